//! One run: the state that changes from step to step, and the step itself.

mod advance;
mod events;
mod forces;
mod impulses;
mod jumps;

use nalgebra::{Vector2, Vector3};

use self::advance::MoveTires;
use self::events::Integrated;
use self::forces::EvaluateCables;
use self::impulses::{DueImpulse, Pushes, push_at_start};
use self::jumps::Jump;
use super::Part;
use crate::outcome::{EndReason, Outcome};
use crate::scene::{Firing, Scene, Shot};
use crate::simulation::clock::Clock;
use crate::simulation::contact::stop_at_ground;
use crate::simulation::pack::{LANES, Pack, VectorArrays};
use crate::simulation::record::Record;
use crate::simulation::verlet::cable_forces::CableForceMemory;
use crate::simulation::wake::Wake;
use crate::simulation::{Motion, RunError, RunSettings, Watcher};

/// Cable of the greatest force.
#[derive(Clone, Copy, Debug)]
struct PeakCable {
    block: usize,
    slot: usize,
    /// k (L − L0) over strength one step earlier [N]; for a damped cable its whole force over strength.
    force_before: f64,
}

/// Energies [J] and greatest values of one step, most of them by lane.
#[derive(Clone, Copy, Debug, Default)]
struct StepTotals {
    energy: Pack,
    /// Energy that friction dissipates in the kick, half of it before and half after the start of the step.
    dissipated: Pack,
    /// Greatest height [m].
    height: Pack,
    /// Greatest cable force [N].
    force: Pack,
    /// Whether any tire is not at rest on the ground.
    moving: bool,
    /// Energy lost in events, over the whole step.
    lost: f64,
    /// Energy that holes put in.
    put_in: f64,
}

/// State of one run.
pub(super) struct Stepper<'a> {
    scene: &'a Scene,
    part: &'a Part,
    /// Firings under kept tires, in order of time.
    firings: Vec<Firing>,
    /// Step [s].
    step: f64,
    friction: f64,
    /// Force above which a cable of strength 1 breaks [N]; infinite if cables never break.
    breaking_force: f64,
    /// Least and greatest strength of a cable.
    strengths: [f64; 2],
    /// Blocks that may hold the greatest force so far.
    peak_blocks: Vec<usize>,
    clock: Clock,
    /// Whether any tire moved in the last step.
    moving: bool,
    record: Record,
    /// Cable of the greatest force, if that force was found one step ago.
    peak_to_refine: Option<PeakCable>,
    /// Impulses of the present step, in order of tires, then of time.
    due: Vec<DueImpulse>,
    pushes: Pushes,
    /// Jumps of tires in the present step that matter to the force of cables.
    jumped: Vec<Jump>,
    /// Tires of the present register that were integrated by themselves.
    integrated: Vec<Integrated>,
    wake: Wake<'a>,
    cable_forces: CableForceMemory<'a>,
    /// Displacement [m] (`n_tires` + [`LANES`]).
    u: VectorArrays,
    /// Velocity at mid-step [m/s] (`n_tires` + [`LANES`]).
    v: VectorArrays,
    /// Elastic energy of each block at its last evaluation [J] (`n_blocks`).
    stored: Vec<Pack>,
    /// Elastic energy of all blocks asleep [J].
    asleep_elastic_energy: Pack,
    /// Potential energy of all tires asleep on the slope [J].
    asleep_slope_energy: f64,
}

