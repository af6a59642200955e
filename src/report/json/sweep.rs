//! Schema `shelter.sweep/1`.

use serde::Serialize;

use super::{Limits, Values};
use crate::report::row_names;
use crate::study::Case;
use crate::study::sweep::{Point, Sweep};

/// The document of one sweep.
#[derive(Serialize)]
pub struct SweepDocument {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    order: Vec<String>,
    limits: Limits,
    points: Vec<IntervalResult>,
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
}

impl IntervalResult {
    fn of(point: &Point) -> Self {
        Self { interval_s: point.interval, values: Values::of(&point.envelope) }
    }
}

impl SweepDocument {
    /// The document of a sweep, which is partial where the time was up.
    pub fn new(case: &Case, sweep: &Sweep, partial: bool) -> Self {
        Self {
            schema: "shelter.sweep/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            order: row_names(case, &sweep.order),
            limits: Limits::of(case),
            points: sweep.points.iter().map(IntervalResult::of).collect(),
            windows_s: sweep.windows.clone(),
            largest_gap_s: sweep.largest_gap(),
            recommended_s: sweep.recommended.map(|recommended| recommended.interval),
            recommended_room_s: sweep.recommended.map(|recommended| recommended.room),
            worst: sweep.worst(case).map(IntervalResult::of),
        }
    }
}
