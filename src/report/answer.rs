//! What was found → report: the one place that words an answer.

use super::parts::Report;
use super::{
    accuracy, assumptions, check, effects, fit, flight, orders, remedies, risk, search, size, sweep,
};
use crate::study::Case;
use crate::study::question::{Found, with_questions};

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, $report:ident::$answer:ident), )+) => {
        /// The report of what was found of a plan, as the question [takes it](crate::study::question::Question::case).
        pub fn answer(case: &Case, found: &Found) -> Report {
            match found { $( Found::$Name(found) => $report::$answer(case, found), )+ }
        }
    };
}
with_questions!(declare_answer);