impl<'a> Stepper<'a> {
    /// Run of `shot` under `scene`, before the first step.
    pub(super) fn new(part: &'a Part, scene: &'a Scene, shot: &Shot, settings: &RunSettings) -> Self {
        let tires = part.reduction.weight.len();
        let firings = part.reduction.firings(shot);
        let friction = shot.friction.unwrap_or(scene.friction);
        let slides = scene.slides(friction);
        let mut wake = Wake::new(&part.ties);
        // The last cables may read one pack beyond the last tire.
        let (u, mut v) = (VectorArrays::zeros(tires + LANES), VectorArrays::zeros(tires + LANES));
        if slides {
            wake.set_all_moving();
            // The motion is at rest at the start. This is its velocity half a step before.
            let acceleration = scene.downhill - scene.downhill.normalize() * (friction * scene.gravity);
            let before = -0.5 * settings.step * acceleration;
            (0..2).for_each(|c| v.components[c][..tires].fill(before[c]));
        }
        Self {
            scene,
            part,
            step: settings.step,
            friction,
            breaking_force: scene.breaking_force.unwrap_or(f64::INFINITY),
            strengths: [f64::min, f64::max]
                .map(|of| scene.strength.iter().copied().reduce(of).unwrap_or(1.0)),
            peak_blocks: Vec::with_capacity(part.blocks.blocks.len()),
            clock: Clock::new(shot, settings, slides),
            moving: slides,
            record: Record::new(settings.step),
            peak_to_refine: None,
            due: Vec::with_capacity(2 * firings.len()),
            pushes: Pushes::with_capacity(firings.len()),
            jumped: Vec::with_capacity(tires + 2 * firings.len()),
            firings,
            integrated: Vec::with_capacity(LANES),
            wake,
            cable_forces: CableForceMemory::new(&part.blocks, &part.viscosity),
            u,
            v,
            stored: vec![[0.0; LANES]; part.blocks.blocks.len()],
            asleep_elastic_energy: [0.0; LANES],
            asleep_slope_energy: 0.0,
        }
    }

    /// Makes all steps with the registers of `arch`; returns the outcome.
    pub(super) fn run(mut self, arch: pulp::Arch, watch: &mut Watcher<'_>) -> Result<Outcome, RunError> {
        loop {
            if let Some(reason) = self.clock.skip_rest_or_end(self.moving, &self.firings) {
                return Ok(self.finish(reason));
            }
            self.collect_due_impulses();
            self.copy_images();
            if self.wake.refresh() {
                self.move_stored_energy();
                self.sum_energy_on_slope();
            }
            let mut totals = match self.scene.damping > 0.0 {
                false => arch.dispatch(EvaluateCables::<false>(&mut self)),
                true => arch.dispatch(EvaluateCables::<true>(&mut self)),
            };
            if watch(&Snapshot { stepper: &self }).is_break() {
                return Err(RunError::Stopped { time: self.clock.now() });
            }
            match self.scene.downhill == Vector2::zeros() {
                true => arch.dispatch(MoveTires::<false>(&mut self, &mut totals)),
                false => arch.dispatch(MoveTires::<true>(&mut self, &mut totals)),
            }
            if !self.jumped.is_empty() {
                self.cross_jumps();
            }
            self.end_step(&totals)?;
        }
    }

    /// Adds the energy of blocks that fell asleep to the energy asleep, and takes off the energy of blocks that woke.
    fn move_stored_energy(&mut self) {
        for &block in &self.wake.fell_asleep {
            (0..LANES).for_each(|j| self.asleep_elastic_energy[j] += self.stored[block][j]);
        }
        for &block in &self.wake.woke {
            (0..LANES).for_each(|j| self.asleep_elastic_energy[j] -= self.stored[block][j]);
        }
    }

    /// Sums the potential energy of the tires asleep on the slope. On level ground it is 0.
    fn sum_energy_on_slope(&mut self) {
        let Self { scene, part, wake, u, .. } = self;
        if scene.downhill == Vector2::zeros() {
            return;
        }
        let tires = (0..part.reduction.weight.len()).filter(|tire| !wake.is_awake(tire / LANES));
        let energy = |tire: usize| -part.mass[tire] * scene.downhill.dot(&u.vector(tire).xy());
        self.asleep_slope_energy = tires.map(energy).sum();
    }

    /// Writes the step to ledger and history, and ticks the clock.
    fn end_step(&mut self, totals: &StepTotals) -> Result<(), RunError> {
        let greatest = |of: &Pack| of.iter().copied().fold(0.0, f64::max);
        let energy = totals.energy.iter().sum::<f64>() + self.asleep_slope_energy;
        let dissipated = totals.dissipated.iter().sum::<f64>();
        let now = self.clock.now();
        if !(energy + dissipated).is_finite() {
            return Err(RunError::Diverged { time: now });
        }
        self.record.balance_energy(energy, 0.5 * dissipated);
        self.record.ledger.dissipated += dissipated + totals.lost;
        self.record.ledger.put_in += totals.put_in;
        self.record.history.note(now, greatest(&totals.height), greatest(&totals.force));
        self.moving = totals.moving;
        self.clock.tick();
        Ok(())
    }

