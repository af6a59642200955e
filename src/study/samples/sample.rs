//! One sample of a shot, and what its run comes to.

use serde::{Deserialize, Serialize};

use super::random_shot::Input;
use crate::outcome::{Outcome, Peak};
use crate::scene::Shot;
use crate::study::Case;
use crate::study::as_planned::cover::Cover;
use crate::study::as_planned::shot_reason::{ShotReason, energy_balance_closes, find_reasons};
use crate::study::as_planned::shot_summary::or_infinite;
use crate::verdict::{Estimate, Limits, PerQuantity, Quantity, Verdict};

/// One sample of a shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number of the sample, from 0.
    pub number: usize,
    /// Its run at the step of samples; at a finer one where that run fails or loses energy.
    pub run: SampleRun,
    /// A run at a still finer step, for a sample of the audit.
    pub finer: Option<SampleRun>,
    /// Values of the inputs in [`Input::ALL`].
    pub inputs: [f64; Input::ALL.len()],
}

impl Sample {
    /// Its run at the finest step.
    pub fn finest(&self) -> &SampleRun {
        self.finer.as_ref().unwrap_or(&self.run)
    }
}

/// A sample at one step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleRun {
    /// Whether it keeps every limit; undecided where the run ends too early, fails, loses energy, or a hole fires under no tire.
    pub verdict: Verdict,
    /// How near a hole comes to firing under no tire, as [`Cover::uncovering`] says.
    #[serde(default)]
    pub uncovering: f64,
    /// Fail where a cable breaks; undecided where the verdict is, or where the run ends before one broke.
    pub breaks: Verdict,
    /// Greatest flight height [m].
    #[serde(deserialize_with = "or_infinite")]
    pub height: f64,
    /// Greatest cable force, of a cable of the plan's breaking force [N].
    #[serde(deserialize_with = "or_infinite")]
    pub force: f64,
    /// Index of the cable of the greatest force.
    pub cable: usize,
    /// Greatest drift at the end [m].
    #[serde(deserialize_with = "or_infinite")]
    pub drift: f64,
}

impl SampleRun {
    /// A run that failed.
    pub const FAILED_RUN: Self = Self {
        verdict: Verdict::Undecided,
        uncovering: 0.0,
        breaks: Verdict::Undecided,
        height: f64::INFINITY,
        force: f64::INFINITY,
        cable: 0,
        drift: f64::INFINITY,
    };

    /// Judges a run that saw this cover over its holes; one without energy balance shows nothing.
    pub fn new(case: &Case, shot: &Shot, outcome: &Outcome, cover: &Cover) -> Self {
        let exact = |Peak { value, time, index }| Estimate { value, error: 0.0, time, index };
        let Outcome { height, force, drift, .. } = *outcome;
        let estimates = PerQuantity { height: exact(height), force: exact(force), drift: exact(drift) };
        let reasons = find_reasons(case, shot, outcome, &estimates, 1.0);
        let verdict = match energy_balance_closes(outcome.ledger.residual()) {
            true => cover.verdict(Verdict::worst(reasons.iter().map(ShotReason::verdict))),
            false => Verdict::Undecided,
        };
        let broke = !outcome.broken.is_empty() || outcome.force.value > case.limits.breaking_force;
        let ends_early = reasons.iter().any(|reason| matches!(reason, ShotReason::EndsEarly { .. }));
        let breaks = match verdict {
            Verdict::Undecided => Verdict::Undecided,
            _ if broke => Verdict::Fail,
            _ if ends_early => Verdict::Undecided,
            _ => Verdict::Pass,
        };
        let [height, drift] = [height.value, drift.value];
        let uncovering = cover.uncovering;
        Self { verdict, uncovering, breaks, height, force: force.value, cable: force.index, drift }
    }

    /// Whether a hole fires over which no tire lies then: the model gives its launch to the nearest one, and knows nothing of the rock.
    pub fn is_uncovered(&self) -> bool {
        self.uncovering > 1.0
    }

    /// Greatest share of a limit that the run uses.
    pub fn utilization(&self, limits: &Limits) -> f64 {
        limits.utilization(|quantity| self.get(quantity))
    }

    /// The value of a quantity [its SI unit].
    pub fn get(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Height => self.height,
            Quantity::Force => self.force,
            Quantity::Drift => self.drift,
        }
    }
}
