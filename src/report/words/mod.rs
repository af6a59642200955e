//! Words of reports, the same in every face.
//!
//! | words of | where |
//! |---|---|
//! | a plan: its limits, and what it adds to the model of the source paper | [`limits`], [`plan_notes`] |
//! | one delay option: its peaks, margins and what decides it | [`option_sentences`] |
//! | a verdict: why it is no pass | [`reasons`] |
//! | observations that speak against all verdicts | [`objections`] |
//! | what a PASS stands on | [`assumption_words`] |
//! | a missing result: why | [`no_result`] |
//! | the answer in one line | [`headline`] |
//! | the progress of a study | [`progress_words`] |
//! | what to film next, and how | [`advice`] |
//! | warnings beside a verdict | [`warnings`], of a plan [`plan_warnings`] |
//! | assumed values, and lines to confirm before the shot | [`to_be_confirmed`] |
//! | a false name of an option | `false_names` |
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
