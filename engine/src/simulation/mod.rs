//! Motion of the shelter: a [`Scene`] and a [`Shot`] come in, an [`Outcome`] goes out.
//!
//! | symbol | here | paper |
//! |---|---|---|
//! | u | displacement of a tire from its position at rest [m]; its third component is the flight height | z = (u, v, w) |
//! | N | cable force, k (L − L0) while L > L0, else 0 [N] | N, (4) |
//! | R, Ff | reaction of the ground and friction [N]; u₃ ≥ 0, R ≥ 0, R u₃ = 0, \|Ff\| ≤ μR | R, Ff, (2), (3) |
//! | h | step [s] | Δt |
//!
//! | what | where |
//! |---|---|
//! | the two methods, each a stepper | `verlet`, `newmark` |
//! | a tire on the ground: support, friction, landing, push | `contact` |
//! | cables in the order of memory | `cable_blocks` |
//! | which tires and cables need work in a step | `wake` |
//! | when holes fire, when the run ends | `clock` |
//! | peaks, broken cables, energy, history | `record` |
//! | why there is no outcome | `run_error` |
//! | numbers in registers; lists in one piece of memory | `pack`, `compressed_rows` |
//!
//! Words of the loop:
//!
//! - A *part* is the piece of a scene that stands for the whole scene. The rest are mirror *images* that move alike.
//! - A *pack* is eight numbers of eight tires or eight cables, each in a *lane*. A register of the processor holds a pack or a
//!   piece of one.
//! - A *block* is a list of cables of equal span whose tires follow one another.
//! - A *slot* is the place of a cable in its block, or of a tire in the packs.
//! - An *element* is a place in the arrays over the cables of all blocks. Some elements are empty.
//! - A tire is *asleep* while the loop does not evaluate it: the tire and the tires tied to it are at rest.
//!
//! Two methods solve one model: `verlet` is explicit with contact in closed form, `newmark` is the method of the source paper. This
//! module does not know plans, options, limits or screens. A motion that is no longer finite is a [`RunError`], never a result.

mod cable_blocks;
mod clock;
mod compressed_rows;
mod contact;
mod newmark;
mod pack;
mod record;
mod run_error;
mod verlet;
mod wake;

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::Vector3;

use self::newmark::NewmarkModel;
pub use self::run_error::{Iteration, RunError};
use self::verlet::VerletModel;
use crate::choice::Method;
use crate::outcome::Outcome;
use crate::scene::{Scene, Shot};

/// Method, step and end of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunSettings {
    /// Time integration method.
    pub method: Method,
    /// Step [s].
    pub step: f64,
    /// End of the run [s]; `None`: the run ends when every tire is at rest.
    pub duration: Option<f64>,
}

/// State of the shelter at one step, as the watcher sees it.
pub trait Motion {
    /// Present time [s].
    fn time(&self) -> f64;
    /// Displacement of a tire from its position at rest [m].
    fn displacement(&self, tire: usize) -> Vector3<f64>;
    /// Force of a cable [N]; 0 for a broken cable.
    fn force(&self, cable: usize) -> f64;
    /// Friction force on a tire and its limit μR [N]; both 0 for a tire in the air and for an anchor.
    fn friction(&self, tire: usize) -> (f64, f64);
}

/// Function that sees every step and decides whether the run continues.
pub type Watcher<'a> = dyn FnMut(&dyn Motion) -> ControlFlow<()> + 'a;

/// Scene made ready for many runs. Clones share the scene and its caches.
#[derive(Clone, Debug)]
pub struct Model {
    scene: Arc<Scene>,
    verlet: Arc<VerletModel>,
    newmark: Arc<NewmarkModel>,
}

impl Model {
    /// Model of `scene`. The first run with a method makes the data that the method needs.
    pub fn new(scene: Scene) -> Self {
        Self { scene: Arc::new(scene), verlet: Arc::default(), newmark: Arc::default() }
    }

    /// Scene of the model.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Runs one shot; `watch` sees every step and may stop the run.
    pub fn run(
        &self,
        shot: &Shot,
        settings: &RunSettings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, RunError> {
        match settings.method {
            Method::Verlet => self.verlet.run(&self.scene, shot, settings, watch),
            Method::Newmark => self.newmark.run(&self.scene, shot, settings, watch),
        }
    }

    /// Runs one shot under a `variant` of the scene: the same tires and ties, but other masses, cable lengths, stiffnesses,
    /// strengths or friction. The run takes only these numbers from the variant, and lays out nothing anew.
    pub fn run_variant(
        &self,
        variant: &Scene,
        shot: &Shot,
        settings: &RunSettings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, RunError> {
        match settings.method {
            Method::Verlet => self.verlet.run_variant(&self.scene, variant, shot, settings, watch),
            Method::Newmark => self.newmark.run(variant, shot, settings, watch),
        }
    }

    /// Number of tires that `method` integrates for a shot. `verlet` integrates a half or a quarter of the tires if scene and shot
    /// are their own mirror image.
    pub fn modelled_tires(&self, method: Method, shot: &Shot) -> usize {
        match method {
            Method::Verlet => self.verlet.modelled_tires(&self.scene, shot),
            Method::Newmark => self.scene.tire_count(),
        }
    }
}
