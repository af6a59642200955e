//! The risk of a sweep: windows worth a check, and an interval with a full verdict.
//!
//! 1. Of the intervals whose planned shots pass, some about [`MOST_SAMPLED_GAP`] apart are sampled, with the same draws at each.
//!    These draws choose; no verdict rests on them.
//! 2. A window worth a check is a row of sampled intervals whose failing share does not exceed the accepted risk. They are
//!    neighbors within one window of the planned shots. Their few samples prove no small risk.
//! 3. The interval deepest inside a window gets a full verdict. It has the largest product of its room and of the part of a limit
//!    that its samples leave, with the accepted share at the top left out. The full verdict is the verdict of `check`, with one dud
//!    if the plan asks for it, and with fresh draws that confirm it. If it does not pass, the next deepest interval is tried, at
//!    most [`MOST_FULL_VERDICTS`] in all. If it fails, the windows end there.

use std::collections::{BTreeMap, BTreeSet};

use super::windows::{deepest, find_windows};
use super::{MOST_SAMPLED_GAP, Point, Recommended, Sweep, are_apart};
use crate::plan::Time;
use crate::scene::Shot;
use crate::study::as_planned::check_many::{check_summary, or_failed_run};
use crate::study::judge::brief_judgement::{BriefJudgement, judge_chosen_shot};
use crate::study::samples::risk_summary::{RiskSummary, sample_shots_in_brief_watched};
use crate::study::samples::sample_count::Sampling;
use crate::study::standing::verdict_word::ThinPass;
use crate::study::{ComputeResult, Computed, Context, NoResult};
use crate::verdict::Verdict;

/// Greatest number of intervals that get a full verdict.
const MOST_FULL_VERDICTS: usize = 6;

/// Share of the progress after the planned shots that a few samples of many intervals take.
const SHARE_OF_FIRST_LOOK: f64 = 0.8;

/// Adds risk to a sweep of the planned shots. `plan_intervals` are the intervals of the plan's options: those in a window of
/// planned shots are among the intervals sampled.
pub fn add_risk(
    context: &Context<'_>,
    as_planned: Computed<Sweep>,
    plan_intervals: &BTreeSet<Time>,
    sampling: &Sampling,
) -> ComputeResult<Sweep> {
    let &Context { case, control, .. } = context;
    let Computed { value: mut swept, mut partial } = as_planned;
    let shot = |point: &Point| (case.shot(&swept.order, point.interval, &swept.holes), point.judged.planned);
    let chosen = choose(&swept.points, &swept.windows_as_planned, plan_intervals);
    let shots: Vec<_> = chosen.iter().map(|&n| shot(&swept.points[n])).collect();
    let first_look = sampling.for_screening().first_look();
    let looking = control.part(SHARE_OF_FIRST_LOOK);
    let intervals: Vec<Time> = chosen.iter().map(|&n| swept.points[n].interval).collect();
    let mut note = |n: usize, risk: RiskSummary| {
        control.note_sampled(intervals[n].seconds(), risk.utilization);
        control.note_trying(format!("shots at {} of {} intervals", n + 1, intervals.len()));
    };
    let sampled = sample_shots_in_brief_watched(context, &shots, &first_look, &mut note)?;
    drop(looking);
    partial |= sampled.contains(&None);
    let mut risks: BTreeMap<usize, _> = chosen.into_iter().zip(sampled).collect();
    for (n, point) in swept.points.iter_mut().enumerate() {
        let risk = risks.remove(&n).flatten().map(RiskSummary::of_first_look);
        point.judged = BriefJudgement::of_samples(case, point.judged.planned, risk);
    }
    swept.recommended = None;
    let (mut tried, mut confirmations) = (BTreeSet::new(), 0);
    let _judging = control.part(1.0);
    loop {
        swept.windows_as_planned = find_windows(case, &swept.points);
        swept.windows = windows_of(&swept.points, &swept.windows_as_planned, Point::is_accepted);
        // Nothing is recommended at a step that the user fixed.
        if tried.len() == MOST_FULL_VERDICTS || partial || context.compute.step.is_some() {
            break;
        }
        let open = |point: &Point| !tried.contains(&point.interval);
        let Some(candidate) = deepest_sampled(&swept, open) else { break };
        let Some(n) = swept.points.iter().position(|point| point.interval == candidate.interval) else {
            break;
        };
        tried.insert(candidate.interval);
        control.note_trying(format!("{} ms", candidate.interval));
        let _one = control.part(0.5);
        let shot = case.shot(&swept.order, candidate.interval, &swept.holes);
        match judge(context, &shot, sampling, swept.points[n].judged, &mut confirmations)? {
            None => partial = true,
            Some(judged) => {
                let point = &mut swept.points[n];
                (point.judged, point.is_quick) = (judged, false);
                if point.verdict() != Verdict::Pass {
                    swept.failed_full_verdict += 1;
                    continue;
                }
                // The shots of the full verdict may have a greater utilization than the shots that chose the interval.
                let in_full = judged.risk.known().map_or(0.0, |risk| risk.utilization);
                let thin = ThinPass::of_passing_shot(context, &shot)?;
                let found =
                    Recommended { utilization: candidate.utilization.max(in_full), thin, ..candidate };
                // A thin pass ranks behind a pass that is not thin.
                swept.recommended = swept.recommended.filter(|_| thin.is_some()).or(Some(found));
                if thin.is_none() {
                    break;
                }
            }
        }
    }
    // Intervals tried after a thin pass may have ended its window, or may have a greater utilization within its room.
    if let Some(thin) = swept.recommended.filter(|best| best.thin.is_some()) {
        let found = deepest_sampled(&swept, |point| point.interval == thin.interval);
        swept.recommended = found.map(|found| Recommended {
            utilization: found.utilization.max(thin.utilization),
            thin: thin.thin,
            ..found
        });
    }
    Ok(Computed { value: swept, partial })
}