    /// Outcome at the end of the run. If the last step exceeds the end, the tires move back by the difference.
    fn finish(self, reason: EndReason) -> Outcome {
        let past = self.clock.overshoot();
        let Self { part, u, v, record, clock, .. } = self;
        // Images still have the state of the step before, so they are left out.
        let kept = part.reduction.weight.iter().enumerate().filter(|&(_, &weight)| weight > 0.0);
        let tires = kept.map(|(tire, _)| (part.reduction.tire(tire), u.vector(tire) - v.vector(tire) * past));
        record.finish(tires, &clock, reason)
    }
}

/// The shelter between the evaluation of the cables and the kick.
struct Snapshot<'s, 'a> {
    stepper: &'s Stepper<'a>,
}

impl Snapshot<'_, '_> {
    /// Acceleration of a kept tire by everything except the ground [m/s²].
    fn acceleration(&self, kept: usize) -> Vector3<f64> {
        let Stepper { part, cable_forces, scene, due, .. } = self.stepper;
        let ends = part.blocks.ends.of(kept / LANES);
        let forces = cable_forces.forces().sum_at(pulp::Scalar::new(), ends, kept % LANES);
        let force = Vector3::from(forces.map(|force| force.pack()[0]));
        force * part.inverse_mass[kept] + scene.gravity() + push_at_start(due, kept)
    }

    /// Velocity of a tire of the scene now [m/s]: half a kick after the velocity at mid-step. With the velocity at mid-step, the
    /// force of a damped cable would be half a step old.
    fn velocity(&self, tire: usize) -> Vector3<f64> {
        let Stepper { part, step, u, v, friction, .. } = self.stepper;
        let (kept, [x, y]) = part.reduction.image_of(tire);
        let free = v.vector(kept) + 0.5 * step * self.acceleration(kept);
        let now = if u.vector(kept).z > 0.0 { free } else { stop_at_ground(free, *friction).0 };
        now.component_mul(&Vector3::new(x, y, 1.0))
    }
}

impl Motion for Snapshot<'_, '_> {
    fn time(&self) -> f64 {
        self.stepper.clock.now()
    }

    fn displacement(&self, tire: usize) -> Vector3<f64> {
        let (kept, [x, y]) = self.stepper.part.reduction.image_of(tire);
        self.stepper.u.vector(kept).component_mul(&Vector3::new(x, y, 1.0))
    }

    fn force(&self, cable: usize) -> f64 {
        let Stepper { scene, record, .. } = self.stepper;
        if record.broken.iter().any(|broken| broken.cable == cable) {
            return 0.0;
        }
        let cable = &scene.cables[cable];
        let between = cable.between(cable.ends.map(|end| self.displacement(end)));
        let length = between.norm();
        let [first, second] = cable.ends.map(|end| self.velocity(end));
        let viscous = scene.viscosity(cable) * between.dot(&(second - first)) / length;
        if length > cable.rest_length { (cable.force(length) + viscous).max(0.0) } else { 0.0 }
    }

    fn friction(&self, tire: usize) -> (f64, f64) {
        if self.displacement(tire).z > 0.0 || self.stepper.scene.is_anchor(tire) {
            return (0.0, 0.0);
        }
        let Stepper { part, step, .. } = self.stepper;
        let (tire, _) = part.reduction.image_of(tire);
        let impulse_to_force = 1.0 / (part.inverse_mass[tire] * step);
        let free = self.stepper.v.vector(tire) + self.acceleration(tire) * *step;
        let (after, normal) = stop_at_ground(free, self.stepper.friction);
        ((free - after).xy().norm() * impulse_to_force, self.stepper.friction * normal * impulse_to_force)
    }
}
