//! Schema `shelter.accuracy/1`.

use serde::Serialize;

use crate::choice::Method;
use crate::study::Case;
use crate::study::accuracy::{AccuracyTable, StepRow};

/// The document of one option.
#[derive(Serialize)]
pub struct AccuracyDocument {
    schema: &'static str,
    plan: String,
    option: String,
    rows: Vec<StepResult>,
    reference: MethodAndStep,
    recommended: Recommended,
}

/// One method at one step.
#[derive(Serialize)]
struct StepResult {
    method: &'static str,
    dt_s: f64,
    steps: Option<usize>,
    stable: bool,
    flight_height_m: Option<f64>,
    cable_force_n: Option<f64>,
    drift_m: Option<f64>,
    height_error: Option<f64>,
    force_error: Option<f64>,
    drift_error: Option<f64>,
    energy_residual: Option<f64>,
    wall_s: Option<f64>,
}

#[derive(Serialize)]
struct MethodAndStep {
    method: &'static str,
    dt_s: f64,
}

#[derive(Serialize)]
struct Recommended {
    draft: MethodAndStep,
    field: MethodAndStep,
    reference: MethodAndStep,
}

impl StepResult {
    fn of(row: &StepRow) -> Self {
        let result = row.result.as_ref();
        Self {
            method: row.method.name(),
            dt_s: row.step,
            steps: result.map(|m| m.steps),
            stable: result.is_some(),
            flight_height_m: result.map(|m| m.height),
            cable_force_n: result.map(|m| m.force),
            drift_m: result.map(|m| m.drift),
            height_error: result.map(|m| m.height_error),
            force_error: result.map(|m| m.force_error),
            drift_error: result.map(|m| m.drift_error),
            energy_residual: result.map(|m| m.energy_residual),
            wall_s: result.map(|m| m.wall.as_secs_f64()),
        }
    }
}

impl AccuracyDocument {
    /// The document of a study.
    pub fn new(case: &Case, study: &AccuracyTable) -> Self {
        let choice = |dt_s| MethodAndStep { method: Method::Verlet.name(), dt_s };
        let [draft, field, reference] = study.levels.map(|level| choice(level.step));
        Self {
            schema: "shelter.accuracy/1",
            plan: case.source.path.clone(),
            option: case.plan.delays[study.option].name.clone(),
            rows: study.rows.iter().map(StepResult::of).collect(),
            reference: choice(study.reference_step),
            recommended: Recommended { draft, field, reference },
        }
    }
}
