//! Anchors: tires of infinite mass, which nothing moves.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use shelter::choice::Method;
use shelter::scene::{Firing, Mirror, Scene, Shot};
use shelter::simulation::Model;

use super::support::scenes::{GRAVITY, METHODS, close, fire, quincunx, run, settings, tie, tires, watch};

const MASS: f64 = 280.0;

/// A mass leaves its anchor at v, with the cable just taut: the anchor bears v √(k m) toward the mass after a quarter of a swing, the
/// cable is slack again after half of one, and the mass comes back at v.
#[test]
fn an_anchor_bears_the_snap_of_its_cable() {
    let (speed, stiffness, step) = (3.0, 1e5, 1e-4);
    let omega = (stiffness / MASS).sqrt();
    for method in METHODS {
        let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0)], MASS);
        (scene.gravity, scene.mass[0]) = (0.0, f64::INFINITY);
        tie(&mut scene, 0, 1, stiffness, 1.0);
        let launch = Firing::at_once(0.0, 1, Vector3::x() * speed);
        let cable = scene.cables[0];
        let model = Model::new(scene);
        let (mut greatest, mut slack_at, mut back) = (Vector3::zeros(), 0.0, 0.0);
        let settings = settings(method, step, Some(0.2));
        let outcome = model.run(&Shot::from_firings(vec![launch]), &settings, &mut |motion| {
            let ends = cable.ends.map(|end| motion.displacement(end));
            let pull = motion.force(0) * cable.between(ends).normalize();
            assert_eq!(motion.displacement(0), Vector3::zeros(), "{method:?}: an anchor stays");
            assert_eq!(motion.friction(0), (0.0, 0.0));
            if pull.x > greatest.x {
                greatest = pull;
            }
            if pull.x > 0.0 {
                (slack_at, back) = (motion.time(), motion.displacement(1).x);
            }
            ControlFlow::Continue(())
        });
        let outcome = outcome.expect("a run");
        let force = speed * (stiffness * MASS).sqrt();
        // The greatest value of steps lies up to (ωh/2)²/2 below the top, that of the outcome is a parabola's.
        let second_order = (omega * step).powi(2);
        close(outcome.force.value, force, second_order * force, "greatest force");
        assert!((greatest - Vector3::x() * force).norm() < second_order * force, "{method:?}: {greatest}");
        close(slack_at, PI / omega, 2.0 * step, "slack again");
        assert!(back < 2.0 * speed * step, "{method:?}: {back} m out as the cable goes slack");
        let end = speed * (PI / omega - outcome.end.time);
        close(outcome.drift.value, -end, speed * step, "comes back at its speed");
        let energy = 0.5 * MASS * speed * speed;
        close(outcome.ledger.put_in, energy, 1e-9 * energy, "energy put in");
        assert!(outcome.ledger.residual() < second_order, "{method:?}: {}", outcome.ledger.residual());
    }
}

/// An anchor is the limit of a heavy mass, and its damped cable has the viscosity of a mass on a wall.
#[test]
fn an_anchor_is_a_mass_without_end() {
    for (method, damping) in [(Method::Verlet, 0.0), (Method::Verlet, 0.1), (Method::Newmark, 0.0)] {
        let [anchored, heavy] = [f64::INFINITY, 1e15].map(|mass| {
            let mut scene = quincunx(2.65, 1.41e6);
            (scene.friction, scene.damping) = (1e9, damping);
            scene.mass[..4].fill(mass);
            run(&scene, &fire(&[4], 6.0), settings(method, 2e-4, Some(0.5)))
        });
        close(anchored.height.value, heavy.height.value, 1e-9, "height");
        close(anchored.force.value, heavy.force.value, 1e-9 * heavy.force.value, "force");
        assert_eq!(anchored.drift.value, 0.0, "{method:?}");
    }
}

