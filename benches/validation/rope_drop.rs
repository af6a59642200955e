//! A weight falls on a steel rope: 99.7 kg, 1.8 m of free fall, 2.74 m of rope of EA = 3.84 MN. A load cell of 1 kHz read 26.7 kN.
//!
//! The motion begins as the rope becomes taut, with the speed that the free fall gives.

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::scene::with_ends;
use shelter::simulation::RunError;

use super::rig::{GRAVITY, Rig};

const MASS: f64 = 99.7;
const FALL: f64 = 1.8;
const ROPE: f64 = 2.74;
/// Stiffness of the rope EA/L₀ [N/m].
const STIFFNESS: f64 = 3.84e6 / ROPE;
/// What the load cell read [N].
pub const MEASURED: f64 = 26.7e3;

/// Greatest force [N] with ends of this stiffness [N/m] at both sides of the rope, or rigid ones, without damping:
/// mg + √((mg)² + k m v²).
pub fn exact(end: Option<f64>) -> f64 {
    let weight = MASS * GRAVITY;
    weight + (weight * weight + with_ends(STIFFNESS, end) * MASS * 2.0 * GRAVITY * FALL).sqrt()
}

/// The same by `method`; `damping` is that of the rope with its ends over critical damping.
pub fn greatest_force(end: Option<f64>, damping: f64, method: Method, step: f64) -> Result<f64, RunError> {
    let mut rig = Rig::upright(GRAVITY);
    rig.scene.damping = damping;
    let weight = rig.mass(MASS, Vector3::zeros(), -Vector3::y() * (2.0 * GRAVITY * FALL).sqrt());
    let anchor = rig.anchor(Vector3::y() * ROPE);
    rig.tie([anchor, weight], ROPE, with_ends(STIFFNESS, end));
    Ok(rig.run(method, step, 0.1, |_| {})?.force.value)
}

/// Damping ratio that lowers the greatest force most, and that force [N].
pub fn best_damping(end: Option<f64>, step: f64) -> Result<(f64, f64), RunError> {
    let mut best = (0.0, f64::INFINITY);
    for damping in (0..=100).map(|n| 0.005 * f64::from(n)) {
        let force = greatest_force(end, damping, Method::Verlet, step)?;
        if force < best.1 {
            best = (damping, force);
        }
    }
    Ok(best)
}
