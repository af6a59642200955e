//! Stability at the extremes, both methods: every run stays finite, above the ground, inside the cone of friction and in
//! balance, or is refused by name.
//!
//! The bound on the ledger follows from the greatest frequency ω of the scene (with ω² ≥ 2k/m) and the step h. Where a
//! cable becomes taut within a step, it pulls from the sample after on: with the stretch x ≤ hv there, the energy counted
//! at that sample is wrong by k x² / 2 − k x v h / 2, at most k (vh)² / 8, which is (ωh)² / 8 of m v² / 2. Becoming slack
//! is the same backwards, with the other sign, so that swings do not add up. Between the two, both methods keep an energy
//! that differs from the one counted by at most (ωh)² / 4. Together: (ωh)² / 2 of what was put in.

mod firing;

use std::ops::ControlFlow;

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::outcome::{EndReason, Outcome};
use shelter::scene::{Firing, Scene, Shot};
use shelter::simulation::{Model, RunError};

use crate::support::scenes::{
    GRAVITY, METHODS, close, fire, grid, quincunx, run, settings, tie, tires, try_run,
};

const LAUNCH: f64 = 6.0;
const EA: f64 = 1e6;

/// The five tires with cables of EA.
fn cross() -> Scene {
    quincunx(1.65, EA)
}

/// Makes every cable longer by `slack` of its length.
fn slacken(scene: &mut Scene, slack: f64) {
    for cable in &mut scene.cables {
        cable.rest_length *= 1.0 + slack;
        cable.stiffness /= 1.0 + slack;
    }
}

/// A twentieth of the critical step, at least two hundred steps to a flight, and no tire further in one than a hundredth of a
/// cable: the bound on the ledger takes a cable's direction for constant over a step.
fn step(scene: &Scene, launch: f64) -> f64 {
    let gravity = scene.gravity.max(1.0);
    let shortest = scene.cables.iter().map(|cable| cable.rest_length).fold(f64::INFINITY, f64::min);
    let turning = if launch > 0.0 { 0.01 * shortest / launch } else { f64::INFINITY };
    (0.05 * scene.critical_step()).min(2.0 * launch / gravity / 200.0).min(turning)
}

/// Steps a run may make: implicit ones cost more.
fn steps(method: Method) -> usize {
    match method {
        Method::Verlet => 20_000,
        Method::Newmark => 2_000,
    }
}

/// Runs up to `steps` steps after the first firing and holds every claim of this file against them.
#[track_caller]
fn stable(case: &str, scene: &Scene, shot: &Shot, method: Method, h: f64, steps: usize) -> Outcome {
    let case = format!("{case}, {method:?}, h = {h:e} s");
    let first = shot.firings.first().map_or(0.0, |firing| firing.time);
    let mut before = vec![Vector3::zeros(); scene.tire_count()];
    let (mut speed, mut highest, mut lowest) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut outside, mut finite) = (0.0_f64, true);
    let until = settings(method, h, Some(first + steps as f64 * h));
    let outcome = Model::new(scene.clone()).run(shot, &until, &mut |motion| {
        for (tire, before) in before.iter_mut().enumerate() {
            let place = motion.displacement(tire);
            finite &= place.iter().all(|part| part.is_finite());
            speed = speed.max((place - *before).norm() / h);
            (lowest, highest) = (lowest.min(place.z), highest.max(place.z));
            *before = place;
            let (friction, limit) = motion.friction(tire);
            finite &= friction.is_finite() && limit.is_finite();
            // Friction is the difference of two velocities over h and rounds as they do.
            let rounding = 8.0 * f64::EPSILON * scene.mass[tire] * (speed / h + scene.gravity);
            outside = outside.max(friction - limit * (1.0 + 1e-9) - rounding);
        }
        ControlFlow::Continue(())
    });
    let out = outcome.unwrap_or_else(|failure| panic!("{case}: {failure}"));
    let ledger = out.ledger;
    let values = [out.height, out.force, out.drift].map(|peak| [peak.value, peak.time]);
    let energies = [ledger.put_in, ledger.dissipated, ledger.greatest_residual];
    finite &= values.iter().flatten().chain(&energies).all(|value| value.is_finite());
    assert!(finite, "{case}: not finite: {out:?}");
    assert!(lowest >= -1e-12 * (1.0 + highest), "{case}: penetrates by {lowest:e} m");
    assert!(outside <= 0.0, "{case}: leaves the cone by {outside:e} N");
    let bound = ledger_bound(scene, shot, h, out.steps);
    assert!(ledger.residual() <= bound, "{case}: residual {:e}, not {bound:e}", ledger.residual());
    if out.end.reason == EndReason::AtRest {
        // The last step is balanced here: what did not stay in cables is dissipated.
        let stored: f64 = scene
            .cables
            .iter()
            .map(|cable| 0.5 * cable.force(cable.displaced(&before).norm()).powi(2) / cable.stiffness)
            .sum();
        let left = (ledger.put_in - ledger.dissipated - stored).abs();
        assert!(left <= bound * ledger.put_in, "{case}: {left:e} J of {:e} J are lost", ledger.put_in);
    }
    let least = -bound * ledger.put_in;
    assert!(ledger.dissipated >= least, "{case}: friction makes {:e} J", -ledger.dissipated);
    out
}

