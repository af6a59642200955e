//! Studies: which shots of a plan are run, how often and how finely, to answer one question of the user.
//!
//! | what | where |
//! |---|---|
//! | all that a user can ask, one list; the settings of a question, which answer it; what every study is handed | [`question`], [`study_trait`], [`Context`] |
//! | a plan made ready to run; method, accuracy and step; what became of its file | [`Case`], [`ComputeSettings`], [`FileState`] |
//! | one shot as planned: checked, and what speaks against it | [`as_planned`] |
//! | the shots that are possible: drawn, run, counted | [`samples`] |
//! | both together: does an option pass, and may it be offered | [`judge`] |
//! | the record of observations of earlier shots, and which observations contradict a plan | [`observed`] |
//! | what takes passes of a plan back, and whether an option may be fired; the word of its verdict; whether a plan may take what a fit found | [`standing`] |
//! | where the holes of a shot lie, by the tires over them | [`hole_places`] |
//! | what fires within any 8 ms | [`eight_ms`] |
//! | the questions of the user, one each | [`check`], [`sweep`], [`orders`], [`risk`], [`search`], [`size`], [`remedies`], [`effects`], [`assumptions`], [`mod@fit`], [`launch`], [`accuracy`], [`flight`], [`trace`] |
//! | several of them at once, for the blast file | [`page`] |
//! | what it will cost | [`cost`] |
//! | how work runs: on all cores, with progress, to be stopped | [`work`]; on many machines: [`merge`]; results on the disk: [`results_file`] |
//!
//! Three verbs: a shot as planned is *checked*, possible shots are *sampled*, and both together are *judged*.
//!
//! A study takes a context and returns plain data, which every face draws; `size` makes a case of each combination of sizes, `remedies` one
//! of each change.
//! Studies do not print and do not compute physics. Only `results_file` reads and writes files of a format, in the
//! lines of `work::journal`, and `observed::record_file`.

pub mod accuracy;
pub mod as_planned;
pub mod assumptions;
mod case;
pub mod check;
mod compute_settings;
mod context;
pub mod cost;
pub mod course_band;
pub mod effects;
pub mod eight_ms;
pub mod fit;
pub mod flight;
pub mod hole_places;
pub mod judge;
pub mod launch;
pub mod merge;
pub mod observed;
pub mod orders;
pub mod page;
pub mod question;
pub mod remedies;
pub mod results_file;
pub mod risk;
pub mod samples;
pub mod search;
pub mod size;
pub mod standing;
pub mod study_trait;
pub mod sweep;
pub mod trace;
pub mod work;

pub use as_planned::shot_summary::{ShotSummary, ValueWithError};
pub use case::Case;
pub use compute_settings::ComputeSettings;
pub use context::Context;
pub use standing::plan_file::FileState;
pub use work::{
    ComputeResult, Computed, Fingerprint, Intervals, Journal, NoResult, Shard, StudyControl, catch_panic,
    thread_pool,
};
