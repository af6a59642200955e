//! Why an option or a study has no result.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::simulation::RunError;

/// Why an option or a study has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoResult {
    /// A run failed by itself. For a run that was ended, [`StudyControl::no_result`](super::StudyControl::no_result) gives the reason.
    #[error(transparent)]
    Failed(RunError),
    /// The user or a signal ended the study.
    #[error("interrupted before there was a result")]
    Stopped,
    /// The time was up.
    #[error("not computed: ended early")]
    OutOfTime,
    /// The program panicked with this text.
    #[error("internal error: {0}")]
    Panicked(String),
    /// The system refused threads to compute on.
    #[error("no threads to compute on: {0}")]
    NoThreads(String),
    /// A plan of one blast row has no interval to sweep.
    #[error("a single blast row has no interval to sweep")]
    SingleRow,
    /// The options of the plan have firing times of their own, so there is no interval at which to try orders.
    #[error("no delay option has an interval")]
    NoInterval,
    /// The options differ in how the holes of a row fire. So a study of other intervals or orders cannot choose.
    #[error("the delay options differ in hole_interval_ms or hole_order: which of them is meant?")]
    HolesDiffer,
    /// Machines cannot share the question.
    #[error("{0}")]
    NotShared(String),
}

/// Does one piece of work. A panic becomes [`NoResult::Panicked`], so that other work goes on.
pub fn catch_panic<T>(work: impl FnOnce() -> Result<T, NoResult>) -> Result<T, NoResult> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let message = panic.downcast_ref::<String>().map(String::as_str);
        let message = message.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("unknown cause");
        Err(NoResult::Panicked(message.to_owned()))
    })
}
