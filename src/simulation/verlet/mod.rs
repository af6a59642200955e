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

use self::lanes::Run;

use super::cable::{Blocks, Field, LANES, Memory, Pack, Tension, load, store};
use super::contact::{Flight, support};
use super::kick::{Kicked, Lanes, Tires};
use super::mirror::Quotient;
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
    motion: [u64; LANES],
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
    memory: Memory,
    lanes: Lanes,
    /// Greatest height and force so far, per lane.
    best: [Pack; 2],
    u: Field,
    v: Field,
    /// Cable forces on the tires [N]; zero between steps.
    f: Field,
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
            memory: Memory::new(&blocks),
            blocks,
            tension: Tension::zero(),
            lanes: Lanes { step: [0.0; LANES], friction: [0.0; LANES], gravity: scene.gravity },
            best: [[0.0; LANES]; 2],
            u: Field::zeros(n),
            v: Field::zeros(n),
            f: Field::zeros(n),
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
    fn pull(&mut self) -> Pass {
        let mut pass = Pass {
            energy: self.asleep,
            dissipated: [0.0; LANES],
            lost: [0.0; LANES],
            put_in: [0.0; LANES],
            height: [0.0; LANES],
            force: [0.0; LANES],
            motion: [0; LANES],
        };
        for lane in 0..W {
            self.interpolate_peak(lane);
        }
        for n in 0..self.wake.blocks.len() {
            let n = self.wake.blocks[n];
            let block = self.blocks.blocks[n];
            self.tension.evaluate(&block, &self.u, &self.v, &self.lanes.step, &mut self.memory);
            self.tension.apply(&block, &mut self.f);
            let compliance = 0.5 * block.weight / block.stiffness;
            let mut stored = [0.0; LANES];
            for at in (0..block.len).step_by(LANES) {
                if !self.tension.taut[at / LANES] {
                    continue;
                }
                let force = load(&self.tension.force, at);
                let mut exceeds = false;
                for j in 0..LANES {
                    stored[j] += compliance * force[j] * force[j];
                    pass.force[j] = pass.force[j].max(force[j]);
                    exceeds |= force[j] > self.best[1][j];
                }
                if exceeds {
                    for (j, &force) in force.iter().enumerate() {
                        if force > self.best[1][j] {
                            self.note_force(n, at + j, force);
                        }
                    }
                }
            }
            for j in 0..LANES {
                pass.energy[j] += stored[j];
            }
            self.stored[n] = stored;
        }
        pass
    }

    /// A cable pulls harder than any before it.
    fn note_force(&mut self, block: usize, element: usize, force: f64) {
        let lane = element % W;
        for j in (lane..LANES).step_by(W) {
            self.best[1][j] = force;
        }
        let Some(run) = &mut self.runs[lane] else { return };
        let place = self.quotient.cable(self.blocks.cable[self.blocks.blocks[block].cable + element / W]);
        run.record.force = Peak { value: force, at: run.clock.now(run.step), place };
        let step = run.step;
        let before = self.signed_force(block, element, -step);
        if let Some(run) = &mut self.runs[lane] {
            run.sampled = Some(Sample { block, element, before });
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
    fn advance(&mut self, pass: &mut Pass) {
        let mut due = 0;
        for n in 0..self.wake.awake.len() {
            let pack = self.wake.awake[n];
            let at = pack * LANES;
            let tires = Tires {
                u: std::array::from_fn(|c| load(&self.u.part[c], at)),
                v: std::array::from_fn(|c| load(&self.v.part[c], at)),
                f: std::array::from_fn(|c| load(&self.f.part[c], at)),
                mass: load(&self.mass, at),
                inverse: load(&self.inverse, at),
            };
            let mut kicked = tires.kick(&self.lanes);
            let mut event = self.due.get(due).is_some_and(|d| d.element < at + LANES);
            let mut higher = false;
            for j in 0..LANES {
                event |= kicked.u[2][j] < 0.0;
                higher |= tires.u[2][j] > self.best[0][j];
                pass.energy[j] += kicked.kinetic[j] + kicked.potential[j];
                pass.dissipated[j] += kicked.dissipated[j];
                pass.height[j] = pass.height[j].max(tires.u[2][j]);
            }
            if higher {
                self.note_heights(at, &tires, &kicked);
            }
            if event {
                due = self.through_events(at, due, &tires, &mut kicked, pass);
            }
            let mut moving = 0;
            for j in 0..LANES {
                pass.motion[j] |= kicked.motion[j];
                moving |= kicked.motion[j];
            }
            for c in 0..3 {
                store(&mut self.u.part[c], at, &kicked.u[c]);
                store(&mut self.v.part[c], at, &kicked.v[c]);
                store(&mut self.f.part[c], at, &[0.0; LANES]);
            }
            self.wake.set_moving(pack, moving != 0);
        }
        for &pack in &self.wake.touched {
            for part in &mut self.f.part {
                store(part, pack * LANES, &[0.0; LANES]);
            }
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

    /// Some tires of a pack are higher than any before them.
    fn note_heights(&mut self, at: usize, tires: &Tires, kicked: &Kicked) {
        for j in 0..LANES {
            let lane = j % W;
            let Some(run) = self.runs[lane].as_mut().filter(|_| tires.u[2][j] > self.best[0][j]) else {
                continue;
            };
            let sample = Peak {
                value: tires.u[2][j],
                at: run.clock.now(run.step),
                place: self.quotient.tire((at + j) / W),
            };
            let velocity = 0.5 * (tires.v[2][j] + kicked.v[2][j]);
            run.record.higher(sample, velocity, tires.f[2][j] * tires.inverse[j] - self.lanes.gravity);
            for k in (lane..LANES).step_by(W) {
                self.best[0][k] = run.record.height.value;
            }
        }
    }

    /// Carries the tires of a pack that land or are fired at through the step; returns the next hole due.
    fn through_events(
        &self,
        at: usize,
        mut due: usize,
        tires: &Tires,
        kicked: &mut Kicked,
        pass: &mut Pass,
    ) -> usize {
        for j in 0..LANES {
            let first = due;
            while self.due.get(due).is_some_and(|d| d.element == at + j) {
                due += 1;
            }
            if first == due && kicked.u[2][j] >= 0.0 {
                continue;
            }
            let vector = |of: &[Pack; 3]| Vector3::new(of[0][j], of[1][j], of[2][j]);
            let (h, mass) = (self.lanes.step[j], tires.mass[j]);
            let mut flight = Flight {
                displacement: vector(&tires.u),
                velocity: 0.5 * (vector(&tires.v) + vector(&kicked.v)),
                free: vector(&tires.f) * tires.inverse[j] - Vector3::z() * self.lanes.gravity,
                friction: self.lanes.friction[j],
                lost: 0.0,
                put_in: 0.0,
            };
            let last = flight.through(h, self.due[first..due].iter().map(|due| (due.after, due.launch)));
            let mid = flight.velocity - last * (0.5 * h);
            for c in 0..3 {
                kicked.u[c][j] = flight.displacement[c];
                kicked.v[c][j] = mid[c];
                kicked.motion[j] |= mid[c].to_bits() << 1;
            }
            kicked.motion[j] |= flight.displacement.z.to_bits() << 1;
            // The kicks before and after count half a step of friction each; here the whole step is counted at once.
            let next_half = 0.5 * h * (flight.free - last).xy().dot(&flight.velocity.xy());
            pass.lost[j] += mass * (flight.lost - next_half) - 0.5 * kicked.dissipated[j];
            pass.put_in[j] += mass * flight.put_in;
        }
        due
    }
}

/// Evaluation of the cables, compiled for each instruction set and chosen at run time.
struct Pull<'s, 'a, const W: usize>(&'s mut Stepper<'a, W>);

impl<const W: usize> pulp::WithSimd for Pull<'_, '_, W> {
    type Output = Pass;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Pass {
        self.0.pull()
    }
}

/// Kick and drift, likewise.
struct Advance<'s, 'a, const W: usize>(&'s mut Stepper<'a, W>, &'s mut Pass);

impl<const W: usize> pulp::WithSimd for Advance<'_, '_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.0.advance(self.1);
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
        let acceleration = self.vector(&self.stepper.f, tire) / mass - Vector3::z() * lanes.gravity;
        let free = self.vector(&self.stepper.v, tire) + acceleration * h;
        let (after, normal) = support(free, friction);
        ((free - after).xy().norm() * mass / h, friction * normal * mass / h)
    }
}
