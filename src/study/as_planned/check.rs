//! The verdict on the shot as planned of one delay option, refined until the verdict is sure.
//!
//! The option is run at a ladder of steps; each step is [`step_error::RATIO`] times finer than the one before. The finest run
//! gives the values. The coarser runs give the errors. While the verdict is open, a finer run is added.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::cover::{Cover, CoverWatch};
use super::peaks::{error_runs, peaks_with_rivals};
use super::step_error;
use crate::choice::Accuracy;
use crate::outcome::{BrokenCable, History, Outcome, RunEnd};
use crate::scene::Shot;
use crate::simulation::{Failure, Motion};
use crate::study::reasons::shot::{ShotReason, closes, find_reasons_as_planned, with_limits};
use crate::study::{Case, ComputeSettings};
use crate::verdict::{Estimate, Limits, Quantity, Verdict};

/// A shot as planned, checked by a ladder of runs.
#[derive(Clone, Debug)]
pub struct CheckedShot {
    /// Pass, fail, or undecided at the finest step allowed.
    pub verdict: Verdict,
    /// Why the verdict is not a pass; empty for a pass.
    pub reasons: Vec<ShotReason>,
    /// Greatest flight height of any tire [m].
    pub height: Estimate,
    /// Greatest force of any cable [N].
    pub force: Estimate,
    /// Greatest drift of any tire at the end [m].
    pub drift: Estimate,
    /// Breaking force over greatest force; infinite where no cable pulls.
    pub safety_factor: f64,
    /// Broken cables in order of time; empty where the plan lets no cable break.
    pub broken: Vec<BrokenCable>,
    /// Height and force over time.
    pub history: History,
    /// The cover over each hole as it fires.
    pub cover: Cover,
    /// Method and accuracy that were asked for.
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

/// Position of a check: finished runs, and simulated time of the present run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckStep {
    /// Number of finished runs.
    pub runs: usize,
    /// Simulated time that the present run has reached [s].
    pub time: f64,
}

/// Greatest number of steps below the first: the finest step is 64 times finer.
const MOST_REFINEMENTS: i32 = 12;

/// Factor on the error with which a verdict must still stand. The error itself holds in 19 of 20 runs; a verdict must hold
/// in more: with a factor of 2, 4 of 4,480 limits near true values were passed or failed wrongly.
pub const SURE_ERROR_FACTOR: f64 = 3.0;

impl CheckedShot {
    /// Height [m], force [N] or drift [m].
    pub fn get(&self, quantity: Quantity) -> Estimate {
        match quantity {
            Quantity::Height => self.height,
            Quantity::Force => self.force,
            Quantity::Drift => self.drift,
        }
    }

    /// The share of its limit that a quantity takes; `None` where it has none.
    pub fn share_of_limit(&self, quantity: Quantity, limits: &Limits) -> Option<f64> {
        Some(self.get(quantity).value / limits.get(quantity)?)
    }

    /// Whether the verdict of the limits would stand with errors [`SURE_ERROR_FACTOR`] times larger, and the energy balance
    /// closes for a pass.
    fn is_sure(&self, limits: &Limits) -> bool {
        let verdict = |times: f64| {
            let larger = |estimate: Estimate| Estimate { error: times * estimate.error, ..estimate };
            let each = with_limits([self.height, self.force, self.drift], limits)
                .map(|(_, estimate, limit)| larger(estimate).judge_against(limit));
            Verdict::worst(each)
        };
        let stands = verdict(1.0) == verdict(SURE_ERROR_FACTOR);
        match verdict(1.0) {
            Verdict::Pass => stands && closes(self.energy_residual),
            Verdict::Fail => stands,
            Verdict::Undecided => false,
        }
    }
}

/// Checks the shot as planned of one delay option. `watch` sees the progress and may stop the check.
///
/// # Panics
///
/// Where the plan has no delay option with the index `option`.
pub fn check_as_planned(
    case: &Case,
    option: usize,
    compute: &ComputeSettings,
    watch: &mut dyn FnMut(CheckStep) -> ControlFlow<()>,
) -> Result<CheckedShot, Failure> {
    check_shot(case, &case.shots[option], compute, watch)
}

