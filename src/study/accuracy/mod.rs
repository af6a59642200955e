//! Error and computing time over the step, for both methods, on this plan and this machine.
//!
//! The errors are differences from a converged run.

pub mod paper_table;

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use self::paper_table::{PaperRow, paper_table};
use super::as_planned::check::SURE_ERROR_FACTOR;
use super::as_planned::step_error;
use super::study_trait::{Study, Subject};
use super::{Case, ComputeResult, ComputeSettings, Computed, Context, NoResult, StudyControl};
use crate::choice::{Accuracy, Method};
use crate::outcome::Outcome;
use crate::scene::Shot;
use crate::verdict::{Limits, Quantity};

/// One method at one step.
#[derive(Clone, Debug)]
pub struct StepRow {
    /// Time integration method.
    pub method: Method,
    /// Step [s].
    pub step: f64,
    /// Result; `None` if the method is not stable at this step.
    pub result: Option<Measured>,
}

/// Result and cost of a run.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Number of steps.
    pub steps: usize,
    /// Greatest height [m].
    pub height: f64,
    /// Greatest cable force [N].
    pub force: f64,
    /// Greatest drift at the end [m].
    pub drift: f64,
    /// |height − reference| / reference.
    pub height_error: f64,
    /// |force − reference| / reference.
    pub force_error: f64,
    /// |drift − reference| / reference.
    pub drift_error: f64,
    /// Ledger residual over the energy put in.
    pub energy_residual: f64,
    /// Least computing time of a few runs.
    pub wall: Duration,
}

/// Speed against accuracy of one option.
#[derive(Clone, Debug)]
pub struct AccuracyTable {
    /// Index of the delay option.
    pub option: usize,
    /// Rows of both methods, each from the longest step to the shortest.
    pub rows: Vec<StepRow>,
    /// Step of the converged run [s]. The method of that run is `verlet`.
    pub reference_step: f64,
    /// Table 1 of the paper, computed by each method; empty if it was not requested, or if the plan is another.
    pub paper: Vec<(Method, Vec<PaperRow>)>,
    /// The accuracy levels, the coarsest first.
    pub levels: [LevelStep; 3],
}

/// An accuracy level and its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelStep {
    /// The level.
    pub level: Accuracy,
    /// Step at which refinement starts [s].
    pub step: f64,
}

/// A class of accuracy: its greatest relative errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorClass {
    /// Greatest relative error of the height.
    pub height: f64,
    /// Greatest relative error of the force.
    pub force: f64,
}

/// The quantity of a run that is hardest to judge against its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestLimit {
    /// Error over value.
    pub error: f64,
    /// Limit minus value, over the value; negative if the value exceeds the limit.
    pub margin: f64,
    /// Whether the run exceeds this or another limit.
    pub is_exceeded: bool,
}

impl NearestLimit {
    /// Whether the limit is so far away that a check needs no finer run.
    pub fn is_enough(&self) -> bool {
        SURE_ERROR_FACTOR * self.error < self.margin.abs()
    }
}

/// The classes of accuracy, the coarser first.
pub const CLASSES: [ErrorClass; 2] =
    [ErrorClass { height: 0.01, force: 0.02 }, ErrorClass { height: 0.002, force: 0.002 }];

/// Number of steps tried per method; each step is [`step_error::RATIO`] times shorter than the one before.
const STEPS: i32 = 15;
/// First step of the finest accuracy level over the step of the converged run.
const REFERENCE_STEP_DIVISOR: f64 = 16.0;

/// Longest computing time of a run, unless the user asks for longer runs.
const PATIENCE: Duration = Duration::from_secs(1);

/// The cost of accuracy, measured on one option.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Index of the option.
    pub option: usize,
    /// Runs that are expected to take longer are left out.
    pub patience: Duration,
    /// Whether Table 1 of the paper is computed, too, if the plan is its shelter.
    pub with_paper_table: bool,
}

impl Study for Question {
    type Found = AccuracyTable;

