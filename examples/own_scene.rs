//! Builds a shelter tire by tire, without a plan, and runs one shot: `cargo run --no-default-features --example own_scene`.

use std::error::Error;
use std::f64::consts::SQRT_2;
use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use shelter::choice::Method;
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};
use shelter::{Model, RunSettings};

/// Axial stiffness EA of every cable [N].
const AXIAL_STIFFNESS: f64 = 1.4e6;

fn main() -> Result<(), Box<dyn Error>> {
    // Four corners and a centre, 2 m from it.
    let side = 2.0 * SQRT_2;
    let places = [(0.0, 0.0), (side, 0.0), (0.0, side), (side, side), (0.5 * side, 0.5 * side)];
    let mut scene = Scene {
        position: places.map(|(x, y)| Vector3::new(x, y, 0.0)).to_vec(),
        mass: vec![280.0; places.len()],
        tire_ids: (1..=places.len()).map(TireId::Listed).collect(),
        cables: Vec::new(),
        friction: 0.5,
        gravity: 9.81,
        downhill: Vector2::zeros(),
        restitution: 0.0,
        damping: 0.0,
        breaking_force: None,
        strength: Vec::new(),
        mirrors: Vec::new(),
    };
    for [a, b] in [[0, 1], [0, 2], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4], [3, 4]] {
        let span = scene.position[b] - scene.position[a];
        let rest_length = span.norm();
        let stiffness = AXIAL_STIFFNESS / rest_length;
        scene.cables.push(Cable { ends: [a, b], rest_length, stiffness, span });
    }
    // One hole under the centre, fired at 0 s, launches it straight up with 6 m/s.
    let shot = Shot::from_firings(vec![Firing::up(0.0, 4, 6.0)]);
    let settings = RunSettings { method: Method::Verlet, step: 0.1 * scene.critical_step(), duration: None };
    let model = Model::new(scene);
    let outcome = model.run(&shot, &settings, &mut |_| ControlFlow::Continue(()))?;
    let (height, force) = (outcome.height.value, outcome.force.value);
    println!("height {height:.3} m, force {:.3} kN, at rest after {:.2} s", 1e-3 * force, outcome.end.time);
    Ok(())
}
