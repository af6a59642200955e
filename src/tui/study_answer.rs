//! The answer of a study in one line behind its mark, for the list of questions.

use crate::report::brief::Brief;
use crate::tui::theme;
use crate::verdict::{Verdict, VerdictWord};

/// The answer of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyAnswer {
    /// The verdict, if the study has one.
    pub verdict: Option<VerdictWord>,
    /// The answer behind its mark: several wordings, longest first.
    pub texts: Vec<String>,
    /// Shares of a limit for a sparkline; empty if the study has none.
    pub shares: Vec<f64>,
}

impl StudyAnswer {
    /// The answer from the `brief` of a result. `concluded` is the verdict of the report.
    pub fn new(brief: Option<Brief>, concluded: Option<VerdictWord>) -> Self {
        let Brief { verdict, is_warning, texts, shares } = brief.unwrap_or_default();
        // If the report calls a pass thin, the answer calls it thin, too.
        let is_thin = verdict == Some(Verdict::Pass) && concluded == Some(VerdictWord::Thin);
        let verdict = verdict.map(VerdictWord::from).filter(|_| !is_thin).or(concluded);
        let mark = match verdict {
            Some(verdict) => theme::mark(verdict),
            None if is_warning => "!",
            None => "·",
        };
        Self { verdict, texts: texts.into_iter().map(|text| format!("{mark} {text}")).collect(), shares }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_pass_has_the_mark_of_one() {
        let mark = |verdict, concluded| {
            let brief = Brief::judged(verdict, vec!["42 ms".to_owned()]);
            StudyAnswer::new(Some(brief), concluded).verdict
        };
        assert_eq!(mark(Verdict::Pass, Some(VerdictWord::Thin)), Some(VerdictWord::Thin));
        assert_eq!(mark(Verdict::Pass, Some(VerdictWord::Fail)), Some(VerdictWord::Pass));
        assert_eq!(mark(Verdict::Fail, Some(VerdictWord::Thin)), Some(VerdictWord::Fail));
        assert_eq!(mark(Verdict::Undecided, None), Some(VerdictWord::Open));
    }
}
