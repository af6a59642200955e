//! Explicit central differences with contact in closed form.
//!
//! Velocities live at mid-step. A step of length h at time tₙ:
//!
//! 1. forces: f = Σ N over the taut cables at uₙ;
//! 2. kick: v* = v + h (f/m − g), then on the ground p = −m v*₃ ≥ 0 and friction up to μp ([`super::contact`]);
//! 3. drift: uₙ₊₁ = uₙ + h v.
//!
//! A tire that lands or is fired at inside the step is carried through it phase by phase instead
//! ([`Flight::through`](super::contact::Flight::through)), so both happen at their own time. The method is of second
//! order, symplectic between events, and stable for h < 2/ω; ω² ≤ max (2/m) Σ k
//! ([`Scene::frequency_bound`](crate::scene::Scene::frequency_bound)). It ignores damping in the cables.
//!
//! `W` runs of one scene advance together, one per lane: element `tire × W + lane` of every array. `W` is 1 or
//! [`LANES`]; what a run computes does not depend on it.

mod lanes;

use nalgebra::Vector3;
use pulp::Simd;

use self::lanes::Run;

use super::cable::{Blocks, Field};
use super::contact::{Flight, support};
use super::kick::{Kicked, Lanes, Tires};
use super::mirror::Quotient;
use super::pack::{LANES, Pack, Wide};
use super::tension::Tension;
use super::wake::Wake;
use super::{Failure, Motion, Settings, Watcher};
use crate::outcome::{Outcome, Peak};
use crate::scene::{Scene, Shot};

/// One run asked for.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// What fires when.
    pub shot: &'a Shot,
    /// Coefficient of friction.
    pub friction: f64,
    /// Step and duration.
    pub settings: Settings,
}

/// Runs one shot; see [`super::simulate`].
pub fn run(
    scene: &Scene,
    shot: &Shot,
    settings: &Settings,
    watch: &mut Watcher<'_>,
) -> Result<Outcome, Failure> {
    let job = Job { shot, friction: scene.friction, settings: *settings };
    let mut results = Stepper::<1>::new(scene, std::slice::from_ref(&job)).run(watch);
    results.pop().unwrap_or(Err(Failure::Stopped { at: 0.0 }))
}

/// Runs many shots of one scene, [`LANES`] at a time; results in the order of `jobs`.
///
/// `watch` sees the first lane at every step and may stop all runs.
pub fn run_all(scene: &Scene, jobs: &[Job<'_>], watch: &mut Watcher<'_>) -> Vec<Result<Outcome, Failure>> {
    Stepper::<LANES>::new(scene, jobs).run(watch)
}

/// How many tires are integrated for a shot: fewer than the scene has where both are their own mirror image.
pub fn modelled_tires(scene: &Scene, shot: &Shot) -> usize {
    Quotient::new(scene, std::iter::once(shot)).modelled()
}

/// A hole that fires within the present step.
#[derive(Clone, Copy, Debug)]
struct Due {
    element: usize,
    /// After the start of the step [s].
    after: f64,
    launch: f64,
}

/// Where the greatest force was sampled.
#[derive(Clone, Copy, Debug)]
struct Sample {
    block: usize,
    element: usize,
    /// k (L − L0) a step earlier [N].
    before: f64,
}

/// Energies and heights of one pass, per lane.
#[derive(Clone, Copy, Debug)]
struct Pass {
    energy: Pack,
    dissipated: Pack,
    /// Dissipated through events, whole and not by halves.
    lost: Pack,
    put_in: Pack,
    height: Pack,
    force: Pack,
    motion: Pack,
}

/// The arrays of `W` runs and what drives them.
struct Stepper<'a, const W: usize> {
    quotient: Quotient<'a>,
    /// Longest stable step [s].
    limit: f64,
    jobs: &'a [Job<'a>],
    next_job: usize,
    results: Vec<Result<Outcome, Failure>>,
    runs: [Option<Run>; W],
    blocks: Blocks,
    wake: Wake,
    tension: Tension,
    lanes: Lanes,
    /// Greatest height and force so far, per lane.
    best: [Pack; 2],
    u: Field,
    v: Field,
    /// Mass × how many tires of the whole scene each stands for [kg].
    mass: Vec<f64>,
    inverse: Vec<f64>,
    due: Vec<Due>,
    /// Elastic energy of each block when last evaluated, and its sum over those asleep [J].
    stored: Vec<Pack>,
    asleep: Pack,
}

