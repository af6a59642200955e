//! One run: what changes from step to step, and the step itself.

mod advance;
mod events;
mod pull;

use nalgebra::Vector3;

use self::advance::Advance;
use self::events::Carried;
use self::pull::Pull;
use super::Part;
use crate::outcome::{End, Outcome};
use crate::scene::{Firing, Scene, Shot};
use crate::simulation::cable::Field;
use crate::simulation::contact::support;
use crate::simulation::pack::{LANES, Pack};
use crate::simulation::record::{Clock, Record};
use crate::simulation::tension::Tension;
use crate::simulation::wake::Wake;
use crate::simulation::{Failure, Motion, Settings, Watcher, time_limit};

/// A hole that fires within the present step.
#[derive(Clone, Copy, Debug)]
struct Due {
    tire: usize,
    /// After the start of the step [s].
    after: f64,
    launch: f64,
}

/// Where the greatest force was sampled.
#[derive(Clone, Copy, Debug)]
struct Sample {
    block: usize,
    place: usize,
    /// k (L − L0) a step earlier [N].
    before: f64,
}

/// Energies [J] and greatest values of one pass, in parts by lane.
#[derive(Clone, Copy, Debug, Default)]
struct Pass {
    energy: Pack,
    dissipated: Pack,
    /// Greatest height [m], force [N], and speed or height.
    height: Pack,
    force: Pack,
    motion: Pack,
    /// Dissipated through events, whole and not by halves.
    lost: f64,
    put_in: f64,
}

pub(super) struct Stepper<'a> {
    scene: &'a Scene,
    part: &'a Part,
    firings: Vec<Firing>,
    step: f64,
    friction: f64,
    gravity: f64,
    /// Force at which a cable is gone [N].
    breaking_force: f64,
    time_limit: f64,
    clock: Clock,
    moving: bool,
    record: Record,
    /// The cable of the greatest force, if sampled in the step before.
    sampled: Option<Sample>,
    due: Vec<Due>,
    /// Tires of one register that are carried through the step by themselves.
    carried: Vec<Carried>,
    wake: Wake<'a>,
    tension: Tension<'a>,
    u: Field,
    v: Field,
    /// Elastic energy of each block when last evaluated, and its sum over those asleep [J].
    stored: Vec<Pack>,
    asleep: Pack,
}

impl<'a> Stepper<'a> {
    pub(super) fn new(part: &'a Part, scene: &'a Scene, shot: &Shot, settings: &Settings) -> Self {
        let tires = part.quotient.weight.len();
        let firings = part.quotient.firings(shot);
        Self {
            scene,
            part,
            step: settings.step,
            friction: shot.friction.unwrap_or(scene.friction),
            gravity: scene.gravity,
            breaking_force: scene.breaking_force.unwrap_or(f64::INFINITY),
            time_limit: time_limit(shot, settings),
            clock: Clock::new(shot),
            moving: false,
            record: Record::new(settings.step),
            sampled: None,
            due: Vec::with_capacity(firings.len()),
            firings,
            carried: Vec::with_capacity(LANES),
            wake: Wake::new(&part.ties),
            tension: Tension::new(&part.blocks),
            // A pack more, which the last cables may read.
            u: Field::zeros(tires + LANES),
            v: Field::zeros(tires + LANES),
            stored: vec![[0.0; LANES]; part.blocks.blocks.len()],
            asleep: [0.0; LANES],
        }
    }

    pub(super) fn run(mut self, watch: &mut Watcher<'_>) -> Result<Outcome, Failure> {
        let arch = pulp::Arch::new();
        loop {
            if self.now() > self.time_limit * (1.0 + 1e-12) {
                return Ok(self.finish(End::TimeLimit));
            }
            if !self.moving {
                match self.firings.get(self.clock.fired) {
                    Some(next) if next.at <= self.time_limit => self.clock.jump(next.at),
                    Some(_) => return Ok(self.finish(End::TimeLimit)),
                    None => return Ok(self.finish(End::AtRest)),
                }
            }
            self.collect_due();
            self.copy_images();
            if self.wake.refresh() {
                self.move_stored_energy();
            }
            let mut pass = arch.dispatch(Pull(&mut self));
            if watch(&Snapshot { stepper: &self }).is_break() {
                return Err(Failure::Stopped { at: self.now() });
            }
            arch.dispatch(Advance(&mut self, &mut pass));
            self.book(&pass)?;
        }
    }

    fn now(&self) -> f64 {
        self.clock.now(self.step)
    }

