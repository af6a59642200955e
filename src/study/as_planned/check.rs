//! The check of the planned shot of one delay option, refined until the verdict is sure.
//!
//! The option runs at a ladder of steps. Each step is [`step_error::RATIO`] times finer than the one before. The finest run gives
//! the values, and the coarser runs give the errors. While the verdict is open, a finer run is added.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::cover::{Cover, CoverRecorder};
use super::ladder::{Finding, run_ladder};
use super::peaks::{error_runs, peaks_with_rivals};
use super::shot_reason::{
    ShotReason, energy_balance_closes, find_reasons_as_planned, with_limits, with_unknown_errors,
};
use super::step_error;
use crate::choice::Accuracy;
use crate::outcome::{BrokenCable, History, Outcome, RunEnd};
use crate::scene::Shot;
use crate::simulation::{Motion, RunError};
use crate::study::hole_places::count_under_no_tire;
use crate::study::{Case, ComputeSettings};
use crate::verdict::{Estimate, Limits, PerQuantity, Quantity, Verdict};

/// A planned shot, checked by a ladder of runs.
#[derive(Clone, Debug)]
pub struct CheckedShot {
    /// Whether the launch velocity is an estimate that nobody observed. A judgement is then no pass.
    pub launch_is_estimated: bool,
    /// Pass, fail, or undecided at the finest step allowed.
    pub verdict: Verdict,
    /// Why the verdict is not a pass; empty for a pass.
    pub reasons: Vec<ShotReason>,
    /// Greatest flight height of any tire [m], force of any cable [N], and drift of any tire at the end [m].
    pub estimates: PerQuantity<Estimate>,
    /// Breaking force over greatest force; infinite if no cable pulls, and NaN if the force is unknown.
    pub safety_factor: f64,
    /// Broken cables in order of time; empty if the plan lets no cable break.
    pub broken: Vec<BrokenCable>,
    /// Height and force over time.
    pub history: History,
    /// The cover over each hole as it fires.
    pub cover: Cover,
    /// Requested method and accuracy.
    pub compute: ComputeSettings,
    /// Step of the run that gave the values [s].
    pub step: f64,
    /// Number of steps of that run.
    pub steps: usize,
    /// Energy residual of that run over the energy that the holes put in.
    pub energy_residual: f64,
    /// Time and reason of the end of that run.
    pub end: RunEnd,
    /// Computing time of the run that gave the values.
    pub wall: Duration,
    /// Computing time of all runs.
    pub total_wall: Duration,
    /// Number of runs behind the verdict.
    pub runs: usize,
    /// Number of steps of all runs.
    pub total_steps: usize,
}

/// Progress of a check: the number of finished runs, and the simulated time of the present run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckProgress {
    /// Number of finished runs.
    pub runs: usize,
    /// Simulated time that the present run has reached [s].
    pub time: f64,
}

/// Factor on the error with which a verdict must still stand to be sure, and a pass to be a pass. The error itself holds in 19 of
/// 20 runs, and a verdict must hold in more. With a factor of 2, 4 of 4,480 limits near true values were passed or failed wrongly.
pub const SURE_ERROR_FACTOR: f64 = 3.0;

impl CheckedShot {
    /// Height [m], force [N] or drift [m].
    pub fn get(&self, quantity: Quantity) -> Estimate {
        *self.estimates.get(quantity)
    }

    /// Share of its limit that a quantity takes; `None` if it has no limit.
    pub fn share_of_limit(&self, quantity: Quantity, limits: &Limits) -> Option<f64> {
        Some(self.get(quantity).value / limits.get(quantity)?)
    }
}

/// Whether the verdict of the limits would stand with errors [`SURE_ERROR_FACTOR`] times larger. For a pass the energy balance must
/// close, too; `residual` is over the energy put in.
fn is_sure(estimates: &PerQuantity<Estimate>, residual: f64, limits: &Limits) -> bool {
    let verdict = |times: f64| {
        let each = with_limits(estimates, limits)
            .map(|(_, estimate, limit)| estimate.times_error(times).compare_with(limit));
        Verdict::worst(each)
    };
    let stands = verdict(1.0) == verdict(SURE_ERROR_FACTOR);
    match verdict(1.0) {
        Verdict::Pass => stands && energy_balance_closes(residual),
        Verdict::Fail => stands,
        Verdict::Undecided => false,
    }
}

/// Checks the planned shot of one delay option. `watch` sees the progress and may stop the check.
///
/// # Panics
///
/// If the plan has no delay option with the index `option`.
pub fn check_as_planned(
    case: &Case,
    option: usize,
    compute: &ComputeSettings,
    watch: &mut dyn FnMut(CheckProgress) -> ControlFlow<()>,
) -> Result<CheckedShot, RunError> {
    check_shot(case, &case.shots[option], compute, watch)
}

impl Case {
    /// Checks the planned shot of one delay option. The planned shot alone makes no shot safe: [`Case::judge_options`] also samples
    /// the uncertainty. [`check_as_planned`] is the same with a watcher.
    ///
    /// # Panics
    ///
    /// If the plan has no delay option with the index `option`.
    pub fn check_as_planned(
        &self,
        option: usize,
        compute: &ComputeSettings,
    ) -> Result<CheckedShot, RunError> {
        check_as_planned(self, option, compute, &mut |_| ControlFlow::Continue(()))
    }
}

