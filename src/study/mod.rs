//! Judgement: what is run, how often and how finely, to answer a user's question about a plan.
//!
//! A [`Case`] is a plan made ready to run; each study takes one and returns a plain result that every view draws.
//! Nothing here prints, parses or computes physics.

pub mod accuracy;
pub mod batch;
pub mod check;
mod envelope;
pub mod error;
pub mod flight;
pub mod merge;
mod no_result;
pub mod orders;
pub mod plans;
mod progress;
pub mod scatter;
pub mod size;
pub mod sweep;
pub mod trace;

use std::path::Path;

pub use envelope::{Bounded, Envelope};
pub use no_result::{NoResult, guarded};
pub use progress::Progress;
use serde::{Deserialize, Serialize};

use crate::choice::{Accuracy, Method};
use crate::plan::{Diagnostics, Plan, PlanSource, Timing};
use crate::scene::{Scene, Shot};
use crate::simulation::Model;
use crate::verdict::Limits;

/// A plan made ready to run.
#[derive(Clone, Debug)]
pub struct Case {
    /// File and text of the plan; empty where the program made the plan.
    pub source: PlanSource,
    /// Values of the plan.
    pub plan: Plan,
    /// Its shelter, made ready.
    pub model: Model,
    /// What fires when, per delay option (`n_options`).
    pub shots: Vec<Shot>,
    /// Its limits, SI.
    pub limits: Limits,
}

impl Case {
    /// Reads, validates and builds a plan; `-` is standard input.
    pub fn load(path: &Path) -> Result<Self, Diagnostics> {
        Self::parse(PlanSource::read(path)?)
    }

    /// Validates and builds a plan from its text.
    pub fn parse(source: PlanSource) -> Result<Self, Diagnostics> {
        let plan = source.plan()?;
        Ok(Self { source, ..Self::new(plan) })
    }

    /// Builds scene, shots and limits of a plan that has no file.
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
        Self { source: PlanSource::default(), plan, model: Model::new(scene), shots, limits }
    }

    /// Title of the plan; the path of its file where the plan has no title.
    pub fn title(&self) -> &str {
        self.plan.title.as_deref().unwrap_or(&self.source.path)
    }

    /// The shot of blast rows fired in `order`, `interval` [s] apart.
    pub fn shot(&self, order: &[usize], interval: f64) -> Shot {
        let timing = Timing::Interval { order: order.to_vec(), interval_ms: interval * 1e3 };
        Shot::new(self.scene(), &self.plan.blast_rows, &timing)
    }

    /// Intervals of the delay options [s], each once.
    pub fn intervals(&self) -> Vec<f64> {
        let interval = |timing: &Timing| match timing {
            Timing::Interval { interval_ms, .. } => Some(interval_ms * 1e-3),
            Timing::At(_) => None,
        };
        let mut all: Vec<f64> = self.plan.delays.iter().filter_map(|delay| interval(&delay.timing)).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComputeSettings {
    /// Which method.
    pub method: Method,
    /// Where refinement starts.
    pub accuracy: Accuracy,
    /// Exactly this step, never refined [s].
    pub step: Option<f64>,
}

impl ComputeSettings {
    /// As the plan asks.
    pub fn of(plan: &Plan) -> Self {
        Self { method: plan.simulation.method, accuracy: plan.simulation.accuracy, step: None }
    }

    /// After one plan took the place of another: what was as the old one asks is as the new one asks.
    pub fn follow(&mut self, old: &Plan, new: &Plan) {
        let (old, new) = (Self::of(old), Self::of(new));
        if self.method == old.method {
            self.method = new.method;
        }
        if self.accuracy == old.accuracy {
            self.accuracy = new.accuracy;
        }
    }
}

/// Intervals between rows to try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intervals {
    /// First [s].
    pub from: f64,
    /// Last [s].
    pub to: f64,
    /// Apart [s].
    pub step: f64,
}

impl Intervals {
    /// Each of them [s].
    pub fn values(&self) -> Vec<f64> {
        let count = ((self.to - self.from) / self.step + 1e-9).floor() as usize;
        (0..=count).map(|n| self.from + n as f64 * self.step).collect()
    }
}

/// One of several machines' share of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Which, from 0.
    pub index: usize,
    /// Of how many.
    pub of: usize,
}

impl Shard {
    /// All the work.
    pub const WHOLE: Shard = Shard { index: 0, of: 1 };

    /// Whether a piece of work falls to it.
    pub fn has(self, number: usize) -> bool {
        number % self.of == self.index
    }
}
