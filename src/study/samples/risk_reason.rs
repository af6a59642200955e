//! Why the possible shots fail too often or leave a verdict open; [`SampledShot::reason`] finds which it is.
//!
//! [`SampledShot::reason`]: crate::study::samples::sampled_shot::SampledShot::reason

use crate::verdict::Verdict;

/// Why the samples of a shot do not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RiskReason {
    /// Surely more of the possible shots fail than the plan accepts.
    TooManyFail,
    /// The shot as planned, computed more finely, lies above all samples: their step is too long for the motion.
    PlannedExceedsSamples,
    /// Finer runs contradict the samples.
    FinerRunsDisagree,
    /// The samples pass, but too few of them are run at a finer step, too.
    FewAudited,
    /// They pass, and the launch velocity that they were drawn about is an estimate that nobody observed.
    LaunchEstimated,
    /// Some samples stay undecided, and could be the failures that are too many.
    UndecidedSamples,
    /// The bounds hold the accepted share: it is not sure whether more fail than the plan accepts.
    NotSure,
}

impl RiskReason {
    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(self) -> Verdict {
        if self == RiskReason::TooManyFail { Verdict::Fail } else { Verdict::Undecided }
    }
}
