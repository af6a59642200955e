//! Words and numbers for people and scripts: pure functions from study results to text, JSON and CSV.
//!
//! Serialisable mirrors of the results live here, so that nothing below knows of formats. Field names are those that
//! scripts depend on.

pub mod accuracy;
pub mod ascii;
#[cfg(feature = "page")]
pub mod chart;
pub mod check;
#[cfg(feature = "page")]
pub mod html;
mod label;
pub mod model;
pub mod no_result;
pub mod orders;
pub mod palette;
pub mod ropes;
pub mod scatter;
pub mod size;
pub mod spark;
pub mod sweep;
pub mod table;
pub mod trace;

use serde::Serialize;

use crate::study::Case;
use crate::study::Envelope;
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// A JSON document with a line end.
pub fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).unwrap_or_else(|error| format!("\"{error}\""));
    text.push('\n');
    text
}

/// A CSV table; the header is the fields' names.
pub fn csv<T: Serialize>(rows: impl IntoIterator<Item = T>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        if let Err(error) = writer.serialize(row) {
            return format!("{error}\n");
        }
    }
    writer.into_inner().map_or_else(|error| error.to_string(), |bytes| String::from_utf8_lossy(&bytes).into())
}

/// Limits of a plan, for JSON.
#[derive(Serialize)]
struct Limits {
    flight_height_m: f64,
    cable_force_n: f64,
    cable_safety_factor: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift_m: Option<f64>,
}

impl Limits {
    fn new(case: &Case) -> Self {
        Self {
            flight_height_m: case.limits.height,
            cable_force_n: case.limits.force,
            cable_safety_factor: case.plan.limits.cable_safety_factor,
            drift_m: case.limits.drift,
        }
    }
}

/// What a study keeps of a shot, for JSON and CSV.
#[derive(Clone, Serialize)]
struct Values {
    flight_height_m: f64,
    flight_height_error_m: f64,
    cable_force_n: f64,
    cable_force_error_n: f64,
    verdict: Verdict,
}

impl Values {
    fn new(envelope: &Envelope) -> Self {
        Self {
            flight_height_m: envelope.height.value,
            flight_height_error_m: envelope.height.error,
            cable_force_n: envelope.force.value,
            cable_force_error_n: envelope.force.error,
            verdict: envelope.verdict,
        }
    }
}

/// Names of blast rows.
fn row_names(case: &Case, rows: &[usize]) -> Vec<String> {
    rows.iter().map(|&row| case.plan.blast_rows[row].name.clone()).collect()
}

/// Plan, size and limits, above every text.
fn heading(case: &Case) -> String {
    let (plan, scene) = (&case.plan, case.scene());
    let mut text = format!(
        "{} · {}\n{} tires, {} cables · limits: height {} m, cable force {} kN (breaking force {} kN / {})",
        case.title(),
        case.source.path,
        scene.mass.len(),
        scene.cables.len(),
        units::value(case.limits.height, Unit::Metre),
        units::value(case.limits.force, Unit::Kilonewton),
        units::value(case.limits.breaking_force, Unit::Kilonewton),
        plan.limits.cable_safety_factor,
    );
    if let Some(drift) = case.limits.drift {
        text += &format!(", drift {} m", units::value(drift, Unit::Metre));
    }
    if let Some(duration) = plan.simulation.duration_s {
        text += &format!(" · followed for {duration} s at most");
    }
    text + "\n\n"
}
