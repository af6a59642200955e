//! How often each option fails when detonators, launches and friction scatter from shot to shot.
//!
//! A sample draws the firing time of every hole (normal about the nominal time), every launch velocity (lognormal, with the
//! planned mean) and the friction (uniform over its range). Holes are independent. The numbers of a sample follow from the
//! seed, its option and its number alone, so they do not depend on threads or shares.
//!
//! A sample is run once, at the first step of the accuracy level. The nominal shot is refined as `check` does; its error
//! stands for the error of the samples. A sample nearer to a limit than this error is refined as `check` does, too.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, LogNormal, Normal};
use serde::{Deserialize, Serialize};

use super::batch::{each, envelopes};
use super::certainty::{LOOK_EVERY, certain};
use super::check::check_shot;
use super::reason::{Reason, find_reasons};
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, Shard};
use crate::outcome::Peak;
use crate::plan::Uncertainty;
use crate::scene::{Firing, Shot, fire_at_s};
use crate::verdict::{Estimate, Verdict};

/// One sample of one option.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Index of the delay option.
    pub option: usize,
    /// Number of the sample, from 0.
    pub number: usize,
    /// Verdict, height, force and drift.
    pub envelope: Envelope,
}

/// Number of samples of each option, their seed, and when to stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sampling {
    /// Number of samples of each option.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Bound on the failure probability; an option stops once it surely lies on one side of the bound. `None`: all samples are
    /// drawn.
    pub certain_at: Option<f64>,
}

/// Draws and judges the samples of every option; only the share `shard` of them.
pub fn scatter(
    case: &Case,
    spec: &Uncertainty,
    sampling: &Sampling,
    shard: Shard,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Vec<Sample>> {
    if sampling.certain_at.is_some() && shard != Shard::WHOLE {
        return Err(NoResult::SharedUntilCertain);
    }
    let options: Vec<usize> = (0..case.shots.len()).collect();
    let errors = each(&options, progress, |&option| {
        let checked = check_shot(case, &case.shots[option], compute, &mut |_| progress.flow())
            .map_err(|failure| progress.no_result(failure))?;
        // From the first step to the last, the error falls at least with the square of the step.
        let coarser = (compute.first_step(case) / checked.step).powi(2).max(1.0);
        let relative = |of: Estimate| if of.value > 0.0 { of.error / of.value * coarser } else { 0.0 };
        Ok([relative(checked.height), relative(checked.force), relative(checked.drift)])
    })?;
    let Some(errors) = errors.into_iter().collect::<Option<Vec<_>>>() else {
        return Ok(Found { value: Vec::new(), partial: true });
    };
    let judge_one = |&(option, number): &(usize, usize)| {
        let shot = drawn(&case.shots[option], spec, sampling.seed, option, number);
        judge_sample(case, &shot, &errors[option], compute, progress)
    };
    let judge = |jobs: Vec<(usize, usize)>| -> Finding<Vec<Sample>> {
        let envelopes = envelopes(&jobs, progress, judge_one)?;
        let partial = envelopes.contains(&None);
        let sample = |((option, number), envelope): (_, Option<Envelope>)| {
            envelope.map(|envelope| Sample { option, number, envelope })
        };
        Ok(Found { value: jobs.into_iter().zip(envelopes).filter_map(sample).collect(), partial })
    };
    if sampling.certain_at.is_none() {
        let all = itertools::iproduct!(options, 0..sampling.samples);
        return judge(all.filter(|&(_, number)| shard.has(number)).collect());
    }
    let mut all = Found { value: Vec::new(), partial: false };
    for option in options {
        let mut samples: Vec<Sample> = Vec::new();
        while samples.len() < sampling.samples
            && certain_verdict(&samples, sampling.certain_at) == Verdict::Undecided
        {
            let from = samples.len();
            let next = from..(from + LOOK_EVERY).min(sampling.samples);
            let judged = judge(next.map(|number| (option, number)).collect())?;
            samples.extend(judged.value);
            if judged.partial {
                all.partial = true;
                break;
            }
        }
        all.value.extend(samples);
    }
    Ok(all)
}

/// The certain verdict on the samples of one option, given the bound; undecided where none is certain, or no bound is given.
fn certain_verdict(samples: &[Sample], bound: Option<f64>) -> Verdict {
    let failures = samples.iter().filter(|sample| sample.envelope.verdict != Verdict::Pass).count();
    bound.map_or(Verdict::Undecided, |bound| certain(failures, samples.len(), bound))
}

/// The verdict on all options: a pass where no sample fails, or where surely fewer fail than `sampling.certain_at`.
pub fn verdict(case: &Case, sampling: &Sampling, samples: &[Sample]) -> Verdict {
    Verdict::worst((0..case.shots.len()).map(|option| summary(samples, option)).map(|summary| {
        if let Some(bound) = sampling.certain_at {
            return certain(summary.failures, summary.samples, bound);
        }
        match (summary.samples > 0 && summary.failures == 0, summary.failures > summary.undecided) {
            (true, _) => Verdict::Pass,
            (_, true) => Verdict::Fail,
            _ => Verdict::Undecided,
        }
    }))
}

/// Judges a sample by one run, or by a whole check where the run is too near to a limit.
fn judge_sample(
    case: &Case,
    shot: &Shot,
    relative_error: &[f64; 3],
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Envelope, NoResult> {
    let settings = case.settings(compute.method, compute.first_step(case));
    let reason = |failure| progress.no_result(failure);
    let outcome = case.model.run(shot, &settings, &mut |_| progress.flow()).map_err(reason)?;
    let estimate = |peak: Peak, relative: f64| {
        let Peak { value, at, index } = peak;
        Estimate { value, error: value * relative, at, index }
    };
    let [height, force, drift] = *relative_error;
    let estimates =
        [estimate(outcome.height, height), estimate(outcome.force, force), estimate(outcome.drift, drift)];
    let reasons = find_reasons(case, shot, &outcome, estimates);
    let verdict = Verdict::worst(reasons.iter().map(Reason::verdict));
    let too_near = |reason: &Reason| matches!(reason, Reason::Limit { verdict: Verdict::Undecided, .. });
    if verdict == Verdict::Undecided && reasons.iter().any(too_near) && compute.step.is_none() {
        let checked = check_shot(case, shot, compute, &mut |_| progress.flow()).map_err(reason)?;
        return Ok(Envelope::of(&checked));
    }
    Ok(Envelope::new(verdict, estimates))
}

/// Draws sample `number` of a nominal shot.
pub fn drawn(nominal: &Shot, spec: &Uncertainty, seed: u64, option: usize, number: usize) -> Shot {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(((option as u64) << 40) | number as u64);
    let sigma = (1.0 + (spec.launch_cv_percent * 1e-2).powi(2)).ln().sqrt();
    let launch = LogNormal::new(-0.5 * sigma * sigma, sigma).ok();
    let [low, high] = spec.friction;
    let friction = Some(low + (high - low) * random.random::<f64>());
    let mut firings: Vec<Firing> = nominal
        .firings
        .iter()
        .map(|firing| {
            let late = Normal::new(0.0, spec.delay.deviation(firing.at)).ok();
            let late = late.map_or(0.0, |late| late.sample(&mut random));
            let factor = launch.map_or(1.0, |launch| launch.sample(&mut random));
            Firing { at: firing.at + late, launch: firing.launch * factor, ..*firing }
        })
        .collect();
    // No firing may be before the start; only differences of firing times matter.
    let first = firings.iter().map(|firing| firing.at).fold(0.0, f64::min);
    firings.iter_mut().for_each(|firing| firing.at -= first);
    Shot { friction, ..Shot::from_firings(firings) }
}

/// The 95 % Wilson interval of a probability, from `hits` in `trials`.
pub fn wilson(hits: usize, trials: usize) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    let (k, n) = (hits as f64, trials as f64);
    if trials == 0 {
        return [0.0, 1.0];
    }
    let centre = (k + 0.5 * Z * Z) / (n + Z * Z);
    let half = Z / (n + Z * Z) * (k * (n - k) / n + 0.25 * Z * Z).sqrt();
    let low = if hits == 0 { 0.0 } else { centre - half };
    let high = if hits == trials { 1.0 } else { centre + half };
    [low, high]
}

/// Summary of the samples of one option.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that do not pass.
    pub failures: usize,
    /// Number of those failures that stay undecided.
    pub undecided: usize,
    /// 95 % interval of the failure probability.
    pub interval: [f64; 2],
    /// Median, 95th percentile and greatest height [m].
    pub height: [f64; 3],
    /// Median, 95th percentile and greatest force [N].
    pub force: [f64; 3],
}

