//! Shelters and shots near a given one: every number changed a little, the layout kept.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Cable, Firing, Scene, Shot};

/// Change of cable lengths over the change of all other inputs: inputs known to 1 % come with a slack known to 0.1 % of the
/// length of a cable.
const LENGTH: f64 = 0.1;

/// Shelter and shot number `number` near `scene` and `shot`. It is the same for any number of threads.
///
/// Every mass and every launch velocity, the axial stiffness of all cables, and friction change by factors drawn evenly from
/// 1 − `relative` to 1 + `relative`; the unstretched length of all cables changes by one factor within a tenth of that. A cable that is not
/// tight does not become tight. Positions, ties and firing times stay.
pub fn nearby(scene: &Scene, shot: &Shot, relative: f64, number: u64) -> (Scene, Shot) {
    let mut random = ChaCha8Rng::seed_from_u64(number);
    let mut factor = move |relative: f64| 1.0 + relative * (2.0 * random.random::<f64>() - 1.0);
    let [friction, axial_stiffness] = [factor(relative), factor(relative)];
    let length = factor(LENGTH * relative);
    let mass = scene.mass.iter().map(|mass| mass * factor(relative)).collect();
    let launched = |firing: &Firing| Firing { launch: firing.launch * factor(relative), ..*firing };
    let firings = shot.firings.iter().map(launched).collect();
    let cable = |cable: &Cable| {
        let span = cable.span.norm();
        let rest_length = (cable.rest_length * length).max(span.min(cable.rest_length));
        let stiffness = cable.stiffness * axial_stiffness * cable.rest_length / rest_length;
        Cable { rest_length, stiffness, ..*cable }
    };
    let near = Scene {
        mass,
        cables: scene.cables.iter().map(cable).collect(),
        friction: scene.friction * friction,
        mirrors: Vec::new(),
        ..scene.clone()
    };
    (near, Shot { firings, friction: shot.friction.map(|own| own * friction) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::TireId;
    use nalgebra::Vector3;

    /// Four tires in a square with slack cables, all fired.
    fn case() -> (Scene, Shot) {
        let place = |n: usize| Vector3::new((n % 2) as f64, (n / 2) as f64, 0.0);
        let cable = |ends: [usize; 2]| {
            let span = place(ends[1]) - place(ends[0]);
            let rest_length = 1.02 * span.norm();
            Cable { ends, rest_length, stiffness: 1e6 / rest_length, span }
        };
        let mut scene = Scene {
            position: (0..4).map(place).collect(),
            mass: vec![280.0; 4],
            tire: (1..=4).map(TireId::Listed).collect(),
            cables: [[0, 1], [0, 2], [1, 3], [2, 3]].map(cable).into(),
            friction: 0.5,
            gravity: 9.81,
            breaking_force: None,
            mirrors: Vec::new(),
        };
        scene.find_mirrors();
        let fire = |tire: usize| Firing::up(0.02 * tire as f64, tire, 6.0);
        (scene, Shot::from_firings((0..4).map(fire).collect()))
    }

    #[test]
    fn every_input_changes_within_the_bounds_and_the_layout_does_not() {
        let (scene, shot) = case();
        let shot = Shot { friction: Some(0.4), ..shot };
        let mut most = [0.0_f64; 5];
        for number in 0..200 {
            let (near, fired) = nearby(&scene, &shot, 0.01, number);
            let cables = || near.cables.iter().zip(&scene.cables);
            let changes: [Vec<f64>; 5] = [
                near.mass.iter().zip(&scene.mass).map(|(near, mass)| near / mass).collect(),
                fired.firings.iter().zip(&shot.firings).map(|(near, f)| near.launch.z / f.launch.z).collect(),
                cables()
                    .map(|(near, c)| near.stiffness * near.rest_length / (c.stiffness * c.rest_length))
                    .collect(),
                vec![near.friction / scene.friction, fired.friction.expect("its own friction") / 0.4],
                cables().map(|(near, c)| 1.0 + 10.0 * (near.rest_length / c.rest_length - 1.0)).collect(),
            ];
            for (most, changes) in most.iter_mut().zip(&changes) {
                *most = changes.iter().fold(*most, |most, change| most.max((change - 1.0).abs()));
            }
            let alike = |of: &[f64]| of.iter().all(|change| (change - of[0]).abs() < 1e-12);
            let all = changes.iter().map(|changes| alike(changes)).collect::<Vec<_>>();
            assert_eq!(all, [false, false, true, true, true]);
            assert!(near.mirrors.is_empty());
            assert_eq!((&near.position, near.gravity), (&scene.position, scene.gravity));
            assert!(cables().all(|(near, cable)| (near.ends, near.span) == (cable.ends, cable.span)));
            assert!(fired.firings.iter().zip(&shot.firings).all(|(n, f)| (n.at, n.tire) == (f.at, f.tire)));
            let again = nearby(&scene, &shot, 0.01, number);
            assert_eq!((again.0.mass, again.1), (near.mass, fired));
        }
        assert!(most.iter().all(|most| (0.009..=0.01 + 1e-12).contains(most)), "{most:?}");
    }

    #[test]
    fn cables_that_are_not_tight_stay_so() {
        let (mut scene, shot) = case();
        scene.cables.iter_mut().for_each(|cable| cable.rest_length = cable.span.norm());
        for number in 0..20 {
            let (near, _) = nearby(&scene, &shot, 0.01, number);
            assert!(near.cables.iter().all(|cable| cable.rest_length >= cable.span.norm()));
        }
    }
}
