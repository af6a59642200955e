//! Effects beyond the source paper, each against its closed form and against an independent prototype.

use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use shelter::choice::{Accuracy, Method};
use shelter::plan::Plan;
use shelter::scene::{Firing, Scene, Shot};
use shelter::simulation::RunError;
use shelter::study::as_planned::check::check_as_planned;
use shelter::study::effects::{Effect, FIRST_SAMPLES, LEAST_RELATIVE_CHANGE, SAMPLES, effects};
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::run_shard;
use shelter::study::{Case, ComputeSettings, Context, Shard, StudyControl};
use shelter::verdict::{Quantity, Verdict};

use super::support::Edited;
use super::support::scenes::{
    GRAVITY, METHODS, close, fire, fire_rows, grid, quincunx, run, settings, tie, tires, try_run, watch,
};

const LAUNCH: f64 = 6.0;

/// The scene on a slope whose tangent is `fall`, downhill toward an azimuth [°].
fn on_slope(mut scene: Scene, fall: f64, toward: f64) -> Scene {
    let (angle, toward) = (fall.atan(), toward.to_radians());
    scene.gravity = GRAVITY * angle.cos();
    scene.downhill = GRAVITY * angle.sin() * Vector2::new(toward.cos(), toward.sin());
    scene
}

/// A lone tire launched normal to the slope rises V₀²/(2 g cos α), drifts ½ g sin α T² downhill in its flight of
/// T = 2 V₀/(g cos α), loses μ V₀ in its landing, and slides on against friction.
#[test]
fn a_launch_from_a_slope_flies_its_parabola() {
    for (fall, toward) in [(0.1_f64, 0.0), (0.3, 250.0), (0.35, 90.0)] {
        let scene = on_slope(tires(&[(0.0, 0.0)], 280.0), fall, toward);
        let (normal, along) = (scene.gravity, scene.downhill.norm());
        let flight = 2.0 * LAUNCH / normal;
        let left = (along * flight - 0.5 * LAUNCH).max(0.0);
        let way = 0.5 * along * flight * flight + left * left / (2.0 * (0.5 * normal - along));
        for method in METHODS {
            for h in [1e-2, 7e-4] {
                let out = run(&scene, &fire(&[0], LAUNCH), settings(method, h, None));
                close(out.height.value, LAUNCH * LAUNCH / (2.0 * normal), 1e-9, "height");
                // As on level ground, the slide is of second order, and so is the flight of `newmark`.
                let second = GRAVITY * h * h;
                let tolerance = second + if method == Method::Verlet { 0.0 } else { h * along * flight };
                close(out.drift.value, way, tolerance, &format!("{method:?} {fall}: drift"));
                assert!(out.ledger.residual() < 1e-2, "{method:?}: {:e}", out.ledger.residual());
            }
        }
    }
}

/// A tire at rest on a slope stays there as long as tan α ≤ μ. On a steeper slope it slides from the start, before any hole
/// fires, with g (sin α − μ cos α).
#[test]
fn a_tire_rests_where_friction_holds_it() {
    let mut scene = on_slope(tires(&[(0.0, 0.0), (9.0, 0.0)], 280.0), 0.3, 30.0);
    let shot = Shot::from_firings(vec![Firing::up(0.9, 1, 0.0)]);
    for method in METHODS {
        scene.friction = 0.300_001;
        let out = run(&scene, &shot, settings(method, 1e-3, Some(5.0)));
        assert_eq!(out.drift.value, 0.0, "{method:?}");
        scene.friction = 0.2;
        let out = run(&scene, &shot, settings(method, 1e-3, Some(1.5)));
        let acceleration = scene.downhill.norm() - 0.2 * scene.gravity;
        // `newmark` ends within a step, at the velocity of its end.
        close(out.drift.value, 0.5 * acceleration * 1.5 * 1.5, GRAVITY * 1e-6, &format!("{method:?}: drift"));
        assert!(out.ledger.residual() < 1e-6);
    }
}

/// A tire sliding uphill at v₀ stops after v₀²/(2 g (sin α + μ cos α)), and friction holds it there.
#[test]
fn a_slide_uphill_ends_where_its_energy_is_used_up() {
    let scene = on_slope(tires(&[(0.0, 0.0)], 280.0), 0.3, 180.0);
    let shot = Shot::from_firings(vec![Firing::at_once(0.0, 0, Vector3::x() * 4.0)]);
    let way = 16.0 / (2.0 * (scene.downhill.norm() + 0.5 * scene.gravity));
    for method in METHODS {
        for h in [1e-2, 1e-3] {
            let out = run(&scene, &shot, settings(method, h, None));
            // A launch along the ground is a landing at its start, of first order in `newmark`.
            let tolerance = if method == Method::Verlet { GRAVITY * h * h } else { h * 4.0 };
            close(out.drift.value, way, tolerance, &format!("{method:?} {h}: way"));
        }
    }
}

