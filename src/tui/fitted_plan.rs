//! The plan with the estimates of a fit, before the user has taken it.

use std::sync::Arc;

use crate::study::Case;
use crate::verdict::Verdict;

/// The plan with the estimates in it, which the user has not taken yet.
#[derive(Clone, Debug)]
pub struct FittedPlan {
    /// The plan.
    pub case: Arc<Case>,
    /// Number of observations that the estimates are from.
    pub n_observations: usize,
    /// Verdict on each option; `None` until all are judged (`n_options`).
    pub verdicts: Option<Vec<Verdict>>,
}
