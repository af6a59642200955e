//! Values outside their usual range: valid in a plan, but perhaps a slip of the pen, such as 2.8 kg for 280 kg.

use itertools::Itertools;

use super::delays::Timing;
use super::keys::{
    Key, Section, blast_row, cable, delay, ground, limits, search, shelter, simulation, tire, uncertainty,
};
use super::time::Time;
use super::{Launch, Layout, Plan};

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
    /// Whether the value is the time between two firing times of the key.
    pub is_gap: bool,
}

impl Plan {
    /// Whether gravity is in its usual range, as on earth.
    pub fn has_gravity_of_earth(&self) -> bool {
        let usual = simulation::GRAVITY_M_S2.usual;
        usual.is_none_or(|[low, high]| (low..=high).contains(&self.simulation.gravity_m_s2))
    }

    /// Unusual values of the plan, at most one per key: the value farthest outside the usual range.
    pub fn unusual(&self) -> Vec<Unusual> {
        let all = self.with_usual_ranges().into_iter();
        let out = all.filter_map(|(section, key, values)| farthest_out(section, key, &values));
        let apart = self.shortest_unusual_gap_ms().map(|value| Unusual {
            section: &delay::SECTION,
            key: &delay::AT_MS,
            value,
            usual: USUAL_APART_MS,
            is_gap: true,
        });
        let out = out.chain(apart);
        // A range around an unusual value says nothing new.
        out.unique_by(|unusual| unusual.key.name).collect()
    }

