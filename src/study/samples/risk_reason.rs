//! Why the possible shots fail too often or leave a verdict open.

use super::risk::Risk;
use crate::verdict::Verdict;

/// Why the samples of a shot do not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RiskReason {
    /// Surely more of the possible shots fail than the plan accepts.
    TooManyFail,
    /// The shot as planned, computed more finely, lies above all samples: their step is too long for the motion.
    PlannedExceedsSamples,
    /// Finer runs contradict the samples.
    Contradicted,
    /// The samples pass, but too few of them are run at a finer step, too.
    FewAudited,
    /// Some samples stay undecided, and could be the failures that are too many.
    UndecidedSamples,
    /// So many fail that it is not sure whether more fail than the plan accepts.
    NotSure,
}

impl RiskReason {
    /// Why samples do not pass; `None` where they do.
    pub fn of(risk: &Risk) -> Option<Self> {
        match risk.verdict() {
            Verdict::Pass => None,
            Verdict::Fail => Some(RiskReason::TooManyFail),
            Verdict::Undecided => Some(match risk {
                _ if risk.planned_exceeds_samples() => RiskReason::PlannedExceedsSamples,
                _ if risk.is_contradicted() => RiskReason::Contradicted,
                _ if risk.bounds.verdict() == Verdict::Pass => RiskReason::FewAudited,
                _ if risk.bounds.undecided > 0 => RiskReason::UndecidedSamples,
                _ => RiskReason::NotSure,
            }),
        }
    }

    /// The verdict that this reason leads to: fail or undecided.
    pub fn verdict(self) -> Verdict {
        if self == RiskReason::TooManyFail { Verdict::Fail } else { Verdict::Undecided }
    }
}
