//! Both methods against closed forms. Tolerances follow from the step h: second order in h times the natural scale of the
//! quantity, or rounding where the method is exact.

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::outcome::{EndReason, RunEnd};
use shelter::scene::{Firing, Shot};

use crate::support::scenes::{GRAVITY, METHODS, close, fire, quincunx, run, settings, tie, tires, watch};

const LAUNCH: f64 = 6.0;

#[test]
fn free_flight_reaches_v2_over_2g_and_lands_after_2v_over_g() {
    let scene = tires(&[(0.0, 0.0)], 280.0);
    for method in METHODS {
        for h in [1e-2, 1e-3, 7e-4] {
            let out = run(&scene, &fire(&[0], LAUNCH), settings(method, h, None));
            // A parabola is followed exactly, and its top is taken between samples.
            close(out.height.value, LAUNCH * LAUNCH / (2.0 * GRAVITY), 1e-9, "height");
            close(out.height.time, LAUNCH / GRAVITY, 1e-9, "time of the top");
            // At rest in the step after the landing.
            close(out.end.time, 2.0 * LAUNCH / GRAVITY, 3.0 * h, "landing");
            assert!(out.ledger.residual() < 1e-9, "{method:?} {:e}", out.ledger.residual());
        }
    }
}

/// Launched at the angle θ from the vertical, a tire rises (V₀ cos θ)²/2g, lands V₀² sin 2θ/g away, loses μ V₀ cos θ of its
/// sideways speed by landing, and slides on until friction has used up the rest.
#[test]
fn a_tilted_launch_flies_a_parabola_and_slides_on() {
    let scene = tires(&[(0.0, 0.0)], 280.0);
    for (tilt, toward) in [(10.0_f64, 0.0_f64), (20.0, 215.0), (40.0, 90.0)] {
        let (tilt, toward) = (tilt.to_radians(), toward.to_radians());
        let sideways = Vector3::new(toward.cos(), toward.sin(), 0.0) * (LAUNCH * tilt.sin());
        let launch = sideways + Vector3::z() * (LAUNCH * tilt.cos());
        let shot = Shot::from_firings(vec![Firing::at_once(0.0, 0, launch)]);
        let flight = LAUNCH * LAUNCH * (2.0 * tilt).sin() / GRAVITY;
        let left = (LAUNCH * tilt.sin() - 0.5 * LAUNCH * tilt.cos()).max(0.0);
        let slide = left * left / (2.0 * 0.5 * GRAVITY);
        for method in METHODS {
            for h in [1e-2, 7e-4] {
                let out = run(&scene, &shot, settings(method, h, None));
                close(out.height.value, (LAUNCH * tilt.cos()).powi(2) / (2.0 * GRAVITY), 1e-9, "height");
                // The slide is of second order in the step; so is the flight where a step ends after the landing.
                let tolerance =
                    GRAVITY * h * h + if method == Method::Verlet { 0.0 } else { h * LAUNCH * tilt.sin() };
                close(out.drift.value, flight + slide, tolerance, "drift");
                close(out.ledger.put_in, 0.5 * 280.0 * LAUNCH * LAUNCH, 1e-6, "energy put in");
            }
        }
    }
}

/// A tire is pulled by a cable stretched by s beforehand, leaves it at L₀ and slides on: work k s²/2 = μ m g × way.
#[test]
fn sliding_tire_stops_where_friction_has_used_up_its_energy() {
    for method in METHODS {
        for h in [1e-3, 1e-4] {
            let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0)], 280.0);
            scene.mass[0] = 1e9;
            tie(&mut scene, 0, 1, 1e5, 1.0);
            let (stretch, stiffness) = (0.1, 1e5 / 0.9);
            scene.cables[0].rest_length = 1.0 - stretch;
            scene.cables[0].stiffness = stiffness;
            // A launch of 0 wakes the tire.
            let out = run(&scene, &fire(&[1], 0.0), settings(method, h, None));
            let limit = 0.5 * 280.0 * GRAVITY;
            let way = 0.5 * stiffness * stretch * stretch / limit;
            let omega = (stiffness / 280.0_f64).sqrt();
            close(out.drift.value, way, (omega * h).powi(2) * way + GRAVITY * h * h, "way");
            // A quarter swing about the point where cable and friction balance, then braking at μ g.
            let amplitude = stretch - limit / stiffness;
            let swing = (std::f64::consts::PI - (limit / (stiffness * amplitude)).acos()) / omega;
            let speed = (2.0 * 0.5 * GRAVITY * (way - stretch)).sqrt();
            close(out.end.time, swing + speed / (0.5 * GRAVITY), 5.0 * h, "time");
        }
    }
}

