//! The orders in which the blast rows can fire, ranked from the worst to the best.
//!
//! 1. With up to [`MOST_ROWS`] rows, all orders get a quick check at coarse steps. If the shelter is its own mirror image, an order
//!    and its mirrored order are checked once.
//! 2. The hardest orders are checked first. An order stays in question while its coarse utilization + `REACH_ERROR_FACTOR` x its
//!    error exceeds the greatest utilization checked so far. This goes on until no order is left. The best order is found in the
//!    same way, with the signs reversed.
//!
//! The planned shots rank the orders. The [`SAMPLED_AT_EACH_END`] best orders and as many of the worst, some by each limit, get a
//! few samples, by draws that only choose. Three of these get a full verdict: the worst by its planned shot, the one that fails
//! most often, and the best. Fresh draws confirm the best. If these pass and every order was sampled, the rest get a full verdict,
//! too. Only then every order can pass.
//!
//! With more rows the orders are searched: random orders first, then swaps of two rows in the worst `CLIMBERS` of them and in the
//! best, until no swap leads further. A search may miss the worst order; its result says so.

mod check_extremes;
mod climb;
mod mirror_rows;

use std::collections::{BTreeMap, BTreeSet};

use itertools::Itertools;
use serde::{Deserialize, Serialize};

pub use self::check_extremes::check_extremes;
use self::climb::climb_orders;
use self::mirror_rows::{mirror_rows, mirrored};
use super::as_planned::check_many::{check_summary, run_checks_or_failed};
use super::as_planned::quick_check::{quick_check_is_sure, quick_check_until};
use super::cost::RUNS_OF_VERDICT;
use super::judge::brief_judgement::BriefJudgement;
use super::judge::nearest_limits::nearest_each_limit_in_turn;
use super::samples::risk_summary::{RiskSummary, sample_shots_in_brief};
use super::samples::sample_count::Sampling;
use super::search::MOST_TRIED;
use super::standing::verdict_word::ThinPass;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, Fingerprint, NoResult, Shard, ShotSummary};
use crate::plan::{HoleTiming, Time};
use crate::sorting::{sort_by, sort_by_key};
use crate::verdict::{Verdict, VerdictWord};

/// Greatest number of blast rows whose orders are all tried: 40,320 orders.
pub const MOST_ROWS: usize = 8;
/// Greatest number of blast rows at which the quick check of every order goes on until the verdict is sure.
const MOST_SURE_ROWS: usize = 7;
/// Number of runs of a quick check with more rows than [`MOST_SURE_ROWS`].
const COARSE_RUNS: usize = 3;

/// Number of orders sampled at each end of the ranking.
const SAMPLED_AT_EACH_END: usize = 20;

/// One order at one interval.
#[derive(Clone, Debug, PartialEq)]
pub struct TriedOrder {
    /// Number of this trial, in the order in which one machine tries them.
    pub number: usize,
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// Interval between successive rows.
    pub interval: Time,
    /// Summary of the planned shot: verdict, height, force and drift.
    pub planned: ShotSummary,
}

/// Result of trying orders.
#[derive(Clone, Debug)]
pub struct Orders {
    /// How the holes of each row fire in every order.
    pub holes: HoleTiming,
    /// The orders, from the worst to the best.
    pub ranked: Vec<TriedOrder>,
    /// Whether all possible orders were tried.
    pub complete: bool,
    /// Judgement of each ranked order.
    judged: Vec<BriefJudgement>,
    /// Whether samples were requested.
    is_sampled: bool,
    /// What ends the thin passes of orders that decide, by their ranks. Not searched without samples.
    thin: BTreeMap<usize, ThinPass>,
}

/// Share of the progress that the planned shots take. Of the rest, the shares of the first look at both ends, and of the orders
/// that decide.
const SHARE_AS_PLANNED: f64 = 0.4;
const SHARE_OF_FIRST_LOOK: f64 = 0.5;
const SHARE_OF_DECISIVE: f64 = 0.6;

impl Orders {
    /// Ranks the orders tried at `intervals` intervals.
    pub fn new(case: &Case, mut tried: Vec<TriedOrder>, intervals: usize, holes: HoleTiming) -> Self {
        let complete = tries_all(case) && tried.len() == count_orders(case, intervals);
        sort_by(&mut tried, |a, b| {
            utilization(case, b).total_cmp(&utilization(case, a)).then(a.number.cmp(&b.number))
        });
        Self {
            holes,
            judged: tried.iter().map(|tried| BriefJudgement::of_planned_alone(case, tried.planned)).collect(),
            ranked: tried,
            complete,
            is_sampled: false,
            thin: BTreeMap::new(),
        }
    }

