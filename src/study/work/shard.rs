//! The part of a study that one machine computes.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_of_work_belongs_to_one_shard() {
        let owners = |number: usize| -> Vec<usize> {
            (0..3).filter(|&index| Shard { index, count: 3 }.has(number)).collect()
        };
        let of_all: Vec<Vec<usize>> = (0..7).map(owners).collect();
        assert_eq!(of_all, [0, 1, 2, 0, 1, 2, 0].map(|owner| vec![owner]));
        assert!((0..7).all(|number| Shard::WHOLE.has(number)));
    }
}
