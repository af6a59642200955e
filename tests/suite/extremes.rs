//! Stability at the extremes: every run is finite, closes its ledger, stays above the ground and inside the friction cone,
//! or is refused by name.

use std::ops::ControlFlow;

use shelter::plan::Method;
use shelter::scene::{Firing, Scene, Shot};
use shelter::simulation::{Failure, Settings, simulate};

use crate::scenes::{METHODS, close, fire, grid, quincunx, run, settings, tires, try_run};

/// Runs for about `steps` steps of a tenth of the critical step, 1 ms at most, and checks what must hold at each.
#[track_caller]
fn holds(scene: &Scene, shot: &Shot, steps: f64, case: &str) {
    let step = (0.1 * scene.critical_step()).min(1e-3);
    let last = shot.firings.last().map_or(0.0, |firing| firing.at);
    for method in METHODS {
        let settings = settings(method, step, Some(last + steps * step));
        let scale = scene.cables.iter().map(|cable| cable.rest_length).fold(1e-3, f64::max);
        let mut worst = (0.0_f64, 0.0_f64);
        let out = simulate(scene, shot, &settings, &mut |motion| {
            for tire in 0..scene.mass.len().min(64) {
                let (friction, limit) = motion.friction(tire);
                worst.0 = worst.0.min(motion.displacement(tire).z);
                worst.1 = worst.1.max(friction - limit * (1.0 + 1e-9));
            }
            ControlFlow::Continue(())
        });
        let out = out.unwrap_or_else(|failure| panic!("{case}, {method:?}: {failure}"));
        let values = [out.height.value, out.force.value, out.drift.value, out.ledger.residual()];
        assert!(values.iter().all(|value| value.is_finite()), "{case}, {method:?}: {values:?}");
        assert!(worst.0 >= -1e-12 * scale, "{case}, {method:?} penetrates by {:e}", worst.0);
        assert!(
            worst.1 <= 1e-9 * (1.0 + worst.1.abs()),
            "{case}, {method:?} leaves the cone by {:e}",
            worst.1
        );
        // ωh is at most 0.2: an elastic energy is known to (ωh)²/4 = 1 %, and impacts store it anew several times.
        assert!(out.ledger.residual() < 5e-2, "{case}, {method:?} residual {:e}", out.ledger.residual());
    }
}

fn cross(axial_stiffness: f64) -> Scene {
    quincunx(1.5, axial_stiffness)
}

#[test]
fn axial_stiffness_from_1_n_to_1e12_n() {
    for exponent in [0, 3, 6, 9, 12] {
        holds(&cross(10_f64.powi(exponent)), &fire(&[4], 6.0), 2000.0, &format!("EA = 1e{exponent} N"));
    }
}

#[test]
fn masses_from_a_gram_to_a_thousand_tonnes_and_ratios_of_a_million() {
    for mass in [1e-3, 1.0, 1e6] {
        let mut scene = cross(1.4e6);
        scene.mass.fill(mass);
        holds(&scene, &fire(&[4], 6.0), 2000.0, &format!("mass {mass} kg"));
    }
    for (corner, centre) in [(1e-3, 1e3), (1e3, 1e-3), (1e6, 1.0)] {
        let mut scene = cross(1.4e6);
        scene.mass[..4].fill(corner);
        scene.mass[4] = centre;
        holds(&scene, &fire(&[4], 6.0), 2000.0, &format!("corners {corner} kg, centre {centre} kg"));
    }
}

#[test]
fn friction_0_and_1e6_and_no_gravity() {
    for friction in [0.0, 1e-6, 1e6] {
        let mut scene = grid(3, 4, 1.5, 1.4e6);
        scene.friction = friction;
        holds(&scene, &fire(&[5, 6], 6.0), 1500.0, &format!("μ = {friction}"));
    }
    let mut scene = grid(3, 4, 1.5, 1.4e6);
    scene.gravity = 0.0;
    holds(&scene, &fire(&[5], 6.0), 1500.0, "no gravity");
}

#[test]
fn launches_from_0_to_1000_m_s() {
    for launch in [0.0, 1e-9, 100.0, 1000.0] {
        holds(&cross(1.4e6), &fire(&[4], launch), 2000.0, &format!("launch {launch} m/s"));
    }
}

#[test]
fn spacings_from_a_millimetre_to_a_kilometre_and_slack_to_double_length() {
    for spacing in [1e-3, 1e3] {
        holds(&quincunx(spacing, 1.4e6), &fire(&[4], 6.0), 2000.0, &format!("spacing {spacing} m"));
    }
    for slack in [1.5, 2.0] {
        let mut scene = cross(1.4e6);
        for cable in &mut scene.cables {
            cable.rest_length *= slack;
        }
        holds(&scene, &fire(&[4], 6.0), 2000.0, &format!("slack {slack}"));
    }
}

