//! Which of many planned shots are sampled if there is no time for all: for each limit, the shots nearest to it.
//!
//! The planned shot nearest to any limit need not fail most often, because forces scatter more than heights. So the limits take turns.

use itertools::Itertools;

use crate::sorting::sorted_by;
use crate::study::ShotSummary;
use crate::verdict::{Limits, Quantity};

/// Indices of all shots: the nearest to each limit, then the second nearest to each, and so on.
pub fn nearest_each_limit_in_turn(limits: &Limits, shots: &[ShotSummary]) -> Vec<usize> {
    let limited = Quantity::ALL.into_iter().filter(|quantity| limits.get(*quantity).is_some());
    let sorted = limited.map(|quantity| {
        let value = |n: &usize| shots[*n].get(quantity).value;
        sorted_by(0..shots.len(), |a, b| value(b).total_cmp(&value(a)))
    });
    let sorted = sorted.collect_vec();
    (0..shots.len()).flat_map(|rank| sorted.iter().map(move |of_limit| of_limit[rank])).unique().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::ValueWithError;
    use crate::verdict::PerQuantity;

    #[test]
    fn no_quantity_pushes_another_out() {
        let shot = |(height, force): (f64, f64)| {
            let values = PerQuantity { height, force, drift: 0.0 };
            ShotSummary {
                values: values.map(|&value| ValueWithError { value, error: 0.0 }),
                ..ShotSummary::FAILED_RUN
            }
        };
        // Three shots have heights near the limit of 1 and forces far from the limit of 100. One shot is the other way round.
        let shots = [(0.90, 10.0), (0.91, 20.0), (0.92, 5.0), (0.10, 60.0)].map(shot);
        let limits = Limits {
            height: 1.0,
            force: 100.0,
            drift: None,
            breaking_force: 100.0,
            accepted_risk: 0.01,
            holes_in_8_ms: None,
            charge_in_8_ms: None,
        };
        assert_eq!(nearest_each_limit_in_turn(&limits, &shots), [2, 3, 1, 0]);
        assert_eq!(nearest_each_limit_in_turn(&limits, &[]), [0; 0]);
    }
}
