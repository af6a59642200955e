//! Times of a shot, in whole nanoseconds.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, Mul, Sub};

use serde::{Deserialize, Serialize};

/// A firing time, or the time between two firings, in whole nanoseconds: 0.1 ms and 0.2 ms add up to 0.3 ms, and equal times are equal.
///
/// The reader turns a plan's milliseconds into a `Time` once ([`Time::from_ms`]). The program turns a `Time` into seconds once, where it
/// builds a shot or reports a result ([`Time::seconds`]). Seconds never become a `Time` again. Sums stop at 292 years, where nothing fires.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Time(i64);

impl Time {
    /// No time.
    pub const ZERO: Self = Self(0);

    /// Time of whole nanoseconds.
    pub const fn from_nanoseconds(nanoseconds: i64) -> Self {
        Self(nanoseconds)
    }

    /// Time nearest to this number of milliseconds: exact if it has at most six decimals.
    pub fn from_ms(ms: f64) -> Self {
        Self((ms * 1e6).round() as i64)
    }

    /// The time in milliseconds, as written in a plan.
    pub fn ms(self) -> f64 {
        self.0 as f64 / 1e6
    }

    /// The time in seconds, to the nearest number.
    pub fn seconds(self) -> f64 {
        self.0 as f64 / 1e9
    }

    /// Whether the time is a whole number of milliseconds, as electronic detonators take it.
    pub fn is_whole_milliseconds(self) -> bool {
        self.0 % 1_000_000 == 0
    }

    /// The time in the middle of two, rounded to the nanosecond toward 0.
    pub fn middle(self, other: Self) -> Self {
        Self(self.0.midpoint(other.0))
    }

    /// The greatest multiple of `unit` that does not exceed this time.
    pub fn rounded_down(self, unit: Self) -> Self {
        Self(self.0.div_euclid(unit.0) * unit.0)
    }

    /// Number of whole `step`s in this time; the greatest number if `step` is 0.
    pub fn steps(self, step: Self) -> i64 {
        self.0.checked_div_euclid(step.0).unwrap_or(i64::MAX)
    }
}

/// Milliseconds with all digits, without the unit: `30.625`.
impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.ms().fmt(f)
    }
}

impl fmt::Debug for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self} ms")
    }
}

impl Add for Time {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sub for Time {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl Mul<i64> for Time {
    type Output = Self;

    fn mul(self, count: i64) -> Self {
        Self(self.0.saturating_mul(count))
    }
}

impl Sum for Time {
    fn sum<I: Iterator<Item = Self>>(times: I) -> Self {
        times.fold(Self::ZERO, Self::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milliseconds_add_up_as_written_and_become_the_nearest_seconds() {
        assert_eq!(Time::from_ms(0.1) + Time::from_ms(0.2), Time::from_ms(0.3));
        assert_eq!(Time::from_ms(16.7) * 3, Time::from_ms(50.1));
        for ms in 0..100_000 {
            let written: f64 = format!("{}.{:03}", ms / 1000, ms % 1000).parse().expect("a number");
            assert_eq!(Time::from_ms(f64::from(ms)).seconds(), written, "{ms} ms");
            assert_eq!(Time::from_ms(f64::from(ms) / 1e3).ms(), written, "{ms} µs");
        }
        assert_eq!(format!("{} {}", Time::from_ms(30.625), Time::from_ms(42.0)), "30.625 42");
    }

    #[test]
    fn times_round_down_below_zero_too() {
        let unit = Time::from_ms(0.01);
        assert_eq!(Time::from_ms(257.656_25).rounded_down(unit), Time::from_ms(257.65));
        assert_eq!(Time::from_ms(-0.001).rounded_down(unit), Time::from_ms(-0.01));
        assert_eq!(Time::from_ms(6.0).steps(Time::from_ms(0.7)), 8);
    }
}
