//! Invariants over random small shelters, both methods.

use proptest::prelude::*;
use shelter::choice::Method;
use shelter::scene::{Firing, Scene, Shot};
use shelter::simulation::Model;
use std::ops::ControlFlow;

use crate::scenes::{METHODS, grid, run, settings, watch};

/// A random grid with random friction, slack, launches and firing times.
pub fn shelter() -> impl Strategy<Value = (Scene, Shot)> {
    let size = (1..4_usize, 2..5_usize);
    (size, 0.5..4.0, 5.0..7.0, 0.0..0.9, 1.0..1.06).prop_flat_map(
        |((rows, columns), spacing, ea, mu, slack)| {
            let tires = rows * columns;
            let firing =
                (0..tires, 0.0..0.3, 0.5..8.0).prop_map(|(tire, at, launch)| Firing { at, tire, launch });
            proptest::collection::vec(firing, 1..4).prop_map(move |firings| {
                let mut scene = grid(rows, columns, spacing, 10_f64.powf(ea));
                scene.friction = mu;
                for cable in &mut scene.cables {
                    cable.rest_length *= slack;
                    cable.stiffness /= slack;
                }
                (scene, Shot::from_firings(firings))
            })
        },
    )
}

pub fn step(scene: &Scene) -> f64 {
    (0.05 * scene.critical_step()).min(1e-3)
}

/// The same shelter with every place mapped and every tire renumbered.
fn mapped(
    scene: &Scene,
    shot: &Shot,
    order: &[usize],
    map: impl Fn(nalgebra::Vector3<f64>) -> nalgebra::Vector3<f64>,
) -> (Scene, Shot) {
    let mut new = scene.clone();
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Energy is neither made nor lost beyond the error of the method: of second order with the step used here, a
    /// twentieth of the critical one; (ωh)²/8 of it is 0.1 %, landings and slack add as much again.
    #[test]
    fn the_ledger_closes((scene, shot) in shelter()) {
        for method in METHODS {
            let out = run(&scene, &shot, settings(method, step(&scene), Some(1.5)));
            prop_assert!(out.ledger.residual() < 2e-2, "{:?} {:e}", method, out.ledger.residual());
            prop_assert!(out.ledger.dissipated >= -1e-9 * out.ledger.put_in);
        }
    }

    /// No tire is below the ground and friction is inside its cone, at every step.
    #[test]
    fn contact_holds_at_every_step((scene, shot) in shelter()) {
        for method in METHODS {
            let mut worst = (0.0_f64, 0.0_f64);
            watch(&scene, &shot, settings(method, step(&scene), Some(1.0)), |motion| {
                for tire in 0..scene.mass.len() {
                    let (friction, limit) = motion.friction(tire);
                    worst.0 = worst.0.min(motion.displacement(tire).z);
                    worst.1 = worst.1.max(friction - limit * (1.0 + 1e-9));
                }
            });
            prop_assert!(worst.0 >= -1e-12, "{:?} penetrates by {:e}", method, worst.0);
            prop_assert!(worst.1 <= 1e-9, "{:?} leaves the cone by {:e}", method, worst.1);
        }
    }

    /// All firing times later by T: the same result, later by T. Both start at the first firing, so only the rounding of
    /// the times themselves differs.
    #[test]
    fn shifted_firing_times_shift_the_result((scene, shot) in shelter(), later in 0.1..100.0_f64) {
        let shifted = Shot::from_firings(shot.firings.iter().map(|f| Firing { at: f.at + later, ..*f }).collect());
        let settings = settings(Method::Verlet, step(&scene), None);
        let (a, b) = (run(&scene, &shot, settings), run(&scene, &shifted, settings));
        // A hundred seconds round to 1e-14 s; chaos may amplify that over a long run.
        prop_assert!((a.height.value - b.height.value).abs() < 1e-6 * (1.0 + a.height.value));
        prop_assert!((a.height.at + later - b.height.at).abs() < 1e-3);
    }

    /// Mirrored and renumbered shelters give mirrored and renumbered results, up to the order of summation.
    #[test]
    fn mirror_and_renumbering_change_nothing((scene, shot) in shelter(), seed in any::<u64>()) {
        let n = scene.mass.len();
        let mut order: Vec<usize> = (0..n).collect();
        let mut state = seed | 1;
        for i in (1..n).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            order.swap(i, (state >> 33) as usize % (i + 1));
        }
        let (new, new_shot) = mapped(&scene, &shot, &order, |p| nalgebra::Vector3::new(-p.x, p.y, p.z));
        let settings = settings(Method::Verlet, step(&scene), Some(0.4));
        let (a, b) = (run(&scene, &shot, settings), run(&new, &new_shot, settings));
        prop_assert!((a.height.value - b.height.value).abs() < 1e-6 * (1.0 + a.height.value));
        prop_assert!((a.force.value - b.force.value).abs() < 1e-5 * (1.0 + a.force.value));
    }

    /// Lengths × 4, times and velocities × 2, masses and EA unchanged: heights × 4, forces unchanged, to the last bit,
    /// since powers of two round nothing.
    #[test]
    fn similarity_is_exact_for_powers_of_two((scene, shot) in shelter()) {
        let mut large = scene.clone();
        for position in &mut large.position {
            *position *= 4.0;
        }
        for cable in &mut large.cables {
            cable.span *= 4.0;
            cable.rest_length *= 4.0;
            cable.stiffness /= 4.0;
        }
        let scaled = |f: &Firing| Firing { at: 2.0 * f.at, launch: 2.0 * f.launch, ..*f };
        let large_shot = Shot::from_firings(shot.firings.iter().map(scaled).collect());
        let h = step(&scene);
        let a = run(&scene, &shot, settings(Method::Verlet, h, Some(0.8)));
        let b = run(&large, &large_shot, settings(Method::Verlet, 2.0 * h, Some(1.6)));
        prop_assert_eq!(4.0 * a.height.value, b.height.value);
        prop_assert_eq!(a.force.value, b.force.value);
    }

    /// Runs of one model share nothing that moves: in any order and on any thread they are the runs made alone.
    #[test]
    fn a_model_keeps_nothing_from_run_to_run((scene, shot) in shelter(), shift in 0.0..0.1) {
        let shots: Vec<Shot> = (0..6)
            .map(|n| {
                let later = |f: &Firing| Firing { at: f.at + n as f64 * shift * f.tire as f64, ..*f };
                Shot { friction: Some(0.1 * n as f64), ..Shot::from_firings(shot.firings.iter().map(later).collect()) }
            })
            .collect();
        for method in METHODS {
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

    /// A tire tied to nothing changes nothing.
    #[test]
    fn a_lone_tire_changes_nothing((scene, shot) in shelter()) {
        let mut more = scene.clone();
        more.position.push(nalgebra::Vector3::new(1e3, 0.0, 0.0));
        more.mass.push(77.0);
        more.tire.push(shelter::scene::TireId::Listed(99));
        let settings = settings(Method::Verlet, step(&scene), Some(0.5));
        let (a, b) = (run(&scene, &shot, settings), run(&more, &shot, settings));
        prop_assert_eq!(a.height, b.height);
        prop_assert_eq!(a.force, b.force);
    }
}
