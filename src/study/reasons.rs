//! Why the verdict on an option is no pass: why it fails, or stays open. `report::reasons` has the words.

use super::as_planned::shot_reason::ShotReason;
use super::judgement::{Judgement, Sampled};
use super::samples::risk_reason::RiskReason;
use crate::verdict::Verdict;

/// Why an option does not pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The shot as planned does not pass.
    AsPlanned(ShotReason),
    /// Possible shots were asked for, and the time was up before one was run.
    NoSamples,
    /// The possible shots do not pass.
    Samples(RiskReason),
}

impl Reason {
    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(&self) -> Verdict {
        match self {
            Reason::AsPlanned(reason) => reason.verdict(),
            Reason::NoSamples => Verdict::Undecided,
            Reason::Samples(reason) => reason.verdict(),
        }
    }
}

impl Judgement {
    /// Why the verdict is no pass; empty for a pass.
    pub fn reasons(&self) -> Vec<Reason> {
        let as_planned = self.as_planned.reasons.iter().copied().map(Reason::AsPlanned);
        let of_samples = match &self.risk {
            Sampled::NotAsked => None,
            Sampled::NotDrawn => Some(Reason::NoSamples),
            Sampled::Drawn(risk) if risk.samples.is_empty() => Some(Reason::NoSamples),
            Sampled::Drawn(risk) => RiskReason::of(risk).map(Reason::Samples),
        };
        as_planned.chain(of_samples).collect()
    }
}
