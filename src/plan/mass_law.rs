//! Mass law: a tire of another mass m' leaves with V0 (m/m')^n, where V0 is the launch velocity of the plan and m the mass of its tire.
//!
//! At n = 1 a hole gives every tire the same momentum: gas and fragments strike the tire. At n = 0 it gives the same velocity: the ground
//! heaves, some 6,500 kg/m² of rock under 150 kg/m² of tires. No measurement decides between the two, so `launch_mass_exponent` is a range.
//! Samples draw n from the range. A change of mass takes the end of the range at which tires leave faster.

use super::{Plan, Uncertainty};

/// Factor on the launch velocity of a tire that is `heavier` times as heavy as the plan's tire: (1/`heavier`)^n.
pub fn launch_factor(heavier: f64, exponent: f64) -> f64 {
    libm::pow(heavier, -exponent)
}

impl Uncertainty {
    /// The exponent at which a tire leaves fastest if it is `heavier` times as heavy as the plan's tire: the smallest exponent for a
    /// heavier tire, the largest for a lighter one.
    pub fn worse_mass_exponent(&self, heavier: f64) -> f64 {
        let [least, most] = self.launch_mass_exponent;
        if heavier > 1.0 { least } else { most }
    }
}

impl Plan {
    /// Factor on the launch velocities of the plan if its tires have this mass, at the worse end of the mass law. A tire with a mass of its
    /// own keeps that mass, so in a plan with such tires the factor is at least 1.
    pub fn launch_factor_of_mass(&self, tire_mass_kg: f64) -> f64 {
        let heavier = tire_mass_kg / self.tire.mass_kg;
        let factor = launch_factor(heavier, self.uncertainty.worse_mass_exponent(heavier));
        if self.layout.has_own_masses() { factor.max(1.0) } else { factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Layout, ListedTire};

    /// At n = 1 the momentum stays, at n = 0 the velocity, between the two m V0^(1/n). The plan's own range of n counts.
    #[test]
    fn a_change_of_mass_takes_the_end_at_which_tires_leave_faster() {
        assert_eq!(launch_factor(1.25, 0.0), 1.0);
        assert!((launch_factor(1.25, 1.0) - 0.8).abs() < 1e-15);
        assert!((launch_factor(4.0, 0.5) - 0.5).abs() < 1e-15);
        let amur = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let mut plan = Plan::parse("", amur).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert_eq!([350.0, 280.0, 140.0].map(|mass| plan.launch_factor_of_mass(mass)), [1.0, 1.0, 2.0]);
        plan.uncertainty.launch_mass_exponent = [0.5, 0.5];
        let factors = [1120.0, 280.0, 70.0].map(|mass| plan.launch_factor_of_mass(mass));
        assert_eq!(factors, [0.5, 1.0, 2.0]);
        // A tire with a mass of its own keeps that mass, and leaves no slower.
        let tire = |mass_kg| ListedTire { x_m: 0.0, y_m: 0.0, mass_kg };
        for (own, slowest) in [(None, 0.5), (Some(280.0), 1.0)] {
            plan.layout = Layout::List { tires: vec![tire(None), tire(own)], cables: Vec::new() };
            assert_eq!([1120.0, 70.0].map(|mass| plan.launch_factor_of_mass(mass)), [slowest, 2.0]);
        }
    }
}
