//! Searches the firing schedules with the least risk among the schedules that `[search]` allows.
//!
//! 1. Candidates are the schedules that keep the longest duration, and the most holes and the heaviest charge within 8 ms. Of up to
//!    500,000 possible schedules all are examined. Of up to [`MOST_TRIED`] candidates all are tried. If there are more, the search
//!    tries 2,000 at random, then the neighbors of the best, then the neighbors of these, and so on. Mirror images count as one.
//! 2. Successive halving ([`successive_halving`]): a few samples of each candidate, twice as many of the better half, and so on.
//! 3. The best candidates that differ from one another become delay options. They are judged and confirmed as `check` does it,
//!    because the draws that chose them make them look too good.

mod schedule;
mod schedules_to_try;
mod successive_halving;

use serde::{Deserialize, Serialize};

pub use self::schedule::Schedule;
use self::schedule::ScheduleSpace;
pub use self::schedule::{RefusedCounts, SearchLimit};
pub use self::schedules_to_try::MOST_TRIED;
use self::schedules_to_try::{AllowedSchedules, FIRST_OF_SEARCH, SchedulesToTry};
use self::successive_halving::{TriedSchedule, halve, run_samples};
use super::judge::batch::Depth;
use super::judge::recommend::safest_first;
use super::judge::{Judgement, OptionResults, verdict_of};
use super::samples::sample_count::Sampling;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, NoResult, Shard};
use crate::plan::names::look_alike;
use crate::plan::{DelayOption, Plan, edit};
use crate::sorting::{sort_by_key, sorted_by};
use crate::verdict::Verdict;

/// First samples of each schedule if all are screened.
const FIRST_OF_ALL: usize = 16;
/// Greatest number of schedules in the report.
const MOST_REPORTED: usize = 10;
/// Shares of the remaining progress: for exploring if not all schedules are tried, and for screening.
const SHARE_OF_EXPLORING: f64 = 0.4;
const SHARE_OF_SCREENING: f64 = 0.2;
/// Greatest number of schedules with a full verdict.
const JUDGED_IN_FULL: usize = 12;
/// Least number of samples of a schedule in the front of risk against duration.
const SAMPLES_OF_FRONT: usize = 256;

/// Result of a search.
#[derive(Clone, Debug)]
pub struct Search {
    /// The plan, with the found schedules as its delay options, best first.
    pub case: Case,
    /// The schedules (`n_options` of the case).
    pub schedules: Vec<Schedule>,
    /// Results of the schedules, as of delay options.
    pub results: OptionResults,
    /// Failing shares of the schedules among the samples that chose them.
    pub rough: Vec<RoughShare>,
    /// Number of schedules that `[search]` describes, including mirror images.
    pub possible: usize,
    /// Number of schedules that keep the limits of the search; `None` if there are too many to examine all.
    pub within_limits: Option<usize>,
    /// Numbers of schedules left out, by the limit that they exceed.
    pub refused: RefusedCounts,
    /// Number of screened schedules: they got first samples, or a check if no samples were requested.
    pub screened: usize,
    /// Whether all schedules that keep the limits of `[search]` were screened.
    pub complete: bool,
    /// Whether samples were requested.
    pub sampled: bool,
    /// Number of screened schedules that have no full verdict, and no failed sample.
    pub without_failure: usize,
    /// The Pareto front of duration and failing share, shortest first. No shorter screened schedule fails less than a schedule of
    /// the front.
    pub front: Vec<FrontPoint>,
}

/// Failing share among the samples that chose a schedule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughShare {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that fail or are undecided.
    pub failures: usize,
}

/// A schedule of the front: no shorter schedule fails less.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontPoint {
    /// The schedule.
    pub schedule: Schedule,
    /// Time from the first hole to the last [s].
    pub duration: f64,
    /// Failing share among its samples.
    pub share: RoughShare,
}

/// The question: which schedules have the least risk?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {}

/// Average number of samples of a schedule.
const RUNS_OF_SCHEDULE: usize = 40;
/// Runs of a schedule that is judged in full. The schedules nearest to the limit take the most samples, and duds. Measured on
/// `amur-three-rows`.
const RUNS_OF_JUDGED_SCHEDULE: usize = 3500;

