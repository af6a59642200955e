//! Windows of passing intervals, the gaps in them to halve, and the interval deepest inside a window.

use super::{GAP, Point, Recommended, are_apart, passes, utilization};
use crate::plan::Time;
use crate::study::Case;

/// Gaps as narrow as this are not halved: an eighth of [`GAP`].
const NARROWEST: Time = Time::from_nanoseconds(31_250);

/// Factor on the errors of two points with which the limits must be out of reach between them. With it, 0.03 % of the intervals
/// checked inside windows fail (`benches/RESULTS.md`).
const CALM_ERROR_FACTOR: f64 = 1.0;

/// Greatest room that counts for a recommended interval: more than detonators scatter.
const ENOUGH_ROOM: Time = Time::from_nanoseconds(10_000_000);

/// Middles of the gaps to halve.
pub(super) fn midpoints(case: &Case, points: &[Point]) -> Vec<Time> {
    let halved = |&n: &usize| {
        let (a, b) = (&points[n], &points[n + 1]);
        let wider_than = |gap| are_apart(a.interval, b.interval, gap);
        let count = usize::from(passes(a)) + usize::from(passes(b));
        let wanted = match count {
            0 => false,
            1 => true,
            _ => !is_calm(case, points, n),
        };
        wider_than(NARROWEST) && (wanted || count > 0 && wider_than(GAP))
    };
    let middle = |n: usize| points[n].interval.middle(points[n + 1].interval);
    (0..points.len().saturating_sub(1)).filter(halved).map(middle).collect()
}

/// Whether no interval in the gap after point `n` can reach a limit, as far as its neighbors show.
fn is_calm(case: &Case, points: &[Point], n: usize) -> bool {
    let slope = |pair: &[Point]| {
        let change = (utilization(case, &pair[1]) - utilization(case, &pair[0])).abs();
        change / (pair[1].interval - pair[0].interval).seconds()
    };
    let near = &points[n.saturating_sub(1)..points.len().min(n + 3)];
    let steepest = near.windows(2).map(slope).fold(0.0, f64::max);
    let width = (points[n + 1].interval - points[n].interval).seconds();
    let highest =
        |point: &Point| point.judged.planned.with_errors(CALM_ERROR_FACTOR).utilization(&case.limits);
    highest(&points[n]).max(highest(&points[n + 1])) + steepest * width <= 1.0
}

/// Utilization of the planned shot with the errors added.
pub(super) fn utilization_with_errors(case: &Case, point: &Point) -> f64 {
    point.judged.planned.with_errors(1.0).utilization(&case.limits)
}

/// The windows of intervals whose planned shots pass.
pub(super) fn find_windows(case: &Case, points: &[Point]) -> Vec<[Time; 2]> {
    let joined = |n: usize| {
        let (a, b) = (&points[n], &points[n + 1]);
        passes(a) && passes(b) && !are_apart(a.interval, b.interval, GAP) && is_calm(case, points, n)
    };
    let mut windows: Vec<[Time; 2]> = Vec::new();
    for n in (0..points.len()).filter(|&n| passes(&points[n])) {
        match windows.last_mut() {
            Some(window) if n > 0 && joined(n - 1) => window[1] = points[n].interval,
            _ => windows.push([points[n].interval; 2]),
        }
    }
    windows
}

/// The interval deepest inside a window of planned shots, by their utilization with errors.
pub(super) fn recommend(case: &Case, points: &[Point], windows: &[[Time; 2]]) -> Option<Recommended> {
    deepest(points, windows, |point| utilization_with_errors(case, point), |_| true)
}

/// The interval and the room r around it for which r × (1 − greatest utilization within r) is greatest. Whole milliseconds come
/// first, because electronic detonators are programmed in whole milliseconds. If none lies inside a window, all intervals count.
pub(super) fn deepest(
    points: &[Point],
    windows: &[[Time; 2]],
    utilization_of: impl Fn(&Point) -> f64,
    may_be_recommended: impl Fn(&Point) -> bool,
) -> Option<Recommended> {
    let whole = |point: &Point| point.interval.is_whole_milliseconds() && may_be_recommended(point);
    deepest_of(points, windows, &utilization_of, &whole)
        .or_else(|| deepest_of(points, windows, &utilization_of, &may_be_recommended))
}

fn deepest_of(
    points: &[Point],
    windows: &[[Time; 2]],
    utilization_of: &dyn Fn(&Point) -> f64,
    may_be_recommended: &dyn Fn(&Point) -> bool,
) -> Option<Recommended> {
    let mut best: Option<(f64, Recommended)> = None;
    for &[from, to] in windows {
        let first = points.partition_point(|point| point.interval < from);
        let inside = &points[first..points.partition_point(|point| point.interval <= to)];
        for (n, &Point { interval, .. }) in
            inside.iter().enumerate().filter(|(_, point)| may_be_recommended(point))
        {
            let most = ENOUGH_ROOM.min(interval - from).min(to - interval);
            let (mut low, mut high, mut greatest) = (n, n, utilization_of(&inside[n]));
            // The room grows point by point, to the nearer point first.
            loop {
                let left = low.checked_sub(1).map(|n| interval - inside[n].interval);
                let right = inside.get(high + 1).map(|point| point.interval - interval);
                let next = left.into_iter().chain(right).min();
                let room = next.map_or(most, |next| next.min(most));
                // The points at the end of the room count, too.
                if left.is_some_and(|left| left <= room) {
                    low -= 1;
                    greatest = greatest.max(utilization_of(&inside[low]));
                }
                if right.is_some_and(|right| right <= room) {
                    high += 1;
                    greatest = greatest.max(utilization_of(&inside[high]));
                }
                let score = room.seconds() * (1.0 - greatest);
                if best.is_none_or(|(least, _)| score > least) && score > 0.0 {
                    best = Some((score, Recommended { interval, room, utilization: greatest, thin: None }));
                }
                if next.is_none_or(|next| next > room) {
                    break;
                }
            }
        }
    }
    best.map(|(_, recommended)| recommended)
}
