//! The delay options: firing times of the blast rows, and of the holes in each row.

use serde::{Deserialize, Serialize};

use super::Time;
use crate::choice::HoleOrder;

/// Common delay times of surface connectors [ms]: 17, 25, 42 and 67 by Irish Industrial Explosives, 9 and 109 in Kirra; the others
/// are typical of catalogues.
pub const COMMON_DELAYS_MS: [f64; 12] =
    [0.0, 9.0, 17.0, 25.0, 33.0, 42.0, 67.0, 100.0, 109.0, 150.0, 176.0, 200.0];

/// One delay option.
#[derive(Clone, Debug, PartialEq)]
pub struct DelayOption {
    /// Name in every view; unique.
    pub name: String,
    /// Firing times of the rows: the first hole of a row fires then.
    pub timing: Timing,
    /// Firing times of the holes of each row.
    pub hole_timing: HoleTiming,
}

impl DelayOption {
    /// Whether two options fire every hole at the same time.
    pub fn fires_like(&self, other: &Self) -> bool {
        self.timing.fire_at() == other.timing.fire_at() && self.hole_timing.is_same(&other.hole_timing)
    }
}

/// Firing of the holes of each row, from the firing time of the row on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HoleTiming {
    /// Time between successive holes; 0: the holes fire together.
    pub interval: Time,
    /// Where the holes begin.
    pub order: HoleOrder,
    /// Whether each hole fires the next, so that a dud stops the holes behind it.
    pub fired_through: bool,
}

impl HoleTiming {
    /// The holes of a row fire together.
    pub const TOGETHER: Self = Self { interval: Time::ZERO, order: HoleOrder::DEFAULT, fired_through: false };

    /// Whether the holes of a row fire at one time.
    pub fn is_together(&self) -> bool {
        self.interval == Time::ZERO
    }

    /// Whether the holes of every row fire alike. Without an interval the order does not matter.
    pub fn is_same(&self, other: &Self) -> bool {
        let is_alike = self.is_together() && other.is_together() && self.fired_through == other.fired_through;
        self == other || is_alike
    }

    /// The timing in words, such as `holes 17 ms left`; `None` if the holes fire together.
    pub fn words(&self) -> Option<String> {
        let Self { interval, order, .. } = self;
        (!self.is_together()).then(|| format!("holes {interval} ms {order}"))
    }
}

/// Firing times of the blast rows.
#[derive(Clone, Debug, PartialEq)]
pub enum Timing {
    /// The rows fire one after another.
    Interval {
        /// Indices of the blast rows in firing order.
        order: Vec<usize>,
        /// Time between successive rows.
        interval: Time,
    },
    /// Firing time of each blast row, in the order of the plan (`n_blast_rows`).
    At(Vec<Time>),
}

impl Timing {
    /// Firing time of each blast row (`n_blast_rows`).
    pub fn fire_at(&self) -> Vec<Time> {
        match self {
            Timing::At(times) => times.clone(),
            Timing::Interval { order, interval } => fire_in_turn(order, *interval),
        }
    }

    /// The time between successive rows, if they fire in this `order` at one interval. `None` if they do not, if there is one row, or if
    /// `order` belongs to other rows.
    pub fn interval_in(&self, order: &[usize]) -> Option<Time> {
        let at = self.fire_at();
        let &[first, second, ..] = order else { return None };
        if order.len() != at.len() || order.iter().any(|&row| row >= at.len()) {
            return None;
        }
        let interval = at[second] - at[first];
        (fire_in_turn(order, interval) == at).then_some(interval).filter(|interval| *interval >= Time::ZERO)
    }
}

/// Firing time of each blast row if the rows fire in `order`, `interval` apart (`n_blast_rows`).
pub fn fire_in_turn(order: &[usize], interval: Time) -> Vec<Time> {
    let mut at = vec![Time::ZERO; order.len()];
    for (turn, &row) in order.iter().enumerate() {
        at[row] = interval * turn as i64;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without an interval the order of holes does not matter. It does matter whether a dud stops other holes.
    #[test]
    fn hole_timings_that_fire_alike_are_the_same() {
        let left = HoleTiming { order: HoleOrder::Left, ..HoleTiming::TOGETHER };
        let right = HoleTiming { order: HoleOrder::Right, ..HoleTiming::TOGETHER };
        assert!(left.is_same(&right));
        let interval = Time::from_ms(17.0);
        assert!(!HoleTiming { interval, ..left }.is_same(&HoleTiming { interval, ..right }));
        assert!(!left.is_same(&HoleTiming { fired_through: true, ..left }));
    }

    /// An order of other rows, as after a change of the plan, has no interval.
    #[test]
    fn rows_fire_at_one_interval_in_their_own_order_alone() {
        let at = |times: &[f64]| Timing::At(times.iter().copied().map(Time::from_ms).collect());
        let in_order = |times: &[f64], order: &[usize]| at(times).interval_in(order).map(Time::ms);
        assert_eq!(in_order(&[84.0, 0.0, 42.0], &[1, 2, 0]), Some(42.0));
        for (times, order) in [
            (&[84.0, 0.0, 42.0][..], &[0, 1, 2][..]),
            (&[0.0, 42.0, 85.0], &[0, 1, 2]),
            (&[0.0, 42.0], &[2, 0, 1]),
            (&[0.0, 42.0], &[0, 2]),
            (&[0.0, 42.0, 84.0], &[0, 1]),
            (&[0.0], &[0]),
        ] {
            assert_eq!(in_order(times, order), None, "{times:?} {order:?}");
        }
    }
}
