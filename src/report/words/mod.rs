//! What reports say, the same in every face.
//!
//! | words of | where |
//! |---|---|
//! | a plan: its limits, and what it adds to the model of the source paper | [`limits`], [`plan_notes`] |
//! | one delay option: its peaks, margins and what decides it | [`option_sentences`] |
//! | a verdict that is no pass: why | [`reasons`] |
//! | what was seen that speaks against all verdicts | [`objections`] |
//! | what a PASS stands on | [`assumption_words`] |
//! | a result that does not come | [`no_result`] |
//! | the answer in one line | [`headline`] |
//! | how far a study is | [`progress_words`] |
//! | what to film next, and how | [`advice`] |
//! | what a reader must know beside a verdict | [`warnings`], of a plan [`plan_warnings`] |
//! | what is assumed, and confirmed before the shot | [`to_be_confirmed`] |
//! | a name of an option that says what is not so | `false_names` |
//! | a cell, a column, an axis | `cell_words` |

pub mod advice;
pub mod assumption_words;
mod cell_words;
pub mod drawn_shot;
mod false_names;
pub mod headline;
pub mod limits;
pub mod no_result;
pub mod objections;
pub mod option_sentences;
pub mod plan_notes;
pub mod plan_warnings;
pub mod progress_words;
pub mod reasons;
pub mod to_be_confirmed;
pub mod warnings;

/// `1 shot`, `2 shots`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
