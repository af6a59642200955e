//! All unknowns at once, on small plans of other kinds.

use shelter::{Case, Plan};

use super::compare_plan;

/// What is not known in all plans: every key is there.
const UNKNOWN: &str = r"
[uncertainty]
launch_cv_percent = 4
launch_row_cv_percent = 3
launch_common_percent = 4
launch_between_shots_percent = 3
launch_mass_exponent = [0, 1]
launch_tilt_deg = 2
launch_tilt_common_deg = 1.5
hole_position_m = 0.06
pattern_offset_m = 0.08
hole_fails_percent = 1
cable_length_m = 0.015
axial_stiffness_percent = [-10, 20]
tire_mass_cv_percent = 8
breaking_force_cv_percent = 4
";

/// Corner tires 2.2 m apart with a tire in every cell, centre to centre; pyrotechnic detonators, also in the holes.
const QUINCUNX: &str = r#"
shelter = { layout = "quincunx", rows = 3, columns = 4, spacing_m = 2.2 }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1519, breaking_force_kn = 50, slack_percent = 1 }
ground = { friction = 0.5 }
limits = { flight_height_m = 1.9, cable_safety_factor = 1.3 }
delay = [{ name = "25 ms", interval_ms = 25 }]
[[blast_row]]
name = "1"
under_row = 1.5
launch_m_s = 5.5
[[blast_row]]
name = "2"
under_row = 2.5
launch_m_s = 5.0
UNKNOWN
detonator = "pyrotechnic"
in_hole_delay_ms = 500
friction = [0.4, 0.6]
slack_percent = [0.5, 2]
"#;

/// Seven tires of different masses, a hole between a heavy and a light one, a limit of drift.
const LIST: &str = r#"
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 2500, breaking_force_kn = 70, slack_percent = 1.5 }
ground = { friction = 0.6 }
limits = { flight_height_m = 2.6, cable_safety_factor = 1.2, drift_m = 3.2 }
delay = [{ name = "17 ms", interval_ms = 17 }]
[shelter]
layout = "list"
tire = [{ x_m = 0, y_m = 0, mass_kg = 900 }, { x_m = 2, y_m = 0.3 }, { x_m = 4.1, y_m = 0, mass_kg = 450 },
        { x_m = 1, y_m = 1.8 }, { x_m = 3.1, y_m = 2 }, { x_m = 0.2, y_m = 3.6, mass_kg = 600 }, { x_m = 2.3, y_m = 3.8 }]
cable = [{ from = 1, to = 2 }, { from = 2, to = 3 }, { from = 1, to = 4 }, { from = 2, to = 4 }, { from = 2, to = 5 },
         { from = 3, to = 5 }, { from = 4, to = 5 }, { from = 4, to = 6 }, { from = 5, to = 7 }, { from = 6, to = 7 },
         { from = 4, to = 7 }]
[[blast_row]]
name = "1"
under_tires = [2, 4]
launch_m_s = 5.5
[[blast_row]]
name = "2"
holes = [{ x_m = 3.62, y_m = 1.0, launch_m_s = 5, push_depth_m = 1.5 }, { x_m = 2.3, y_m = 3.7, launch_m_s = 5 }]
UNKNOWN
detonator = "electronic"
friction = [0.5, 0.7]
slack_percent = [1, 2]
"#;

/// Holes by position from a survey, rim to rim, each row fired hole by hole from the left with surface delays; one is stated to tilt.
const POSITIONS: &str = r#"
shelter = { layout = "grid", rows = 3, columns = 4, spacing_m = 2.6 }
tire = { mass_kg = 280, outer_diameter_m = 1.6 }
cable = { axial_stiffness_kn = 2000, breaking_force_kn = 115, slack_percent = 2 }
ground = { friction = 0.5 }
limits = { flight_height_m = 2.2, cable_safety_factor = 1.3 }
delay = [{ name = "42 ms", interval_ms = 42, hole_interval_ms = 9, hole_order = "left" }]
[[blast_row]]
name = "1"
holes = [{ x_m = 0.1, y_m = 0.05, launch_m_s = 5.5 }, { x_m = 2.5, y_m = -0.1, launch_m_s = 5.5, tilt_deg = 4, tilt_toward_deg = 30 },
         { x_m = 5.25, y_m = 0.1, launch_m_s = 5.5 }, { x_m = 7.7, y_m = 0, launch_m_s = 5.5 }]
[[blast_row]]
name = "2"
holes = [{ x_m = 0.05, y_m = 2.7, launch_m_s = 5.5, push_depth_m = 1.2 }, { x_m = 2.6, y_m = 2.5, launch_m_s = 5.5 },
         { x_m = 6.5, y_m = 2.6, launch_m_s = 5.5 }]
UNKNOWN
detonator = "pyrotechnic surface"
friction = [0.4, 0.6]
slack_percent = [1, 3]
"#;

/// Ties and tires that yield.
const ELASTIC: &str = r#"
shelter = { layout = "grid", rows = 3, columns = 4, spacing_m = 2.6 }
tire = { mass_kg = 280, outer_diameter_m = 1.6 }
cable = { axial_stiffness_kn = 7000, breaking_force_kn = 38, slack_percent = 2, end_stiffness_kn_m = 1500 }
ground = { friction = 0.5 }
limits = { flight_height_m = 2.2, cable_safety_factor = 1.3 }
delay = [{ name = "20 ms", interval_ms = 20 }]
[[blast_row]]
name = "1"
under_row = 1
launch_m_s = 5.5
[[blast_row]]
name = "2"
under_row = 2
launch_m_s = 5.5
UNKNOWN
detonator = "electronic"
friction = [0.4, 0.6]
slack_percent = [1, 3]
"#;

/// A slope of 25 %, downhill to a side of the rows, and a limit of drift.
const SLOPE: &str = r#"
shelter = { layout = "grid", rows = 4, columns = 3, spacing_m = 1.8 }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1519, breaking_force_kn = 60, slack_percent = 2 }
ground = { friction = 0.55, slope_percent = 25, slope_toward_deg = 70 }
limits = { flight_height_m = 1.9, cable_safety_factor = 1.3, drift_m = 4.5 }
delay = [{ name = "30 ms", interval_ms = 30 }]
[[blast_row]]
name = "1"
under_row = 1
launch_m_s = 5
[[blast_row]]
name = "2"
under_row = 3
launch_m_s = 5
UNKNOWN
detonator = "electronic"
friction = [0.5, 0.6]
slack_percent = [1, 3]
"#;

/// Compares the failing shares of `samples` samples; true where all agree.
pub fn compare(samples: usize) -> bool {
    println!("\nall unknowns, {samples} samples each\n");
    println!("| plan | program | independent | deviations apart | agree |");
    println!("|---|---|---|---|---|");
    let plans = [
        ("quincunx", QUINCUNX),
        ("tire list of different masses", LIST),
        ("holes by position, fired hole by hole", POSITIONS),
        ("elastic ends", ELASTIC),
        ("slope of 25 %", SLOPE),
    ];
    let compared = plans.map(|(what, text)| {
        let text = text.replace("UNKNOWN\n", UNKNOWN);
        let plan = Plan::parse(what, &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        compare_plan(what, &Case::new(plan), samples)
    });
    compared == [true; 5]
}
