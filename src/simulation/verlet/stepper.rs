//! One run: what changes from step to step, and the step itself.

use nalgebra::Vector3;
use pulp::Simd;

use super::Part;
use crate::outcome::{Broken, End, Outcome, Peak};
use crate::scene::{Firing, Scene, Shot};
use crate::simulation::cable::Field;
use crate::simulation::contact::{Flight, support};
use crate::simulation::kick::{Kicked, Tires};
use crate::simulation::pack::{LANES, Pack, Wide};
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
    wake: Wake<'a>,
    tension: Tension<'a>,
    u: Field,
    v: Field,
    /// Elastic energy of each block when last evaluated, and its sum over those asleep [J].
    stored: Vec<Pack>,
    asleep: Pack,
}

impl<'a> Stepper<'a> {
    pub(super) fn new(part: &'a Part, scene: &Scene, shot: &Shot, settings: &Settings) -> Self {
        let tires = part.quotient.weight.len();
        let firings = part.quotient.firings(shot);
        Self {
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
            wake: Wake::new(&part.ties),
            tension: Tension::new(&part.blocks),
            u: Field::zeros(tires),
            v: Field::zeros(tires),
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
                    _ => return Ok(self.finish(End::AtRest)),
                }
            }
            self.collect_due();
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

    /// Evaluates the cables that need it.
    #[inline(always)]
    fn pull<S: Simd>(&mut self, simd: S) -> Pass {
        let mut pass = Pass { energy: self.asleep, ..Pass::default() };
        self.interpolate_peak();
        for n in 0..self.wake.blocks.len() {
            let n = self.wake.blocks[n];
            let block = &self.part.blocks.blocks[n];
            let stress = self.tension.evaluate(simd, block, &self.u, &self.v, self.step);
            let mut greatest = 0.0_f64;
            for j in 0..LANES {
                pass.energy[j] += stress.energy[j];
                pass.force[j] = pass.force[j].max(stress.force[j]);
                greatest = greatest.max(stress.force[j]);
            }
            self.stored[n] = stress.energy;
            if greatest > self.record.force.value {
                self.note_forces(n);
            }
            if greatest > self.breaking_force {
                self.cut_broken(n, &mut pass);
            }
        }
        pass
    }

    /// Some cables of a block pull harder than any before them.
    fn note_forces(&mut self, n: usize) {
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

    /// Takes away the cables of a block that pull past their breaking force; what they stored is lost.
    #[cold]
    fn cut_broken(&mut self, n: usize, pass: &mut Pass) {
        let block = &self.part.blocks.blocks[n];
        for place in 0..block.len {
            if self.tension.force(block, place) > self.breaking_force {
                let lost = self.tension.cut(block, place);
                self.record.ledger.dissipated += lost;
                pass.energy[place % LANES] -= lost;
                self.stored[n][place % LANES] -= lost;
                let cable = self.part.quotient.cable(self.part.blocks.cable(n, place));
                self.record.broken.push(Broken { at: self.now(), cable });
            }
        }
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

    /// Kick and drift of the awake tires.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, pass: &mut Pass) {
        let zero = Wide::splat(simd, 0.0);
        let (step, friction) = (Wide::splat(simd, self.step), Wide::splat(simd, self.friction));
        let gravity = Wide::splat(simd, self.gravity);
        let mut due = 0;
        for n in 0..self.wake.awake.len() {
            let pack = self.wake.awake[n];
            let mut moving = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                let at = pack * LANES + lane;
                let tires = Tires {
                    u: self.u.slices(at..at+Wide::<S>::LEN).map(|part| Wide::load(simd, part, 0)),
                    v: self.v.slices(at..at+Wide::<S>::LEN).map(|part| Wide::load(simd, part, 0)),
                    f: self.tension.pulls().at(simd, self.part.blocks.ends.of(pack), lane),
                    mass: Wide::load(simd, &self.part.mass, at),
                    inverse: Wide::load(simd, &self.part.inverse, at),
                    step,
                    friction,
                    gravity,
                };
                let kicked = tires.kick(simd);
                kicked.energy.add_to(&mut pass.energy, lane);
                kicked.dissipated.add_to(&mut pass.dissipated, lane);
                tires.u[2].max(Wide::load(simd, &pass.height, lane)).store(&mut pass.height, lane);
                kicked.motion.max(Wide::load(simd, &pass.motion, lane)).store(&mut pass.motion, lane);
                for c in 0..3 {
                    kicked.u[c].store(&mut self.u.part[c], at);
                    kicked.v[c].store(&mut self.v.part[c], at);
                }
                moving |= zero.less(kicked.motion).any();
                if Wide::splat(simd, self.record.height.value).less(tires.u[2]).any() {
                    self.note_heights(at, &tires, &kicked);
                }
                let fires = self.due.get(due).is_some_and(|due| due.tire < at + Wide::<S>::LEN);
                if fires || kicked.u[2].less(zero).any() {
                    due = self.through_events(at, due, &tires, &kicked, pass);
                    moving = true;
                }
            }
            self.wake.set_moving(pack, moving);
        }
        self.copy_images();
    }