impl Case {
    /// Checks the shot as planned of one delay option, which alone makes no shot safe: [`Case::judge_options`] also samples what
    /// the plan does not know. [`check_as_planned`] is the same with a watcher.
    ///
    /// # Panics
    ///
    /// Where the plan has no delay option with the index `option`.
    pub fn check_as_planned(&self, option: usize, compute: &ComputeSettings) -> Result<CheckedShot, Failure> {
        check_as_planned(self, option, compute, &mut |_| ControlFlow::Continue(()))
    }
}

/// Checks any shot under the shelter of a case.
pub fn check_shot(
    case: &Case,
    shot: &Shot,
    compute: &ComputeSettings,
    watch: &mut dyn FnMut(CheckStep) -> ControlFlow<()>,
) -> Result<CheckedShot, Failure> {
    let begun = Instant::now();
    let (done, steps, watch) = (Cell::new(0), Cell::new(0), RefCell::new(watch));
    let run = |shot: &Shot, step: f64| {
        let settings = case.run_settings(compute.method, step);
        let start = Instant::now();
        let mut cover = CoverWatch::new(case, &shot.firings, step);
        let look = |motion: &dyn Motion| {
            cover.observe(motion);
            (watch.borrow_mut())(CheckStep { runs: done.get(), time: motion.time() })
        };
        let outcome = case.model.run(shot, &settings, &mut { look })?;
        done.set(done.get() + 1);
        steps.set(steps.get() + outcome.steps);
        Ok(Run { outcome, cover: cover.cover(), wall: start.elapsed() })
    };
    let mut checked = None;
    climb(
        compute.first_step(case),
        compute.step.is_some(),
        |step| run(shot, step),
        |runs, last| {
            let cost = || Cost { runs: done.get(), steps: steps.get(), wall: begun.elapsed() };
            let mut latest = checked_from_runs(case, shot, compute, runs, &[], cost());
            if last || latest.is_sure(&case.limits) {
                let coarsest = &runs[error_runs(runs.len()).start];
                let pairs = run_pairs(case, shot, compute, coarsest.outcome.step, run)?;
                latest = checked_from_runs(case, shot, compute, runs, &pairs, cost());
            }
            let sure = latest.is_sure(&case.limits);
            checked = Some(latest);
            Ok(sure)
        },
    )?;
    checked.ok_or(Failure::Stopped { at: 0.0 })
}

/// A finished run and its computing time.
struct Run {
    outcome: Outcome,
    cover: Cover,
    wall: Duration,
}

/// What all runs of a check cost so far.
struct Cost {
    runs: usize,
    steps: usize,
    wall: Duration,
}

/// Change of inputs of nearby shots at the step of the field level and above. At finer steps it falls with the square of the
/// step, as the error does.
const PAIR_CHANGE: f64 = 1e-3;

/// Pairs of runs of nearby shots at `step` [s]; without the pairs of which a run fails.
fn run_pairs(
    case: &Case,
    shot: &Shot,
    compute: &ComputeSettings,
    step: f64,
    run: impl Fn(&Shot, f64) -> Result<Run, Failure>,
) -> Result<Vec<[Run; 2]>, Failure> {
    let field = ComputeSettings { accuracy: Accuracy::Field, step: None, ..*compute }.first_step(case);
    let finer = step / (field * step_error::RATIO.powi(step_error::NEIGHBOURS as i32));
    let relative = PAIR_CHANGE * finer.powi(2).min(1.0);
    let mut pairs = Vec::new();
    for number in 0..step_error::PAIRS {
        let [more, less] = shot.both_sides(case.scene().friction, relative, number);
        match run(&more, step).and_then(|more| Ok([more, run(&less, step)?])) {
            Ok(pair) => pairs.push(pair),
            Err(stopped @ Failure::Stopped { .. }) => return Err(stopped),
            Err(_) => {}
        }
    }
    Ok(pairs)
}

