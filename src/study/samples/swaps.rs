//! Blast rows that may fire in the reverse order, because the detonators in their holes scatter.

use itertools::Itertools;

use crate::plan::Time;
use crate::study::Case;

/// Two successive blast rows that may fire in the reverse order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swap {
    /// Indices of the blast rows, in the planned order.
    pub rows: [usize; 2],
    /// Planned interval between the rows [s].
    pub interval: f64,
    /// Probability that the first hole of the second row fires before the first hole of the first row; where the holes of a row
    /// fire together, of any one hole of each.
    pub probability: f64,
}

/// Pairs of successive rows of an option that fire in reverse order with a probability of at least `least`: the first hole of the
/// second row before the first hole of the first row.
pub fn find_swaps(case: &Case, option: usize, least: f64) -> Vec<Swap> {
    let uncertainty = &case.plan.uncertainty;
    let in_hole = uncertainty.in_hole_deviation();
    let times = case.plan.delays[option].timing.fire_at();
    let rows: Vec<(Time, usize)> = times.into_iter().zip(0..).sorted().collect();
    let swap = |pair: &[(Time, usize)]| {
        let [(early, first), (late, second)] = [pair[0], pair[1]];
        let interval = (late - early).seconds();
        let deviation = uncertainty.delay.deviation(interval).hypot(in_hole.hypot(in_hole));
        // The gap between rows is never negative: without detonators in the holes rows keep their order.
        let may_swap = interval > 0.0 && in_hole > 0.0;
        let probability = 0.5 * libm::erfc(interval / (deviation * std::f64::consts::SQRT_2));
        (may_swap && probability >= least).then_some(Swap { rows: [first, second], interval, probability })
    };
    rows.windows(2).filter_map(swap).collect()
}