#[test]
fn two_free_masses_exchange_velocity_at_v_sqrt_k_mu() {
    let (speed, stiffness, length) = (LAUNCH, 1.4e6, 1.5);
    for (method, factor) in [(Method::Verlet, 0.0125), (Method::Newmark, 1.0)] {
        for h in [1e-3, 2e-4] {
            // Without gravity; both tires lie on the ground, so the pair is stood on end: one above the other.
            let mut scene = tires(&[(0.0, 0.0), (0.0, 0.0)], 280.0);
            scene.gravity = 0.0;
            scene.mass = vec![280.0, 140.0];
            scene.position[1].z = length;
            tie(&mut scene, 0, 1, stiffness, 1.0);
            let out = run(&scene, &fire(&[1], speed), settings(method, h, Some(0.2)));
            let (k, reduced) = (stiffness / length, 280.0 * 140.0 / 420.0);
            let exact = speed * (k * reduced).sqrt();
            let omega = (k / reduced).sqrt();
            // Second order: (ωh)² times a constant of the method.
            close(out.force.value, exact, factor * (omega * h).powi(2) * exact, "force");
            close(out.force.time, 0.5 * std::f64::consts::PI / omega, h, "time of the peak");
        }
    }
}

/// The same pair on a slack cable, which becomes taut at any part of a step. Central differences would overshoot the force by
/// (ωh)²/8 where that is on a step and not at all halfway between two; a tenth of it is left to the parabola through samples.
#[test]
fn a_cable_pulls_alike_wherever_in_a_step_it_becomes_taut() {
    let (speed, axial_stiffness, length) = (LAUNCH, 1.4e6, 1.5);
    let reduced = 280.0 * 140.0 / 420.0;
    for eighths in 0..8 {
        let mut scene = tires(&[(0.0, 0.0), (0.0, 0.0)], 280.0);
        scene.gravity = 0.0;
        scene.mass = vec![280.0, 140.0];
        scene.position[1].z = length;
        let omega_h = 0.3;
        let h = omega_h / (axial_stiffness / length / reduced).sqrt();
        let way = speed * h * (3.0 + f64::from(eighths) / 8.0);
        tie(&mut scene, 0, 1, axial_stiffness, 1.0 + way / length);
        let out = run(&scene, &fire(&[1], speed), settings(Method::Verlet, h, Some(0.2)));
        let exact = speed * (scene.cables[0].stiffness * reduced).sqrt();
        close(out.force.value, exact, 0.1 * omega_h.powi(2) / 8.0 * exact, &format!("{eighths}/8 of a step"));
    }
}

/// Launched at v with the cable just taut, tied to a mass so heavy that it does not move.
#[test]
fn vertical_cable_to_the_ground_pulls_with_sqrt_mg2_kmv2_minus_mg() {
    let (mass, stiffness) = (280.0_f64, 1.41e6_f64);
    for method in METHODS {
        for h in [5e-4, 1e-4] {
            let mut scene = tires(&[(0.0, 0.0), (0.0, 0.0)], mass);
            scene.mass[0] = 1e7;
            scene.position[1].z = 1.0;
            tie(&mut scene, 0, 1, stiffness, 1.0);
            let out = run(&scene, &fire(&[1], LAUNCH), settings(method, h, Some(0.1)));
            let weight = mass * GRAVITY;
            let exact = (weight * weight + stiffness * mass * LAUNCH * LAUNCH).sqrt() - weight;
            let omega = (stiffness / mass).sqrt();
            close(out.force.value, exact, (0.5 * (omega * h).powi(2) + 1e-4) * exact, "force");
        }
    }
}

/// The source paper's cross with corners held by weight and friction.
#[test]
fn a_pinned_cross_rises_and_pulls_as_its_cables_allow() {
    for (diagonal, slack, height, force) in [
        (2.65, 1.0, 0.554_923_923, 30_582.972),
        (1.65, 1.0, 0.400_906_031, 41_023.629),
        (2.65, 1.02, 0.757_897_991, 27_777.025),
    ] {
        for method in METHODS {
            let mut scene = quincunx(diagonal, 1.41e6);
            for cable in &mut scene.cables {
                cable.rest_length *= slack;
                cable.stiffness /= slack;
            }
            scene.friction = 1e9;
            scene.mass[..4].fill(1e9);
            let h = 2e-4;
            let out = run(&scene, &fire(&[4], LAUNCH), settings(method, h, Some(0.3)));
            let omega2 = 4.0 * 1.41e6 / (diagonal * 280.0);
            let relative = omega2 * h * h + 1e-5;
            close(out.height.value, height, relative * height, "height");
            close(out.force.value, force, relative * force, "force");
        }
    }
}