impl Study for Question {
    type Found = Search;
    const IS_SHARED: bool = true;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Search",
        question: "Safest schedule?",
        about: "Which schedules fail least? Orders, intervals and holes that [search] allows.",
        tells: "which schedules fail least, their orders and intervals",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        let tried = ScheduleSpace::new(case).ok()?.count().min(MOST_TRIED);
        Some(tried * RUNS_OF_SCHEDULE + tried.min(JUDGED_IN_FULL) * RUNS_OF_JUDGED_SCHEDULE)
    }

    fn usual(_case: &Case, _about: Subject) -> Self {
        Self {}
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Search> {
        search(context)
    }

    /// Draws the first samples of the schedules of one shard, for the journal. With more than [`MOST_TRIED`] candidates, a search
    /// screens only the best, so it has no shards.
    fn answer_shard(&self, context: &Context<'_>, shard: Shard) -> ComputeResult<()> {
        let &Context { case, .. } = context;
        let space = ScheduleSpace::new(case)?;
        let listed = AllowedSchedules::new(case, &space);
        if !listed.are_all_tried() {
            let why = format!("of more than {MOST_TRIED} schedules the best are searched, not shared");
            return Err(NoResult::NotShared(why));
        }
        let mut to_try = SchedulesToTry::new(case, &space);
        to_try.add(listed.allowed.unwrap_or_default());
        let ours = to_try.tried.into_iter().enumerate().filter(|(number, _)| shard.has(*number));
        let mut ours: Vec<TriedSchedule> = ours.map(|(_, trial)| trial).collect();
        run_samples(&for_screening(context), &mut ours, FIRST_OF_ALL)
    }
}

/// Searches the schedules of a plan. Without a `sampling` only the planned shots count.
pub fn search(context: &Context<'_>) -> ComputeResult<Search> {
    let &Context { case, control, sampling, .. } = context;
    let space = ScheduleSpace::new(case)?;
    let screened_as = for_screening(context);
    let listed = AllowedSchedules::new(case, &space);
    let (complete, within_limits) = (listed.are_all_tried(), listed.allowed.as_ref().map(Vec::len));
    let mut to_try = SchedulesToTry::new(case, &space);
    let mut out_of_time = false;
    control.has_steps(if complete { 2 } else { 3 });
    match listed.allowed {
        Some(allowed) if complete => to_try.add(allowed),
        allowed => {
            let _exploring = control.part(SHARE_OF_EXPLORING);
            out_of_time = to_try.explore(&screened_as, allowed.as_deref())?.partial;
        }
    }
    let mut tried = to_try.tried;
    let first = if complete { FIRST_OF_ALL } else { FIRST_OF_SEARCH };
    let screening = control.part(SHARE_OF_SCREENING);
    out_of_time |= halve(&screened_as, &mut tried, first)?.partial;
    drop(screening);
    let finalists = choose_finalists(&space, &tried);
    let not_chosen =
        tried.iter().filter(|trial| !finalists.iter().any(|(_, other)| other.shot == trial.shot));
    let without_failure =
        not_chosen.filter(|trial| trial.tally.samples > 0 && trial.tally.failures == 0).count();
    let front = pareto_front(&space, &tried);
    if let Some((first, _)) = finalists.first() {
        control.note_trying(first.named_option(&case.plan.blast_rows).name);
    }
    let judging = control.part(1.0);
    let schedules: Vec<Schedule> = finalists.iter().map(|(schedule, _)| schedule.clone()).collect();
    let rough = finalists.iter().map(|(_, trial)| RoughShare::of(trial)).collect();
    let (case, Computed { value: results, partial }) = judge(context, &schedules)?;
    drop(judging);
    let screened = tried.iter().filter(|trial| trial.tally.samples > 0).count();
    let mut found = Search {
        case,
        schedules,
        results,
        rough,
        possible: space.count(),
        within_limits,
        refused: listed.refused,
        screened,
        complete: complete && screened == tried.len(),
        sampled: sampling.is_some(),
        without_failure,
        front,
    };
    found.rank();
    Ok(Computed { value: found, partial: partial || out_of_time })
}

/// The context for the samples that choose.
fn for_screening<'c>(context: &Context<'c>) -> Context<'c> {
    context.with_sampling(context.sampling.as_ref().map(Sampling::for_screening))
}

impl RoughShare {
    fn of(tried: &TriedSchedule) -> Self {
        Self { samples: tried.tally.samples, failures: tried.tally.failures }
    }

    /// Failures over samples.
    pub fn value(self) -> f64 {
        self.failures as f64 / self.samples.max(1) as f64
    }
}

