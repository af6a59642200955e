//! Contact and friction: problems that other programs print with their answers, as far as masses, ties and one plane of ground
//! can express them.
//!
//! A spring is a mirrored pair of ties, of which always one pulls. A floor that yields is a slack tie.

use std::f64::consts::PI;

use nalgebra::{Vector2, Vector3};
use shelter::choice::Method;
use shelter::simulation::RunError;

use super::rig::{GRAVITY, History, Rig};

/// A mass rubs on the ground between two ties, 0.85 mm off its middle: 1 kg, 10⁴ N/m, μ 0.1, g 10 m/s² (Code_Aster V5.01.100).
pub mod friction_pad {
    use super::*;

    /// Turning points [m] after the start, one each π/100 s; at the last one the mass stays.
    pub const EXACT: [f64; 4] = [-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3];
    /// Time between two turning points [s].
    pub const EACH: f64 = PI / 100.0;

    /// Turning points: times [s] and places [m].
    pub fn turning_points(method: Method, step: f64) -> Result<Vec<[f64; 2]>, RunError> {
        let (start, stiffness) = (0.85e-3, 1e4);
        let mut rig = Rig::new(10.0, 0.1);
        let pad = rig.mass(1.0, Vector3::x() * start, Vector3::zeros());
        for side in [-1.0, 1.0] {
            let end = rig.anchor(Vector3::x() * side);
            rig.tie([end, pad], 1.0, stiffness);
        }
        let mut place = History::default();
        rig.run(method, step, 0.2, |motion| {
            place.0.push([motion.time(), start + motion.displacement(pad).x]);
        })?;
        Ok(place.turning_points())
    }
}

/// A mass on a spring runs into a stiffer one from its place at rest: 100 kg, 10⁴ and 10⁶ N/m, 1 m/s (Code_Aster V5.01.101).
pub mod bump_stop {
    use super::*;

    const MASS: f64 = 100.0;
    const SPRING: f64 = 1e4;
    const STOP: f64 = 1e6;

    /// What happens at the stop and after it.
    pub struct Shock {
        /// Greatest force of the stop [N].
        pub force: f64,
        /// Duration [s].
        pub duration: f64,
        /// Speed after it [m/s].
        pub speed: f64,
        /// Greatest way to the other side [m].
        pub swing: f64,
    }

    pub fn exact() -> Shock {
        let omega = ((SPRING + STOP) / MASS).sqrt();
        Shock { force: STOP / omega, duration: PI / omega, speed: 1.0, swing: (MASS / SPRING).sqrt() }
    }

    pub fn shock(method: Method, step: f64) -> Result<Shock, RunError> {
        let mut rig = Rig::new(GRAVITY, 0.0);
        let mass = rig.mass(MASS, Vector3::zeros(), Vector3::x());
        let [left, right] = [-1.0, 1.0].map(|side| rig.anchor(Vector3::x() * side));
        rig.tie([left, mass], 1.0, SPRING);
        rig.tie([right, mass], 1.0, SPRING);
        rig.tie([left, mass], 1.0, STOP);
        let (mut back, mut swing) = (History::default(), 0.0_f64);
        let outcome = rig.run(method, step, 0.3, |motion| {
            let place = motion.displacement(mass).x;
            back.0.push([motion.time(), -place]);
            swing = swing.max(-place);
        })?;
        let [duration, speed] = back.passage(0.0).unwrap_or([f64::NAN; 2]);
        Ok(Shock { force: outcome.force.value, duration, speed, swing })
    }
}

/// A mass falls 2 m onto a floor that yields: 1 kg, 100 N/m, thrown down with 1 m/s, g 10 m/s² (Code_Aster V5.01.108, A).
///
/// The floor is an anchor above, whose tie has 2 m of slack.
pub mod yielding_floor {
    use super::*;

    const STIFFNESS: f64 = 100.0;
    const GAP: f64 = 2.0;
    /// Of 1 kg [N]; gravity [m/s²].
    const WEIGHT: f64 = 10.0;

    /// What happens at the floor.
    pub struct Bounce {
        /// Time of contact [s].
        pub contact: f64,
        /// Speed at contact [m/s].
        pub speed: f64,
        /// Greatest force of the floor [N].
        pub force: f64,
        /// Time in contact [s].
        pub duration: f64,
    }

    pub fn exact() -> Bounce {
        let omega = STIFFNESS.sqrt();
        let speed = (1.0 + 2.0 * WEIGHT * GAP).sqrt();
        Bounce {
            contact: (speed - 1.0) / WEIGHT,
            speed,
            force: WEIGHT + WEIGHT.hypot(speed * omega),
            duration: 2.0 / omega * (PI - (speed * omega / WEIGHT).atan()),
        }
    }

