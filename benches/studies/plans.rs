//! Random plans, the same for every run: grids of tires, every blast row under a row of its own.

use shelter::Plan;
use shelter::plan::{HoleTiming, Time};
use shelter::study::sweep::sweep;
use shelter::study::{Case, ComputeSettings, Context, Intervals, StudyControl};

use super::random::Random;

/// Blast rows of which all orders are compared only on narrow shelters: of wide ones it takes days.
const MANY_ROWS: usize = 7;

/// Plan number `n` with `rows` blast rows, or 2 to 4; its limits lie within what 26 intervals and the plan's own reach.
pub fn case(n: u64, rows: Option<usize>, rim_to_rim: bool) -> Case {
    // Limits that no interval keeps: a sweep tries nothing between.
    let strict = build(n, rows, rim_to_rim, [0.001, 0.01]);
    let order: Vec<usize> = (0..strict.plan.blast_rows.len()).collect();
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(500.0), step: Time::from_ms(20.0) };
    let compute = ComputeSettings { step: Some(5e-4), ..ComputeSettings::of(&strict.plan) };
    let reached = sweep(
        &Context::new(&strict, compute, &StudyControl::default()),
        &order,
        &intervals,
        HoleTiming::TOGETHER,
    )
    .expect("a result")
    .value;
    let [mut heights, mut forces]: [Vec<f64>; 2] = [
        reached.points.iter().map(|point| point.judged.planned.values.height.value).collect(),
        reached.points.iter().map(|point| point.judged.planned.values.force.value).collect(),
    ];
    let mut random = Random(n);
    let mut quantile = |values: &mut Vec<f64>, low: f64, high: f64| {
        values.sort_by(f64::total_cmp);
        values[(random.between(low, high) * (values.len() - 1) as f64) as usize]
    };
    let (height, force) = (quantile(&mut heights, 0.6, 1.0), quantile(&mut forces, 0.3, 0.8));
    build(n, rows, rim_to_rim, [1.02 * height, 1e-3 * force])
}

/// Plan number `n` with limits of height [m] and force [kN].
fn build(n: u64, rows: Option<usize>, rim_to_rim: bool, [height, force]: [f64; 2]) -> Case {
    let mut random = Random(1000 + n);
    let fired = random.whole(2, 4);
    let fired = rows.unwrap_or(fired);
    let (ballast, columns, spacing) = (random.whole(1, 2), random.whole(4, 10), random.between(2.3, 3.2));
    let columns = if fired < MANY_ROWS { columns } else { 2 + columns % 2 };
    let (diameter, spacing) = if rim_to_rim { (1.6, spacing) } else { (0.0, spacing - 0.9) };
    let mut text = format!(
        r#"
shelter = {{ layout = "grid", rows = {}, columns = {columns}, spacing_m = {spacing:.2} }}
tire = {{ mass_kg = {:.0}, outer_diameter_m = {diameter} }}
cable = {{ axial_stiffness_kn = {:.0}, slack_percent = {:.1}, breaking_force_kn = {force:.2} }}
ground = {{ friction = {:.2} }}
limits = {{ flight_height_m = {height:.3}, cable_safety_factor = 1 }}
delay = [{{ name = "20 ms", interval_ms = 20 }}, {{ name = "67 ms", interval_ms = 67 }}]
"#,
        fired + ballast,
        random.between(200.0, 400.0),
        random.between(2000.0, 8000.0),
        random.between(0.5, 4.0),
        random.between(0.3, 0.6),
    );
    for row in 1..=fired {
        let launch = random.between(4.0, 7.0);
        text += &format!("[[blast_row]]\nname = \"{row}\"\nunder_row = {row}\nlaunch_m_s = {launch:.2}\n");
    }
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}
