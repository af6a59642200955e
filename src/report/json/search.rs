//! Schema `shelter.search/1`.

use serde::Serialize;

use super::check::{CablePeakObject, Percentiles, TirePeakObject};
use super::{LimitsObject, intervals};
use crate::choice::HoleOrder;
use crate::plan::Time;
use crate::report::check::judged_inputs;
use crate::report::option_row::{OptionRow, option_rows};
use crate::report::row_names;
use crate::report::shared_columns::launch_margin_share;
use crate::report::words::no_result;
use crate::report::words::reasons;
use crate::report::words::warnings;
use crate::study::eight_ms::WithinEightMs;
use crate::study::judgement::Judgement;
use crate::study::search::{FrontPoint, Schedule, Search};
use crate::study::{Case, Computed};
use crate::verdict::Quantity;

/// The document of a search.
#[derive(Serialize)]
pub struct SearchDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    judged: &'static str,
    partial: bool,
    limits: LimitsObject,
    /// Schedules judged.
    count: usize,
    /// Schedules there are, before limits and mirror images.
    possible: usize,
    complete: bool,
    /// Best first.
    found: Vec<FoundSchedule>,
    front: Vec<FrontSchedule>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct FoundSchedule {
    name: String,
    #[serde(flatten)]
    schedule: ScheduleObject,
    fire_at_s: Vec<f64>,
    verdict: &'static str,
    reasons: Vec<String>,
    /// Failures over decided samples; null without samples.
    probability: Option<f64>,
    interval_95: Option<[f64; 2]>,
    duration_s: f64,
    holes_in_8_ms: usize,
    charge_in_8_ms_kg: Option<f64>,
    #[serde(flatten)]
    values: Option<FoundValues>,
}

#[derive(Serialize)]
struct FoundValues {
    nominal_verdict: &'static str,
    launch_margin: Option<f64>,
    flight_height_m: TirePeakObject,
    cable_force_n: CablePeakObject,
}

#[derive(Serialize)]
struct ScheduleObject {
    order: Vec<String>,
    intervals_s: Vec<f64>,
    hole_interval_s: f64,
    hole_order: HoleOrder,
}

/// A schedule of which no shorter one judged fails less, by the samples that chose it.
#[derive(Serialize)]
struct FrontSchedule {
    #[serde(flatten)]
    schedule: ScheduleObject,
    duration_s: f64,
    failures: usize,
    samples: usize,
}

impl ScheduleObject {
    fn of(case: &Case, schedule: &Schedule) -> Self {
        Self {
            order: row_names(case, &schedule.order),
            intervals_s: schedule.gaps.iter().map(|gap| gap.seconds()).collect(),
            hole_interval_s: schedule.hole_timing.interval.seconds(),
            hole_order: schedule.hole_timing.order,
        }
    }
}

impl FoundValues {
    fn of(case: &Case, judged: &Judgement) -> Self {
        let (scene, checked, sampled) = (case.scene(), &judged.checked, judged.sampled.known());
        Self {
            nominal_verdict: checked.verdict.for_scripts(),
            launch_margin: launch_margin_share(judged),
            flight_height_m: TirePeakObject::new(
                scene,
                &checked.height,
                Percentiles::of(sampled, Quantity::Height),
            ),
            cable_force_n: CablePeakObject::new(
                scene,
                &checked.force,
                Percentiles::of(sampled, Quantity::Force),
            ),
        }
    }
}

impl SearchDocument {
    /// The document of a search, which is partial where the time was up.
    pub fn new(case: &Case, searched: &Computed<Search>) -> Self {
        let Computed { value: search, partial } = searched;
        let found = |(row, schedule): (OptionRow<'_>, &Schedule)| {
            let WithinEightMs { holes, charge } = row.together();
            let judged = row.result.as_ref().ok();
            let sampled = judged.and_then(|judged| judged.sampled.known());
            FoundSchedule {
                name: row.delay.name.clone(),
                schedule: ScheduleObject::of(case, schedule),
                fire_at_s: row.delay.timing.fire_at().into_iter().map(Time::seconds).collect(),
                verdict: row.verdict().for_scripts(),
                reasons: match row.result {
                    Ok(judged) => reasons::sentences(row.case, judged),
                    Err(reason) => vec![no_result::message(reason)],
                },
                probability: sampled.and_then(|sampled| sampled.bounds.probability()),
                interval_95: judged.and_then(|judged| Some(intervals(&judged.sampled)?[0])),
                duration_s: row.shot.duration(),
                holes_in_8_ms: holes,
                charge_in_8_ms_kg: charge,
                values: judged.map(|judged| FoundValues::of(row.case, judged)),
            }
        };
        let front = |point: &FrontPoint| FrontSchedule {
            schedule: ScheduleObject::of(case, &point.schedule),
            duration_s: point.duration,
            failures: point.share.failures,
            samples: point.share.samples,
        };
        Self {
            schema: "shelter.search/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: case.verdict_on_file(searched.verdict()).for_scripts(),
            judged: judged_inputs(case, search.sampled),
            partial: *partial,
            limits: LimitsObject::of(case),
            count: search.screened,
            possible: search.possible,
            complete: search.complete,
            found: option_rows(&search.case, &search.results).zip(&search.schedules).map(found).collect(),
            front: search.front.iter().map(front).collect(),
            warnings: warnings::of_plan(case),
        }
    }
}
