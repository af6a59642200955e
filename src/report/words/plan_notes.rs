//! Notes about a plan that readers of a study need beside its report.

use super::option_sentences;
use crate::plan::{HoleTiming, Launch, Plan, Timing};
use crate::report::language::say;
use crate::study::Case;
use crate::units;

/// Delay options with a time for each row. A study of orders leaves them out at the intervals of the plan. `None` where there are
/// none.
pub fn options_left_out(case: &Case) -> Option<String> {
    let timed_by_row = case.plan.delays.iter().filter(|delay| matches!(delay.timing, Timing::At(_)));
    let names: Vec<&str> = timed_by_row.map(|delay| delay.name.as_str()).collect();
    (!names.is_empty())
        .then(|| format!("without an interval of their own, and left out: {}", names.join("; ")))
}

/// Timing of the holes of a row in a study that varies order and interval; `None` where every row fires at once in all options.
pub fn hole_timing(case: &Case, holes: &HoleTiming) -> Option<String> {
    let differ = case.plan.shared_hole_timing().is_none();
    match option_sentences::hole_timing(holes) {
        Some(holes) => Some(say!("in every row: {holes}", holes)),
        None => differ.then(|| say!("here every row fires at once")),
    }
}

/// Launch factor of tires of another mass: `tires of 200 kg: launches × 1.4 (launch_mass_exponent 1, the worse end)`. `None` for
/// the mass of the plan.
pub fn launches_of_mass(plan: &Plan, tire_mass_kg: f64) -> Option<String> {
    let heavier = tire_mass_kg / plan.tire.mass_kg;
    let factor = plan.launch_factor_of_mass(tire_mass_kg);
    let launches = if factor == 1.0 { "stay".to_owned() } else { format!("× {}", units::short(factor)) };
    let exponent = plan.uncertainty.worse_mass_exponent(heavier);
    let text = format!(
        "tires of {tire_mass_kg} kg: launches {launches} (launch_mass_exponent {exponent}, the worse end)"
    );
    (heavier != 1.0).then_some(text)
}

/// Effects that the plan adds to the source paper's model, in one line; `None` where it adds none.
pub fn beyond_paper(plan: &Plan) -> Option<String> {
    let (ground, tire, cable) = (&plan.ground, &plan.tire, &plan.cable);
    let mention = |holds: bool, text: String| holds.then_some(text);
    let greatest = |quantity: fn(&Launch) -> f64| plan.launches().map(quantity).fold(0.0, f64::max);
    let (tilt, push) = (greatest(|launch| launch.tilt_deg), greatest(|launch| launch.push_ms));
    let gravity = plan.simulation.gravity_m_s2;
    let parts = [
        mention(gravity != 9.81, say!("gravity {gravity} m/s²", gravity)),
        mention(tilt > 0.0, say!("launches tilted by up to {tilt}°", tilt)),
        mention(push > 0.0, say!("launches pushed over up to {push} ms", push)),
        mention(
            ground.slope_percent > 0.0,
            say!(
                "the ground falls {} % toward {}° from +x, heights are normal to it",
                ground.slope_percent,
                ground.slope_toward_deg
            ),
        ),
        mention(tire.restitution > 0.0, say!("landings rebound with {} of their speed", tire.restitution)),
        mention(
            cable.damping_percent > 0.0,
            say!("cables damped with {} % of critical", cable.damping_percent),
        ),
        cable.end_stiffness_kn_m.map(|end| say!("ends of cables yield, {end} kN/m each", end)),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(" · "))
}
