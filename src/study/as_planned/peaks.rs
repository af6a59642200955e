//! Height, force and drift of a shot with their errors, from runs at a ladder of steps.

use std::ops::Range;

use super::step_error::{NEIGHBOURS, estimate, widened};
use crate::outcome::{History, Outcome, Peak, slice_at, slices};
use crate::verdict::{Estimate, PerQuantity};

/// Number of equal parts of a run in which rivals of its greatest value are searched.
const SLICES: usize = 32;

/// Height, force and drift of the last of `runs`. The runs are sorted from the coarsest step to the finest. Errors of height and
/// force reach up to rivals of the greatest value.
///
/// The errors come from the runs of [`error_runs`], and from `pairs` of nearby shots that run at the coarsest step of those runs.
pub fn peaks_with_rivals(runs: &[&Outcome], pairs: &[[&Outcome; 2]]) -> PerQuantity<Estimate> {
    let near = &runs[error_runs(runs.len())];
    let last = runs[runs.len() - 1];
    let PerQuantity { height, force, drift } = peaks(runs, pairs);
    PerQuantity {
        height: beside_rivals(near, last, height, |history| &history.height),
        force: beside_rivals(near, last, force, |history| &history.force),
        drift,
    }
}

/// The same without rivals.
fn peaks(runs: &[&Outcome], pairs: &[[&Outcome; 2]]) -> PerQuantity<Estimate> {
    let near = &runs[error_runs(runs.len())];
    let last = runs[runs.len() - 1];
    let estimate_of = |peak: fn(&Outcome) -> Peak| {
        let Peak { value, time, index } = peak(last);
        let error = estimate(last.step, value, near.iter().map(|run| (run.step, peak(run).value)));
        let between = near.first().map_or(value, |coarsest| peak(coarsest).value);
        let pairs = pairs.iter().map(|pair| pair.map(|run| peak(run).value));
        Estimate { value, error: widened(error, between, pairs), time, index }
    };
    PerQuantity {
        height: estimate_of(|run| run.height),
        force: estimate_of(|run| run.force),
        drift: estimate_of(|run| run.drift),
    }
}

/// Indices of the runs that give the errors of the last of `count` runs: the runs just before it, [`NEIGHBOURS`] at most.
pub fn error_runs(count: usize) -> Range<usize> {
    count.saturating_sub(1 + NEIGHBOURS)..count - 1
}

/// A greatest value whose error reaches up to its rivals. Rivals are peaks at other times. They are smaller in this run, but may be
/// greater within their own error.
///
/// The parts next to the part of the greatest value hold no rival: its own flank reaches into them, and the part of a peak differs
/// from step to step. If they counted, the error of the force would more than double in 16 % of the 2,100 scenes of `calibration`
/// at the draft level, and only three more forces and three more heights would lie within their error. Without them, no true force
/// exceeds the reported force by more than three times its error, with which a pass must stand. One height does, by 0.01 % of
/// itself.
fn beside_rivals(
    near: &[&Outcome],
    last: &Outcome,
    greatest: Estimate,
    buckets: fn(&History) -> &Vec<f64>,
) -> Estimate {
    let parts = |run: &Outcome| slices::<SLICES>(buckets(&run.history), run.history.width, last.end.time);
    let of_last = parts(last);
    let near: Vec<_> = near.iter().map(|run| (run.step, parts(run))).collect();
    let upper_end =
        |n: usize| of_last[n] + estimate(last.step, of_last[n], near.iter().map(|(step, v)| (*step, v[n])));
    let top = slice_at::<SLICES>(greatest.time, last.end.time);
    let highest = (0..SLICES).filter(|n| n.abs_diff(top) > 1).map(upper_end).fold(0.0, f64::max);
    Estimate { error: greatest.error.max(highest - greatest.value), ..greatest }
}
