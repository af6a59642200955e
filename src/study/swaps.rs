//! Blast rows that may fire in the reverse order, because the detonators in their holes scatter.

use super::Case;
use crate::scene::fire_at_s;

/// Two successive blast rows that may fire in the reverse order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swap {
    /// Index of the option.
    pub option: usize,
    /// Indices of the blast rows, in the planned order.
    pub rows: [usize; 2],
    /// Planned interval between the rows [s].
    pub interval: f64,
    /// Probability that a hole of the second row fires before a hole of the first.
    pub probability: f64,
}

/// Pairs of successive rows of which a hole of the second fires before a hole of the first with a probability of at least
/// `least`.
pub fn swaps(case: &Case, least: f64) -> Vec<Swap> {
    let unknown = &case.plan.uncertainty;
    let in_hole = unknown.in_hole_deviation();
    let mut swaps = Vec::new();
    for (option, delay) in case.plan.delays.iter().enumerate() {
        let mut rows: Vec<(f64, usize)> =
            fire_at_s(&delay.timing).into_iter().enumerate().map(|(row, at)| (at, row)).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in rows.windows(2) {
            let [(early, first), (late, second)] = [pair[0], pair[1]];
            let interval = late - early;
            let deviation = unknown.delay.deviation(interval).hypot(in_hole.hypot(in_hole));
            // The gap between rows is never negative: without detonators in the holes rows keep their order.
            if interval > 0.0 && in_hole > 0.0 {
                let probability = 0.5 * libm::erfc(interval / (deviation * std::f64::consts::SQRT_2));
                if probability >= least {
                    swaps.push(Swap { option, rows: [first, second], interval, probability });
                }
            }
        }
    }
    swaps
}
