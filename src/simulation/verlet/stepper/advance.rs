//! The second pass of a step: kick and drift of the awake tires, and what happens to some of them within the step.

use nalgebra::Vector3;
use pulp::Simd;

use super::{Due, Pass, Stepper};
use crate::outcome::Peak;
use crate::simulation::contact::Flight;
use crate::simulation::kick::{Kicked, Tires};
use crate::simulation::mirror::{Image, Quotient};
use crate::simulation::pack::{LANES, Pack, Wide};
use crate::simulation::record::Record;

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
        let (step, friction) = (Wide::splat(simd, self.step), Wide::splat(simd, self.friction));
        let gravity = Wide::splat(simd, self.gravity);
        let mut events = Events {
            now: self.now(),
            step: self.step,
            friction: self.friction,
            gravity: self.gravity,
            quotient: &self.part.quotient,
            record: &mut self.record,
            pass,
        };
        let Self { part, wake, tension, u, v, due, .. } = self;
        let (u, v, pulls) = (u.slices_mut(), v.slices_mut(), tension.pulls());
        let (mass, inverse) = (&part.mass[..u[0].len()], &part.inverse[..u[0].len()]);
        let (mut energy, mut dissipated) = ([0.0; LANES], [0.0; LANES]);
        let (mut height, mut motion) = ([0.0; LANES], [0.0; LANES]);
        let mut highest = Wide::splat(simd, events.record.height.value);
        let mut due = &due[..];
        for place in 0..wake.awake.len() {
            let pack = wake.awake[place];
            let mut moving = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                let at = pack * LANES + lane;
                let tires = Tires {
                    u: [0, 1, 2].map(|c| Wide::load(simd, u[c], at)),
                    v: [0, 1, 2].map(|c| Wide::load(simd, v[c], at)),
                    f: pulls.at(simd, part.blocks.ends.of(pack), lane),
                    mass: Wide::load(simd, mass, at),
                    inverse: Wide::load(simd, inverse, at),
                    step,
                    friction,
                    gravity,
                };
                let mut kicked = tires.kick(simd);
                if highest.less(tires.u[2]).any() {
                    events.note_heights(at, &tires, &kicked);
                    highest = Wide::splat(simd, events.record.height.value);
                }
                let end = at + Wide::<S>::LEN;
                if due.first().is_some_and(|due| due.tire < end) || kicked.u[2].less(zero).any() {
                    let (fired, later) = due.split_at(due.partition_point(|due| due.tire < end));
                    events.pass_through(simd, at, fired, &tires, &mut kicked);
                    due = later;
                    moving = true;
                }
                kicked.energy.add_to(&mut energy, lane);
                kicked.dissipated.add_to(&mut dissipated, lane);
                tires.u[2].max(Wide::load(simd, &height, lane)).store(&mut height, lane);
                kicked.motion.max(Wide::load(simd, &motion, lane)).store(&mut motion, lane);
                for c in 0..3 {
                    kicked.u[c].store(u[c], at);
                    kicked.v[c].store(v[c], at);
                }
                moving |= zero.less(kicked.motion).any();
            }
            wake.set_moving(pack, moving);
        }
        let pass = events.pass;
        for j in 0..LANES {
            pass.energy[j] += energy[j];
            pass.height[j] = pass.height[j].max(height[j]);
        }
        (pass.dissipated, pass.motion) = (dissipated, motion);
    }

    /// Reflects kept tires into their images and keeps those on a mirror plane in it.
    pub(super) fn copy_images(&mut self) {
        let (u, v) = (self.u.slices_mut(), self.v.slices_mut());
        for &Image { of, from, sign } in &self.part.quotient.images {
            let mut moved = false;
            for c in 0..3 {
                for part in [&mut *u[c], &mut *v[c]] {
                    let value = sign[c] * part[from];
                    moved |= part[of] != value;
                    part[of] = value;
                }
            }
            if moved {
                self.wake.set_moving(of / LANES, true);
            }
        }
    }
}

/// Where things that happen to single tires are noted.
struct Events<'e> {
    now: f64,
    step: f64,
    friction: f64,
    gravity: f64,
    quotient: &'e Quotient,
    record: &'e mut Record,
    pass: &'e mut Pass,
}

impl Events<'_> {
    /// Some tires in a register are higher than any before them.
    fn note_heights<S: Simd>(&mut self, at: usize, tires: &Tires<S>, kicked: &Kicked<S>) {
        let (height, inverse) = (tires.u[2].pack(), tires.inverse.pack());
        let (before, after, force) = (tires.v[2].pack(), kicked.v[2].pack(), tires.f[2].pack());
        for j in 0..Wide::<S>::LEN {
            if height[j] > self.record.height.value {
                let place = self.quotient.tire(at + j);
                let sample = Peak { value: height[j], at: self.now, place };
                let velocity = 0.5 * (before[j] + after[j]);
                self.record.higher(sample, velocity, force[j] * inverse[j] - self.gravity);
            }
        }
    }

    /// Carries the tires in a register that land or are `fired` at through the step.
    fn pass_through<S: Simd>(
        &mut self,
        simd: S,
        at: usize,
        mut fired: &[Due],
        tires: &Tires<S>,
        kicked: &mut Kicked<S>,
    ) {
        let [u, v, f] = [tires.u, tires.v, tires.f].map(|of| of.map(Wide::pack));
        let [mut moved, mut mid] = [kicked.u, kicked.v].map(|of| of.map(Wide::pack));
        let (mass, inverse) = (tires.mass.pack(), tires.inverse.pack());
        let (dissipated, mut motion) = (kicked.dissipated.pack(), kicked.motion.pack());
        let h = self.step;
        for j in 0..Wide::<S>::LEN {
            let (here, later) = fired.split_at(fired.partition_point(|due| due.tire <= at + j));
            fired = later;
            if here.is_empty() && moved[2][j] >= 0.0 {
                continue;
            }
            let vector = |of: &[Pack; 3]| Vector3::new(of[0][j], of[1][j], of[2][j]);
            let mut flight = Flight {
                displacement: vector(&u),
                velocity: 0.5 * (vector(&v) + vector(&mid)),
                free: vector(&f) * inverse[j] - Vector3::z() * self.gravity,
                friction: self.friction,
                lost: 0.0,
                put_in: 0.0,
                elapsed: 0.0,
                top: (0.0, 0.0),
            };
            let last = flight.through(h, here.iter().map(|due| (due.after, due.launch)));
            let after = flight.velocity - last * (0.5 * h);
            // A flight within the step is seen by no sample.
            let (height, until) = flight.top;
            if height > self.record.height.value {
                let place = self.quotient.tire(at + j);
                self.record.height = Peak { value: height, at: self.now + until, place };
            }
            self.pass.height[0] = self.pass.height[0].max(height);
            for c in 0..3 {
                moved[c][j] = flight.displacement[c];
                mid[c][j] = after[c];
            }
            motion[j] = motion[j].max(after.amax()).max(flight.displacement.z);
            // The kicks before and after count half a step of friction each; here the whole step is counted at once.
            let next_half = 0.5 * h * (flight.free - last).xy().dot(&flight.velocity.xy());
            self.pass.lost += mass[j] * (flight.lost - next_half) - 0.5 * dissipated[j];
            self.pass.put_in += mass[j] * flight.put_in;
        }
        [kicked.u, kicked.v] = [moved, mid].map(|of| of.map(|part| Wide::load(simd, &part, 0)));
        kicked.motion = Wide::load(simd, &motion, 0);
    }
}
