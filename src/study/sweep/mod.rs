//! Height and force over the interval between rows: the windows of intervals whose planned shots pass, and the windows of accepted
//! risk ([`accepted`]).
//!
//! 1. The requested intervals are tried, and the intervals of the plan's own options.
//! 2. A *gap* lies between two neighboring intervals. The interval in its middle is tried, too, in three cases: the gap is wider
//!    than [`GAP`] and a neighbor passes; only one neighbor passes; both pass, but the gap is not *calm*. Gaps are halved down to
//!    `NARROWEST` in `windows`.
//! 3. A gap of width w is calm if u + s w ≤ 1. u is the greater upper bound (value + error) of the utilization at its two
//!    neighbors. s is the steepest change of the utilization with the interval, in this gap and in the gap on either side.
//! 4. A window is a row of passing intervals with calm gaps no wider than [`GAP`]. Its ends are intervals that were tried.
//!
//! The plan's own intervals, the ends of windows and the recommended interval are checked as `check` does. The others get a quick
//! check, at steps as coarse as their distance from the limits allows. Where the utilization jumps, the interval of the jump
//! depends a little on the step. So a window is narrowed until both ends pass.

mod accepted;
mod windows;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use self::windows::{find_windows, midpoints, recommend};
use super::as_planned::check_many::{check_summary, run_checks, run_checks_or_failed};
use super::as_planned::quick_check::quick_check;
use super::cost::RUNS_OF_VERDICT;
use super::judge::brief_judgement::BriefJudgement;
use super::samples::risk_summary::RiskSummary;
use super::standing::verdict_word::ThinPass;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, Intervals, NoResult, ShotSummary};
use crate::plan::{DelayOption, HoleTiming, Time, Timing};
use crate::verdict::Verdict;

/// One interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Interval between successive rows.
    pub interval: Time,
    /// What is known of its shot.
    pub judged: BriefJudgement,
    /// Whether the planned shot got only a quick check.
    pub is_quick: bool,
}

impl Point {
    /// The verdict on its shot.
    pub fn verdict(&self) -> Verdict {
        self.judged.verdict()
    }

    /// Whether samples were drawn.
    pub fn is_sampled(&self) -> bool {
        self.judged.risk.known().is_some()
    }

    /// Whether the planned shot passes, the failing share of its samples does not exceed the accepted risk, and one dud does not
    /// make it fail.
    pub fn is_accepted(&self) -> bool {
        let is_not_refuted = passes(self) && self.verdict() != Verdict::Fail;
        is_not_refuted && self.judged.risk.known().is_some_and(RiskSummary::is_accepted)
    }
}

/// Result of a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// How the holes of each row fire at every interval.
    pub holes: HoleTiming,
    /// Points in ascending order of the interval.
    pub points: Vec<Point>,
    /// Ranges of intervals in which the planned shot of every interval tried passes. The ends were tried.
    pub windows_as_planned: Vec<[Time; 2]>,
    /// Windows worth a check: ranges of intervals in which every interval sampled is accepted. The ends were sampled. If only the
    /// planned shots were requested, these are the windows of planned shots.
    pub windows: Vec<[Time; 2]>,
    /// The recommended interval; `None` if no window is wider than a point, or no full verdict passes.
    pub recommended: Option<Recommended>,
    /// Number of intervals whose full verdict does not pass.
    pub failed_full_verdict: usize,
}

impl Computed<Sweep> {
    /// The verdict: pass if an interval is recommended, fail if every interval of the range was tried and surely fails.
    pub fn verdict(&self) -> Verdict {
        let Computed { value: Sweep { points, recommended, .. }, partial } = self;
        let all_fail = !points.is_empty() && points.iter().all(|point| point.verdict() == Verdict::Fail);
        match recommended {
            Some(_) => Verdict::Pass,
            None if all_fail && !*partial => Verdict::Fail,
            None => Verdict::Undecided,
        }
    }
}

/// An interval deep inside a window worth a check; without samples, inside a window whose planned shots pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recommended {
    /// Interval between successive rows.
    pub interval: Time,
    /// Room on either side: within this distance every interval tried is inside the window.
    pub room: Time,
    /// Greatest utilization of all intervals within the room. With samples, the accepted share of the samples at the top is left
    /// out at each interval. Without samples, the planned shot counts, errors included.
    pub utilization: f64,
    /// What ends its pass, if the pass is thin. Not searched without samples.
    pub thin: Option<ThinPass>,
}

