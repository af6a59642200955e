//! What a PASS stands on: for everything that a plan takes as known, the value at which an option no longer passes.
//!
//! 1. Each assumption is tried at ever worse values, all else as the plan says. The first value that does not pass ends it: force
//!    against slack, for one, rises and falls again.
//! 2. A value passes where the shot as planned does, if that changes with it, and no more than the accepted share of the samples
//!    fails. All values have the same draws, which no verdict has used; a sample that stays undecided counts as failing.
//! 3. Samples that came nearest to a limit with what the plan states are run first: a value at which too many fail gets no others. Nor
//!    does one that moved the first 100 so little that none of the others, which lie lower, would fail if it moved twice as far.
//! 4. Assumptions whose value fails nearest to what is stated come first. How near, [`assumed`] says.
//!
//! All values of one ratio are tried before those of the next, whatever they are of. So the nearest few are known before the others
//! are tried to their ends.
//!
//! It is advice: a value that passes here has no verdict.

pub mod assumed;

use std::ops::Range;

use serde::{Deserialize, Serialize};

use self::assumed::{Assumed, FACTORS, Rung};
use super::as_planned::check_many::or_failed_run;
use super::as_planned::quick_check::quick_check;
use super::judge::Judgement;
use super::judge::batch::Depth;
use super::samples::random_shot::draw_shot;
use super::samples::sample::SampleRun;
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::{ShotToSample, run_sample_once};
use super::settings::{Listed, Study, Subject};
use super::work::batch::{run_announced_batch, run_batch};
use super::{Case, ComputeResult, Computed, Context, NoResult, ShotSummary, catch_panic};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// Samples of each value.
pub const SAMPLES: usize = 300;
/// The nearest assumptions that one sentence names.
pub const NEAREST: usize = 3;

/// How far one assumption holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption {
    /// What is assumed.
    pub assumed: Assumed,
    /// The value that the plan states; values are as [`Assumed`] says.
    pub stated: f64,
    /// The last value tried before the first that does not pass; `None` where what is stated does not.
    pub passes_until: Option<f64>,
    /// The first value that does not pass; `None` where every value that was tried passes.
    pub fails_from: Option<f64>,
    /// How large that value is against what is stated.
    pub ratio: Option<f64>,
    /// Whether no further value is left to be tried.
    pub is_complete: bool,
}

/// What one option stands on.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumptions {
    /// Index of the option.
    pub option: usize,
    /// Samples of each value; 0 where only the shot as planned was asked for.
    pub samples: usize,
    /// Most samples of a value that passes which fail.
    pub accepted: usize,
    /// Verdict on the shot as planned.
    pub planned: Verdict,
    /// Samples that fail with all as stated.
    pub failing: usize,
    /// The assumptions, the nearest first.
    pub all: Vec<Assumption>,
}

impl Assumptions {
    /// Whether the option passes here with all as stated.
    pub fn pass_as_stated(&self) -> bool {
        self.planned == Verdict::Pass && self.failing <= self.accepted
    }

    /// The assumptions of which a value that does not pass is known, the nearest first.
    pub fn failing(&self) -> impl Iterator<Item = &Assumption> {
        self.all.iter().filter(|assumption| assumption.fails_from.is_some())
    }
}

/// How far a study goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Extent {
    /// Every assumption is tried to its end.
    All,
    /// The study ends once the [`NEAREST`] are known.
    Nearest,
}

/// An option, judged, and what its pass stands on.
#[derive(Clone, Debug)]
pub struct OptionAssumptions {
    /// Index of the option.
    pub option: usize,
    /// Its judgement.
    pub judged: Result<Judgement, NoResult>,
    /// `None` where it does not pass, or the time was up before.
    pub assumptions: Option<Assumptions>,
}

/// What the pass of one option stands on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Index of the option.
    pub option: usize,
    /// How far the study goes.
    pub extent: Extent,
}

/// Values that all assumptions of an option are usually tried at.
const VALUES_TRIED: usize = 150;

impl Study for Question {
    type Found = Assumptions;
    const SAMPLING: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_VERDICT.seed);
    const LISTED: Option<Listed> = Some(Listed {
        name: "Holds",
        question: "What must hold?",
        about: "Until when does the selected option hold? Of each thing taken as known, the value at which it fails.",
    });

    fn expected_runs(_case: &Case) -> Option<usize> {
        Some(VALUES_TRIED * SAMPLES / 2)
    }

    fn usual(_case: &Case, about: Subject) -> Self {
        Self { option: about.option, extent: Extent::All }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Assumptions> {
        find_assumptions(context, self.option, self.extent)
    }
}

