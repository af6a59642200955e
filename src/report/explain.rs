//! Sentences about one checked option, the same in every face.

use crate::outcome::Broken;
use crate::scene::Scene;
use crate::study::ComputeSettings;
use crate::study::check::Checked;
use crate::study::reason::{EarlyEnd, Quantity, Reason};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::{Estimate, Verdict};

/// Why an option did not pass, in words.
pub fn reason(reason: &Reason) -> String {
    let (quantity, verdict, estimate, limit) = match reason {
        Reason::Limit { quantity, verdict, estimate, limit } => (quantity, verdict, estimate, limit),
        Reason::Broken(1) => return "a cable breaks".to_owned(),
        Reason::Broken(count) => return format!("{count} cables break"),
        Reason::EnergyResidual(residual) => {
            let residual = units::percent(*residual, 1);
            return format!("the energy balance is off by {residual}: the step is too long for this motion");
        }
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
            format!("tires still move at {end} and may pull harder later: give a longer duration_s")
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
fn peak(scene: &Scene, checked: &Checked) -> [String; 2] {
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

/// Greatest height, force and drift, with their errors, places and times.
pub fn peaks(scene: &Scene, checked: &Checked) -> String {
    let [highest, hardest] = peak(scene, checked);
    let value = |of: &Estimate, unit: Unit| {
        format!("{} {}", value_and_error(of.value, of.error, unit), unit.symbol())
    };
    format!(
        "height {}, {highest} · force {}, {hardest} · drift {}",
        value(&checked.height, Unit::Metre),
        value(&checked.force, Unit::Kilonewton),
        value(&checked.drift, Unit::Metre),
    )
}

/// How the values of an option were computed, and where its peaks are.
pub fn computation(scene: &Scene, checked: &Checked) -> String {
    let [height, force] = peak(scene, checked);
    format!(
        "Highest: {height}; greatest force: {force}; {}, step {}, {} runs, energy residual {}",
        compute_label(&checked.compute),
        units::milliseconds(checked.step),
        checked.runs,
        units::residual(checked.energy_residual),
    )
}
