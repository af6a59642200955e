//! One random scene, judged and compared with its truth: a run at a step many times finer than that of the field level.

use std::ops::ControlFlow;

use shelter::choice::{Accuracy, Method};
use shelter::plan::Plan;
use shelter::simulation::{Model, RunSettings};
use shelter::study::as_planned::check::{CheckedShot, check_as_planned};
use shelter::study::{Case, ComputeSettings};
use shelter::verdict::{Limits, Verdict};

use super::random::Random;
use super::regimes::Regime;

/// Names of the quantities compared.
pub const QUANTITIES: [&str; 3] = ["height", "force", "drift"];

/// A plan whose scene and shot are replaced.
const PLAN: &str = r#"
shelter = { layout = "grid", rows = 1, columns = 1, spacing_m = 1 }
tire = { mass_kg = 1 }
cable = { axial_stiffness_kn = 1, breaking_force_kn = 1 }
ground = { friction = 0 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 1 }]
limits = { flight_height_m = 1, cable_safety_factor = 1 }
delay = [{ name = "1", interval_ms = 0 }]
"#;

/// Errors and verdicts of one scene at one level. Errors are relative to the true value; 0 where that is 0.
pub struct Compared {
    pub regime: Regime,
    /// Reported errors of height, force and drift at the level's own step, before any refinement.
    pub reported: [f64; 3],
    /// True errors at that step.
    pub truth: [f64; 3],
    /// Verdicts for limits 0.01 to 10 % from the true height and force, each with the right verdict.
    pub verdicts: Vec<(Verdict, Verdict)>,
    /// Steps of the runs behind these verdicts.
    pub steps: usize,
    /// Steps that the same number of runs at the finest step would take.
    pub steps_at_finest: usize,
}

/// Compares scene `n` of a regime at one level with a run `finer` times finer than the field level; `limits` limits are judged.
pub fn compare(regime: Regime, n: u64, accuracy: Accuracy, limits: usize, finer: f64) -> Compared {
    let (scene, shot) = regime.scene(n);
    let plan = Plan::parse("", PLAN).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut case = Case::new(plan);
    (case.model, case.shots) = (Model::new(scene), vec![shot]);
    let at_level = |accuracy| ComputeSettings { method: Method::Verlet, accuracy, step: None };
    let field = at_level(Accuracy::Field).first_step(&case);
    let settings = RunSettings { method: Method::Verlet, step: field / finer, duration: None };
    let truth = case.model.run(&case.shots[0], &settings, &mut |_| ControlFlow::Continue(()));
    let truth = truth.unwrap_or_else(|failure| panic!("{regime:?} {n}: {failure}"));
    let judge = |case: &Case, compute: &ComputeSettings| -> CheckedShot {
        check_as_planned(case, 0, compute, &mut |_| ControlFlow::Continue(()))
            .unwrap_or_else(|failure| panic!("{regime:?} {n}: {failure}"))
    };
    let own_step = ComputeSettings { step: Some(at_level(accuracy).first_step(&case)), ..at_level(accuracy) };
    let first = judge(&case, &own_step);
    let relative = |error: f64, value: f64| if value > 1e-6 { (error / value).abs() } else { 0.0 };
    let exact = [truth.height.value, truth.force.value, truth.drift.value];
    let found = [first.estimates.height, first.estimates.force, first.estimates.drift];
    let (mut verdicts, mut steps) = (Vec::new(), 0);
    let mut random = Random(n);
    for _ in 0..limits {
        let mut near = |value: f64| {
            let distance = 10_f64.powf(random.between(-4.0, -1.0));
            value * (1.0 + if random.between(0.0, 1.0) < 0.5 { distance } else { -distance })
        };
        let (height, force) = (near(exact[0]), near(exact[1]).max(1.0));
        case.limits = Limits { height, force, drift: None, breaking_force: force, ..case.limits };
        let judged = judge(&case, &at_level(accuracy));
        let right = if exact[0] > height || exact[1] > force { Verdict::Fail } else { Verdict::Pass };
        verdicts.push((judged.verdict, right));
        steps += judged.total_steps;
    }
    Compared {
        regime,
        reported: std::array::from_fn(|q| relative(found[q].error, exact[q])),
        truth: std::array::from_fn(|q| relative(found[q].value - exact[q], exact[q])),
        verdicts,
        steps,
        steps_at_finest: limits * truth.steps,
    }
}

/// Median of some numbers.
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Percentage of scenes whose true error of quantity `q` is within the reported error, but for rounding.
pub fn within<'c>(compared: impl Iterator<Item = &'c Compared>, q: usize) -> f64 {
    let all: Vec<_> = compared.collect();
    let hold = all.iter().filter(|c| c.truth[q] <= c.reported[q] + 1e-10).count();
    100.0 * hold as f64 / all.len() as f64
}
