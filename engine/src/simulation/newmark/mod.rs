//! The method of the source paper: trapezoidal Newmark (β = 1/4, γ = 1/2) with Newton–Raphson and a contact region.
//!
//! Symbols: h step; u₀, v₀, a₀ displacement, velocity and acceleration at the start of the step; Δu displacement over the step; v₁
//! velocity at its end; M masses; K stiffness; F forces. The velocity at the end is v₁ = 2 Δu/h − v₀, and equilibrium holds at the
//! end:
//!
//! M (4 Δu/h² − 4 v₀/h − a₀) = F(u₀ + Δu).
//!
//! 1. Newton–Raphson solves this equation for an assumed contact region. Its first iteration from Δu = 0 is the paper's predictor
//!    step (5), ΔF̄ = R̄ Δu, with ΔF̄ = (F₁ − F₀) + M (4 v₀/h + 2 a₀) and R̄ = K + 4M/h². Here F₁ = F₀, because holes change
//!    velocities, and M a₀ = F(u₀). At useful steps 4M/h² outweighs K. Without K, (5) gives Δu = h v₀ + h² a₀/2. The iteration
//!    begins there.
//! 2. The solution implies a contact region by (2)–(4). If the implied region differs from the assumed region, the step is repeated
//!    with the implied region, from the last Δu on.
//! 3. When both regions agree, Newton–Raphson converges fully, and the regions are compared once more.
//!
//! A tire that lands stops falling and loses sideways speed by friction as in [`super::contact`]. Holes fire at their exact time:
//! the step is cut there. Accelerations come from the balance of forces, so that short steps do not amplify rounding.
//!
//! Only tires that move, and the tires tied to them, are computed ([`super::wake`]). Motion can spread over several tires within
//! one step: a tire that starts to move wakes its neighbours before the step is repeated.

mod converge;
mod ground;
mod note_state;
mod region;
mod system;

use std::borrow::Cow;
use std::sync::OnceLock;

use nalgebra::{Vector2, Vector3};

use self::region::{Region, TireContact};
use self::system::System;
use super::clock::Clock;
use super::record::Record;
use super::wake::{Ties, Wake};
use super::{Motion, RunError, RunSettings, Watcher};
use crate::choice::Method;
use crate::outcome::Outcome;
use crate::scene::{Scene, Shot};

/// Ties of one scene, made at their first use and kept for later runs.
#[derive(Debug, Default)]
pub struct NewmarkModel {
    ties: OnceLock<Ties>,
}

impl NewmarkModel {
    /// Runs one shot of the scene of this model; see [`super::Model::run`].
    pub fn run(
        &self,
        scene: &Scene,
        shot: &Shot,
        settings: &RunSettings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, RunError> {
        if !(settings.step > 0.0 && settings.step.is_finite()) {
            return Err(RunError::Step { step: settings.step, limit: f64::MAX, method: Method::Newmark });
        }
        if scene.restitution > 0.0 {
            return Err(RunError::Effect { effect: "restitution", method: Method::Newmark });
        }
        if scene.damping > 0.0 {
            return Err(RunError::Effect { effect: "damping", method: Method::Newmark });
        }
        if shot.firings.iter().any(|firing| firing.push_time > 0.0) {
            return Err(RunError::Effect { effect: "push", method: Method::Newmark });
        }
        let ties = self.ties.get_or_init(|| Ties::of_cables(scene));
        Stepper::new(scene, ties, shot, settings).run(watch)
    }
}

/// State of one run. All vectors are by tire (`n_tires`).
struct Stepper<'a> {
    /// The scene; broken cables have an infinite unstretched length.
    scene: Cow<'a, Scene>,
    shot: &'a Shot,
    friction: f64,
    /// Step [s].
    step: f64,
    clock: Clock,
    /// Whether any tire moved in the last step.
    moving: bool,
    record: Record,
    /// Cable of the greatest force, if that force was found one step ago, and its k (L − L0) over strength one step earlier [N].
    peak_to_refine: Option<(usize, f64)>,
    /// Tires and cables that need work, in packs of one tire and blocks of one cable.
    wake: Wake<'a>,
    /// Elastic energy of the cables asleep [J].
    asleep_elastic_energy: f64,
    /// Potential energy of all tires asleep on the slope [J].
    asleep_slope_energy: f64,
    /// Displacement [m].
    u: Vec<Vector3<f64>>,
    /// Velocity [m/s].
    v: Vec<Vector3<f64>>,
    /// Acceleration [m/s²].
    a: Vec<Vector3<f64>>,
    /// Displacement one step earlier [m].
    earlier: Vec<Vector3<f64>>,
    /// Contact region assumed for the step.
    region: Region,
    /// Contact region that the solution implies.
    implied: Region,
    system: System,
    /// Displacement over the step [m].
    du: Vec<Vector3<f64>>,
    /// Displacement at the end of the step [m].
    end: Vec<Vector3<f64>>,
    /// Cable force and gravity along the ground at the end of the step [N].
    f: Vec<Vector3<f64>>,
    /// Cable force and gravity along the ground at the start of the step [N].
    f_start: Vec<Vector3<f64>>,
    /// Force that is out of balance at the end of the step [N].
    residual: Vec<Vector3<f64>>,
}

