//! The results of `sweep`; schema `shelter.sweep/1`.

use serde::Serialize;

use super::spark::sparkline;
use super::table::Style;
use crate::study::sweep::{Point, Sweep};
use crate::study::{Case, Envelope};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::Verdict;

/// The document of one sweep.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    order: Vec<String>,
    limits: super::Limits,
    points: Vec<Row>,
    windows_s: Vec<[f64; 2]>,
    worst: Option<Row>,
    best: Option<Row>,
}

/// One interval, for JSON and CSV.
#[derive(Clone, Serialize)]
pub struct Row {
    interval_s: f64,
    flight_height_m: f64,
    flight_height_error_m: f64,
    cable_force_n: f64,
    cable_force_error_n: f64,
    verdict: Verdict,
}

impl Row {
    /// Of a point.
    pub fn new(point: &Point) -> Self {
        let Point { interval, envelope } = *point;
        Self {
            interval_s: interval,
            flight_height_m: envelope.height.value,
            flight_height_error_m: envelope.height.error,
            cable_force_n: envelope.force.value,
            cable_force_error_n: envelope.force.error,
            verdict: envelope.verdict,
        }
    }
}

impl Document {
    /// Of a sweep.
    pub fn new(case: &Case, sweep: &Sweep, partial: bool) -> Self {
        Self {
            schema: "shelter.sweep/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            order: super::row_names(case, &sweep.order),
            limits: super::Limits::new(case),
            points: sweep.points.iter().map(Row::new).collect(),
            windows_s: sweep.windows(),
            worst: sweep.worst(case).map(Row::new),
            best: sweep.best(case).map(Row::new),
        }
    }
}

/// Width of the sparklines.
const SPARK: usize = 60;

/// The sweep for reading.
pub fn text(case: &Case, sweep: &Sweep, partial: bool, style: Style) -> String {
    let mut text = super::heading(case);
    let names = super::row_names(case, &sweep.order).join(", ");
    let ends = |of: fn(&[Point]) -> Option<&Point>| {
        of(&sweep.points).map_or_else(String::new, |point| units::milliseconds(point.interval))
    };
    let (from, to) = (ends(<[Point]>::first), ends(<[Point]>::last));
    text += &format!("interval between rows {names}: {from} to {to}, {} tried\n\n", sweep.points.len());
    let line = |name: &str, of: fn(&Point) -> f64, limit: f64| {
        let bars = sparkline(&evenly(&sweep.points, of), SPARK, limit);
        format!("{name:>8}  {from} {bars} {to}\n")
    };
    text += &line("height", |point| point.envelope.height.value, case.limits.height);
    text += &line("force", |point| point.envelope.force.value, case.limits.force);
    text.push('\n');
    for (name, point) in [("worst", sweep.worst(case)), ("best", sweep.best(case))] {
        if let Some(point) = point {
            let interval = units::milliseconds(point.interval);
            text += &format!("{name:>8}  {interval:>9}  {}\n", values(point, style));
        }
    }
    let windows: Vec<String> = sweep
        .windows()
        .iter()
        .map(|[from, to]| {
            format!("{} to {}", units::exact_milliseconds(*from), units::exact_milliseconds(*to))
        })
        .collect();
    let fails = sweep.points.iter().any(|point| point.envelope.verdict == Verdict::Fail);
    text += &match windows.as_slice() {
        [] if fails && !partial => format!("\n{}: no interval tried passes\n", style.verdict(Verdict::Fail)),
        [] => format!("\n{}: no interval tried surely passes\n", style.verdict(Verdict::Undecided)),
        some if partial => format!("\n{}: so far {}\n", style.verdict(Verdict::Undecided), some.join(" · ")),
        some => format!("\n{}: {}\n", style.verdict(Verdict::Pass), some.join(" · ")),
    };
    style.plain(text)
}

fn values(point: &Point, style: Style) -> String {
    let Envelope { height, force, .. } = point.envelope;
    format!(
        "{}  height {} m  force {} kN",
        style.verdict(point.envelope.verdict),
        value_and_error(height.value, height.error, Unit::Metre),
        value_and_error(force.value, force.error, Unit::Kilonewton),
    )
}

/// The values at even distances: the greatest of those nearest to each.
fn evenly(points: &[Point], of: impl Fn(&Point) -> f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let width = (last.interval - first.interval).max(f64::MIN_POSITIVE) / (SPARK - 1) as f64;
    (0..SPARK)
        .map(|n| {
            let at = first.interval + n as f64 * width;
            let near = points.iter().filter(|point| (point.interval - at).abs() <= 0.5 * width);
            let nearest = || {
                let distance = |point: &&Point| (point.interval - at).abs();
                points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map_or(0.0, &of)
            };
            near.map(&of).reduce(f64::max).unwrap_or_else(nearest)
        })
        .collect()
}