/// (ωh)² / 2 of the energy put in (see the top of this file), and rounding.
fn ledger_bound(scene: &Scene, shot: &Shot, h: f64, steps: usize) -> f64 {
    let omega = scene.frequency_bound();
    // Lengths are differences of numbers of their own size: the force rounds by k ε L, and works over v h at every step.
    let launch = shot.firings.iter().fold(0.0_f64, |most, firing| most.max(firing.launch.norm()));
    let longest = scene.cables.iter().fold(0.0_f64, |most, cable| most.max(cable.rest_length));
    let length = longest + launch * h * steps as f64;
    let noise = if launch > 0.0 { omega * omega * h * length / launch } else { 0.0 };
    0.5 * (omega * h).powi(2) + f64::EPSILON * (steps as f64 + 10.0) * (10.0 + noise)
}

/// `stable` at the usual step for both methods.
#[track_caller]
fn stable_both(case: &str, scene: &Scene, shot: &Shot, launch: f64) -> [Outcome; 2] {
    METHODS.map(|method| stable(case, scene, shot, method, step(scene, launch), steps(method)))
}

#[test]
fn steps_from_1e_7_s_to_just_below_critical_are_stable() {
    let scene = cross();
    let critical = scene.critical_step();
    for method in METHODS {
        for h in [1e-7, 1e-3 * critical, 1e-2 * critical, 0.1 * critical, 0.5 * critical, 0.999 * critical] {
            stable("step", &scene, &fire(&[4], LAUNCH), method, h, steps(method));
        }
    }
}

#[test]
fn steps_at_and_beyond_critical_are_refused_by_verlet_and_followed_by_newmark() {
    let scene = cross();
    let critical = scene.critical_step();
    for factor in [1.0, 1.0 + 1e-12, 2.0, 10.0] {
        let h = factor * critical;
        let refused = try_run(&scene, &fire(&[4], LAUNCH), settings(Method::Verlet, h, None));
        assert_eq!(refused, Err(RunError::Step { step: h, limit: critical, method: Method::Verlet }));
        // Unconditionally stable: the bound on the ledger is loose here, finiteness and contact are not.
        stable("beyond critical", &scene, &fire(&[4], LAUNCH), Method::Newmark, h, 1_000);
    }
}

#[test]
fn steps_that_are_no_steps_are_refused_by_name() {
    for method in METHODS {
        for h in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
            let refused = try_run(&cross(), &fire(&[4], LAUNCH), settings(method, h, Some(1.0)));
            assert!(matches!(refused, Err(RunError::Step { .. })), "{method:?} {h}: {refused:?}");
            let lone = try_run(&grid(1, 1, 1.0, EA), &fire(&[0], LAUNCH), settings(method, h, Some(1.0)));
            assert!(matches!(lone, Err(RunError::Step { .. })), "{method:?} {h}: {lone:?}");
        }
    }
}

#[test]
fn cables_from_1_n_to_1e12_n_are_stable() {
    for stiffness in [1.0, 1e3, 1e6, 1e9, 1e12] {
        let case = format!("EA {stiffness:e}");
        stable_both(&case, &quincunx(1.65, stiffness), &fire(&[4], LAUNCH), LAUNCH);
        stable_both(&case, &grid(2, 3, 2.0, stiffness), &fire(&[1, 3], LAUNCH), LAUNCH);
    }
}

#[test]
fn masses_from_1e_3_kg_to_1e6_kg_are_stable() {
    for mass in [1e-3, 1.0, 1e3, 1e6] {
        let mut scene = cross();
        scene.mass.fill(mass);
        stable_both(&format!("mass {mass:e}"), &scene, &fire(&[4], LAUNCH), LAUNCH);
    }
}