/// Bounces of a lone tire last 2 V₀/(g (1 − e)) in all, less those that would take a step; the n-th rises e²ⁿ V₀²/2g.
#[test]
fn bounces_are_a_geometric_series() {
    for (e, h) in [(0.3, 1e-3), (0.6, 5e-3), (0.9, 2e-2)] {
        let mut scene = tires(&[(0.0, 0.0)], 280.0);
        scene.restitution = e;
        let (mut last, mut tops) = ((0.0, 0.0), Vec::new());
        let out = watch(&scene, &fire(&[0], LAUNCH), settings(Method::Verlet, h, None), |motion| {
            let height = motion.displacement(0).z;
            // A flight whose top is well above a step's fall is seen by samples.
            if last.0 > last.1 && last.0 > height {
                tops.push(last.0);
            }
            last = (height, last.0);
        });
        let free = LAUNCH * LAUNCH / (2.0 * GRAVITY);
        close(out.height.value, free, 1e-9, "first flight");
        let seen = tops
            .iter()
            .enumerate()
            .take_while(|(n, _)| e.powi(2 * *n as i32) * free > 20.0 * GRAVITY * h * h);
        assert!(seen.clone().count() > 1, "a test that can fail: {e}");
        for (n, &top) in seen {
            close(top, e.powi(2 * n as i32) * free, GRAVITY * h * h, &format!("{e}: bounce {n}"));
        }
        let bounces = 2.0 * LAUNCH / (GRAVITY * (1.0 - e));
        close(out.end.time, bounces, 4.0 * h, &format!("{e}: time of all bounces"));
        assert!(out.ledger.residual() < 1e-2, "{e}: {:e}", out.ledger.residual());
        close(out.ledger.dissipated, out.ledger.put_in, 1e-2 * out.ledger.put_in, "all energy is lost");
    }
}

/// The friction of a landing acts with the whole normal impulse: (1 + e) m v.
#[test]
fn a_bounce_rubs_with_its_whole_impulse() {
    let mut scene = tires(&[(0.0, 0.0)], 280.0);
    (scene.restitution, scene.friction) = (0.5, 0.1);
    let launch = Vector3::new(3.0, 0.0, 4.0);
    let shot = Shot::from_firings(vec![Firing::at_once(0.0, 0, launch)]);
    let flight = 2.0 * 4.0 / GRAVITY;
    let mut path = Vec::new();
    watch(&scene, &shot, settings(Method::Verlet, 1e-3, Some(1.1)), |motion| {
        path.push((motion.time(), motion.displacement(0).x));
    });
    let later = path.iter().filter(|(time, _)| *time > flight + 0.01);
    for (time, x) in later {
        let speed = 3.0 - 0.1 * 1.5 * 4.0;
        close(*x, 3.0 * flight + speed * (time - flight), 1e-9, "way after the landing");
    }
}

#[test]
fn newmark_refuses_what_it_lacks_by_name() {
    let refused = |effect| Err(RunError::Effect { effect, method: Method::Newmark });
    let mut scene = tires(&[(0.0, 0.0)], 280.0);
    let pushed = try_run(&scene, &pushes(&[(0.0, 0.02)]), settings(Method::Newmark, 1e-3, None));
    assert_eq!(pushed, refused("push"));
    scene.damping = 0.05;
    assert_eq!(
        try_run(&scene, &fire(&[0], LAUNCH), settings(Method::Newmark, 1e-3, None)),
        refused("damping")
    );
    (scene.damping, scene.restitution) = (0.0, 0.3);
    let rebounding = try_run(&scene, &fire(&[0], LAUNCH), settings(Method::Newmark, 1e-3, None));
    assert_eq!(rebounding, refused("restitution"));
}

/// Pushes of a lone tire: the time of each firing and of its push [s].
fn pushes(times: &[(f64, f64)]) -> Shot {
    let push = |&(at, push): &(f64, f64)| Firing { push_time: push, ..Firing::up(at, 0, LAUNCH) };
    Shot::from_firings(times.iter().map(push).collect())
}

/// Pushed over τ with V₀/τ > g, a lone tire rises V₀²/2g − V₀ τ/2, whatever part of a step the push begins and ends in. The
/// push does the work m (V₀/τ) s over the way s = (V₀/τ − g) τ²/2, which the ledger holds exactly.
#[test]
fn a_push_over_a_time_lifts_as_its_integral() {
    let scene = tires(&[(0.0, 0.0)], 280.0);
    for push in [0.5e-3, 0.02, 0.0317, 0.1] {
        for at in [0.0, 0.000_73] {
            let height = LAUNCH * LAUNCH / (2.0 * GRAVITY) - 0.5 * LAUNCH * push;
            let way = 0.5 * (LAUNCH / push - GRAVITY) * push * push;
            for h in [4e-3, 1e-3] {
                let out = run(&scene, &pushes(&[(at, push)]), settings(Method::Verlet, h, None));
                close(out.height.value, height, 1e-9, &format!("{push} s at {h} s: height"));
                close(out.ledger.put_in, 280.0 * LAUNCH / push * way, 1e-6, "work of the push");
                assert!(out.ledger.residual() < 1e-9, "{:e}", out.ledger.residual());
            }
        }
    }
}

