//! The limits of a plan in words, the same in every face.

use crate::report::language::{phrase, say};
use crate::study::Case;
use crate::units::{self, Unit};

/// Limits of height and cable force, with the breaking force. Limits of slide, holes and charge within 8 ms follow where the plan
/// has them.
pub fn limits(case: &Case) -> String {
    let [force, breaking] = [case.limits.force, case.limits.breaking_force].map(kilonewtons);
    let factor = case.plan.limits.cable_safety_factor;
    with_force(
        case,
        &say!("cable force {force} (breaking force {breaking} / {factor})", force, breaking, factor),
    )
}

/// Limits where room is short: the force without the breaking force.
pub fn limits_in_short(case: &Case) -> String {
    with_force(case, &format!("force {}", kilonewtons(case.limits.force)))
}

/// Limits under any rope: the force as a share of the rope's breaking force.
pub fn limits_of_any_rope(case: &Case) -> String {
    with_force(case, &format!("breaking force / {}", case.plan.limits.cable_safety_factor))
}

fn with_force(case: &Case, force: &str) -> String {
    let metres = |length: f64| format!("{} m", units::value(length, Unit::Metre));
    let drift = case.limits.drift.map_or_else(String::new, |drift| say!(", slide {}", metres(drift)));
    let limits = &case.plan.limits;
    let holes = limits.holes_in_8_ms.map_or_else(String::new, |most| match most {
        1 => phrase(", 1 hole in 8 ms").to_owned(),
        most => say!(", {most} holes in 8 ms", most),
    });
    let charge = limits.charge_in_8_ms_kg.map_or_else(String::new, |most| say!(", {most} kg in 8 ms", most));
    say!("height {}, {force}{drift}{holes}{charge}", metres(case.limits.height), force, drift, holes, charge)
}

fn kilonewtons(force: f64) -> String {
    format!("{} kN", units::value(force, Unit::Kilonewton))
}