#[test]
fn mass_ratios_of_1e6_are_stable() {
    for (corner, centre) in [(1e-3, 1e3), (1e3, 1e-3), (1.0, 1e6), (1e6, 1.0)] {
        let mut scene = cross();
        scene.mass.fill(corner);
        scene.mass[4] = centre;
        for tire in [0, 4] {
            let case = format!("corners {corner:e}, centre {centre:e}, fired at {tire}");
            stable_both(&case, &scene, &fire(&[tire], LAUNCH), LAUNCH);
        }
    }
}

#[test]
fn friction_from_0_to_1e6_is_stable() {
    for friction in [0.0, 1e-6, 1e-3, 1.0, 10.0, 1e3, 1e6] {
        let mut scene = cross();
        scene.friction = friction;
        let outcomes = stable_both(&format!("mu {friction:e}"), &scene, &fire(&[4], LAUNCH), LAUNCH);
        if friction >= 1e3 {
            // Nothing slides: corners never move before they are lifted, the centre stops where it lands.
            outcomes.iter().for_each(|out| assert_eq!(out.end.reason, EndReason::AtRest));
            close(outcomes[0].height.value, outcomes[1].height.value, 1e-3, "height by both methods");
        }
    }
}

#[test]
fn launches_from_0_to_1e3_m_s_are_stable() {
    for launch in [1e-3, 1.0, 1e2, 1e3] {
        stable_both(&format!("launch {launch:e}"), &cross(), &fire(&[4], launch), launch);
    }
    for method in METHODS {
        let out = stable("no launch", &cross(), &fire(&[4], 0.0), method, 1e-4, 100);
        assert_eq!((out.height.value, out.force.value, out.drift.value), (0.0, 0.0, 0.0));
        assert_eq!((out.ledger.put_in, out.ledger.dissipated, out.end.reason), (0.0, 0.0, EndReason::AtRest));
    }
}

/// The ground takes all of it, at once.
#[test]
fn a_downward_launch_moves_nothing_and_is_dissipated() {
    for method in METHODS {
        for gravity in [GRAVITY, 0.0] {
            let mut scene = cross();
            scene.gravity = gravity;
            let out = stable("downward", &scene, &fire(&[4], -LAUNCH), method, 1e-4, 1_000);
            assert_eq!((out.height.value, out.drift.value, out.end.reason), (0.0, 0.0, EndReason::AtRest));
            let energy = 0.5 * 280.0 * LAUNCH * LAUNCH;
            close(out.ledger.put_in, energy, 1e-9, "put in");
            close(out.ledger.dissipated, energy, 1e-9, "dissipated");
        }
        // In flight it only brings the tire down sooner; what it takes out of the rise counts as negative.
        let shot = Shot::from_firings(vec![Firing::up(0.0, 4, LAUNCH), Firing::up(0.05, 4, -2.0 * LAUNCH)]);
        let out = stable("up and down", &cross(), &shot, method, 1e-4, 20_000);
        assert_eq!(out.end.reason, EndReason::AtRest);
        assert!(out.height.value < 0.3, "{}", out.height.value);
    }
}

#[test]
fn spacings_from_1e_3_m_to_1e3_m_are_stable() {
    for spacing in [1e-3, 1e-1, 1e1, 1e2, 1e3] {
        let case = format!("spacing {spacing:e}");
        stable_both(&case, &quincunx(spacing, EA), &fire(&[4], LAUNCH), LAUNCH);
    }
}

#[test]
fn slack_from_0_to_100_percent_is_stable() {
    for slack in [0.0, 1e-9, 1e-2, 0.1, 1.0] {
        let mut scene = cross();
        slacken(&mut scene, slack);
        let outcomes = stable_both(&format!("slack {slack:e}"), &scene, &fire(&[4], LAUNCH), LAUNCH);
        if slack == 1.0 {
            // A diagonal of 1.65 m may grow to 3.3 m: the tire comes down before its cables are taut.
            let free = LAUNCH * LAUNCH / (2.0 * GRAVITY);
            outcomes.iter().for_each(|out| close(out.height.value, free, 1e-9, "height"));
        }
    }
}

#[test]
fn without_gravity_all_is_stable() {
    let mut scene = cross();
    scene.gravity = 0.0;
    stable_both("no gravity", &scene, &fire(&[4], LAUNCH), LAUNCH);
    stable_both("no gravity, all", &scene, &fire(&[0, 1, 2, 3, 4], LAUNCH), LAUNCH);
}

