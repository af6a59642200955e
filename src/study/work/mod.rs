//! How the work of a study runs.
//!
//! | what | where |
//! |---|---|
//! | jobs on all cores | [`batch`] |
//! | results that survive the end of the program | [`journal`] |
//! | progress of a study | [`progress`] |
//! | how a study is stopped | `study_control` |
//! | a result, whole or partial; why there is none | `computed`, `no_result` |
//! | intervals to try | `intervals` |
//! | the part of a study that one machine computes | `shard` |
//!
//! When the time is up, each level has its own result:
//!
//! | level | result |
//! |---|---|
//! | a run | `RunError::Stopped`, and by [`StudyControl::no_result`] `NoResult::OutOfTime` |
//! | a job of a batch | `None` in the place of its result ([`batch::run_batch`]) |
//! | an option, a combination, a change | a result that says so: `NoResult::OutOfTime`, `Untried::OutOfTime`, `TriedKind::out_of_time` |
//! | a study | [`Computed::partial`], with what was found by then; `NoResult::OutOfTime` if nothing was |

pub mod batch;
mod computed;
mod intervals;
pub mod journal;
mod no_result;
pub mod progress;
mod shard;
pub mod study_control;

pub use batch::thread_pool;
pub use computed::{ComputeResult, Computed};
pub use intervals::Intervals;
pub use journal::{Fingerprint, Journal};
pub use no_result::{NoResult, catch_panic};
pub use shard::Shard;
pub use study_control::StudyControl;
