//! Values of a plan's blast. Each is taken from the hole that launches fastest, which is the safe side.

use super::{Blast, EarlierShots};
use crate::plan::{Layout, Plan};

impl Blast {
    /// The blast of a plan: the heaviest charge, the least stemming, the widest hole, and the mass of the cover over its area.
    pub fn of_plan(plan: &Plan) -> Self {
        let least = |a: f64, b: f64| a.min(b);
        Self {
            charge_kg: plan.launches().filter_map(|launch| launch.charge_kg).reduce(f64::max),
            stemming_m: plan.launches().filter_map(|launch| launch.stemming_m).reduce(least),
            hole_diameter_mm: plan.launches().filter_map(|launch| launch.hole_diameter_mm).reduce(f64::max),
            cover_kg_m2: cover(plan),
            ..Self::default()
        }
    }

    /// The same blast, with the values of `stated` in place of its own.
    pub fn replaced_by(self, stated: Self) -> Self {
        Self {
            hole_diameter_mm: stated.hole_diameter_mm.or(self.hole_diameter_mm),
            stemming_m: stated.stemming_m.or(self.stemming_m),
            charge_length_m: stated.charge_length_m.or(self.charge_length_m),
            charge_kg: stated.charge_kg.or(self.charge_kg),
            explosive_density: stated.explosive_density.or(self.explosive_density),
            specific_charge_kg_m3: stated.specific_charge_kg_m3.or(self.specific_charge_kg_m3),
            burden_m: stated.burden_m.or(self.burden_m),
            spacing_m: stated.spacing_m.or(self.spacing_m),
            bench_m: stated.bench_m.or(self.bench_m),
            is_confined: stated.is_confined || self.is_confined,
            cover_kg_m2: stated.cover_kg_m2.or(self.cover_kg_m2),
        }
    }
}

/// Mass of the cover over its area [kg/m²]. The mass is that of the lightest tire, which leaves fastest. The area is that of its disc, or
/// of its cell of the mesh if the plan has no diameter.
fn cover(plan: &Plan) -> Option<f64> {
    let mass = plan.tire_masses().into_iter().reduce(f64::min)?;
    let diameter = plan.tire.outer_diameter_m;
    if diameter > 0.0 {
        return Some(mass / (0.25 * std::f64::consts::PI * diameter * diameter));
    }
    match &plan.layout {
        Layout::Grid(mesh) => Some(mass / (mesh.row_spacing_m * mesh.column_spacing_m)),
        Layout::Quincunx(mesh) => Some(2.0 * mass / (mesh.row_spacing_m * mesh.column_spacing_m)),
        Layout::List { .. } => None,
    }
}

/// The fastest launch of a plan [m/s].
pub fn fastest_launch(plan: &Plan) -> f64 {
    plan.launches().map(|launch| launch.speed_m_s).fold(0.0, f64::max)
}

/// The slowest launch of a plan [m/s].
pub fn slowest_launch(plan: &Plan) -> f64 {
    plan.launches().map(|launch| launch.speed_m_s).fold(f64::INFINITY, f64::min)
}

impl EarlierShots {
    /// The fit that the plan already holds; `None` if it was not fitted.
    pub fn of_plan(plan: &Plan) -> Option<Self> {
        let shots = Self {
            name: "what the plan was fitted to".to_owned(),
            speed: fastest_launch(plan),
            percent: plan.uncertainty.launch_common_percent,
            ..Self::default()
        };
        (!plan.fitted_from.is_empty()).then_some(shots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same impulse launches a lighter tire faster, so the lightest tire counts as the cover.
    #[test]
    fn the_cover_is_that_of_the_lightest_tire() {
        let text = "shelter = { layout = \"list\", tire = [{ x_m = 0, y_m = 0, mass_kg = 140 }, { x_m = 3, y_m = 0 }], cable = [] }\n\
            tire = { mass_kg = 280, outer_diameter_m = 2 }\ncable = { axial_stiffness_kn = 1400, breaking_force_kn = 60 }\n\
            ground = { friction = 0.3 }\nblast_row = [{ name = \"1\", under_tires = [1], launch_m_s = 6 }]\n\
            limits = { flight_height_m = 2, cable_safety_factor = 1 }\ndelay = [{ name = \"1\", interval_ms = 0 }]\n";
        let plan = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let found = cover(&plan).expect("a diameter");
        assert!((found - 140.0 / std::f64::consts::PI).abs() < 1e-9, "{found}");
    }
}
