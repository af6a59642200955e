//! Why the verdict on an option is no pass: why it fails, or stays open. `report::words::reasons` has the words.

use crate::study::as_planned::shot_reason::ShotReason;
use crate::study::samples::risk_reason::RiskReason;
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
    /// The plan asks for an option that withstands one dud, and this one does not, or it is not known.
    OneDud(Verdict),
    /// The possible shots pass, and fresh draws do not confirm it.
    NotConfirmed {
        /// Number of fresh draws that fail.
        failures: usize,
        /// Number of fresh draws.
        samples: usize,
    },
    /// The possible shots pass, and fresh draws are still to confirm it.
    AwaitsConfirmation,
}

impl Reason {
    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(&self) -> Verdict {
        match self {
            Reason::AsPlanned(reason) => reason.verdict(),
            Reason::NoSamples | Reason::NotConfirmed { .. } | Reason::AwaitsConfirmation => {
                Verdict::Undecided
            }
            Reason::Samples(reason) => reason.verdict(),
            Reason::OneDud(verdict) => *verdict,
        }
    }
}
