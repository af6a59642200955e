//! What a study returns.

use crate::study::NoResult;

/// The result of a study, and whether the time sufficed.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed<T> {
    /// The result.
    pub value: T,
    /// Whether the time was up before all was computed; `value` then comes from what was.
    pub partial: bool,
}

impl<T> Computed<T> {
    /// A result for which the time sufficed.
    pub fn complete(value: T) -> Self {
        Self { value, partial: false }
    }
}

/// What a study returns: its result, or why there is none.
pub type ComputeResult<T> = Result<Computed<T>, NoResult>;
