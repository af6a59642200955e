//! The second pass of a step: kick and drift of the awake tires.

use pulp::Simd;

use super::events::{Carried, Events, State};
use super::{Pass, Stepper};
use crate::simulation::mirror::Image;
use crate::simulation::pack::{LANES, Wide};

/// Compiled for each instruction set and chosen at run time.
pub(super) struct Advance<'s, 'a>(pub &'s mut Stepper<'a>, pub &'s mut Pass);

impl pulp::WithSimd for Advance<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.0.advance(simd, self.1);
    }
}

impl Stepper<'_> {
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, pass: &mut Pass) {
        let zero = Wide::splat(simd, 0.0);
        let mut events = Events {
            now: self.now(),
            step: self.step,
            friction: self.friction,
            gravity: self.gravity,
            part: self.part,
            record: &mut self.record,
            pass,
            carried: &mut self.carried,
        };
        let Self { part, wake, tension, u, v, due, .. } = self;
        let (u, v, pulls) = (u.slices_mut(), v.slices_mut(), tension.pulls());
        let masses = [&part.mass[..u[0].len()], &part.inverse[..u[0].len()]];
        let (mut energy, mut dissipated) = ([0.0; LANES], [0.0; LANES]);
        let (mut height, mut motion) = ([0.0; LANES], [0.0; LANES]);
        let mut highest = Wide::splat(simd, events.record.height.value);
        let mut due = &due[..];
        for place in 0..wake.awake.len() {
            let pack = wake.awake[place];
            let mut moving = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                let at = pack * LANES + lane;
                let tires = events.tires(simd, State::new(&u, &v, pulls, masses), at);
                let kicked = tires.kick(simd);
                let higher = highest.less(tires.u[2]).any();
                let end = at + Wide::<S>::LEN;
                let fires = due.first().is_some_and(|due| due.tire < end);
                let mut carried = false;
                if higher || fires || kicked.u[2].less(zero).any() {
                    let (fired, later) = due.split_at(due.partition_point(|due| due.tire < end));
                    let state = State::new(&u, &v, pulls, masses);
                    carried = events.happen(state, at..end, kicked.u[2].pack(), fired);
                    highest = Wide::splat(simd, events.record.height.value);
                    due = later;
                }
                kicked.energy.add_to(&mut energy, lane);
                kicked.dissipated.add_to(&mut dissipated, lane);
                tires.u[2].max(Wide::load(simd, &height, lane)).store(&mut height, lane);
                kicked.motion.max(Wide::load(simd, &motion, lane)).store(&mut motion, lane);
                for c in 0..3 {
                    kicked.u[c].store(u[c], at);
                    kicked.v[c].store(v[c], at);
                }
                if carried {
                    for Carried { tire, displacement, velocity } in events.carried.drain(..) {
                        for c in 0..3 {
                            u[c][tire] = displacement[c];
                            v[c][tire] = velocity[c];
                        }
                    }
                    moving = true;
                }
                moving |= zero.less(kicked.motion).any();
            }
            wake.set_moving(pack, moving);
        }
        let pass = events.pass;
        for j in 0..LANES {
            pass.energy[j] += energy[j];
            pass.height[j] = pass.height[j].max(height[j]);
            pass.motion[j] = pass.motion[j].max(motion[j]);
        }
        pass.dissipated = dissipated;
    }

    /// Reflects kept tires into their images, but for their velocities, and keeps those on a mirror plane in it.
    pub(super) fn copy_images(&mut self) {
        let (u, v) = (self.u.slices_mut(), self.v.slices_mut());
        for &Image { of, from, sign } in &self.part.quotient.images {
            let mut moved = false;
            for c in 0..3 {
                let value = sign[c] * u[c][from];
                moved |= u[c][of] != value;
                u[c][of] = value;
                v[c][of] = if of == from { sign[c] * v[c][of] } else { 0.0 };
            }
            if moved {
                self.wake.set_moving(of / LANES, true);
            }
        }
    }

    /// Gives images the velocities of what they are images of, until [`Self::copy_images`].
    pub(super) fn copy_velocities(&mut self) {
        let v = self.v.slices_mut();
        for &Image { of, from, sign } in &self.part.quotient.images {
            for c in 0..3 {
                v[c][of] = sign[c] * v[c][from];
            }
        }
    }
}
