//! What a study returns.

use crate::study::NoResult;

/// The result of a study, and whether the time sufficed.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed<T> {
    /// The result.
    pub value: T,
    /// Whether the time was up before all shots were judged; `value` then comes from the shots judged by then.
    pub partial: bool,
}

/// What a study returns: its result, or why there is none.
pub type ComputeResult<T> = Result<Computed<T>, NoResult>;
