//! A tire on the ground: unilateral support and Coulomb friction in closed form.
//!
//! A point mass on a plane with a diagonal mass matrix decouples. With the free velocity v* after all other forces, a tire
//! on the ground with v*₃ < 0 receives the normal impulse p = −m v*₃ and then stops sideways if |v*ₜ| ≤ μp/m, else loses
//! μp/m of its sideways speed. That is the exact solution at the tire; nothing iterates and no penalty enters.
//!
//! [`Flight::through`] carries one tire through a step in which it lands or is fired at: forces are constant over the step,
//! so every phase (flight, slide, stick) is a parabola and every event has its own time.

use nalgebra::{Vector2, Vector3};

/// What the ground leaves of a free velocity at one tire on it, `(velocity, normal impulse per mass)` [m/s].
pub fn support(free: Vector3<f64>, friction: f64) -> (Vector3<f64>, f64) {
    if free.z >= 0.0 {
        return (free, 0.0);
    }
    let sideways = rub(free.xy(), -friction * free.z);
    (Vector3::new(sideways.x, sideways.y, 0.0), -free.z)
}

/// Sideways velocity after friction has taken up to `loss` [m/s] of it.
fn rub(velocity: Vector2<f64>, loss: f64) -> Vector2<f64> {
    let speed = velocity.norm();
    if speed <= loss { Vector2::zeros() } else { velocity * (1.0 - loss / speed) }
}

/// One tire under a constant force for one step.
#[derive(Clone, Copy, Debug)]
pub struct Flight {
    /// Displacement [m]; on the ground when the third component is 0.
    pub displacement: Vector3<f64>,
    /// Velocity [m/s].
    pub velocity: Vector3<f64>,
    /// Acceleration by cables and gravity, without the ground [m/s²].
    pub free: Vector3<f64>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Energy lost per mass so far [J/kg].
    pub lost: f64,
    /// Energy put in per mass so far [J/kg].
    pub put_in: f64,
    /// Time within the step so far [s].
    pub elapsed: f64,
    /// Highest top of a parabola so far: height [m] and time within the step [s].
    pub top: (f64, f64),
}

/// Rise to the top of a parabola [m] and the time until then [s], if it is reached within `time` [s].
pub fn top(velocity: f64, acceleration: f64, time: f64) -> Option<(f64, f64)> {
    let until = -velocity / acceleration;
    (velocity > 0.0 && acceleration < 0.0 && until <= time).then_some((0.5 * velocity * until, until))
}

impl Flight {
    /// Moves over a step of length `h` [s] through landings and `launches` (time within the step [s], velocity [m/s]).
    ///
    /// Returns the acceleration of the last phase, so that velocity − acceleration·h/2 is the velocity central differences
    /// carry at mid-step.
    pub fn through(&mut self, h: f64, launches: impl Iterator<Item = (f64, f64)>) -> Vector3<f64> {
        let mut now = 0.0;
        for (at, launch) in launches {
            self.advance(at - now);
            now = at;
            self.put_in += launch * (self.velocity.z + 0.5 * launch);
            self.velocity.z += launch;
        }
        self.advance(h - now)
    }

    fn on_ground(&self) -> bool {
        self.displacement.z <= 0.0 && self.velocity.z <= 0.0
    }

    /// Moves for `left` seconds without a launch; returns the acceleration at its end.
    fn advance(&mut self, mut left: f64) -> Vector3<f64> {
        if !(self.on_ground() && self.free.z <= 0.0) {
            match self.landing().filter(|&landing| landing <= left) {
                None => {
                    self.fly(left);
                    return self.free;
                }
                Some(landing) => {
                    self.fly(landing);
                    self.land();
                    left -= landing;
                }
            }
            if self.free.z > 0.0 {
                self.fly(left);
                return self.free;
            }
        }
        self.slide(left)
    }

    /// Time until a tire off the ground, or leaving it, comes down [s].
    fn landing(&self) -> Option<f64> {
        let (z, v, a) = (self.displacement.z, self.velocity.z, self.free.z);
        let discriminant = v * v - 2.0 * a * z;
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        // Of z + v t + a t²/2 = 0, the root at which the tire moves down; each form where it does not cancel.
        let time = if v > 0.0 { -(v + root) / a } else { 2.0 * z / (root - v) };
        (time.is_finite() && time >= 0.0).then_some(time)
    }

