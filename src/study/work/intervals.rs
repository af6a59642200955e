//! The intervals that a sweep or a ranking of orders is asked for.

use serde::{Deserialize, Serialize};

use crate::plan::Time;

/// Evenly spaced intervals between rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intervals {
    /// First interval.
    pub from: Time,
    /// Last interval.
    pub to: Time,
    /// Distance between neighbours, more than 0.
    pub step: Time,
}

impl Intervals {
    /// All intervals.
    pub fn values(&self) -> Vec<Time> {
        let count = (self.to - self.from).steps(self.step);
        (0..=count).map(|n| self.from + self.step * n).collect()
    }
}
