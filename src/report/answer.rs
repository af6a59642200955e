//! What was found → report: the one place that words an answer.

use super::parts::Report;
use crate::study::Case;
use crate::study::question::{Found, with_questions};

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, $report:ident::$answer:ident), )+) => {
        /// The report of what was found of a plan, as the question [takes it](crate::study::question::Question::case).
        pub fn answer(case: &Case, found: &Found) -> Report {
            match found { $( Found::$Name(found) => super::$report::$answer(case, found), )+ }
        }
    };
}
with_questions!(declare_answer);