impl<'a, const W: usize> Stepper<'a, W> {
    fn new(scene: &'a Scene, jobs: &'a [Job<'a>]) -> Self {
        let quotient = Quotient::new(scene, jobs.iter().map(|job| job.shot));
        let n = quotient.weight.len() * W;
        let spread = |values: Vec<f64>| -> Vec<f64> {
            let each = values.into_iter().flat_map(|value| std::iter::repeat_n(value, W));
            each.chain(std::iter::repeat_n(1.0, LANES)).collect()
        };
        let masses = || quotient.scene.mass.iter();
        let mass = spread(masses().zip(&quotient.weight).map(|(mass, weight)| mass * weight).collect());
        // An image is never kicked by the part of its cables that is modelled.
        let kicked = |(mass, &weight): (&f64, &f64)| if weight > 0.0 { 1.0 / mass } else { 0.0 };
        let inverse = spread(masses().zip(&quotient.weight).map(kicked).collect());
        let blocks = Blocks::new(&quotient.scene, &quotient.cable_weight, W);
        Self {
            limit: scene.critical_step(),
            quotient,
            jobs,
            next_job: 0,
            results: vec![Err(Failure::Stopped { at: 0.0 }); jobs.len()],
            runs: [const { None }; W],
            wake: Wake::new(&blocks, n),
            stored: vec![[0.0; LANES]; blocks.blocks.len()],
            asleep: [0.0; LANES],
            tension: Tension::new(&blocks),
            blocks,
            lanes: Lanes { step: [0.0; LANES], friction: [0.0; LANES], gravity: scene.gravity },
            best: [[0.0; LANES]; 2],
            u: Field::zeros(n),
            v: Field::zeros(n),
            mass,
            inverse,
            due: Vec::with_capacity(W * jobs.iter().map(|job| job.shot.firings.len()).max().unwrap_or(0)),
        }
    }

    fn run(mut self, watch: &mut Watcher<'_>) -> Vec<Result<Outcome, Failure>> {
        let arch = pulp::Arch::new();
        loop {
            self.due.clear();
            for lane in 0..W {
                self.ready(lane);
            }
            if self.runs.iter().all(Option::is_none) {
                return self.results;
            }
            self.due.sort_by_key(|due| due.element);
            if self.wake.refresh() {
                self.move_stored_energy();
            }
            let mut pass = arch.dispatch(Pull(&mut self));
            if watch(&Snapshot { stepper: &self }).is_break() {
                self.stop();
                return self.results;
            }
            arch.dispatch(Advance(&mut self, &mut pass));
            for lane in 0..W {
                self.book(lane, &pass);
            }
        }
    }

    /// Cables that fell asleep keep their energy, those that woke count it anew.
    fn move_stored_energy(&mut self) {
        for j in 0..LANES {
            for &block in &self.wake.blocks_before {
                self.asleep[j] += self.stored[block][j];
            }
            for &block in &self.wake.blocks {
                self.asleep[j] -= self.stored[block][j];
            }
        }
    }

    /// Evaluates the cables that need it.
    #[inline(always)]
    fn pull<S: Simd>(&mut self, simd: S) -> Pass {
        let mut pass = Pass {
            energy: self.asleep,
            dissipated: [0.0; LANES],
            lost: [0.0; LANES],
            put_in: [0.0; LANES],
            height: [0.0; LANES],
            force: [0.0; LANES],
            motion: [0.0; LANES],
        };
        for lane in 0..W {
            self.interpolate_peak(lane);
        }
        for n in 0..self.wake.blocks.len() {
            let n = self.wake.blocks[n];
            let block = self.blocks.blocks[n];
            let stress = self.tension.evaluate(simd, &block, &self.u, &self.v, &self.lanes.step);
            let mut exceeds = false;
            for j in 0..LANES {
                pass.energy[j] += stress.energy[j];
                pass.force[j] = pass.force[j].max(stress.force[j]);
                exceeds |= stress.force[j] > self.best[1][j];
            }
            if exceeds {
                self.note_forces(n);
            }
            self.stored[n] = stress.energy;
        }
        pass
    }

    /// Some cables of a block pull harder than any before them.
    fn note_forces(&mut self, n: usize) {
        let block = self.blocks.blocks[n];
        for element in 0..block.len {
            let (lane, force) = (element % W, self.tension.force(&block, element));
            if force <= self.best[1][lane] {
                continue;
            }
            for j in (lane..LANES).step_by(W) {
                self.best[1][j] = force;
            }
            let Some(step) = self.runs[lane].as_ref().map(|run| run.step) else { continue };
            let before = self.signed_force(n, element, -step);
            if let Some(run) = &mut self.runs[lane] {
                let place = self.quotient.cable(self.blocks.cable(n, element));
                run.record.force = Peak { value: force, at: run.clock.now(step), place };
                run.sampled = Some(Sample { block: n, element, before });
            }
        }
    }

    /// Finds the top of the greatest force between the samples around it.
    fn interpolate_peak(&mut self, lane: usize) {
        let Some(Sample { block, element, before }) =
            self.runs[lane].as_mut().and_then(|run| run.sampled.take())
        else {
            return;
        };
        let after = self.signed_force(block, element, 0.0);
        let Some(run) = &mut self.runs[lane] else { return };
        run.record.vertex(before, after);
        for j in (lane..LANES).step_by(W) {
            self.best[1][j] = run.record.force.value;
        }
    }

    /// k (L − L0) of one cable, its tires moved on by `ahead` [s] at their present velocity [N].
    fn signed_force(&self, block: usize, element: usize, ahead: f64) -> f64 {
        let block = &self.blocks.blocks[block];
        let mut length2 = 0.0;
        for c in 0..3 {
            let place = |end: usize| self.u.part[c][end + element] + ahead * self.v.part[c][end + element];
            length2 += (place(block.second) - place(block.first) + block.span[c]).powi(2);
        }
        block.stiffness * (length2.sqrt() - block.rest_length)
    }

    /// Kick and drift of the awake tires.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, pass: &mut Pass) {
        let gravity = Wide::splat(simd, self.lanes.gravity);
        let zero = Wide::splat(simd, 0.0);
        let mut due = 0;
        for n in 0..self.wake.awake.len() {
            let pack = self.wake.awake[n];
            let mut moving = false;
            for lane in (0..LANES).step_by(Wide::<S>::LEN) {
                let at = pack * LANES + lane;
                let tires = Tires {
                    u: self.u.load(simd, at),
                    v: self.v.load(simd, at),
                    f: self.tension.pulls(simd, self.blocks.ends.of(pack), lane),
                    mass: Wide::load(simd, &self.mass, at),
                    inverse: Wide::load(simd, &self.inverse, at),
                    step: Wide::load(simd, &self.lanes.step, lane),
                    friction: Wide::load(simd, &self.lanes.friction, lane),
                    gravity,
                };
                let kicked = tires.kick(simd);
                kicked.energy.add_to(&mut pass.energy, lane);
                kicked.dissipated.add_to(&mut pass.dissipated, lane);
                let highest = Wide::load(simd, &pass.height, lane).max(tires.u[2]);
                highest.store(&mut pass.height, lane);
                kicked.motion.max(Wide::load(simd, &pass.motion, lane)).store(&mut pass.motion, lane);
                for c in 0..3 {
                    kicked.u[c].store(&mut self.u.part[c], at);
                    kicked.v[c].store(&mut self.v.part[c], at);
                }
                moving |= zero.less(kicked.motion).any();
                if Wide::load(simd, &self.best[0], lane).less(tires.u[2]).any() {
                    self.note_heights(at, &tires, &kicked);
                }
                let fires = self.due.get(due).is_some_and(|due| due.element < at + Wide::<S>::LEN);
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
        for image in &self.quotient.images {
            for lane in 0..W {
                let (of, from) = (image.of * W + lane, image.from * W + lane);
                let mut moving = 0;
                for field in [&mut self.u, &mut self.v] {
                    for (c, sign) in image.sign.into_iter().chain([1.0]).enumerate() {
                        field.part[c][of] = sign * field.part[c][from];
                        moving |= field.part[c][of].to_bits() << 1;
                    }
                }
                if moving != 0 {
                    self.wake.set_moving(of / LANES, true);
                }
            }
        }
    }

    /// Some tires in a register are higher than any before them.
    fn note_heights<S: Simd>(&mut self, at: usize, tires: &Tires<S>, kicked: &Kicked<S>) {
        let (height, inverse) = (tires.u[2].pack(), tires.inverse.pack());
        let (before, after, force) = (tires.v[2].pack(), kicked.v[2].pack(), tires.f[2].pack());
        for j in 0..Wide::<S>::LEN {
            let lane = (at + j) % W;
            let Some(run) = self.runs[lane].as_mut().filter(|_| height[j] > self.best[0][lane]) else {
                continue;
            };
            let sample = Peak {
                value: height[j],
                at: run.clock.now(run.step),
                place: self.quotient.tire((at + j) / W),
            };
            let velocity = 0.5 * (before[j] + after[j]);
            run.record.higher(sample, velocity, force[j] * inverse[j] - self.lanes.gravity);
            for k in (lane..LANES).step_by(W) {
                self.best[0][k] = run.record.height.value;
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
        for j in 0..Wide::<S>::LEN {
            let (element, lane, first) = (at + j, (at + j) % LANES, due);
            while self.due.get(due).is_some_and(|due| due.element == element) {
                due += 1;
            }
            if first == due && lands[j] >= 0.0 {
                continue;
            }
            let vector = |of: &[Pack; 3]| Vector3::new(of[0][j], of[1][j], of[2][j]);
            let h = self.lanes.step[lane];
            let mut flight = Flight {
                displacement: vector(&u),
                velocity: 0.5 * (vector(&v) + vector(&after)),
                free: vector(&f) * inverse[j] - Vector3::z() * self.lanes.gravity,
                friction: self.lanes.friction[lane],
                lost: 0.0,
                put_in: 0.0,
            };
            let last = flight.through(h, self.due[first..due].iter().map(|due| (due.after, due.launch)));
            let mid = flight.velocity - last * (0.5 * h);
            for c in 0..3 {
                self.u.part[c][element] = flight.displacement[c];
                self.v.part[c][element] = mid[c];
            }
            pass.motion[lane] = pass.motion[lane].max(mid.amax()).max(flight.displacement.z);
            // The kicks before and after count half a step of friction each; here the whole step is counted at once.
            let next_half = 0.5 * h * (flight.free - last).xy().dot(&flight.velocity.xy());
            pass.lost[lane] += mass[j] * (flight.lost - next_half) - 0.5 * dissipated[j];
            pass.put_in[lane] += mass[j] * flight.put_in;
        }
        due
    }
}

/// Evaluation of the cables, compiled for each instruction set and chosen at run time.
struct Pull<'s, 'a, const W: usize>(&'s mut Stepper<'a, W>);

impl<const W: usize> pulp::WithSimd for Pull<'_, '_, W> {
    type Output = Pass;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Pass {
        self.0.pull(simd)
    }
}

/// Kick and drift, likewise.
struct Advance<'s, 'a, const W: usize>(&'s mut Stepper<'a, W>, &'s mut Pass);

impl<const W: usize> pulp::WithSimd for Advance<'_, '_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.0.advance(simd, self.1);
    }
}

/// The first lane, between forces and kick.
struct Snapshot<'s, 'a, const W: usize> {
    stepper: &'s Stepper<'a, W>,
}

impl<const W: usize> Snapshot<'_, '_, W> {
    fn vector(&self, of: &Field, tire: usize) -> Vector3<f64> {
        Vector3::from_fn(|c, _| of.part[c][tire * W])
    }
}

impl<const W: usize> Motion for Snapshot<'_, '_, W> {
    fn time(&self) -> f64 {
        self.stepper.runs[0].as_ref().map_or(0.0, |run| run.clock.now(run.step))
    }

    fn displacement(&self, tire: usize) -> Vector3<f64> {
        let (found, [x, y]) = self.stepper.quotient.find(tire);
        self.vector(&self.stepper.u, found).component_mul(&Vector3::new(x, y, 1.0))
    }

    fn friction(&self, tire: usize) -> (f64, f64) {
        if self.displacement(tire).z > 0.0 {
            return (0.0, 0.0);
        }
        let Stepper { quotient, lanes, .. } = self.stepper;
        let (tire, _) = quotient.find(tire);
        let (h, mass, friction) = (lanes.step[0], quotient.scene.mass[tire], lanes.friction[0]);
        let element = tire * W;
        let ends = self.stepper.blocks.ends.of(element / LANES);
        let pulls = self.stepper.tension.pulls(pulp::Scalar::new(), ends, element % LANES);
        let pull = Vector3::from(pulls.map(|pull| pull.pack()[0]));
        let acceleration = pull / mass - Vector3::z() * lanes.gravity;
        let free = self.vector(&self.stepper.v, tire) + acceleration * h;
        let (after, normal) = support(free, friction);
        ((free - after).xy().norm() * mass / h, friction * normal * mass / h)
    }
}
