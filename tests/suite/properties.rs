//! Random small shelters: balances that hold, scaled and mirrored shelters that move alike, and changes that change nothing.

use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use shelter::choice::Method;
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};
use shelter::simulation::Model;

use super::support::scenes::{METHODS, fire, grid, quincunx, run, settings, watch};

/// A random grid with random friction, slack, launches and firing times; some on a slope on which friction holds, some with
/// landings that rebound, some with damped cables, in all combinations. Some holes push over a time.
fn shelter() -> impl Strategy<Value = (Scene, Shot)> {
    let size = (1..4_usize, 2..5_usize);
    let slope = prop_oneof![2 => Just((0.0, 0.0)), 1 => (0.0..0.95, 0.0..std::f64::consts::TAU)];
    let seldom = |values: std::ops::Range<f64>| prop_oneof![2 => Just(0.0), 1 => values];
    let effects = (slope, seldom(0.0..0.9), seldom(0.0..1.0));
    (size, 0.5..4.0, 5.0..7.0, 0.0..0.9, 1.0..1.06, effects).prop_flat_map(
        |((rows, columns), spacing, ea, mu, slack, ((held, toward), restitution, damping))| {
            let tires = rows * columns;
            let push = prop_oneof![3 => Just(0.0), 1 => 1e-3..0.05];
            let firing = (0..tires, 0.0..0.3, 0.5..8.0, push).prop_map(|(tire, at, launch, push)| Firing {
                push_time: push,
                ..Firing::up(at, tire, launch)
            });
            proptest::collection::vec(firing, 1..4).prop_map(move |firings| {
                let mut scene = grid(rows, columns, spacing, 10_f64.powf(ea));
                (scene.friction, scene.restitution, scene.damping) = (mu, restitution, damping);
                scene.downhill = held * mu * scene.gravity * Vector2::new(toward.cos(), toward.sin());
                for cable in &mut scene.cables {
                    cable.rest_length *= slack;
                    cable.stiffness /= slack;
                }
                (scene, Shot::from_firings(firings))
            })
        },
    )
}

/// The methods that have the effects of a scene and a shot.
fn methods(scene: &Scene, shot: &Shot) -> &'static [Method] {
    let pushes = shot.firings.iter().any(|firing| firing.push_time > 0.0);
    if scene.restitution > 0.0 || scene.damping > 0.0 || pushes { &METHODS[..1] } else { &METHODS }
}

/// A twentieth of the critical step, 1 ms at most [s].
fn step(scene: &Scene) -> f64 {
    (0.05 * scene.critical_step()).min(1e-3)
}

