//! Schema `shelter.sweep/1`.

use serde::Serialize;

use super::{LimitsObject, SampledValues, Values};
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
    #[serde(flatten)]
    values: Values,
    #[serde(flatten)]
    sampled: SampledValues,
}

impl IntervalResult {
    fn of(point: &Point) -> Self {
        let sampled = SampledValues::of(point.planned.verdict, point.risk.known());
        Self { interval_s: point.interval, values: Values::of(point.verdict(), &point.planned), sampled }
    }
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
            partial: *partial,
            order: row_names(case, &sweep.order),
            limits: LimitsObject::of(case),
            points: sweep.points.iter().map(IntervalResult::of).collect(),
            nominal_windows_s: sweep.windows_as_planned.clone(),
            windows_s: sweep.windows.clone(),
            largest_gap_s: sweep.largest_gap(),
            recommended_s: sweep.recommended.map(|recommended| recommended.interval),
            recommended_room_s: sweep.recommended.map(|recommended| recommended.room),
            worst: sweep.worst(case).map(IntervalResult::of),
        }
    }
}
