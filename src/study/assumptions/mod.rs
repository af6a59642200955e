//! What a PASS stands on: for each assumption of a plan, the value at which an option no longer passes.
//!
//! 1. Each assumption is tried at ever worse values, with all else as planned. The first value that does not pass ends the assumption,
//!    because results can turn back. With more slack, for example, the force rises and then falls again.
//! 2. A value passes if no more than the accepted share of the samples fails. If the value changes the planned shot, that must pass, too.
//!    All values have the same draws, which no verdict has used. A sample that stays undecided counts as failing.
//! 3. Samples run by turns: one that came nearest to a limit with the plan's values, then one whose draw the value changes most. A value
//!    gets no more samples once too many fail.
//! 4. It also gets no more samples if the first 50 moved so little that no other sample would fail. The others lie lower and change less.
//!    Each is assumed to move three times as far as any of the first, toward each limit and toward firing a hole under no tire. But a
//!    sample always runs if the value makes it another shot ([`mod@change`]). All samples run if one turned undecided, or if the plan ends
//!    runs.
//! 5. Assumptions whose value fails nearest to the plan come first. [`assumed`] defines how near.
//!
//! All values of one ratio are tried before those of the next, over all assumptions. So the nearest few are known before the others are
//! tried to their ends.
//!
//! The result is advice: a value that passes here has no verdict.

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
/// Number of nearest assumptions that one sentence names.
pub const NEAREST: usize = 3;

/// How far one assumption holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption {
    /// The assumption.
    pub assumed: Assumed,
    /// The plan's value. [`Assumed`] defines the values.
    pub stated: f64,
    /// The last value tried before the first that does not pass; `None` if the plan's value itself does not pass.
    pub passes_until: Option<f64>,
    /// The first value that does not pass; `None` if every value tried passes.
    pub fails_from: Option<f64>,
    /// How bad that value is compared with the plan.
    pub ratio: Option<f64>,
    /// Whether there is nothing left to try.
    pub is_complete: bool,
}

/// The assumptions that one option stands on.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumptions {
    /// Index of the option.
    pub option: usize,
    /// Samples of each value; 0 if only the planned shot was asked for.
    pub samples: usize,
    /// Greatest number of failing samples with which a value passes.
    pub accepted: usize,
    /// Verdict on the planned shot.
    pub planned: Verdict,
    /// Number of samples that fail with the plan's values.
    pub failing: usize,
    /// The assumptions, the nearest first.
    pub all: Vec<Assumption>,
}

impl Assumptions {
    /// Whether the option passes here with the plan's values.
    pub fn pass_as_stated(&self) -> bool {
        self.planned == Verdict::Pass && self.failing <= self.accepted
    }

    /// Whether the nearest ends are known, or it is known that there are none. Otherwise it is only known whether the pass is thin.
    pub fn nearest_are_known(&self) -> bool {
        !self.pass_as_stated()
            || self.failing().count() >= NEAREST
            || self.all.iter().all(|assumption| assumption.is_complete)
    }

    /// The assumptions with a known value that does not pass, the nearest first.
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

/// A judged option and what its pass stands on.
#[derive(Clone, Debug)]
pub struct OptionAssumptions {
    /// Index of the option.
    pub option: usize,
    /// Its judgement.
    pub judged: Result<Judgement, NoResult>,
    /// What the pass stands on; `None` if the option does not pass, or the time was up before.
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

/// Usual number of values tried for all assumptions of an option.
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

/// What the passing options stand on. All options are judged first. Each value gets as many samples as the sampling says. Without sampling,
/// only the planned shots count.
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
        // Judge all options together, like `check`. The fresh draws of an option and their share of the error depend on the others.
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

/// Finds what one option stands on. Each value gets as many samples as `sampling` says. Without sampling, only the planned shot counts.
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
            // Values that would make the pass thin are always tried, even if enough ends are nearer by their ratio.
            return climb_while(trials, ladders, is_thin);
        }
    }
    Ok(false)
}

/// Tries values of all ladders while the next one `is_due`. Returns whether the time was up.
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

/// The values of one assumption while they are tried.
struct Ladder {
    rungs: Vec<Rung>,
    /// The samples in the order of the last value tried; empty if no value was sampled.
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

    /// The next value to try; `None` if none is left, or one has failed.
    fn next(&self) -> Option<&Rung> {
        self.rungs.get(self.tried).filter(|_| self.found.fails_from.is_none())
    }

    /// Number of values not tried.
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
