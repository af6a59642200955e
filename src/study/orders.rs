//! The orders in which the blast rows can fire, ranked from the worst to the best.
//!
//! Up to [`MOST_ROWS`] rows all orders are tried. With more rows the orders are searched: random orders first; then
//! exchanges of two rows in the worst and in the best order found, until no exchange leads further. A search may miss
//! the worst order; its result says so.

use itertools::Itertools;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::batch::judge_shots;
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, Shard};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// Greatest number of blast rows whose orders are all tried: 5,040 orders.
pub const MOST_ROWS: usize = 7;
/// Number of random orders of a search, per interval.
const RANDOM: usize = 1000;

/// One order at one interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// Number of this trial, in the order in which one machine tries them.
    pub number: usize,
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// Interval between successive rows [s].
    pub interval: f64,
    /// Verdict, height, force and drift.
    pub envelope: Envelope,
}

/// Result of trying orders.
#[derive(Clone, Debug)]
pub struct Orders {
    /// From the worst to the best.
    pub ranked: Vec<Tried>,
    /// Whether all possible orders were tried.
    pub complete: bool,
}

impl Orders {
    /// Ranks the orders that one or many machines tried, at `intervals` intervals.
    pub fn new(case: &Case, mut tried: Vec<Tried>, intervals: usize) -> Self {
        let complete = is_complete(case) && tried.len() == count(case, intervals);
        let utilization = |tried: &Tried| tried.envelope.utilization(&case.limits);
        tried.sort_by(|a, b| utilization(b).total_cmp(&utilization(a)).then(a.number.cmp(&b.number)));
        Self { ranked: tried, complete }
    }

    /// The verdict on all orders; undecided where none was tried.
    pub fn verdict(&self) -> Verdict {
        let worst = Verdict::worst(self.ranked.iter().map(|tried| tried.envelope.verdict));
        if self.ranked.is_empty() { Verdict::Undecided } else { worst }
    }

    /// Number of orders that pass.
    pub fn passing(&self) -> usize {
        self.ranked.iter().filter(|tried| tried.envelope.verdict == Verdict::Pass).count()
    }
}

/// Number of possible orders, times the number of intervals.
pub fn count(case: &Case, intervals: usize) -> usize {
    (1..=case.plan.blast_rows.len()).product::<usize>().saturating_mul(intervals)
}

/// Whether the plan has few enough rows that all orders are tried.
pub fn is_complete(case: &Case) -> bool {
    case.plan.blast_rows.len() <= MOST_ROWS
}

/// Tries the orders at every interval [s]; only the share `shard` of them.
pub fn orders(
    case: &Case,
    intervals: &[f64],
    shard: Shard,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Vec<Tried>> {
    if intervals.is_empty() {
        return Err(NoResult::NoInterval);
    }
    let rows = case.plan.blast_rows.len();
    if !is_complete(case) {
        return search(case, intervals, compute, progress);
    }
    let all = intervals
        .iter()
        .flat_map(|&interval| (0..rows).permutations(rows).map(move |order| (order, interval)));
    let jobs: Vec<_> = all.enumerate().filter(|(number, _)| shard.has(*number)).collect();
    judge_orders(case, jobs, compute, progress)
}

type Job = (usize, (Vec<usize>, f64));

fn judge_orders(
    case: &Case,
    jobs: Vec<Job>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Vec<Tried>> {
    let shots: Vec<Shot> = jobs.iter().map(|(_, (order, interval))| case.shot(order, *interval)).collect();
    let envelopes = judge_shots(case, &shots, compute, progress)?;
    let tried = |((number, (order, interval)), envelope): (Job, Option<Envelope>)| {
        envelope.map(|envelope| Tried { number, order, interval, envelope })
    };
    let partial = envelopes.contains(&None);
    Ok(Found { value: jobs.into_iter().zip(envelopes).filter_map(tried).collect(), partial })
}

fn search(
    case: &Case,
    intervals: &[f64],
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Vec<Tried>> {
    let rows: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
    let (mut tried, mut partial): (Vec<Tried>, _) = (Vec::new(), false);
    for (n, &interval) in intervals.iter().enumerate() {
        let mut random = ChaCha8Rng::seed_from_u64(n as u64);
        let mut starts = vec![rows.clone(), rows.iter().rev().copied().collect()];
        starts.extend((0..RANDOM).map(|_| {
            let mut order = rows.clone();
            order.shuffle(&mut random);
            order
        }));
        let first = tried.len();
        partial |= add(case, &mut tried, starts, interval, compute, progress)?;
        // Exchanges of the worst order and of the best order, until all exchanges of both are known.
        loop {
            let before = tried.len();
            for sign in [1.0, -1.0] {
                let rank = |tried: &Tried| sign * tried.envelope.utilization(&case.limits);
                let end = tried[first..].iter().reduce(|a, b| if rank(b) > rank(a) { b } else { a });
                let Some(end) = end.cloned() else { return Ok(Found { value: tried, partial }) };
                let exchanged = (0..rows.len()).array_combinations().map(|[a, b]| {
                    let mut order = end.order.clone();
                    order.swap(a, b);
                    order
                });
                partial |= add(case, &mut tried, exchanged.collect(), interval, compute, progress)?;
            }
            if tried.len() == before {
                break;
            }
        }
    }
    Ok(Found { value: tried, partial })
}

/// Judges the orders that have not been tried at this interval, and adds them to `tried`. Returns whether the time was up
/// before all of them were judged.
fn add(
    case: &Case,
    tried: &mut Vec<Tried>,
    orders: Vec<Vec<usize>>,
    interval: f64,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<bool, NoResult> {
    let known: std::collections::HashSet<&[usize]> =
        tried.iter().filter(|t| t.interval == interval).map(|t| t.order.as_slice()).collect();
    let new = orders.into_iter().unique().filter(|order| !known.contains(order.as_slice()));
    let jobs = new.enumerate().map(|(n, order)| (tried.len() + n, (order, interval))).collect();
    let Found { value, partial } = judge_orders(case, jobs, compute, progress)?;
    tried.extend(value);
    Ok(partial)
}
