//! The first pass of a step: every cable that needs it is evaluated.

use pulp::Simd;
use rustc_hash::FxHashSet;

use super::{Pass, Sample, Stepper};
use crate::outcome::{Broken, Peak};
use crate::simulation::pack::{LANES, Wide};

/// Compiled for each instruction set and chosen at run time.
pub(super) struct Pull<'s, 'a>(pub &'s mut Stepper<'a>);

impl pulp::WithSimd for Pull<'_, '_> {
    type Output = Pass;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Pass {
        self.0.pull(simd)
    }
}

impl Stepper<'_> {
    #[inline(always)]
    fn pull<S: Simd>(&mut self, simd: S) -> Pass {
        self.interpolate_peak();
        let Self { part, wake, tension, u, stored, .. } = self;
        let (blocks, stored) = (&part.blocks.blocks[..], &mut stored[..part.blocks.blocks.len()]);
        let (u, mut tension) = (u.slices(), tension.slices());
        let (mut energy, mut force) = (self.asleep, [0.0; LANES]);
        let (mut greatest, mut hardest) = (Wide::splat(simd, self.record.force.value), None);
        for &n in &wake.blocks {
            let stress = tension.evaluate(simd, &blocks[n], u);
            stored[n] = stress.energy;
            let mut harder = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                Wide::load(simd, &stress.energy, lane).add_to(&mut energy, lane);
                let here = Wide::load(simd, &stress.force, lane);
                here.max(Wide::load(simd, &force, lane)).store(&mut force, lane);
                harder |= greatest.less(here).any();
            }
            if harder {
                greatest = Wide::splat(simd, stress.force.into_iter().fold(0.0, f64::max));
                hardest = Some(n);
            }
        }
        let mut pass = Pass { energy, force, ..Pass::default() };
        if let Some(block) = hardest {
            self.note_force(block);
        }
        if pass.force.iter().any(|&force| force > self.breaking_force) {
            self.cut_broken(&mut pass);
        }
        pass
    }

    /// A cable of a block pulls harder than any before it.
    fn note_force(&mut self, n: usize) {
        self.copy_velocities();
        let block = &self.part.blocks.blocks[n];
        for place in 0..block.len {
            let force = self.tension.force(block, place);
            if force > self.record.force.value {
                let cable = self.part.quotient.cable(self.part.blocks.cable(n, place));
                self.record.force = Peak { value: force, at: self.now(), place: cable };
                let before = self.signed_force(n, place, -self.step);
                self.sampled = Some(Sample { block: n, place, before });
            }
        }
    }

    /// Takes away the cables that pull past their breaking force; what they stored is lost.
    #[cold]
    fn cut_broken(&mut self, pass: &mut Pass) {
        let (at, mut cut) = (self.now(), Vec::new());
        self.record.cap(self.breaking_force);
        self.sampled = None;
        pass.force.iter_mut().for_each(|force| *force = force.min(self.breaking_force));
        for &n in &self.wake.blocks {
            let block = &self.part.blocks.blocks[n];
            for place in 0..block.len {
                if self.tension.force(block, place) > self.breaking_force {
                    let lost = self.tension.cut(block, place);
                    self.record.ledger.dissipated += lost;
                    pass.energy[place % LANES] -= lost;
                    self.stored[n][place % LANES] -= lost;
                    cut.push(self.part.blocks.cable(n, place));
                }
            }
        }
        // An image may be modelled, too, and break by itself.
        let mut known: FxHashSet<usize> = self.record.broken.iter().map(|broken| broken.cable).collect();
        let new =
            self.part.quotient.cables(self.scene, &cut).into_iter().filter(|&cable| known.insert(cable));
        self.record.broken.extend(new.map(|cable| Broken { at, cable }));
    }

    /// Finds the top of the greatest force between the samples around it.
    fn interpolate_peak(&mut self) {
        if let Some(Sample { block, place, before }) = self.sampled.take() {
            let after = self.signed_force(block, place, 0.0);
            self.record.vertex(before, after);
        }
    }

    /// k (L − L0) of one cable, its tires moved on by `ahead` [s] at their present velocity [N].
    fn signed_force(&self, block: usize, place: usize, ahead: f64) -> f64 {
        let block = &self.part.blocks.blocks[block];
        let mut length2 = 0.0;
        for c in 0..3 {
            let at = |end: usize| self.u.part[c][end + place] + ahead * self.v.part[c][end + place];
            length2 += (at(block.second) - at(block.first) + block.span[c]).powi(2);
        }
        block.stiffness * (length2.sqrt() - block.rest_length)
    }
}
