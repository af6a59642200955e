//! Time histories of chosen tires and cables of one option.

use std::ops::ControlFlow;

use super::Case;
use crate::outcome::Outcome;
use crate::simulation::{Motion, RunError, RunSettings};

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

/// Runs one option and hands a row to `emit` every `every` seconds.
///
/// A row is the time [s], then per tire x, y, height [m], friction and its limit μR [N], then per cable its force [N].
pub fn trace(
    case: &Case,
    option: usize,
    settings: &RunSettings,
    chosen: &TracedItems,
    every: f64,
    emit: &mut dyn FnMut(&[f64]) -> ControlFlow<()>,
) -> Result<Outcome, RunError> {
    let mut row = Vec::with_capacity(1 + 5 * chosen.tires.len() + chosen.cables.len());
    let mut next = 0.0;
    case.model.run(&case.shots[option], settings, &mut |motion| {
        let now = motion.time();
        // The nearest step counts: a row may be up to half a step early.
        if now + 0.5 * settings.step < next {
            return ControlFlow::Continue(());
        }
        next = ((now + 0.5 * settings.step) / every).floor() * every + every;
        fill(&mut row, case, chosen, motion);
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
