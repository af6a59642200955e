//! The intervals that a sweep or a ranking of orders is asked for.

use serde::{Deserialize, Serialize};

/// Evenly spaced intervals between rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intervals {
    /// First interval [s].
    pub from: f64,
    /// Last interval [s].
    pub to: f64,
    /// Distance between neighbours [s].
    pub step: f64,
}

impl Intervals {
    /// All intervals [s].
    pub fn values(&self) -> Vec<f64> {
        let count = ((self.to - self.from) / self.step + 1e-9).floor() as usize;
        (0..=count).map(|n| self.from + n as f64 * self.step).collect()
    }
}