/// A resting tire does not move while the pull stays inside the cone, and moves when it does not. The pull comes from a
/// weight hung over it: a cable stretched beforehand between a pinned tire and the one that is tested.
#[test]
fn static_pull_sticks_below_mu_r_and_slips_above() {
    for method in METHODS {
        for (part, moves) in [(1.0 - 1e-6, false), (1.0 + 1e-3, true)] {
            let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0), (50.0, 0.0)], 280.0);
            scene.mass[0] = 1e9;
            tie(&mut scene, 0, 1, 1e5, 1.0);
            let pull = part * 0.5 * 280.0 * GRAVITY;
            let cable = &mut scene.cables[0];
            // N = EA (L − L0)/L0 at rest.
            cable.rest_length = 1.0 / (1.0 + pull / 1e5);
            cable.stiffness = 1e5 / cable.rest_length;
            // A launch of 0 wakes the tire without moving it.
            let wake =
                shelter::scene::Shot::from_firings(vec![Firing::up(0.0, 1, 0.0), Firing::up(0.0, 2, LAUNCH)]);
            let mut greatest = 0.0_f64;
            watch(&scene, &wake, settings(method, 1e-3, Some(1.0)), |motion| {
                greatest = greatest.max(motion.displacement(1).norm());
            });
            assert_eq!(greatest > 0.0, moves, "{method:?} pull {part} of the limit: moved {greatest:e}");
        }
    }
}

#[test]
fn flight_without_cables_changes_momentum_by_gravity_only() {
    let scene = tires(&[(0.0, 0.0)], 280.0);
    for method in METHODS {
        let mut heights: Vec<(f64, Vector3<f64>)> = Vec::new();
        watch(&scene, &fire(&[0], LAUNCH), settings(method, 1e-3, Some(1.0)), |motion| {
            heights.push((motion.time(), motion.displacement(0)));
        });
        for (time, place) in heights {
            close(place.z, LAUNCH * time - 0.5 * GRAVITY * time * time, 1e-12, "height");
            assert_eq!((place.x, place.y), (0.0, 0.0));
        }
    }
}

/// Pulled by a cable at an angle, a tire slips at T = μ m g / (cos θ + μ sin θ) and is lifted at T = m g / sin θ.
#[test]
fn inclined_pull_slips_and_lifts_at_its_thresholds() {
    let weight = 280.0 * GRAVITY;
    // The far end stands on ground of its own, higher up.
    let pulled = |angle: f64, pull: f64, friction: f64, method: Method| {
        let mut scene = tires(&[(0.0, 0.0), (10.0 * angle.cos(), 0.0)], 280.0);
        scene.position[1].z = 10.0 * angle.sin();
        scene.mass[1] = 1e7;
        scene.friction = friction;
        tie(&mut scene, 0, 1, 1e5, 1.0);
        scene.cables[0].rest_length = 10.0 / (1.0 + pull / 1e5);
        scene.cables[0].stiffness = 1e5 / scene.cables[0].rest_length;
        // A tire that lifts slides at once, which slackens the cable: what counts is that it left the ground.
        let mut moved = Vector3::zeros();
        watch(&scene, &fire(&[0], 0.0), settings(method, 1e-3, Some(0.05)), |motion| {
            moved = moved.sup(&motion.displacement(0).abs());
        });
        moved
    };
    for method in METHODS {
        let (angle, mu) = (0.2_f64, 0.5);
        let slips = mu * weight / (angle.cos() + mu * angle.sin());
        assert!((slips - 1_272.372_075).abs() < 1e-5);
        assert_eq!(pulled(angle, slips * (1.0 - 1e-9), mu, method), Vector3::zeros(), "{method:?} sticks");
        assert!(pulled(angle, slips * (1.0 + 1e-6), mu, method).x > 0.0, "{method:?} slips");
        let lifts = weight / angle.sin();
        assert_eq!(pulled(angle, lifts * (1.0 - 1e-6), 1e9, method).z, 0.0, "{method:?} stays down");
        // Lifted, it slides at g / tan θ, which takes 2e-5 of the pull away within the first step.
        assert!(pulled(angle, lifts * (1.0 + 1e-4), 1e9, method).z > 0.0, "{method:?} lifts");
    }
}