#[test]
fn many_holes_at_once_at_one_place_and_late() {
    let all = |at: f64, count: usize, tires: usize| {
        Shot::from_firings((0..count).map(|n| Firing { at, tire: n % tires, launch: 3.0 }).collect())
    };
    let scene = grid(4, 5, 1.5, 1.4e6);
    holds(&scene, &all(0.0, 20, 20), 1000.0, "all holes at once");
    holds(&scene, &all(0.0, 10_000, 20), 200.0, "10,000 holes at once");
    holds(&scene, &all(1e5, 20, 20), 1000.0, "firing after a day");
    let again = (0..100).map(|n| Firing { at: 0.013 * f64::from(n), tire: 7, launch: 3.0 });
    holds(&scene, &Shot::from_firings(again.collect()), 500.0, "one tire fired 100 times");
    let same = (0..100).map(|_| Firing { at: 0.0, tire: 7, launch: 0.06 });
    holds(&scene, &Shot::from_firings(same.collect()), 500.0, "one tire fired 100 times at once");
}

#[test]
fn one_tire_and_a_row_of_a_thousand() {
    holds(&tires(&[(0.0, 0.0)], 280.0), &fire(&[0], 6.0), 1500.0, "one tire");
    holds(&grid(1, 1000, 1.5, 1.4e6), &fire(&[500], 6.0), 300.0, "a row of a thousand");
}

#[test]
fn a_million_metres_away_nothing_changes() {
    let near = grid(3, 4, 1.5, 1.4e6);
    let mut far = near.clone();
    for place in &mut far.position {
        place.x += 1e6;
        place.y -= 1e6;
    }
    for method in METHODS {
        let settings = settings(method, 1e-3, Some(0.5));
        assert_eq!(run(&near, &fire(&[5], 6.0), settings), run(&far, &fire(&[5], 6.0), settings));
    }
}

/// Steps from 1e-7 s, where only rounding is left, to ten times the critical one, where `verlet` refuses and the implicit
/// method must still give something finite or say why not.
#[test]
fn steps_from_1e_7_s_to_ten_times_critical() {
    let (scene, shot) = (quincunx(1.0, 1.519e6), fire(&[4], 6.0));
    let fine = run(&scene, &shot, settings(Method::Verlet, 1e-7, Some(0.05)));
    close(fine.force.value, 17_735.7, 0.5, "peak force at 1e-7 s");
    let critical = scene.critical_step();
    for part in [1.0, 1.1, 10.0] {
        let result = try_run(&scene, &shot, settings(Method::Verlet, part * critical, Some(1.0)));
        assert!(matches!(result, Err(Failure::Step { .. })), "{part} of the critical step");
    }
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        for method in METHODS {
            let result = try_run(&scene, &shot, Settings { method, step, duration: Some(1.0) });
            assert!(matches!(result, Err(Failure::Step { .. })), "step {step}, {method:?}");
        }
    }
    let just_below = run(&scene, &shot, settings(Method::Verlet, 0.99 * critical, Some(2.0)));
    assert!(just_below.height.value < 2.0 && just_below.height.value > 0.5);
    for part in [1.0, 3.0, 10.0] {
        match try_run(&scene, &shot, settings(Method::Newmark, part * critical, Some(1.0))) {
            Ok(out) => assert!(out.height.value.is_finite() && out.force.value.is_finite()),
            Err(failure) => assert!(matches!(failure, Failure::Unsettled { .. }), "{failure}"),
        }
    }
}

#[test]
fn cables_that_hardly_pull_leave_free_flight() {
    for method in METHODS {
        let out = run(&cross(1e-6), &fire(&[4], 6.0), settings(method, 1e-3, None));
        close(out.height.value, 36.0 / (2.0 * 9.81), 1e-8, "height");
    }
}

/// Ten hours between two holes are jumped over: the result is that of separate runs.
#[test]
fn a_long_pause_costs_nothing() {
    let scene = grid(3, 4, 1.5, 1.4e6);
    let hole = |at: f64| Firing { at, tire: 5, launch: 6.0 };
    let once = run(&scene, &Shot::from_firings(vec![hole(0.0)]), settings(Method::Verlet, 1e-3, None));
    let shot = Shot::from_firings(vec![hole(0.0), hole(36_000.0)]);
    let twice = run(&scene, &shot, settings(Method::Verlet, 1e-3, None));
    assert!(twice.steps < 10 * once.steps);
    assert!(twice.height.value >= once.height.value);
    assert!(twice.drift.at > 36_000.0);
}
