//! Error and computing time against the step, for both methods, on this plan and this machine.
//!
//! The errors are differences from a converged run.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::{Case, ComputeSettings, Finding, Found, NoResult, Progress, step_error};
use crate::choice::{Accuracy, Method};
use crate::outcome::Outcome;
use crate::plan::Timing;
use crate::scene::Shot;
use crate::simulation::Settings;

/// One method at one step.
#[derive(Clone, Debug)]
pub struct StepRow {
    /// Time integration method.
    pub method: Method,
    /// Step [s].
    pub step: f64,
    /// Result; `None` where the method is not stable at this step.
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
    /// Step of the converged run [s]; its method is `verlet`.
    pub reference_step: f64,
    /// Accuracy levels, each with its first step [s].
    pub levels: [(Accuracy, f64); 3],
}

/// Classes of accuracy: greatest relative error of height and of force.
pub const CLASSES: [(f64, f64); 2] = [(0.01, 0.02), (0.002, 0.002)];

/// Number of steps tried per method; each step is [`step_error::RATIO`] times shorter than the one before.
const STEPS: i32 = 15;
/// First step of the finest accuracy level over the step of the converged run.
const FINER: f64 = 16.0;

/// Measures one option. A run that is expected to take longer than `patience` is left out.
pub fn measure(
    case: &Case,
    option: usize,
    patience: Duration,
    progress: &Progress,
) -> Finding<AccuracyTable> {
    let levels =
        [Accuracy::Draft, Accuracy::Field, Accuracy::Reference].map(|level| (level, first_step(case, level)));
    let reference_step = levels[2].1 / FINER;
    let shot = &case.shots[option];
    progress.expect(2 * STEPS as usize + levels.len() + 1);
    let reference = run(case, shot, Method::Verlet, reference_step, progress)?;
    progress.advance();
    let coarsest = (0.95 * case.scene().critical_step()).min(8e-3);
    let (mut rows, mut partial) = (Vec::new(), false);
    for method in [Method::Verlet, Method::Newmark] {
        let mut steps: Vec<f64> = (0..STEPS).map(|n| coarsest * step_error::RATIO.powi(-n)).collect();
        if method == Method::Verlet {
            // A step of a level takes the place of one that differs by rounding alone.
            steps.retain(|step| levels.iter().all(|(_, level)| (step / level - 1.0).abs() > 1e-9));
            steps.extend(levels.map(|(_, step)| step));
            steps.sort_by(|a, b| b.total_cmp(a));
            steps.dedup();
        }
        let mut last = Duration::ZERO;
        for step in steps.into_iter().take_while(|&step| step > reference_step) {
            if 2 * last > patience {
                break;
            }
            let result = match run(case, shot, method, step, progress) {
                Err(NoResult::OutOfTime) => {
                    partial = true;
                    break;
                }
                // The method lacks an effect of the plan: it has no rows.
                Err(NoResult::Failed(_)) => break,
                result => result?,
            };
            progress.advance();
            last = result.as_ref().map_or(last, |(_, wall)| *wall);
            let result = result.map(|(outcome, wall)| compared(&outcome, wall, reference.as_ref()));
            rows.push(StepRow { method, step, result });
        }
    }
    Ok(Found { value: AccuracyTable { option, rows, reference_step, levels }, partial })
}

/// Step at which refinement starts at an accuracy level, by `verlet` [s].
fn first_step(case: &Case, accuracy: Accuracy) -> f64 {
    ComputeSettings { method: Method::Verlet, accuracy, step: None }.first_step(case)
}

impl AccuracyTable {
    /// The longest step of a method at which this step and all shorter steps are within a class; with its computing time.
    pub fn cheapest(&self, method: Method, class: (f64, f64)) -> Option<(f64, Duration)> {
        let within = |row: &&StepRow| {
            let good = |m: &Measured| m.height_error <= class.0 && m.force_error <= class.1;
            row.result.as_ref().is_some_and(good)
        };
        let rows = self.rows.iter().filter(|row| row.method == method).rev().take_while(within);
        rows.last().and_then(|row| Some((row.step, row.result?.wall)))
    }
}

/// Runs a shot; short runs are repeated, so that their least time means something. `None` where the method is not stable.
fn run(
    case: &Case,
    shot: &Shot,
    method: Method,
    step: f64,
    progress: &Progress,
) -> Result<Option<(Outcome, Duration)>, NoResult> {
    let settings = case.settings(method, step);
    let mut best: Option<(Outcome, Duration)> = None;
    let begun = Instant::now();
    for _ in 0..5 {
        let start = Instant::now();
        let outcome = match case.model.run(shot, &settings, &mut |_| progress.flow()) {
            Ok(outcome) => outcome,
            Err(failure) if failure.needs_finer_step() => return Ok(None),
            Err(failure) => return Err(progress.no_result(failure)),
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
    let error = |value: f64, of: fn(&Outcome) -> f64| {
        let exact = reference.map_or(f64::NAN, |(outcome, _)| of(outcome));
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

/// A row of the source paper's Table 1: step [s], height [m], greatest force and force at 0.16 s [N].
pub type PaperRow = (f64, f64, f64, f64);

/// Table 1 of the source paper as printed; NaN where the table has a dash.
pub const PAPER: [PaperRow; 6] = [
    (5e-4, 0.705, 17_668.0, 9_265.0),
    (2.5e-4, 0.707, 17_687.0, 8_284.0),
    (2e-4, 0.708, 17_704.0, 7_461.0),
    (1e-4, 0.708, 17_704.0, 7_456.0),
    (6.25e-5, 0.708, 17_701.0, 7_521.0),
    (5e-5, f64::NAN, f64::NAN, 7_452.0),
];

/// Table 1 computed by `method`, where the plan is the shelter of the paper: five tires of 280 kg over one hole.
pub fn paper_table(case: &Case, method: Method) -> Option<Vec<PaperRow>> {
    let scene = case.scene();
    let single =
        matches!(case.plan.delays.as_slice(), [delay] if matches!(delay.timing, Timing::Interval { .. }));
    let centre = case.shots.first()?.firings.first()?.tire;
    let [5, 8] = [scene.mass.len(), scene.cables.len()] else { return None };
    if !single || case.shots[0].firings.len() != 1 || scene.mass[0] != 280.0 || scene.friction != 0.5 {
        return None;
    }
    let diagonal = scene.cables.iter().position(|cable| cable.ends.contains(&centre))?;
    PAPER
        .iter()
        .map(|row| row.0)
        .map(|step| {
            let settings = Settings { method, step, duration: Some(1.0) };
            let (mut late, mut before) = (f64::NAN, (0.0, 0.0));
            let outcome = case.model.run(&case.shots[0], &settings, &mut |motion| {
                let now = (motion.time(), motion.force(diagonal));
                if before.0 < 0.16 && now.0 >= 0.16 - 1e-12 {
                    let part = ((0.16 - before.0) / (now.0 - before.0)).clamp(0.0, 1.0);
                    late = before.1 + part * (now.1 - before.1);
                }
                before = now;
                ControlFlow::Continue(())
            });
            outcome.ok().map(|outcome| (step, outcome.height.value, outcome.force.value, late))
        })
        .collect()
}
