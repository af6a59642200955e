//! The shot of 12.04.07 of the source paper: three rows 20 ms apart, two rows of ballast on the side of the village.
//!
//! Known are the rows, the interval and, of the paper's smaller example, tires of 280 kg, a launch of 6 m/s, rope of 6.2 mm and
//! friction of 0.3 to 0.5. Everything else is assumed: ten columns, whole tires of 1.6 m, and the values below, each at each.

use std::ops::ControlFlow;

use itertools::iproduct;
use rayon::prelude::*;
use shelter::choice::Method;
use shelter::plan::Plan;
use shelter::simulation::RunSettings;
use shelter::study::Case;

/// Distance of centres [m].
pub const SPACINGS: [f64; 3] = [2.0, 2.6, 3.2];
/// Stiffness EA of the rope [kN]: 6.2, 9.6 and 14 mm of GOST 2688-80.
pub const STIFFNESSES: [f64; 3] = [1410.0, 3380.0, 7190.0];
/// Slack [%].
pub const SLACKS: [f64; 3] = [0.0, 2.0, 4.0];
/// Coefficients of friction: the paper's range.
pub const FRICTIONS: [f64; 3] = [0.3, 0.4, 0.5];

/// Greatest flight height [m] and cable force [N] for a launch velocity [m/s] and one set of assumptions.
fn greatest(
    launch: f64,
    [spacing, stiffness, slack, friction]: [f64; 4],
    method: Method,
) -> Option<[f64; 2]> {
    let text = format!(
        r#"
shelter = {{ layout = "grid", rows = 5, columns = 10, spacing_m = {spacing} }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
cable = {{ axial_stiffness_kn = {stiffness}, breaking_force_kn = 100, slack_percent = {slack} }}
ground = {{ friction = {friction} }}
blast_row = [
    {{ name = "1", under_row = 1, launch_m_s = {launch} }},
    {{ name = "2", under_row = 2, launch_m_s = {launch} }},
    {{ name = "3", under_row = 3, launch_m_s = {launch} }},
]
limits = {{ flight_height_m = 2, cable_safety_factor = 1 }}
delay = [{{ name = "20 ms", interval_ms = 20 }}]
"#
    );
    let case = Case::new(Plan::parse("12.04.07", &text).ok()?);
    let settings = RunSettings { method, step: 2e-4, duration: Some(2.0) };
    let outcome = case.model.run(&case.shots[0], &settings, &mut |_| ControlFlow::Continue(())).ok()?;
    Some([outcome.height.value, outcome.force.value])
}

/// Least, median and greatest flight height [m] over all assumptions, for a launch velocity [m/s].
pub fn band(launch: f64, method: Method) -> [f64; 3] {
    let all: Vec<[f64; 4]> = iproduct!(SPACINGS, STIFFNESSES, SLACKS, FRICTIONS)
        .map(|(spacing, stiffness, slack, friction)| [spacing, stiffness, slack, friction])
        .collect();
    let heights = all.into_par_iter().filter_map(|assumed| greatest(launch, assumed, method));
    let mut heights: Vec<f64> = heights.map(|[height, _]| height).collect();
    heights.sort_by(f64::total_cmp);
    [heights[0], heights[heights.len() / 2], heights[heights.len() - 1]]
}
