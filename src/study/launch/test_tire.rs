//! Launch velocity from a loose tire over a hole of an ordinary shot, by its height or its time in the air.
//!
//! 1. Symbols: V the launch velocity, h the height, T the time in the air, g the gravity.
//! 2. A tire thrown straight up rises h = V²/2g and is back on level ground after T = 2V/g.
//! 3. So V = √(2 g h). Its relative error is half of that of h.
//! 4. Also V = g T / 2. Its error is g/2 for each second of error in T.
//!
//! One tire over one hole is one draw of the scatter from hole to hole and from shot to shot. However exact the reading, the launch
//! velocity is not known better than [`LEAST_PERCENT`].

use super::{Kind, LaunchEstimate, band_of};
use crate::plan::Uncertainty;
use crate::units;

/// Least coefficient of variation that one test tire leaves [%].
pub const LEAST_PERCENT: f64 = 10.0;

/// A loose test tire and its reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestTire {
    /// The reading.
    pub seen: Seen,
    /// Gravity [m/s²].
    pub gravity: f64,
}

/// A reading of a loose tire, with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// The greatest height [m].
    Height {
        /// The value.
        height: f64,
        /// Its standard deviation.
        sd: f64,
    },
    /// The time in the air [s].
    FlightTime {
        /// The value.
        time: f64,
        /// Its standard deviation.
        sd: f64,
    },
}

impl TestTire {
    /// The launch velocity, and its standard deviation from the reading [m/s].
    pub fn speed(&self) -> (f64, f64) {
        match self.seen {
            Seen::Height { height, sd } => {
                let speed = (2.0 * self.gravity * height).sqrt();
                (speed, 0.5 * speed * sd / height)
            }
            Seen::FlightTime { time, sd } => (0.5 * self.gravity * time, 0.5 * self.gravity * sd),
        }
    }

    /// The launch velocity, as an estimate.
    pub fn estimate(&self) -> LaunchEstimate {
        let (speed, sd) = self.speed();
        let reading = 1e2 * sd / speed;
        let percent = reading.max(LEAST_PERCENT);
        let out_of_range = (reading >= Uncertainty::ESTIMATED_LAUNCH_PERCENT).then(|| {
            format!(
                "read to {} % of the velocity: that tells no more than bounds do",
                units::rounded(reading, 0)
            )
        });
        let read = units::value_and_sd(speed, sd);
        LaunchEstimate {
            kind: Kind::TestTire,
            name: String::new(),
            band: band_of(speed, percent),
            common_percent: percent,
            out_of_range,
            basis: match self.seen {
                Seen::Height { height, sd } => {
                    format!("rose {} m: {read} m/s", units::value_and_sd(height, sd))
                }
                Seen::FlightTime { time, sd } => {
                    format!("in the air for {} s: {read} m/s", units::value_and_sd(time, sd))
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tire(seen: Seen) -> TestTire {
        TestTire { seen, gravity: 9.81 }
    }

    /// A height of 1.83 m gives 6 m/s. 20 % of a height is 10 % of the velocity. A frame of 1/30 s is 0.16 m/s.
    #[test]
    fn worked_numbers_come_out() {
        let (speed, sd) = tire(Seen::Height { height: 1.83, sd: 0.366 }).speed();
        assert!((speed - 6.0).abs() < 0.01 && (sd / speed - 0.1).abs() < 1e-9, "{speed} {sd}");
        let (speed, sd) = tire(Seen::FlightTime { time: 1.2232, sd: 1.0 / 30.0 }).speed();
        assert!((speed - 6.0).abs() < 0.01 && (sd - 0.16).abs() < 0.005, "{speed} {sd}");
    }

    /// However exact the reading, it is of one tire only. A poor reading is no better than a bound.
    #[test]
    fn one_tire_is_never_written_as_surer_than_one_tire() {
        let percent = |sd| tire(Seen::Height { height: 2.0, sd }).estimate().common_percent;
        assert_eq!(percent(0.01), LEAST_PERCENT);
        assert!((percent(0.6) - 15.0).abs() < 1e-9);
        let badly = tire(Seen::Height { height: 0.5, sd: 0.4 }).estimate();
        assert!(!badly.is_valid() && badly.common_percent > Uncertainty::ESTIMATED_LAUNCH_PERCENT);
    }
}
