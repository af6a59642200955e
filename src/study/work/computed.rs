//! Result of a study.

use crate::study::NoResult;

/// The result of a study, and whether the time sufficed.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed<T> {
    /// The result.
    pub value: T,
    /// Whether the time was up before everything was computed. `value` then comes from what was computed.
    pub partial: bool,
}

impl<T> Computed<T> {
    /// A result for which the time sufficed.
    pub fn complete(value: T) -> Self {
        Self { value, partial: false }
    }
}

/// Result of a study, or why there is none.
pub type ComputeResult<T> = Result<Computed<T>, NoResult>;
