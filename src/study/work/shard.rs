//! Which part of a study one machine computes.

use serde::{Deserialize, Serialize};

/// The shard of one machine in a study spread over several machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Number of the shard, from 0.
    pub index: usize,
    /// Number of shards.
    pub count: usize,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    /// Whether the shard holds piece `number` of the work.
    pub fn has(self, number: usize) -> bool {
        number % self.count == self.index
    }
}
