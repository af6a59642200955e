//! A second implementation of the model, as simple as can be, against the fast one on four hundred random shelters.
//!
//! Moreau's time stepping: every small step takes the velocities first, solves contact and friction of each tire as one
//! impulse, then moves. Cables stand in a dense matrix, nothing sleeps, nothing is mirrored, no landing has a time of its
//! own, no step is shared with the fast path. Its error is of first order; two steps, one half of the other, tell how large.

use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use shelter::choice::Method;
use shelter::scene::{Firing, Scene, Shot};

use super::support::scenes::{GRAVITY, run, settings, tie, tires};

/// Greatest height [m], greatest cable force [N], greatest horizontal shift at the end [m].
type Extremes = [f64; 3];

/// Simulated [s].
const DURATION: f64 = 0.5;
/// Steps of the coarser run of the simple implementation.
const STEPS: usize = 10_000;

/// Rest length [m] and stiffness [N/m] of the cable between two tires, and its vector at rest [m].
type Tie = Option<(f64, f64, Vector3<f64>)>;

fn simple(scene: &Scene, shot: &Shot, steps: usize) -> Extremes {
    let count = scene.tire_count();
    let mut cables: Vec<Vec<Tie>> = vec![vec![None; count]; count];
    for cable in &scene.cables {
        let [a, b] = cable.ends;
        cables[a][b] = Some((cable.rest_length, cable.stiffness, cable.span));
    }
    let h = DURATION / steps as f64;
    let (mut u, mut v) = (vec![Vector3::zeros(); count], vec![Vector3::zeros(); count]);
    let mut envelope = [0.0_f64; 3];
    let mut fired = 0;
    for n in 0..steps {
        let now = n as f64 * h;
        let mut force = vec![Vector3::zeros(); count];
        for a in 0..count {
            for b in 0..count {
                let Some((rest_length, stiffness, span)) = cables[a][b] else { continue };
                let line: Vector3<f64> = span + u[b] - u[a];
                let pull = stiffness * (line.norm() - rest_length).max(0.0);
                envelope[1] = envelope[1].max(pull);
                force[a] += line.normalize() * pull;
                force[b] -= line.normalize() * pull;
            }
        }
        while let Some(firing) = shot.firings.get(fired).filter(|firing| firing.time <= now) {
            v[firing.tire] += firing.launch;
            fired += 1;
        }
        for tire in 0..count {
            v[tire] += (force[tire] / scene.mass[tire] - Vector3::z() * GRAVITY) * h;
            // What the ground gives, so that the tire is not below it after the step.
            let normal = -(v[tire].z + u[tire].z / h);
            if normal > 0.0 {
                v[tire].z += normal;
                let sliding = v[tire].x.hypot(v[tire].y);
                let left = (sliding - scene.friction * normal).max(0.0);
                let share = if sliding > 0.0 { left / sliding } else { 0.0 };
                v[tire].x *= share;
                v[tire].y *= share;
            }
            u[tire] += v[tire] * h;
            envelope[0] = envelope[0].max(u[tire].z);
        }
    }
    envelope[2] = u.iter().map(|u| u.x.hypot(u.y)).fold(0.0, f64::max);
    envelope
}

/// Two to six tires anywhere, of any mass, tied at random, fired at random.
fn shelter(rng: &mut ChaCha8Rng) -> (Scene, Shot) {
    let count = rng.random_range(2..=6);
    let places: Vec<(f64, f64)> = (0..count)
        .map(|n| {
            (
                2.0 * f64::from(n % 3) + rng.random_range(-0.4..0.4),
                2.0 * f64::from(n / 3) + rng.random_range(-0.4..0.4),
            )
        })
        .collect();
    let mut scene = tires(&places, 280.0);
    scene.friction = rng.random_range(0.0..0.9);
    for mass in &mut scene.mass {
        *mass = rng.random_range(50.0..600.0);
    }
    let count = scene.tire_count();
    for a in 0..count {
        for b in a + 1..count {
            if rng.random_bool(0.6) {
                let axial_stiffness = 10_f64.powf(rng.random_range(4.5..6.0));
                tie(&mut scene, a, b, axial_stiffness, rng.random_range(1.0..1.06));
            }
        }
    }
    let firing = |rng: &mut ChaCha8Rng| {
        let (at, tire) = (rng.random_range(0.0..0.2), rng.random_range(0..count));
        let mut firing = Firing::up(at, tire, rng.random_range(1.0..7.0));
        if rng.random() {
            firing.launch.x = rng.random_range(-2.0..2.0);
            firing.launch.y = rng.random_range(-2.0..2.0);
        }
        firing
    };
    let firings = (0..rng.random_range(1..=3)).map(|_| firing(rng)).collect();
    (scene, Shot::from_firings(firings))
}

/// What the fast path gives lies within what two runs of the simple one leave open: four times the change from its last
/// halving of the step, which for a method of first order is four times the finer run's error, and a thousandth, because
/// landings between its steps make that error jump about. That is fine enough to see 2 % in friction, 0.5 % in stiffness
/// and 0.3 % in gravity: each, put into the simple one, fails in hundreds of shelters.
#[test]
fn the_fast_path_agrees_with_a_simple_one_on_four_hundred_shelters() {
    const SHELTERS: u64 = 400;
    let wrong: Vec<String> = (0..SHELTERS)
        .into_par_iter()
        .filter_map(|seed| {
            let (scene, shot) = shelter(&mut ChaCha8Rng::seed_from_u64(seed));
            let coarse = simple(&scene, &shot, STEPS);
            let fine = simple(&scene, &shot, 2 * STEPS);
            let step = (0.01 * scene.critical_step()).min(1e-4);
            let out = run(&scene, &shot, settings(Method::Verlet, step, Some(DURATION)));
            let fast = [out.height.value, out.force.value, out.drift.value];
            let floor = [1e-4, 1.0, 1e-4];
            let far = (0..3).find(|&n| {
                let open = 4.0 * (fine[n] - coarse[n]).abs();
                (fast[n] - fine[n]).abs() > open + floor[n] + 1e-3 * fine[n]
            });
            far.map(|n| format!("seed {seed}: fast {fast:?}, simple {coarse:?} then {fine:?} ({n})"))
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {SHELTERS}:\n{}", wrong.len(), wrong.join("\n"));
}
