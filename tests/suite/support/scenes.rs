//! Scenes for tests, built without the plan reader.

use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use shelter::choice::Method;
use shelter::outcome::Outcome;
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};
use shelter::simulation::{Model, Motion, RunError, RunSettings};

pub const GRAVITY: f64 = 9.81;
pub const METHODS: [Method; 2] = [Method::Verlet, Method::Newmark];

/// Tires at `places` [m], all of `mass` [kg], with μ = 0.5 and no cable.
pub fn tires(places: &[(f64, f64)], mass: f64) -> Scene {
    Scene {
        position: places.iter().map(|&(x, y)| Vector3::new(x, y, 0.0)).collect(),
        mass: vec![mass; places.len()],
        tire_ids: (1..=places.len()).map(TireId::Listed).collect(),
        cables: Vec::new(),
        friction: 0.5,
        gravity: GRAVITY,
        downhill: Vector2::zeros(),
        restitution: 0.0,
        damping: 0.0,
        breaking_force: None,
        strength: Vec::new(),
        mirrors: Vec::new(),
    }
}

/// Ties two tires with a cable of stiffness EA [N], `slack` times as long as their distance.
pub fn tie(scene: &mut Scene, a: usize, b: usize, axial_stiffness: f64, slack: f64) {
    let span = scene.position[b] - scene.position[a];
    let rest_length = span.norm() * slack;
    let stiffness = axial_stiffness / rest_length;
    scene.cables.push(Cable { ends: [a, b], rest_length, stiffness, span });
}

/// A grid with all links, row by row; index `row × columns + column`.
pub fn grid(rows: usize, columns: usize, spacing: f64, axial_stiffness: f64) -> Scene {
    let place = |n: usize| ((n % columns) as f64 * spacing, (n / columns) as f64 * spacing);
    let mut scene = tires(&(0..rows * columns).map(place).collect::<Vec<_>>(), 280.0);
    for row in 0..rows {
        for column in 0..columns {
            let at = row * columns + column;
            let neighbours = [(0, 1), (1, -1), (1, 0), (1, 1)];
            for (down, right) in neighbours {
                let (r, c) = (row + down, column as isize + right);
                if r < rows && (0..columns as isize).contains(&c) {
                    tie(&mut scene, at, r * columns + c as usize, axial_stiffness, 1.0);
                }
            }
        }
    }
    scene
}

/// The source paper's five tires: corners 0 to 3, centre 4, diagonal [m], EA [N].
pub fn quincunx(diagonal: f64, axial_stiffness: f64) -> Scene {
    let side = diagonal * std::f64::consts::SQRT_2;
    let corners = [(0.0, 0.0), (side, 0.0), (0.0, side), (side, side)];
    let centre = (0.5 * side, 0.5 * side);
    let mut scene = tires(&[corners[0], corners[1], corners[2], corners[3], centre], 280.0);
    for (a, b) in [(0, 1), (0, 2), (1, 3), (2, 3), (0, 4), (1, 4), (2, 4), (3, 4)] {
        tie(&mut scene, a, b, axial_stiffness, 1.0);
    }
    scene
}

/// Tires fired at once with `launch` [m/s].
pub fn fire(tires: &[usize], launch: f64) -> Shot {
    Shot::from_firings(tires.iter().map(|&tire| Firing::up(0.0, tire, launch)).collect())
}

/// Rows (from 0) of a grid fired one after another, `interval` [s] apart, with 6 m/s.
pub fn fire_rows(rows: &[usize], columns: usize, interval: f64) -> Shot {
    let row = |(turn, &row): (usize, &usize)| {
        (row * columns..(row + 1) * columns).map(move |tire| Firing::up(turn as f64 * interval, tire, 6.0))
    };
    Shot::from_firings(rows.iter().enumerate().flat_map(row).collect())
}

pub fn settings(method: Method, step: f64, duration: Option<f64>) -> RunSettings {
    RunSettings { method, step, duration }
}

pub fn run(scene: &Scene, shot: &Shot, settings: RunSettings) -> Outcome {
    try_run(scene, shot, settings).expect("the run has an outcome")
}

pub fn try_run(scene: &Scene, shot: &Shot, settings: RunSettings) -> Result<Outcome, RunError> {
    Model::new(scene.clone()).run(shot, &settings, &mut |_| ControlFlow::Continue(()))
}

/// Runs and shows every step to `see`.
pub fn watch(scene: &Scene, shot: &Shot, settings: RunSettings, mut see: impl FnMut(&dyn Motion)) -> Outcome {
    let watched = Model::new(scene.clone()).run(shot, &settings, &mut |motion| {
        see(motion);
        ControlFlow::Continue(())
    });
    watched.expect("the run has an outcome")
}

/// Asserts |value − exact| ≤ tolerance, naming the case.
#[track_caller]
pub fn close(value: f64, exact: f64, tolerance: f64, case: &str) {
    let error = (value - exact).abs();
    assert!(error <= tolerance, "{case}: {value} is {error:e} from {exact}, more than {tolerance:e}");
}
