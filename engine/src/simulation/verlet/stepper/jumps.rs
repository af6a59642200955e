//! Forces of cables whose tires jump between two steps. A tire jumps if it is launched or lands, or if a push on it begins or ends.
//!
//! Symbols: h step; t ≤ h time since the last evaluation; D(t) vector between the fastenings of a cable; L = |D| length; tᵢ time of
//! a jump; Δᵢ velocity that this jump adds to D′; ρ₀, ρ₁ mean rates of L² over the step before and over this step; c ṡ viscous
//! force.
//!
//! 1. A launch and a landing change the velocity of a tire at once, and the force c ṡ of damped cables with it. A push that begins
//!    or ends gives the force a kink. Without damping, every jump gives the force of a cable a kink.
//! 2. The force is the force of a smooth motion before a jump, and of another smooth motion after it. A parabola through the forces
//!    of steps on both sides shows neither.
//! 3. Without jumps, D is linear over the step, and L² is a parabola: (L²)′ = ρ₁ + (t/h − ½)(ρ₁ − ρ₀).
//! 4. Jumps before t add Σ Δᵢ (t − tᵢ) to D, and 2 (D·Σ Δᵢ + D′·Σ Δᵢ (t − tᵢ)) to (L²)′.
//! 5. So the forces just before and just after each jump are known to second order. They compete for the greatest force.

use nalgebra::Vector3;

use super::{PeakCable, Stepper};
use crate::outcome::Peak;
use crate::scene::Cable;
use crate::simulation::pack::LANES;

/// Jump of a tire within the present step.
#[derive(Clone, Copy, Debug)]
pub struct Jump {
    /// Index of the tire in the part.
    pub tire: usize,
    /// Time since the start of the step [s].
    pub at: f64,
    /// Velocity gained at once [m/s]; 0 where a push begins or ends.
    pub change: Vector3<f64>,
    /// Acceleration at the end of the step minus acceleration at its start [m/s²].
    pub gained: Vector3<f64>,
    /// Displacement at the end of the step if nothing had happened in it [m].
    pub end: Vector3<f64>,
    /// Displacement over the step if nothing had happened in it [m].
    pub move_of_step: Vector3<f64>,
}

/// A cable over a step in which its tires jump.
#[derive(Clone, Copy, Debug)]
struct CableInStep {
    cable: Cable,
    viscosity: f64,
    step: f64,
    /// D at the end of the step without jumps, and its change over the step [m].
    end: Vector3<f64>,
    move_of_step: Vector3<f64>,
    /// ρ₀ and ρ₁ [m²/s].
    rates: [f64; 2],
}

impl CableInStep {
    /// k (L − L0) + c ṡ at the time `at` [s] [N]. Earlier jumps have added the vector `lead` [m] to D and `faster` [m/s] to its
    /// rate.
    fn stretch_force(&self, at: f64, [lead, faster]: [Vector3<f64>; 2]) -> f64 {
        let Self { cable, viscosity, step, end, move_of_step, rates: [before, here] } = self;
        let smooth = end - move_of_step * (1.0 - at / step);
        let span = smooth + lead;
        let length = span.norm();
        let rate = here
            + (at / step - 0.5) * (here - before)
            + 2.0 * (span.dot(&faster) + lead.dot(move_of_step) / step);
        cable.stretch_force(length) + viscosity * rate / (2.0 * length)
    }

    /// Force of the cable at the time `at` [s] after the same jumps [N]; 0 if the cable is slack.
    fn force(&self, at: f64, added: [Vector3<f64>; 2]) -> f64 {
        let smooth = self.end - self.move_of_step * (1.0 - at / self.step);
        let is_taut = (smooth + added[0]).norm() > self.cable.rest_length;
        if is_taut { self.stretch_force(at, added).max(0.0) } else { 0.0 }
    }
}

