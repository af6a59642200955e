//! Time histories of chosen tires and cables of one option, for its planned shot or a sample.

use std::borrow::Cow;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::samples::random_shot::DrawnShot;
use super::samples::run_sample::{ShotToSample, sample_settings, sample_step, worst_drawn};
use super::samples::sample_count::Sampling;
use super::{Case, ComputeSettings};
use crate::outcome::Outcome;
use crate::scene::{Scene, Shot};
use crate::simulation::{Motion, RunError, RunSettings, Watcher};

/// Tires and cables to record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TracedItems {
    /// Indices of tires.
    pub tires: Vec<usize>,
    /// Indices of cables.
    pub cables: Vec<usize>,
}

impl TracedItems {
    /// The highest tire and the most loaded cable of a run.
    pub fn of(outcome: &Outcome) -> Self {
        let cables = if outcome.force.value > 0.0 { vec![outcome.force.index] } else { Vec::new() };
        Self { tires: vec![outcome.height.index], cables }
    }
}

/// A shot to trace.
#[derive(Clone, Debug)]
pub struct TracedShot<'c> {
    case: &'c Case,
    shot: Cow<'c, Shot>,
    /// The scene of a sample; `None` for the planned shot.
    variant: Option<Scene>,
    /// Method, step and end of the run.
    pub settings: RunSettings,
}

/// A sample of an option, as a check draws and runs it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DrawnSample {
    /// Seed of the draws.
    pub seed: u64,
    /// Number of the sample, from 0.
    pub number: usize,
    /// Number of times that the step of samples was halved, because finer runs contradicted the samples.
    pub step_halvings: u32,
}

impl<'c> TracedShot<'c> {
    /// A sample of an option at the step of samples. Without a sample, the planned shot at the first step of a check.
    ///
    /// # Panics
    ///
    /// If the plan has no delay option with the index `option`.
    pub fn new(
        case: &'c Case,
        option: usize,
        compute: &ComputeSettings,
        sample: Option<DrawnSample>,
    ) -> Self {
        let planned = &case.shots[option];
        let Some(DrawnSample { seed, number, step_halvings }) = sample else {
            let settings = case.run_settings(compute.method, compute.first_step(case));
            return Self { case, shot: Cow::Borrowed(planned), variant: None, settings };
        };
        let target = ShotToSample::new(case, planned, *compute, Sampling::exactly(1, seed));
        let DrawnShot { scene, shot, later, .. } = worst_drawn(&target, number, step_halvings);
        let step = sample_step(compute, &scene) * 0.5_f64.powi(step_halvings as i32);
        let settings = sample_settings(case, compute, step, later);
        Self { case, shot: Cow::Owned(shot), variant: Some(scene), settings }
    }

    /// What fires when.
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    /// The shelter of the plan, or of the sample.
    pub fn scene(&self) -> &Scene {
        self.variant.as_ref().unwrap_or(self.case.scene())
    }

    /// Runs the shot; `watch` sees every step and may stop the run.
    pub fn run(&self, watch: &mut Watcher<'_>) -> Result<Outcome, RunError> {
        let model = &self.case.model;
        match &self.variant {
            Some(scene) => model.run_variant(scene, &self.shot, &self.settings, watch),
            None => model.run(&self.shot, &self.settings, watch),
        }
    }
}

/// Runs a shot and hands a row to `emit` every `every` seconds.
///
/// A row is the time [s], then per tire x, y, height [m], friction and its limit μR [N], then per cable its force [N].
pub fn trace(
    shot: &TracedShot<'_>,
    chosen: &TracedItems,
    every: f64,
    emit: &mut dyn FnMut(&[f64]) -> ControlFlow<()>,
) -> Result<Outcome, RunError> {
    let mut row = Vec::with_capacity(1 + 5 * chosen.tires.len() + chosen.cables.len());
    let (mut next, step) = (0.0, shot.settings.step);
    shot.run(&mut |motion| {
        let now = motion.time();
        // The nearest step counts: a row may be up to half a step early.
        if now + 0.5 * step < next {
            return ControlFlow::Continue(());
        }
        next = ((now + 0.5 * step) / every).floor() * every + every;
        fill(&mut row, shot.case, chosen, motion);
        emit(&row)
    })
}

fn fill(row: &mut Vec<f64>, case: &Case, chosen: &TracedItems, motion: &dyn Motion) {
    row.clear();
    row.push(motion.time());
    for &tire in &chosen.tires {
        let u = motion.displacement(tire);
        let position = case.scene().position[tire] + u;
        let (friction, limit) = motion.friction(tire);
        row.extend([position.x, position.y, u.z, friction, limit]);
    }
    row.extend(chosen.cables.iter().map(|&cable| motion.force(cable)));
}
