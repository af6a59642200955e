//! JSON documents: serialisable mirrors of results, with the field names that scripts depend on.

mod accuracy;
mod assumptions;
mod check;
mod effects;
mod fit;
mod orders;
mod remedies;
mod risk;
mod ropes;
mod search;
mod size;
mod sweep;
mod trace;

use std::io;

use serde::Serialize;

pub use self::accuracy::AccuracyDocument;
pub use self::assumptions::AssumptionsDocument;
pub use self::check::CheckDocument;
pub use self::effects::EffectsDocument;
pub use self::fit::FitDocument;
pub use self::orders::OrdersDocument;
pub use self::risk::RiskDocument;
pub use self::ropes::RopesDocument;
pub use self::search::SearchDocument;
pub use self::size::SizeDocument;
pub use self::sweep::SweepDocument;
pub use self::trace::TraceDocument;
use crate::study::judgement::Evidence;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, ShotSummary};
use crate::verdict::Verdict;

/// A document with a line end.
pub fn text(document: &impl Serialize) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// Limits of a plan.
#[derive(Serialize)]
struct LimitsObject {
    flight_height_m: f64,
    cable_force_n: f64,
    cable_safety_factor: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    drift_m: Option<f64>,
}

impl LimitsObject {
    fn of(case: &Case) -> Self {
        Self {
            flight_height_m: case.limits.height,
            cable_force_n: case.limits.force,
            cable_safety_factor: case.plan.limits.cable_safety_factor,
            drift_m: case.limits.drift,
        }
    }
}

/// A verdict, and the greatest values of the shot as planned.
#[derive(Serialize)]
struct Values {
    flight_height_m: f64,
    flight_height_error_m: f64,
    cable_force_n: f64,
    cable_force_error_n: f64,
    verdict: Verdict,
}

impl Values {
    fn of(verdict: Verdict, judged: &ShotSummary) -> Self {
        Self {
            flight_height_m: judged.height.value,
            flight_height_error_m: judged.height.error,
            cable_force_n: judged.force.value,
            cable_force_error_n: judged.force.error,
            verdict,
        }
    }
}

/// Failure probability of a shot of a study; null where no sample was drawn.
#[derive(Serialize)]
struct SampledValues {
    nominal_verdict: Verdict,
    samples: usize,
    probability: Option<f64>,
    interval_95: Option<[f64; 2]>,
}

impl SampledValues {
    fn of(nominal_verdict: Verdict, risk: Option<&RiskSummary>) -> Self {
        let drawn = risk.map(|risk| risk.bounds);
        Self {
            nominal_verdict,
            samples: drawn.map_or(0, |drawn| drawn.samples),
            probability: drawn.and_then(|drawn| drawn.probability()),
            interval_95: drawn.map(|drawn| drawn.interval),
        }
    }
}

/// Bounds of the failure probability, and the samples behind them.
#[derive(Serialize)]
struct Failures {
    #[serde(flatten)]
    bounds: Bounds,
    samples: usize,
    undecided: usize,
}

impl Failures {
    /// What the samples tell: where none was drawn, a share from 0 to 1. `None` where none were asked for.
    fn of(sampled: &Evidence<SampledShot>) -> Option<Self> {
        let [interval, _] = intervals(sampled)?;
        let counts = sampled.known().map(|SampledShot { bounds, .. }| (bounds.samples, bounds.undecided));
        let (samples, undecided) = counts.unwrap_or_default();
        Some(Self { bounds: interval.into(), samples, undecided })
    }
}

/// Bounds of the share of possible shots that fail, and of those in which a cable breaks; `None` where none were asked for.
fn intervals(sampled: &Evidence<SampledShot>) -> Option<[[f64; 2]; 2]> {
    match sampled {
        Evidence::NotAsked => None,
        Evidence::NoneDrawn => Some([[0.0, 1.0]; 2]),
        Evidence::Known(sampled) => Some([sampled.bounds.interval, sampled.breaks.interval]),
    }
}

#[derive(Serialize)]
struct Bounds {
    low: f64,
    high: f64,
}

impl From<[f64; 2]> for Bounds {
    fn from([low, high]: [f64; 2]) -> Self {
        Self { low, high }
    }
}
