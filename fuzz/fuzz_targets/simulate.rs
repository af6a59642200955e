//! Any plan of a small shelter moves for a few steps by both methods: every number stays finite, or the run says why not.
#![no_main]

use std::ops::ControlFlow;

use libfuzzer_sys::fuzz_target;
use shelter::choice::Method;
use shelter::plan::{Layout, Plan};
use shelter::simulation::{RunError, RunSettings};
use shelter::study::Case;

/// Tires of the largest shelter run; larger ones only take longer.
const MOST_TIRES: usize = 64;
const STEPS: usize = 40;

fuzz_target!(|text: &str| {
    let Ok(plan) = Plan::parse("plan.toml", text) else { return };
    let listed = match &plan.layout {
        Layout::Grid(mesh) | Layout::Quincunx(mesh) => {
            let side = |count: usize| count.saturating_add(2 * mesh.border_rows);
            side(mesh.rows).saturating_mul(side(mesh.columns))
        }
        Layout::List { tires, .. } => tires.len(),
    };
    if listed > MOST_TIRES {
        return;
    }
    let case = Case::new(plan);
    let tires = case.scene().tire_count();
    let step = (0.2 * case.scene().critical_step()).min(1e-3);
    for method in [Method::Verlet, Method::Newmark] {
        for shot in case.shots.iter().take(2) {
            let mut left = STEPS;
            let outcome = case.model.run(shot, &RunSettings { method, step, duration: None }, &mut |motion| {
                for tire in 0..tires {
                    let u = motion.displacement(tire);
                    assert!(u.iter().all(|x| x.is_finite()) && u.z >= 0.0, "{method:?}: tire {tire} at {u:?}");
                }
                left -= 1;
                if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            match outcome {
                Ok(outcome) => assert!(outcome.height.value.is_finite() && outcome.force.value.is_finite()),
                Err(RunError::Stopped { .. }) => {}
                Err(failure) => assert!(!failure.to_string().is_empty()),
            }
        }
    }
});
