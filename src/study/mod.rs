//! Judgement: what is run, how often and how finely, to answer a user's question about a plan.
//!
//! A [`Case`] is a plan made ready to run; each study takes one and returns a plain result that every view draws.
//! Nothing here prints, parses or computes physics.

pub mod accuracy;
pub mod check;
pub mod error;
pub mod trace;

use crate::plan::{Accuracy, Method, Plan};
use crate::scene::{Scene, Shot};
use crate::simulation::Model;
use crate::verdict::Limits;

/// A plan made ready to run.
#[derive(Clone, Debug)]
pub struct Case {
    /// As loaded.
    pub plan: Plan,
    /// Its shelter, made ready.
    pub model: Model,
    /// What fires when, per delay option (`n_options`).
    pub shots: Vec<Shot>,
    /// Its limits, SI.
    pub limits: Limits,
}

impl Case {
    /// Builds scene, shots and limits of a plan.
    pub fn new(plan: Plan) -> Self {
        let scene = Scene::build(&plan);
        let shots =
            plan.delays.iter().map(|delay| Shot::new(&scene, &plan.blast_rows, &delay.timing)).collect();
        let breaking_force = plan.cable.breaking_force_kn * 1e3;
        let limits = Limits {
            height: plan.limits.flight_height_m,
            force: breaking_force / plan.limits.cable_safety_factor,
            drift: plan.limits.drift_m,
            breaking_force,
        };
        Self { plan, model: Model::new(scene), shots, limits }
    }
}

impl Case {
    /// Its shelter.
    pub fn scene(&self) -> &Scene {
        self.model.scene()
    }

    /// Tires that `method` integrates, the most of any option: fewer than all where mirror planes halve the shelter.
    pub fn modelled_tires(&self, method: Method) -> usize {
        self.shots.iter().map(|shot| self.model.modelled_tires(method, shot)).max().unwrap_or(0)
    }
}

/// How finely to compute; from the plan, with what the command line overrides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Which method.
    pub method: Method,
    /// Where refinement starts.
    pub accuracy: Accuracy,
    /// Exactly this step, never refined [s].
    pub step: Option<f64>,
}

impl Effort {
    /// As the plan asks.
    pub fn of(plan: &Plan) -> Self {
        Self { method: plan.simulation.method, accuracy: plan.simulation.accuracy, step: None }
    }
}
