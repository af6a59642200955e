//! Tires on the ground: friction, the contact region that a solution implies, and the end of a step with its landings.

use nalgebra::{Vector2, Vector3};

use super::Stepper;
use super::region::TireContact;
use crate::outcome::Peak;
use crate::simulation::contact::{apex, stop_at_ground};

impl Stepper<'_> {
    /// Friction force per mass of a sliding tire [m/s²]: by (3) μ times the reaction. It acts against the velocity, or against the
    /// cable force if there is no velocity.
    pub(super) fn sliding_friction(&self, free: Vector3<f64>, velocity: Vector2<f64>) -> Vector2<f64> {
        let limit = self.friction * (-free.z).max(0.0);
        let direction = velocity.try_normalize(0.0).or_else(|| free.xy().try_normalize(0.0));
        direction.map_or_else(Vector2::zeros, |direction| direction * -limit)
    }

    /// Friction force per mass at the end of the step [m/s²]. It is at most the force that stops the tire within the step, because
    /// a tire that has just landed may be slow.
    pub(super) fn end_friction(&self, tire: usize, free: Vector3<f64>, h: f64) -> Vector2<f64> {
        let sliding = self.sliding(tire, h);
        self.sliding_friction(free, sliding).cap_magnitude(2.0 * sliding.norm() / h)
    }

    /// Sideways velocity at the end of the step, without the friction at the end [m/s]. That friction acts against this velocity.
    fn sliding(&self, tire: usize, h: f64) -> Vector2<f64> {
        let acceleration = self.a[tire].xy() + self.f[tire].xy() / self.scene.mass[tire];
        self.v[tire].xy() + acceleration * (0.5 * h)
    }

    /// Whether a tire that is on the ground at the end of the step landed within the step.
    fn landed_within_step(&self, tire: usize) -> bool {
        self.u[tire].z > 0.0 || self.v[tire].z != 0.0
    }

    /// Sets the contact region that the solution implies.
    pub(super) fn set_implied_region(&mut self, h: f64) {
        for &n in self.wake.awake_cables() {
            let cable = &self.scene.cables[n];
            // (4): cables with L < L0 are switched off.
            self.implied.taut[n] = cable.displaced(&self.end).norm() > cable.rest_length;
        }
        for &tire in self.wake.awake_tires() {
            self.implied.ground[tire] = self.implied_ground(tire, h);
        }
    }

    /// Contact of a tire that the solution implies.
    fn implied_ground(&self, tire: usize, h: f64) -> TireContact {
        let mass = self.scene.mass[tire];
        let free = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
        let assumed = self.region.ground[tire];
        let lands = self.landed_within_step(tire);
        // (2): w ≥ 0.
        if assumed == TireContact::InAir {
            return if self.end[tire].z < 0.0 { TireContact::Slip } else { TireContact::InAir };
        }
        // The solution holds the tire on the ground: the residual is minus the force of the ground. The ground cannot pull.
        let rises = if lands { self.residual[tire].z > 0.0 } else { free.z > 0.0 };
        if rises {
            return TireContact::InAir;
        }
        // (3): the force that stops the tire over the last half step is at most μR.
        let within_cone = self.sliding(tire, h).norm() <= self.friction * (-free.z).max(0.0) * (0.5 * h);
        match assumed {
            TireContact::Stick if !within_cone => TireContact::Slip,
            TireContact::Slip if !lands && within_cone => TireContact::Stick,
            other => other,
        }
    }

    /// Makes the end of the step the new state. Books the energy that landings and friction dissipate.
    pub(super) fn accept(&mut self, h: f64) {
        for n in 0..self.wake.awake_tires().len() {
            let tire = self.wake.awake_tires()[n];
            let mass = self.scene.mass[tire];
            let mut velocity = self.du[tire] * (2.0 / h) - self.v[tire];
            let ground = self.region.ground[tire];
            if ground == TireContact::Stick {
                let force = (self.f[tire] + self.f_start[tire]).xy() * (0.5 * h);
                let stopped = self.v[tire].xy() * mass + force;
                self.record.ledger.dissipated += 0.5 * stopped.dot(&self.v[tire].xy());
                velocity = Vector3::zeros();
            } else if ground == TireContact::Slip {
                velocity.z = 0.0;
                let free = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
                let before = self.a[tire].xy() - self.f_start[tire].xy() / mass;
                let friction = 0.5 * (before + self.end_friction(tire, free, h));
                self.record.ledger.dissipated -= mass * friction.dot(&self.du[tire].xy());
                if self.landed_within_step(tire) {
                    velocity = self.land(tire, h, velocity);
                }
            }
            self.v[tire] = velocity;
            self.u[tire] = self.end[tire];
        }
    }

    /// Velocity of a tire after its landing within the step [m/s]. The fall gives the impact speed. Friction slows the tire
    /// sideways.
    fn land(&mut self, tire: usize, h: f64, velocity: Vector3<f64>) -> Vector3<f64> {
        let (height, rise, a) = (self.u[tire].z, self.v[tire].z, self.a[tire].z);
        if let Some((more, until)) = apex(rise, a, h) {
            let time = self.clock.now() + until;
            self.record.note_top(Peak { value: height + more, time, index: tire });
        }
        let impact = (rise * rise - 2.0 * a * height).max(0.0).sqrt();
        let left = (h - 2.0 * height / (impact - rise).max(f64::MIN_POSITIVE)).clamp(0.0, h);
        let before = velocity.xy().push(-impact);
        let (after, _) = stop_at_ground(before, self.friction);
        self.end[tire] += (after.xy() - before.xy()).push(0.0) * left;
        let lost = 0.5 * self.scene.mass[tire] * (before.norm_squared() - after.norm_squared());
        self.record.ledger.dissipated += lost;
        if after.xy() == Vector2::zeros() {
            self.region.ground[tire] = TireContact::Stick;
        }
        after
    }
}