/// Summarises the samples of one option; `samples` may be in any order.
pub fn summary(samples: &[Sample], option: usize) -> Summary {
    let mine: Vec<&Envelope> =
        samples.iter().filter(|sample| sample.option == option).map(|sample| &sample.envelope).collect();
    let count = |verdict: Verdict| mine.iter().filter(|envelope| envelope.verdict == verdict).count();
    let failures = mine.len() - count(Verdict::Pass);
    Summary {
        samples: mine.len(),
        failures,
        undecided: count(Verdict::Undecided),
        interval: wilson(failures, mine.len()),
        height: percentiles(mine.iter().map(|envelope| envelope.height.value).collect()),
        force: percentiles(mine.iter().map(|envelope| envelope.force.value).collect()),
    }
}

fn percentiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let rank = (share * values.len() as f64).ceil() as usize;
        values.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
    };
    [at(0.5), at(0.95), at(1.0)]
}

/// Two successive blast rows that may fire in the reverse order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swap {
    /// Index of the option.
    pub option: usize,
    /// Indices of the blast rows, in the planned order.
    pub rows: [usize; 2],
    /// Planned interval between the rows [s].
    pub interval: f64,
    /// Probability that a hole of the second row fires before a hole of the first.
    pub probability: f64,
}

/// Pairs of successive rows that fire in the reverse order with a probability of at least `least`.
pub fn swaps(case: &Case, spec: &Uncertainty, least: f64) -> Vec<Swap> {
    let mut swaps = Vec::new();
    for (option, delay) in case.plan.delays.iter().enumerate() {
        let mut rows: Vec<(f64, usize)> =
            fire_at_s(&delay.timing).into_iter().enumerate().map(|(row, at)| (at, row)).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in rows.windows(2) {
            let [(early, first), (late, second)] = [pair[0], pair[1]];
            let deviation = spec.delay.deviation(early).hypot(spec.delay.deviation(late));
            if late > early && deviation > 0.0 {
                let probability = 0.5 * libm::erfc((late - early) / (deviation * std::f64::consts::SQRT_2));
                if probability >= least {
                    swaps.push(Swap { option, rows: [first, second], interval: late - early, probability });
                }
            }
        }
    }
    swaps
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wilson 1927; figures by the formula in exact arithmetic: 0 of 100 gives z²/(n + z²).
    #[test]
    fn wilson_intervals_match_known_values() {
        let [low, high] = wilson(0, 100);
        assert_eq!(low, 0.0);
        assert!((high - 0.036_993_498).abs() < 1e-9, "{high}");
        let [low, high] = wilson(50, 100);
        assert!((low - 0.403_832).abs() < 1e-5 && (high - 0.596_168).abs() < 1e-5, "{low} {high}");
    }
}