/// Two pushes that overlap add up: from the start of the second the acceleration is twice V₀/τ − g, and so on.
#[test]
fn pushes_that_overlap_add_up() {
    let (push, later) = (0.05, 0.02);
    let scene = tires(&[(0.0, 0.0)], 280.0);
    let (mut speed, mut height) = (0.0, 0.0);
    for (holes, time) in [(1.0, later), (2.0, push - later), (1.0, later)] {
        let acceleration = holes * LAUNCH / push - GRAVITY;
        height += speed * time + 0.5 * acceleration * time * time;
        speed += acceleration * time;
    }
    height += speed * speed / (2.0 * GRAVITY);
    let shot = pushes(&[(0.0, push), (later, push)]);
    for h in [3.3e-3, 1e-3] {
        let out = run(&scene, &shot, settings(Method::Verlet, h, None));
        close(out.height.value, height, 1e-9, "height");
        assert!(out.ledger.residual() < 1e-9, "{:e}", out.ledger.residual());
    }
}

/// Two free masses on a cable of damping ζ that is just taut, parting at v, pull with N(t) = v e^(−ζω₀t) (A cos ω_d t + B sin ω_d
/// t) until N is 0; A = c, B = (k − c ζ ω₀)/ω_d. The greatest force, and the speed at which they then meet, are within the
/// (ωh)²/8 = 0.02 % of undamped swings, and a little more.
#[test]
fn two_masses_on_a_damped_cable_swing_as_damped() {
    let (mass, speed) = (280.0, 2.0);
    for damping in [0.02, 0.05, 0.2, 0.7_f64] {
        let mut scene = tires(&[(0.0, 0.0), (2.0, 0.0)], mass);
        (scene.gravity, scene.friction, scene.damping) = (0.0, 0.0, damping);
        tie(&mut scene, 0, 1, 2e6, 1.0);
        let (k, reduced) = (scene.cables[0].stiffness, 0.5 * mass);
        let free = (k / reduced).sqrt();
        let (damped, c) = (free * (1.0 - damping * damping).sqrt(), 2.0 * damping * (k * reduced).sqrt());
        let (a, b) = (c, (k - c * damping * free) / damped);
        let force =
            |t: f64| speed * (-damping * free * t).exp() * (a * (damped * t).cos() + b * (damped * t).sin());
        let top = (damped * b - damping * free * a).atan2(damped * a + damping * free * b) / damped;
        let greatest = if damping >= 0.5 { c * speed } else { force(top) };
        let end = (std::f64::consts::PI - (a / b).atan()) / damped;
        // What the force leaves of the impulse, by Simpson's rule.
        let n = 2000;
        let weight = |i: usize| {
            if i == 0 || i == n {
                1.0
            } else if i % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        let impulse: f64 = (0..=n).map(|i| weight(i) * force(end * i as f64 / n as f64)).sum::<f64>() * end
            / (3.0 * n as f64);
        let after = speed - impulse / reduced;
        for step in [0.04 / free, 0.02 / free] {
            let launch = Vector3::x() * (0.5 * speed);
            let firing = |tire: usize, launch| Firing::at_once(0.0, tire, launch);
            let shot = Shot::from_firings(vec![firing(0, -launch), firing(1, launch)]);
            let mut path = Vec::new();
            let out = watch(&scene, &shot, settings(Method::Verlet, step, Some(1.5 * end)), |motion| {
                path.push((motion.time(), motion.displacement(1).x - motion.displacement(0).x));
            });
            let [(before, from), (later, to)] = [path[path.len() - 2], path[path.len() - 1]];
            let parted = (to - from) / (later - before);
            close(out.force.value, greatest, 5e-4 * greatest, &format!("{damping}: force"));
            close(parted, after, 5e-4 * speed, &format!("{damping}: speed after"));
            let dissipated = 0.5 * reduced * (speed * speed - after * after);
            close(out.ledger.dissipated, dissipated, 5e-3 * out.ledger.put_in, "dissipated");
            assert!(out.ledger.residual() < 1e-2, "{damping}: {:e}", out.ledger.residual());
        }
    }
}

/// A push of next to nothing, over the landing of a tire on damped cables, changes nothing: the landing is a jump of the velocity
/// all the same. The push puts in 2e-9 of the launch; a landing that is none puts the energy dissipated off by 6e-8.
#[test]
fn a_landing_under_a_push_is_a_landing() {
    let mut scene = tires(&[(0.0, 0.0), (1.65, 0.0), (3.3, 0.0)], 280.0);
    // The outer tires stay where they are, and the cables are taut wherever the middle one lands.
    (scene.damping, scene.friction) = (0.3, 5.0);
    tie(&mut scene, 0, 1, 1e5, 0.999);
    tie(&mut scene, 1, 2, 1e5, 0.999);
    let launch = Firing::at_once(0.0, 1, Vector3::new(0.5, 0.4, 3.0));
    let next_to_nothing = Firing { push_time: 2.0, ..Firing::up(1e-3, 1, 1e-9 * LAUNCH) };
    let [without, with] = [vec![launch], vec![launch, next_to_nothing]]
        .map(|firings| run(&scene, &Shot::from_firings(firings), settings(Method::Verlet, 1e-3, Some(1.5))));
    for (a, b) in [
        (without.height.value, with.height.value),
        (without.force.value, with.force.value),
        (without.drift.value, with.drift.value),
        (without.ledger.dissipated, with.ledger.dissipated),
    ] {
        close(b, a, 1e-8 * a, "a push of next to nothing");
    }
}

/// A hole fires under a tire on a cable that is already taut: the force jumps by c Δv at once, and no greater one is invented
/// beside it. Three tires in a row, no slack; the reference is an independent integrator at steps of 1 to 8 µs. Of such jumps the
/// error is of first order: 2.5 % at the first of these steps, 0.25 % at the last.
#[test]
fn a_launch_under_a_damped_taut_cable_invents_no_peak() {
    for (damping, force) in [(0.4, 36_765.0), (0.8, 62_720.0), (1.0, 76_720.0)] {
        let mut scene = tires(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0)], 280.0);
        scene.damping = damping;
        tie(&mut scene, 0, 1, 1.519e6, 1.0);
        tie(&mut scene, 1, 2, 1.519e6, 1.0);
        let tilted = LAUNCH * std::f64::consts::FRAC_1_SQRT_2 * Vector3::new(1.0, 0.0, 1.0);
        let later = Firing::at_once(0.06, 2, tilted);
        let shot = Shot::from_firings(vec![Firing::up(0.0, 1, LAUNCH), later]);
        for step in [1e-3, 2.5e-4, 6e-5] {
            let out = run(&scene, &shot, settings(Method::Verlet, step, None));
            close(out.force.value, force, (25.0 * step + 3e-3) * force, &format!("{damping} at {step} s"));
            assert!(out.ledger.residual() < 5e-3, "{damping}: {:e}", out.ledger.residual());
        }
    }
}

