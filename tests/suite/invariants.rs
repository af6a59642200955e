//! What must hold whatever the shelter: balance, similarity, and changes that must change nothing.

use proptest::prelude::*;
use shelter::choice::Method;
use shelter::outcome::{EndReason, RunEnd};
use shelter::scene::{Cable, Firing, Shot};

use super::properties::{shelter, step};
use super::scenes::{GRAVITY, METHODS, fire, quincunx, run, settings, tires, watch};

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Without friction nothing pushes sideways but the cables, pairwise: the centre of mass stays above its place, to
    /// rounding. So does the moment of momentum about the vertical, which the method keeps as Σ m xₙ × xₙ₊₁.
    #[test]
    fn without_friction_momentum_stays_zero((mut scene, shot) in shelter()) {
        scene.friction = 0.0;
        let count = scene.mass.len();
        let centre = scene.position.iter().sum::<nalgebra::Vector3<f64>>() / count as f64;
        let whole: f64 = scene.mass.iter().sum();
        let mut before: Vec<_> = scene.position.iter().map(|p| p - centre).collect();
        let (mut shift, mut turn, mut size) = (0.0_f64, 0.0_f64, 1e-3_f64);
        watch(&scene, &shot, settings(Method::Verlet, step(&scene), Some(0.6)), |motion| {
            let now: Vec<_> =
                (0..count).map(|tire| scene.position[tire] - centre + motion.displacement(tire)).collect();
            let off: nalgebra::Vector3<f64> =
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

    /// Lengths × λ, times and launch velocities × √λ, masses and EA unchanged: heights × λ, forces unchanged. Rounding
    /// differs for λ that is no power of two, and a short run amplifies it little.
    #[test]
    fn similarity_holds_for_any_scale((scene, shot) in shelter(), scale in 0.1..10.0_f64) {
        let root = scale.sqrt();
        let mut large = scene.clone();
        large.position.iter_mut().for_each(|position| *position *= scale);
        for cable in &mut large.cables {
            cable.span *= scale;
            cable.rest_length *= scale;
            cable.stiffness /= scale;
        }
        let scaled = |f: &Firing| Firing { at: root * f.at, launch: root * f.launch, ..*f };
        let large_shot = Shot::from_firings(shot.firings.iter().map(scaled).collect());
        let h = step(&scene);
        let a = run(&scene, &shot, settings(Method::Verlet, h, Some(0.3)));
        let b = run(&large, &large_shot, settings(Method::Verlet, root * h, Some(root * 0.3)));
        prop_assert!((scale * a.height.value - b.height.value).abs() <= 1e-7 * (1e-3 + b.height.value));
        prop_assert!((a.force.value - b.force.value).abs() <= 1e-6 * (1.0 + a.force.value));
    }

    /// A cable so long that it never pulls changes nothing, to the last bit.
    #[test]
    fn a_cable_that_never_pulls_changes_nothing((scene, shot) in shelter()) {
        if scene.mass.len() < 2 {
            return Ok(());
        }
        let mut more = scene.clone();
        let span = scene.position[1] - scene.position[0];
        let slack = Cable { ends: [0, 1], rest_length: 1e6, stiffness: 1.0, span };
        more.cables.push(slack);
        let settings = settings(Method::Verlet, step(&scene), Some(0.6));
        let (a, b) = (run(&scene, &shot, settings), run(&more, &shot, settings));
        prop_assert_eq!(a.height, b.height);
        prop_assert_eq!(a.force, b.force);
    }

    /// A cable is the same as two beside each other with half its stiffness; each pulls half as much.
    #[test]
    fn two_halves_of_a_cable_are_the_cable((scene, shot) in shelter()) {
        let mut halves = scene.clone();
        halves.cables.iter_mut().for_each(|cable| cable.stiffness *= 0.5);
        halves.cables.extend(halves.cables.clone());
        for method in METHODS {
            let settings = settings(method, step(&scene), Some(0.4));
            let (a, b) = (run(&scene, &shot, settings), run(&halves, &shot, settings));
            prop_assert!((a.height.value - b.height.value).abs() < 1e-7 * (1e-3 + a.height.value), "{:?}", method);
            prop_assert!((a.force.value - 2.0 * b.force.value).abs() < 1e-6 * (1.0 + a.force.value), "{:?}", method);
        }
    }

    /// After the last hole no energy comes from anywhere: what the ledger calls dissipated only grows, and what is left
    /// in motion, height and cables is never more than was put in, beyond the error of the method.
    #[test]
    fn energy_never_grows_by_itself((scene, shot) in shelter()) {
        for method in METHODS {
            let short = run(&scene, &shot, settings(method, step(&scene), Some(0.7)));
            let long = run(&scene, &shot, settings(method, step(&scene), Some(1.4)));
            let error = 2e-2 * long.ledger.put_in;
            prop_assert!(long.ledger.dissipated >= short.ledger.dissipated - error, "{:?}", method);
            prop_assert!(long.ledger.dissipated <= long.ledger.put_in + error, "{:?}", method);
        }
    }

    /// Every number that comes out is one, and nothing moves before the first hole fires.
    #[test]
    fn all_is_finite_and_nothing_moves_beforehand((scene, shot) in shelter(), later in 0.01..2.0_f64) {
        let shot = Shot::from_firings(shot.firings.iter().map(|f| Firing { at: f.at + later, ..*f }).collect());
        let first = shot.firings[0].at;
        for method in METHODS {
            let mut early = 0.0_f64;
            let mut finite = true;
            let out = watch(&scene, &shot, settings(method, step(&scene), Some(later + 0.5)), |motion| {
                let most = (0..scene.mass.len()).map(|tire| motion.displacement(tire).norm()).fold(0.0, f64::max);
                finite &= most.is_finite();
                if motion.time() <= first {
                    early = early.max(most);
                }
            });
            prop_assert!(finite && out.height.value.is_finite() && out.force.value.is_finite());
            prop_assert!(out.height.at >= first || out.height.value == 0.0);
            prop_assert!(early <= 1e-12, "{:?}: {:e} m before the first hole", method, early);
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
        let RunEnd { at, reason } = ends[0];
        assert!(at <= duration);
        // The step after the landing finds the tire at rest.
        let expected = if duration < landing { EndReason::TimeLimit } else { EndReason::AtRest };
        assert!(reason == expected || (duration - landing).abs() < h, "{reason:?} after {duration} s");
    }
}