    /// Shortest time [ms] between rows with listed firing times, if it is below the usual range, or if all such times of its option are
    /// short.
    fn shortest_unusual_gap_ms(&self) -> Option<f64> {
        let listed = self.delays.iter().filter(|delay| matches!(delay.timing, Timing::At(_)));
        let of_option = listed.filter_map(|delay| {
            let mut fire_at = delay.timing.fire_at();
            fire_at.sort_unstable();
            fire_at.dedup();
            let apart = fire_at.into_iter().tuple_windows().map(|(before, after)| (after - before).ms());
            apart.minmax_by(f64::total_cmp).into_option()
        });
        let odd = of_option.filter_map(|(least, most)| {
            (least < USUAL_APART_MS[0] || most < LONGEST_APART_MS).then_some(least)
        });
        odd.min_by(f64::total_cmp)
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
        let of_launches = |value: fn(&Launch) -> Option<f64>| self.launches().filter_map(value).collect();
        // 0 is no diameter: cables run from centre to centre.
        let diameters = Some(self.tire.outer_diameter_m).filter(|diameter| *diameter > 0.0);
        let of_plan = vec![
            (&tire::SECTION, &tire::MASS_KG, masses),
            (&tire::SECTION, &tire::OUTER_DIAMETER_M, diameters.into_iter().collect()),
            (&shelter::SECTION, &shelter::SPACING_M, spacings),
            (&cable::SECTION, &cable::SLACK_PERCENT, vec![self.cable.slack_percent]),
            (&cable::SECTION, &cable::AXIAL_STIFFNESS_KN, vec![self.cable.axial_stiffness_kn]),
            (&cable::SECTION, &cable::BREAKING_FORCE_KN, vec![self.cable.breaking_force_kn]),
            (&cable::SECTION, &cable::DAMPING_PERCENT, vec![self.cable.damping_percent]),
            (
                &cable::SECTION,
                &cable::END_STIFFNESS_KN_M,
                self.cable.end_stiffness_kn_m.into_iter().collect(),
            ),
            (&ground::SECTION, &ground::FRICTION, vec![self.ground.friction]),
            (&blast_row::SECTION, &blast_row::LAUNCH_M_S, of_launches(|launch| Some(launch.speed_m_s))),
            (&blast_row::SECTION, &blast_row::TILT_DEG, of_launches(|launch| Some(launch.tilt_deg))),
            (&blast_row::SECTION, &blast_row::PUSH_MS, of_launches(push_ms)),
            (&blast_row::SECTION, &blast_row::CHARGE_KG, of_launches(|launch| launch.charge_kg)),
            (&blast_row::SECTION, &blast_row::STEMMING_M, of_launches(|launch| launch.stemming_m)),
            (
                &blast_row::SECTION,
                &blast_row::HOLE_DIAMETER_MM,
                of_launches(|launch| launch.hole_diameter_mm),
            ),
            (&blast_row::SECTION, &blast_row::PUSH_DEPTH_M, of_launches(|launch| launch.push_depth_m)),
            (&simulation::SECTION, &simulation::GRAVITY_M_S2, vec![self.simulation.gravity_m_s2]),
            (&limits::SECTION, &limits::FLIGHT_HEIGHT_M, vec![self.limits.flight_height_m]),
            (&limits::SECTION, &limits::DRIFT_M, self.limits.drift_m.into_iter().collect()),
            (
                &limits::SECTION,
                &limits::CHARGE_IN_8_MS_KG,
                self.limits.charge_in_8_ms_kg.into_iter().collect(),
            ),
            (&limits::SECTION, &limits::CABLE_SAFETY_FACTOR, vec![self.limits.cable_safety_factor]),
            (&limits::SECTION, &limits::ACCEPTED_RISK_PERCENT, vec![self.limits.accepted_risk_percent]),
            (&limits::SECTION, &limits::DUD_RISK_PERCENT, vec![self.limits.dud_risk_percent]),
        ];
        let first = |timing: &Timing| {
            timing.fire_at().into_iter().map(Time::ms).filter(|at| *at > 0.0).reduce(f64::min)
        };
        let [intervals, times] = [true, false].map(|is_interval| {
            let timings = self.delays.iter().map(|delay| &delay.timing);
            let timings = timings.filter(|timing| matches!(timing, Timing::Interval { .. }) == is_interval);
            timings.filter_map(first).collect()
        });
        let hole_intervals = self.delays.iter().map(|delay| delay.hole_timing.interval);
        let hole_intervals = hole_intervals.filter(|interval| *interval > Time::ZERO).map(Time::ms).collect();
        let spec = &self.search;
        let searched =
            |times: Vec<Time>| times.into_iter().filter(|at| *at > Time::ZERO).map(Time::ms).collect();
        let of_delays = [
            (&search::SECTION, &search::INTERVALS_MS, searched(spec.intervals.clone())),
            (
                &search::SECTION,
                &search::HOLE_INTERVALS_MS,
                searched(spec.holes.iter().map(|holes| holes.interval).collect()),
            ),
            (&delay::SECTION, &delay::INTERVAL_MS, intervals),
            (&delay::SECTION, &delay::AT_MS, times),
            (&delay::SECTION, &delay::HOLE_INTERVAL_MS, hole_intervals),
        ];
        // A 0 states an exact value, and is no slip of the pen.
        let not_exact = |values: Vec<f64>| if values == [0.0] { Vec::new() } else { values };
        let unknowns = self.unknowns().into_iter();
        of_plan
            .into_iter()
            .chain(of_delays)
            .chain(unknowns.map(|(key, values)| (&uncertainty::SECTION, key, not_exact(values))))
            .collect()
    }

    /// The numbers of `[uncertainty]`; both ends of a range.
    pub(super) fn unknowns(&self) -> Vec<(&'static Key, Vec<f64>)> {
        let unknown = &self.uncertainty;
        vec![
            (&uncertainty::DELAY_SD_MS, vec![unknown.delay.sd_ms]),
            (&uncertainty::DELAY_CV_PERCENT, vec![unknown.delay.cv_percent]),
            (&uncertainty::IN_HOLE_DELAY_MS, vec![unknown.in_hole_delay_ms]),
            (&uncertainty::LAUNCH_CV_PERCENT, vec![unknown.launch_cv_percent]),
            (&uncertainty::LAUNCH_ROW_CV_PERCENT, vec![unknown.launch_row_cv_percent]),
            (&uncertainty::LAUNCH_COMMON_PERCENT, vec![unknown.launch_common_percent]),
            (&uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT, vec![unknown.launch_between_shots_percent]),
            (&uncertainty::LAUNCH_TILT_DEG, vec![unknown.launch_tilt_deg]),
            (&uncertainty::LAUNCH_TILT_COMMON_DEG, vec![unknown.launch_tilt_common_deg]),
            (&uncertainty::HOLE_POSITION_M, vec![unknown.hole_position_m]),
            (&uncertainty::PATTERN_OFFSET_M, vec![unknown.pattern_offset_m]),
            (&uncertainty::HOLE_FAILS_PERCENT, vec![unknown.hole_fails_percent]),
            (&uncertainty::CABLE_LENGTH_M, vec![unknown.cable_length_m]),
            (&uncertainty::FRICTION, unknown.friction.to_vec()),
            (&uncertainty::SLACK_PERCENT, unknown.slack_percent.to_vec()),
            (&uncertainty::AXIAL_STIFFNESS_PERCENT, unknown.axial_stiffness_percent.to_vec()),
            (&uncertainty::TIRE_MASS_CV_PERCENT, vec![unknown.tire_mass_cv_percent]),
            (&uncertainty::BREAKING_FORCE_CV_PERCENT, vec![unknown.breaking_force_cv_percent]),
        ]
    }
}