    /// Gathers the holes that fire before the step ends and wakes their tires.
    fn collect_due(&mut self) {
        self.due.clear();
        let start = self.clock.since(self.step);
        let end = start + self.step;
        while let Some(firing) = self.firings.get(self.clock.fired) {
            let at = firing.at - self.clock.base;
            if at >= end {
                break;
            }
            let after = (at - start).clamp(0.0, self.step);
            self.due.push(Due { tire: firing.tire, after, launch: firing.launch });
            self.wake.set_moving(firing.tire / LANES, true);
            self.clock.fired += 1;
        }
        self.due.sort_by_key(|due| due.tire);
    }

    /// Cables that fell asleep keep their energy, those that woke count it anew.
    fn move_stored_energy(&mut self) {
        for &block in &self.wake.fell_asleep {
            (0..LANES).for_each(|j| self.asleep[j] += self.stored[block][j]);
        }
        for &block in &self.wake.woke {
            (0..LANES).for_each(|j| self.asleep[j] -= self.stored[block][j]);
        }
    }

    /// Closes the books for the step and ticks the clock.
    fn book(&mut self, pass: &Pass) -> Result<(), Failure> {
        let greatest = |of: &Pack| of.iter().copied().fold(0.0, f64::max);
        let (energy, dissipated) = (pass.energy.iter().sum::<f64>(), pass.dissipated.iter().sum::<f64>());
        if !(energy + dissipated).is_finite() {
            return Err(Failure::Diverged { at: self.now() });
        }
        self.record.balance(energy, 0.5 * dissipated);
        self.record.ledger.dissipated += dissipated + pass.lost;
        self.record.ledger.put_in += pass.put_in;
        self.record.history.note(self.now(), greatest(&pass.height), greatest(&pass.force));
        self.moving = greatest(&pass.motion) > 0.0;
        self.clock.tick();
        Ok(())
    }

    fn finish(self, end: End) -> Outcome {
        // The last step reaches past the limit.
        let (now, past) = (self.now(), (self.now() - self.time_limit).max(0.0));
        let Self { part, u, v, record, clock, .. } = self;
        let vector = |of: &Field, tire: usize| Vector3::from_fn(|c, _| of.part[c][tire]);
        // Images are as they were a step ago.
        let kept = part.quotient.weight.iter().enumerate().filter(|&(_, &weight)| weight > 0.0);
        let tires =
            kept.map(|(tire, _)| (part.quotient.tire(tire), vector(&u, tire) - vector(&v, tire) * past));
        record.finish(tires, (now - past, clock.steps), end)
    }
}

/// The shelter between forces and kick.
struct Snapshot<'s, 'a> {
    stepper: &'s Stepper<'a>,
}

impl Snapshot<'_, '_> {
    fn vector(&self, of: &Field, tire: usize) -> Vector3<f64> {
        Vector3::from_fn(|c, _| of.part[c][tire])
    }
}

impl Motion for Snapshot<'_, '_> {
    fn time(&self) -> f64 {
        self.stepper.now()
    }

    fn displacement(&self, tire: usize) -> Vector3<f64> {
        let (found, [x, y]) = self.stepper.part.quotient.find(tire);
        self.vector(&self.stepper.u, found).component_mul(&Vector3::new(x, y, 1.0))
    }

    fn force(&self, cable: usize) -> f64 {
        let Stepper { scene, record, .. } = self.stepper;
        if record.broken.iter().any(|broken| broken.cable == cable) {
            return 0.0;
        }
        let cable = &scene.cables[cable];
        cable.force(cable.between(cable.ends.map(|end| self.displacement(end))).norm())
    }

    fn friction(&self, tire: usize) -> (f64, f64) {
        if self.displacement(tire).z > 0.0 {
            return (0.0, 0.0);
        }
        let Stepper { part, tension, step, .. } = self.stepper;
        let (tire, _) = part.quotient.find(tire);
        let ends = part.blocks.ends.of(tire / LANES);
        let pulls = tension.pulls().at(pulp::Scalar::new(), ends, tire % LANES);
        let pull = Vector3::from(pulls.map(|pull| pull.pack()[0]));
        let (inverse, impulse_to_force) = (part.inverse[tire], 1.0 / (part.inverse[tire] * step));
        let acceleration = pull * inverse - Vector3::z() * self.stepper.gravity;
        let free = self.vector(&self.stepper.v, tire) + acceleration * *step;
        let (after, normal) = support(free, self.stepper.friction);
        ((free - after).xy().norm() * impulse_to_force, self.stepper.friction * normal * impulse_to_force)
    }
}
