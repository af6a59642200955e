//! The source paper's method: trapezoidal Newmark (β = 1/4, γ = 1/2) with Newton–Raphson and a contact region.
//!
//! Over a step of length h, v₁ = 2 Δu/h − v₀ and equilibrium holds at its end:
//!
//! M (4 Δu/h² − 4 v₀/h − a₀) = F(u₀ + Δu).
//!
//! Newton–Raphson solves it for a frozen contact region, from Δu = h v₀ + h² a₀/2 on; from Δu = 0 its first iteration
//! would be the paper's predictor (5). The region implied by the result (2)–(4) is compared with the one assumed and the
//! step repeated, on from the last Δu, until both agree; only then is the result converged fully, and compared again. A tire
//! that lands stops falling and loses friction's share of its sideways speed as in [`super::contact`]; holes fire at their
//! exact time, where the step is cut.
//! Acceleration is taken from the balance of forces, so that short steps do not amplify rounding.
//!
//! Only tires that move and those tied to them are looked at ([`super::wake`]). Within a step motion goes on from tire to
//! tire: one that leaves its place wakes its neighbours before the step is repeated, so that nothing is left out.

mod ground;
mod region;
mod sample;
mod settle;
mod system;

use std::borrow::Cow;
use std::sync::OnceLock;

use nalgebra::Vector3;

use self::region::{Ground, Region};
use self::system::System;
use super::record::{Clock, Record};
use super::wake::{Ties, Wake};
use super::{Failure, Motion, Settings, Watcher, time_limit};
use crate::choice::Method;
use crate::outcome::{End, Outcome};
use crate::scene::{Scene, Shot};

/// A scene made ready for many runs.
#[derive(Debug, Default)]
pub struct Model {
    ties: OnceLock<Ties>,
}

impl Model {
    /// Runs one shot of the scene this model is for; see [`super::simulate`].
    pub fn run(
        &self,
        scene: &Scene,
        shot: &Shot,
        settings: &Settings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, Failure> {
        if !(settings.step > 0.0 && settings.step.is_finite()) {
            return Err(Failure::Step { step: settings.step, limit: f64::MAX, method: Method::Newmark });
        }
        let ties = self.ties.get_or_init(|| Ties::of_cables(&scene.cables, scene.mass.len()));
        Stepper::new(scene, ties, shot, settings.step).run(time_limit(shot, settings) * (1.0 + 1e-12), watch)
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
    /// Which tires and cables need work, each of them for itself.
    wake: Wake<'a>,
    /// Elastic energy of the cables asleep [J].
    asleep: f64,
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
    /// Cable forces on the tires at the end and the start of the step, and what equilibrium lacks at its end [N].
    f: Vec<Vector3<f64>>,
    f_start: Vec<Vector3<f64>>,
    residual: Vec<Vector3<f64>>,
}

impl<'a> Stepper<'a> {
    fn new(scene: &'a Scene, ties: &'a Ties, shot: &'a Shot, step: f64) -> Self {
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
            wake: Wake::new(ties),
            asleep: 0.0,
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
            residual: zeros(),
        }
    }

    fn run(mut self, limit: f64, watch: &mut Watcher<'_>) -> Result<Outcome, Failure> {
        loop {
            if !self.moving {
                match self.shot.firings.get(self.clock.fired) {
                    Some(next) if next.at <= limit => self.clock.jump(next.at),
                    Some(_) => return Ok(self.finish(limit, End::TimeLimit)),
                    None => return Ok(self.finish(limit, End::AtRest)),
                }
            }
            if self.now() > limit {
                return Ok(self.finish(limit, End::TimeLimit));
            }
            self.refresh();
            self.sample();
            if watch(&Snapshot { stepper: &self }).is_break() {
                return Err(Failure::Stopped { at: self.now() });
            }
            self.step_through_firings()?;
            self.find_resting();
            self.clock.tick();
        }
    }

    fn now(&self) -> f64 {
        self.clock.now(self.step)
    }

    /// One step, cut where holes fire.
    fn step_through_firings(&mut self) -> Result<(), Failure> {
        for &tire in &self.wake.awake {
            self.earlier[tire] = self.u[tire];
        }
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
            self.wake.set_moving(firing.tire, true);
            self.clock.fired += 1;
        }
        self.advance(self.step - done, 0)
    }

    /// Brings the wake front up to date; whether it changed. Cables that fell asleep keep their energy.
    fn refresh(&mut self) -> bool {
        let changed = self.wake.refresh();
        if changed {
            let stored = |&cable: &usize| {
                let cable = &self.scene.cables[cable];
                cable.energy(cable.displaced(&self.u).norm())
            };
            self.asleep += self.wake.fell_asleep.iter().map(stored).sum::<f64>();
            self.asleep -= self.wake.woke.iter().map(stored).sum::<f64>();
        }
        changed
    }

    /// Finds the tires that are where they were a step ago and stay there.
    fn find_resting(&mut self) {
        self.moving = false;
        for n in 0..self.wake.awake.len() {
            let tire = self.wake.awake[n];
            let moved = self.v[tire] != Vector3::zeros() || self.u[tire] != self.earlier[tire];
            self.moving |= moved || self.u[tire].z > 0.0;
            let rests = !moved && self.region.ground[tire] == Ground::Stick;
            if rests {
                self.a[tire] = Vector3::zeros();
            }
            self.wake.set_moving(tire, !rests);
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

    fn force(&self, cable: usize) -> f64 {
        let Stepper { scene, u, .. } = self.stepper;
        let cable = &scene.cables[cable];
        cable.force(cable.displaced(u).norm())
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

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::simulation::wake::tests::{exact, scenes};

    #[test]
    fn what_sleeps_would_not_have_moved() {
        let (scene, shots) = scenes();
        let ties = || Ties::of_cables(&scene.cables, scene.mass.len());
        let (some, all) = (Model::default(), Model { ties: ties().with_everything().into() });
        // Over the longer step motion goes on through several tires at once.
        for (shot, step) in shots.iter().flat_map(|shot| [(shot, 2e-3), (shot, 2e-2)]) {
            let settings = Settings { method: Method::Newmark, step, duration: None };
            let [some, all] = [&some, &all].map(|model| {
                model.run(&scene, shot, &settings, &mut |_| ControlFlow::Continue(())).expect("a run")
            });
            assert_eq!(exact(&some), exact(&all));
        }
    }
}
