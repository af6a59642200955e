//! Result of one run: peaks of height, force and drift, the energy ledger, the end, and bounded histories.
//!
//! Simulations fill these types; verdicts and views read them. All values are in SI units.

/// A greatest value, with its time and its tire or cable.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Greatest value [unit of the quantity].
    pub value: f64,
    /// Time of the greatest value [s].
    pub time: f64,
    /// Index of the tire or cable in the scene.
    pub index: usize,
}

/// Reason why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndReason {
    /// Every tire lies still and no hole is left to fire.
    AtRest,
    /// The run reached the requested duration, or the time limit for shelters that never come to rest.
    TimeLimit,
}

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunEnd {
    /// Time of the end [s].
    pub time: f64,
    /// Reason of the end.
    pub reason: EndReason,
}

/// Energies of a run [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Energy that the holes put in [J].
    pub put_in: f64,
    /// Energy lost in landings, friction, damping and broken cables [J].
    pub dissipated: f64,
    /// Greatest |kinetic + potential + elastic + dissipated − put in| over the run [J].
    pub greatest_residual: f64,
}

impl Ledger {
    /// Greatest residual over the energy put in; the residual itself [J] if no energy was put in.
    pub fn residual(&self) -> f64 {
        if self.put_in > 0.0 { self.greatest_residual / self.put_in } else { self.greatest_residual }
    }
}

/// A cable that broke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenCable {
    /// Time of the break [s].
    pub time: f64,
    /// Index of the cable.
    pub cable: usize,
}

/// Result of one finished run.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Greatest flight height of any tire [m].
    pub height: Peak,
    /// Greatest cable force [N], each force divided by the strength of its cable. So a weak cable counts as a cable of the plan's
    /// breaking force that is loaded as much.
    pub force: Peak,
    /// Greatest horizontal shift of any tire at the end of the run [m].
    pub drift: Peak,
    /// Cables that broke, in order of time; empty unless the scene lets cables break.
    pub broken: Vec<BrokenCable>,
    /// Energies of the run.
    pub ledger: Ledger,
    /// Height and force over time.
    pub history: History,
    /// Step [s].
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Time and reason of the end.
    pub end: RunEnd,
    /// Whether a tire is in the air at the end.
    pub tires_in_air: bool,
}

/// Greatest height and force of any tire and cable in successive buckets of time.
///
/// The history holds the peaks of the run as they count: found between steps, and each force divided by the strength of its cable.
///
/// The history stays bounded for any duration: at `CAPACITY` buckets, neighbours merge and the width doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Width of a bucket [s]; bucket `n` covers the times from `n` to `n + 1` widths.
    pub width: f64,
    /// Greatest height in each bucket [m].
    pub height: Vec<f64>,
    /// Greatest cable force in each bucket [N].
    pub force: Vec<f64>,
}

impl History {
    /// Greatest number of buckets: twice the columns of the widest chart in a terminal.
    pub const CAPACITY: usize = 512;

    /// Empty history whose buckets are one step [s] wide.
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
        // The small term keeps a time on the border of two buckets out of the earlier bucket.
        let bucket = (at / self.width + 1e-6) as usize;
        if bucket >= self.height.len() {
            self.height.resize(bucket + 1, 0.0);
            self.force.resize(bucket + 1, 0.0);
        }
        self.height[bucket] = self.height[bucket].max(height);
        self.force[bucket] = self.force[bucket].max(force);
    }
}

/// Greatest value of `buckets`, each `width` [s] wide, in each of `SLICES` equal parts of the time from 0 to `end` [s].
pub fn slices<const SLICES: usize>(buckets: &[f64], width: f64, end: f64) -> [f64; SLICES] {
    let mut greatest = [0.0_f64; SLICES];
    for (n, &value) in buckets.iter().enumerate() {
        let slice = slice_at::<SLICES>((n as f64 + 0.5) * width, end);
        greatest[slice] = greatest[slice].max(value);
    }
    greatest
}

/// Number of the slice that holds the time `at` [s], of `SLICES` equal slices of the time from 0 to `end` [s].
pub fn slice_at<const SLICES: usize>(at: f64, end: f64) -> usize {
    ((at / end.max(f64::MIN_POSITIVE) * SLICES as f64) as usize).min(SLICES - 1)
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

    /// In binary, 3 × 0.009 / 0.009 is less than 3.
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
            let time = n as f64 * 1e-3;
            history.note(time, if n == 777 { 9.0 } else { 1.0 }, time);
        }
        assert!(history.height.len() <= History::CAPACITY);
        let peak = history.height.iter().position(|&h| h == 9.0).expect("the peak is kept");
        assert_eq!(peak, (0.777 / history.width) as usize);
        assert_eq!(history.force.last(), Some(&99.999));
    }
}
