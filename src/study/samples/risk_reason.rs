//! Why the sampled shots fail too often or leave a verdict open. [`SampledShot::reason`] finds the reason.
//!
//! [`SampledShot::reason`]: crate::study::samples::sampled_shot::SampledShot::reason

use crate::verdict::Verdict;

/// Why the samples of a shot do not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RiskReason {
    /// Surely more of the sampled shots fail than the plan accepts.
    TooManyFail,
    /// The planned shot, computed more finely, exceeds all samples: the step of the samples is too long for the motion.
    PlannedExceedsSamples,
    /// Finer runs contradict the samples.
    FinerRunsDisagree,
    /// The samples pass, but too few of them also ran at a finer step.
    FewAudited,
    /// The samples pass, but they were drawn about an estimated launch velocity that nobody observed.
    LaunchEstimated,
    /// Some samples stay undecided. They could be the failures that are too many.
    UndecidedSamples,
    /// The bounds include the accepted share: it is not sure whether more shots fail than the plan accepts.
    NotSure,
}

impl RiskReason {
    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(self) -> Verdict {
        if self == RiskReason::TooManyFail { Verdict::Fail } else { Verdict::Undecided }
    }
}