    fn fly(&mut self, time: f64) {
        if let Some((rise, until)) = top(self.velocity.z, self.free.z, time)
            && self.displacement.z + rise > self.top.0
        {
            self.top = (self.displacement.z + rise, self.elapsed + until);
        }
        self.elapsed += time;
        self.displacement += self.velocity * time + self.free * (0.5 * time * time);
        self.velocity += self.free * time;
    }

    fn land(&mut self) {
        let before = self.velocity;
        self.displacement.z = 0.0;
        let (after, _) = support(before, self.friction);
        self.velocity = after;
        self.lost += 0.5 * (before.norm_squared() - after.norm_squared());
    }

    /// On the ground for `time` seconds: slides until friction stops it, then sticks if the pull stays in the cone.
    fn slide(&mut self, time: f64) -> Vector3<f64> {
        self.elapsed += time;
        if self.velocity.z < 0.0 {
            // Fired at downwards: a landing without a fall.
            self.land();
        }
        self.displacement.z = 0.0;
        self.velocity.z = 0.0;
        let limit = -self.friction * self.free.z;
        let pull = self.free.xy();
        let speed = self.velocity.xy().norm();
        let direction = if speed > 0.0 {
            self.velocity.xy() / speed
        } else if pull.norm() > limit {
            pull.normalize()
        } else {
            return Vector3::zeros();
        };
        let acceleration = pull - direction * limit;
        let braking = -acceleration.dot(&direction);
        let stops = braking * time >= speed && pull.norm() <= limit;
        let moving = if stops { speed / braking } else { time };
        let way = self.velocity.xy() * moving + acceleration * (0.5 * moving * moving);
        let velocity = if stops { Vector2::zeros() } else { self.velocity.xy() + acceleration * moving };
        self.lost += limit * way.norm();
        self.displacement += way.push(0.0);
        self.velocity = velocity.push(0.0);
        if stops { Vector3::zeros() } else { acceleration.push(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.81;

    fn flight(displacement: Vector3<f64>, velocity: Vector3<f64>, free: Vector3<f64>) -> Flight {
        Flight {
            displacement,
            velocity,
            free,
            friction: 0.5,
            lost: 0.0,
            put_in: 0.0,
            elapsed: 0.0,
            top: (0.0, 0.0),
        }
    }

    /// |v_t+| = max(0, |v_t−| − μ |v_n−|) for an inelastic landing.
    #[test]
    fn an_oblique_landing_loses_mu_times_its_normal_speed() {
        let (after, normal) = support(Vector3::new(3.0, 0.0, -4.0), 0.5);
        assert_eq!((after, normal), (Vector3::new(1.0, 0.0, 0.0), 4.0));
        let (after, _) = support(Vector3::new(1.2, 1.6, -4.0), 0.5);
        assert_eq!(after, Vector3::zeros());
        let up = Vector3::new(1.0, 2.0, 0.5);
        assert_eq!(support(up, 0.5), (up, 0.0));
    }

    /// Thrown up and sideways, it lands after 2 v/g at its launch speed, slides and stops: all in one step.
    #[test]
    fn one_step_holds_a_launch_a_landing_and_a_stop() {
        let mut flight = flight(Vector3::zeros(), Vector3::zeros(), -Vector3::z() * G);
        flight.velocity.x = 3.0;
        flight.displacement.z = 1e-300;
        flight.through(5.0, [(0.0, 2.0)].into_iter());
        let sideways = 3.0 - 0.5 * 2.0;
        let way = 3.0 * 2.0 * 2.0 / G + sideways * sideways / (2.0 * 0.5 * G);
        assert!((flight.displacement.x - way).abs() < 1e-12);
        assert_eq!(flight.velocity, Vector3::zeros());
        // All that was there and put in is lost.
        assert!((flight.lost - 0.5 * 9.0 - flight.put_in).abs() < 1e-12);
    }

    #[test]
    fn a_pull_inside_the_cone_moves_nothing() {
        let mut flight = flight(Vector3::zeros(), Vector3::zeros(), Vector3::new(0.49 * G, 0.0, -G));
        flight.through(1.0, std::iter::empty());
        assert_eq!(flight.displacement, Vector3::zeros());
    }
}