/// The best of the sorted schedules that differ from one another. They are judged in full.
fn choose_finalists<'r>(
    space: &ScheduleSpace<'_>,
    tried: &'r [TriedSchedule],
) -> Vec<(Schedule, &'r TriedSchedule)> {
    let mut chosen: Vec<(Schedule, &TriedSchedule)> = Vec::new();
    for trial in tried.iter().filter(|trial| trial.tally.samples > 0) {
        let schedule = space.schedule(&trial.candidate);
        if chosen.len() < JUDGED_IN_FULL && !chosen.iter().any(|(other, _)| other.is_nearly_same(&schedule)) {
            chosen.push((schedule, trial));
        }
    }
    chosen
}

/// The Pareto front: the schedules for which no shorter schedule fails less.
fn pareto_front(space: &ScheduleSpace<'_>, tried: &[TriedSchedule]) -> Vec<FrontPoint> {
    let sampled_enough = tried.iter().filter(|trial| trial.tally.samples >= SAMPLES_OF_FRONT);
    let point = |trial: &TriedSchedule| FrontPoint {
        schedule: space.schedule(&trial.candidate),
        duration: trial.shot.duration(),
        share: RoughShare::of(trial),
    };
    let in_turn = sorted_by(sampled_enough.map(point), |a, b| {
        a.duration.total_cmp(&b.duration).then(a.share.value().total_cmp(&b.share.value()))
    });
    let mut front: Vec<FrontPoint> = Vec::new();
    for point in in_turn {
        if front.last().is_none_or(|last| point.share.value() < last.share.value()) {
            front.push(point);
        }
    }
    front
}

/// The delay option of a schedule. If an option of the plan fires alike, it has the name of that option, else a name that no option
/// has.
fn option_with_free_name(case: &Case, schedule: &Schedule) -> DelayOption {
    let new = schedule.named_option(&case.plan.blast_rows);
    if let Some(old) = case.plan.delays.iter().find(|old| old.fires_like(&new)) {
        return DelayOption { name: old.name.clone(), ..new };
    }
    let name =
        edit::free_name(&new.name, |name| case.plan.delays.iter().any(|old| look_alike(&old.name, name)));
    DelayOption { name, ..new }
}

/// Judges schedules as delay options of their own plan.
fn judge(context: &Context<'_>, schedules: &[Schedule]) -> Result<(Case, Computed<OptionResults>), NoResult> {
    let &Context { case, .. } = context;
    let delays = schedules.iter().map(|schedule| option_with_free_name(case, schedule)).collect();
    let plan = Plan { delays, ..case.plan.clone() };
    let case = Case::new(plan).with_source(case.source.clone());
    let found = context.with_case(&case).judge(Depth::Chosen)?;
    Ok((case, found))
}

impl Search {
    /// Sorts the schedules by verdict, then the safest first, and keeps [`MOST_REPORTED`] of them.
    fn rank(&mut self) {
        let mut ranked = safest_first(&self.case, &self.results, |n| self.rough[n].value());
        sort_by_key(&mut ranked, |&n| verdict_of(&self.results[n]));
        ranked.truncate(MOST_REPORTED);
        self.case = self.case.with_options(&ranked);
        self.schedules = ranked.iter().map(|&n| self.schedules[n].clone()).collect();
        self.results = ranked.iter().map(|&n| self.results[n].clone()).collect();
        self.rough = ranked.iter().map(|&n| self.rough[n]).collect();
    }

    /// The schedules that pass, as delay options, best first.
    pub fn passing(&self) -> impl Iterator<Item = &DelayOption> {
        let all = self.case.plan.delays.iter().zip(&self.results);
        let passes = |result: &Result<Judgement, NoResult>| match result {
            // At a step that the user fixed, no sample is audited.
            Ok(judged) if self.sampled => judged.is_full_pass(),
            result => verdict_of(result) == Verdict::Pass,
        };
        all.filter(move |(_, result)| passes(result)).map(|(delay, _)| delay)
    }
}

impl Computed<Search> {
    /// The verdict on the best schedule. A search that ran out of time is no pass. If all schedules were examined and none keeps
    /// the limits of the search, the verdict is a fail.
    pub fn verdict(&self) -> Verdict {
        let Computed { value: search, partial } = self;
        let verdict = match search.results.first() {
            None if search.complete => Verdict::Fail,
            None => Verdict::Undecided,
            Some(best) => verdict_of(best),
        };
        let is_none_offered = search.passing().next().is_none();
        if (*partial || is_none_offered) && verdict == Verdict::Pass { Verdict::Undecided } else { verdict }
    }
}