/// Greatest distance between neighboring points inside a window.
pub const GAP: Time = Time::from_nanoseconds(250_000);
/// Greatest distance between neighboring sampled points inside a window.
const MOST_SAMPLED_GAP: Time = Time::from_nanoseconds(1_000_000);
/// Intervals of a sweep, unless the user asks for others. More are tried between them where the answer changes.
pub const DEFAULT_INTERVALS: Intervals =
    Intervals { from: Time::ZERO, to: Time::from_nanoseconds(500_000_000), step: GAP };

/// Share of a sweep with samples that the planned shots take. Of the rest of that part, the shares of its first round and of each
/// later round.
const SHARE_AS_PLANNED: f64 = 0.15;
const SHARE_OF_FIRST_ROUND: f64 = 0.7;
const SHARE_OF_ROUND: f64 = 0.4;

/// The question: height, force and risk over the interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// Intervals between successive rows.
    pub intervals: Intervals,
    /// How the holes of each row fire at every interval; `None` if the options differ, and nobody says it.
    pub holes: Option<HoleTiming>,
}

/// Runs of a sweep before its verdicts: the planned shots, and the first look at the intervals that pass. Measured on
/// `amur-three-rows`.
const RUNS_BEFORE_VERDICTS: usize = 60_000;

impl Study for Question {
    type Found = Sweep;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Sweep",
        question: "Which interval?",
        about: "Which interval between rows passes? From 0 to 500 ms, closer where the answer changes.",
        tells: "the safest interval, and which are worth a check",
    });

    fn expected_runs(_case: &Case) -> Option<usize> {
        Some(RUNS_BEFORE_VERDICTS + RUNS_OF_VERDICT)
    }

    fn usual(case: &Case, about: Subject) -> Self {
        let order = (0..case.plan.blast_rows.len()).collect();
        Self { order, intervals: DEFAULT_INTERVALS, holes: about.holes_of(case) }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Sweep> {
        sweep(context, &self.order, &self.intervals, self.holes.ok_or(NoResult::HolesDiffer)?)
    }
}

/// Sweeps the interval between the rows of `order`. Without a `sampling` only the planned shots count.
pub fn sweep(
    context: &Context<'_>,
    order: &[usize],
    intervals: &Intervals,
    holes: HoleTiming,
) -> ComputeResult<Sweep> {
    let &Context { case, control, sampling, .. } = context;
    if case.plan.blast_rows.len() < 2 {
        return Err(NoResult::SingleRow);
    }
    control.has_steps(if sampling.is_some() { 3 } else { 1 });
    let trying = control.part(if sampling.is_some() { SHARE_AS_PLANNED } else { 1.0 });
    let as_planned = sweep_as_planned(context, order, intervals, holes)?;
    drop(trying);
    let Some(sampling) = sampling else { return Ok(as_planned) };
    let planned = plan_intervals(case, order, holes).into_iter().collect();
    accepted::add_risk(context, as_planned, &planned, &sampling)
}

/// Sweeps the planned shots.
fn sweep_as_planned(
    context: &Context<'_>,
    order: &[usize],
    intervals: &Intervals,
    holes: HoleTiming,
) -> ComputeResult<Sweep> {
    let &Context { case, control, .. } = context;
    let mut exact: BTreeSet<Time> = plan_intervals(case, order, holes).into_iter().collect();
    let mut next: BTreeSet<Time> = intervals.values().into_iter().collect();
    next.extend(exact.range(intervals.from..=intervals.to));
    let mut tried: BTreeMap<Time, ShotSummary> = BTreeMap::new();
    // The intervals of `exact` that were checked in full.
    let mut checked_in_full: BTreeSet<Time> = BTreeSet::new();
    loop {
        let _round = control.part(if tried.is_empty() { SHARE_OF_FIRST_ROUND } else { SHARE_OF_ROUND });
        let jobs: Vec<Time> = next.iter().copied().collect();
        let work = |&at: &Time| {
            let shot = case.shot(order, at, &holes);
            let checked = match exact.contains(&at) {
                true => check_summary(context, &shot),
                false => quick_check(context, &shot),
            };
            if let Ok(planned) = &checked {
                control.note_tried(at.seconds(), planned.utilization(&case.limits));
            }
            checked
        };
        // Points between known points may all fail.
        let checked = match tried.is_empty() {
            true => run_checks(&jobs, control, work)?,
            false => run_checks_or_failed(&jobs, control, work)?,
        };
        // Out of time: gaps keep their width, and windows end there.
        let partial = checked.contains(&None);
        let in_full =
            jobs.iter().zip(&checked).filter(|(at, checked)| exact.contains(at) && checked.is_some());
        checked_in_full.extend(in_full.map(|(&at, _)| at));
        tried.extend(jobs.into_iter().zip(checked).filter_map(|(at, planned)| Some((at, planned?))));
        let points: Vec<Point> = tried
            .iter()
            .map(|(&at, &planned)| Point {
                interval: at,
                judged: BriefJudgement::of_planned_alone(case, planned),
                is_quick: !checked_in_full.contains(&at),
            })
            .collect();
        next = if partial { BTreeSet::new() } else { midpoints(case, &points).into_iter().collect() };
        if !next.is_empty() {
            continue;
        }
        let windows = find_windows(case, &points);
        // Out of time, only an interval that was checked as `check` does can be recommended.
        let recommended = recommend(case, &points, &windows)
            .filter(|recommended| !partial || checked_in_full.contains(&recommended.interval))
            .filter(|_| !case.plan.uncertainty.launch_is_estimated());
        let wide = windows.iter().filter(|[from, to]| from < to).flatten();
        let ends_and_recommended = wide.copied().chain(recommended.map(|recommended| recommended.interval));
        next = ends_and_recommended.filter(|at| !exact.contains(at)).collect();
        if partial || next.is_empty() {
            let windows_as_planned = windows.clone();
            let order = order.to_vec();
            let value = Sweep {
                order,
                holes,
                points,
                windows_as_planned,
                windows,
                recommended,
                failed_full_verdict: 0,
            };
            return Ok(Computed { value, partial });
        }
        exact.extend(&next);
    }
}

