//! Columns that several reports share.

use super::parts::{Cell, Column, Fact, fact};
use crate::report::language::say;
use crate::study::ValueWithError;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::judge::Judgement;
use crate::study::judge::grounds::Evidence;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sampled_shot::SampledShot;
use crate::units::Unit;
use crate::verdict::Verdict;

/// Verdict: PASS, THIN, HOLD, OPEN or FAIL.
pub const VERDICT: Column = Column::words(&["verdict"], "");
/// Greatest flight height and its error.
pub const HEIGHT: Column =
    Column::numbers(&["flight_height_m", "flight_height_error_m"], "height", Unit::Metre);
/// Greatest cable force and its error.
pub const FORCE: Column =
    Column::numbers(&["cable_force_n", "cable_force_error_n"], "force", Unit::Kilonewton);
/// Bounds of the share of sampled shots that fail.
pub const FAILURES: Column =
    Column::numbers(&["low_95", "high_95"], "fails", Unit::Percent).json(&["interval_95"]);
/// Failures over decided samples.
pub const PROBABILITY: Column = Column::scripts(&["probability"]);
/// Number of samples drawn.
pub const SAMPLES: Column = Column::scripts(&[]).json(&["samples"]);
/// Verdict on the planned shot.
pub const NOMINAL_VERDICT: Column = Column::scripts(&["nominal_verdict"]);
/// Time between successive blast rows.
pub const INTERVAL: Column = Column::numbers(&["interval_s"], "interval", Unit::One);

/// Cell of [`HEIGHT`].
pub fn height(height: ValueWithError) -> Cell {
    Cell::Estimate { value: height.value, error: height.error, unit: Unit::Metre }
}

/// Cell of [`FORCE`].
pub fn force(force: ValueWithError) -> Cell {
    Cell::Estimate { value: force.value, error: force.error, unit: Unit::Kilonewton }
}

/// How much faster than planned the tires may leave, as a share. 0 where the margin is not known or the planned shot does not pass.
/// `None` where nothing fails up to the greatest rise tried, or where only the planned shot was asked for and passes.
pub fn launch_margin_share(judged: &Judgement) -> Option<f64> {
    match judged.launch_margin {
        Some(LaunchMargin::UpTo { rise, .. }) => Some(rise),
        Some(LaunchMargin::BeyondTried) => None,
        None if !judged.sampled.is_asked() && judged.checked.verdict == Verdict::Pass => None,
        Some(LaunchMargin::NotPassing) | None => Some(0.0),
    }
}

/// Bounds of the share of sampled shots that fail, and of the share in which a cable breaks. Both are 0 to 1 where no sample was
/// drawn; `None` where none was asked for.
pub fn intervals(sampled: &Evidence<SampledShot>) -> Option<[[f64; 2]; 2]> {
    match sampled {
        Evidence::NotAsked => None,
        Evidence::Awaited => Some([[0.0, 1.0]; 2]),
        Evidence::Known(sampled) => Some([sampled.bounds.interval, sampled.breaks.interval]),
    }
}

/// Bounds of the failure probability, and the number of samples behind them; `None` where none was asked for.
pub fn failures_object(sampled: &Evidence<SampledShot>) -> Option<Vec<Fact>> {
    let [interval, _] = intervals(sampled)?;
    let bounds = sampled.known().map(|sampled| sampled.bounds);
    Some(vec![
        fact(&["low", "high"], Cell::Probability(interval)),
        fact(&["samples"], bounds.map_or(0, |bounds| bounds.samples)),
        fact(&["undecided"], bounds.map_or(0, |bounds| bounds.undecided)),
    ])
}

/// Cell of [`FAILURES`]; nothing where no sample was drawn.
pub fn failures(risk: Option<&RiskSummary>) -> Cell {
    risk.map(|risk| Cell::Probability(risk.bounds.interval)).into()
}

/// Cell of [`PROBABILITY`]; nothing where no sample was drawn.
pub fn probability(risk: Option<&RiskSummary>) -> Cell {
    risk.and_then(|risk| risk.bounds.probability()).into()
}

/// Cell of [`SAMPLES`].
pub fn samples(risk: Option<&RiskSummary>) -> Cell {
    Cell::Count(risk.map_or(0, |risk| risk.bounds.samples))
}

/// Failing samples in words: `2 of 430 sampled shots fail`.
pub fn sampled(risk: &RiskSummary) -> String {
    say!("{} of {} sampled shots fail", risk.bounds.failures, risk.bounds.samples)
}
