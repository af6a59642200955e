//! Support and friction of a tire on the ground, in closed form.
//!
//! Tires are point masses, so each contact is solved by itself. Symbols: m mass of the tire; v* free velocity of the tire, after
//! all forces but those of the ground; v*₃ its normal part, v*ₜ its sideways part; p normal impulse; μ coefficient of friction.
//!
//! 1. If the tire is on the ground and v*₃ < 0, the ground gives the normal impulse p = −m v*₃.
//! 2. If |v*ₜ| ≤ μp/m, friction stops the tire sideways.
//! 3. Otherwise the tire loses μp/m of its sideways speed.
//!
//! This is the exact solution at the tire, without iteration and without penalty stiffness.
//!
//! [`TireStep::integrate`] moves one tire through a step in which the tire lands, is launched, or is pushed. Forces are constant
//! over the step. So every phase (flight, slide under friction of one direction, stick) is a parabola, and every event has its own
//! time.

use nalgebra::{Vector2, Vector3};

/// Velocity of a tire on the ground after support and friction, and the normal impulse per mass [m/s], from its free velocity
/// [m/s].
pub fn stop_at_ground(free_velocity: Vector3<f64>, friction: f64) -> (Vector3<f64>, f64) {
    if free_velocity.z >= 0.0 {
        return (free_velocity, 0.0);
    }
    let sideways = apply_friction(free_velocity.xy(), -friction * free_velocity.z);
    (Vector3::new(sideways.x, sideways.y, 0.0), -free_velocity.z)
}

/// Sideways velocity after friction takes up to `loss` [m/s] from its speed [m/s].
fn apply_friction(velocity: Vector2<f64>, loss: f64) -> Vector2<f64> {
    let speed = velocity.norm();
    if speed <= loss { Vector2::zeros() } else { velocity * (1.0 - loss / speed) }
}

/// Effect of a hole on a tire within a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct HoleImpulse {
    /// Time since the start of the step [s].
    pub since_start: f64,
    /// Velocity added at once [m/s].
    pub launch: Vector3<f64>,
    /// Acceleration added from then on [m/s²].
    pub push_acceleration: Vector3<f64>,
}

/// Motion of one tire over one step under constant force.
#[derive(Clone, Copy, Debug)]
pub struct TireStep {
    /// Displacement [m]; the tire is on the ground when the third component is 0.
    pub displacement: Vector3<f64>,
    /// Velocity [m/s].
    pub velocity: Vector3<f64>,
    /// Acceleration by cables, gravity and pushes, without the ground [m/s²].
    free_acceleration: Vector3<f64>,
    /// Acceleration by pushes [m/s²].
    pub push_acceleration: Vector3<f64>,
    /// Coefficient of friction μ.
    friction: f64,
    /// Restitution: normal speed after a landing over normal speed before.
    restitution: f64,
    /// Energy per mass lost in landings and friction so far [J/kg].
    pub lost: f64,
    /// Energy per mass put in by holes so far [J/kg].
    pub put_in: f64,
    /// Time since the start of the step [s].
    elapsed: f64,
    /// Highest top of a parabola so far: height [m] and time since the start of the step [s].
    pub peak: (f64, f64),
    /// First landing so far: time since the start of the step [s], and change of velocity [m/s].
    pub landing: Option<(f64, Vector3<f64>)>,
}

/// Rise to the top of a parabola [m] and time until the top [s]; `None` if the tire does not reach the top within `time` [s].
pub fn apex(velocity: f64, acceleration: f64, time: f64) -> Option<(f64, f64)> {
    let until = -velocity / acceleration;
    (velocity > 0.0 && acceleration < 0.0 && until <= time).then_some((0.5 * velocity * until, until))
}

impl TireStep {
    /// Tire at the start of a step: displacement [m], velocity [m/s], acceleration without the ground [m/s²], μ, and
    /// restitution.
    pub fn new(
        displacement: Vector3<f64>,
        velocity: Vector3<f64>,
        free_acceleration: Vector3<f64>,
        friction: f64,
        restitution: f64,
    ) -> Self {
        let (lost, put_in, elapsed, peak) = (0.0, 0.0, 0.0, (0.0, 0.0));
        let push_acceleration = Vector3::zeros();
        Self {
            displacement,
            velocity,
            free_acceleration,
            push_acceleration,
            friction,
            restitution,
            lost,
            put_in,
            elapsed,
            peak,
            landing: None,
        }
    }

    /// Integrates the motion over a step of length `h` [s], with landings and with the `impulses` of holes, which are in order of
    /// time.
    ///
    /// Returns the acceleration a of the last phase [m/s²]: v − a h/2 is the mid-step velocity of central differences.
    pub fn integrate(&mut self, h: f64, impulses: impl Iterator<Item = HoleImpulse>) -> Vector3<f64> {
        let mut now = 0.0;
        for HoleImpulse { since_start, launch, push_acceleration } in impulses {
            self.integrate_between(since_start - now, h);
            (now, self.elapsed) = (since_start, since_start);
            self.put_in += launch.dot(&(self.velocity + 0.5 * launch));
            self.velocity += launch;
            self.push_acceleration += push_acceleration;
            self.free_acceleration += push_acceleration;
        }
        self.integrate_between(h - now, h)
    }

