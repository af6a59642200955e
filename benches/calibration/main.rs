//! Are the reported errors right? Compares them with true errors over random scenes, smooth and hard.
//!
//! `cargo bench --bench calibration -- 300` prints how often the true error is within the reported one, how wide the
//! reported ones are, how many verdicts flip against the reference, and what refining only open verdicts saves.
//! The truth is a run at a step [`FINER`] times finer.

mod scenes;

use std::ops::ControlFlow;

use rayon::prelude::*;
use shelter::choice::{Accuracy, Method};
use shelter::outcome::Outcome;
use shelter::plan::Plan;
use shelter::simulation::{Model, Settings};
use shelter::study::check::check;
use shelter::study::{Case, ComputeSettings};
use shelter::verdict::{Limits, Verdict};

/// How much finer the reference is than the field step.
const FINER: f64 = 128.0;
/// First scene used here; the estimate's margin was fitted on scenes 30,000 to 30,599.
const FIRST: u64 = 10_000;

const PLAN: &str = r#"
shelter = { layout = "grid", rows = 1, columns = 1, spacing_m = 1 }
tire = { mass_kg = 1 }
cable = { axial_stiffness_kn = 1, breaking_force_kn = 1 }
ground = { friction = 0 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 1 }]
limits = { flight_height_m = 1, cable_safety_factor = 1 }
delay = [{ name = "1", interval_ms = 0 }]
"#;

struct Tried {
    reported: [f64; 2],
    truth: [f64; 2],
    verdict: Verdict,
    right: Verdict,
    steps: f64,
    steps_at_finest: f64,
}

fn main() {
    let count = std::env::args().filter_map(|argument| argument.parse().ok()).next().unwrap_or(300_u64);
    for accuracy in [Accuracy::Draft, Accuracy::Field] {
        let tried: Vec<Tried> =
            (FIRST..FIRST + count).into_par_iter().map(|n| compare(n, accuracy)).collect();
        println!("\n{accuracy:?}: {count} random scenes, truth at 1/{FINER} of the field step\n");
        println!("| | within the reported error | median true error | median reported | reported / true |");
        println!("|---|---|---|---|---|");
        for (quantity, name) in ["height", "force"].into_iter().enumerate() {
            let within = tried.iter().filter(|t| t.truth[quantity] <= t.reported[quantity]).count();
            let truth = median(tried.iter().map(|t| t.truth[quantity]));
            let reported = median(tried.iter().map(|t| t.reported[quantity]));
            println!(
                "| {name} | {:.1} % | {:.4} % | {:.4} % | {:.1} |",
                100.0 * within as f64 / count as f64,
                100.0 * truth,
                100.0 * reported,
                reported / truth
            );
        }
        let undecided = tried.iter().filter(|t| t.verdict == Verdict::Undecided).count();
        let flips = tried.iter().filter(|t| t.verdict != Verdict::Undecided && t.verdict != t.right).count();
        let (steps, finest): (f64, f64) =
            tried.iter().fold((0.0, 0.0), |sum, t| (sum.0 + t.steps, sum.1 + t.steps_at_finest));
        println!("\nlimits 0.01 to 10 % from the true values: {flips} verdicts flip, {undecided} undecided,");
        println!("{:.1} % of the steps that all runs at the finest step would take", 100.0 * steps / finest);
    }
}

/// Errors are relative to the true value; limits are drawn near it.
fn compare(n: u64, accuracy: Accuracy) -> Tried {
    let (scene, shot) = scenes::scene(n);
    let plan = Plan::parse("", PLAN).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut case = Case::new(plan);
    (case.model, case.shots) = (Model::new(scene), vec![shot]);
    let at_level = |accuracy| ComputeSettings { method: Method::Verlet, accuracy, step: None };
    let field = at_level(Accuracy::Field).first_step(&case);
    let settings = Settings { method: Method::Verlet, step: field / FINER, duration: None };
    let truth: Outcome = case
        .model
        .run(&case.shots[0], &settings, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|failure| panic!("scene {n}: {failure}"));
    let mut random = scenes::Random(n);
    let mut near = |value: f64| {
        let distance = 10_f64.powf(random.between(-4.0, -1.0));
        value * (1.0 + if random.between(0.0, 1.0) < 0.5 { distance } else { -distance })
    };
    let (height, force) = (near(truth.height.value), near(truth.force.value).max(1.0));
    case.limits = Limits { height, force, drift: None, breaking_force: force };
    let mut compute = at_level(accuracy);
    let judge = |compute: &ComputeSettings| {
        check(&case, 0, compute, &mut |_| ControlFlow::Continue(()))
            .unwrap_or_else(|failure| panic!("scene {n}: {failure}"))
    };
    let judged = judge(&compute);
    // The errors of the level's own step, before any refinement.
    compute.step = Some(compute.first_step(&case));
    let first = judge(&compute);
    let relative = |value: f64, of: f64| (value / of.max(f64::MIN_POSITIVE)).abs();
    let (h, f) = (truth.height.value, truth.force.value);
    let fails = h > height || f > force;
    Tried {
        reported: [relative(first.height.error, h), relative(first.force.error, f)],
        truth: [relative(first.height.value - h, h), relative(first.force.value - f, f)],
        verdict: judged.verdict,
        right: if fails { Verdict::Fail } else { Verdict::Pass },
        steps: judged.total_steps as f64,
        steps_at_finest: truth.steps as f64 * 64.0 / FINER,
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