/// Runs a ladder of steps, from the coarsest to the finest; no step is run twice.
///
/// 1. The coarser neighbours of `first` are run, then `first`, then finer steps.
/// 2. Once there are two runs, `is_sure` is asked after each. It gets all runs so far, and whether no finer run can follow; the
///    last run gives the values, the others give the errors. The ladder ends when `is_sure` returns true.
/// 3. Where `fixed`, the ladder ends at `first`. If every coarser neighbour failed, one finer run gives the error; it then stands
///    before `first` among the runs, so that the values stay at `first`.
fn climb<R>(
    first: f64,
    fixed: bool,
    mut run: impl FnMut(f64) -> Result<R, Failure>,
    mut is_sure: impl FnMut(&[R], bool) -> Result<bool, Failure>,
) -> Result<(), Failure> {
    let rung = |n: i32| first * step_error::RATIO.powi(n);
    let mut runs = Vec::new();
    for n in (1..=step_error::NEIGHBOURS as i32).rev() {
        match run(rung(n)) {
            Ok(coarser) => runs.push(coarser),
            Err(failure) if failure.needs_finer_step() => {}
            Err(failure) => return Err(failure),
        }
    }
    for finer in 0..=MOST_REFINEMENTS {
        runs.push(run(rung(-finer))?);
        if runs.len() < 2 && fixed {
            // The finer run tells the error; the values stay at the step asked for.
            runs.insert(0, run(rung(-1))?);
        }
        // A single run has no error: its neighbour is the next finer run.
        let last = fixed || finer == MOST_REFINEMENTS;
        if runs.len() >= 2 && (is_sure(&runs, last)? || last) {
            break;
        }
    }
    Ok(())
}

/// Checks a shot by a ladder of runs, of which the last gives the values, and by `pairs` of nearby shots at the step of the
/// coarsest neighbour.
fn checked_from_runs(
    case: &Case,
    shot: &Shot,
    compute: &ComputeSettings,
    runs: &[Run],
    pairs: &[[Run; 2]],
    cost: Cost,
) -> CheckedShot {
    let last = &runs[runs.len() - 1];
    let outcomes: Vec<&Outcome> = runs.iter().map(|run| &run.outcome).collect();
    let pairs: Vec<[&Outcome; 2]> =
        pairs.iter().map(|pair| pair.each_ref().map(|run| &run.outcome)).collect();
    let [height, force, drift] = peaks_with_rivals(&outcomes, &pairs);
    let outcome = &last.outcome;
    let reasons = find_reasons_as_planned(case, shot, outcome, [height, force, drift]);
    CheckedShot {
        verdict: Verdict::worst(reasons.iter().map(ShotReason::verdict)),
        reasons,
        height,
        force,
        drift,
        safety_factor: case.limits.breaking_force / force.value,
        broken: outcome.broken.clone(),
        history: outcome.history.clone(),
        cover: last.cover,
        compute: *compute,
        step: outcome.step,
        steps: outcome.steps,
        energy_residual: outcome.ledger.residual(),
        end: outcome.end,
        wall: last.wall,
        total_wall: cost.wall,
        runs: cost.runs,
        total_steps: cost.steps,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Iteration;

    /// Steps that `climb` asks for where steps above `coarsest` fail, and the step that gives the values.
    fn climbed(coarsest: f64, fixed: bool, sure_at: f64) -> (Vec<f64>, f64) {
        let (mut asked, mut values) = (Vec::new(), f64::NAN);
        let run = |step: f64| {
            asked.push(step);
            let failure = Failure::Unsettled { what: Iteration::ContactRegion, at: 0.0 };
            if step > coarsest { Err(failure) } else { Ok(step) }
        };
        let is_sure = |runs: &[f64], _: bool| {
            values = runs[runs.len() - 1];
            Ok(values <= sure_at)
        };
        climb(1.0, fixed, run, is_sure).expect("fine steps work");
        (asked, values)
    }

    #[test]
    fn no_step_is_run_twice() {
        for coarsest in [4.0, 2.0, 1.0] {
            for fixed in [false, true] {
                for sure_at in [1.0, 0.5, 1e-9] {
                    let (mut asked, _) = climbed(coarsest, fixed, sure_at);
                    let count = asked.len();
                    asked.sort_by(f64::total_cmp);
                    asked.dedup();
                    assert_eq!(asked.len(), count, "{coarsest} {fixed} {sure_at}");
                }
            }
        }
    }

    #[test]
    fn values_come_from_the_step_asked_for_or_from_the_finest() {
        assert_eq!(climbed(4.0, true, 1e-9).1, 1.0);
        assert_eq!(climbed(1.0, true, 1e-9).1, 1.0, "though its only neighbour is finer");
        assert_eq!(climbed(4.0, false, 1.0).1, 1.0);
        assert!(
            (climbed(1.0, false, 1.0).1 * step_error::RATIO - 1.0).abs() < 1e-12,
            "no error without a neighbour"
        );
        assert!((climbed(4.0, false, 0.0).1 * 64.0 - 1.0).abs() < 1e-12, "the finest step allowed");
    }
}