/// What the options stand on that pass. They are judged first; each value gets as many samples as the sampling says, and without it only
/// the shots as planned count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfPassing {
    /// Indices of the options.
    pub options: Vec<usize>,
}

impl Study for OfPassing {
    type Found = Vec<OptionAssumptions>;
    const SAMPLING: Sampling = Question::SAMPLING;

    fn usual(case: &Case, _about: Subject) -> Self {
        Self { options: (0..case.shots.len()).collect() }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Self::Found> {
        let &Context { case, control, sampling, .. } = context;
        let of_verdict = sampling.map(|sampling| Sampling { seed: sampling.seed, ..Sampling::OF_VERDICT });
        // An option that others stand beside needs the fresh draws that `check` gives it.
        control.has_steps(2);
        let judging = control.part(SHARE_OF_JUDGEMENT);
        let chosen = case.with_options(&self.options);
        let judged_as = context.with_case(&chosen).with_sampling(of_verdict);
        let Computed { value: judged, mut partial } = match case.shots.len() {
            1 => judged_as.judge_options()?,
            _ => judged_as.judge(Depth::Chosen)?,
        };
        drop(judging);
        let _finding = control.part(1.0);
        let mut all = Vec::new();
        for (n, (&option, judged)) in self.options.iter().zip(judged).enumerate() {
            let _one = control.part(1.0 / (self.options.len() - n) as f64);
            let mut assumptions = None;
            if judged.as_ref().is_ok_and(|judged| judged.verdict() == Verdict::Pass) {
                match find_assumptions(context, option, Extent::All) {
                    Err(NoResult::OutOfTime) => partial = true,
                    found => {
                        let found = found?;
                        partial |= found.partial;
                        assumptions = Some(found.value);
                    }
                }
            }
            all.push(OptionAssumptions { option, judged, assumptions });
        }
        Ok(Computed { value: all, partial })
    }
}

/// Share of the work that the judgement of the options takes.
const SHARE_OF_JUDGEMENT: f64 = 0.3;

/// Finds what one option stands on. Each value gets as many samples as `sampling` says; without it only the shot as planned counts.
pub fn find_assumptions(context: &Context<'_>, option: usize, extent: Extent) -> ComputeResult<Assumptions> {
    find_these(context, option, Assumed::all(), extent)
}

/// Finds how far these assumptions of one option hold.
pub fn find_these(
    context: &Context<'_>,
    option: usize,
    assumptions: impl Iterator<Item = Assumed>,
    extent: Extent,
) -> ComputeResult<Assumptions> {
    let &Context { case, control, sampling, .. } = context;
    let shot = &case.shots[option];
    let sampling = sampling.map_or(Sampling::exactly(0, 0), |sampling| {
        Sampling::exactly(sampling.most, sampling.seed).for_screening()
    });
    let tried = |assumed: &Assumed| sampling.most > 0 || assumed.is_of_planned_shot();
    let mut ladders: Vec<Ladder> =
        assumptions.filter(tried).map(|assumed| Ladder::new(assumed, case, shot)).collect();
    let values: usize = 1 + ladders.iter().map(|ladder| ladder.rungs.len()).sum::<usize>();
    control.announce(values * sampling.most);
    let trials = Trials::new(context, shot, sampling)?;
    let accepted = trials.accepted;
    let failing = trials.as_stated.iter().filter(|run| run.verdict != Verdict::Pass).count();
    let planned = trials.check(case, shot)?;
    let mut partial = false;
    if planned == Verdict::Pass && failing <= accepted {
        partial = climb(&trials, &mut ladders, extent)?;
    } else {
        ladders.iter_mut().for_each(Ladder::fail_as_stated);
    }
    ladders.iter().for_each(|ladder| control.advance_by(ladder.left() * sampling.most));
    let mut all: Vec<Assumption> = ladders.into_iter().map(|ladder| ladder.found).collect();
    let ratio = |assumption: &Assumption| assumption.ratio.unwrap_or(f64::INFINITY);
    all.sort_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    let value = Assumptions { option, samples: sampling.most, accepted, planned, failing, all };
    Ok(Computed { value, partial })
}

/// Tries values of all ladders, one ratio after the other. Returns whether the time was up.
fn climb(trials: &Trials<'_>, ladders: &mut [Ladder], extent: Extent) -> Result<bool, NoResult> {
    for most in [1.0].into_iter().chain(FACTORS).chain([f64::INFINITY]) {
        loop {
            let mut next: Vec<&mut Ladder> = ladders
                .iter_mut()
                .filter(|ladder| ladder.next().is_some_and(|rung| rung.ratio <= most))
                .collect();
            if next.is_empty() {
                break;
            }
            if trials.try_next(&mut next)? {
                return Ok(true);
            }
        }
        let known = ladders.iter().filter(|ladder| ladder.found.fails_from.is_some()).count();
        if extent == Extent::Nearest && known >= NEAREST {
            break;
        }
    }
    Ok(false)
}

/// The values of one assumption, while they are tried.
struct Ladder {
    rungs: Vec<Rung>,
    /// Number of values tried.
    tried: usize,
    found: Assumption,
}

impl Ladder {
    fn new(assumed: Assumed, case: &Case, shot: &Shot) -> Self {
        let (stated, rungs) = (assumed.stated(&case.plan, shot), assumed.rungs(&case.plan, shot));
        let found = Assumption {
            assumed,
            stated,
            passes_until: Some(stated),
            fails_from: None,
            ratio: None,
            is_complete: rungs.is_empty(),
        };
        Self { rungs, tried: 0, found }
    }