/// A damped cable between a tire and its mirror image forgets the motion of both.
#[test]
fn a_launch_beside_a_mirror_plane_is_that_of_the_whole_shelter() {
    let text = "shelter = { layout = \"grid\", rows = 3, columns = 4, spacing_m = 2 }\ntire = { mass_kg = 280 }\n\
                cable = { axial_stiffness_kn = 1500, breaking_force_kn = 900, damping_percent = 40 }\n\
                ground = { friction = 0.5 }\nlimits = { flight_height_m = 9, cable_safety_factor = 1 }\n\
                delay = [{ name = \"a\", interval_ms = 60 }]\n\
                [[blast_row]]\nname = \"1\"\nholes = [{ x_m = 0, y_m = 0, launch_m_s = 6 }, { x_m = 6, y_m = 0, launch_m_s = 6 }]\n\
                [[blast_row]]\nname = \"2\"\nholes = [{ x_m = 2, y_m = 0, launch_m_s = 6, tilt_deg = 45, tilt_toward_deg = 180 }, \
                { x_m = 4, y_m = 0, launch_m_s = 6, tilt_deg = 45, tilt_toward_deg = 0 }]\n";
    let half = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let mut whole = half.scene().clone();
    whole.mirrors.clear();
    assert!(half.model.modelled_tires(Method::Verlet, &half.shots[0]) < whole.tire_count());
    let [half, whole] =
        [half.scene(), &whole].map(|scene| run(scene, &half.shots[0], settings(Method::Verlet, 5e-4, None)));
    close(half.height.value, whole.height.value, 1e-9, "height");
    close(half.force.value, whole.force.value, 1e-6 * whole.force.value, "force");
}

