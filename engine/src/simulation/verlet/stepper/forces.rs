//! First pass of a step: cable forces, the greatest force, cables that break.

use pulp::Simd;
use rustc_hash::FxHashSet;

use super::{PeakCable, StepTotals, Stepper};
use crate::outcome::{BrokenCable, Peak};
use crate::simulation::pack::{LANES, Wide};

/// First pass; compiled for each instruction set and chosen at run time. `DAMPED`: the cables are damped.
pub(super) struct EvaluateCables<'s, 'a, const DAMPED: bool>(pub &'s mut Stepper<'a>);

impl<const DAMPED: bool> pulp::WithSimd for EvaluateCables<'_, '_, DAMPED> {
    type Output = StepTotals;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> StepTotals {
        self.0.evaluate_cables::<S, DAMPED>(simd)
    }
}

impl Stepper<'_> {
    /// Evaluates the cables of all blocks that are awake; returns their energy and greatest force.
    #[inline(always)]
    fn evaluate_cables<S: Simd, const DAMPED: bool>(&mut self, simd: S) -> StepTotals {
        if !DAMPED {
            self.interpolate_peak();
        }
        let Self { part, wake, cable_forces, u, stored, peak_blocks, strengths, step, .. } = self;
        let [weakest, strongest] = *strengths;
        let (blocks, stored) = (&part.blocks.blocks[..], &mut stored[..part.blocks.blocks.len()]);
        let (u, mut cable_forces) = (u.slices(), cable_forces.slices());
        let (mut energy, mut force, mut dissipated) =
            (self.asleep_elastic_energy, [0.0; LANES], [0.0; LANES]);
        let mut greatest = Wide::splat(simd, weakest * self.record.force.value);
        for &n in &wake.awake_blocks {
            let of_block = cable_forces.evaluate::<S, DAMPED>(simd, &blocks[n], u, *step);
            stored[n] = of_block.energy;
            if DAMPED {
                (0..LANES).for_each(|j| dissipated[j] += of_block.dissipated[j]);
            }
            let mut is_greater = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                Wide::load(simd, &of_block.energy, lane).add_to(&mut energy, lane);
                let here = Wide::load(simd, &of_block.force, lane);
                here.max(Wide::load(simd, &force, lane)).store(&mut force, lane);
                is_greater |= greatest.less(here).any();
            }
            if is_greater {
                let over_strength = of_block.force.into_iter().fold(0.0, f64::max) / strongest;
                greatest = Wide::splat(simd, weakest * over_strength.max(self.record.force.value));
                peak_blocks.push(n);
            }
        }
        if DAMPED {
            self.interpolate_peak();
        }
        let mut totals = StepTotals { energy, force, dissipated, ..StepTotals::default() };
        if !self.peak_blocks.is_empty() {
            self.copy_velocities();
            while let Some(block) = self.peak_blocks.pop() {
                self.note_force(block);
            }
        }
        if totals.force.iter().any(|&force| force > weakest * self.breaking_force) {
            self.break_cables(&mut totals);
        }
        totals
    }

    /// Notes the greatest force of block `n`, if it exceeds the greatest force so far.
    fn note_force(&mut self, n: usize) {
        let block = &self.part.blocks.blocks[n];
        for slot in 0..block.len {
            let force = self.force_over_strength(n, slot);
            if force > self.record.force.value {
                let before = self.cable_forces.slot_force_before(block, slot);
                // Right after a jump, the force is of first order only. `cross_jumps` has noted the force at the jump.
                if before == Some(f64::NEG_INFINITY) {
                    continue;
                }
                let index = self.part.reduction.cable(self.part.blocks.cable(n, slot));
                self.record.force = Peak { value: force, time: self.clock.now(), index };
                let force_before = match before {
                    Some(force) => force / self.strength(n, slot),
                    None => self.stretch_over_strength(n, slot, -self.step),
                };
                self.peak_to_refine = Some(PeakCable { block: n, slot, force_before });
            }
        }
    }

    /// Removes the cables whose force over strength exceeds the breaking force. Their elastic energy is lost.
    #[cold]
    fn break_cables(&mut self, totals: &mut StepTotals) {
        let (time, mut broken) = (self.clock.now(), Vec::new());
        let breaks = |n: usize| {
            let slots = 0..self.part.blocks.blocks[n].len;
            slots.into_iter().any(|slot| self.force_over_strength(n, slot) > self.breaking_force)
        };
        if !self.wake.awake_blocks.iter().copied().any(breaks) {
            return;
        }
        self.peak_to_refine = None;
        let mut hardest = (0.0, 0);
        totals.force.iter_mut().for_each(|force| *force = force.min(self.breaking_force));
        for &n in &self.wake.awake_blocks {
            let block = &self.part.blocks.blocks[n];
            for slot in 0..block.len {
                let force = self.force_over_strength(n, slot);
                if force > self.breaking_force {
                    let cable = self.part.blocks.cable(n, slot);
                    if force > hardest.0 {
                        hardest = (force, self.part.reduction.cable(cable));
                    }
                    let lost = self.cable_forces.remove(block, slot);
                    self.record.ledger.dissipated += lost;
                    totals.energy[slot % LANES] -= lost;
                    self.stored[n][slot % LANES] -= lost;
                    broken.push(cable);
                }
            }
        }
        self.record.note_break(self.breaking_force, time, hardest.1);
        // Two cables of the part may be images of each other, and both break by themselves. So cables found twice are left out.
        let mut broken_before: FxHashSet<usize> =
            self.record.broken.iter().map(|broken| broken.cable).collect();
        let with_images = self.part.reduction.cables_with_images(self.scene, &broken);
        let new = with_images.into_iter().filter(|&cable| broken_before.insert(cable));
        self.record.broken.extend(new.map(|cable| BrokenCable { time, cable }));
    }

    /// Moves the greatest force, found one step ago, to the top of the parabola through the forces of the steps around it.
    fn interpolate_peak(&mut self) {
        if let Some(PeakCable { block, slot, force_before }) = self.peak_to_refine.take() {
            let damped = self.cable_forces.slot_force_before(&self.part.blocks.blocks[block], slot).is_some();
            let after = match damped {
                true => self.force_over_strength(block, slot),
                false => self.stretch_over_strength(block, slot, 0.0),
            };
            self.record.interpolate_force(force_before, after);
        }
    }

    /// Force of the cable in a slot of a block over its strength [N]; 0 for an empty slot.
    fn force_over_strength(&self, block: usize, slot: usize) -> f64 {
        let force = self.cable_forces.slot_force(&self.part.blocks.blocks[block], slot);
        if force > 0.0 { force / self.strength(block, slot) } else { 0.0 }
    }

    /// Strength of the cable in a slot of a block.
    pub(super) fn strength(&self, block: usize, slot: usize) -> f64 {
        self.scene.strength(self.part.reduction.cable(self.part.blocks.cable(block, slot)))
    }

    /// k (L − L0) over strength of the cable in a slot of a block [N]. Its tires are moved on for the time `ahead` [s] at their
    /// present velocity.
    fn stretch_over_strength(&self, block: usize, slot: usize, ahead: f64) -> f64 {
        let cable = self.part.blocks.cable_in(&self.part.blocks.blocks[block], slot);
        let moved = |tire: usize| self.u.vector(tire) + ahead * self.v.vector(tire);
        let force = cable.stretch_force(cable.between(cable.ends.map(moved)).norm());
        force / self.strength(block, slot)
    }
}
