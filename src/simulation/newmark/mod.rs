//! The source paper's method: trapezoidal Newmark (β = 1/4, γ = 1/2) with Newton–Raphson and a contact region.
//!
//! Over a step of length h, v₁ = 2 Δu/h − v₀ and equilibrium holds at its end:
//!
//! M (4 Δu/h² − 4 v₀/h − a₀) = F(u₀ + Δu).
//!
//! Newton–Raphson solves it for a frozen contact region. From Δu = 0 its first iteration is the paper's predictor (5): the
//! residual there is M (4 v₀/h + 2 a₀) and the matrix K₀ + 4M/h². After convergence the region implied by the result (2)–(4)
//! is compared with the one assumed and the step repeated until both agree. A tire that lands stops falling and loses
//! friction's share of its sideways speed as in [`super::contact`]; holes fire at their exact time, where the step is cut.
//! Acceleration is taken from the balance of forces, so that short steps do not amplify rounding.

mod region;
mod system;

use std::borrow::Cow;

use nalgebra::{Vector2, Vector3};

use self::region::{Ground, MOST_REPEATS, Region};
use self::system::System;
use super::contact::{support, top};
use super::record::{Clock, Record};
use super::{Failure, Motion, Settings, Watcher, time_limit};
use crate::outcome::{Broken, End, Outcome, Peak};
use crate::plan::Method;
use crate::scene::{Scene, Shot};

/// Newton iterations before a step is halved.
const MOST_ITERATIONS: usize = 20;
/// Times a step is halved before it is given up.
const MOST_HALVINGS: usize = 8;
/// Newton stops when its correction is this small beside the step's displacement.
const CONVERGED: f64 = 1e-10;

/// Runs one shot; see [`super::simulate`].
pub fn run(
    scene: &Scene,
    shot: &Shot,
    settings: &Settings,
    watch: &mut Watcher<'_>,
) -> Result<Outcome, Failure> {
    if !(settings.step > 0.0 && settings.step.is_finite()) {
        return Err(Failure::Step { step: settings.step, limit: f64::MAX, method: Method::Newmark });
    }
    let limit = time_limit(shot, settings) * (1.0 + 1e-12);
    let mut stepper = Stepper::new(scene, shot, settings.step);
    loop {
        let at_rest = !stepper.moving;
        if at_rest {
            match shot.firings.get(stepper.clock.fired) {
                Some(next) if next.at <= limit => stepper.clock.jump(next.at),
                _ => return Ok(stepper.finish(End::AtRest)),
            }
        }
        if stepper.now() > limit {
            return Ok(stepper.finish(End::TimeLimit));
        }
        stepper.sample();
        if watch(&Snapshot { stepper: &stepper }).is_break() {
            return Err(Failure::Stopped { at: stepper.now() });
        }
        stepper.step_through_firings()?;
        stepper.clock.tick();
    }
}

struct Stepper<'a> {
    /// The scene, less the cables that broke.
    scene: Cow<'a, Scene>,
    shot: &'a Shot,
    friction: f64,
    step: f64,
    clock: Clock,
    moving: bool,
    record: Record,
    /// Cable of the greatest force, if sampled in the step before, and its k (L − L0) a step earlier [N].
    sampled: Option<(usize, f64)>,
    /// Displacement [m], velocity [m/s], acceleration [m/s²] (`n_tires`).
    u: Vec<Vector3<f64>>,
    v: Vec<Vector3<f64>>,
    a: Vec<Vector3<f64>>,
    /// Displacement a sample earlier [m].
    earlier: Vec<Vector3<f64>>,
    region: Region,
    implied: Region,
    system: System,
    /// Displacement over the step and at its end [m].
    du: Vec<Vector3<f64>>,
    end: Vec<Vector3<f64>>,
    /// Cable forces on the tires [N].
    f: Vec<Vector3<f64>>,
    f_start: Vec<Vector3<f64>>,
    right: Vec<Vector3<f64>>,
}

impl<'a> Stepper<'a> {
    fn new(scene: &'a Scene, shot: &'a Shot, step: f64) -> Self {
        let zeros = || vec![Vector3::zeros(); scene.mass.len()];
        let region =
            Region { taut: vec![false; scene.cables.len()], ground: vec![Ground::Stick; scene.mass.len()] };
        Self {
            scene: Cow::Borrowed(scene),
            shot,
            friction: shot.friction.unwrap_or(scene.friction),
            step,
            clock: Clock::new(shot),
            moving: false,
            record: Record::new(step),
            sampled: None,
            u: zeros(),
            v: zeros(),
            a: zeros(),
            earlier: zeros(),
            implied: region.clone(),
            region,
            system: System::new(scene),
            du: zeros(),
            end: zeros(),
            f: zeros(),
            f_start: zeros(),
            right: zeros(),
        }
    }

