//! What a launch velocity that nobody observed does to a verdict: no shot passes on it.
//!
//! Bounds of a blast plan leave the velocity open by a factor of two or three. However few samples fail, what they were drawn from is
//! no observation. So a verdict on an estimated launch is at most OPEN, as planned and sampled, in every study.
//! `Uncertainty::launch_is_estimated` tells such plans.

use super::Case;
use crate::verdict::Verdict;

/// The verdict that the launches allow: no pass where they are an estimate.
pub fn verdict_with_launch(verdict: Verdict, launch_is_estimated: bool) -> Verdict {
    if launch_is_estimated { verdict.max(Verdict::Undecided) } else { verdict }
}

/// Whether a shot of a plan may pass at all: where only shots as planned are asked for, nothing else says that the launch is an
/// estimate.
pub fn passes_with_launch(case: &Case) -> bool {
    verdict_with_launch(Verdict::Pass, case.plan.uncertainty.launch_is_estimated()) == Verdict::Pass
}