    /// Samples the worst and the best orders. The orders that decide are sampled until their verdict is sure.
    pub fn add_risk(&mut self, context: &Context<'_>, sampling: &Sampling) -> ComputeResult<()> {
        let &Context { case, control, .. } = context;
        self.is_sampled = true;
        self.judged
            .iter_mut()
            .for_each(|judged| *judged = BriefJudgement::of_samples(case, judged.planned, None));
        let count = self.ranked.len();
        let planned = self.ranked.iter().map(|tried| tried.planned).collect_vec();
        let worst = nearest_each_limit_in_turn(&case.limits, &planned).into_iter().take(SAMPLED_AT_EACH_END);
        let best = count.saturating_sub(SAMPLED_AT_EACH_END)..count;
        let ends: Vec<usize> =
            [0].into_iter().take(count).chain(worst).chain(best).sorted().dedup().collect();
        let shot = |&n: &usize| {
            let TriedOrder { order, interval, planned, .. } = &self.ranked[n];
            (case.shot(order, *interval, &self.holes), *planned)
        };
        let shots: Vec<_> = ends.iter().map(shot).collect();
        let first_look = sampling.for_screening().first_look();
        let looking = control.part(SHARE_OF_FIRST_LOOK);
        let looks = sample_shots_in_brief(context, &shots, &first_look)?;
        let mut sampled: Vec<_> =
            looks.into_iter().map(|risk| risk.map(RiskSummary::of_first_look)).collect();
        drop(looking);
        let share = |n: &usize| sampled[*n].map_or(0.0, |risk| risk.failing_share());
        let fails_most = (0..ends.len()).max_by(|a, b| share(a).total_cmp(&share(b)).then(b.cmp(a)));
        let best = ends.len().checked_sub(1);
        let decisive: BTreeSet<usize> = best.map(|_| 0).into_iter().chain(fails_most).chain(best).collect();
        let full: Vec<_> = decisive.iter().map(|&n| shots[n].clone()).collect();
        let judging = control.part(SHARE_OF_DECISIVE);
        let judged = sample_shots_in_brief(context, &full, sampling)?;
        drop(judging);
        for (&n, judged) in decisive.iter().zip(judged) {
            sampled[n] = judged;
        }
        let mut partial = sampled.contains(&None);
        for (&n, sampled) in ends.iter().zip(sampled) {
            self.judged[n] = BriefJudgement::of_samples(case, self.judged[n].planned, sampled);
        }
        let mut confirmations = 0;
        for &n in &decisive {
            let (rank, shot) = (ends[n], &shots[n].0);
            let mut judged = self.judged[rank].with_one_dud(context, shot, sampling)?;
            if let (Some(passing), true) = (judged, Some(n) == best) {
                judged = passing.confirmed(context, shot, sampling, &mut confirmations)?;
            }
            partial |= judged.is_none();
            self.judged[rank] = judged.unwrap_or(BriefJudgement::of_samples(case, shots[n].1, None));
            if self.judged[rank].verdict() == Verdict::Pass {
                self.thin.extend(ThinPass::of_passing_shot(context, shot)?.map(|thin| (rank, thin)));
            }
        }
        let others = (0..ends.len()).filter(|n| !decisive.contains(n)).collect_vec();
        if ends.len() == count && decisive.iter().all(|&n| self.judged[ends[n]].verdict() == Verdict::Pass) {
            let shots = others.iter().map(|&n| shots[n].clone()).collect_vec();
            let sampled = sample_shots_in_brief(context, &shots, sampling)?;
            for ((n, (shot, planned)), sampled) in others.into_iter().zip(&shots).zip(sampled) {
                let judged = BriefJudgement::of_samples(case, *planned, sampled);
                let judged = judged.with_one_dud(context, shot, sampling)?;
                partial |= sampled.is_none() || judged.is_none();
                self.judged[ends[n]] = judged.unwrap_or(BriefJudgement::of_samples(case, *planned, None));
            }
        }
        Ok(Computed { value: (), partial })
    }

    /// What ends the pass of an order, if that pass is known to be thin.
    pub fn thin(&self, rank: usize) -> Option<ThinPass> {
        self.thin.get(&rank).copied()
    }

