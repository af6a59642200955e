//! The changes to try for a delay option.

use crate::plan::edit::change::Change;
use crate::plan::{Layout, Plan, Time, Timing};
use crate::ropes::catalogue;
use crate::sorting::sort_by;

/// Additional rows of ballast.
const MORE_BORDER_ROWS: [usize; 3] = [1, 2, 3];
/// Distances from the plan's slack [percentage points].
const OTHER_SLACK: [f64; 3] = [0.5, 1.0, 2.0];
/// Factors of lower launches.
const LOWER_LAUNCHES: [f64; 6] = [0.98, 0.95, 0.9, 0.85, 0.8, 0.7];
/// Distances from an option's interval [ms].
const OTHER_INTERVALS_MS: [i64; 8] = [1, 2, 3, 5, 8, 12, 17, 25];

/// The changes of a plan that may make an option pass, by kind, the smallest first. `too_much_together`: more fires within 8 ms than the
/// plan allows.
pub(super) fn find_candidates(plan: &Plan, option: usize, too_much_together: bool) -> Vec<Vec<Change>> {
    let (slack, interval) = (plan.cable.slack_percent, interval(plan, option));
    let slacks = around(slack, &OTHER_SLACK).map(Change::Slack);
    let intervals = interval.into_iter().flat_map(other_intervals);
    let intervals = intervals.map(|interval| Change::Interval { option, interval });
    if too_much_together {
        // Only other firing times can help.
        return vec![intervals.collect()];
    }
    // The cheapest kind stands first. A lower launch means a smaller charge, and an observation must then show that launch.
    vec![
        intervals.collect(),
        stronger_ropes(plan),
        stronger_terminations(plan),
        more_border_rows(plan),
        slacks.collect(),
        LOWER_LAUNCHES.map(Change::Launch).to_vec(),
    ]
}

/// Stronger ropes of the same family and grade as the plan's rope, the weakest first; none if the plan names no rope.
fn stronger_ropes(plan: &Plan) -> Vec<Change> {
    let Some(own) = plan.cable.rope.as_ref().and_then(|name| catalogue().find(name)) else {
        return Vec::new();
    };
    let alike = catalogue().ropes.iter().filter(|rope| rope.family == own.family && rope.grade == own.grade);
    let mut ropes: Vec<_> = alike.filter(|rope| rope.breaking_force_kn > own.breaking_force_kn).collect();
    sort_by(&mut ropes, |a, b| a.breaking_force_kn.total_cmp(&b.breaking_force_kn));
    ropes.into_iter().map(Change::Rope).collect()
}

/// Terminations that hold more than the plan's, the weakest first. They fit the plan's rope. If the plan names no rope, they fit every rope
/// that its own termination fits.
fn stronger_terminations(plan: &Plan) -> Vec<Change> {
    let rope = plan.cable.rope.as_ref().and_then(|name| catalogue().find(name));
    let planned = plan.cable.termination.as_ref().and_then(|name| catalogue().termination(name));
    let must_fit = match (rope, planned) {
        (Some(rope), _) => vec![rope.kind],
        (None, Some(planned)) => planned.fits.clone(),
        (None, None) => return Vec::new(),
    };
    let fits =
        catalogue().terminations.iter().filter(|known| must_fit.iter().all(|kind| known.fits.contains(kind)));
    let mut stronger: Vec<_> =
        fits.filter(|known| known.efficiency_percent > plan.cable.termination_percent).collect();
    sort_by(&mut stronger, |a, b| a.efficiency_percent.total_cmp(&b.efficiency_percent));
    stronger.into_iter().map(Change::Termination).collect()
}

/// More rows of ballast around a mesh.
fn more_border_rows(plan: &Plan) -> Vec<Change> {
    match &plan.layout {
        Layout::Grid(mesh) | Layout::Quincunx(mesh) => {
            MORE_BORDER_ROWS.map(|more| Change::BorderRows(mesh.border_rows + more)).to_vec()
        }
        Layout::List { .. } => Vec::new(),
    }
}

/// Interval of an option; `None` if its rows have their own firing times, or there is only one row.
fn interval(plan: &Plan, option: usize) -> Option<Time> {
    match plan.delays[option].timing {
        Timing::Interval { interval, .. } if plan.blast_rows.len() > 1 => Some(interval),
        Timing::Interval { .. } | Timing::At(_) => None,
    }
}

/// Intervals at each distance below and above `own`, not below 0.
fn other_intervals(own: Time) -> impl Iterator<Item = Time> {
    let millisecond = Time::from_nanoseconds(1_000_000);
    let beside = OTHER_INTERVALS_MS.into_iter().map(move |distance| millisecond * distance);
    beside.flat_map(move |distance| [own - distance, own + distance]).filter(|&at| at >= Time::ZERO)
}

/// Numbers at each distance below and above `own`, not below 0.
fn around(own: f64, distances: &[f64]) -> impl Iterator<Item = f64> {
    let beside = distances.iter().flat_map(move |distance| [own - distance, own + distance]);
    // Rounding makes 2.3 - 0.5 exactly 1.8 in the text of the plan.
    beside.filter(|&number| number >= 0.0).map(|number| (number * 1e6).round() / 1e6)
}
