//! Are the reported errors right? A small version of `cargo bench --bench calibration`.

#[path = "../../benches/calibration/scenes.rs"]
mod scenes;

use std::ops::ControlFlow;

use shelter::choice::{Accuracy, Method};
use shelter::simulation::{Model, Settings};
use shelter::study::error::{NEIGHBOURS, RATIO, estimate};

use super::support::shipped;

/// 160 random scenes, smooth and hard, against a step 64 times finer: the true error is within the reported one in 19 of 20,
/// and the reported one is at most 5 times too wide in the median. The scenes are fixed, so the outcome is.
#[test]
fn reported_errors_hold_and_are_not_too_wide() {
    let mut within = [0; 2];
    let mut errors: [Vec<(f64, f64)>; 2] = Default::default();
    const SCENES: u64 = 160;
    for n in 0..SCENES {
        let (scene, shot) = scenes::scene(20_000 + n);
        let model = Model::new(scene);
        let step = (0.1 * model.scene().critical_step()).min(1e-3);
        let run = |step: f64| {
            let settings = Settings { method: Method::Verlet, step, duration: None };
            let out = model.run(&shot, &settings, &mut |_| ControlFlow::Continue(()));
            let out = out.expect("the run has an outcome");
            [out.height.value, out.force.value]
        };
        let (value, truth) = (run(step), run(step / 64.0));
        let near: Vec<_> =
            (1..=NEIGHBOURS as i32).map(|n| RATIO.powi(n) * step).map(|s| (s, run(s))).collect();
        for quantity in 0..2 {
            let neighbours = near.iter().map(|(step, value)| (*step, value[quantity]));
            let reported = estimate(step, value[quantity], neighbours);
            let error = (value[quantity] - truth[quantity]).abs();
            within[quantity] += usize::from(error <= reported);
            let scale = truth[quantity].max(f64::MIN_POSITIVE);
            errors[quantity].push((reported / scale, error / scale));
        }
    }
    for quantity in 0..2 {
        assert!(within[quantity] * 20 >= SCENES as usize * 19, "{} of {SCENES} hold", within[quantity]);
        let median = |of: fn(&(f64, f64)) -> f64| {
            let mut all: Vec<f64> = errors[quantity].iter().map(of).collect();
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        let ratio = median(|e| e.0) / median(|e| e.1);
        assert!(ratio <= 5.0, "{ratio} times too wide");
    }
}

/// A verdict near its limit is refined, one far from it is not.
#[test]
fn only_open_verdicts_cost_more() {
    use shelter::plan::Plan;
    use shelter::study::check::check;
    use shelter::study::{Case, ComputeSettings};
    let path = shipped("amur-three-rows.toml");
    let mut case = Case::new(Plan::load(path.as_ref()).expect("a shipped plan"));
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let mut judge = |height: f64| {
        case.limits.height = height;
        case.limits.force = 1e9;
        check(&case, 4, &compute, &mut |_| ControlFlow::Continue(())).expect("the run has an outcome")
    };
    let far = judge(3.0);
    assert_eq!(far.runs, 1 + NEIGHBOURS);
    let near = judge(far.height.value * (1.0 + 1e-6));
    assert!(near.runs > far.runs, "{} runs", near.runs);
    assert!(near.height.error < far.height.error);
}
