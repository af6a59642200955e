//! The results of `check` as JSON and CSV; schema `shelter.check/1`.

use serde::Serialize;
use serde_json::Number;

use super::no_result;
use crate::outcome::Broken;
use crate::scene::{Scene, TireId, fire_at_s};
use crate::study::check::{Checked, EarlyEnd, Quantity, Reason};
use crate::study::plans::{Results, verdict};
use crate::study::{Case, ComputeSettings, NoResult};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::{Estimate, Verdict};

/// The address of a tire: whole numbers but for the centres of a quincunx.
fn address(tire: &TireId) -> Vec<Number> {
    let number = |n: f64| {
        if n.fract() == 0.0 { Some(Number::from(n as i64)) } else { Number::from_f64(n) }
    };
    tire.numbers().into_iter().filter_map(number).collect()
}

/// Why an option did not pass, in words.
pub fn explain(reason: &Reason) -> String {
    let (quantity, verdict, estimate, limit) = match reason {
        Reason::Limit { quantity, verdict, estimate, limit } => (quantity, verdict, estimate, limit),
        Reason::Broken(1) => return "a cable breaks".to_owned(),
        Reason::Broken(count) => return format!("{count} cables break"),
        Reason::EndsEarly { end, open } => return ends_early(*end, *open),
    };
    let (name, unit) = match quantity {
        Quantity::Height => ("flight height", Unit::Metre),
        Quantity::Force => ("cable force", Unit::Kilonewton),
        Quantity::Drift => ("drift", Unit::Metre),
    };
    let value = value_and_error(estimate.value, estimate.error, unit);
    let (limit, symbol) = (units::exact(*limit, unit), unit.symbol());
    match verdict {
        Verdict::Fail => format!("{name} {value} {symbol} is over the limit of {limit} {symbol}"),
        _ => format!("{name} {value} {symbol} is too near the limit of {limit} {symbol} to tell"),
    }
}

/// That a run ends too early, in words.
fn ends_early(end: f64, open: EarlyEnd) -> String {
    let end = units::seconds(end);
    match open {
        EarlyEnd::HolesUnfired(last) => {
            format!(
                "the run ends at {end}, before the last hole fires at {}: give a longer duration_s",
                units::seconds(last)
            )
        }
        EarlyEnd::TiresInAir => {
            format!("the run ends at {end} with tires in the air: give a longer duration_s, or none")
        }
        EarlyEnd::ForceGrowing => {
            format!("the run ends at {end} with force at its greatest: give a longer duration_s, or none")
        }
        EarlyEnd::TiresMoving => {
            format!(
                "tires still move at {end}, and their drift has a limit: give a longer duration_s, or none"
            )
        }
    }
}

/// How results were asked for: `verlet, field` or `verlet, step 1 ms`.
pub fn compute_label(compute: &ComputeSettings) -> String {
    let method = compute.method.name();
    match compute.step {
        Some(step) => format!("{method}, step {}", units::milliseconds(step)),
        None => format!("{method}, {}", compute.accuracy.name()),
    }
}

/// Where and when height and force were greatest.
pub fn peak(scene: &Scene, checked: &Checked) -> [String; 2] {
    let Checked { height, force, .. } = checked;
    let lifted = format!("tire {}, {}", scene.tire[height.index], units::seconds(height.at));
    let pulled = format!("cable {}, {}", scene.cable_name(force.index), units::seconds(force.at));
    [
        if height.value > 0.0 { lifted } else { "no tire lifts".to_owned() },
        if force.value > 0.0 { pulled } else { "no cable pulls".to_owned() },
    ]
}

/// Broken cables told one by one.
const BROKEN: usize = 4;

/// The cables that broke, the first ones by name.
pub fn broken(scene: &Scene, checked: &Checked) -> String {
    let name =
        |broken: &Broken| format!("{} at {}", scene.cable_name(broken.cable), units::seconds(broken.at));
    let names: Vec<String> = checked.broken.iter().take(BROKEN).map(name).collect();
    let more = checked.broken.len().saturating_sub(BROKEN);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("broken: {}{rest}", names.join(", "))
}