    /// The next value to try; `None` where there is none, or one has failed.
    fn next(&self) -> Option<&Rung> {
        self.rungs.get(self.tried).filter(|_| self.found.fails_from.is_none())
    }

    /// Number of values that were not tried.
    fn left(&self) -> usize {
        self.rungs.len() - self.tried
    }

    fn note(&mut self, passes: bool) {
        let Some(&Rung { value, ratio }) = self.next() else { return };
        self.tried += 1;
        if passes {
            self.found.passes_until = Some(value);
        } else {
            (self.found.fails_from, self.found.ratio) = (Some(value), Some(ratio));
        }
        self.found.is_complete = !passes || self.left() == 0;
    }

    fn fail_as_stated(&mut self) {
        let stated = self.found.stated;
        self.found = Assumption {
            passes_until: None,
            fails_from: Some(stated),
            ratio: Some(1.0),
            is_complete: true,
            ..self.found
        };
    }
}

/// What all values are tried with.
struct Trials<'t> {
    context: &'t Context<'t>,
    shot: &'t Shot,
    sampling: Sampling,
    /// Most samples of a value that passes which fail.
    accepted: usize,
    /// The samples with all as stated.
    as_stated: Vec<SampleRun>,
    /// Greatest share of a limit that each of them uses; infinite for one that stayed undecided.
    stated_use: Vec<f64>,
    /// Numbers of the samples, those that came nearest to a limit first.
    hardest_first: Vec<usize>,
}

/// Samples of the first rounds of a value; the last round takes all others.
const ROUNDS: [usize; 2] = [25, 75];
/// Samples that a value has had before those left may be spared.
const LEAST_BEFORE_SPARED: usize = 100;
/// Times that a sample which is spared may move as far as the one that moved farthest.
const SPARED_MOVE: f64 = 2.0;

/// Greatest share of a limit that a run uses; infinite where it stays undecided.
fn used(run: &SampleRun, case: &Case) -> f64 {
    if run.verdict == Verdict::Undecided { f64::INFINITY } else { run.utilization(&case.limits) }
}

impl<'t> Trials<'t> {
    /// Runs the samples with all as stated.
    fn new(context: &'t Context<'t>, shot: &'t Shot, sampling: Sampling) -> Result<Self, NoResult> {
        let &Context { case, compute, control, .. } = context;
        let target = ShotToSample::new(case, shot, compute, sampling);
        let numbers: Vec<usize> = (0..sampling.most).collect();
        let runs = run_announced_batch(&numbers, control, |&number| {
            Ok(run_sample_once(&target, number, control)?.run)
        })?;
        let as_stated = runs.into_iter().collect::<Option<Vec<SampleRun>>>().ok_or(NoResult::OutOfTime)?;
        let stated_use: Vec<f64> = as_stated.iter().map(|run| used(run, case)).collect();
        let mut hardest_first = numbers;
        hardest_first.sort_by(|&a, &b| stated_use[b].total_cmp(&stated_use[a]));
        let accepted = (case.limits.accepted_risk * sampling.most as f64 + 1e-9).floor() as usize;
        Ok(Self { context, shot, sampling, accepted, as_stated, stated_use, hardest_first })
    }

    /// The verdict on a shot as planned.
    fn check(&self, case: &Case, shot: &Shot) -> Result<Verdict, NoResult> {
        match catch_panic(|| or_failed_run(quick_check(&self.context.with_case(case), shot))) {
            Err(NoResult::Panicked(_)) => Ok(ShotSummary::FAILED_RUN.verdict),
            checked => Ok(checked?.verdict),
        }
    }

