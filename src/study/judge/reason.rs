//! Why the verdict on an option is no pass: the option fails or stays open. `report::words::reasons` has the words.

use crate::study::as_planned::shot_reason::ShotReason;
use crate::study::samples::risk_reason::RiskReason;
use crate::verdict::Verdict;

/// Why an option does not pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// The planned shot does not pass.
    AsPlanned(ShotReason),
    /// Samples were asked for, but the time was up before the first one.
    NoSamples,
    /// The samples do not pass.
    Samples(RiskReason),
    /// The plan asks for an option that withstands one dud. This option does not, or it is not known.
    OneDud(Verdict),
    /// The samples pass, but fresh draws do not confirm that.
    NotConfirmed {
        /// Number of fresh draws that fail.
        failures: usize,
        /// Number of fresh draws.
        samples: usize,
    },
    /// The samples pass, and fresh draws are still to confirm that.
    AwaitsConfirmation,
}

impl Reason {
    /// The verdict of this reason: fail or undecided.
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
