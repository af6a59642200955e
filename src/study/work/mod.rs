//! How the work of a study runs.
//!
//! | what | where |
//! |---|---|
//! | jobs on all cores | [`batch`] |
//! | method, accuracy and step that were asked for | `compute` |
//! | how far it is, and how it is stopped | `progress` |
//! | a result, whole or partial; why there is none | `found`, `no_result` |
//! | intervals to be tried | `intervals` |
//! | shares of a study on several machines, and how they become one | `shard`, [`merge`] |

pub mod batch;
mod compute;
mod found;
mod intervals;
pub mod merge;
mod no_result;
mod progress;
mod shard;

pub use batch::thread_pool;
pub use compute::ComputeSettings;
pub(super) use compute::step_factor;
pub use found::{Finding, Found};
pub use intervals::Intervals;
pub use no_result::{NoResult, guarded};
pub use progress::Progress;
pub use shard::Shard;
