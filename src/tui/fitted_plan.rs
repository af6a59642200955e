//! The plan with the estimates of a fit, before the user has taken them.

use std::sync::Arc;

use crate::study::Case;
use crate::verdict::Verdict;

/// The plan with the estimates of a fit. The user has not taken them yet.
#[derive(Clone, Debug)]
pub struct FittedPlan {
    /// The plan with the estimates.
    pub case: Arc<Case>,
    /// Number of observations behind the estimates.
    pub n_observations: usize,
    /// Verdict on each option with the estimates; `None` until all are judged (`n_options`).
    pub verdicts: Option<Vec<Verdict>>,
}
