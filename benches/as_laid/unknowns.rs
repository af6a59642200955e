//! One unknown at a time, on a plan that takes all of them as exact.

use shelter::{Case, Plan};

use super::sampler::{Planned, STEP};
use super::{SEED, compare_plan, share_by_program};

/// Option that is compared.
const OPTION: &str = "42 ms";
/// Standard deviation of the places of tires [m], and that of the distance between two of them.
const TIRES_OFF: f64 = 0.03;
const DISTANCE_OFF: &str = "0.042";

/// The plan with the value of one key of `[uncertainty]` changed; an empty key changes nothing.
fn plan_with(text: &str, key: &str, value: &str) -> Case {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if !key.is_empty() {
        let line = lines.iter_mut().find(|line| line.starts_with(&format!("{key} = "))).expect("a key");
        *line = format!("{key} = {value}");
    }
    let plan = Plan::parse("amur", &lines.join("\n")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let option = plan.delays.iter().position(|delay| delay.name == OPTION).expect("an option");
    Case::new(plan).with_options(&[option])
}

/// The text of the plan, its ropes of steel, everything as drawn.
fn text() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/amur-three-rows.toml");
    std::fs::read_to_string(path).expect("the plan")
}

/// The plan as drawn.
pub fn exact() -> Case {
    plan_with(&text(), "", "")
}

/// The text with every push from 0.8 m below its hole, and every row with its holes by position, `aside` [m] from its tires.
fn with_holes_at([x, y]: [f64; 2]) -> String {
    let mut text = text();
    for row in 0..3 {
        let hole = |column: usize| {
            let at = [2.6 * column as f64 + x, 2.6 * f64::from(row) + y];
            format!("{{ x_m = {}, y_m = {}, launch_m_s = 6.0, push_depth_m = 0.8 }}", at[0], at[1])
        };
        let holes: Vec<String> = (0..10).map(hole).collect();
        let under_row = format!("under_row = {}\nlaunch_m_s = 6.0", row + 1);
        assert!(text.contains(&under_row));
        text = text.replace(&under_row, &format!("holes = [{}]", holes.join(", ")));
    }
    text
}

/// Compares the failing shares of `samples` samples; true where all agree. What another sampler found earlier, with another rope,
/// stands in `benches/RESULTS.md`.
pub fn compare(samples: usize) -> bool {
    println!("\n{samples} samples each; shares in percent with bounds of 95 %\n");
    println!("| what the plan takes as exact | program | independent | deviations apart | agree |");
    println!("|---|---|---|---|---|");
    let own = text();
    let pushed = own.replace("launch_m_s = 6.0", "launch_m_s = 6.0\npush_depth_m = 0.8");
    let at_tires = with_holes_at([0.0, 0.0]);
    let lines = [
        ("nothing else varies", &own, "", ""),
        ("each hole a dud with 1 %", &own, "hole_fails_percent", "1"),
        ("each hole a dud with 3 %", &own, "hole_fails_percent", "3"),
        ("holes off their tires, sd 10 cm", &pushed, "hole_position_m", "0.1"),
        ("all launches tilted alike, sd 3°", &own, "launch_tilt_common_deg", "3"),
        ("all launches tilted alike, sd 5°", &own, "launch_tilt_common_deg", "5"),
        ("length of each cable, sd 2 cm", &own, "cable_length_m", "0.02"),
        ("length of each cable, sd 4.2 cm", &own, "cable_length_m", DISTANCE_OFF),
        ("launch row by row, cv 5 %", &own, "launch_row_cv_percent", "5"),
        ("tilt hole by hole, sd 3° instead of 1°", &own, "launch_tilt_deg", "3"),
        ("tilt hole by hole, sd 5° instead of 1°", &own, "launch_tilt_deg", "5"),
        ("holes by position, exact", &at_tires, "", ""),
        ("pattern 10 cm aside along x", &with_holes_at([0.1, 0.0]), "", ""),
        ("pattern 10 cm aside along y", &with_holes_at([0.0, 0.1]), "", ""),
        ("pattern 10 cm aside along −y", &with_holes_at([0.0, -0.1]), "", ""),
        ("pattern off, sd 10 cm", &at_tires, "pattern_offset_m", "0.1"),
    ];
    let mut agrees = true;
    for (what, text, key, value) in lines {
        agrees &= compare_plan(what, &plan_with(text, key, value), samples);
    }
    print_tires_off(&own, samples);
    agrees & compare_steps(&own, samples)
}

/// Tires laid off their places, which no key says, beside the key of cable lengths with the deviation of the distance between two
/// tires. Both are different unknowns: the line shows how far apart they are, and does not count.
fn print_tires_off(text: &str, samples: usize) {
    let cables = plan_with(text, "cable_length_m", DISTANCE_OFF);
    let exact = plan_with(text, "", "");
    let mut independent = Planned::new(&exact, 0, None);
    independent.tires_off = TIRES_OFF;
    let program = share_by_program(&cables, &cables.shots[0], samples);
    let independent = independent.share(SEED, samples);
    println!(
        "| tires laid off, sd 3 cm (program: cables, sd 4.2 cm) | {program} | {independent} | {:.1} | other unknowns |",
        program.deviations_from(independent)
    );
}

/// The independent samples at half the step: the error of the step must not matter.
fn compare_steps(text: &str, samples: usize) -> bool {
    let case = plan_with(text, "hole_fails_percent", "3");
    let at = |step: f64| {
        let mut planned = Planned::new(&case, 0, None);
        planned.step = step;
        planned.share(SEED, samples)
    };
    let (whole, half) = (at(STEP), at(0.5 * STEP));
    println!("\nindependent, duds with 3 %: {whole} at 0.2 ms, {half} at 0.1 ms, the same draws");
    whole.agrees_with(half)
}