/// Where the shelter slides down the slope, an anchor holds the mass that is tied to it: sin α m g less friction on its cable.
#[test]
fn an_anchor_holds_on_a_slope_on_which_all_else_slides() {
    let step = 1e-3;
    for method in METHODS {
        let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0), (2.0, 5.0)], MASS);
        scene.mass[0] = f64::INFINITY;
        scene.friction = 0.3;
        scene.downhill = Vector2::x() * GRAVITY;
        tie(&mut scene, 0, 1, 1e6, 1.0);
        let mut held = 0.0;
        let outcome =
            watch(&scene, &Shot::from_firings(Vec::new()), settings(method, step, Some(2.0)), |motion| {
                assert_eq!(motion.displacement(0), Vector3::zeros(), "{method:?}");
                held = motion.force(0);
            });
        // It stops anywhere in the cone of friction.
        let weight = MASS * GRAVITY;
        assert!((0.7..1.3).contains(&(held / weight)), "{method:?}: {held} N");
        assert_eq!(outcome.drift.index, 2, "{method:?}: the loose tire slides");
        let acceleration = 0.7 * GRAVITY;
        let slid = 0.5 * acceleration * 2.0 * 2.0;
        // The last step, of a motion that goes on, is of second order.
        close(outcome.drift.value, slid, acceleration * step * step, "its slide");
        let residual = outcome.ledger.greatest_residual;
        assert!(
            residual > 0.0 && residual < 1e-3 * weight * slid,
            "{method:?}: {residual} J; 0 counts nothing"
        );
    }
}

#[test]
fn a_hole_under_an_anchor_moves_nothing() {
    for method in METHODS {
        let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0)], MASS);
        scene.mass[0] = f64::INFINITY;
        tie(&mut scene, 0, 1, 1e6, 1.0);
        let outcome = run(&scene, &fire(&[0], 6.0), settings(method, 1e-3, None));
        let nothing = [outcome.height.value, outcome.force.value, outcome.drift.value, outcome.ledger.put_in];
        assert_eq!(nothing, [0.0; 4], "{method:?}");
    }
}

/// A quarter of the anchored cross, or half of it on a slope on which a loose tire slides, moves as the whole does: with anchors on
/// mirror planes and images of anchors.
#[test]
fn mirrored_anchors_are_anchors() {
    for downhill in [0.0, 6.0] {
        let mut scene = tires(&[(0.0, 0.0), (2.0, 0.0), (-2.0, 0.0), (0.0, 2.0), (0.0, -2.0)], MASS);
        (1..5).for_each(|end| {
            scene.mass[end] = f64::INFINITY;
            tie(&mut scene, 0, end, 1.4e6, 1.0);
        });
        scene.downhill = -Vector2::y() * downhill;
        let images = [[0, 2, 1, 3, 4], [0, 1, 2, 4, 3]].into_iter().zip(0..);
        let mirrors = images.map(|(image, axis)| Mirror { axis, image: image.to_vec() }).collect();
        let mirrored = Scene { mirrors, ..scene.clone() };
        let [whole, part] = [&scene, &mirrored].map(|scene| {
            let modelled = Model::new(scene.clone()).modelled_tires(Method::Verlet, &fire(&[0], 6.0));
            assert_eq!(modelled, 1, "only the tire in the middle is integrated");
            run(scene, &fire(&[0], 6.0), settings(Method::Verlet, 1e-4, Some(0.5)))
        });
        if downhill == 0.0 {
            // `docs/check-it-yourself.md`, with corners of ten thousand tonnes.
            close(whole.height.value, 0.4588, 5e-5, "height");
        }
        close(part.height.value, whole.height.value, 1e-12, "height of a part");
        close(part.force.value, whole.force.value, 1e-8, "force of a part");
        close(part.ledger.put_in, whole.ledger.put_in, 1e-9, "energy of a part");
        assert!(part.ledger.residual() < 1e-4, "{}", part.ledger.residual());
    }
}