    fn now(&self) -> f64 {
        self.clock.now(self.step)
    }

    /// One step, cut where holes fire.
    fn step_through_firings(&mut self) -> Result<(), Failure> {
        self.earlier.copy_from_slice(&self.u);
        self.moving = false;
        let (start, mut done) = (self.clock.since(self.step), 0.0);
        while let Some(&firing) = self.shot.firings.get(self.clock.fired) {
            let after = firing.at - self.clock.base - start;
            if after >= self.step {
                break;
            }
            if after > done {
                self.advance(after - done, 0)?;
                done = after;
            }
            let velocity = &mut self.v[firing.tire].z;
            let energy = firing.launch * (*velocity + 0.5 * firing.launch);
            *velocity += firing.launch;
            self.record.ledger.put_in += self.scene.mass[firing.tire] * energy;
            self.region.ground[firing.tire] = Ground::Free;
            self.clock.fired += 1;
        }
        self.advance(self.step - done, 0)
    }

    /// One cut of a step: repeated until the contact region stands still, and halved where it does not.
    fn advance(&mut self, h: f64, halved: usize) -> Result<(), Failure> {
        match self.settle(h) {
            Err(Failure::Unsettled { .. }) if halved < MOST_HALVINGS => {
                self.advance(0.5 * h, halved + 1)?;
                self.advance(0.5 * h, halved + 1)
            }
            settled => settled,
        }
    }

    fn settle(&mut self, h: f64) -> Result<(), Failure> {
        cable_forces(&self.scene, &self.u, |cable, length| cable.force(length), &mut self.f_start);
        self.set_accelerations();
        for repeats in 0..MOST_REPEATS {
            self.solve(h)?;
            self.imply(h);
            if !self.region.adopt(&self.implied, repeats) {
                self.accept(h);
                return Ok(());
            }
        }
        Err(Failure::Unsettled { what: "contact region", at: self.now() })
    }

    /// Accelerations at the start of a cut from the balance of forces there.
    fn set_accelerations(&mut self) {
        for tire in 0..self.u.len() {
            let free = self.f_start[tire] / self.scene.mass[tire] - Vector3::z() * self.scene.gravity;
            self.a[tire] = match self.region.ground[tire] {
                Ground::Free => free,
                Ground::Stick => Vector3::zeros(),
                Ground::Slip => (free.xy() + self.friction(free, self.v[tire].xy())).push(0.0),
            };
        }
    }

    /// Friction of a sliding tire per mass: μ times the reaction, against the velocity, or the pull where there is none.
    fn friction(&self, free: Vector3<f64>, velocity: Vector2<f64>) -> Vector2<f64> {
        let limit = self.friction * (-free.z).max(0.0);
        let direction = velocity.try_normalize(0.0).or_else(|| free.xy().try_normalize(0.0));
        direction.map_or_else(Vector2::zeros, |direction| direction * -limit)
    }

    /// The same at the end of a step, where it can do no more than stop the tire: one that has just landed may be slow.
    fn end_friction(&self, tire: usize, free: Vector3<f64>, h: f64) -> Vector2<f64> {
        let sliding = self.sliding(tire, h);
        self.friction(free, sliding).cap_magnitude(2.0 * sliding.norm() / h)
    }

    /// Newton–Raphson for the present region.
    fn solve(&mut self, h: f64) -> Result<(), Failure> {
        for tire in 0..self.u.len() {
            let (du, open) = match self.region.ground[tire] {
                Ground::Free => (Vector3::zeros(), Vector3::repeat(1.0)),
                Ground::Slip => (Vector3::z() * -self.u[tire].z, Vector3::new(1.0, 1.0, 0.0)),
                Ground::Stick => ((self.v[tire].xy() * (0.5 * h)).push(-self.u[tire].z), Vector3::zeros()),
            };
            self.du[tire] = du;
            self.system.open[tire] = open;
        }
        for _ in 0..MOST_ITERATIONS {
            self.set_residual(h);
            self.system.assemble(&self.scene, &self.end, &self.region.taut, h);
            if !self.system.solve(&self.scene, &self.right) {
                break;
            }
            let (mut correction, mut way) = (0.0_f64, 0.0_f64);
            for (du, delta) in self.du.iter_mut().zip(&self.system.correction) {
                *du += delta;
                correction = correction.max(delta.amax());
                way = way.max(du.amax());
            }
            if !way.is_finite() {
                return Err(Failure::Diverged { at: self.now() });
            }
            if correction <= CONVERGED * way {
                self.set_residual(h);
                return Ok(());
            }
        }
        Err(Failure::Unsettled { what: "Newton iteration", at: self.now() })
    }