    /// Tries the next value of each of these ladders. Returns whether the time was up: then none of them has moved.
    fn try_next(&self, ladders: &mut [&mut Ladder]) -> Result<bool, NoResult> {
        let (&Context { case, control, .. }, shot) = (self.context, self.shot);
        let vary = |ladder: &&mut Ladder| {
            let (case, shot) = ladder.next().map_or_else(
                || (case.clone(), shot.clone()),
                |rung| ladder.found.assumed.vary(case, shot, rung),
            );
            Varied { assumed: ladder.found.assumed, case, shot, failing: 0, farthest_move: 0.0 }
        };
        let mut varied: Vec<Varied> = ladders.iter().map(vary).collect();
        let planned = run_batch(&varied, control, |varied| match varied.shot == *shot {
            true => Ok(Verdict::Pass),
            false => self.check(&varied.case, &varied.shot),
        })?;
        let Some(planned) = planned.into_iter().collect::<Option<Vec<Verdict>>>() else { return Ok(true) };
        let mut passes: Vec<bool> = planned.into_iter().map(|verdict| verdict == Verdict::Pass).collect();
        let fail_as_planned = passes.iter().filter(|passes| !**passes).count();
        control.advance_by(fail_as_planned * self.sampling.most);
        let mut open: Vec<usize> = (0..varied.len()).filter(|&n| passes[n]).collect();
        for round in self.rounds() {
            let jobs: Vec<(usize, usize)> = open
                .iter()
                .flat_map(|&n| self.hardest_first[round.clone()].iter().map(move |&number| (n, number)))
                .collect();
            let runs = run_announced_batch(&jobs, control, |&(n, number)| self.sample(&varied[n], number))?;
            for (&(n, number), run) in jobs.iter().zip(runs) {
                let Some(run) = run else { return Ok(true) };
                let Varied { failing, farthest_move, .. } = &mut varied[n];
                *failing += usize::from(run.verdict != Verdict::Pass);
                *farthest_move = farthest_move.max(used(&run, case) - self.stated_use[number]);
            }
            open.retain(|&n| {
                passes[n] = varied[n].failing <= self.accepted;
                let goes_on = passes[n] && !self.spares_the_rest(&varied[n], round.end);
                control.advance_by(if goes_on { 0 } else { self.sampling.most - round.end });
                goes_on
            });
        }
        for (ladder, passes) in ladders.iter_mut().zip(passes) {
            ladder.note(passes);
        }
        Ok(false)
    }

    /// The places in [`Self::hardest_first`] of the samples of each round.
    fn rounds(&self) -> Vec<Range<usize>> {
        let (mut rounds, mut start) = (Vec::new(), 0_usize);
        for size in ROUNDS.into_iter().chain([usize::MAX]) {
            let end = start.saturating_add(size).min(self.sampling.most);
            rounds.push(start..end);
            start = end;
        }
        rounds
    }

    /// Whether none of the samples after the first `run` would fail, were it moved by [`SPARED_MOVE`] times as much as any of those.
    fn spares_the_rest(&self, varied: &Varied, run: usize) -> bool {
        let Some(&next) = self.hardest_first.get(run) else { return false };
        let bound = self.stated_use[next] + SPARED_MOVE * varied.farthest_move;
        run >= LEAST_BEFORE_SPARED && varied.assumed.moves_all_draws() && bound < 1.0
    }

    /// One sample. A draw that another value leaves as it is need not be run again.
    fn sample(&self, varied: &Varied, number: usize) -> Result<SampleRun, NoResult> {
        let Self { context: &Context { case, compute, control, .. }, shot, sampling, .. } = *self;
        if varied.assumed.leaves_most_draws() {
            let drawn = |case: &Case, shot: &Shot| draw_shot(case, shot, sampling.seed, number).shot;
            if drawn(&varied.case, &varied.shot) == drawn(case, shot) {
                return Ok(self.as_stated[number]);
            }
        }
        let target = ShotToSample::new(&varied.case, &varied.shot, compute, sampling);
        Ok(run_sample_once(&target, number, control)?.run)
    }
}

/// The plan and the shot with one value of one assumption.
struct Varied {
    assumed: Assumed,
    case: Case,
    shot: Shot,
    /// Samples that fail so far.
    failing: usize,
    /// Farthest that a sample moved toward a limit, as a share of it.
    farthest_move: f64,
}