    fn usual(_case: &Case, about: Subject) -> Self {
        Self { option: about.option, patience: PATIENCE, with_paper_table: false }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<AccuracyTable> {
        let mut measured = measure(context, self.option, self.patience)?;
        if self.with_paper_table {
            let methods = [Method::Verlet, Method::Newmark].into_iter();
            let table = |method| Some((method, paper_table(context.case, method)?));
            measured.value.paper = methods.filter_map(table).collect();
        }
        Ok(measured)
    }
}

/// Measures one option. A run that is expected to take longer than `patience` is left out.
pub fn measure(context: &Context<'_>, option: usize, patience: Duration) -> ComputeResult<AccuracyTable> {
    let &Context { case, control, .. } = context;
    let levels = [Accuracy::Draft, Accuracy::Field, Accuracy::Reference]
        .map(|level| LevelStep { level, step: first_step(case, level) });
    let reference_step = levels[2].step / REFERENCE_STEP_DIVISOR;
    let shot = &case.shots[option];
    control.announce(2 * STEPS as usize + levels.len() + 1);
    let reference = run(case, shot, Method::Verlet, reference_step, control)?;
    control.advance();
    let coarsest = (0.95 * case.scene().critical_step()).min(8e-3);
    let (mut rows, mut partial) = (Vec::new(), false);
    for method in [Method::Verlet, Method::Newmark] {
        let mut steps: Vec<f64> = (0..STEPS).map(|n| coarsest * step_error::RATIO.powi(-n)).collect();
        if method == Method::Verlet {
            // A step of a level replaces a step that differs only by rounding.
            steps.retain(|step| levels.iter().all(|level| (step / level.step - 1.0).abs() > 1e-9));
            steps.extend(levels.map(|level| level.step));
            steps.sort_by(f64::total_cmp);
            steps.reverse();
            steps.dedup();
        }
        let mut last = Duration::ZERO;
        for step in steps.into_iter().take_while(|&step| step > reference_step) {
            if 2 * last > patience {
                break;
            }
            let result = match run(case, shot, method, step, control) {
                Err(NoResult::OutOfTime) => {
                    partial = true;
                    break;
                }
                // The method lacks an effect of the plan, so it has no rows.
                Err(NoResult::Failed(_)) => break,
                result => result?,
            };
            control.advance();
            last = result.as_ref().map_or(last, |(_, wall)| *wall);
            let result = result.map(|(outcome, wall)| compared(&outcome, wall, reference.as_ref()));
            rows.push(StepRow { method, step, result });
        }
    }
    Ok(Computed { value: AccuracyTable { option, rows, reference_step, paper: Vec::new(), levels }, partial })
}

/// Step with `verlet` at which refinement starts at an accuracy level [s].
fn first_step(case: &Case, accuracy: Accuracy) -> f64 {
    ComputeSettings { method: Method::Verlet, accuracy, step: None }.first_step(case)
}

impl AccuracyTable {
    /// The limit that is hardest to decide by the first run at a level; `None` if that run is not stable, or nothing moves.
    pub fn nearest_limit(&self, level: Accuracy, limits: &Limits) -> Option<NearestLimit> {
        let step = self.levels.iter().find(|row| row.level == level)?.step;
        let mut rows = self.rows.iter().filter(|row| row.method == Method::Verlet && row.step == step);
        let run = rows.find_map(|row| row.result)?;
        let values = [
            (Quantity::Height, run.height, run.height_error),
            (Quantity::Force, run.force, run.force_error),
            (Quantity::Drift, run.drift, run.drift_error),
        ];
        let from_limit = |(quantity, value, error): (Quantity, f64, f64)| {
            let limit = limits.get(quantity).filter(|_| value > 0.0)?;
            Some(NearestLimit { error, margin: limit / value - 1.0, is_exceeded: false })
        };
        let all: Vec<NearestLimit> = values.into_iter().filter_map(from_limit).collect();
        let is_exceeded = all.iter().any(|limit| limit.margin < 0.0);
        let room = |limit: &NearestLimit| limit.margin.abs() - SURE_ERROR_FACTOR * limit.error;
        let nearest = all.into_iter().min_by(|a, b| room(a).total_cmp(&room(b)))?;
        Some(NearestLimit { is_exceeded, ..nearest })
    }

    /// The longest step of a method at which this step and all shorter steps are within a class, and its computing time.
    pub fn cheapest(&self, method: Method, class: ErrorClass) -> Option<(f64, Duration)> {
        let within = |row: &&StepRow| {
            let good = |m: &Measured| m.height_error <= class.height && m.force_error <= class.force;
            row.result.as_ref().is_some_and(good)
        };
        let rows = self.rows.iter().filter(|row| row.method == method).rev().take_while(within);
        rows.last().and_then(|row| Some((row.step, row.result?.wall)))
    }
}

/// Runs a shot. Short runs are repeated, so that their least time is meaningful. `None` if the method is not stable.
fn run(
    case: &Case,
    shot: &Shot,
    method: Method,
    step: f64,
    control: &StudyControl,
) -> Result<Option<(Outcome, Duration)>, NoResult> {
    let settings = case.run_settings(method, step);
    let mut best: Option<(Outcome, Duration)> = None;
    let begun = Instant::now();
    for _ in 0..5 {
        let start = Instant::now();
        let outcome = match case.model.run(shot, &settings, &mut |_| control.keep_going()) {
            Ok(outcome) => outcome,
            Err(failure) if failure.needs_finer_step() => return Ok(None),
            Err(failure) => return Err(control.no_result(failure)),
        };
        let wall = start.elapsed();
        if best.as_ref().is_none_or(|(_, least)| wall < *least) {
            best = Some((outcome, wall));
        }
        if begun.elapsed() > Duration::from_millis(200) {
            break;
        }
    }
    Ok(best)
}

fn compared(outcome: &Outcome, wall: Duration, reference: Option<&(Outcome, Duration)>) -> Measured {
    let error = |value: f64, quantity: fn(&Outcome) -> f64| {
        let exact = reference.map_or(f64::NAN, |(outcome, _)| quantity(outcome));
        if exact == value { 0.0 } else { ((value - exact) / exact).abs() }
    };
    Measured {
        steps: outcome.steps,
        height: outcome.height.value,
        force: outcome.force.value,
        drift: outcome.drift.value,
        height_error: error(outcome.height.value, |o| o.height.value),
        force_error: error(outcome.force.value, |o| o.force.value),
        drift_error: error(outcome.drift.value, |o| o.drift.value),
        energy_residual: outcome.ledger.residual(),
        wall,
    }
}