#[test]
fn shelters_of_one_tire_and_of_one_long_row_are_stable() {
    for method in METHODS {
        stable("1 x 1", &grid(1, 1, 2.0, EA), &fire(&[0], LAUNCH), method, 1e-3, steps(method));
        let row = grid(1, 1000, 2.0, EA);
        let few = if method == Method::Verlet { 5_000 } else { 200 };
        stable("1 x 1000", &row, &fire(&[500], LAUNCH), method, step(&row, LAUNCH), few);
        stable("1 x 1000", &row, &fire(&[0, 999], LAUNCH), method, step(&row, LAUNCH), few);
    }
}

/// Only spans enter; the offset costs them ε × 1e6 m, of which k makes the force.
#[test]
fn a_shelter_1e6_m_away_moves_as_one_at_the_origin() {
    let near = cross();
    let places: Vec<_> = near.position.iter().map(|p| (p.x + 1e6, p.y - 1e6)).collect();
    let mut far = tires(&places, 280.0);
    for cable in &near.cables {
        tie(&mut far, cable.ends[0], cable.ends[1], EA, 1.0);
    }
    let [near, far] = [near, far].map(|scene| stable_both("far away", &scene, &fire(&[4], LAUNCH), LAUNCH));
    for (near, far) in near.iter().zip(&far) {
        close(far.height.value, near.height.value, 1e-7, "height");
        close(far.force.value, near.force.value, 1e-7 * near.force.value, "force");
    }
}

/// What the cables take is the work of their forces: k (L − L0)² / 2 each, less than EA L0 / 2 here.
#[test]
fn soft_cables_leave_free_flight() {
    let free = LAUNCH * LAUNCH / (2.0 * GRAVITY);
    for stiffness in [1.0, 1e-3, 1e-6] {
        for out in stable_both("soft", &quincunx(1.65, stiffness), &fire(&[4], LAUNCH), LAUNCH) {
            let work = 4.0 * 0.5 * stiffness * 1.65;
            // A parabola is followed exactly, up to rounding.
            close(out.height.value, free, work / (280.0 * GRAVITY) + 1e-12, "height");
        }
    }
}

/// Every corner of the box spanned by the ranges above.
#[test]
fn all_extremes_together_are_stable() {
    let ends = |n: usize, bit: usize, [low, high]: [f64; 2]| if n >> bit & 1 == 0 { low } else { high };
    for n in 0..256 {
        let mut scene = quincunx(ends(n, 0, [1e-3, 1e3]), ends(n, 1, [1.0, 1e12]));
        scene.mass.fill(ends(n, 2, [1e-3, 1e6]));
        scene.mass[4] *= ends(n, 3, [1.0, 1e-3]);
        scene.friction = ends(n, 4, [0.0, 1e6]);
        scene.gravity = ends(n, 5, [0.0, GRAVITY]);
        slacken(&mut scene, ends(n, 6, [0.0, 1.0]));
        let launch = ends(n, 7, [1e-3, 1e3]);
        for method in METHODS {
            let few = if method == Method::Verlet { 2_000 } else { 200 };
            stable(
                &format!("corner {n:08b}"),
                &scene,
                &fire(&[4], launch),
                method,
                step(&scene, launch),
                few,
            );
        }
    }
}

/// Such a flight lies between two samples; its top is noted where the tire lands.
#[test]
fn a_flight_shorter_than_the_step_reaches_its_height() {
    let scene = grid(1, 1, 2.0, EA);
    let top = (LAUNCH * LAUNCH / (2.0 * GRAVITY), LAUNCH / GRAVITY);
    for method in METHODS {
        for h in [0.5, 0.7, 1.0, 1.3, 2.0, 1e3] {
            let out = stable("short flight", &scene, &fire(&[0], LAUNCH), method, h, 100);
            close(out.height.value, top.0, 1e-9, "height");
            close(out.height.time, top.1, 1e-9, "time of the top");
            assert_eq!(out.end.reason, EndReason::AtRest);
        }
        // Fired within the step, where an earlier tire is still in the air.
        let shot = Shot::from_firings(vec![Firing::up(0.0, 0, 5.0), Firing::up(0.25, 1, LAUNCH)]);
        let two = tires(&[(0.0, 0.0), (5.0, 0.0)], 280.0);
        let out = stable("short flights", &two, &shot, method, 2.0, 100);
        close(out.height.value, top.0, 1e-9, "height");
        assert_eq!(out.height.index, 1);
        close(
            out.height.time,
            0.25 + top.1,
            if method == Method::Verlet { 1e-9 } else { 2.0 },
            "time of the top",
        );
    }
}
