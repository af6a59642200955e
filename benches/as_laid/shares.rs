//! Failing shares, their bounds, and whether two of them agree.

use std::fmt;

/// Samples that fail, of all.
#[derive(Clone, Copy)]
pub struct Share {
    pub failures: usize,
    pub samples: usize,
}

/// Quantile of the normal distribution for bounds of 95 %.
const BOUNDS: f64 = 1.96;
/// Difference of two shares over its standard error from which on they disagree.
const DISAGREEMENT: f64 = 3.0;

impl Share {
    /// Share that fails.
    pub fn value(self) -> f64 {
        self.failures as f64 / self.samples as f64
    }

    /// Bounds of the probability, 95 % (Wilson 1927).
    pub fn bounds(self) -> [f64; 2] {
        let (count, share) = (self.samples as f64, self.value());
        let square = BOUNDS * BOUNDS / count;
        let half = BOUNDS * (share * (1.0 - share) / count + square / (4.0 * count)).sqrt();
        [-half, half].map(|half| ((share + 0.5 * square + half) / (1.0 + square)).clamp(0.0, 1.0))
    }

    /// Difference to another share over its standard error, where both are of one probability.
    pub fn deviations_from(self, other: Self) -> f64 {
        let all = (self.samples + other.samples) as f64;
        let pooled = (self.failures + other.failures) as f64 / all;
        let variance = pooled * (1.0 - pooled) * (1.0 / self.samples as f64 + 1.0 / other.samples as f64);
        if variance > 0.0 { (self.value() - other.value()) / variance.sqrt() } else { 0.0 }
    }

    /// Whether both may be of one probability.
    pub fn agrees_with(self, other: Self) -> bool {
        self.deviations_from(other).abs() < DISAGREEMENT
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.bounds().map(|bound| 100.0 * bound);
        write!(f, "{:.1} ({low:.1} to {high:.1})", 100.0 * self.value())
    }
}