    /// Residual of equilibrium at the end of the step, and the forces there.
    fn set_residual(&mut self, h: f64) {
        for tire in 0..self.u.len() {
            self.end[tire] = self.u[tire] + self.du[tire];
        }
        let Self { region, scene, end, .. } = self;
        let mut taut = region.taut.iter();
        let law = |cable: &crate::scene::Cable, length: f64| {
            let on = taut.next().is_some_and(|&on| on);
            if on { cable.stiffness * (length - cable.rest_length) } else { 0.0 }
        };
        cable_forces(scene, end, law, &mut self.f);
        for tire in 0..self.u.len() {
            let mass = self.scene.mass[tire];
            let mut force = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
            if self.region.ground[tire] == Ground::Slip {
                force += self.end_friction(tire, force, h).push(0.0);
            }
            let inertia = (self.du[tire] / h - self.v[tire]) * (4.0 / h) - self.a[tire];
            self.right[tire] = (force - inertia) * mass;
        }
    }

    fn end_velocity(&self, tire: usize, h: f64) -> Vector3<f64> {
        self.du[tire] * (2.0 / h) - self.v[tire]
    }

    /// Sideways velocity at the end of the step were there no friction [m/s]: what friction opposes.
    fn sliding(&self, tire: usize, h: f64) -> Vector2<f64> {
        let force = (self.f_start[tire] + self.f[tire]).xy();
        self.v[tire].xy() + force * (0.5 * h / self.scene.mass[tire])
    }

    /// Whether a tire found on the ground at the end of the step meets it there with a speed.
    fn lands(&self, tire: usize) -> bool {
        self.u[tire].z > 0.0 || self.v[tire].z != 0.0
    }

    /// The region that the solution implies.
    fn imply(&mut self, h: f64) {
        for (cable, taut) in self.scene.cables.iter().zip(&mut self.implied.taut) {
            *taut = cable.displaced(&self.end).norm() > cable.rest_length;
        }
        for tire in 0..self.u.len() {
            self.implied.ground[tire] = self.implied_ground(tire, h);
        }
    }

    fn implied_ground(&self, tire: usize, h: f64) -> Ground {
        let mass = self.scene.mass[tire];
        let free = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
        let assumed = self.region.ground[tire];
        let lands = self.lands(tire);
        if assumed == Ground::Free {
            return if self.end[tire].z < 0.0 { Ground::Slip } else { Ground::Free };
        }
        if free.z > 0.0 && !lands {
            return Ground::Free;
        }
        let within_cone = self.sliding(tire, h).norm() <= self.friction * (-free.z).max(0.0) * h;
        match assumed {
            Ground::Stick if !within_cone => Ground::Slip,
            Ground::Slip if !lands && within_cone => Ground::Stick,
            other => other,
        }
    }

    /// Takes over the end of the step, with landings and what they and friction dissipate.
    fn accept(&mut self, h: f64) {
        for tire in 0..self.u.len() {
            let mass = self.scene.mass[tire];
            let mut velocity = self.end_velocity(tire, h);
            let ground = self.region.ground[tire];
            if ground == Ground::Stick {
                let force = (self.f[tire] + self.f_start[tire]).xy() * (0.5 * h);
                let stopped = self.v[tire].xy() * mass + force;
                self.record.ledger.dissipated += 0.5 * stopped.dot(&self.v[tire].xy());
                velocity = Vector3::zeros();
            } else if ground == Ground::Slip {
                velocity.z = 0.0;
                let free = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
                let before = self.a[tire].xy() - self.f_start[tire].xy() / mass;
                let friction = 0.5 * (before + self.end_friction(tire, free, h));
                self.record.ledger.dissipated -= mass * friction.dot(&self.du[tire].xy());
                if self.lands(tire) {
                    velocity = self.land(tire, h, velocity);
                }
            }
            self.moving |=
                velocity != Vector3::zeros() || self.du[tire] != Vector3::zeros() || self.end[tire].z > 0.0;
            self.v[tire] = velocity;
        }
        std::mem::swap(&mut self.u, &mut self.end);
    }

    /// The landing of a tire within the step: its impact speed follows from the fall, friction takes its share sideways.
    fn land(&mut self, tire: usize, h: f64, velocity: Vector3<f64>) -> Vector3<f64> {
        let (height, rise, a) = (self.u[tire].z, self.v[tire].z, self.a[tire].z);
        // A flight within the step is seen by no sample.
        if let Some((more, until)) = top(rise, a, h)
            && height + more > self.record.height.value
        {
            self.record.height = Peak { value: height + more, at: self.now() + until, place: tire };
        }
        let impact = (rise * rise - 2.0 * a * height).max(0.0).sqrt();
        let left = (h - 2.0 * height / (impact - rise).max(f64::MIN_POSITIVE)).clamp(0.0, h);
        let before = velocity.xy().push(-impact);
        let (after, _) = support(before, self.friction);
        self.end[tire] += (after.xy() - before.xy()).push(0.0) * left;
        let lost = 0.5 * self.scene.mass[tire] * (before.norm_squared() - after.norm_squared());
        self.record.ledger.dissipated += lost;
        if after.xy() == Vector2::zeros() {
            self.region.ground[tire] = Ground::Stick;
        }
        after
    }

