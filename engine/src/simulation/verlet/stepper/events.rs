//! Events of single tires within a step: a new greatest height, a landing, a launch.

use std::ops::Range;

use nalgebra::Vector3;
use pulp::{Scalar, Simd};

use super::impulses::{DueImpulse, Pushes, push_at_start};
use super::jumps::Jump;
use super::{Part, StepTotals};
use crate::outcome::Peak;
use crate::scene::Scene;
use crate::simulation::contact::TireStep;
use crate::simulation::pack::{LANES, Pack, Wide, components};
use crate::simulation::record::Record;
use crate::simulation::verlet::cable_forces::CableForces;
use crate::simulation::verlet::half_kicks::{PushedTire, TireAtStep, is_in_air};
use crate::simulation::verlet::kick::TireRegister;

/// Result for a tire that was integrated through the step by itself.
#[derive(Clone, Copy, Debug)]
pub struct Integrated {
    /// Index of the tire in the part.
    pub tire: usize,
    /// Displacement at the end of the step [m].
    pub displacement: Vector3<f64>,
    /// Velocity at mid-step [m/s].
    pub velocity: Vector3<f64>,
}

/// Tires before the step, as slices of one length, so that one bounds check serves all of them (`n_tires` + [`LANES`]).
#[derive(Clone, Copy)]
pub struct TiresBefore<'s> {
    /// Displacement [m].
    u: [&'s [f64]; 3],
    /// Velocity at mid-step [m/s].
    v: [&'s [f64]; 3],
    /// Cable forces [N].
    forces: CableForces<'s>,
    /// Masses [kg], and one over the masses [1/kg].
    masses: [&'s [f64]; 2],
}

impl<'s> TiresBefore<'s> {
    /// Views of arrays that the step will write later.
    #[inline(always)]
    pub fn new(
        [x, y, z]: &'s [&mut [f64]; 3],
        [vx, vy, vz]: &'s [&mut [f64]; 3],
        forces: CableForces<'s>,
        masses: [&'s [f64]; 2],
    ) -> Self {
        Self { u: [x, y, z], v: [vx, vy, vz], forces, masses }
    }
}

/// Data of the step that events need, and the places for their results.
pub struct EventContext<'e> {
    /// Start of the step [s].
    pub now: f64,
    /// Step [s].
    pub step: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// The scene.
    pub scene: &'e Scene,
    /// Modelled tires and cables.
    pub part: &'e Part,
    /// Record of the run.
    pub record: &'e mut Record,
    /// Energies and greatest values of the step.
    pub totals: &'e mut StepTotals,
    /// Tires of the present register that were integrated by themselves.
    pub integrated: &'e mut Vec<Integrated>,
    /// Jumps of tires in this step, if `notes_jumps`.
    pub jumped: &'e mut Vec<Jump>,
    /// Whether jumps are noted.
    pub notes_jumps: bool,
    /// Pushes that began in an earlier step or go on after this one.
    pub pushes: &'e mut Pushes,
}

impl EventContext<'_> {
    /// Tires of the register that begins at tire `at`.
    #[inline(always)]
    pub fn tires<S: Simd>(&self, simd: S, state: TiresBefore<'_>, at: usize) -> TireRegister<S> {
        let TiresBefore { u, v, forces, masses: [mass, inverse_mass] } = state;
        TireRegister {
            u: components!(c => Wide::load(simd, u[c], at)),
            v: components!(c => Wide::load(simd, v[c], at)),
            f: forces.sum_at(simd, self.part.blocks.ends.of(at / LANES), at % LANES),
            mass: Wide::load(simd, mass, at),
            inverse_mass: Wide::load(simd, inverse_mass, at),
            step: Wide::splat(simd, self.step),
            friction: Wide::splat(simd, self.friction),
            gravity: Wide::splat(simd, self.scene.gravity),
            downhill: [Wide::splat(simd, self.scene.downhill.x), Wide::splat(simd, self.scene.downhill.y)],
        }
    }

    /// Notes new greatest heights in the register of `tires`, and integrates each tire with a landing or an impulse by itself.
    /// Returns whether any tire was integrated.
    ///
    /// `ahead` is the height of each tire at the end of the step [m]. A tire with a negative height lands. `due` are the impulses
    /// on this register. The kick and the forces of these few tires are computed a second time: to keep the values of the registers
    /// would cost memory accesses at every step.
    #[cold]
    #[inline(never)]
    pub fn integrate_single_tires<const SLOPED: bool>(
        &mut self,
        state: TiresBefore<'_>,
        tires: Range<usize>,
        ahead: Pack,
        mut due: &[DueImpulse],
    ) -> bool {
        for (tire, ahead) in tires.zip(ahead) {
            let (here, later) = due.split_at(due.partition_point(|due| due.tire <= tire));
            due = later;
            let has_event = ahead < 0.0 || !here.is_empty();
            let is_image = self.part.inverse_mass[tire] == 0.0;
            if is_image || !has_event && state.u[2][tire] <= self.record.height.value {
                continue;
            }
            let alone = self.tires(Scalar::new(), state, tire);
            let moved = alone.kick_and_move::<SLOPED>(Scalar::new());
            let pushed = push_at_start(here, tire);
            let on_ground_before = self.pushes.pushed_on_ground(tire);
            let at_step = TireAtStep::new(&alone, &moved, self.scene.gravity(), pushed, on_ground_before);
            let TireAtStep { displacement, velocity, free, .. } = at_step;
            if displacement.z > self.record.height.value {
                let index = self.part.reduction.tire(tire);
                let peak = Peak { value: displacement.z, time: self.now, index };
                self.record.note_height(peak, velocity.z, free.z + pushed.z);
            }
            if has_event {
                self.totals.energy[0] += 0.5 * self.part.mass[tire] * at_step.more_speed2;
                self.totals.dissipated[0] -= at_step.booked_wrongly;
                self.integrate(at_step, tire, here);
            }
        }
        !self.integrated.is_empty()
    }

    /// Integrates one tire through the step, from tₙ to tₙ₊₁.
    fn integrate(&mut self, at_step: TireAtStep, tire: usize, due: &[DueImpulse]) {
        let TireAtStep { displacement, velocity, free, booked, without_event, .. } = at_step;
        let (h, move_of_step) = (self.step, without_event - displacement);
        let acceleration = (move_of_step - velocity * h) * (2.0 / (h * h));
        let mut motion = TireStep::new(displacement, velocity, free, self.friction, self.scene.restitution);
        let last = motion.integrate(h, due.iter().map(|due| due.impulse));
        let goes_on = self.pushes.is_pushed_after_step(tire);
        let velocity = TireAtStep::mid_step_velocity(&motion, last, goes_on, h);
        if goes_on && !is_in_air(&motion) {
            let push_acceleration = motion.push_acceleration;
            self.pushes.remember_on_ground(PushedTire { tire, velocity, push_acceleration });
        }
        let (height, until) = motion.peak;
        let index = self.part.reduction.tire(tire);
        self.record.note_top(Peak { value: height, time: self.now + until, index });
        self.totals.height[0] = self.totals.height[0].max(height);
        self.totals.moving |= velocity != Vector3::zeros() || motion.displacement.z > 0.0;
        let next_half = at_step.next_half(&motion, last, goes_on, h);
        let mass = self.part.mass[tire];
        self.totals.lost += mass * (motion.lost - next_half) - booked;
        self.totals.put_in += mass * motion.put_in;
        if self.notes_jumps {
            let (end, gained) = (without_event, last - acceleration);
            let jump = |(at, change)| Jump { tire, at, change, gained, end, move_of_step };
            // A push that goes on from an earlier step is no event.
            let is_event =
                |due: &&DueImpulse| due.impulse.launch != Vector3::zeros() || due.impulse.since_start > 0.0;
            let by_holes =
                due.iter().filter(is_event).map(|due| (due.impulse.since_start, due.impulse.launch));
            self.jumped.extend(by_holes.chain(motion.landing).map(jump));
        }
        self.integrated.push(Integrated { tire, displacement: motion.displacement, velocity });
    }
}
