//! Schema `shelter.sweep/1`.

use serde::Serialize;

use super::{LimitsObject, SampledValues, Values};
use crate::plan::Time;
use crate::report::check::judged_inputs;
use crate::report::row_names;
use crate::study::sweep::{Point, Sweep};
use crate::study::{Case, Computed};

/// The document of one sweep.
#[derive(Serialize)]
pub struct SweepDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    judged: &'static str,
    partial: bool,
    order: Vec<String>,
    limits: LimitsObject,
    points: Vec<IntervalResult>,
    nominal_windows_s: Vec<[f64; 2]>,
    windows_s: Vec<[f64; 2]>,
    largest_gap_s: f64,
    recommended_s: Option<f64>,
    recommended_room_s: Option<f64>,
    worst: Option<IntervalResult>,
}

#[derive(Serialize)]
struct IntervalResult {
    interval_s: f64,
    /// Whether only a quick check judged the shot as planned.
    quick: bool,
    #[serde(flatten)]
    values: Values,
    #[serde(flatten)]
    sampled: SampledValues,
}

impl IntervalResult {
    fn of(point: &Point) -> Self {
        let sampled = SampledValues::of(point.planned.verdict, point.risk.known());
        let values = Values::of(point.verdict(), &point.planned);
        Self { interval_s: point.interval.seconds(), quick: point.is_quick, values, sampled }
    }
}

/// The windows that hold more than one point.
fn wider_than_a_point(windows: &[[Time; 2]]) -> Vec<[f64; 2]> {
    windows.iter().filter(|[from, to]| from < to).map(|window| window.map(Time::seconds)).collect()
}

impl SweepDocument {
    /// The document of a sweep, which is partial where the time was up.
    pub fn new(case: &Case, swept: &Computed<Sweep>) -> Self {
        let Computed { value: sweep, partial } = swept;
        Self {
            schema: "shelter.sweep/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: swept.verdict().for_scripts(),
            judged: judged_inputs(case, sweep.has_risk()),
            partial: *partial,
            order: row_names(case, &sweep.order),
            limits: LimitsObject::of(case),
            points: sweep.points.iter().map(IntervalResult::of).collect(),
            nominal_windows_s: wider_than_a_point(&sweep.windows_as_planned),
            windows_s: wider_than_a_point(&sweep.windows),
            largest_gap_s: sweep.largest_gap().seconds(),
            recommended_s: sweep.recommended.map(|recommended| recommended.interval.seconds()),
            recommended_room_s: sweep.recommended.map(|recommended| recommended.room.seconds()),
            worst: sweep.worst(case).map(IntervalResult::of),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    /// A point that passes between two that do not is no window.
    #[test]
    fn a_window_is_wider_than_a_point() {
        let plan = Plan::parse("", include_str!("../../../plans/amur-three-rows.toml"));
        let case = Case::new(plan.unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let windows =
            [[10.0, 10.0], [20.0, 30.0], [40.0, 40.0]].map(|window| window.map(Time::from_ms)).to_vec();
        let value = Sweep {
            order: vec![0, 1, 2],
            points: Vec::new(),
            windows_as_planned: windows.clone(),
            windows,
            recommended: None,
            failed_full_verdict: 0,
        };
        let document = SweepDocument::new(&case, &Computed { value, partial: false });
        assert_eq!(document.windows_s, [[0.02, 0.03]]);
        assert_eq!(document.nominal_windows_s, [[0.02, 0.03]]);
    }
}