/// A tire under a push on the ground that a cable pulls: the greatest force is that of an independent integrator, 1003.045 N,
/// and converges with the second order.
#[test]
fn pushes_on_the_ground_are_of_second_order() {
    let mut scene = tires(&[(0.0, 0.0), (2.0, 0.0)], 280.0);
    tie(&mut scene, 0, 1, 1.519e6, 1.0);
    let launch = Vector3::new(-1.2 * 60.0_f64.to_radians().sin(), 0.0, 1.2 * 60.0_f64.to_radians().cos());
    let shot = Shot::from_firings(vec![Firing { push_time: 0.2, ..Firing::at_once(0.0, 0, launch) }]);
    for (step, tolerance) in [(1e-3, 1e-2), (2.5e-4, 1e-3)] {
        let out = run(&scene, &shot, settings(Method::Verlet, step, None));
        close(out.force.value, 1003.045, tolerance, &format!("force at {step} s"));
    }
}

/// With each effect by itself, and with all, the displacements of five tires after 0.1 s, of which one is thrown up and four slide
/// round corners, differ from those of a run 32 times finer by O(h²) with `verlet`, by O(h) with `newmark`.
#[test]
fn every_effect_keeps_the_order_of_its_method() {
    let up = Firing::up(0.0, 4, LAUNCH);
    let tilted = Firing { launch: Vector3::new(1.5, 0.7, 5.8), ..up };
    let level = Vector2::zeros();
    for (name, methods, firing, downhill, damping) in [
        ("none", &METHODS[..], up, level, 0.0),
        ("tilt", &METHODS[..], tilted, level, 0.0),
        ("slope", &METHODS[..], up, Vector2::new(1.1, -2.3), 0.0),
        ("push", &METHODS[..1], Firing { push_time: 0.0231, ..up }, level, 0.0),
        ("damping", &METHODS[..1], up, level, 0.05),
        ("all", &METHODS[..1], Firing { push_time: 0.0231, ..tilted }, Vector2::new(1.1, -2.3), 0.05),
    ] {
        for &method in methods {
            let ends = |h: f64| {
                let mut scene = quincunx(1.5, 3e5);
                scene.mass = vec![60.0, 400.0, 900.0, 150.0, 280.0];
                (scene.downhill, scene.damping) = (downhill, damping);
                let mut ends = Vec::new();
                let shot = Shot::from_firings(vec![firing]);
                watch(&scene, &shot, settings(method, h, Some(0.1004)), |motion| {
                    if (motion.time() - 0.1).abs() < 0.5 * h {
                        ends = (0..5).map(|tire| motion.displacement(tire)).collect();
                    }
                });
                ends
            };
            let steps = [8e-4, 4e-4, 2e-4];
            let exact = ends(steps[2] / 32.0);
            let error = |h: f64| -> f64 {
                ends(h).iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
            };
            let errors = steps.map(error);
            let order = 0.5 * (errors[0] / errors[2]).log2();
            // A cable that becomes taut within a step of `newmark` pulls from the start of the step or from its end.
            let least = if method == Method::Verlet { 1.6 } else { 0.9 };
            assert!(order > least, "{name}, {method:?}: order {order} from {errors:?}");
        }
    }
}

/// A push weaker than gravity lifts nothing. Sideways it slides a tire only against the friction that is left, and what it
/// puts in is what friction takes.
#[test]
fn a_push_along_the_ground_slides_as_its_integral() {
    let (push, launch) = (0.5, Vector3::new(4.0, 0.0, 2.0));
    let shot = Shot::from_firings(vec![Firing { push_time: push, ..Firing::at_once(0.0, 0, launch) }]);
    let out = run(&tires(&[(0.0, 0.0)], 280.0), &shot, settings(Method::Verlet, 1e-3, None));
    let force = launch / push;
    let acceleration = force.x - 0.5 * (GRAVITY - force.z);
    let speed = acceleration * push;
    let way = 0.5 * speed * push + speed * speed / (2.0 * 0.5 * GRAVITY);
    assert_eq!(out.height.value, 0.0);
    close(out.drift.value, way, 1e-5, "way");
    close(
        out.ledger.dissipated,
        out.ledger.put_in,
        2e-3 * out.ledger.put_in,
        "friction takes what is put in",
    );
    assert!(out.ledger.residual() < 2e-3, "{:e}", out.ledger.residual());
}

