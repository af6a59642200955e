//! The answer of a study in one line, for a list of all questions.

use crate::verdict::Verdict;

/// The answer of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Brief {
    /// The verdict, where the study has one.
    pub verdict: Option<Verdict>,
    /// Whether the answer speaks against the plan, without a verdict.
    pub is_warning: bool,
    /// The answer, from the longest wording to the shortest.
    pub texts: Vec<String>,
    /// Shares of a limit along the results, for a sparkline; empty where the results have no such order.
    pub shares: Vec<f64>,
}

impl Brief {
    /// An answer with a verdict.
    pub fn judged(verdict: Verdict, texts: Vec<String>) -> Self {
        Self { verdict: Some(verdict), texts, ..Self::default() }
    }

    /// The same answer with a row of shares of a limit.
    pub fn drawn_as(self, shares: Vec<f64>) -> Self {
        Self { shares, ..self }
    }
}
