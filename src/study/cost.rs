//! What is still to be computed will cost: the runs that it is expected to take, times the measured time of one run of this plan on this
//! machine.

use std::time::Duration;

use super::Case;
use super::as_planned::check::CheckedShot;
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::steps_of_sample;

/// Samples that a full verdict with its fresh draws usually takes.
pub const RUNS_OF_VERDICT: usize = 1200;
/// Runs with one hole left out that a verdict usually takes.
const RUNS_OF_DUDS: usize = 600;

/// Samples that an option is expected to take before its verdict, of which `drawn` are there.
pub fn samples_to_come(case: &Case, drawn: usize) -> usize {
    let duds = if case.plan.limits.withstands_one_dud { RUNS_OF_DUDS } else { 0 };
    RUNS_OF_VERDICT.saturating_sub(drawn).max(Sampling::OF_VERDICT.least) + duds
}

/// The expected time of so many runs on `threads` threads, from one shot that was checked.
pub fn time_of_runs(case: &Case, checked: &CheckedShot, runs: usize, threads: usize) -> Duration {
    let per_step = checked.wall.as_secs_f64() / checked.steps.max(1) as f64;
    let steps = steps_of_sample(case, &checked.compute, checked.end.time);
    // A sample has no mirror image: all its tires are computed.
    let whole = case.scene().mass.len() as f64 / case.modelled_tires(checked.compute.method).max(1) as f64;
    Duration::from_secs_f64(runs as f64 * per_step * steps * whole / threads.max(1) as f64)
}