    /// Integrates over `left` [s] between two impulses, within a step of length `h` [s]. Returns the acceleration of the last phase
    /// [m/s²].
    fn integrate_between(&mut self, left: f64, h: f64) -> Vector3<f64> {
        let before = self.displacement;
        let acceleration = self.integrate_phases(left, h);
        self.put_in += self.push_acceleration.dot(&(self.displacement - before));
        acceleration
    }

    fn on_ground(&self) -> bool {
        self.displacement.z <= 0.0 && self.velocity.z <= 0.0
    }

    /// Integrates over `left` [s] of a step of length `h` [s], phase by phase: in the air, landing, on the ground. Returns the
    /// acceleration of the last phase [m/s²]. The caller counts the work of pushes.
    fn integrate_phases(&mut self, mut left: f64, h: f64) -> Vector3<f64> {
        while !(self.on_ground() && self.free_acceleration.z <= 0.0) {
            match self.time_to_landing().filter(|&landing| landing <= left) {
                None => {
                    self.fly_freely(left);
                    return self.free_acceleration;
                }
                Some(landing) => {
                    self.fly_freely(landing);
                    self.land(self.rebound(h));
                    left -= landing;
                }
            }
            if self.free_acceleration.z > 0.0 {
                self.fly_freely(left);
                return self.free_acceleration;
            }
        }
        self.slide(left)
    }

    /// Time until the tire lands [s], for a tire in the air or leaving the ground; `None` if the tire does not come down.
    fn time_to_landing(&self) -> Option<f64> {
        let (z, v, a) = (self.displacement.z, self.velocity.z, self.free_acceleration.z);
        let discriminant = v * v - 2.0 * a * z;
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        // The tire moves down at one root of z + v t + a t²/2 = 0. This root has two forms. Each form is used where its terms do
        // not cancel.
        let time = if v > 0.0 { -(v + root) / a } else { 2.0 * z / (root - v) };
        (time.is_finite() && time >= 0.0).then_some(time)
    }

    fn fly_freely(&mut self, time: f64) {
        if let Some((rise, until)) = apex(self.velocity.z, self.free_acceleration.z, time)
            && self.displacement.z + rise > self.peak.0
        {
            self.peak = (self.displacement.z + rise, self.elapsed + until);
        }
        self.elapsed += time;
        self.displacement += self.velocity * time + self.free_acceleration * (0.5 * time * time);
        self.velocity += self.free_acceleration * time;
    }

    /// Normal speed of a falling tire after its landing [m/s]. The bounces still to come are a geometric series. If all of them
    /// together last less than a step of length `h` [s], the tire stays down, and the speed is 0.
    fn rebound(&self, h: f64) -> f64 {
        let speed = -self.restitution * self.velocity.z;
        let bounces = 2.0 * speed / (-self.free_acceleration.z * (1.0 - self.restitution));
        if self.free_acceleration.z < 0.0 && bounces < h { 0.0 } else { speed }
    }

    /// Lands the tire, which leaves the ground at the normal speed `rebound` [m/s]. Friction acts with the whole normal impulse.
    fn land(&mut self, rebound: f64) {
        let before = self.velocity;
        self.displacement.z = 0.0;
        let (mut after, _) = stop_at_ground(before - Vector3::z() * rebound, self.friction);
        after.z += rebound;
        self.velocity = after;
        self.lost += 0.5 * (before.norm_squared() - after.norm_squared());
        self.landing.get_or_insert((self.elapsed, after - before));
    }

    /// Integrates over `time` [s] on the ground; returns the acceleration of the last phase [m/s²].
    fn slide(&mut self, time: f64) -> Vector3<f64> {
        if self.velocity.z < 0.0 {
            // A downward launch is a landing without a fall.
            self.land(0.0);
        }
        self.displacement.z = 0.0;
        self.velocity.z = 0.0;
        let (mut left, mut acceleration) = (time, Vector2::zeros());
        for _ in 0..MOST_TURNS {
            let Some(phase) = self.slide_straight(left) else { return Vector3::zeros() };
            acceleration = phase.acceleration;
            left -= phase.time;
            if left <= 0.0 {
                break;
            }
        }
        self.elapsed += left.max(0.0);
        acceleration.push(0.0)
    }