/// A slope across a mirror plane takes the plane away; along it, half a shelter moves like the whole.
#[test]
fn a_slope_keeps_only_the_mirror_planes_along_it() {
    let text = "shelter = { layout = \"grid\", rows = 4, columns = 6, spacing_m = 1.5 }\ntire = { mass_kg = 280 }\n\
                cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60, slack_percent = 2 }\n\
                blast_row = [{ name = \"1\", under_row = 2, launch_m_s = 6 }, { name = \"2\", under_row = 3, launch_m_s = 6 }]\n\
                limits = { flight_height_m = 2, cable_safety_factor = 1 }\ndelay = [{ name = \"a\", interval_ms = 0 }]\n";
    let case = |ground: &str| {
        let plan = Plan::parse("", &format!("{text}ground = {{ friction = 0.5{ground} }}\n"));
        Case::new(plan.unwrap_or_else(|mistakes| panic!("{mistakes}")))
    };
    let modelled = |ground: &str| case(ground).modelled_tires(Method::Verlet);
    let level = modelled("");
    let along = modelled(", slope_percent = 20, slope_toward_deg = 270");
    let across = modelled(", slope_percent = 20, slope_toward_deg = 30");
    assert!(level < along && along < across, "{level} {along} {across}");
    assert_eq!(across, 24);
    // The same slope, with the plane across x and without any.
    let half = case(", slope_percent = 20, slope_toward_deg = 90");
    let mut scene = half.scene().clone();
    let whole = {
        scene.mirrors.clear();
        run(&scene, &half.shots[0], settings(Method::Verlet, 1e-3, None))
    };
    let half = run(half.scene(), &half.shots[0], settings(Method::Verlet, 1e-3, None));
    close(half.height.value, whole.height.value, 1e-9, "height");
    close(half.force.value, whole.force.value, 1e-6 * whole.force.value, "force");
}

/// Both methods converge to one another on a slope.
#[test]
fn methods_agree_on_a_slope() {
    let scene = on_slope(grid(4, 5, 1.5, 1.4e6), 0.25, 200.0);
    let shot = fire_rows(&[1, 2], 5, 0.02);
    let [verlet, newmark] = METHODS.map(|method| run(&scene, &shot, settings(method, 1e-4, Some(3.0))));
    close(verlet.height.value, newmark.height.value, 2e-3 * newmark.height.value, "height");
    close(verlet.force.value, newmark.force.value, 5e-3 * newmark.force.value, "force");
    // Tires that come to rest further down have less energy than at the start.
    let residuals = [verlet, newmark].map(|out| out.ledger.residual());
    assert!(residuals.iter().all(|&residual| residual < 2e-3), "{residuals:?}");
}

