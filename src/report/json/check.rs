//! Schema `shelter.check/1`.

use serde::Serialize;
use serde_json::Number;

use super::Limits;
use crate::outcome::Broken;
use crate::report::{explain, no_result};
use crate::scene::{Scene, TireId, fire_at_s};
use crate::study::Case;
use crate::study::check::Checked;
use crate::study::check_all::{Results, verdict};
use crate::verdict::{Estimate, Verdict};

/// The document of one plan.
#[derive(Serialize)]
pub struct CheckDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    scene: SceneSize,
    limits: Limits,
    options: Vec<OptionResult>,
}

#[derive(Serialize)]
struct SceneSize {
    tires: usize,
    cables: usize,
    modelled_tires: usize,
}

#[derive(Serialize)]
struct OptionResult {
    name: String,
    fire_at_s: Vec<f64>,
    verdict: &'static str,
    reasons: Vec<String>,
    #[serde(flatten)]
    values: Option<OptionValues>,
}

#[derive(Serialize)]
struct OptionValues {
    flight_height_m: AtTire,
    cable_force_n: AtCable,
    cable_safety_factor: Option<f64>,
    drift_m: AtTire,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    broken: Vec<BrokenCable>,
    method: &'static str,
    dt_s: f64,
    steps: usize,
    energy_residual: f64,
    wall_s: f64,
    total_wall_s: f64,
    runs: usize,
}

#[derive(Serialize)]
struct AtTire {
    value: f64,
    error: f64,
    at_s: f64,
    tire: Vec<Number>,
}

#[derive(Serialize)]
struct AtCable {
    value: f64,
    error: f64,
    at_s: f64,
    cable: Option<[Vec<Number>; 2]>,
}

/// A cable that broke.
#[derive(Serialize)]
struct BrokenCable {
    cable: [Vec<Number>; 2],
    at_s: f64,
}

impl BrokenCable {
    fn new(scene: &Scene, broken: &Broken) -> Self {
        let ends = scene.cables[broken.cable].ends;
        Self { cable: ends.map(|end| address(&scene.tire[end])), at_s: broken.at }
    }
}

impl AtTire {
    fn new(scene: &Scene, estimate: &Estimate) -> Self {
        let Estimate { value, error, at, index } = *estimate;
        Self { value, error, at_s: at, tire: scene.tire.get(index).map(address).unwrap_or_default() }
    }
}

impl AtCable {
    fn new(scene: &Scene, estimate: &Estimate) -> Self {
        let Estimate { value, error, at, index } = *estimate;
        let ends = |cable: &crate::scene::Cable| cable.ends.map(|end| address(&scene.tire[end]));
        Self { value, error, at_s: at, cable: scene.cables.get(index).map(ends) }
    }
}

impl OptionValues {
    fn new(scene: &Scene, checked: &Checked) -> Self {
        Self {
            flight_height_m: AtTire::new(scene, &checked.height),
            cable_force_n: AtCable::new(scene, &checked.force),
            cable_safety_factor: Some(checked.safety_factor).filter(|factor| factor.is_finite()),
            drift_m: AtTire::new(scene, &checked.drift),
            broken: checked.broken.iter().map(|broken| BrokenCable::new(scene, broken)).collect(),
            method: checked.compute.method.name(),
            dt_s: checked.step,
            steps: checked.steps,
            energy_residual: checked.energy_residual,
            wall_s: checked.wall.as_secs_f64(),
            total_wall_s: checked.total_wall.as_secs_f64(),
            runs: checked.runs,
        }
    }
}

impl CheckDocument {
    /// The document of the results of one plan; with `any` one passing option is enough.
    pub fn new(case: &Case, results: &Results, any: bool) -> Self {
        let (plan, scene) = (&case.plan, case.scene());
        let method =
            results.iter().flatten().next().map_or(plan.simulation.method, |checked| checked.compute.method);
        let options = plan.delays.iter().zip(results).map(|(delay, result)| OptionResult {
            name: delay.name.clone(),
            fire_at_s: fire_at_s(&delay.timing),
            verdict: result.as_ref().map_or(Verdict::Undecided, |c| c.verdict).name(),
            reasons: match result {
                Ok(checked) => checked.reasons.iter().map(explain::reason).collect(),
                Err(reason) => vec![no_result::message(reason)],
            },
            values: result.as_ref().ok().map(|checked| OptionValues::new(scene, checked)),
        });
        Self {
            schema: "shelter.check/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: verdict(results, any).name(),
            scene: SceneSize {
                tires: scene.mass.len(),
                cables: scene.cables.len(),
                modelled_tires: case.modelled_tires(method),
            },
            limits: Limits::of(case),
            options: options.collect(),
        }
    }
}

/// The address of a tire: whole numbers but for the centres of a quincunx.
fn address(tire: &TireId) -> Vec<Number> {
    let number = |n: f64| {
        if n.fract() == 0.0 { Some(Number::from(n as i64)) } else { Number::from_f64(n) }
    };
    tire.numbers().into_iter().filter_map(number).collect()
}
