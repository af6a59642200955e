//! How the work of a study runs.
//!
//! | what | where |
//! |---|---|
//! | jobs on all cores | [`batch`] |
//! | results that survive the end of the program | [`journal`] |
//! | how far it is, and how it is stopped | `study_control` |
//! | a result, whole or partial; why there is none | `computed`, `no_result` |
//! | intervals to be tried | `intervals` |
//! | the part of a study that one machine computes | `shard` |

pub mod batch;
mod computed;
mod intervals;
pub mod journal;
mod no_result;
mod shard;
mod study_control;

pub use batch::thread_pool;
pub use computed::{ComputeResult, Computed};
pub use intervals::Intervals;
pub use journal::{Fingerprint, Journal};
pub use no_result::{NoResult, catch_panic};
pub use shard::Shard;
pub use study_control::StudyControl;
