//! Runs of one option of one plan, with or without an effect: the planned shot and its first samples.

use std::borrow::Cow;
use std::time::Instant;

use super::{FIRST_SAMPLES, LEAST_RELATIVE_CHANGE, Spread, relative};
use crate::scene::Shot;
use crate::study::as_planned::check_many::or_failed_run;
use crate::study::as_planned::quick_check::quick_check;
use crate::study::samples::run_sample::{ShotToSample, run_sample_once};
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::percentiles;
use crate::study::{Case, Context, NoResult, ShotSummary};
use crate::verdict::{Limits, PerQuantity, Quantity, Verdict};

/// One option of one plan.
pub(super) struct OptionRuns {
    /// Side of the limits on which the planned shot lies.
    pub(super) verdict: Verdict,
    /// The first samples; only the planned shot if there are no samples.
    pub(super) runs: Vec<TimedRun>,
}

/// The values and the computing time of one run.
pub(super) struct TimedRun {
    /// Peaks of the quantities [SI unit]; infinite if the run failed.
    values: PerQuantity<f64>,
    /// Computing time [s].
    wall: f64,
}

impl OptionRuns {
    /// The spread of a quantity over the first `count` runs.
    pub(super) fn spread(&self, quantity: Quantity, count: usize) -> Spread {
        let values = self.runs[..count].iter().map(|run| *run.values.get(quantity));
        let [median, p95] = percentiles(values, [0.5, 0.95]).unwrap_or([f64::INFINITY; 2]);
        Spread { median, p95 }
    }

    /// Median computing time of the first `count` runs [s].
    pub(super) fn median_time(&self, count: usize) -> f64 {
        percentiles(self.runs[..count].iter().map(|run| run.wall), [0.5]).map_or(f64::NAN, |[median]| median)
    }
}

/// If [`FIRST_SAMPLES`] fall to both sides with equal chance, at least so many fall to one side with a probability of 0.6 %.
const CLEAR_MAJORITY: usize = 14;

/// Whether more samples may change the result of an effect on a quantity with a limit. There is doubt if a change is unknown. Otherwise the
/// result is sure in these cases:
///
/// - A clear majority of the changes is above [`LEAST_RELATIVE_CHANGE`]. Then the median is above, too.
/// - A clear majority is below −[`LEAST_RELATIVE_CHANGE`], and no change is positive. Then the median is below, too, and the effect only
///   lowers the quantity.
/// - A clear majority is not below, and the greatest change is farther from [`LEAST_RELATIVE_CHANGE`] than the changes are from one
///   another. Then neither the median nor the 95th percentile is beyond.
pub(super) fn is_in_doubt(without: &OptionRuns, with: &OptionRuns, limits: &Limits) -> bool {
    let is_unclear = |quantity: Quantity| {
        let pairs = without.runs.iter().zip(&with.runs);
        let changes: Vec<f64> =
            pairs.map(|(a, b)| relative(*a.values.get(quantity), *b.values.get(quantity))).collect();
        let count = |is: &dyn Fn(f64) -> bool| changes.iter().filter(|change| is(**change)).count();
        let above = count(&|change| change > LEAST_RELATIVE_CHANGE);
        let below = count(&|change| change < -LEAST_RELATIVE_CHANGE);
        let least = changes.iter().copied().fold(f64::INFINITY, f64::min);
        let most = changes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match () {
            () if changes.iter().any(|change| change.is_nan()) => true,
            () if above >= CLEAR_MAJORITY => false,
            () if below >= CLEAR_MAJORITY => most > 0.0,
            () => below + CLEAR_MAJORITY > changes.len() || most + (most - least) >= LEAST_RELATIVE_CHANGE,
        }
    };
    Quantity::ALL.into_iter().filter(|&quantity| limits.get(quantity).is_some()).any(is_unclear)
}

/// Time after the last hole for which a shelter without friction is computed [s], because it never comes to rest. A tire launched at 6 m/s
/// lands after 1.2 s.
const WITHOUT_FRICTION: f64 = 3.0;

/// The case, with a fixed end of its runs if the tires never come to rest. The end depends on this option alone.
fn followed<'c>(case: &'c Case, shot: &Shot) -> Cow<'c, Case> {
    if case.plan.ground.friction > 0.0 || case.plan.simulation.duration_s.is_some() {
        return Cow::Borrowed(case);
    }
    let last = shot.firings.last().map_or(0.0, |firing| firing.time);
    Cow::Owned(case.with_duration(Some(last + WITHOUT_FRICTION)))
}

/// Checks the planned shot of an option coarsely and takes its first samples.
pub(super) fn measure_option(context: &Context<'_>, option: usize) -> Result<OptionRuns, NoResult> {
    let &Context { case, sampling, .. } = context;
    let shot = &case.shots[option];
    let followed = &*followed(case, shot);
    let begun = Instant::now();
    let as_planned = or_failed_run(quick_check(&context.with_case(followed), shot))?;
    let verdict = verdict_of_values(&as_planned, followed);
    let runs = match sampling {
        Some(sampling) => {
            let first = 0..FIRST_SAMPLES.min(sampling.most);
            first.map(|number| time_sample(context, option, number, &sampling)).collect::<Result<_, _>>()?
        }
        None => {
            let values = PerQuantity::from_fn(|quantity| as_planned.get(quantity).value);
            vec![TimedRun { values, wall: begun.elapsed().as_secs_f64() }]
        }
    };
    Ok(OptionRuns { verdict, runs })
}

/// Takes one sample of an option, with its computing time.
pub(super) fn time_sample(
    context: &Context<'_>,
    option: usize,
    number: usize,
    sampling: &Sampling,
) -> Result<TimedRun, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let shot = &case.shots[option];
    let case = &*followed(case, shot);
    let target = ShotToSample::new(case, shot, compute, *sampling);
    let begun = Instant::now();
    let run = run_sample_once(&target, number, control)?.run;
    let values = PerQuantity::from_fn(|quantity| run.get(quantity));
    Ok(TimedRun { values, wall: begun.elapsed().as_secs_f64() })
}

/// Side of the limits on which a shot lies. A run that ends early counts by its values, because tires without friction never come to rest.
fn verdict_of_values(summary: &ShotSummary, case: &Case) -> Verdict {
    let shown = summary.as_far_as_shown();
    let utilization = |errors: f64| shown.with_errors(errors).utilization(&case.limits);
    match (utilization(1.0) <= 1.0, utilization(-1.0) > 1.0) {
        _ if summary.verdict == Verdict::Fail => Verdict::Fail,
        (true, _) => Verdict::Pass,
        (_, true) => Verdict::Fail,
        _ => Verdict::Undecided,
    }
}
