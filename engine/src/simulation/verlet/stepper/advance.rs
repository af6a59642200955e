//! Second pass of a step: kick and move of the awake tires, and copies of the kept tires to their images.

use pulp::Simd;

use super::events::{EventContext, Integrated, TiresBefore};
use super::{StepTotals, Stepper};
use crate::simulation::pack::{LANES, Wide};
use crate::simulation::verlet::mirror_reduction::Image;

/// Second pass; compiled for each instruction set and chosen at run time. `SLOPED`: the ground slopes.
pub(super) struct MoveTires<'s, 'a, const SLOPED: bool>(pub &'s mut Stepper<'a>, pub &'s mut StepTotals);

impl<const SLOPED: bool> pulp::WithSimd for MoveTires<'_, '_, SLOPED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.0.move_tires::<S, SLOPED>(simd, self.1);
    }
}

impl Stepper<'_> {
    /// Kicks and moves the awake tires, and adds their energies and greatest values to `totals`.
    #[inline(always)]
    fn move_tires<S: Simd, const SLOPED: bool>(&mut self, simd: S, totals: &mut StepTotals) {
        let zero = Wide::splat(simd, 0.0);
        let mut events = EventContext {
            now: self.clock.now(),
            step: self.step,
            friction: self.friction,
            scene: self.scene,
            part: self.part,
            record: &mut self.record,
            totals,
            integrated: &mut self.integrated,
            pushes: &mut self.pushes,
            jumped: &mut self.jumped,
            // Without damping, only a peak that lies between two steps needs the jumps.
            notes_jumps: self.scene.damping > 0.0 || self.peak_to_refine.is_some(),
        };
        let Self { part, wake, cable_forces, u, v, due, .. } = self;
        let (u, v, forces) = (u.slices_mut(), v.slices_mut(), cable_forces.forces());
        let masses = [&part.mass[..u[0].len()], &part.inverse_mass[..u[0].len()]];
        let (mut energy, mut dissipated) = ([0.0; LANES], [0.0; LANES]);
        let (mut height, mut any_moving) = ([0.0; LANES], false);
        let mut highest = Wide::splat(simd, events.record.height.value);
        let mut due = &due[..];
        for n in 0..wake.awake_packs.len() {
            let pack = wake.awake_packs[n];
            let mut moving = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                let first = pack * LANES + lane;
                let tires = events.tires(simd, TiresBefore::new(&u, &v, forces, masses), first);
                let moved = tires.kick_and_move::<SLOPED>(simd);
                let is_higher_or_lands = highest.less(tires.u[2]).or(moved.u[2].less(zero));
                let end = first + Wide::<S>::LEN;
                let fires = due.first().is_some_and(|due| due.tire < end);
                let mut any_integrated = false;
                if is_higher_or_lands.any() || fires {
                    let (fired, later) = due.split_at(due.partition_point(|due| due.tire < end));
                    let state = TiresBefore::new(&u, &v, forces, masses);
                    any_integrated =
                        events.integrate_single_tires::<SLOPED>(state, first..end, moved.u[2].pack(), fired);
                    highest = Wide::splat(simd, events.record.height.value);
                    due = later;
                }
                moved.energy.add_to(&mut energy, lane);
                moved.dissipated.add_to(&mut dissipated, lane);
                tires.u[2].max(Wide::load(simd, &height, lane)).store(&mut height, lane);
                for c in 0..3 {
                    moved.u[c].store(u[c], first);
                    moved.v[c].store(v[c], first);
                }
                if any_integrated {
                    for Integrated { tire, displacement, velocity } in events.integrated.drain(..) {
                        for c in 0..3 {
                            u[c][tire] = displacement[c];
                            v[c][tire] = velocity[c];
                        }
                    }
                    moving = true;
                }
                let is_moving = moved.moving.any_but_zero();
                (moving, any_moving) = (moving | is_moving, any_moving | is_moving);
            }
            wake.set_moving(pack, moving);
        }
        let totals = events.totals;
        for j in 0..LANES {
            totals.energy[j] += energy[j];
            totals.dissipated[j] += dissipated[j];
            totals.height[j] = totals.height[j].max(height[j]);
        }
        totals.moving |= any_moving;
    }

    /// Copies the reflected displacements of kept tires to their images, and keeps tires on a mirror plane in the plane.
    ///
    /// Images have no velocity, so that they do not move on.
    pub(super) fn copy_images(&mut self) {
        if self.part.reduction.images.is_empty() {
            return;
        }
        let (u, v) = (self.u.slices_mut(), self.v.slices_mut());
        for &Image { written, read, sign } in &self.part.reduction.images {
            let mut moved = false;
            for c in 0..3 {
                let value = sign[c] * u[c][read];
                moved |= u[c][written] != value;
                u[c][written] = value;
                v[c][written] = if written == read { sign[c] * v[c][written] } else { 0.0 };
            }
            if moved {
                self.wake.set_moving(written / LANES, true);
            }
        }
    }

    /// Gives images the reflected velocities of their kept tires, until the next [`Self::copy_images`].
    pub(super) fn copy_velocities(&mut self) {
        let v = self.v.slices_mut();
        for &Image { written, read, sign } in &self.part.reduction.images {
            for c in 0..3 {
                v[c][written] = sign[c] * v[c][read];
            }
        }
    }
}
