//! Values outside what is usual: right for a plan, but perhaps a slip of the pen, such as 2.8 kg for 280 kg.

use super::keys::{Key, Section, blast_row, cable, ground, limits, shelter, tire};
use super::{Layout, Plan};

/// A value outside the usual range of its key.
#[derive(Clone, Copy, Debug)]
pub struct Unusual {
    /// The section.
    pub section: &'static Section,
    /// The key.
    pub key: &'static Key,
    /// The value, in the unit of the key.
    pub value: f64,
    /// Least and greatest usual value.
    pub usual: [f64; 2],
}

impl Plan {
    /// Values of the plan that are not usual, at most one a key: the farthest out.
    pub fn unusual(&self) -> Vec<Unusual> {
        let all = self.with_usual_ranges().into_iter();
        all.filter_map(|(section, key, values)| farthest_out(section, key, &values)).collect()
    }

    /// The values of every key that has a usual range.
    fn with_usual_ranges(&self) -> Vec<(&'static Section, &'static Key, Vec<f64>)> {
        let (masses, spacings) = match &self.layout {
            Layout::Grid(mesh) | Layout::Quincunx(mesh) => {
                (vec![self.tire.mass_kg], vec![mesh.row_spacing_m, mesh.column_spacing_m])
            }
            Layout::List { tires, .. } => {
                let own = tires.iter().filter_map(|tire| tire.mass_kg);
                (own.chain([self.tire.mass_kg]).collect(), Vec::new())
            }
        };
        let launches = self.launches().map(|launch| launch.speed_m_s).collect();
        // 0 is no diameter: cables run from centre to centre.
        let diameters = Some(self.tire.outer_diameter_m).filter(|diameter| *diameter > 0.0);
        vec![
            (&tire::SECTION, &tire::MASS_KG, masses),
            (&tire::SECTION, &tire::OUTER_DIAMETER_M, diameters.into_iter().collect()),
            (&shelter::SECTION, &shelter::SPACING_M, spacings),
            (&cable::SECTION, &cable::SLACK_PERCENT, vec![self.cable.slack_percent]),
            (&cable::SECTION, &cable::AXIAL_STIFFNESS_KN, vec![self.cable.axial_stiffness_kn]),
            (&cable::SECTION, &cable::BREAKING_FORCE_KN, vec![self.cable.breaking_force_kn]),
            (&ground::SECTION, &ground::FRICTION, vec![self.ground.friction]),
            (&blast_row::SECTION, &blast_row::LAUNCH_M_S, launches),
            (&limits::SECTION, &limits::FLIGHT_HEIGHT_M, vec![self.limits.flight_height_m]),
            (&limits::SECTION, &limits::CABLE_SAFETY_FACTOR, vec![self.limits.cable_safety_factor]),
            (&limits::SECTION, &limits::ACCEPTED_RISK_PERCENT, vec![self.limits.accepted_risk_percent]),
        ]
    }
}

fn farthest_out(section: &'static Section, key: &'static Key, values: &[f64]) -> Option<Unusual> {
    let usual @ [low, high] = key.usual?;
    let out = |value: &f64| (low - value).max(value - high);
    let value = *values.iter().max_by(|a, b| out(a).total_cmp(&out(b)))?;
    (out(&value) > 0.0).then_some(Unusual { section, key, value, usual })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::keys::plan;

    /// Names and values of what is unusual in the example with `new` in place of `old`.
    fn told(old: &str, new: &str) -> Vec<(&'static str, f64)> {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        assert!(text.contains(old), "{old}");
        let plan = Plan::parse("", &text.replace(old, new)).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        plan.unusual().iter().map(|unusual| (unusual.key.name, unusual.value)).collect()
    }

    fn keys_below(section: &'static Section) -> Vec<(&'static Section, &'static Key)> {
        let below = |&key: &&'static Key| match key.kind.section() {
            Some(inner) => keys_below(inner),
            None => vec![(section, key)],
        };
        section.keys.iter().flat_map(below).collect()
    }

    #[test]
    fn every_key_with_a_usual_range_is_looked_at() {
        let plan = Plan::parse("", include_str!("../../tests/fixtures/amur-three-rows.toml"));
        let plan = plan.unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let looked_at = plan.with_usual_ranges();
        // Holes have their launch as rows do.
        for (section, key) in keys_below(&plan::SECTION).into_iter().filter(|(_, key)| key.usual.is_some()) {
            let found = looked_at.iter().any(|(_, one, _)| one.name == key.name);
            assert!(found, "{} {}", section.title, key.name);
        }
        assert_eq!(
            told("accepted_risk_percent = 1 ", "accepted_risk_percent = 50 "),
            [("accepted_risk_percent", 50.0)]
        );
    }

    #[test]
    fn slips_of_the_pen_are_told() {
        assert_eq!(told("mass_kg = 280", "mass_kg = 280"), []);
        assert_eq!(told("mass_kg = 280 ", "mass_kg = 2.8 "), [("mass_kg", 2.8)]);
        assert_eq!(told("friction = 0.5 ", "friction = 50 "), [("friction", 50.0)]);
        assert_eq!(told("launch_m_s = 6.0", "launch_m_s = 60"), [("launch_m_s", 60.0)]);
        let own = "breaking_force_kn = 20900\naxial_stiffness_kn = 1519";
        let rope = "rope = \"GOST 2688-80 14 1960\"    # `shelter ropes` lists the catalogue\ntermination = \"mechanical sleeve\"";
        assert_eq!(told(rope, own), [("breaking_force_kn", 20_900.0)], "newtons for kilonewtons");
        assert_eq!(told("slack_percent = 2\n", "slack_percent = 40\n"), [("slack_percent", 40.0)]);
    }
}
