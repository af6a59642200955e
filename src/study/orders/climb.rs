//! The search among more orders than can be tried: hill climbing from random orders, by swaps of two rows.

use std::collections::{HashMap, HashSet};

use itertools::Itertools;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::check_extremes::check_extremes;
use super::{OrderToTry, TriedOrder, quick_check_orders, utilization};
use crate::plan::{HoleTiming, Time};
use crate::sorting::sorted_by;
use crate::study::{ComputeResult, Computed, Context};

/// Number of orders that swaps improve toward the worst order, and number toward the best.
const CLIMBERS: usize = 24;

/// Number of random orders of a search, per interval.
const RANDOM_STARTS: usize = 1000;

/// Share of the remaining progress of an interval that a round of climbing takes.
const SHARE_OF_ROUND: f64 = 0.25;

/// Searches the worst and the best order at every interval.
pub(super) fn climb_orders(
    context: &Context<'_>,
    intervals: &[Time],
    holes: &HoleTiming,
) -> ComputeResult<Vec<TriedOrder>> {
    let &Context { case, control, .. } = context;
    let rows: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
    let mut tried: Vec<TriedOrder> = Vec::new();
    for (n, &interval) in intervals.iter().enumerate() {
        let _interval = control.part(1.0 / (intervals.len() - n + 1) as f64);
        let mut random = ChaCha8Rng::seed_from_u64(n as u64);
        let mut starts = vec![rows.clone(), rows.iter().rev().copied().collect()];
        starts.extend((0..RANDOM_STARTS).map(|_| {
            let mut order = rows.clone();
            order.shuffle(&mut random);
            order
        }));
        let first = tried.len();
        let starting = control.part(SHARE_OF_ROUND);
        if quick_check_new_orders(context, holes, &mut tried, first, starts, interval)?.partial {
            return Ok(Computed { value: tried, partial: true });
        }
        drop(starting);
        // Climbers toward the worst order climb the utilization. Climbers toward the best order climb its negative.
        let mut climbers: Vec<(f64, Vec<usize>)> = Vec::new();
        for sign in [1.0, -1.0] {
            let height = |tried: &&TriedOrder| sign * utilization(case, tried);
            let highest = sorted_by(&tried[first..], |a, b| height(b).total_cmp(&height(a)));
            climbers.extend(highest.into_iter().take(CLIMBERS).map(|tried| (sign, tried.order.clone())));
        }
        // All climbers take a step at once. Climbers that meet become one.
        while !climbers.is_empty() {
            let _round = control.part(SHARE_OF_ROUND);
            let neighbours = climbers.iter().flat_map(|(_, order)| exchanges(order)).unique().collect();
            if quick_check_new_orders(context, holes, &mut tried, first, neighbours, interval)?.partial {
                return Ok(Computed { value: tried, partial: true });
            }
            let utilizations: HashMap<&[usize], f64> =
                tried[first..].iter().map(|t| (t.order.as_slice(), utilization(case, t))).collect();
            let improved = |(sign, order): (f64, Vec<usize>)| {
                let value = |order: &Vec<usize>| sign * utilizations[order.as_slice()];
                let next = exchanges(&order).max_by(|a, b| value(a).total_cmp(&value(b)))?;
                (value(&next) > value(&order)).then_some((sign, next))
            };
            climbers = climbers
                .into_iter()
                .filter_map(improved)
                .unique_by(|(sign, order)| (*sign > 0.0, order.clone()))
                .collect();
        }
    }
    check_extremes(context, holes, tried)
}

/// All orders that differ by a swap of two rows.
fn exchanges(order: &[usize]) -> impl Iterator<Item = Vec<usize>> {
    (0..order.len()).array_combinations().map(move |[a, b]| {
        let mut order = order.to_vec();
        order.swap(a, b);
        order
    })
}

/// Checks the orders that are not among `tried[first..]`, and adds them.
fn quick_check_new_orders(
    context: &Context<'_>,
    holes: &HoleTiming,
    tried: &mut Vec<TriedOrder>,
    first: usize,
    orders: Vec<Vec<usize>>,
    interval: Time,
) -> ComputeResult<()> {
    let tried_orders: HashSet<&[usize]> = tried[first..].iter().map(|t| t.order.as_slice()).collect();
    let new = orders.into_iter().unique().filter(|order| !tried_orders.contains(order.as_slice()));
    let new = new.enumerate().map(|(n, order)| OrderToTry { number: tried.len() + n, order, interval });
    let Computed { value, partial } = quick_check_orders(context, holes, new.collect())?;
    tried.extend(value);
    Ok(Computed { value: (), partial })
}