    /// Slides for `time` [s] at most, while friction keeps its direction, against the velocity at the start. The slide ends early
    /// if the tire no longer moves against friction. `None` if the tire sticks: at rest, within the cone of friction.
    fn slide_straight(&mut self, time: f64) -> Option<Slide> {
        let limit = -self.friction * self.free_acceleration.z;
        let (driving, velocity) = (self.free_acceleration.xy(), self.velocity.xy());
        let speed = velocity.norm();
        let direction = if speed > 0.0 {
            velocity / speed
        } else if driving.norm() > limit {
            driving.normalize()
        } else {
            self.elapsed += time;
            return None;
        };
        let acceleration = driving - direction * limit;
        let braking = -acceleration.dot(&direction);
        let stops = speed > 0.0 && braking * time >= speed;
        let moving = if stops { speed / braking } else { time };
        let path = velocity * moving + acceleration * (0.5 * moving * moving);
        let mut after = velocity + acceleration * moving;
        if stops {
            after -= direction * after.dot(&direction);
            // The rest is rounding, no motion.
            if after.norm() <= 1e-12 * speed {
                after = Vector2::zeros();
            }
        }
        self.elapsed += moving;
        self.lost += limit * path.dot(&direction);
        self.displacement += path.push(0.0);
        self.velocity = after.push(0.0);
        Some(Slide { time: moving, acceleration })
    }
}

/// Slide under friction of one direction.
struct Slide {
    /// Duration [s].
    time: f64,
    /// Acceleration [m/s²].
    acceleration: Vector2<f64>,
}

/// Greatest number of times that friction changes its direction within a step. Under constant force, the first stop along the
/// direction of friction leaves a speed across it, and the second stop leaves little. A tire that stops twice more within one step
/// is at rest, except for rounding.
const MOST_TURNS: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.81;

    /// |v_t+| = max(0, |v_t−| − μ |v_n−|) for an inelastic landing.
    #[test]
    fn an_oblique_landing_loses_mu_times_its_normal_speed() {
        let (after, normal) = stop_at_ground(Vector3::new(3.0, 0.0, -4.0), 0.5);
        assert_eq!((after, normal), (Vector3::new(1.0, 0.0, 0.0), 4.0));
        let (after, _) = stop_at_ground(Vector3::new(1.2, 1.6, -4.0), 0.5);
        assert_eq!(after, Vector3::zeros());
        let up = Vector3::new(1.0, 2.0, 0.5);
        assert_eq!(stop_at_ground(up, 0.5), (up, 0.0));
    }

    /// A tire thrown up and sideways lands after 2 v/g at its launch speed. It slides and stops in the same step.
    #[test]
    fn one_step_holds_a_launch_a_landing_and_a_stop() {
        let (above, sideways) = (Vector3::z() * 1e-300, Vector3::x() * 3.0);
        let mut step = TireStep::new(above, sideways, -Vector3::z() * G, 0.5, 0.0);
        step.integrate(
            5.0,
            [HoleImpulse { launch: Vector3::z() * 2.0, ..HoleImpulse::default() }].into_iter(),
        );
        let sideways = 3.0 - 0.5 * 2.0;
        let expected = 3.0 * 2.0 * 2.0 / G + sideways * sideways / (2.0 * 0.5 * G);
        assert!((step.displacement.x - expected).abs() < 1e-12);
        assert_eq!(step.velocity, Vector3::zeros());
        // All energy is lost: the energy at the start and the energy put in.
        assert!((step.lost - 0.5 * 9.0 - step.put_in).abs() < 1e-12);
    }

    /// A force stronger than friction brakes a slide with a + μ g, reverses it, and speeds it up with a − μ g.
    #[test]
    fn a_slide_that_turns_round_within_a_step_is_two_parabolas() {
        let (pull, limit) = (8.0, 0.5 * G);
        let force = Vector3::new(-pull, 0.0, -G);
        let mut step = TireStep::new(Vector3::zeros(), Vector3::x() * 2.0, force, 0.5, 0.0);
        let last = step.integrate(1.0, std::iter::empty());
        let turn = 2.0 / (pull + limit);
        let (there, back) = (0.5 * 2.0 * turn, 0.5 * (pull - limit) * (1.0 - turn) * (1.0 - turn));
        assert!((step.displacement.x - (there - back)).abs() < 1e-14);
        assert!((step.velocity.x + (pull - limit) * (1.0 - turn)).abs() < 1e-14);
        assert!((step.lost - limit * (there + back)).abs() < 1e-14 && last.x == limit - pull);
    }

    /// The force acts across the first direction, too. The energy that friction takes is the energy that the motion loses.
    #[test]
    fn a_slide_round_a_corner_keeps_the_balance_of_energy() {
        for pull in [0.3 * G, 1.5 * G] {
            let force = Vector3::new(0.0, pull, -G);
            let mut step = TireStep::new(Vector3::zeros(), Vector3::x() * 1.5, force, 0.5, 0.0);
            step.integrate(0.6, std::iter::empty());
            let work = pull * step.displacement.y;
            let energy = 0.5 * (1.5 * 1.5 - step.velocity.norm_squared());
            assert!((work + energy - step.lost).abs() < 1e-12, "{pull}: {} {}", work + energy, step.lost);
        }
    }

    #[test]
    fn a_force_inside_the_cone_moves_nothing() {
        let force = Vector3::new(0.49 * G, 0.0, -G);
        let mut step = TireStep::new(Vector3::zeros(), Vector3::zeros(), force, 0.5, 0.0);
        step.integrate(1.0, std::iter::empty());
        assert_eq!(step.displacement, Vector3::zeros());
    }
}