/// The same shelter with every place mapped and every tire renumbered.
fn mapped(
    scene: &Scene,
    shot: &Shot,
    order: &[usize],
    map: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> (Scene, Shot) {
    let mut new = scene.clone();
    new.downhill = map(scene.downhill.push(0.0)).xy();
    for (old, &place) in order.iter().enumerate() {
        new.position[place] = map(scene.position[old]);
        new.mass[place] = scene.mass[old];
    }
    for cable in &mut new.cables {
        cable.ends = cable.ends.map(|end| order[end]);
        cable.span = map(cable.span);
    }
    let firings = shot.firings.iter().map(|f| Firing { tire: order[f.tire], ..*f }).collect();
    (new, Shot::from_firings(firings))
}

/// The shelter with lengths × `scale`, times and launch velocities × √`scale`, masses and EA unchanged.
fn scaled(scene: &Scene, shot: &Shot, scale: f64) -> (Scene, Shot) {
    let (mut large, root) = (scene.clone(), scale.sqrt());
    large.position.iter_mut().for_each(|position| *position *= scale);
    for cable in &mut large.cables {
        cable.span *= scale;
        cable.rest_length *= scale;
        cable.stiffness /= scale;
    }
    let firing = |f: &Firing| Firing {
        time: root * f.time,
        launch: root * f.launch,
        push_time: root * f.push_time,
        ..*f
    };
    (large, Shot::from_firings(shot.firings.iter().map(firing).collect()))
}

/// The shot with every firing `later` [s].
fn delayed(shot: &Shot, later: f64) -> Shot {
    Shot::from_firings(shot.firings.iter().map(|f| Firing { time: f.time + later, ..*f }).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Energy is neither made nor lost beyond the error of the method: of second order with the step used here, a
    /// twentieth of the critical one; (ωh)²/8 of it is 0.1 %, landings and slack add as much again. After the last hole no
    /// energy comes from anywhere: what the ledger calls dissipated only grows, and never exceeds what was put in.
    #[test]
    fn the_ledger_closes_and_energy_never_grows_by_itself((scene, shot) in shelter()) {
        for &method in methods(&scene, &shot) {
            let short = run(&scene, &shot, settings(method, step(&scene), Some(0.7)));
            let long = run(&scene, &shot, settings(method, step(&scene), Some(1.5)));
            prop_assert!(long.ledger.residual() < 2e-2, "{:?} {:e}", method, long.ledger.residual());
            prop_assert!(long.ledger.dissipated >= -1e-9 * long.ledger.put_in);
            let error = 2e-2 * long.ledger.put_in;
            prop_assert!(long.ledger.dissipated >= short.ledger.dissipated - error, "{:?}", method);
            // On a slope tires lose height, too.
            let level = scene.downhill == Vector2::zeros();
            prop_assert!(!level || long.ledger.dissipated <= long.ledger.put_in + error, "{:?}", method);
        }
    }

    /// At every step every number is finite, no tire is below the ground and friction is inside its cone; and nothing moves
    /// before the first hole fires.
    #[test]
    fn contact_holds_at_every_step_and_nothing_moves_beforehand((scene, shot) in shelter(), later in 0.01..2.0_f64) {
        let shot = delayed(&shot, later);
        let first = shot.firings[0].time;
        for &method in methods(&scene, &shot) {
            let (mut lowest, mut outside_cone, mut early, mut finite) = (0.0_f64, 0.0_f64, 0.0_f64, true);
            let out = watch(&scene, &shot, settings(method, step(&scene), Some(later + 1.0)), |motion| {
                for tire in 0..scene.tire_count() {
                    let (friction, limit) = motion.friction(tire);
                    let displacement = motion.displacement(tire);
                    finite &= displacement.norm().is_finite() && friction.is_finite() && limit.is_finite();
                    lowest = lowest.min(displacement.z);
                    outside_cone = outside_cone.max(friction - limit * (1.0 + 1e-9));
                    if motion.time() <= first {
                        early = early.max(displacement.norm());
                    }
                }
            });
            prop_assert!(finite && out.height.value.is_finite() && out.force.value.is_finite());
            prop_assert!(lowest >= -1e-12, "{:?} penetrates by {:e}", method, lowest);
            // Friction is the change of a velocity, up to some 10 m/s, over a step: its rounding is that of the velocity times m/h.
            let heaviest = scene.mass.iter().copied().fold(0.0, f64::max);
            let rounding = 1e-9 + 4.0 * f64::EPSILON * 10.0 * heaviest / step(&scene);
            prop_assert!(outside_cone <= rounding, "{:?} leaves the cone by {:e}", method, outside_cone);
            prop_assert!(out.height.time >= first || out.height.value == 0.0);
            prop_assert!(early <= 1e-12, "{:?}: {:e} m before the first hole", method, early);
        }
    }

    /// Without friction nothing pushes sideways but the cables, pairwise: the centre of mass stays above its place, to
    /// rounding. So does the moment of momentum about the vertical, which the method keeps as Σ m xₙ × xₙ₊₁.
    #[test]
    fn without_friction_momentum_stays_zero((mut scene, shot) in shelter()) {
        (scene.friction, scene.downhill) = (0.0, Vector2::zeros());
        let count = scene.tire_count();
        let centre = scene.position.iter().sum::<Vector3<f64>>() / count as f64;
        let whole: f64 = scene.mass.iter().sum();
        let mut before: Vec<_> = scene.position.iter().map(|p| p - centre).collect();
        let (mut shift, mut turn, mut size) = (0.0_f64, 0.0_f64, 1e-3_f64);
        watch(&scene, &shot, settings(Method::Verlet, step(&scene), Some(0.6)), |motion| {
            let now: Vec<_> =
                (0..count).map(|tire| scene.position[tire] - centre + motion.displacement(tire)).collect();
            let off: Vector3<f64> =
                (0..count).map(|tire| scene.mass[tire] * motion.displacement(tire)).sum();
            shift = shift.max(off.xy().norm() / whole);
            let moment = |tire: usize| scene.mass[tire] * before[tire].xy().perp(&now[tire].xy());
            turn = turn.max((0..count).map(moment).sum::<f64>().abs());
            size = size.max((0..count).map(|tire| scene.mass[tire] * now[tire].xy().norm_squared()).sum());
            before = now;
        });
        prop_assert!(shift < 1e-11, "the centre of mass moves by {shift:e} m");
        prop_assert!(turn < 1e-11 * size, "a moment of {turn:e} of {size:e} kg m²");
    }

    /// All firing times later by T: the same result, later by T. Both start at the first firing, so only the rounding of
    /// the times themselves differs.
    #[test]
    fn shifted_firing_times_shift_the_result((scene, shot) in shelter(), later in 0.1..100.0_f64) {
        let shifted = delayed(&shot, later);
        let settings = settings(Method::Verlet, step(&scene), None);
        let (a, b) = (run(&scene, &shot, settings), run(&scene, &shifted, settings));
        // A hundred seconds round to 1e-14 s; chaos may amplify that over a long run.
        prop_assert!((a.height.value - b.height.value).abs() < 1e-6 * (1.0 + a.height.value));
        prop_assert!((a.height.time + later - b.height.time).abs() < 1e-3);
    }

    /// Mirrored and renumbered shelters give mirrored and renumbered results, up to the order of summation.
    #[test]
    fn mirror_and_renumbering_change_nothing((scene, shot) in shelter(), seed in any::<u64>()) {
        let n = scene.tire_count();
        let mut order: Vec<usize> = (0..n).collect();
        let mut state = seed | 1;
        for i in (1..n).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            order.swap(i, (state >> 33) as usize % (i + 1));
        }
        let (new, new_shot) = mapped(&scene, &shot, &order, |p| Vector3::new(-p.x, p.y, p.z));
        let settings = settings(Method::Verlet, step(&scene), Some(0.4));
        let (a, b) = (run(&scene, &shot, settings), run(&new, &new_shot, settings));
        prop_assert!((a.height.value - b.height.value).abs() < 1e-6 * (1.0 + a.height.value));
        prop_assert!((a.force.value - b.force.value).abs() < 1e-5 * (1.0 + a.force.value));
    }

    /// A scaled shelter moves alike: heights × `scale`, forces unchanged. For 4 to the last bit, since powers of two round
    /// nothing; for any scale up to rounding, which a short run amplifies little.
    #[test]
    fn scaled_shelters_move_alike((scene, shot) in shelter(), scale in 0.1..10.0_f64) {
        let envelopes = |scale: f64, duration: f64| {
            let (large, large_shot) = scaled(&scene, &shot, scale);
            let (h, root) = (step(&scene), scale.sqrt());
            let a = run(&scene, &shot, settings(Method::Verlet, h, Some(duration)));
            let b = run(&large, &large_shot, settings(Method::Verlet, root * h, Some(root * duration)));
            ([scale * a.height.value, a.force.value], [b.height.value, b.force.value])
        };
        let (expected, found) = envelopes(4.0, 0.8);
        prop_assert_eq!(expected, found);
        let (expected, found) = envelopes(scale, 0.3);
        prop_assert!((expected[0] - found[0]).abs() <= 1e-7 * (1e-3 + found[0]));
        prop_assert!((expected[1] - found[1]).abs() <= 1e-6 * (1.0 + expected[1]));
    }

    /// Runs of one model share nothing that moves: in any order and on any thread they are the runs made alone.
    #[test]
    fn a_model_keeps_nothing_from_run_to_run((scene, shot) in shelter(), shift in 0.0..0.1) {
        let shots: Vec<Shot> = (0..6)
            .map(|n| {
                let later = |f: &Firing| Firing { time: f.time + n as f64 * shift * f.tire as f64, ..*f };
                Shot { friction: Some(0.1 * n as f64), ..Shot::from_firings(shot.firings.iter().map(later).collect()) }
            })
            .collect();
        for &method in methods(&scene, &shot) {
            let settings = settings(method, step(&scene), Some(0.6));
            let model = Model::new(scene.clone());
            let go = |shot: &Shot| model.run(shot, &settings, &mut |_| ControlFlow::Continue(()));
            let together: Vec<_> = std::thread::scope(|scope| {
                let threads: Vec<_> = shots.iter().rev().map(|shot| scope.spawn(move || go(shot))).collect();
                threads.into_iter().rev().map(|thread| thread.join().expect("no panic")).collect()
            });
            for (shot, together) in shots.iter().zip(together) {
                let scene = Scene { friction: shot.friction.unwrap_or(0.0), ..scene.clone() };
                prop_assert_eq!(Ok(run(&scene, &Shot { friction: None, ..shot.clone() }, settings)), together);
            }
        }
    }

    /// Neither a tire tied to nothing nor a cable so long that it never pulls changes anything, to the last bit.
    #[test]
    fn what_takes_no_part_changes_nothing((scene, shot) in shelter()) {
        let mut lone = scene.clone();
        lone.position.push(Vector3::new(1e3, 0.0, 0.0));
        lone.mass.push(77.0);
        lone.tire_ids.push(TireId::Listed(99));
        let mut slack = scene.clone();
        let span = scene.position[1] - scene.position[0];
        slack.cables.push(Cable { ends: [0, 1], rest_length: 1e6, stiffness: 1.0, span });
        let settings = settings(Method::Verlet, step(&scene), Some(0.6));
        let out = run(&scene, &shot, settings);
        for more in [lone, slack] {
            let other = run(&more, &shot, settings);
            prop_assert_eq!(out.height, other.height);
            prop_assert_eq!(out.force, other.force);
        }
    }

    /// A cable is the same as two beside each other with half its stiffness; each pulls half as much.
    #[test]
    fn two_halves_of_a_cable_are_the_cable((scene, shot) in shelter()) {
        let mut halves = scene.clone();
        halves.cables.iter_mut().for_each(|cable| cable.stiffness *= 0.5);
        // Critical damping grows with the root of the stiffness.
        halves.damping *= 0.5_f64.sqrt();
        halves.cables.extend(halves.cables.clone());
        for &method in methods(&scene, &shot) {
            let settings = settings(method, step(&scene), Some(0.4));
            let (a, b) = (run(&scene, &shot, settings), run(&halves, &shot, settings));
            prop_assert!((a.height.value - b.height.value).abs() < 1e-7 * (1e-3 + a.height.value), "{:?}", method);
            prop_assert!((a.force.value - 2.0 * b.force.value).abs() < 1e-6 * (1.0 + a.force.value), "{:?}", method);
        }
    }

    /// One tire over four heavy corners, where the balance of energy proves it: more launch, more mass or more slack never
    /// lower the flight, more stiffness never raises it; more launch or more mass never lower the force. The tolerance is
    /// the error of the step.
    #[test]
    fn a_pinned_cross_is_monotone(
        (launch, mass, ea, slack) in (2.0..9.0_f64, 50.0..500.0_f64, 5.0..6.5_f64, 1.0..1.1_f64),
        more in 1.02..1.5_f64,
    ) {
        let envelope = |launch: f64, mass: f64, ea: f64, slack: f64| {
            let mut scene = quincunx(1.5, ea);
            scene.friction = 1e6;
            scene.mass[..4].fill(1e9);
            scene.mass[4] = mass;
            for cable in &mut scene.cables {
                cable.rest_length *= slack;
                cable.stiffness /= slack;
            }
            let h = (0.02 * scene.critical_step()).min(2e-4);
            let out = run(&scene, &fire(&[4], launch), settings(Method::Verlet, h, Some(1.0)));
            (out.height.value, out.force.value)
        };
        let ea = 10_f64.powf(ea);
        let (height, force) = envelope(launch, mass, ea, slack);
        let least = |value: f64| value * (1.0 - 2e-3);
        let (faster, heavier) = (envelope(launch * more, mass, ea, slack), envelope(launch, mass * more, ea, slack));
        prop_assert!(faster.0 >= least(height) && faster.1 >= least(force));
        prop_assert!(heavier.0 >= least(height) && heavier.1 >= least(force));
        prop_assert!(envelope(launch, mass, ea, slack * (1.0 + 0.1 * (more - 1.0))).0 >= least(height));
        prop_assert!(least(envelope(launch, mass, ea * more, slack).0) <= height);
    }
}
