//! Notes on the state before each step: peaks, history, ledger, cables that break.

use nalgebra::Vector3;

use super::Stepper;
use crate::outcome::{BrokenCable, EndReason, Outcome, Peak};

impl Stepper<'_> {
    /// Notes peaks, history and ledger of the present state.
    pub(super) fn note_state(&mut self) {
        let now = self.clock.now();
        if let Some((cable, before)) = self.peak_to_refine.take() {
            let after = self.stretch_over_strength(cable, &self.u);
            self.record.interpolate_force(before, after);
        }
        let breaking_force = self.scene.breaking_force.unwrap_or(f64::INFINITY);
        let (mut energy, mut height, mut force) =
            (self.asleep_elastic_energy + self.asleep_slope_energy, 0.0_f64, 0.0_f64);
        for &index in self.wake.awake_cables() {
            let cable = &self.scene.cables[index];
            let length = cable.displaced(&self.u).norm();
            let value = cable.force(length) / self.scene.strength(index);
            energy += cable.energy(length);
            force = force.max(value);
            if value > self.record.force.value {
                self.record.force = Peak { value, time: now, index };
                self.peak_to_refine = Some((index, self.stretch_over_strength(index, &self.earlier)));
            }
        }
        for &tire in self.wake.awake_tires() {
            let (mass, value) = (self.scene.mass[tire], self.u[tire].z);
            height = height.max(value);
            let potential = -self.scene.gravity().dot(&self.u[tire]);
            energy += mass * (0.5 * self.v[tire].norm_squared() + potential);
            if value > self.record.height.value {
                let peak = Peak { value, time: now, index: tire };
                self.record.note_height(peak, self.v[tire].z, self.a[tire].z);
            }
        }
        self.record.balance_energy(energy, 0.0);
        if force > breaking_force {
            self.break_cables(breaking_force);
        }
        self.record.history.note(now, height, force.min(breaking_force));
    }

    /// Notes the greatest force of the cables of a tire as a hole fires under it, at `time` [s] between two steps. The force has a
    /// kink there. A parabola through the forces of steps on both sides does not show the kink.
    pub(super) fn note_force_at_firing(&mut self, tire: usize, time: f64) {
        for index in 0..self.scene.cables.len() {
            if !self.scene.cables[index].ends.contains(&tire) {
                continue;
            }
            if self.peak_to_refine.is_some_and(|(peak, _)| peak == index) {
                self.peak_to_refine = None;
            }
            let value = self.stretch_over_strength(index, &self.u);
            if value > self.record.force.value {
                self.record.force = Peak { value, time, index };
                self.peak_to_refine = None;
            }
        }
    }

    /// Removes the cables whose force over strength exceeds the breaking force. Their elastic energy is lost, and their tires wake.
    #[cold]
    fn break_cables(&mut self, breaking_force: f64) {
        let time = self.clock.now();
        self.peak_to_refine = None;
        let mut hardest = (0.0, 0);
        for n in 0..self.wake.awake_cables().len() {
            let index = self.wake.awake_cables()[n];
            let strength = self.scene.strength(index);
            let cable = &mut self.scene.to_mut().cables[index];
            let length = cable.displaced(&self.u).norm();
            let force = cable.force(length) / strength;
            if force > breaking_force {
                if force > hardest.0 {
                    hardest = (force, index);
                }
                self.record.ledger.dissipated += cable.energy(length);
                self.record.broken.push(BrokenCable { time, cable: index });
                cable.rest_length = f64::INFINITY;
                self.region.taut[index] = false;
                for end in cable.ends {
                    self.wake.set_moving(end, true);
                }
            }
        }
        self.record.note_break(breaking_force, time, hardest.1);
    }

    /// k (L − L0) over strength of a cable [N] at the displacements `u` [m].
    fn stretch_over_strength(&self, cable: usize, u: &[Vector3<f64>]) -> f64 {
        let strength = self.scene.strength(cable);
        let cable = &self.scene.cables[cable];
        cable.stretch_force(cable.displaced(u).norm()) / strength
    }

    /// Outcome at the end of the run. If the last step exceeds the end, the tires move back by the difference.
    pub(super) fn finish(self, reason: EndReason) -> Outcome {
        let past = self.clock.overshoot();
        let Self { u, v, record, clock, .. } = self;
        let tires = u.iter().zip(&v).enumerate().map(|(tire, (u, v))| (tire, u - v * past));
        record.finish(tires, &clock, reason)
    }
}
