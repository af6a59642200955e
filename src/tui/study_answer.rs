//! What a study found, in one line behind its mark: for the page of all questions.

use crate::report::brief::Brief;
use crate::tui::theme;
use crate::verdict::Verdict;

/// The answer of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyAnswer {
    /// The verdict, where the study has one.
    pub verdict: Option<Verdict>,
    /// The answer behind its mark, from the longest wording to the shortest.
    pub texts: Vec<String>,
    /// What was found in a row of shares of a limit; empty where it is no such row.
    pub shares: Vec<f64>,
}

impl StudyAnswer {
    /// The answer of a result, whose report has `concluded` this.
    pub fn new(brief: Option<Brief>, concluded: Option<Verdict>) -> Self {
        let Brief { verdict, is_warning, texts, shares } = brief.unwrap_or_default();
        let verdict = verdict.or(concluded);
        let mark = match verdict {
            Some(verdict) => theme::mark(verdict),
            None if is_warning => "!",
            None => "·",
        };
        Self { verdict, texts: texts.into_iter().map(|text| format!("{mark} {text}")).collect(), shares }
    }
}
