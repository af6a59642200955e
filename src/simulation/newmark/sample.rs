//! What a step leaves in the record: peaks, history, ledger, cables that break.

use nalgebra::Vector3;

use super::Stepper;
use crate::outcome::{Broken, End, Outcome, Peak};

impl Stepper<'_> {
    /// Notes peaks, history and ledger of the present state.
    pub(super) fn sample(&mut self) {
        let now = self.now();
        if let Some((cable, before)) = self.sampled.take() {
            self.record.vertex(before, self.signed_force(cable, &self.u));
        }
        let breaking_force = self.scene.breaking_force.unwrap_or(f64::INFINITY);
        let (mut energy, mut height, mut force) = (self.asleep, 0.0_f64, 0.0_f64);
        for &place in &self.wake.blocks {
            let cable = &self.scene.cables[place];
            let length = cable.displaced(&self.u).norm();
            let pull = cable.force(length);
            energy += cable.energy(length);
            force = force.max(pull);
            if pull > self.record.force.value {
                self.record.force = Peak { value: pull, at: now, place };
                self.sampled = Some((place, self.signed_force(place, &self.earlier)));
            }
        }
        for &tire in &self.wake.awake {
            let (mass, value) = (self.scene.mass[tire], self.u[tire].z);
            height = height.max(value);
            energy += mass * (0.5 * self.v[tire].norm_squared() + self.scene.gravity * value);
            if value > self.record.height.value {
                let sample = Peak { value, at: now, place: tire };
                self.record.higher(sample, self.v[tire].z, self.a[tire].z);
            }
        }
        self.record.balance(energy, 0.0);
        if force > breaking_force {
            self.cut_broken(breaking_force);
        }
        self.record.history.note(now, height, force.min(breaking_force));
    }

    /// Takes away the cables that pull past their breaking force; what they stored is lost, and their tires are let go.
    #[cold]
    fn cut_broken(&mut self, breaking_force: f64) {
        let at = self.now();
        self.record.cap(breaking_force);
        self.sampled = None;
        for n in 0..self.wake.blocks.len() {
            let place = self.wake.blocks[n];
            let cable = &mut self.scene.to_mut().cables[place];
            let length = cable.displaced(&self.u).norm();
            if cable.force(length) > breaking_force {
                self.record.ledger.dissipated += cable.energy(length);
                self.record.broken.push(Broken { at, cable: place });
                cable.rest_length = f64::INFINITY;
                self.region.taut[place] = false;
                for end in cable.ends {
                    self.wake.set_moving(end, true);
                }
            }
        }
    }

    fn signed_force(&self, cable: usize, u: &[Vector3<f64>]) -> f64 {
        let cable = &self.scene.cables[cable];
        cable.stiffness * (cable.displaced(u).norm() - cable.rest_length)
    }

    /// The outcome at `limit` [s], which the last step reaches past.
    pub(super) fn finish(self, limit: f64, end: End) -> Outcome {
        let (now, past) = (self.now(), (self.now() - limit).max(0.0));
        let Self { u, v, record, clock, .. } = self;
        let tires = u.iter().zip(&v).enumerate().map(|(tire, (u, v))| (tire, u - v * past));
        record.finish(tires, (now - past, clock.steps), end)
    }
}