/// Intervals of the plan's options: of options with an interval, and of options with firing times that fire the rows in this order.
fn plan_intervals(case: &Case, order: &[usize], holes: HoleTiming) -> Vec<Time> {
    let mut intervals = case.plan.intervals(Some(holes));
    for (delay, shot) in case.plan.delays.iter().zip(&case.shots) {
        if let Timing::At(_) = delay.timing
            && let Some(interval) = delay.timing.interval_in(order)
            && case.shot(order, interval, &holes).firings == shot.firings
        {
            intervals.push(interval);
        }
    }
    intervals
}

/// Whether two intervals lie farther apart than `gap`, by more than a hundredth of it. Gaps that are halved again and again end
/// near the requested width, not exactly at it.
fn are_apart(from: Time, to: Time, gap: Time) -> bool {
    (to - from) * 100 > gap * 101
}

fn passes(point: &Point) -> bool {
    point.judged.planned.verdict == Verdict::Pass
}

fn utilization(case: &Case, point: &Point) -> f64 {
    point.judged.planned.utilization(&case.limits)
}

impl Sweep {
    /// The first and the last interval tried.
    pub fn range(&self) -> [Time; 2] {
        let interval_of = |point: Option<&Point>| point.map_or(Time::ZERO, |point| point.interval);
        [interval_of(self.points.first()), interval_of(self.points.last())]
    }

    /// Whether samples were requested.
    pub fn has_risk(&self) -> bool {
        self.points.iter().any(|point| point.judged.risk.is_asked())
    }

    /// Ranges of intervals in which every interval tried passes. The ends were tried. With samples, only an interval with a full
    /// verdict passes, so such a range is often one interval.
    pub fn passing_windows(&self) -> Vec<[Time; 2]> {
        if !self.has_risk() {
            return self.windows.clone();
        }
        let has_passed = |point: &Point| !point.is_quick && point.verdict() == Verdict::Pass;
        accepted::windows_of(&self.points, &self.windows, has_passed)
    }

    /// Greatest distance between neighboring points inside any window; with samples, between the sampled points.
    pub fn largest_gap(&self) -> Time {
        let counts = |point: &&Point| !point.judged.risk.is_asked() || point.is_sampled();
        let points: Vec<Point> = self.points.iter().filter(counts).copied().collect();
        let gap = |pair: &[Point]| {
            let inside = |[from, to]: &[Time; 2]| *from <= pair[0].interval && pair[1].interval <= *to;
            self.windows.iter().any(inside).then(|| pair[1].interval - pair[0].interval)
        };
        points.windows(2).filter_map(gap).max().unwrap_or_default()
    }

    /// The point of the greatest utilization.
    pub fn worst(&self, case: &Case) -> Option<&Point> {
        self.points.iter().max_by(|a, b| utilization(case, a).total_cmp(&utilization(case, b)))
    }

    /// Room on either side of an interval, like the room of the [`Recommended`] interval; `None` if it lies in no window.
    pub fn room_beside(&self, interval: Time) -> Option<Time> {
        let around = self.windows.iter().find(|[from, to]| (*from..=*to).contains(&interval));
        around.map(|&[from, to]| (interval - from).min(to - interval))
    }

