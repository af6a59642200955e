//! Motion of the shelter: a [`Scene`] and a [`Shot`] come in, an [`Outcome`] goes out.
//!
//! | symbol | here | paper |
//! |---|---|---|
//! | u | displacement of a tire from its place at rest [m]; its third component is the flight height | z = (u, v, w) |
//! | N | cable force, k (L − L0) while L > L0, else 0 [N] | N, (4) |
//! | R, Ff | reaction of the ground and friction [N]; u₃ ≥ 0, R ≥ 0, R u₃ = 0, \|Ff\| ≤ μR | R, Ff, (2), (3) |
//! | h | step [s] | Δt |
//!
//! Two methods, one model: [`verlet`] is explicit with contact in closed form, [`newmark`] is the source paper's.
//! Nothing here knows of plans, options, limits or screens. A motion that blows up is a [`Failure`], never a result.

mod cable;
mod contact;
mod kick;
mod mirror;
pub mod newmark;
mod pack;
mod record;
mod tension;
pub mod verlet;
mod wake;

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::choice::Method;
use crate::outcome::Outcome;
use crate::scene::{Scene, Shot};

/// Simulated time after the last firing at which a shelter that never settles is given up [s].
pub const SETTLING_LIMIT: f64 = 60.0;

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Which method.
    pub method: Method,
    /// Step [s].
    pub step: f64,
    /// End of the run [s]; `None`: until every tire is at rest.
    pub duration: Option<f64>,
}

/// Why a run has no outcome.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    /// The step is beyond what the method can follow, or none at all.
    #[error(
        "the step of {step} s is outside what {method:?} can follow here, 0 to {limit:.3e} s: choose a smaller --dt"
    )]
    Step {
        /// Asked for [s].
        step: f64,
        /// Greatest stable step [s].
        limit: f64,
        /// By which method.
        method: Method,
    },
    /// The state stopped being finite.
    #[error("the motion is no longer finite at {at} s: choose a smaller --dt")]
    Diverged {
        /// When [s].
        at: f64,
    },
    /// Newton–Raphson or the contact region did not settle within its bound.
    #[error("the {what} does not settle at {at} s: choose a smaller --dt")]
    Unsettled {
        /// Which iteration.
        what: &'static str,
        /// When [s].
        at: f64,
    },
    /// The watcher said stop.
    #[error("stopped at {at} s before the end")]
    Stopped {
        /// When [s].
        at: f64,
    },
}

/// A look at the shelter in motion, given to the watcher at every step.
pub trait Motion {
    /// Time [s].
    fn time(&self) -> f64;
    /// Displacement of a tire from its place at rest [m].
    fn displacement(&self, tire: usize) -> Vector3<f64>;
    /// Force of a cable, 0 once it is broken [N].
    fn force(&self, cable: usize) -> f64;
    /// Actual friction force on a tire and its limit μR [N]; both 0 off the ground.
    fn friction(&self, tire: usize) -> (f64, f64);
}

/// Sees every step; says whether to go on.
pub type Watcher<'a> = dyn FnMut(&dyn Motion) -> ControlFlow<()> + 'a;

/// A scene made ready for many runs.
#[derive(Clone, Debug)]
pub struct Model {
    scene: Arc<Scene>,
    verlet: Arc<verlet::Model>,
    newmark: Arc<newmark::Model>,
}

impl Model {
    /// Of a scene; what the methods need is made at their first run.
    pub fn new(scene: Scene) -> Self {
        Self { scene: Arc::new(scene), verlet: Arc::default(), newmark: Arc::default() }
    }

    /// What it is made of.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Runs one shot. `watch` sees every step and may stop the run.
    pub fn run(&self, shot: &Shot, settings: &Settings, watch: &mut Watcher<'_>) -> Result<Outcome, Failure> {
        match settings.method {
            Method::Verlet => self.verlet.run(&self.scene, shot, settings, watch),
            Method::Newmark => self.newmark.run(&self.scene, shot, settings, watch),
        }
    }

    /// How many tires are integrated for a shot: fewer than the scene has where both are their own mirror image and the
    /// method uses it.
    pub fn modelled_tires(&self, method: Method, shot: &Shot) -> usize {
        match method {
            Method::Verlet => self.verlet.modelled_tires(&self.scene, shot),
            Method::Newmark => self.scene.mass.len(),
        }
    }
}

/// Runs one shot of a scene that is run only once; see [`Model::run`].
pub fn simulate(
    scene: &Scene,
    shot: &Shot,
    settings: &Settings,
    watch: &mut Watcher<'_>,
) -> Result<Outcome, Failure> {
    match settings.method {
        Method::Verlet => verlet::Model::default().run(scene, shot, settings, watch),
        Method::Newmark => newmark::Model::default().run(scene, shot, settings, watch),
    }
}

/// When a run of `shot` must end at the latest [s].
fn time_limit(shot: &Shot, settings: &Settings) -> f64 {
    let last = shot.firings.last().map_or(0.0, |firing| firing.at);
    settings.duration.unwrap_or(last + SETTLING_LIMIT)
}