    /// The verdict word of an order.
    pub fn word(&self, rank: usize) -> VerdictWord {
        if self.thin.contains_key(&rank) { VerdictWord::Thin } else { self.judged[rank].verdict().into() }
    }

    /// Whether the pass of an order that decides is thin.
    pub fn has_thin(&self) -> bool {
        !self.thin.is_empty()
    }

    /// Whether samples were requested.
    pub fn has_risk(&self) -> bool {
        self.is_sampled
    }

    /// Number of orders without samples, if samples were requested; else 0.
    pub fn not_sampled(&self) -> usize {
        let without = |judged: &&BriefJudgement| judged.risk.known().is_none();
        if self.has_risk() { self.judged.iter().filter(without).count() } else { 0 }
    }

    /// Judgement of the order ranked `n`.
    pub fn judged(&self, n: usize) -> &BriefJudgement {
        &self.judged[n]
    }

    /// Number of orders whose planned shot passes.
    pub fn passing_as_planned(&self) -> usize {
        self.ranked.iter().filter(|tried| tried.planned.verdict == Verdict::Pass).count()
    }
}

impl Computed<Orders> {
    /// The verdict on the worst order: pass only if every order was tried, and each passes.
    pub fn verdict(&self) -> Verdict {
        let Computed { value: orders, partial } = self;
        let worst = Verdict::worst(orders.judged.iter().map(BriefJudgement::verdict));
        let is_open = *partial || orders.ranked.is_empty() || !orders.complete;
        if worst == Verdict::Pass && is_open { Verdict::Undecided } else { worst }
    }
}

/// Number of possible orders, times the number of intervals.
pub fn count_orders(case: &Case, intervals: usize) -> usize {
    (1..=case.plan.blast_rows.len()).fold(intervals, usize::saturating_mul)
}

/// Whether the plan has few enough rows that all orders are tried.
pub fn tries_all(case: &Case) -> bool {
    case.plan.blast_rows.len() <= MOST_ROWS
}

/// Cost of the check of an order, in runs of a sample, measured on `point-blasting`; and number of samples of an order at an end.
const RUNS_OF_ORDER: usize = 40;
const SAMPLES_OF_ORDER: usize = 100;

/// The question: which order is the worst, and which is the best?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Intervals between successive rows.
    pub intervals: Vec<Time>,
    /// How the holes of each row fire in every order; `None` if the options differ, and nobody says it.
    pub holes: Option<HoleTiming>,
}

impl Study for Question {
    type Found = Orders;
    const IS_SHARED: bool = true;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Orders",
        question: "Which row first?",
        about: "Which order of the rows is worst, which best? All orders at the intervals of the plan.",
        tells: "the worst order, the best, and how far they differ",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        let tried =
            count_orders(case, case.plan.intervals(case.plan.shared_hole_timing()).len()).min(MOST_TRIED);
        let sampled = tried.min(2 * SAMPLED_AT_EACH_END);
        Some(tried * RUNS_OF_ORDER + sampled * SAMPLES_OF_ORDER + 2 * RUNS_OF_VERDICT)
    }

    fn usual(case: &Case, about: Subject) -> Self {
        let holes = about.holes_of(case);
        Self { intervals: case.plan.intervals(holes), holes }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Orders> {
        orders(context, &self.intervals, self.holes.ok_or(NoResult::HolesDiffer)?)
    }

    fn answer_shard(&self, context: &Context<'_>, shard: Shard) -> ComputeResult<()> {
        let tried = try_orders(context, &self.intervals, self.holes.ok_or(NoResult::HolesDiffer)?, shard)?;
        Ok(Computed { value: (), partial: tried.partial })
    }
}

/// Tries the orders at every interval, and ranks them. With a `sampling` it adds the risk of both ends.
pub fn orders(context: &Context<'_>, intervals: &[Time], holes: HoleTiming) -> ComputeResult<Orders> {
    let &Context { case, control, sampling, .. } = context;
    control.has_steps(if sampling.is_some() { 2 } else { 1 });
    let trying = control.part(if sampling.is_some() { SHARE_AS_PLANNED } else { 1.0 });
    let Computed { value: tried, mut partial } = try_orders(context, intervals, holes, Shard::WHOLE)?;
    drop(trying);
    let _ranking = control.part(1.0);
    let mut orders = Orders::new(case, tried, intervals.len(), holes);
    if let Some(sampling) = &sampling {
        partial |= orders.add_risk(context, sampling)?.partial;
    }
    Ok(Computed { value: orders, partial })
}

