//! The intervals of a sweep or of a ranking of orders.

use serde::{Deserialize, Serialize};

use crate::plan::Time;

/// Evenly spaced intervals between rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intervals {
    /// First interval.
    pub from: Time,
    /// Last interval.
    pub to: Time,
    /// Distance between neighboring intervals, more than 0.
    pub step: Time,
}

impl Intervals {
    /// All intervals.
    pub fn values(&self) -> Vec<Time> {
        let count = (self.to - self.from).steps(self.step);
        (0..=count).map(|n| self.from + self.step * n).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_end_at_the_last_or_before_it() {
        let ms = Time::from_ms;
        let values = |to: f64| Intervals { from: ms(10.0), to: ms(to), step: ms(5.0) }.values();
        assert_eq!(values(10.0), [10.0].map(ms));
        for to in [20.0, 24.0] {
            assert_eq!(values(to), [10.0, 15.0, 20.0].map(ms), "{to}");
        }
    }
}