impl Stepper<'_> {
    /// Notes the greatest force at the jumps of this step. Damped cables then forget how their tires moved before.
    #[cold]
    pub(super) fn cross_jumps(&mut self) {
        // Images still lie where the step began. They jump with their kept tires.
        self.copy_images();
        self.copy_velocities();
        self.copy_jumps();
        let damped = !self.part.viscosity.is_empty();
        let peak = self.peak_to_refine;
        let peak_element = peak.map(|peak| self.part.blocks.blocks[peak.block].first_element + peak.slot);
        if let (Some(peak), Some(element)) = (peak, peak_element) {
            self.refine_before_jumps(peak, element);
        }
        for n in 0..self.jumped.len() {
            let Jump { tire, at, .. } = self.jumped[n];
            self.for_each_cable_of(tire, |stepper, element| {
                if damped || peak_element == Some(element) {
                    stepper.note_force_at(element, at);
                }
            });
        }
        for n in 0..if damped { self.jumped.len() } else { 0 } {
            let tire = self.jumped[n].tire;
            if n == 0 || self.jumped[n - 1].tire != tire {
                self.for_each_cable_of(tire, |stepper, element| stepper.forget_motion(element, tire));
            }
        }
        self.jumped.clear();
    }

    /// Gives images the reflected jumps of their kept tires; sorts the jumps by tire.
    fn copy_jumps(&mut self) {
        for n in 0..self.jumped.len() {
            let jump = self.jumped[n];
            for image in self.part.reduction.images.iter().filter(|image| image.read == jump.tire) {
                let reflected = |vector: Vector3<f64>| vector.component_mul(&Vector3::from(image.sign));
                let of_image = Jump {
                    tire: image.written,
                    change: reflected(jump.change),
                    gained: reflected(jump.gained),
                    end: reflected(jump.end),
                    move_of_step: reflected(jump.move_of_step),
                    ..jump
                };
                match image.written == jump.tire {
                    true => self.jumped[n] = of_image,
                    false => self.jumped.push(of_image),
                }
            }
        }
        self.jumped.sort_unstable_by_key(|jump| jump.tire);
    }

    /// Calls `visit` with the element of each cable of a tire.
    fn for_each_cable_of(&mut self, tire: usize, mut visit: impl FnMut(&mut Self, usize)) {
        let part = self.part;
        for &element in part.blocks.ends.of(tire / LANES).into_iter().flatten() {
            let element = element as usize + tire % LANES;
            if self.cable_forces.exists(element) {
                visit(self, element);
            }
        }
    }

    /// Jumps of a tire in this step.
    fn jumps_of(&self, tire: usize) -> &[Jump] {
        let from = self.jumped.partition_point(|jump| jump.tire < tire);
        &self.jumped[from..self.jumped.partition_point(|jump| jump.tire <= tire)]
    }

    /// Block, slot and cable of an element that holds a cable.
    fn cable_at(&self, element: usize) -> (usize, usize, Cable) {
        let blocks = &self.part.blocks.blocks;
        let block = blocks.partition_point(|block| block.first_element <= element) - 1;
        let slot = element - blocks[block].first_element;
        (block, slot, self.part.blocks.cable_in(&blocks[block], slot))
    }

    fn cable_in_step(&self, element: usize) -> CableInStep {
        let (.., cable) = self.cable_at(element);
        let smooth = |tire: usize| match self.jumps_of(tire) {
            [] => [self.u.vector(tire), self.mean_velocity(tire) * self.step],
            [jump, ..] => [jump.end, jump.move_of_step],
        };
        let [first, second] = cable.ends.map(smooth);
        let [end, move_of_step] = [cable.span + second[0] - first[0], second[1] - first[1]];
        let [excess, before] = self.cable_forces.excess_and_change(element);
        let here = end.norm_squared() - cable.rest_length * cable.rest_length - excess;
        // If the cable was slack, the change that is kept is older than the step before.
        let before = if excess > 0.0 { before } else { here };
        let rates = [before, here].map(|change| change / self.step);
        let viscosity = self.part.viscosity.get(element).copied().unwrap_or_default();
        CableInStep { cable, viscosity, step: self.step, end, move_of_step, rates }
    }

    /// Notes the force of a cable just before and just after the jumps of its tires at the time `at` since the start of the step
    /// [s], if that force is the greatest so far.
    fn note_force_at(&mut self, element: usize, at: f64) {
        let in_step = self.cable_in_step(element);
        let (block, slot, cable) = self.cable_at(element);
        let [first, second] = cable.ends.map(|end| self.jumps_of(end));
        let added = |is_past: fn(&f64, &f64) -> bool| {
            let of_tire = |jumps: &[Jump]| {
                let past = jumps.iter().filter(|jump| is_past(&jump.at, &at));
                past.fold([Vector3::zeros(); 2], |[lead, faster], jump| {
                    [lead + jump.change * (at - jump.at), faster + jump.change]
                })
            };
            let ([lead, faster], [first_lead, first_faster]) = (of_tire(second), of_tire(first));
            [lead - first_lead, faster - first_faster]
        };
        let forces = [f64::lt, f64::le].map(|is_past| in_step.force(at, added(is_past)));
        let value = forces[0].max(forces[1]) / self.strength(block, slot);
        if value > self.record.force.value {
            let index = self.part.reduction.cable(self.part.blocks.cable_of(element));
            self.record.force = Peak { value, time: self.clock.now() + at, index };
            self.peak_to_refine = None;
        }
    }

    /// Moves the greatest force, found as this step began, to the top of its parabola, if the top lies before the first jump of its
    /// tires. The parabola goes through the force at the end of the step without jumps.
    fn refine_before_jumps(&mut self, PeakCable { block, slot, force_before }: PeakCable, element: usize) {
        let in_step = self.cable_in_step(element);
        let jumps = in_step.cable.ends.into_iter().flat_map(|end| self.jumps_of(end));
        let Some(first) = jumps.map(|jump| jump.at).reduce(f64::min) else { return };
        self.peak_to_refine = None;
        let after = in_step.stretch_force(self.step, [Vector3::zeros(); 2]) / self.strength(block, slot);
        let bend = 2.0 * self.record.force.value - force_before - after;
        if 0.5 * (after - force_before) / bend * self.step <= first {
            self.record.interpolate_force(force_before, after);
        }
    }

    /// Mean velocity of a tire over this step if it had always moved as at its end [m/s]. In the air, the velocity at mid-step
    /// holds what a push adds until the step ends. So half a step of every push that goes on is taken off.
    fn mean_velocity(&self, tire: usize) -> Vector3<f64> {
        let velocity = self.v.vector(tire);
        if self.pushes.is_empty() || self.u.vector(tire).z <= 0.0 {
            return velocity;
        }
        let images = &self.part.reduction.images;
        let (kept, sign) =
            images.iter().find(|image| image.written == tire).map_or((tire, [1.0; 3]), |i| (i.read, i.sign));
        velocity - self.pushes.after_step(kept).component_mul(&Vector3::from(sign)) * (0.5 * self.step)
    }

    /// Lets a damped cable of `tire`, which has jumped, forget how its tires moved before the end of this step. If both tires
    /// jumped, only the first tire does this.
    ///
    /// The change of (L²)′ from step to step is ρ₁ − ρ₀ plus what the jumps changed: 2 D·ΔD″ with the acceleration ΔD″ that D″
    /// gained, and the change of 2 |D′|².
    fn forget_motion(&mut self, element: usize, tire: usize) {
        let CableInStep { cable, step, move_of_step, rates, .. } = self.cable_in_step(element);
        let [first, second] = cable.ends;
        if first < tire && !self.jumps_of(first).is_empty() {
            return;
        }
        let between = cable.span + self.u.vector(second) - self.u.vector(first);
        let apart = (self.mean_velocity(second) - self.mean_velocity(first)) * step;
        let gained_by =
            |tire: usize| self.jumps_of(tire).first().map_or(Vector3::zeros(), |jump| jump.gained);
        let gained = (gained_by(second) - gained_by(first)) * (step * step);
        let more = 2.0 * (between.dot(&gained) + apart.norm_squared() - move_of_step.norm_squared());
        let length2 = between.norm_squared();
        let change = length2 - (between - apart).norm_squared();
        let before = change - (rates[1] - rates[0]) * step - more;
        let jumps = [first, second].into_iter().flat_map(|end| self.jumps_of(end));
        let force_jumps = jumps.into_iter().any(|jump| jump.change != Vector3::zeros());
        let excess = length2 - cable.rest_length * cable.rest_length;
        self.cable_forces.forget_motion(element, excess, [before, change], force_jumps);
    }
}