impl<'a> Stepper<'a> {
    /// Run of `shot` under `scene`, before the first step.
    fn new(scene: &'a Scene, ties: &'a Ties, shot: &'a Shot, settings: &RunSettings) -> Self {
        let zeros = || vec![Vector3::zeros(); scene.tire_count()];
        let friction = shot.friction.unwrap_or(scene.friction);
        let slides = scene.slides(friction);
        let mut wake = Wake::new(ties);
        if slides {
            wake.set_all_moving();
        }
        let ground = vec![if slides { TireContact::Slip } else { TireContact::Stick }; scene.tire_count()];
        let region = Region { taut: vec![false; scene.cables.len()], ground };
        Self {
            scene: Cow::Borrowed(scene),
            shot,
            friction,
            step: settings.step,
            clock: Clock::new(shot, settings, slides),
            moving: slides,
            record: Record::new(settings.step),
            peak_to_refine: None,
            wake,
            asleep_elastic_energy: 0.0,
            asleep_slope_energy: 0.0,
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

    /// Makes all steps; returns the outcome.
    fn run(mut self, watch: &mut Watcher<'_>) -> Result<Outcome, RunError> {
        loop {
            if let Some(reason) = self.clock.skip_rest_or_end(self.moving, &self.shot.firings) {
                return Ok(self.finish(reason));
            }
            self.refresh();
            self.note_state();
            if watch(&Snapshot { stepper: &self }).is_break() {
                return Err(RunError::Stopped { time: self.clock.now() });
            }
            self.step_through_firings()?;
            self.find_resting();
            self.clock.tick();
        }
    }

    /// Integrates one step, cut at the firing times of holes.
    fn step_through_firings(&mut self) -> Result<(), RunError> {
        for &tire in self.wake.awake_tires() {
            self.earlier[tire] = self.u[tire];
        }
        let (start, mut done) = (self.clock.since_base(), 0.0);
        while let Some(&firing) = self.shot.firings.get(self.clock.fired) {
            let after = firing.time - self.clock.base - start;
            if after >= self.step {
                break;
            }
            if after > done {
                self.advance(after - done, 0)?;
                done = after;
            }
            self.clock.fired += 1;
            if self.scene.is_anchor(firing.tire) {
                continue;
            }
            self.note_force_at_firing(firing.tire, firing.time);
            let velocity = &mut self.v[firing.tire];
            let energy = firing.launch.dot(&(*velocity + 0.5 * firing.launch));
            *velocity += firing.launch;
            self.record.ledger.put_in += self.scene.mass[firing.tire] * energy;
            if firing.launch != Vector3::zeros() {
                self.region.ground[firing.tire] = TireContact::InAir;
            }
            self.wake.set_moving(firing.tire, true);
        }
        self.advance(self.step - done, 0)
    }

    /// Updates the wake front; returns whether the front changed. Cables that fell asleep keep their energy.
    fn refresh(&mut self) -> bool {
        let changed = self.wake.refresh();
        if changed {
            let stored = |&cable: &usize| {
                let cable = &self.scene.cables[cable];
                cable.energy(cable.displaced(&self.u).norm())
            };
            self.asleep_elastic_energy += self.wake.fell_asleep.iter().map(stored).sum::<f64>();
            self.asleep_elastic_energy -= self.wake.woke.iter().map(stored).sum::<f64>();
            if self.scene.downhill != Vector2::zeros() {
                let asleep = (0..self.u.len())
                    .filter(|&tire| !self.wake.is_awake(tire) && !self.scene.is_anchor(tire));
                let energy =
                    |tire: usize| -self.scene.mass[tire] * self.scene.downhill.dot(&self.u[tire].xy());
                self.asleep_slope_energy = asleep.map(energy).sum();
            }
        }
        changed
    }

    /// Finds the tires at rest: they did not move in the last step, and stick to the ground.
    fn find_resting(&mut self) {
        self.moving = false;
        for n in 0..self.wake.awake_tires().len() {
            let tire = self.wake.awake_tires()[n];
            let moved = self.v[tire] != Vector3::zeros() || self.u[tire] != self.earlier[tire];
            self.moving |= moved || self.u[tire].z > 0.0;
            let rests = !moved && self.region.ground[tire] == TireContact::Stick;
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
        self.stepper.clock.now()
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
        if scene.is_anchor(tire) {
            return (0.0, 0.0);
        }
        let mass = scene.mass[tire];
        let limit = self.stepper.friction * (mass * scene.gravity - f[tire].z).max(0.0);
        match region.ground[tire] {
            TireContact::InAir => (0.0, 0.0),
            TireContact::Slip => (limit, limit),
            TireContact::Stick => (f[tire].xy().norm().min(limit), limit),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::simulation::wake::tests::{exact, scenes};

    /// A free tire at rest, 1 m above the ground. The region assumes it on the ground, as after a longer step that was given up.
    fn tire_aloft(check: impl FnOnce(Stepper<'_>)) {
        let scene = &Scene { cables: Vec::new(), ..scenes().0 };
        let ties = Ties::of_cables(scene);
        let shot = Shot::from_firings(Vec::new());
        let settings = RunSettings { method: Method::Newmark, step: 1e-3, duration: None };
        let mut stepper = Stepper::new(scene, &ties, &shot, &settings);
        stepper.u[0].z = 1.0;
        stepper.region.ground[0] = TireContact::Slip;
        stepper.wake.set_moving(0, true);
        check(stepper);
    }

    /// The tire falls freely: 1 m − g h²/2.
    #[test]
    fn a_tire_that_was_assumed_on_the_ground_falls_from_where_it_is() {
        tire_aloft(|mut stepper| {
            let h = 1e-3;
            stepper.advance(h, 0).expect("a step");
            assert!((stepper.u[0].z - (1.0 - 0.5 * stepper.scene.gravity * h * h)).abs() < 1e-12);
            assert!((stepper.v[0].z + stepper.scene.gravity * h).abs() < 1e-12);
        });
    }

    /// A solution that needs the ground to pull implies that the tire is in the air.
    #[test]
    fn the_ground_does_not_pull() {
        tire_aloft(|mut stepper| {
            let h = 1e-3;
            stepper.refresh();
            stepper.set_start_forces();
            stepper.set_accelerations();
            stepper.predict(h);
            stepper.solve(h, 1e-10).expect("a solution");
            assert_eq!(stepper.end[0].z, 0.0);
            stepper.set_implied_region(h);
            assert_eq!(stepper.implied.ground[0], TireContact::InAir);
        });
    }

    #[test]
    fn tires_asleep_would_not_have_moved() {
        let (scene, shots) = scenes();
        let ties = || Ties::of_cables(&scene);
        let (some, all) = (NewmarkModel::default(), NewmarkModel { ties: ties().with_everything().into() });
        // With the longer step, motion spreads over several tires within one step.
        for (shot, step) in shots.iter().flat_map(|shot| [(shot, 2e-3), (shot, 2e-2)]) {
            let settings = RunSettings { method: Method::Newmark, step, duration: None };
            let [some, all] = [&some, &all].map(|cache| {
                cache.run(&scene, shot, &settings, &mut |_| ControlFlow::Continue(())).expect("a run")
            });
            assert_eq!(exact(&some), exact(&all));
        }
    }
}