/// Duration of a launch [ms]; `None` for a launch at once, which is no slip of the pen.
fn push_ms(launch: &Launch) -> Option<f64> {
    Some(launch.push_ms).filter(|push| *push > 0.0)
}

/// Least and greatest usual time between rows with listed firing times [ms]. Detonators are programmed in tenths. A time in seconds among
/// milliseconds lies closer to its neighbour.
const USUAL_APART_MS: [f64; 2] = [0.1, 20000.0];

/// Least usual value of the longest time between rows of one option [ms]: rows 1, 2 and 3 ms after the first are probably meant in seconds.
const LONGEST_APART_MS: f64 = 4.0;

fn farthest_out(section: &'static Section, key: &'static Key, values: &[f64]) -> Option<Unusual> {
    let usual @ [low, high] = key.usual?;
    let out = |value: &f64| (low - value).max(value - high);
    let value = *values.iter().max_by(|a, b| out(a).total_cmp(&out(b)))?;
    (out(&value) > 0.0).then_some(Unusual { section, key, value, usual, is_gap: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::keys::plan;

    /// Names and values of the unusual keys in the example with `new` in place of `old`.
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

    /// Only three unknowns have no usual range: two that are no number, and the mass law, which any value fits. The program reports percent
    /// for a share, centimetres for metres, and a dud in every second hole.
    #[test]
    fn a_slip_of_the_pen_in_an_unknown_is_told() {
        let keys = keys_below(&uncertainty::SECTION).into_iter();
        let without: Vec<&str> =
            keys.filter(|(_, key)| key.usual.is_none()).map(|(_, key)| key.name).collect();
        assert_eq!(without, ["detonator", "launch_mass_exponent", "fitted_from"]);
        for (key, value) in [
            ("hole_fails_percent", 50.0),
            ("hole_fails_percent", 99.0),
            ("cable_length_m", 2.0),
            // Shares for percent, kilometres for metres.
            ("hole_fails_percent", 0.0001),
            ("cable_length_m", 0.00001),
            ("hole_position_m", 0.0005),
            ("pattern_offset_m", 0.0005),
        ] {
            assert_eq!(told(&format!("{key} = 0\n"), &format!("{key} = {value}\n")), [(key, value)]);
        }
        // A share for percent: a launch that varies by 0.1 % in common.
        let key = "launch_common_percent";
        assert_eq!(told(&format!("{key} = 3 "), &format!("{key} = 0.1 ")), [(key, 0.1)]);
        assert_eq!(told(&format!("{key} = 3 "), &format!("{key} = 0 ")), []);
        assert_eq!(told("slack_percent = [1.5, 2.5]", "slack_percent = [1, 40]"), [("slack_percent", 40.0)]);
    }

    #[test]
    fn every_key_with_a_usual_range_is_looked_at() {
        let plan = Plan::parse("", include_str!("../../tests/fixtures/amur-three-rows.toml"));
        let plan = plan.unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let looked_at = plan.with_usual_ranges();
        // Holes have a launch as rows do, and listed tires have a mass. Some unknowns have the same name as the value that varies.
        let is_unknown = |section: &Section| section.title == uncertainty::SECTION.title;
        for (section, key) in keys_below(&plan::SECTION).into_iter().filter(|(_, key)| key.usual.is_some()) {
            let found = looked_at
                .iter()
                .any(|(own, one, _)| one.name == key.name && is_unknown(own) == is_unknown(section));
            assert!(found, "{} {}", section.title, key.name);
        }
        assert_eq!(
            told("accepted_risk_percent = 1 ", "accepted_risk_percent = 50 "),
            [("accepted_risk_percent", 50.0)]
        );
    }

    /// No page permits a shot on another planet.
    #[test]
    fn gravity_is_that_of_the_earth() {
        for (gravity, is_of_earth) in
            [("9.81", true), ("9.7", true), ("9.9", true), ("9.69", false), ("98.1", false)]
        {
            let text = format!(
                "{}\n[simulation]\ngravity_m_s2 = {gravity}\n",
                include_str!("../../tests/fixtures/amur-three-rows.toml")
            );
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            assert_eq!(plan.has_gravity_of_earth(), is_of_earth, "{gravity}");
        }
    }

    #[test]
    fn slips_of_the_pen_are_told() {
        assert_eq!(told("mass_kg = 280", "mass_kg = 280"), []);
        assert_eq!(told("mass_kg = 280 ", "mass_kg = 2.8 "), [("mass_kg", 2.8)]);
        assert_eq!(told("friction = 0.5 ", "friction = 50 "), [("friction", 50.0)]);
        for row in
            ["push_ms = 200", "push_ms = 0.02", "tilt_deg = 70", "push_depth_m = 30", "charge_kg = 0.025"]
        {
            let [key, value] = row.split(" = ").collect_array().unwrap_or_default();
            let told = told("launch_m_s = 6.0", &format!("launch_m_s = 6.0\n{row}"));
            assert_eq!(told, [(key, value.parse().unwrap_or_default())]);
        }
        for row in ["damping_percent = 80", "end_stiffness_kn_m = 2"] {
            let [key, value] = row.split(" = ").collect_array().unwrap_or_default();
            let told = told("slack_percent = 2\n", &format!("slack_percent = 2\n{row}\n"));
            assert_eq!(told, [(key, value.parse().unwrap_or_default())]);
        }
        assert_eq!(told("launch_m_s = 6.0", "launch_m_s = 60"), [("launch_m_s", 60.0)]);
        assert_eq!(told("interval_ms = 9\n", "interval_ms = 0.009\n"), [("interval_ms", 0.009)], "seconds");
        assert_eq!(told("at_ms = [0, 500, 1000]", "at_ms = [0, 0.5, 1]"), [("at_ms", 0.5)]);
        assert_eq!(told("at_ms = [0, 500, 1000]", "at_ms = [0, 500, 500.042]"), [("at_ms", 0.042)]);
        assert_eq!(told("at_ms = [0, 500, 1000]", "at_ms = [0, 33, 33.2]"), [], "programmed in tenths");
        assert_eq!(told("at_ms = [0, 500, 1000]", "at_ms = [0, 1, 2]"), [("at_ms", 1.0)]);
        assert_eq!(told("interval_ms = 9\n", "interval_ms = 1\n"), [("interval_ms", 1.0)]);
        let searched =
            |row: &str| told("[uncertainty]       ", &format!("[search]\n{row}\n[uncertainty]       "));
        assert_eq!(searched("intervals_ms = [0.017, 42]"), [("intervals_ms", 0.017)]);
        assert_eq!(searched("hole_intervals_ms = [0, 0.017]"), [("hole_intervals_ms", 0.017)]);
        assert_eq!(
            told("[uncertainty]       ", "[uncertainty]\nin_hole_delay_ms = 4        "),
            [("in_hole_delay_ms", 4.0)],
            "a cap of 4 s"
        );
        let holes = "interval_ms = 9\nhole_interval_ms = 0.017\n";
        assert_eq!(told("interval_ms = 9\n", holes), [("hole_interval_ms", 0.017)], "seconds");
        let own = "breaking_force_kn = 20900\naxial_stiffness_kn = 1519";
        let rope = "rope = \"GOST 2688-80 14 1960\"    # `shelter ropes` lists the catalogue\ntermination = \"mechanical sleeve\"";
        assert_eq!(told(rope, own), [("breaking_force_kn", 20_900.0)], "newtons for kilonewtons");
        assert_eq!(told("slack_percent = 2\n", "slack_percent = 40\n"), [("slack_percent", 40.0)]);
    }
}
