//! Runs of one option of one plan, with an effect or without it: the shot as planned, and its first samples.

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
    /// On which side of the limits the shot as planned lies.
    pub(super) verdict: Verdict,
    /// The first samples; without samples the shot as planned alone.
    pub(super) runs: Vec<TimedRun>,
}

/// What one run gave, and how long it took.
pub(super) struct TimedRun {
    /// Its greatest values [SI]; infinite where it failed.
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

/// Of [`FIRST_SAMPLES`] that fall to either side alike, so many or more fall to one side with a probability of 0.6 %.
const CLEAR_MAJORITY: usize = 14;

/// Whether more samples may tell something else of an effect on a quantity that has a limit.
///
/// - Where a clear majority of the changes is above [`LEAST_RELATIVE_CHANGE`], the median is.
/// - Where a clear majority is below −[`LEAST_RELATIVE_CHANGE`], the median is; that the effect only lowers the quantity is sure if
///   none rises.
/// - Else neither the median nor the 95th percentile is beyond, if no clear minority is below, and if all changes are farther from
///   [`LEAST_RELATIVE_CHANGE`] than they are from one another.
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

/// Time after the last hole over which a shelter without friction is followed [s]: it never comes to rest. A tire launched at 6 m/s
/// is down again after 1.2 s.
const WITHOUT_FRICTION: f64 = 3.0;

/// The case, with an end of its runs where nothing comes to rest: what holds for an option depends on no other.
fn followed<'c>(case: &'c Case, shot: &Shot) -> Cow<'c, Case> {
    if case.plan.ground.friction > 0.0 || case.plan.simulation.duration_s.is_some() {
        return Cow::Borrowed(case);
    }
    let last = shot.firings.last().map_or(0.0, |firing| firing.time);
    Cow::Owned(case.with_duration(Some(last + WITHOUT_FRICTION)))
}

/// Screens an option as planned, and takes its first samples.
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

/// Takes the sample of this number of an option.
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

/// On which side of the limits a shot lies. A run that ends early counts by its values: without friction none comes to rest.
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