/// A duration that ends near the landing of the last tire: both methods name the same end, and a shelter that is found at
/// rest by the last step is at rest.
#[test]
fn both_methods_name_the_same_end_around_rest() {
    let (scene, launch, h) = (tires(&[(0.0, 0.0)], 280.0), 6.0, 1e-3);
    let landing = 2.0 * launch / GRAVITY;
    for quarter in -12..=12 {
        let duration = landing + 0.25 * f64::from(quarter) * h;
        let ends =
            METHODS.map(|method| run(&scene, &fire(&[0], launch), settings(method, h, Some(duration))).end);
        assert_eq!(ends[0], ends[1], "{duration} s");
        let RunEnd { time, reason } = ends[0];
        assert!(time <= duration);
        // The step after the landing finds the tire at rest.
        let expected = if duration < landing { EndReason::TimeLimit } else { EndReason::AtRest };
        assert!(reason == expected || (duration - landing).abs() < h, "{reason:?} after {duration} s");
    }
}

/// A tire is drawn aside by a constant acceleration a and thrown across by a short cable, which then hangs slack. From there
/// on it slides along a curve: with φ the angle between velocity and pull, v sin φ / tan(φ/2)^(μg/a) stays the same. The
/// velocity comes from displacements one step apart, so that the ratio at two times differs from 1 by O(h²).
#[test]
fn a_curved_slide_is_of_second_order() {
    let (mass, friction, far) = (280.0, 0.5, 1e7);
    let pull = friction * GRAVITY;
    for method in METHODS {
        let error = |h: f64| {
            let mut scene = tires(&[(0.0, 0.0), (far, 0.0), (0.0, 4.0)], mass);
            (scene.mass[1], scene.mass[2]) = (1e12, 1e12);
            tie(&mut scene, 0, 1, 1.0, 0.5);
            // Half of its length is stretched.
            scene.cables[0].stiffness = mass * pull / (0.5 * far);
            tie(&mut scene, 0, 2, 1e6, 0.975);
            let (mut last, mut invariants) = (Vector3::zeros(), [f64::NAN; 2]);
            let times = [0.1, 0.4];
            watch(&scene, &fire(&[0], 0.0), settings(method, h, Some(0.41)), |motion| {
                let now = motion.displacement(0);
                let velocity = (now - last) / h;
                last = now;
                let angle = velocity.y.atan2(velocity.x);
                let invariant = velocity.y / (0.5 * angle).tan().powf(friction * GRAVITY / pull);
                for (invariant_at, at) in invariants.iter_mut().zip(times) {
                    if (motion.time() - at).abs() < 0.5 * h {
                        assert_eq!(motion.force(1), 0.0, "the short cable hangs slack");
                        *invariant_at = invariant;
                    }
                }
            });
            (invariants[1] / invariants[0] - 1.0).abs()
        };
        let errors = [2e-3, 1e-3, 5e-4].map(error);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 1.8, "{method:?}: order {order} from {errors:?}");
        }
    }
}

/// A tire is thrown up between four of different masses, which slide round corners. The displacements of all tires after
/// 0.1 s differ from those of a run 32 times finer by O(h²).
#[test]
fn tires_that_slide_round_corners_are_of_second_order() {
    for method in METHODS {
        let ends = |h: f64| {
            let mut scene = quincunx(1.5, 3e5);
            scene.mass = vec![60.0, 400.0, 900.0, 150.0, 280.0];
            let mut ends = Vec::new();
            watch(&scene, &fire(&[4], LAUNCH), settings(method, h, Some(0.1004)), |motion| {
                if (motion.time() - 0.1).abs() < 0.5 * h {
                    ends = (0..5).map(|tire| motion.displacement(tire)).collect();
                }
            });
            ends
        };
        let steps = [8e-4, 4e-4, 2e-4];
        let exact = ends(steps[2] / 32.0);
        let error =
            |h: f64| -> f64 { ends(h).iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) };
        let errors = steps.map(error);
        let order = 0.5 * (errors[0] / errors[2]).log2();
        assert!(order > 1.7, "{method:?}: order {order} from {errors:?}");
    }
}