/// Tries the orders of `shard` at every interval.
pub fn try_orders(
    context: &Context<'_>,
    intervals: &[Time],
    holes: HoleTiming,
    shard: Shard,
) -> ComputeResult<Vec<TriedOrder>> {
    let &Context { case, .. } = context;
    if intervals.is_empty() {
        return Err(NoResult::NoInterval);
    }
    let rows = case.plan.blast_rows.len();
    // If no run succeeds, the first order shows why.
    let or_first_failure = |found: Computed<Vec<TriedOrder>>| {
        if found.value.iter().all(|tried| tried.planned == ShotSummary::FAILED_RUN) {
            for tried in found.value.iter().take(1) {
                check_summary(context, &case.shot(&tried.order, tried.interval, &holes))?;
            }
        }
        Ok(found)
    };
    if !tries_all(case) {
        return climb_orders(context, intervals, &holes).and_then(or_first_failure);
    }
    let mirror_rows = mirror_rows(case, &holes);
    let orders = intervals
        .iter()
        .flat_map(|&interval| (0..rows).permutations(rows).map(move |order| (order, interval)));
    let per_interval = count_orders(case, 1);
    let orders = orders.enumerate().map(|(number, (order, interval))| OrderToTry { number, order, interval });
    let is_ours = |one: &OrderToTry| shard.has(one.number) && one.order <= mirrored(&one.order, &mirror_rows);
    let found = quick_check_orders(context, &holes, orders.filter(is_ours).collect())?;
    let mut tried = Vec::with_capacity(2 * found.value.len());
    for one in found.value {
        let order = mirrored(&one.order, &mirror_rows);
        if order != one.order {
            let number = one.number - one.number % per_interval + lexicographic_number(&order);
            tried.push(TriedOrder { number, order, ..one });
        }
        tried.push(one);
    }
    sort_by_key(&mut tried, |tried| tried.number);
    if found.partial || shard != Shard::WHOLE {
        return or_first_failure(Computed { value: tried, partial: found.partial });
    }
    check_extremes(context, &holes, tried).and_then(or_first_failure)
}

/// An order to check at one interval.
struct OrderToTry {
    /// Number of the trial, as in [`TriedOrder::number`].
    number: usize,
    /// Blast rows in firing order.
    order: Vec<usize>,
    /// Interval between successive rows.
    interval: Time,
}

/// Number of a permutation in lexicographic order.
fn lexicographic_number(order: &[usize]) -> usize {
    let smaller = |n: usize| order[n + 1..].iter().filter(|&&later| later < order[n]).count();
    (0..order.len()).fold(0, |rank, n| rank * (order.len() - n) + smaller(n))
}

fn utilization(case: &Case, tried: &TriedOrder) -> f64 {
    tried.planned.utilization(&case.limits)
}

/// Checks orders quickly.
fn quick_check_orders(
    context: &Context<'_>,
    holes: &HoleTiming,
    orders: Vec<OrderToTry>,
) -> ComputeResult<Vec<TriedOrder>> {
    let &Context { case, compute, control, .. } = context;
    let enough = |summary: &ShotSummary, runs: usize| {
        quick_check_is_sure(case, summary, runs)
            || case.plan.blast_rows.len() > MOST_SURE_ROWS && runs >= COARSE_RUNS
    };
    let summaries = run_checks_or_failed(&orders, control, |OrderToTry { order, interval, .. }| {
        let shot = case.shot(order, *interval, holes);
        let planned = control.journal().recall_or(
            || Fingerprint::of(("order", case.fingerprint(), &shot, compute)),
            || quick_check_until(context, &shot, enough),
        );
        if let Ok(planned) = &planned {
            control.note_tried(interval.seconds(), planned.utilization(&case.limits));
        }
        planned
    })?;
    let tried = |(OrderToTry { number, order, interval }, planned): (_, Option<ShotSummary>)| {
        planned.map(|planned| TriedOrder { number, order, interval, planned })
    };
    let partial = summaries.contains(&None);
    Ok(Computed { value: orders.into_iter().zip(summaries).filter_map(tried).collect(), partial })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_are_numbered_as_they_are_listed() {
        for (number, order) in (0..5).permutations(5).enumerate() {
            assert_eq!(super::lexicographic_number(&order), number);
        }
    }
}
