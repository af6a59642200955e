//! Quick check of a shot that is one of thousands: it runs at coarse steps first, and no finer than its verdict needs.
//!
//! A check begins at the step of the accuracy level and refines until the verdict is sure. A quick check begins at 8 times the step
//! of the field level, and refines by [`step_error::RATIO`] until it has seen enough. It ends at the latest at the step at which a
//! check begins. A quick check does not look at nearby shots as a check does. It reports greater errors instead. If nearby steps
//! agree by chance, even these errors may leave out the truth. If the step is fixed, or too few of the coarse runs succeed, the
//! shot is checked instead.

use super::check_many::{check_summary, or_failed_run};
use super::cover::{Cover, CoverRecorder};
use super::peaks::peaks_with_rivals;
use super::shot_reason::{ShotReason, find_reasons_as_planned, with_unknown_errors};
use super::step_error;
use crate::choice::Accuracy;
use crate::outcome::Outcome;
use crate::scene::Shot;
use crate::simulation::Motion;
use crate::study::{Case, ComputeSettings, Context, Fingerprint, NoResult, ShotSummary};
use crate::verdict::{Estimate, PerQuantity, Verdict};

/// Number of steps above the first step of `field`. The coarsest step is 8 times that, with `verlet` at most 0.8 of the critical step.
const COARSER: i32 = 6;
/// Error of a quick check, over the error that a check would report for the same runs. At coarse steps the values do not yet differ
/// as line 2 of [`step_error`] says. With this factor, [`LEAST_ERROR`] and rivals, the errors leave out 0.5 % of the true heights
/// and 2 % of the forces, at 400 intervals up to 1.2 s of three rows. With the factor alone they leave out 4 and 15 %. The test
/// `errors_of_quick_checks_hold` counts them.
const ERROR_FACTOR: f64 = 2.5;
/// Least error at half the coarsest step, where a pass may end first, as a share of the value. Coarse runs may agree by chance. The least
/// error falls with the fourth power of the step: the more runs agree, the less it is chance.
const LEAST_ERROR: f64 = 0.02;
/// Factor on the error of a quick check with which a pass must still stand. This is 4.5 times the error that a check would report
/// for the same runs, half as much again as a check requires, because nothing looks at such a shot again.
const SURE_PASS: f64 = 1.8;
/// Least number of runs behind a pass: two may agree by luck.
const RUNS_OF_PASS: usize = 3;
/// Factor on the error of a quick check with which a fail must still stand. This is 3 times the error that a check would report for
/// the same runs, as much as a check requires.
const SURE_FAIL: f64 = 1.2;

/// Checks a shot at ever finer steps until it lies surely on one side of its limits.
pub fn quick_check(context: &Context<'_>, shot: &Shot) -> Result<ShotSummary, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let is_sure = |summary: &ShotSummary, runs| quick_check_is_sure(case, summary, runs);
    control.journal().recall_or(
        || Fingerprint::of(("quick check", case.fingerprint(), shot, compute)),
        || quick_check_until(context, shot, is_sure),
    )
}

/// Checks a shot quickly. If the quick check leaves the shot open, a full check follows: a shot must not stay open only because
/// steps are coarse. If its runs fail, nothing is known of the shot.
pub fn quick_or_whole_check(context: &Context<'_>, shot: &Shot) -> Result<ShotSummary, NoResult> {
    match or_failed_run(quick_check(context, shot))? {
        quick if quick.verdict != Verdict::Undecided => Ok(quick),
        _ => or_failed_run(check_summary(context, shot)),
    }
}

/// Checks a shot at ever finer steps until `enough` returns true. `enough` gets the summary of the last run and the number of runs.
pub fn quick_check_until(
    context: &Context<'_>,
    shot: &Shot,
    enough: impl Fn(&ShotSummary, usize) -> bool,
) -> Result<ShotSummary, NoResult> {
    let &Context { case, compute, control, .. } = context;
    if compute.step.is_some() {
        return check_summary(context, shot);
    }
    let last = compute.first_step(case);
    let field = ComputeSettings { accuracy: Accuracy::Field, step: None, ..compute };
    let mut step = field.first_step(case) * step_error::RATIO.powi(COARSER);
    let mut runs: Vec<Outcome> = Vec::new();
    loop {
        let is_last = step < 1.01 * last;
        let mut cover = CoverRecorder::new(case, &shot.firings, step);
        let watch = &mut |motion: &dyn Motion| {
            cover.observe(motion);
            control.keep_going()
        };
        match case.model.run(shot, &case.run_settings(compute.method, step), watch) {
            Ok(outcome) => runs.push(outcome),
            Err(failure) if failure.needs_finer_step() && !is_last => {}
            Err(failure) => return Err(control.no_result(failure)),
        }
        if is_last && runs.len() < RUNS_OF_PASS {
            return check_summary(context, shot);
        }
        if runs.len() > 1 {
            let [by_step, known] = summaries_of_runs(case, shot, &runs, cover.cover());
            if is_last || enough(&by_step, runs.len()) {
                return Ok(known);
            }
        }
        step /= step_error::RATIO;
    }
}

/// Two summaries of the last run, whose neighbors are the runs before. The first has the errors of its step. The second has the
/// verdict of the cover, too, and unknown errors where a value may still grow after the end.
fn summaries_of_runs(case: &Case, shot: &Shot, runs: &[Outcome], cover: Cover) -> [ShotSummary; 2] {
    let all: Vec<&Outcome> = runs.iter().collect();
    let (last, by_runs) = (all[all.len() - 1], peaks_with_rivals(&all, &[]));
    let least = LEAST_ERROR * (2.0 * last.step / all[0].step).powi(4);
    let estimates = PerQuantity::from_fn(|quantity| {
        let estimate = by_runs.get(quantity).times_error(ERROR_FACTOR);
        Estimate { error: estimate.error.max(least * estimate.value), ..estimate }
    });
    let reasons = find_reasons_as_planned(case, shot, last, &estimates, SURE_PASS);
    let verdict = Verdict::worst(reasons.iter().map(ShotReason::verdict));
    let known = with_unknown_errors(shot, last, &estimates);
    // A finer step changes neither the cover nor the unknown errors. So only the first summary decides on one.
    [(verdict, estimates), (cover.verdict(verdict), known)]
        .map(|(verdict, estimates)| ShotSummary::new(verdict, &estimates, cover))
}

/// Whether the values of a quick check of `runs` runs lie so far from all limits that its verdict stands.
pub fn quick_check_is_sure(case: &Case, summary: &ShotSummary, runs: usize) -> bool {
    match summary.verdict {
        Verdict::Pass => runs >= RUNS_OF_PASS,
        Verdict::Fail => summary.with_errors(-SURE_FAIL).utilization(&case.limits) > 1.0,
        Verdict::Undecided => false,
    }
}