    pub fn bounce(method: Method, step: f64) -> Result<Bounce, RunError> {
        let mut rig = Rig::upright(WEIGHT);
        let mass = rig.mass(1.0, Vector3::zeros(), -Vector3::y());
        let end = rig.anchor(Vector3::y());
        rig.tie([end, mass], 1.0 + GAP, STIFFNESS);
        let (mut fallen, mut back) = (History::default(), History::default());
        let outcome = rig.run(method, step, 1.2, |motion| {
            let (time, place) = (motion.time(), -motion.displacement(mass).y);
            fallen.0.push([time, place]);
            // The way back is the second half of the contact, which begins at 0.54 s and ends at 0.89 s.
            if time > 0.7 {
                back.0.push([time, -place]);
            }
        })?;
        let [contact, speed] = fallen.passage(GAP).unwrap_or([f64::NAN; 2]);
        let [leaves, _] = back.passage(-GAP).unwrap_or([f64::NAN; 2]);
        Ok(Bounce { contact, speed, force: outcome.force.value, duration: leaves - contact })
    }
}

/// A level force that moves a block up a slope: tan α 0.1, μ 0.3 (NAFEMS CGS-4). A tie pulls where the benchmark pushes.
pub mod block_on_slope {
    use super::*;

    const SLOPE: f64 = 0.1;
    const FRICTION: f64 = 0.3;

    /// Least force over the weight that moves the block.
    pub fn exact() -> f64 {
        (SLOPE + FRICTION) / (1.0 - SLOPE * FRICTION)
    }

    /// The same by bisection between 0.3 and 0.5, to 10⁻⁹.
    pub fn least_force(method: Method, step: f64) -> Result<f64, RunError> {
        let (mut holds, mut moves) = (0.3, 0.5);
        while moves - holds > 1e-9 {
            let force = 0.5 * (holds + moves);
            if is_moved_by(force, method, step)? {
                moves = force;
            } else {
                holds = force;
            }
        }
        Ok(0.5 * (holds + moves))
    }

    fn is_moved_by(force: f64, method: Method, step: f64) -> Result<bool, RunError> {
        let (mass, angle) = (100.0, SLOPE.atan());
        let mut rig = Rig::new(GRAVITY * angle.cos(), FRICTION);
        rig.scene.downhill = Vector2::x() * (-GRAVITY * angle.sin());
        let block = rig.mass(mass, Vector3::zeros(), Vector3::zeros());
        // Level, uphill: in the axes of the slope it leans into the ground.
        rig.pull(block, Vector3::new(angle.cos(), 0.0, -angle.sin()) * (force * mass * GRAVITY));
        let mut moved = false;
        rig.run(method, step, 10.0 * step, |motion| moved |= motion.displacement(block).x != 0.0)?;
        Ok(moved)
    }
}

/// A ball falls 1 m and bounces with a restitution of 0.7 (Reference FMUs of the Modelica Association, `BouncingBall`).
///
/// It is thrown up 1 m first, since every run begins on the ground. Only `verlet` has a restitution.
pub mod bouncing_ball {
    use super::*;

    const RESTITUTION: f64 = 0.7;
    const BOUNCES: usize = 4;

    /// Time [s] after the fall began and height [m] of the top of each bounce.
    pub fn exact() -> [[f64; 2]; BOUNCES] {
        let fall = (2.0 / GRAVITY).sqrt();
        let mut lands = fall;
        std::array::from_fn(|n| {
            let rise = fall * RESTITUTION.powi(n as i32 + 1);
            let top = [lands + rise, (rise / fall).powi(2)];
            lands += 2.0 * rise;
            top
        })
    }

    pub fn tops(step: f64) -> Result<Vec<[f64; 2]>, RunError> {
        let fall = (2.0 / GRAVITY).sqrt();
        let mut rig = Rig::new(GRAVITY, 0.5);
        rig.scene.restitution = RESTITUTION;
        let ball = rig.mass(1.0, Vector3::zeros(), Vector3::z() * (GRAVITY * fall));
        let mut height = History::default();
        rig.run(Method::Verlet, step, 3.0, |motion| {
            height.0.push([motion.time() - fall, motion.displacement(ball).z]);
        })?;
        let tops =
            height.turning_points().into_iter().filter(|[time, height]| *time > 0.1 * fall && *height > 0.01);
        Ok(tops.take(BOUNCES).collect())
    }
}
