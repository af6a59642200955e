//! The schedules to try: all that keep the limits of the search, or those that the search finds.

use std::collections::HashSet;

use itertools::Itertools;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::schedule::{Candidate, KnownShots, RefusedCounts, ScheduleSpace, SearchLimit};
use super::successive_halving::{TriedSchedule, run_samples};
use crate::sorting::sorted_by;
use crate::study::{Case, ComputeResult, Computed, Context};

/// Greatest number of allowed schedules that are all tried.
pub const MOST_TRIED: usize = 4000;
/// Greatest number of schedules that are all examined for the limits of the search.
const MOST_LISTED: usize = 500_000;
/// Number of random schedules that a search begins with, and greatest number of draws for them.
const RANDOM_STARTS: usize = 2000;
const MOST_DRAWS: usize = 50 * RANDOM_STARTS;
/// Number of best schedules whose neighbors are tried at a time.
const CLIMBERS: usize = 24;
/// First samples of each schedule of a search.
pub const FIRST_OF_SEARCH: usize = 8;

/// The schedules that keep the limits of the search.
pub struct AllowedSchedules {
    /// The schedules in order; `None` if there are too many to examine all.
    pub allowed: Option<Vec<Candidate>>,
    /// Numbers of schedules left out, by the limit that they exceed.
    pub refused: RefusedCounts,
}

impl AllowedSchedules {
    /// Examines all schedules of a plan, unless there are too many.
    pub fn new(case: &Case, space: &ScheduleSpace<'_>) -> Self {
        let mut refused = RefusedCounts::default();
        let listed = (space.count() <= MOST_LISTED).then(|| space.all());
        let allowed = listed.map(|listed| {
            let limits: Vec<Option<SearchLimit>> = listed
                .par_iter()
                .map(|candidate| space.exceeded_limit(&space.schedule(candidate).shot(case)))
                .collect();
            limits.iter().flatten().for_each(|limit| refused.count(*limit));
            let without_limit = listed.into_iter().zip(limits).filter(|(_, limit)| limit.is_none());
            without_limit.map(|(candidate, _)| candidate).collect()
        });
        Self { allowed, refused }
    }

    /// Whether the schedules are so few that all are tried.
    pub fn are_all_tried(&self) -> bool {
        self.allowed.as_ref().is_some_and(|allowed| allowed.len() <= MOST_TRIED)
    }
}

/// The schedules to screen.
pub struct SchedulesToTry<'c> {
    case: &'c Case,
    space: &'c ScheduleSpace<'c>,
    known: KnownShots,
    /// The schedules, in the order in which they were added.
    pub tried: Vec<TriedSchedule>,
}

impl<'c> SchedulesToTry<'c> {
    /// No schedule.
    pub fn new(case: &'c Case, space: &'c ScheduleSpace<'c>) -> Self {
        Self { case, space, known: KnownShots::default(), tried: Vec::new() }
    }

    /// Adds the candidates that are allowed and not known yet.
    pub fn add(&mut self, candidates: impl IntoIterator<Item = Candidate>) {
        for candidate in candidates {
            let shot = self.space.schedule(&candidate).shot(self.case);
            if self.space.exceeded_limit(&shot).is_none() && self.known.insert(self.case, &shot) {
                self.tried.push(TriedSchedule::new(candidate, shot));
            }
        }
    }

    /// Searches if not all schedules can be screened. `allowed` are the schedules that keep the limits, if all were examined.
    pub fn explore(&mut self, context: &Context<'_>, allowed: Option<&[Candidate]>) -> ComputeResult<()> {
        let mut random = ChaCha8Rng::seed_from_u64(context.sampling.map_or(0, |sampling| sampling.seed));
        // If the limits of the search allow few schedules, more are drawn.
        for _ in 0..MOST_DRAWS {
            self.add([match allowed {
                Some(allowed) => allowed[random.random_range(0..allowed.len())].clone(),
                None => self.space.random(&mut random),
            }]);
            if self.tried.len() == RANDOM_STARTS {
                break;
            }
        }
        let mut seen: HashSet<Candidate> = HashSet::new();
        loop {
            let left = MOST_TRIED.saturating_sub(self.tried.len());
            let new = self.tried.iter().filter(|trial| trial.tally.samples == 0).count();
            let _round = context.control.part(new as f64 / (new + left).max(1) as f64);
            let drawn = run_samples(context, &mut self.tried, FIRST_OF_SEARCH)?;
            if drawn.partial {
                return Ok(drawn);
            }
            let unseen = self.tried.iter().filter(|trial| !seen.contains(&trial.candidate));
            let best = sorted_by(unseen, |a, b| {
                a.tally.estimated_failing_share().total_cmp(&b.tally.estimated_failing_share())
            });
            let best: Vec<Candidate> =
                best.into_iter().take(CLIMBERS).map(|trial| trial.candidate.clone()).collect();
            let room = MOST_TRIED.saturating_sub(self.tried.len());
            if best.is_empty() || room == 0 {
                return Ok(Computed::complete(()));
            }
            let near = best.iter().flat_map(|candidate| self.space.neighbours(candidate)).unique().take(room);
            self.add(near.collect::<Vec<_>>());
            seen.extend(best);
        }
    }
}
