//! What happens to single tires within a step: they are higher than any before, land, or are fired at.

use std::ops::Range;

use nalgebra::Vector3;
use pulp::{Scalar, Simd};

use super::{Due, Part, Pass};
use crate::outcome::Peak;
use crate::simulation::contact::Flight;
use crate::simulation::kick::Tires;
use crate::simulation::pack::{LANES, Pack, Wide};
use crate::simulation::record::Record;
use crate::simulation::tension::Pulls;

/// A tire that was carried through the step by itself.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    pub tire: usize,
    /// Displacement at the end of the step [m].
    pub displacement: Vector3<f64>,
    /// Velocity at mid-step [m/s].
    pub velocity: Vector3<f64>,
}

/// The tires before the step, in slices of one length so that one check of bounds serves them all (`n_tires` + [`LANES`]).
#[derive(Clone, Copy)]
pub struct State<'s> {
    /// Displacement [m].
    u: [&'s [f64]; 3],
    /// Velocity at mid-step [m/s].
    v: [&'s [f64]; 3],
    pulls: Pulls<'s>,
    /// Masses [kg], and one over them [1/kg].
    masses: [&'s [f64]; 2],
}

impl<'s> State<'s> {
    /// Of arrays that the step will write.
    #[inline(always)]
    pub fn new(
        [x, y, z]: &'s [&mut [f64]; 3],
        [dx, dy, dz]: &'s [&mut [f64]; 3],
        pulls: Pulls<'s>,
        masses: [&'s [f64]; 2],
    ) -> Self {
        Self { u: [x, y, z], v: [dx, dy, dz], pulls, masses }
    }
}

/// Where things that happen to single tires are noted.
pub struct Events<'e> {
    /// Start of the step [s].
    pub now: f64,
    /// Its length [s].
    pub step: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// [m/s²].
    pub gravity: f64,
    pub part: &'e Part,
    pub record: &'e mut Record,
    pub pass: &'e mut Pass,
    pub carried: &'e mut Vec<Carried>,
}

impl Events<'_> {
    /// The tires in a register, from `at` on.
    #[inline(always)]
    pub fn tires<S: Simd>(&self, simd: S, state: State<'_>, at: usize) -> Tires<S> {
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
    pub fn happen(&mut self, state: State<'_>, tires: Range<usize>, ahead: Pack, mut fired: &[Due]) -> bool {
        for (tire, ahead) in tires.zip(ahead) {
            let (here, later) = fired.split_at(fired.partition_point(|due| due.tire <= tire));
            fired = later;
            let passes = ahead < 0.0 || !here.is_empty();
            let is_image = self.part.inverse[tire] == 0.0;
            if is_image || !passes && state.u[2][tire] <= self.record.height.value {
                continue;
            }
            let alone = self.tires(Scalar::new(), state, tire);
            let kicked = alone.kick(Scalar::new());
            let number = |wide: Wide<Scalar>| wide.pack()[0];
            let vector = |of: [Wide<Scalar>; 3]| Vector3::from(of.map(number));
            let (displacement, inverse) = (vector(alone.u), number(alone.inverse));
            let velocity = 0.5 * (vector(alone.v) + vector(kicked.v));
            let free = vector(alone.f) * inverse - Vector3::z() * self.gravity;
            if displacement.z > self.record.height.value {
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