/// The plan of three rows as the prototype had it, with one option, and more keys in its sections.
fn three_rows(ground: &str, tire: &str, cable: &str, row: &str) -> Case {
    let mut text = format!(
        "shelter = {{ layout = \"grid\", rows = 5, columns = 10, spacing_m = 2.6 }}\n\
         tire = {{ mass_kg = 280, outer_diameter_m = 1.6{tire} }}\n\
         cable = {{ rope = \"GOST 2688-80 14\", slack_percent = 2{cable} }}\n\
         ground = {{ friction = 0.5{ground} }}\n\
         limits = {{ flight_height_m = 1.8, cable_safety_factor = 1.5 }}\n\
         delay = [{{ name = \"20 ms\", interval_ms = 20 }}]\n"
    );
    for n in 1..=3 {
        text += &format!("[[blast_row]]\nname = \"{n}\"\nunder_row = {n}\nlaunch_m_s = 6\n{row}\n");
    }
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// An independent prototype, semi-implicit at a step of 20 µs, gave these heights [m] and forces [kN]; they are met within
/// 0.5 % of height and 1 % of force.
#[test]
fn effects_are_those_of_an_independent_prototype() {
    let downhill =
        |percent: f64, toward: f64| format!(", slope_percent = {percent}, slope_toward_deg = {toward}");
    let cases = [
        ("base", three_rows("", "", "", ""), 1.7435, 63.95),
        ("ends 2 MN/m", three_rows("", "", ", end_stiffness_kn_m = 2000", ""), 1.7487, 24.48),
        ("ends 0.5 MN/m", three_rows("", "", ", end_stiffness_kn_m = 500", ""), 1.7521, 12.67),
        ("slope 10 % toward -y", three_rows(&downhill(10.0, 270.0), "", "", ""), 1.7485, 64.90),
        ("slope 30 % toward -y", three_rows(&downhill(30.0, 270.0), "", "", ""), 1.8073, 67.79),
        ("slope 30 % toward +y", three_rows(&downhill(30.0, 90.0), "", "", ""), 1.8294, 67.94),
        (
            "tilt 10 deg toward -y",
            three_rows("", "", "", "tilt_deg = 10\ntilt_toward_deg = 270"),
            1.6488,
            112.07,
        ),
        ("damping 2 %", three_rows("", "", ", damping_percent = 2", ""), 1.7505, 59.89),
        ("damping 5 %", three_rows("", "", ", damping_percent = 5", ""), 1.7552, 54.97),
        ("damping 20 %", three_rows("", "", ", damping_percent = 20", ""), 1.7589, 39.70),
        ("push over 10 ms", three_rows("", "", "", "push_ms = 10"), 1.7165, 63.31),
        ("push over 30 ms", three_rows("", "", "", "push_ms = 30"), 1.6625, 62.03),
        ("restitution 0.3", three_rows("", ", restitution = 0.3", "", ""), 1.7435, 63.95),
        ("restitution 0.6", three_rows("", ", restitution = 0.6", "", ""), 1.7435, 63.95),
    ];
    for (name, case, height, force) in cases {
        let compute = ComputeSettings { accuracy: Accuracy::Reference, ..ComputeSettings::of(&case.plan) };
        let checked =
            check_as_planned(&case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a result");
        close(checked.estimates.height.value, height, 5e-3 * height, &format!("{name}: height"));
        close(checked.estimates.force.value * 1e-3, force, 1e-2 * force, &format!("{name}: force"));
    }
}

/// Samples of `shelter effects`.
const FEW: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_VERDICT.seed);

/// Median of a quantity over so many samples of the only option [SI]; their number is odd.
fn median(case: &Case, compute: ComputeSettings, quantity: Quantity, samples: usize) -> f64 {
    let sampling = Sampling::exactly(samples, FEW.seed);
    let target = ShotToSample::new(case, &case.shots[0], compute, sampling);
    let drawn = run_shard(&[target], Shard::WHOLE, &StudyControl::default()).expect("samples");
    let mut values: Vec<f64> =
        drawn.into_iter().map(|(_, sample)| sample.expect("time for all").run.get(quantity)).collect();
    values.sort_by(f64::total_cmp);
    values[samples / 2]
}

/// Where no run succeeds nothing is known, and nothing may be left out.
#[test]
fn what_failed_runs_leave_open_is_required() {
    let case = three_rows("", "", "", "");
    let compute = ComputeSettings { step: Some(1.0), ..ComputeSettings::of(&case.plan) };
    let found = effects(&Context::new(&case, compute, &StudyControl::default()).with_sampling(FEW))
        .expect("a result")
        .value
        .remove(0);
    let found = found.expect("time for all");
    assert!(found.iter().all(|of| of.is_required() && of.is_missed_on_the_unsafe_side), "{found:?}");
}

/// Slack is a choice of this plan, and is compared with the plan without it; a slope is not, and is probed in four directions,
/// of which the hardest counts. Verdicts on the limits are those of `check`.
#[test]
fn effects_compare_plans_with_and_without_them() {
    let case = three_rows("", "", "", "");
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let found = effects(&Context::new(&case, compute, &StudyControl::default()).with_sampling(FEW))
        .expect("a result")
        .value
        .remove(0);
    let found = found.expect("time for all");
    let of = |effect: Effect| *found.iter().find(|of| of.effect == effect).expect("tried");
    assert!(!found.iter().any(|of| of.effect == Effect::Ballast), "the plan has none, and none is probed");
    let verdict = |case: &Case| {
        check_as_planned(case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a result").verdict
    };
    let mut plan = case.plan.clone();
    (plan.cable.slack_percent, plan.uncertainty.slack_percent) = (0.0, [0.0; 2]);
    let tight = Case::new(plan);
    let slack = of(Effect::Slack);
    assert_eq!((slack.value, slack.assumed), (2.0, false));
    let median_force = |case: &Case, samples: usize| median(case, compute, Quantity::Force, samples);
    let [with, without] = [&case, &tight].map(|case| median_force(case, slack.samples));
    assert_eq!(slack.change(Quantity::Force), with / without - 1.0);
    assert_eq!([slack.verdict_without, slack.verdict_with], [verdict(&tight), verdict(&case)]);
    let slope = of(Effect::Slope);
    let sloping = [0, 90, 180, 270].map(|toward| {
        let ground = format!(", slope_percent = 10, slope_toward_deg = {toward}");
        median_force(&three_rows(&ground, "", "", ""), slope.samples) / median_force(&case, slope.samples)
            - 1.0
    });
    assert_eq!((slope.value, slope.assumed), (10.0, true));
    let most = sloping.into_iter().fold(f64::NEG_INFINITY, f64::max);
    assert!(slope.change(Quantity::Force) == most, "{slope:?} {sloping:?}");
    // Yielding ends take more than half of the force: no median of an effect that matters is missed.
    assert!(of(Effect::Ends).is_required() && of(Effect::Ends).change(Quantity::Force) < -0.5);
    assert!(!of(Effect::Restitution).is_required(), "{:?}", of(Effect::Restitution));
}

/// Where the first samples leave no doubt whether a median changes by more than what is required, all samples say the same.
#[test]
fn effects_without_doubt_need_few_samples() {
    let case = three_rows("", "", "", "");
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let found = effects(&Context::new(&case, compute, &StudyControl::default()).with_sampling(FEW))
        .expect("a result")
        .value
        .remove(0);
    let found = found.expect("time for all");
    let with = [
        (Effect::Push, three_rows("", "", "", "push_ms = 20")),
        (Effect::Restitution, three_rows("", ", restitution = 0.3", "", "")),
        (Effect::Damping, three_rows("", "", ", damping_percent = 5", "")),
        (Effect::Ends, three_rows("", "", ", end_stiffness_kn_m = 2000", "")),
    ];
    let mut counts = Vec::new();
    for (effect, plan) in with {
        let of = found.iter().find(|of| of.effect == effect).expect("tried");
        counts.push(of.samples);
        for quantity in [Quantity::Height, Quantity::Force] {
            let [with, without] = [&plan, &case].map(|case| median(case, compute, quantity, SAMPLES));
            let of_all = with / without - 1.0;
            let is_large = |change: f64| change.abs() > LEAST_RELATIVE_CHANGE;
            let change = of.change(quantity);
            assert_eq!(
                is_large(change),
                is_large(of_all),
                "{effect:?}: {change} of {}, {of_all}",
                of.samples
            );
        }
    }
    assert!(counts.iter().all(|count| [FIRST_SAMPLES, SAMPLES].contains(count)), "{counts:?}");
    assert!(counts.contains(&FIRST_SAMPLES), "{counts:?}");
}

/// A force that ends at the breaking force keeps its limit, and yet the shot fails.
#[test]
fn cables_that_break_fail_with_an_effect_and_without() {
    let text = "shelter = { layout = \"grid\", rows = 1, columns = 2, spacing_m = 2.6 }\n\
                tire = { mass_kg = 280 }\nground = { friction = 0.5 }\n\
                cable = { axial_stiffness_kn = 1000, breaking_force_kn = 3, on_overload = \"break\" }\n\
                blast_row = [{ name = \"1\", under_row = 1, launch_m_s = 6, tilt_deg = 20 }]\n\
                limits = { flight_height_m = 3, cable_safety_factor = 1 }\n\
                delay = [{ name = \"a\", interval_ms = 42 }]\n";
    let text = text.edited("rows = 1, columns = 2", "rows = 2, columns = 1");
    let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let compute = ComputeSettings::of(&case.plan);
    assert_eq!(case.check_as_planned(0, &compute).expect("a result").verdict, Verdict::Fail);
    let found = effects(&Context::new(&case, compute, &StudyControl::default()).with_sampling(FEW))
        .expect("a result")
        .value
        .remove(0);
    let found = found.expect("time for all");
    let slope = found.iter().find(|of| of.effect == Effect::Slope).expect("tried");
    assert_eq!((slope.verdict_without, slope.verdict_with), (Verdict::Fail, Verdict::Fail));
}

/// Without samples the changes are those of the shots as planned.
#[test]
fn effects_of_the_shot_as_planned_alone() {
    let case = three_rows("", "", "", "");
    let compute = ComputeSettings::of(&case.plan);
    let found =
        effects(&Context::new(&case, compute, &StudyControl::default())).expect("a result").value.remove(0);
    let found = found.expect("time for all");
    let push = found.iter().find(|of| of.effect == Effect::Push).expect("tried");
    let pushed = three_rows("", "", "", "push_ms = 20");
    let [pushed, at_once] =
        [&pushed, &case].map(|case| case.check_as_planned(0, &compute).expect("a result"));
    // A screen ends at a coarser step than a check: its errors here are below 1 %.
    let change = pushed.estimates.height.value / at_once.estimates.height.value - 1.0;
    close(push.change(Quantity::Height), change, 1e-2, "height");
    assert!(change < -0.02, "{change}");
}

/// A slope under two tires that never pull at their cable moves hardly more than their drift; where that has a limit, the slope is
/// required.
#[test]
fn drift_counts_where_it_has_a_limit() {
    let case = |drift: &str| {
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 1, columns = 2, spacing_m = 2.6 }}\n\
             tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}\nground = {{ friction = 0.5 }}\n\
             cable = {{ axial_stiffness_kn = 1000, breaking_force_kn = 200, slack_percent = 40 }}\n\
             blast_row = [{{ name = \"1\", under_row = 1, launch_m_s = 6 }}]\n\
             limits = {{ flight_height_m = 3, cable_safety_factor = 1.5{drift} }}\n\
             delay = [{{ name = \"a\", interval_ms = 42 }}]\n"
        );
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    };
    let required = |case: Case| {
        let compute = ComputeSettings::of(&case.plan);
        let found = effects(&Context::new(&case, compute, &StudyControl::default()).with_sampling(FEW))
            .expect("a result")
            .value
            .remove(0);
        let found = found.expect("time for all");
        let slope = *found.iter().find(|of| of.effect == Effect::Slope).expect("tried");
        (slope.is_required(), slope.is_missed_on_the_unsafe_side)
    };
    assert_eq!(required(case(", drift_m = 0.8")), (true, true));
    assert!(!required(case("")).0);
}
