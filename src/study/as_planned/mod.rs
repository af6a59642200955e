//! One shot as planned.
//!
//! | what | where |
//! |---|---|
//! | the check: run ever finer until the verdict is sure | [`check`], `ladder`; one of thousands of shots: [`quick_check`]; many: [`check_many`] |
//! | greatest values of a run, with the error of its step | `peaks`, [`step_error`] |
//! | the cover over unfired holes, which no limit judges | [`cover`] |
//! | how much faster the tires may leave | [`margin`] |
//! | what a study keeps of a check | [`shot_summary`] |

pub mod check;
pub mod check_many;
pub mod cover;
mod ladder;
pub mod margin;
mod peaks;
pub mod quick_check;
pub mod shot_summary;
pub mod step_error;
