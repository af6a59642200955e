//! What a run says: greatest height, force and drift with place and time, the energy ledger, and bounded histories.
//!
//! Simulations fill these types, verdicts and views read them. SI units throughout.

/// A greatest value, where and when it was reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// The value, in the unit of its quantity.
    pub value: f64,
    /// When [s].
    pub at: f64,
    /// Index of the tire or cable.
    pub place: usize,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Every tire lies still and no hole is left to fire.
    AtRest,
    /// The duration asked for was reached, or the limit for shelters that never settle.
    TimeLimit,
}

/// Energies of a run [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Put in by the holes.
    pub put_in: f64,
    /// Lost in landings and friction.
    pub dissipated: f64,
    /// Greatest |kinetic + potential + elastic + dissipated − put in| over the run.
    pub greatest_residual: f64,
}

impl Ledger {
    /// Greatest residual over the energy put in; as it is [J] where nothing was put in.
    pub fn residual(&self) -> f64 {
        if self.put_in > 0.0 { self.greatest_residual / self.put_in } else { self.greatest_residual }
    }
}

/// A cable that broke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Broken {
    /// When [s].
    pub at: f64,
    /// Index of the cable.
    pub cable: usize,
}

/// One finished run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Greatest flight height of any tire [m].
    pub height: Peak,
    /// Greatest cable force [N].
    pub force: Peak,
    /// Greatest horizontal shift of any tire at the end [m]; `at` is the end.
    pub drift: Peak,
    /// Cables that broke, in order of time; none unless the scene lets cables break.
    pub broken: Vec<Broken>,
    /// Where the energy went.
    pub ledger: Ledger,
    /// Height and force over time.
    pub history: History,
    /// Step [s].
    pub step: f64,
    /// Steps made.
    pub steps: usize,
    /// How it ended; when is `drift.at`.
    pub end: End,
    /// Whether a tire is in the air at the end.
    pub aloft: bool,
}

/// Greatest height and force of any tire and cable in successive buckets of time.
///
/// Bounded however long the run: at `CAPACITY` buckets, neighbours merge and the width doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Width of a bucket [s]; bucket `n` covers `n..n+1` widths from time 0.
    pub width: f64,
    /// Greatest height in each bucket [m].
    pub height: Vec<f64>,
    /// Greatest cable force in each bucket [N].
    pub force: Vec<f64>,
}

impl History {
    /// Most buckets kept; twice the columns of the widest chart a terminal shows.
    pub const CAPACITY: usize = 512;

    /// An empty history with buckets of one step [s].
    pub fn new(step: f64) -> Self {
        Self {
            width: step,
            height: Vec::with_capacity(Self::CAPACITY),
            force: Vec::with_capacity(Self::CAPACITY),
        }
    }

    /// Notes the greatest height [m] and force [N] at time `at` [s].
    #[inline]
    pub fn note(&mut self, at: f64, height: f64, force: f64) {
        while at >= self.width * Self::CAPACITY as f64 {
            merge_neighbours(&mut self.height);
            merge_neighbours(&mut self.force);
            self.width *= 2.0;
        }
        // Not to be rounded into the bucket before the one that it begins.
        let bucket = (at / self.width + 1e-6) as usize;
        if bucket >= self.height.len() {
            self.height.resize(bucket + 1, 0.0);
            self.force.resize(bucket + 1, 0.0);
        }
        self.height[bucket] = self.height[bucket].max(height);
        self.force[bucket] = self.force[bucket].max(force);
    }
}

fn merge_neighbours(buckets: &mut Vec<f64>) {
    for n in 0..buckets.len().div_ceil(2) {
        let second = buckets.get(2 * n + 1).copied().unwrap_or(0.0);
        buckets[n] = buckets[2 * n].max(second);
    }
    buckets.truncate(buckets.len().div_ceil(2));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 × 0.009 / 0.009 is less than 3 in binary.
    #[test]
    fn no_bucket_is_passed_over() {
        for step in [0.009, 0.0011, 1e-3 / 3.0, 0.07] {
            let mut history = History::new(step);
            (0..5000).for_each(|n| history.note(n as f64 * step, 1.0, 1.0));
            assert!(history.height.iter().all(|&height| height == 1.0), "{step}");
        }
    }

    #[test]
    fn a_history_stays_bounded_and_keeps_its_peaks() {
        let mut history = History::new(1e-3);
        for n in 0..100_000 {
            let at = n as f64 * 1e-3;
            history.note(at, if n == 777 { 9.0 } else { 1.0 }, at);
        }
        assert!(history.height.len() <= History::CAPACITY);
        let peak = history.height.iter().position(|&h| h == 9.0).expect("the peak is kept");
        assert_eq!(peak, (0.777 / history.width) as usize);
        assert_eq!(history.force.last(), Some(&99.999));
    }
}