    /// The interval of an option that fires the rows and their holes as the sweep does.
    pub fn interval_of(&self, delay: &DelayOption) -> Option<Time> {
        delay.timing.interval_in(&self.order).filter(|_| delay.hole_timing.is_same(&self.holes))
    }

    /// The point of the recommended interval.
    pub fn best(&self) -> Option<&Point> {
        let interval = self.recommended?.interval;
        self.points.iter().find(|point| point.interval == interval)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::ValueWithError;
    use crate::study::as_planned::cover::Cover;
    use crate::verdict::PerQuantity;

    /// Tries a shelter with the height `height` [m] at an interval [ms] and a limit of 1 m, at first every `step` [ms] up to 20 ms.
    fn tried(step: f64, height: impl Fn(f64) -> f64) -> Vec<[Time; 2]> {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml")
            .replace("flight_height_m = 2.35", "flight_height_m = 1");
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let point = |at: Time| {
            let value = height(at.ms());
            let verdict = if value > 1.0 { Verdict::Fail } else { Verdict::Pass };
            let height = ValueWithError { value, error: 0.0 };
            let planned = ShotSummary {
                verdict,
                values: PerQuantity {
                    height,
                    force: ValueWithError::default(),
                    drift: ValueWithError::default(),
                },
                cover: Cover::NONE,
            };
            Point { interval: at, judged: BriefJudgement::of_planned_alone(&case, planned), is_quick: true }
        };
        let count = (20.0 / step) as i64;
        let mut points: Vec<Point> = (0..=count).map(|n| point(Time::from_ms(n as f64 * step))).collect();
        loop {
            let next = midpoints(&case, &points);
            if next.is_empty() {
                return find_windows(&case, &points);
            }
            points.extend(next.into_iter().map(point));
            points.sort_by_key(|point| point.interval);
        }
    }

    /// Whether any window contains the interval `at` [ms].
    fn hold(windows: &[[Time; 2]], at: f64) -> bool {
        windows.iter().any(|[from, to]| (*from..=*to).contains(&Time::from_ms(at)))
    }

    #[test]
    fn a_peak_between_two_points_that_pass_is_found() {
        let peak = |at: f64| (1.05 - (at - 10.125_f64).abs()).max(0.5);
        for step in [0.25, 5.0] {
            let windows = tried(step, peak);
            assert!(!hold(&windows, 10.125) && !hold(&windows, 10.09), "{windows:?}");
            assert!(hold(&windows, 9.5) && hold(&windows, 10.9), "{windows:?}");
        }
    }

    #[test]
    fn an_edge_is_a_point_that_passes_close_to_one_that_does_not() {
        let windows = tried(5.0, |at| 0.1 * at);
        let [from, to] = windows[0];
        assert!(from == Time::ZERO && to <= Time::from_ms(10.0) && to > Time::from_ms(9.9), "{windows:?}");
    }

    #[test]
    fn the_recommended_interval_is_deep_and_not_a_minimum_in_a_narrow_window() {
        // Utilization 0.1 from 2 to 2.4 ms, 0.6 from 5 to 11.8 ms; elsewhere it exceeds the limit.
        let height = |at: f64| match at {
            2.0..=2.4 => 0.1,
            5.0..=11.8 => 0.6,
            _ => 1.5,
        };
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml")
            .replace("flight_height_m = 2.35", "flight_height_m = 1");
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let points: Vec<Point> = (0..=150)
            .map(|n| {
                let value = height(0.1 * f64::from(n));
                let verdict = if value > 1.0 { Verdict::Fail } else { Verdict::Pass };
                let height = ValueWithError { value, error: 0.0 };
                let planned = ShotSummary {
                    verdict,
                    values: PerQuantity {
                        height,
                        force: ValueWithError::default(),
                        drift: ValueWithError::default(),
                    },
                    cover: Cover::NONE,
                };
                Point {
                    interval: Time::from_nanoseconds(i64::from(n) * 100_000),
                    judged: BriefJudgement::of_planned_alone(&case, planned),
                    is_quick: true,
                }
            })
            .collect();
        let windows = find_windows(&case, &points);
        let recommended = recommend(&case, &points, &windows).expect("two windows");
        // A window begins and ends a point before the limit. The middle of 5.1 to 11.7 ms is no whole number of milliseconds.
        assert_eq!((recommended.interval, recommended.room), (Time::from_ms(8.0), Time::from_ms(2.9)));
        assert_eq!(recommended.utilization, 0.6);
        // From 2.1 to 2.3 ms there is no whole millisecond.
        let narrow = recommend(&case, &points, &[[2.1, 2.3].map(Time::from_ms)]).expect("a window");
        assert_eq!(narrow.interval, Time::from_ms(2.2));
    }
}
