//! Studies: each runs shots of a plan, as often and as finely as needed, to answer one question of the user.
//!
//! | what | where |
//! |---|---|
//! | the list of all questions; what they have in common; the input of every study | [`question`], [`study_trait`], [`Context`] |
//! | a plan made ready to run; method, accuracy and step; the state of its file | [`Case`], [`ComputeSettings`], [`FileState`] |
//! | one planned shot: its check, and why it does not pass | [`as_planned`] |
//! | sampled shots: drawn, run, counted | [`samples`] |
//! | both together: does an option pass, and may it be offered | [`judge`] |
//! | the record of observations of earlier shots, and the observations that contradict a plan | [`observed`] |
//! | what withdraws passes; whether to fire an option; its verdict word; whether a plan may take a fit | [`standing`] |
//! | places of the holes of a shot, by the tires over them | [`hole_places`] |
//! | holes and charge that fire within any 8 ms | [`eight_ms`] |
//! | one question of the user each | [`check`], [`sweep`], [`orders`], [`risk`], [`search`], [`size`], [`remedies`] |
//! | | [`effects`], [`assumptions`], [`mod@fit`], [`launch`], [`accuracy`], [`flight`], [`trace`] |
//! | several questions at once, for the blast file | [`page`] |
//! | the expected cost | [`cost`] |
//! | how work runs: on all cores, with progress | [`work`]; on many machines: [`merge`]; results on the disk: [`results_file`] |
//!
//! Three verbs: a planned shot is *checked*, shots drawn at random are *sampled*, and both together are *judged*.
//!
//! A study takes a context and returns plain data, which every interface draws. `size` makes a case of each combination of sizes,
//! and `remedies` makes a case of each change. Studies do not print and do not compute physics. Only `results_file`, in the lines
//! of `work::journal`, and `observed::record_file` read and write files of a format.

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