    /// Reflects kept tires into their images and keeps those on a mirror plane in it.
    fn copy_images(&mut self) {
        for image in &self.part.quotient.images {
            let mut moving = false;
            for field in [&mut self.u, &mut self.v] {
                for (c, sign) in image.sign.into_iter().chain([1.0]).enumerate() {
                    field.part[c][image.of] = sign * field.part[c][image.from];
                    moving |= field.part[c][image.of] != 0.0;
                }
            }
            if moving {
                self.wake.set_moving(image.of / LANES, true);
            }
        }
    }

    /// Some tires in a register are higher than any before them.
    fn note_heights<S: Simd>(&mut self, at: usize, tires: &Tires<S>, kicked: &Kicked<S>) {
        let (height, inverse) = (tires.u[2].pack(), tires.inverse.pack());
        let (before, after, force) = (tires.v[2].pack(), kicked.v[2].pack(), tires.f[2].pack());
        for j in 0..Wide::<S>::LEN {
            if height[j] > self.record.height.value {
                let place = self.part.quotient.tire(at + j);
                let sample = Peak { value: height[j], at: self.now(), place };
                let velocity = 0.5 * (before[j] + after[j]);
                self.record.higher(sample, velocity, force[j] * inverse[j] - self.gravity);
            }
        }
    }

    /// Carries the tires in a register that land or are fired at through the step; returns the next hole due.
    fn through_events<S: Simd>(
        &mut self,
        at: usize,
        mut due: usize,
        tires: &Tires<S>,
        kicked: &Kicked<S>,
        pass: &mut Pass,
    ) -> usize {
        let [u, v, f, after] = [tires.u, tires.v, tires.f, kicked.v].map(|of| of.map(Wide::pack));
        let (mass, inverse) = (tires.mass.pack(), tires.inverse.pack());
        let (lands, dissipated) = (kicked.u[2].pack(), kicked.dissipated.pack());
        let h = self.step;
        for j in 0..Wide::<S>::LEN {
            let (tire, first) = (at + j, due);
            while self.due.get(due).is_some_and(|due| due.tire == tire) {
                due += 1;
            }
            if first == due && lands[j] >= 0.0 {
                continue;
            }
            let vector = |of: &[Pack; 3]| Vector3::new(of[0][j], of[1][j], of[2][j]);
            let mut flight = Flight {
                displacement: vector(&u),
                velocity: 0.5 * (vector(&v) + vector(&after)),
                free: vector(&f) * inverse[j] - Vector3::z() * self.gravity,
                friction: self.friction,
                lost: 0.0,
                put_in: 0.0,
                elapsed: 0.0,
                top: (0.0, 0.0),
            };
            let last = flight.through(h, self.due[first..due].iter().map(|due| (due.after, due.launch)));
            let mid = flight.velocity - last * (0.5 * h);
            // A flight within the step is seen by no sample.
            let (height, after) = flight.top;
            if height > self.record.height.value {
                let place = self.part.quotient.tire(tire);
                self.record.height = Peak { value: height, at: self.now() + after, place };
            }
            pass.height[0] = pass.height[0].max(height);
            for c in 0..3 {
                self.u.part[c][tire] = flight.displacement[c];
                self.v.part[c][tire] = mid[c];
            }
            pass.motion[0] = pass.motion[0].max(mid.amax()).max(flight.displacement.z);
            // The kicks before and after count half a step of friction each; here the whole step is counted at once.
            let next_half = 0.5 * h * (flight.free - last).xy().dot(&flight.velocity.xy());
            pass.lost += mass[j] * (flight.lost - next_half) - 0.5 * dissipated[j];
            pass.put_in += mass[j] * flight.put_in;
        }
        due
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
        let [x, y, _] = &self.u.part;
        let mut drift = Peak { at: self.now(), ..Peak::default() };
        for tire in 0..self.part.quotient.weight.len() {
            let shift2 = x[tire] * x[tire] + y[tire] * y[tire];
            if shift2 > drift.value {
                (drift.value, drift.place) = (shift2, self.part.quotient.tire(tire));
            }
        }
        drift.value = drift.value.sqrt();
        self.record.finish(drift, self.clock.steps, end)
    }
}

/// Evaluation of the cables, compiled for each instruction set and chosen at run time.
struct Pull<'s, 'a>(&'s mut Stepper<'a>);

impl pulp::WithSimd for Pull<'_, '_> {
    type Output = Pass;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Pass {
        self.0.pull(simd)
    }
}

/// Kick and drift, likewise.
struct Advance<'s, 'a>(&'s mut Stepper<'a>, &'s mut Pass);

impl pulp::WithSimd for Advance<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.0.advance(simd, self.1);
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