    /// Notes peaks, history and ledger of the present state.
    fn sample(&mut self) {
        let now = self.now();
        if let Some((cable, before)) = self.sampled.take() {
            self.record.vertex(before, self.signed_force(cable, &self.u));
        }
        let breaking_force = self.scene.breaking_force.unwrap_or(f64::INFINITY);
        let (mut energy, mut height, mut force) = (0.0, 0.0_f64, 0.0_f64);
        for (place, cable) in self.scene.cables.iter().enumerate() {
            let pull = cable.force(cable.displaced(&self.u).norm());
            energy += 0.5 * pull * pull / cable.stiffness;
            force = force.max(pull);
            if pull > self.record.force.value {
                self.record.force = Peak { value: pull, at: now, place };
                self.sampled = Some((place, self.signed_force(place, &self.earlier)));
            }
        }
        for (tire, &mass) in self.scene.mass.iter().enumerate() {
            let value = self.u[tire].z;
            height = height.max(value);
            energy += mass * (0.5 * self.v[tire].norm_squared() + self.scene.gravity * value);
            if value > self.record.height.value {
                let sample = Peak { value, at: now, place: tire };
                self.record.higher(sample, self.v[tire].z, self.a[tire].z);
            }
        }
        self.record.balance(energy, 0.0);
        if force > breaking_force {
            self.cut_broken(breaking_force);
        }
        self.record.history.note(now, height, force);
    }

    /// Takes away the cables that pull past their breaking force; what they stored is lost.
    #[cold]
    fn cut_broken(&mut self, breaking_force: f64) {
        let at = self.now();
        for cable in 0..self.scene.cables.len() {
            let pull = self.scene.cables[cable].force(self.scene.cables[cable].displaced(&self.u).norm());
            if pull > breaking_force {
                self.record.ledger.dissipated += 0.5 * pull * pull / self.scene.cables[cable].stiffness;
                self.record.broken.push(Broken { at, cable });
                self.scene.to_mut().cables[cable].rest_length = f64::INFINITY;
                self.region.taut[cable] = false;
            }
        }
    }

    fn signed_force(&self, cable: usize, u: &[Vector3<f64>]) -> f64 {
        let cable = &self.scene.cables[cable];
        cable.stiffness * (cable.displaced(u).norm() - cable.rest_length)
    }

    fn finish(self, end: End) -> Outcome {
        let mut drift = Peak { at: self.now(), ..Peak::default() };
        for (tire, u) in self.u.iter().enumerate() {
            if u.xy().norm() > drift.value {
                (drift.value, drift.place) = (u.xy().norm(), tire);
            }
        }
        self.record.finish(drift, self.clock.steps, end)
    }
}

/// Sums over the cables the force that `law` gives at their length, into the forces on the tires [N].
fn cable_forces(
    scene: &Scene,
    u: &[Vector3<f64>],
    mut law: impl FnMut(&crate::scene::Cable, f64) -> f64,
    forces: &mut [Vector3<f64>],
) {
    forces.fill(Vector3::zeros());
    for cable in &scene.cables {
        let span = cable.displaced(u);
        let length = span.norm();
        let force = law(cable, length);
        if force != 0.0 {
            let pull = span * (force / length);
            forces[cable.ends[0]] += pull;
            forces[cable.ends[1]] -= pull;
        }
    }
}

struct Snapshot<'s, 'a> {
    stepper: &'s Stepper<'a>,
}

impl Motion for Snapshot<'_, '_> {
    fn time(&self) -> f64 {
        self.stepper.now()
    }

    fn displacement(&self, tire: usize) -> Vector3<f64> {
        self.stepper.u[tire]
    }

    fn friction(&self, tire: usize) -> (f64, f64) {
        let Stepper { scene, region, f, .. } = self.stepper;
        let mass = scene.mass[tire];
        let limit = self.stepper.friction * (mass * scene.gravity - f[tire].z).max(0.0);
        match region.ground[tire] {
            Ground::Free => (0.0, 0.0),
            Ground::Slip => (limit, limit),
            Ground::Stick => (f[tire].xy().norm().min(limit), limit),
        }
    }
}