/// Checks any shot under the shelter of a case.
pub fn check_shot(
    case: &Case,
    shot: &Shot,
    compute: &ComputeSettings,
    watch: &mut dyn FnMut(CheckProgress) -> ControlFlow<()>,
) -> Result<CheckedShot, RunError> {
    let mut runner = Runner { case, compute, watch, runs: 0, steps: 0, begun: Instant::now() };
    run_ladder(
        &mut runner,
        compute.first_step(case),
        compute.step.is_some(),
        |runner, step| runner.run(shot, step),
        |runner, runs, is_last| {
            let without_pairs = checked_from_runs(shot, runs, &[], runner);
            if !is_last && !without_pairs.is_sure {
                return Ok(without_pairs);
            }
            let coarsest = &runs[error_runs(runs.len()).start];
            let pairs = runner.run_pairs(shot, coarsest.outcome.step, is_last)?;
            let Finding { found, is_sure } = checked_from_runs(shot, runs, &pairs, runner);
            // A nearby shot without a result may differ.
            Ok(Finding { found, is_sure: is_sure && pairs.len() == step_error::PAIRS as usize })
        },
    )
}

/// A finished run and its computing time.
struct Run {
    outcome: Outcome,
    cover: Cover,
    wall: Duration,
}

/// Runs shots of a case, and counts the cost.
struct Runner<'r> {
    case: &'r Case,
    compute: &'r ComputeSettings,
    watch: &'r mut dyn FnMut(CheckProgress) -> ControlFlow<()>,
    /// Number of runs so far, and number of their steps.
    runs: usize,
    steps: usize,
    begun: Instant,
}

/// Change of the inputs of nearby shots at the step of the field level and above. At finer steps the change falls with the square
/// of the step, as the error does.
const PAIR_CHANGE: f64 = 1e-3;

impl Runner<'_> {
    /// One run at `step` [s].
    fn run(&mut self, shot: &Shot, step: f64) -> Result<Run, RunError> {
        let settings = self.case.run_settings(self.compute.method, step);
        let begun = Instant::now();
        let mut cover = CoverRecorder::new(self.case, &shot.firings, step);
        let mut look = |motion: &dyn Motion| {
            cover.observe(motion);
            (self.watch)(CheckProgress { runs: self.runs, time: motion.time() })
        };
        let outcome = self.case.model.run(shot, &settings, &mut look)?;
        self.runs += 1;
        self.steps += outcome.steps;
        Ok(Run { outcome, cover: cover.cover(), wall: begun.elapsed() })
    }

    /// Pairs of runs of nearby shots at `step` [s]. A pair with a failed run is left out. But if no finer step follows, the check
    /// then has no result. None of 8,400 runs failed beside the 2,100 scenes of `calibration` at the draft level.
    fn run_pairs(&mut self, shot: &Shot, step: f64, is_last: bool) -> Result<Vec<[Run; 2]>, RunError> {
        let field = ComputeSettings { accuracy: Accuracy::Field, step: None, ..*self.compute };
        let finer =
            step / (field.first_step(self.case) * step_error::RATIO.powi(step_error::NEIGHBOURS as i32));
        let relative = PAIR_CHANGE * finer.powi(2).min(1.0);
        let mut pairs = Vec::new();
        for number in 0..step_error::PAIRS {
            let [more, less] = shot.nearby_pair(self.case.scene().friction, relative, number);
            match self.run(&more, step).and_then(|more| Ok([more, self.run(&less, step)?])) {
                Ok(pair) => pairs.push(pair),
                Err(failure) if is_last || matches!(failure, RunError::Stopped { .. }) => {
                    return Err(failure);
                }
                Err(_) => {}
            }
        }
        Ok(pairs)
    }
}

/// Checks a shot by a ladder of runs and by `pairs` of nearby shots. The last run gives the values. The pairs ran at the step of
/// the coarsest neighbor.
fn checked_from_runs(
    shot: &Shot,
    runs: &[Run],
    pairs: &[[Run; 2]],
    runner: &Runner<'_>,
) -> Finding<CheckedShot> {
    let case = runner.case;
    let last = &runs[runs.len() - 1];
    let outcomes: Vec<&Outcome> = runs.iter().map(|run| &run.outcome).collect();
    let pairs: Vec<[&Outcome; 2]> =
        pairs.iter().map(|pair| pair.each_ref().map(|run| &run.outcome)).collect();
    let estimates = peaks_with_rivals(&outcomes, &pairs);
    let outcome = &last.outcome;
    let mut reasons = find_reasons_as_planned(case, shot, outcome, &estimates, SURE_ERROR_FACTOR);
    let uncovered = count_under_no_tire(case, shot);
    reasons.extend((uncovered > 0).then_some(ShotReason::UnderNoTire(uncovered)));
    let left = last.cover.under_no_tire;
    reasons.extend((left > uncovered).then(|| ShotReason::TiresMovedAway(left - uncovered)));
    let known = with_unknown_errors(shot, outcome, &estimates);
    let is_sure = is_sure(&estimates, outcome.ledger.residual(), &case.limits);
    let found = CheckedShot {
        launch_is_estimated: case.plan.uncertainty.launch_is_estimated(),
        verdict: Verdict::worst(reasons.iter().map(ShotReason::verdict)),
        reasons,
        estimates: known,
        safety_factor: if known.force.error.is_finite() {
            case.limits.breaking_force / known.force.value
        } else {
            f64::NAN
        },
        broken: outcome.broken.clone(),
        history: outcome.history.clone(),
        cover: last.cover,
        compute: *runner.compute,
        step: outcome.step,
        steps: outcome.steps,
        energy_residual: outcome.ledger.residual(),
        end: outcome.end,
        wall: last.wall,
        total_wall: runner.begun.elapsed(),
        runs: runner.runs,
        total_steps: runner.steps,
    };
    Finding { found, is_sure }
}