/// The deepest of the sampled intervals that may be recommended, by the utilization of their samples.
fn deepest_sampled(swept: &Sweep, may_be_recommended: impl Fn(&Point) -> bool) -> Option<Recommended> {
    let drawn: Vec<Point> = swept.points.iter().filter(|point| point.is_sampled()).copied().collect();
    let used = |point: &Point| point.judged.risk.known().map_or(f64::INFINITY, |risk| risk.utilization);
    deepest(&drawn, &swept.windows, used, may_be_recommended)
}

/// The full verdict on a shot. Its planned shot gets a full check. If that does not pass, the samples that `screened` the shot
/// stay. `None` if the time was up.
fn judge(
    context: &Context<'_>,
    shot: &Shot,
    sampling: &Sampling,
    mut screened: BriefJudgement,
    confirmations: &mut usize,
) -> Result<Option<BriefJudgement>, NoResult> {
    match or_failed_run(check_summary(context, shot)) {
        Err(NoResult::OutOfTime) => Ok(None),
        Err(ended) => Err(ended),
        Ok(planned) if planned.verdict == Verdict::Pass => {
            judge_chosen_shot(context, shot, planned, sampling, confirmations)
        }
        Ok(planned) => {
            screened.planned = planned;
            Ok(Some(screened))
        }
    }
}

/// Indices of the points to sample: the plan's own intervals, both ends of each window, whole milliseconds between them, and points
/// at most [`MOST_SAMPLED_GAP`] apart. A window narrower than that gives only its first point, and only if that point is farther
/// from the last point chosen.
fn choose(points: &[Point], windows: &[[Time; 2]], plan_intervals: &BTreeSet<Time>) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::new();
    for &[from, to] in windows {
        let first = points.partition_point(|point| point.interval < from);
        let last = points.partition_point(|point| point.interval <= to) - 1;
        let is_wide = to - from >= MOST_SAMPLED_GAP;
        let is_of_plan = |n: usize| plan_intervals.contains(&points[n].interval);
        let beyond = |before: Option<&usize>, at: Time| {
            before.is_none_or(|&before| are_apart(points[before].interval, at, MOST_SAMPLED_GAP))
        };
        for n in first..=last {
            let next = points.get(n + 1).map(|point| point.interval);
            let due = match is_wide {
                true => {
                    let is_whole = points[n].interval.is_whole_milliseconds();
                    let is_due = next.is_none_or(|next| beyond(chosen.last(), next));
                    n == first || n == last || is_whole || is_due
                }
                false => n == first && beyond(chosen.last(), from),
            };
            if due || is_of_plan(n) {
                chosen.push(n);
            }
        }
    }
    chosen
}

/// Rows of sampled points that are all `accepted`, each row inside one of the windows `within`. The ends were sampled.
pub(super) fn windows_of(
    points: &[Point],
    within: &[[Time; 2]],
    accepted: impl Fn(&Point) -> bool,
) -> Vec<[Time; 2]> {
    let mut windows: Vec<[Time; 2]> = Vec::new();
    for &[from, to] in within {
        let inside = |point: &&Point| point.is_sampled() && (from..=to).contains(&point.interval);
        let mut before: Option<Time> = None;
        for point in points.iter().filter(inside) {
            let interval = point.interval;
            before = match (before, windows.last_mut()) {
                _ if !accepted(point) => None,
                (Some(before), Some(window)) if !are_apart(before, interval, MOST_SAMPLED_GAP) => {
                    window[1] = interval;
                    Some(interval)
                }
                _ => {
                    windows.push([interval; 2]);
                    Some(interval)
                }
            };
        }
    }
    windows
}
