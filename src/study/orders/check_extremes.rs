//! Full checks of the orders that may be the worst or the best.

use std::collections::{HashMap, HashSet};

use itertools::Itertools;

use super::mirror_rows::{mirror_rows, mirrored};
use super::{TriedOrder, utilization};
use crate::plan::{HoleTiming, Time};
use crate::scene::Shot;
use crate::sorting::sorted_by;
use crate::study::as_planned::check_many::{check_summary, run_checks_or_failed};
use crate::study::{ComputeResult, Computed, Context, ShotSummary};

/// Factor on the error of a quick check within which an order may still be the worst or the best. This is 6 times the error that a
/// check would report for the same runs. In 36 cases of six rows the worst order needed at most 3.5 times (`benches/RESULTS.md`).
const REACH_ERROR_FACTOR: f64 = 2.4;

/// Number of orders refined together. The number is fixed, so the number of threads changes nothing.
const REFINED_TOGETHER: usize = 32;

/// Checks the orders that may be the worst or the best at every interval, as `check` does, until none is left.
pub fn check_extremes(
    context: &Context<'_>,
    holes: &HoleTiming,
    mut tried: Vec<TriedOrder>,
) -> ComputeResult<Vec<TriedOrder>> {
    let &Context { case, control, .. } = context;
    let mirror_rows = mirror_rows(case, holes);
    let mut refined = HashSet::new();
    let index: HashMap<(Time, Vec<usize>), usize> =
        tried.iter().enumerate().map(|(n, t)| ((t.interval, t.order.clone()), n)).collect();
    let image_of = |t: &TriedOrder| index.get(&(t.interval, mirrored(&t.order, &mirror_rows))).copied();
    let images: Vec<Option<usize>> = tried.iter().map(image_of).collect();
    let intervals: Vec<Time> = tried.iter().map(|tried| tried.interval).dedup().collect();
    // First toward the worst order, then toward the best.
    for (interval, sign) in itertools::iproduct!(intervals, [1.0, -1.0]) {
        loop {
            let is_of_interval = |n: &usize| tried[*n].interval == interval;
            let is_known = |n: &usize| tried[*n].planned != ShotSummary::FAILED_RUN;
            let checked =
                (0..tried.len()).filter(|n| is_of_interval(n) && refined.contains(n) && is_known(n));
            let farthest_checked =
                checked.map(|n| sign * utilization(case, &tried[n])).fold(f64::NEG_INFINITY, f64::max);
            // An order whose runs failed may be the worst, but not the best.
            let reachable = |n: usize| match is_known(&n) {
                true => {
                    let shown = tried[n].planned.as_far_as_shown();
                    sign * shown.with_errors(sign * REACH_ERROR_FACTOR).utilization(&case.limits)
                }
                false => sign * f64::INFINITY,
            };
            let left = (0..tried.len())
                .filter(|n| is_of_interval(n) && !refined.contains(n) && reachable(*n) > farthest_checked)
                .filter(|&n| images[n].is_none_or(|image| n <= image));
            let mut next = sorted_by(left, |&a, &b| reachable(b).total_cmp(&reachable(a)));
            next.truncate(REFINED_TOGETHER);
            if next.is_empty() {
                break;
            }
            let shots: Vec<Shot> =
                next.iter().map(|&n| case.shot(&tried[n].order, interval, holes)).collect();
            let checked = run_checks_or_failed(&shots, control, |shot| check_summary(context, shot))?;
            for (n, planned) in next.into_iter().zip(checked) {
                let Some(planned) = planned else {
                    return Ok(Computed { value: tried, partial: true });
                };
                for n in images[n].into_iter().chain([n]) {
                    tried[n].planned = planned;
                    refined.insert(n);
                }
            }
        }
    }
    Ok(Computed::complete(tried))
}