/// A path as a shell takes it; one of standard input by a word in its place.
fn quoted(path: &str) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "/._-+".contains(letter);
    match path {
        "-" => "PLAN".to_owned(),
        _ if path.starts_with('-') => quoted(&format!("./{path}")),
        _ if path.chars().all(plain) => path.to_owned(),
        _ => format!("'{}'", path.replace('\'', "'\\''")),
    }
}

/// The command that gives these results.
pub fn command(case: &Case, results: &Results) -> String {
    let mut command = format!("shelter check {}", quoted(&case.source.path));
    let (asked, of_plan) =
        (results.iter().flatten().next().map(|c| c.compute), ComputeSettings::of(&case.plan));
    if let Some(ComputeSettings { method, accuracy, step }) = asked.filter(|asked| *asked != of_plan) {
        command += &format!(" --method {} --accuracy {}", method.name(), accuracy.name());
        if let Some(step) = step {
            command += &format!(" --dt {step}");
        }
    }
    command
}

/// The document of one plan.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    scene: SceneSize,
    limits: super::Limits,
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
    values: Option<Values>,
}

#[derive(Serialize)]
struct Values {
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

impl Values {
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

impl Document {
    /// The results of one plan.
    pub fn new(case: &Case, results: &Results, any: bool) -> Self {
        let (plan, scene) = (&case.plan, case.scene());
        let method =
            results.iter().flatten().next().map_or(plan.simulation.method, |checked| checked.compute.method);
        let options = plan.delays.iter().zip(results).map(|(delay, result)| OptionResult {
            name: delay.name.clone(),
            fire_at_s: fire_at_s(&delay.timing),
            verdict: result.as_ref().map_or(Verdict::Undecided, |c| c.verdict).name(),
            reasons: match result {
                Ok(checked) => checked.reasons.iter().map(explain).collect(),
                Err(reason) => vec![no_result::message(reason)],
            },
            values: result.as_ref().ok().map(|checked| Values::new(scene, checked)),
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
            limits: super::Limits::new(case),
            options: options.collect(),
        }
    }
}

/// One option of one plan as a CSV row; empty cells where it has no result.
#[derive(Default, Serialize)]
pub struct Row {
    plan: String,
    option: String,
    verdict: &'static str,
    flight_height_m: Option<f64>,
    flight_height_error_m: Option<f64>,
    flight_height_at_s: Option<f64>,
    flight_height_tire: String,
    cable_force_n: Option<f64>,
    cable_force_error_n: Option<f64>,
    cable_force_at_s: Option<f64>,
    cable_force_cable: String,
    cable_safety_factor: Option<f64>,
    drift_m: Option<f64>,
    drift_error_m: Option<f64>,
    broken_cables: Option<usize>,
    dt_s: Option<f64>,
    energy_residual: Option<f64>,
    reasons: String,
}

impl Row {
    /// The rows of one plan.
    pub fn of(case: &Case, results: &Results) -> Vec<Self> {
        let scene = case.scene();
        let row = |(delay, result): (&crate::plan::DelayOption, &Result<Checked, NoResult>)| {
            let (plan, option) = (case.source.path.clone(), delay.name.clone());
            match result {
                Err(reason) => Self {
                    plan,
                    option,
                    verdict: Verdict::Undecided.name(),
                    reasons: no_result::message(reason),
                    ..Self::default()
                },
                Ok(checked) => Self {
                    plan,
                    option,
                    verdict: checked.verdict.name(),
                    flight_height_m: Some(checked.height.value),
                    flight_height_error_m: Some(checked.height.error),
                    flight_height_at_s: Some(checked.height.at),
                    flight_height_tire: scene.tire[checked.height.index].to_string(),
                    cable_force_n: Some(checked.force.value),
                    cable_force_error_n: Some(checked.force.error),
                    cable_force_at_s: Some(checked.force.at),
                    cable_force_cable: scene.cable_name(checked.force.index),
                    cable_safety_factor: Some(checked.safety_factor).filter(|factor| factor.is_finite()),
                    drift_m: Some(checked.drift.value),
                    drift_error_m: Some(checked.drift.error),
                    broken_cables: Some(checked.broken.len()),
                    dt_s: Some(checked.step),
                    energy_residual: Some(checked.energy_residual),
                    reasons: checked.reasons.iter().map(explain).collect::<Vec<_>>().join("; "),
                },
            }
        };
        case.plan.delays.iter().zip(results).map(row).collect()
    }
}
