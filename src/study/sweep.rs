//! Height and force against the interval between rows, and the intervals that pass.

use super::batch::judge_shots;
use super::{Case, ComputeSettings, Envelope, Finding, Found, Intervals, NoResult, Progress};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// One interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Interval between successive rows [s].
    pub interval: f64,
    /// Verdict, height, force and drift at this interval.
    pub envelope: Envelope,
}

/// Result of a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// Points in ascending order of the interval.
    pub points: Vec<Point>,
}

/// Difference of utilization between two neighbours from which the interval between them is tried, too.
const JUMP: f64 = 0.1;
/// How often the distance between two neighbours is halved at most.
const HALVINGS: usize = 3;

/// Sweeps the interval between the rows of `order`, more closely where the utilization jumps or the verdict changes.
pub fn sweep(
    case: &Case,
    order: &[usize],
    intervals: &Intervals,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Sweep> {
    if case.plan.blast_rows.len() < 2 {
        return Err(NoResult::SingleRow);
    }
    let mut partial = false;
    let mut judged = |intervals: Vec<f64>| -> Result<Vec<Point>, NoResult> {
        let shots: Vec<Shot> = intervals.iter().map(|&interval| case.shot(order, interval)).collect();
        let envelopes = judge_shots(case, &shots, compute, progress)?;
        partial |= envelopes.contains(&None);
        let point = |(interval, envelope): (f64, Option<_>)| Some(Point { interval, envelope: envelope? });
        // Out of time: keep the points before the first interval without a result, so that windows have no gaps.
        Ok(intervals.into_iter().zip(envelopes).map_while(point).collect())
    };
    let mut points = judged(intervals.values())?;
    for _ in 0..HALVINGS {
        let between: Vec<f64> = points
            .windows(2)
            .filter(|pair| jumps(case, &pair[0], &pair[1]))
            .map(|pair| 0.5 * (pair[0].interval + pair[1].interval))
            .collect();
        points.extend(judged(between)?);
        points.sort_by(|a, b| a.interval.total_cmp(&b.interval));
    }
    Ok(Found { value: Sweep { order: order.to_vec(), points }, partial })
}

fn jumps(case: &Case, a: &Point, b: &Point) -> bool {
    let utilization = |point: &Point| point.envelope.utilization(&case.limits);
    a.envelope.verdict != b.envelope.verdict || (utilization(a) - utilization(b)).abs() > JUMP
}

impl Sweep {
    /// The first and the last interval tried [s].
    pub fn range(&self) -> [f64; 2] {
        let at = |point: Option<&Point>| point.map_or(0.0, |point| point.interval);
        [at(self.points.first()), at(self.points.last())]
    }

    /// Windows: ranges of intervals [s] in which every interval tried passes.
    pub fn windows(&self) -> Vec<[f64; 2]> {
        let passing = |point: &&Point| point.envelope.verdict == Verdict::Pass;
        self.points
            .chunk_by(|a, b| (a.envelope.verdict == Verdict::Pass) == (b.envelope.verdict == Verdict::Pass))
            .filter(|stretch| stretch.first().is_some_and(|point| passing(&point)))
            .filter_map(|stretch| Some([stretch.first()?.interval, stretch.last()?.interval]))
            .collect()
    }

    /// The point of the greatest utilization.
    pub fn worst(&self, case: &Case) -> Option<&Point> {
        self.points.iter().max_by(|a, b| by_utilization(case, a, b))
    }

    /// The point of the least utilization.
    pub fn best(&self, case: &Case) -> Option<&Point> {
        self.points.iter().min_by(|a, b| by_utilization(case, a, b))
    }
}

fn by_utilization(case: &Case, a: &Point, b: &Point) -> std::cmp::Ordering {
    let utilization = |point: &Point| point.envelope.utilization(&case.limits);
    utilization(a).total_cmp(&utilization(b))
}
