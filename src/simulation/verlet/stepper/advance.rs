//! The second pass of a step: kick and drift of the awake tires, and what happens to some of them within the step.

use std::ops::Range;

use nalgebra::Vector3;
use pulp::{Scalar, Simd};

use super::{Due, Part, Pass, Stepper};
use crate::outcome::Peak;
use crate::simulation::contact::Flight;
use crate::simulation::kick::Tires;
use crate::simulation::mirror::Image;
use crate::simulation::pack::{LANES, Pack, Wide};
use crate::simulation::record::Record;
use crate::simulation::tension::Pulls;

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

    /// Reflects kept tires into their images and keeps those on a mirror plane in it. Nobody asks how fast an image moves
    /// but [`Self::copy_velocities`].
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

    /// Gives images the velocities of what they are images of, until they are copied next.
    pub(super) fn copy_velocities(&mut self) {
        let v = self.v.slices_mut();
        for &Image { of, from, sign } in &self.part.quotient.images {
            for c in 0..3 {
                v[c][of] = sign[c] * v[c][from];
            }
        }
    }
}

/// A tire that was carried through the step by itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried {
    tire: usize,
    displacement: Vector3<f64>,
    velocity: Vector3<f64>,
}

/// The tires before the step.
#[derive(Clone, Copy)]
struct State<'s> {
    u: [&'s [f64]; 3],
    v: [&'s [f64]; 3],
    pulls: Pulls<'s>,
    /// Masses [kg], and one over them [1/kg].
    masses: [&'s [f64]; 2],
}

impl<'s> State<'s> {
    #[inline(always)]
    fn new(
        [x, y, z]: &'s [&mut [f64]; 3],
        [dx, dy, dz]: &'s [&mut [f64]; 3],
        pulls: Pulls<'s>,
        masses: [&'s [f64]; 2],
    ) -> Self {
        Self { u: [x, y, z], v: [dx, dy, dz], pulls, masses }
    }
}

/// Where things that happen to single tires are noted.
struct Events<'e> {
    now: f64,
    step: f64,
    friction: f64,
    gravity: f64,
    part: &'e Part,
    record: &'e mut Record,
    pass: &'e mut Pass,
    carried: &'e mut Vec<Carried>,
}

impl Events<'_> {
    /// The tires in a register, from `at` on.
    #[inline(always)]
    fn tires<S: Simd>(&self, simd: S, state: State<'_>, at: usize) -> Tires<S> {
        let State { u, v, pulls, masses: [mass, inverse] } = state;
        Tires {
            u: [0, 1, 2].map(|c| Wide::load(simd, u[c], at)),
            v: [0, 1, 2].map(|c| Wide::load(simd, v[c], at)),
            f: pulls.at(simd, self.part.blocks.ends.of(at / LANES), at % LANES),
            mass: Wide::load(simd, mass, at),
            inverse: Wide::load(simd, inverse, at),
            step: Wide::splat(simd, self.step),
            friction: Wide::splat(simd, self.friction),
            gravity: Wide::splat(simd, self.gravity),
        }
    }

    /// Some of the tires in a register are higher than any before, will land (be below the ground, `ahead` [m]) or are `fired`
    /// at; whether any lands or is fired at.
    ///
    /// Evaluates them again, one by one: what it took from registers would have to be kept in memory at every step.
    #[cold]
    #[inline(never)]
    fn happen(&mut self, state: State<'_>, tires: Range<usize>, ahead: Pack, mut fired: &[Due]) -> bool {
        for (tire, ahead) in tires.zip(ahead) {
            let (here, later) = fired.split_at(fired.partition_point(|due| due.tire <= tire));
            fired = later;
            let passes = ahead < 0.0 || !here.is_empty();
            if !passes && state.u[2][tire] <= self.record.height.value {
                continue;
            }
            let alone = self.tires(Scalar::new(), state, tire);
            let kicked = alone.kick(Scalar::new());
            let number = |wide: Wide<Scalar>| wide.pack()[0];
            let vector = |of: [Wide<Scalar>; 3]| Vector3::from(of.map(number));
            let (displacement, inverse) = (vector(alone.u), number(alone.inverse));
            let velocity = 0.5 * (vector(alone.v) + vector(kicked.v));
            let free = vector(alone.f) * inverse - Vector3::z() * self.gravity;
            // An image is as high as its kept tire, but knows no force.
            if displacement.z > self.record.height.value && inverse > 0.0 {
                let place = self.part.quotient.tire(tire);
                let sample = Peak { value: displacement.z, at: self.now, place };
                self.record.higher(sample, velocity.z, free.z);
            }
            if !passes {
                continue;
            }
            let flight = Flight {
                displacement,
                velocity,
                free,
                friction: self.friction,
                lost: 0.0,
                put_in: 0.0,
                elapsed: 0.0,
                top: (0.0, 0.0),
            };
            self.carry(flight, tire, here, number(kicked.dissipated));
        }
        !self.carried.is_empty()
    }

    /// Carries a tire that lands or is `fired` at through the step; its kick has dissipated some energy [J] already.
    fn carry(&mut self, mut flight: Flight, tire: usize, fired: &[Due], dissipated: f64) {
        let h = self.step;
        let last = flight.through(h, fired.iter().map(|due| (due.after, due.launch)));
        let velocity = flight.velocity - last * (0.5 * h);
        // A flight within the step is seen by no sample.
        let (height, until) = flight.top;
        if height > self.record.height.value {
            let place = self.part.quotient.tire(tire);
            self.record.height = Peak { value: height, at: self.now + until, place };
        }
        self.pass.height[0] = self.pass.height[0].max(height);
        self.pass.motion[0] = self.pass.motion[0].max(velocity.amax()).max(flight.displacement.z);
        // The kicks before and after count half a step of friction each; here the whole step is counted at once.
        let next_half = 0.5 * h * (flight.free - last).xy().dot(&flight.velocity.xy());
        let mass = self.part.mass[tire];
        self.pass.lost += mass * (flight.lost - next_half) - 0.5 * dissipated;
        self.pass.put_in += mass * flight.put_in;
        self.carried.push(Carried { tire, displacement: flight.displacement, velocity });
    }
}
