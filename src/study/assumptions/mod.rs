//! What a PASS stands on: for everything that a plan takes as known, the value at which an option no longer passes.
//!
//! 1. Each assumption is tried at ever worse values, all else as the plan says. The first value that does not pass ends it: force
//!    against slack, for one, rises and falls again.
//! 2. A value passes where the shot as planned does, if that changes with it, and no more than the accepted share of the samples
//!    fails. All values have the same draws, which no verdict has used; a sample that stays undecided counts as failing.
//! 3. The samples that came nearest to a limit with what the plan states are run first, by turns with those whose draw the value
//!    changes most: a value at which too many fail gets no others. Nor does one that moved the first 50 so little that none of the
//!    others, which lie lower and change less, would fail if it moved three times as far, toward each limit and toward firing a hole
//!    under no tire. A sample of another shot than as stated, [`mod@change`] says which, is always run, and so are all where one turned
//!    undecided, or where the plan ends runs.
//! 4. Assumptions whose value fails nearest to what is stated come first. How near, [`assumed`] says.
//!
//! All values of one ratio are tried before those of the next, whatever they are of. So the nearest few are known before the others
//! are tried to their ends.
//!
//! It is advice: a value that passes here has no verdict.

pub mod assumed;
mod change;
mod trials;

use serde::{Deserialize, Serialize};

use self::assumed::{Assumed, FACTORS, Rung};
use self::trials::{Drawn, Trials};
use super::judge::Judgement;
use super::judge::batch::Depth;
use super::samples::sample_count::Sampling;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, NoResult};
use crate::scene::Shot;
use crate::sorting::sort_by;
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

    /// Whether the nearest ends are known, or that there are none; else only whether the pass is thin.
    pub fn nearest_are_known(&self) -> bool {
        !self.pass_as_stated()
            || self.failing().count() >= NEAREST
            || self.all.iter().all(|assumption| assumption.is_complete)
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
    /// The study ends once the [`NEAREST`] are known, and whether the pass is thin.
    Nearest,
    /// The study ends once it is known whether the pass is thin.
    Thin,
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
const VALUES_TRIED: usize = 240;

impl Study for Question {
    type Found = Assumptions;
    const SAMPLING: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_VERDICT.seed);
    const LISTED: Option<Listed> = Some(Listed {
        name: "Holds",
        question: "What must hold?",
        about: "Until when does the selected option hold? Of each thing taken as known, the value at which it fails.",
        tells: "until when the pass holds, of each thing assumed",
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
        // As `check` judges, beside all others: which fresh draws an option gets, and with which error, depends on them.
        control.has_steps(2);
        let judging = control.part(SHARE_OF_JUDGEMENT);
        let judged_as = context.with_sampling(of_verdict);
        let Computed { value: judged, mut partial } = match case.shots.len() {
            1 => judged_as.judge_options()?,
            _ => judged_as.judge(Depth::Chosen)?,
        };
        drop(judging);
        let _finding = control.part(1.0);
        let mut all = Vec::new();
        for (n, &option) in self.options.iter().enumerate() {
            let judged = judged[option].clone();
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
        Sampling::exactly(sampling.most, sampling.seed).for_assumptions()
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
    sort_by(&mut all, |a, b| ratio(a).total_cmp(&ratio(b)));
    let value = Assumptions { option, samples: sampling.most, accepted, planned, failing, all };
    Ok(Computed { value, partial })
}

/// Tries values of all ladders, one ratio after the other. Returns whether the time was up.
fn climb(trials: &Trials<'_>, ladders: &mut [Ladder], extent: Extent) -> Result<bool, NoResult> {
    let is_thin = |found: &Assumption, rung: &Rung| {
        found.assumed.thin_until(found.stated).is_some_and(|most| rung.value <= most)
    };
    if extent == Extent::Thin {
        return climb_while(trials, ladders, is_thin);
    }
    for most in [1.0].into_iter().chain(FACTORS).chain([f64::INFINITY]) {
        if climb_while(trials, ladders, |_, rung| rung.ratio <= most)? {
            return Ok(true);
        }
        let known = ladders.iter().filter(|ladder| ladder.found.fails_from.is_some()).count();
        if extent == Extent::Nearest && known >= NEAREST {
            // What would make the pass a thin one is tried in any case, however many ends are nearer by what the plan states.
            return climb_while(trials, ladders, is_thin);
        }
    }
    Ok(false)
}

/// Tries values of all ladders as long as the next one `is_due`. Returns whether the time was up.
fn climb_while(
    trials: &Trials<'_>,
    ladders: &mut [Ladder],
    is_due: impl Fn(&Assumption, &Rung) -> bool,
) -> Result<bool, NoResult> {
    loop {
        let is_due = |ladder: &&mut Ladder| ladder.next().is_some_and(|rung| is_due(&ladder.found, rung));
        let mut next: Vec<&mut Ladder> = ladders.iter_mut().filter(is_due).collect();
        if next.is_empty() {
            return Ok(false);
        }
        if trials.try_next(&mut next)? {
            return Ok(true);
        }
    }
}

/// The values of one assumption, while they are tried.
struct Ladder {
    rungs: Vec<Rung>,
    /// The samples in the order of the value tried last; empty where none was sampled.
    order: Vec<Drawn>,
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
        Self { rungs, order: Vec::new(), tried: 0, found }
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
