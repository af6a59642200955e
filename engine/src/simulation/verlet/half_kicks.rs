//! The two halves of a kick and the friction in them, for a tire that is integrated through its step by itself.
//!
//! The kick of a register ([`super::kick`]) takes the velocity from tₙ₋½ to tₙ₊½ at once. A tire with an event in the step needs
//! its velocity at tₙ, where the step begins. At the end, it must have a velocity at mid-step again, from which the next kick
//! starts:
//!
//! 1. **First half**, tₙ₋½ to tₙ ([`TireAtStep::new`]): the velocity at tₙ is the mean of the velocities before and after the kick.
//! 2. **Second half**, tₙ to tₙ₊½: left out. [`TireStep`] integrates from tₙ to tₙ₊₁; the tire lands, slides and sticks at its own
//!    times.
//! 3. **Back** to tₙ₊½ ([`TireAtStep::mid_step_velocity`]): the velocity at tₙ₊₁ less half a step of the last acceleration.
//!
//! Friction dissipates energy in both halves, and the kick at tₙ books both. These rules keep energy from being booked twice:
//!
//! 4. `lost` of [`TireStep`] is all energy that friction and landings take from tₙ to tₙ₊₁.
//! 5. The kick at tₙ has already booked its second half ([`TireAtStep::booked`]).
//! 6. The kick at tₙ₊₁ will book its first half again ([`TireAtStep::next_half`]).
//!
//! **The exception is a push.** The kick of a register knows no push. In the air that is right: the velocity at mid-step holds what
//! the push adds until the step ends. On the ground, friction under a push differs from the friction of the kick. There the first
//! half is made anew, from the velocity at mid-step with the push. The energy that the kick has booked is taken off, and 5 and 6
//! are 0.

use nalgebra::Vector3;
use pulp::Scalar;

use super::kick::{MovedRegister, TireRegister};
use crate::simulation::contact::{TireStep, stop_at_ground};
use crate::simulation::pack::Wide;

/// A tire at the start tₙ of the step through which it is integrated by itself.
#[derive(Clone, Copy, Debug)]
pub struct TireAtStep {
    /// Displacement [m].
    pub displacement: Vector3<f64>,
    /// Velocity [m/s].
    pub velocity: Vector3<f64>,
    /// Acceleration by cables and gravity, without the ground and pushes [m/s²].
    pub free: Vector3<f64>,
    /// Square of the velocity less square of the kick's mean velocity [m²/s²]; 0 except on the ground under a push.
    pub more_speed2: f64,
    /// Energy that friction dissipates in the second half of the kick; the register has already booked it [J].
    pub booked: f64,
    /// Energy that the register has booked and that was not dissipated [J].
    pub booked_wrongly: f64,
    /// Displacement at the end of the step if the step had no event [m].
    pub without_event: Vector3<f64>,
}

/// A tire on the ground that is under a push as a step begins.
#[derive(Clone, Copy, Debug)]
pub struct PushedTire {
    /// Index of the tire in the part.
    pub tire: usize,
    /// Velocity at the mid-step before [m/s].
    pub velocity: Vector3<f64>,
    /// Acceleration by its pushes until the step begins [m/s²].
    pub push_acceleration: Vector3<f64>,
}

impl TireAtStep {
    /// First half of the kick that takes the tire of `register` to `moved`. `pushed` is the acceleration of the tire by pushes as
    /// the step begins [m/s²]. `on_ground_before` holds its velocity and acceleration before, if it was pushed on the ground until
    /// then.
    #[inline(always)]
    pub fn new(
        register: &TireRegister<Scalar>,
        moved: &MovedRegister<Scalar>,
        gravity: Vector3<f64>,
        pushed: Vector3<f64>,
        on_ground_before: Option<PushedTire>,
    ) -> Self {
        let (displacement, h) = (vector(register.u), number(register.step));
        let mean = 0.5 * (vector(register.v) + vector(moved.v));
        let free = vector(register.f) * number(register.inverse_mass) + gravity;
        let dissipated = number(moved.dissipated);
        let Some(before) = on_ground_before else {
            return Self {
                displacement,
                velocity: mean,
                free,
                more_speed2: 0.0,
                booked: 0.5 * dissipated,
                booked_wrongly: 0.0,
                without_event: vector(moved.u) + pushed * (0.5 * h * h),
            };
        };
        let kicked = before.velocity + (free + before.push_acceleration) * (0.5 * h);
        let (velocity, _) = stop_at_ground(kicked, number(register.friction));
        Self {
            displacement,
            velocity,
            free,
            more_speed2: velocity.norm_squared() - mean.norm_squared(),
            booked: 0.0,
            booked_wrongly: dissipated,
            without_event: displacement + (velocity + 0.5 * h * (free + pushed).xy().push(0.0)) * h,
        }
    }

    /// Velocity at mid-step [m/s] of a tire after its step of length `h` [s]. `last` is the last acceleration of the tire [m/s²].
    /// `push_goes_on`: a push on the tire goes on after the step.
    pub fn mid_step_velocity(
        after: &TireStep,
        last: Vector3<f64>,
        push_goes_on: bool,
        h: f64,
    ) -> Vector3<f64> {
        let by_kick = if push_goes_on && is_in_air(after) { last - after.push_acceleration } else { last };
        after.velocity - by_kick * (0.5 * h)
    }

    /// Energy per mass that friction has dissipated from tₙ₊½ to tₙ₊₁ and that the next kick will book again [J/kg].
    pub fn next_half(&self, after: &TireStep, last: Vector3<f64>, push_goes_on: bool, h: f64) -> f64 {
        if push_goes_on { 0.0 } else { 0.5 * h * (self.free - last).xy().dot(&after.velocity.xy()) }
    }
}

/// Whether a tire is in the air at the end of its step, or leaves the ground there.
pub fn is_in_air(after: &TireStep) -> bool {
    after.displacement.z > 0.0 || after.velocity.z > 0.0
}

#[inline(always)]
fn number(wide: Wide<Scalar>) -> f64 {
    wide.pack()[0]
}

#[inline(always)]
fn vector(of: [Wide<Scalar>; 3]) -> Vector3<f64> {
    Vector3::from(of.map(number))
}
