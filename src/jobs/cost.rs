//! What a study will cost: the runs that it is expected to take, times the measured time of one run of this plan on this machine.

use std::time::Duration;

use crate::plan::Layout;
use crate::ropes::catalogue;
use crate::study::as_planned::check::CheckedShot;
use crate::study::question::StudyKind;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::steps_of_sample;
use crate::study::{Case, assumptions, effects, orders, search};

/// Samples that a full verdict with its fresh draws usually takes.
const OF_VERDICT: usize = 1200;
/// Runs with one hole left out that a verdict usually takes.
const OF_DUDS: usize = 600;
/// Runs of a sweep before its verdicts: as planned, and the first look at the intervals that pass. Measured on `amur-three-rows`.
const OF_SWEEP: usize = 60_000;
/// Samples that a schedule of a search takes on average.
const OF_SCHEDULE: usize = 40;
/// Schedules that a search judges in full, and the runs of each: the nearest to the limit take the most samples, and duds. Measured
/// on `amur-three-rows`.
const JUDGED_SCHEDULES: usize = 12;
const OF_JUDGED_SCHEDULE: usize = 3500;
/// Orders that are looked at closely.
const ORDERS_SAMPLED: usize = 40;
/// Runs of each shot of a combination of sizes, and combinations of which samples are drawn.
const OF_COMBINATION: usize = 4;
const COMBINATIONS_SAMPLED: usize = 6;
/// Plans that effects make: each effect, some toward several directions.
const EFFECT_PLANS: usize = 20;
/// Values that all assumptions of an option are tried at.
const VALUES_TRIED: usize = 150;
/// Runs of a fit.
const OF_FIT: usize = 6000;

/// The expected time of a study on `threads` threads, from one shot that was checked; `None` for what is no question of its own.
pub fn expected_time(
    case: &Case,
    checked: &CheckedShot,
    kind: StudyKind,
    threads: usize,
) -> Option<Duration> {
    Some(time_of_runs(case, checked, expected_runs(case, kind)?, threads))
}

/// Samples that an option is expected to take before its verdict, of which `drawn` are there.
pub fn samples_to_come(case: &Case, drawn: usize) -> usize {
    let duds = if case.plan.limits.withstands_one_dud { OF_DUDS } else { 0 };
    OF_VERDICT.saturating_sub(drawn).max(Sampling::OF_VERDICT.least) + duds
}

/// The expected time of so many runs on `threads` threads, from one shot that was checked.
pub fn time_of_runs(case: &Case, checked: &CheckedShot, runs: usize, threads: usize) -> Duration {
    let per_step = checked.wall.as_secs_f64() / checked.steps.max(1) as f64;
    let steps = steps_of_sample(case, &checked.compute, checked.end.time);
    // A sample has no mirror image: all its tires are computed.
    let whole = case.scene().mass.len() as f64 / case.modelled_tires(checked.compute.method).max(1) as f64;
    Duration::from_secs_f64(runs as f64 * per_step * steps * whole / threads.max(1) as f64)
}

fn expected_runs(case: &Case, kind: StudyKind) -> Option<usize> {
    let options = case.shots.len();
    Some(match kind {
        StudyKind::Sweep => OF_SWEEP + OF_VERDICT,
        StudyKind::Orders => {
            let tried = orders::count_orders(case, case.intervals().len()).min(search::MOST_TRIED);
            tried + ORDERS_SAMPLED * 100 + 2 * OF_VERDICT
        }
        StudyKind::Risk => options * Sampling::OF_RISK.most,
        StudyKind::Search => {
            let tried = search::count_possible(case).ok()?.min(search::MOST_TRIED);
            tried * OF_SCHEDULE + tried.min(JUDGED_SCHEDULES) * OF_JUDGED_SCHEDULE
        }
        StudyKind::Size => {
            let size = &case.plan.size;
            let borders =
                if matches!(case.plan.layout, Layout::List { .. }) { 0 } else { size.most_border_rows };
            let ropes = catalogue().ropes.iter();
            let ropes = ropes.filter(|rope| size.family.as_ref().is_none_or(|family| *family == rope.family));
            let combinations = ropes.count() * size.tire_mass_kg.len().max(1) * (borders + 1);
            combinations * options * OF_COMBINATION + COMBINATIONS_SAMPLED * OF_VERDICT
        }
        StudyKind::Effects => options * EFFECT_PLANS * effects::SAMPLES,
        // What to observe next follows from the verdicts of all options.
        StudyKind::Fit => OF_FIT + options * samples_to_come(case, 0),
        StudyKind::Assumptions => VALUES_TRIED * assumptions::SAMPLES / 2,
        _ => return None,
    })
}
