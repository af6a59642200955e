//! Expected cost of what is still to be computed: the expected number of runs, times the measured time of one run of this plan on
//! this machine.

use std::time::Duration;

use super::Case;
use super::as_planned::check::CheckedShot;
use super::judge::Judgement;
use super::judge::one_dud::expected_dud_samples;
use super::samples::run_sample::steps_of_sample;
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::{RISK_OF_USUAL, USUAL_OF_PASS};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// Samples that a full verdict with its fresh draws usually takes.
pub const RUNS_OF_VERDICT: usize = 1200;
/// Runs with one hole left out that a verdict usually takes.
const RUNS_OF_DUDS: usize = 600;

/// Runs that an option is expected to take before its verdict (samples and duds), if `drawn` samples are there.
pub fn samples_to_come(case: &Case, drawn: usize) -> usize {
    let duds = if case.plan.limits.withstands_one_dud { RUNS_OF_DUDS } else { 0 };
    RUNS_OF_VERDICT.saturating_sub(drawn).max(Sampling::OF_VERDICT.least) + duds
}

/// Runs that an option is still expected to take before its verdict is final: samples, duds and fresh draws. `judged` is its
/// judgement so far.
pub fn runs_to_come(case: &Case, shot: &Shot, judged: Option<&Judgement>) -> usize {
    let Sampling { least, most, .. } = Sampling::OF_VERDICT;
    let usual = (USUAL_OF_PASS as f64 * RISK_OF_USUAL / case.limits.accepted_risk) as usize;
    let (usual, holes) = (usual.clamp(least, most), shot.firings.len());
    let sampled = judged.and_then(|judged| judged.sampled.known());
    let drawn = sampled.map_or(0, |sampled| sampled.samples.len());
    let mut duds = if judged.is_some_and(|judged| judged.one_dud.is_some()) { 0 } else { holes };
    if judged.is_some_and(|judged| judged.verdict() == Verdict::Fail) {
        return least.saturating_sub(drawn) + duds;
    }
    if duds > 0 {
        duds += expected_dud_samples(case, shot);
    }
    // The second option shares the error probability with the first, so it takes more draws.
    let fresh = if case.shots.len() > 1 { usual + usual / 2 } else { 0 };
    let is_sampled = sampled.is_some_and(|sampled| Sampling::OF_VERDICT.is_complete(sampled));
    match judged.map(Judgement::grounds).filter(|_| is_sampled) {
        Some(grounds) if grounds.awaits_confirmation() || grounds.awaits_one_dud() => duds + fresh,
        Some(_) => duds,
        None => usual.max(2 * drawn).min(most) - drawn.min(most) + duds + fresh,
    }
}

/// The expected time of so many runs on `threads` threads, measured on one checked shot.
pub fn time_of_runs(case: &Case, checked: &CheckedShot, runs: usize, threads: usize) -> Duration {
    let per_step = checked.wall.as_secs_f64() / checked.steps.max(1) as f64;
    let steps = steps_of_sample(case, &checked.compute, checked.end.time);
    // A sample has no mirror image, so all its tires are computed.
    let whole = case.scene().mass.len() as f64 / case.modelled_tires(checked.compute.method).max(1) as f64;
    Duration::from_secs_f64(runs as f64 * per_step * steps * whole / threads.max(1) as f64)
}
