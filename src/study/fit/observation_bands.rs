//! Samples of a plan: which values an observer could see, where the observations lie among them, and what to observe next.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::determined::{Observable, assumed_sd, observables};
use super::launch_information::{LaunchInformation, launch_information};
use super::observed_shots::{ObservedShot, ObservedShots};
use super::predictor::observe_shot;
use super::until_rest;
use crate::choice::ObservedQuantity;
use crate::plan::observations::ObservedPoint;
use crate::study::samples::random_shot::{Input, draw_shot};
use crate::study::samples::run_sample::sample_step;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::percentiles;
use crate::study::work::batch::run_batch;
use crate::study::{Case, Context, NoResult};
use crate::verdict::Quantity;

/// Least share of samples with a value that a line through them needs.
const OFTEN_KNOWN: f64 = 0.95;
/// If fewer than this share of samples have a value, the tire hardly ever lifts or lands.
const SELDOM_KNOWN: f64 = 0.05;

/// Planned value of an observed quantity, and the values that an observer could see in samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Prediction {
    /// The value in the planned shot; NaN if the tire never lifts or never lands.
    pub planned: f64,
    /// 5th and 95th percentile of the values that an observer could see, with the standard deviation of the observation. Only
    /// samples in which the tire lifts, or lands, count. NaN if it hardly ever does; `None` without samples.
    pub band: Option<[f64; 2]>,
    /// Median of the values that an observer could see; NaN if there is no band.
    pub middle: f64,
    /// Correlation of these values with the inputs that repeat in every shot. Negative if faster launches reduce the value; 0 if
    /// unknown.
    pub in_common: f64,
    /// Information of the observation about the launch, beside the other observations of its shot.
    pub of_launch: LaunchInformation,
}

/// Standard deviations from the middle to an end of a band of 90 %.
pub const TO_END_OF_BAND: f64 = 1.645;

impl Prediction {
    /// Distance of a value from the middle of the band, in standard deviations of that side, above or below. Infinite if hardly any
    /// shot has a value. Each side has its own width, because scatter of launches stretches heights upward.
    pub fn deviations(&self, value: f64) -> Option<f64> {
        let ([low, high], middle) = (self.band?, self.middle);
        let half = if value > middle { high - middle } else { middle - low };
        let deviations = TO_END_OF_BAND * (value - middle) / half;
        Some(if deviations.is_nan() { f64::INFINITY } else { deviations })
    }

    /// Whether an observed value lies in the band.
    pub fn contains(&self, value: f64) -> Option<bool> {
        self.band.map(|[low, high]| (low..=high).contains(&value))
    }
}

/// The observation that would narrow the utilization most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NextObservation {
    /// The observation.
    pub observable: Observable,
    /// Assumed standard deviation of the observation [SI unit].
    pub sd: f64,
    /// Share of the variance of the utilization that the observation would remove.
    pub share: f64,
    /// Coefficient of variation of the launch in common after a fit of the observation alone [%]; `None` if the observation hardly
    /// follows the launch.
    pub launch_percent: Option<f64>,
}

/// Values of the watched points in samples of one option, and the inputs in common of these samples.
struct Samples {
    /// Values (`n_samples` × `n_watched`).
    values: Vec<Vec<f64>>,
    /// Inputs in common (`n_samples`).
    inputs: Vec<[f64; Input::ALL.len()]>,
}

impl Samples {
    /// The n-th value as an observer could see it in each sample, with an error of standard deviation `sd`.
    fn observable_values(&self, n: usize, sd: f64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(n as u64);
        self.values.iter().map(|sample| sample[n] + sd * random.sample::<f64, _>(StandardNormal)).collect()
    }

    /// The inputs that repeat in the next shot, without the launch in common (`n_inputs` × `n_samples`).
    fn repeating_but_launch(&self) -> Vec<Vec<f64>> {
        let repeating = (0..Input::ALL.len()).filter(|&n| Input::ALL[n].repeats());
        let others = repeating.filter(|&n| Input::ALL[n] != Input::LaunchCommon);
        others.map(|n| self.inputs.iter().map(|inputs| inputs[n]).collect()).collect()
    }

    /// The logarithm of the launch in common of each sample.
    fn log_launch(&self) -> Vec<f64> {
        let launch = Input::ALL.iter().position(|input| *input == Input::LaunchCommon);
        launch.map_or_else(Vec::new, |n| self.inputs.iter().map(|inputs| inputs[n].ln()).collect())
    }
}

/// The inputs of samples that repeat in the next shot; values are regressed on them.
struct InCommon {
    /// Inputs minus their means (`n_samples` × `n_repeated`).
    centred: DMatrix<f64>,
    /// Covariance of the inputs, and its inverse.
    covariance: DMatrix<f64>,
    inverse: DMatrix<f64>,
}

impl InCommon {
    /// `None` if there are too few samples.
    fn of(drawn: &Samples) -> Option<Self> {
        let count = drawn.values.len();
        let repeated: Vec<usize> = (0..Input::ALL.len()).filter(|&n| Input::ALL[n].repeats()).collect();
        if count <= 2 * repeated.len() {
            return None;
        }
        let inputs = DMatrix::from_fn(count, repeated.len(), |n, input| drawn.inputs[n][repeated[input]]);
        let from_mean = |n, input| inputs[(n, input)] - inputs.column(input).mean();
        let centred = DMatrix::from_fn(count, repeated.len(), from_mean);
        let covariance = centred.transpose() * &centred / (count - 1) as f64;
        let inverse = covariance.clone().pseudo_inverse(1e-15).ok()?;
        Some(Self { centred, covariance, inverse })
    }

    /// The slopes of values over the inputs, and the variance of the values.
    fn regression(&self, values: &DVector<f64>) -> (DVector<f64>, f64) {
        let degrees = (values.len() - 1) as f64;
        let from_mean = values.add_scalar(-values.mean());
        let slopes = &self.inverse * (self.centred.transpose() * &from_mean) / degrees;
        (slopes, from_mean.norm_squared() / degrees)
    }

    /// Correlation of the n-th observed value with the inputs; `sd` is the standard deviation of the observation. The sign is the
    /// sign of the slope over the launch in common. `None` if some samples have no value.
    fn correlation(&self, drawn: &Samples, n: usize, sd: f64) -> Option<f64> {
        let values = DVector::from_iterator(drawn.values.len(), drawn.values.iter().map(|sample| sample[n]));
        let (slopes, variance) = self.regression(&values);
        let explained = (slopes.transpose() * &self.covariance * &slopes)[0];
        let of_launch = Input::ALL
            .iter()
            .filter(|input| input.repeats())
            .position(|input| *input == Input::LaunchCommon)?;
        let correlation = (explained / (variance + sd * sd)).sqrt().min(1.0).copysign(slopes[of_launch]);
        Some(correlation).filter(|correlation| correlation.is_finite())
    }
}

fn samples(context: &Context<'_>, shot: &ObservedShot, sampling: &Sampling) -> Result<Samples, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let numbers: Vec<usize> = (0..sampling.least).collect();
    let runs = run_batch(&numbers, control, |&number| {
        let sample = draw_shot(case, &case.shots[shot.option], sampling.seed, number);
        let settings = case.run_settings(compute.method, sample_step(&compute, &sample.scene));
        // Back to the time of the plan, in which observations are given.
        let fired = sample.shot.later_by(-sample.later).with_times(&shot.times);
        let values = observe_shot(case, Some(&sample.scene), &fired, &shot.watched, &settings, control)?;
        Ok(values.map(|values| (values, sample.inputs)))
    })?;
    if runs.contains(&None) {
        return Err(NoResult::OutOfTime);
    }
    let (values, inputs) = runs.into_iter().flatten().flatten().unzip();
    Ok(Samples { values, inputs })
}

/// Prediction of the plan for each observation. Without a `sampling` there are no bands. If firing times were measured, the bands
/// use them.
pub fn predict_observations(
    context: &Context<'_>,
    seen: &ObservedShots,
) -> Result<Vec<Prediction>, NoResult> {
    let case = &until_rest(context.case);
    let context = &context.with_case(case);
    let &Context { compute, control, sampling, .. } = context;
    let mut all = Vec::new();
    for shot in seen.shots() {
        let ObservedShot { option, ref watched, .. } = shot;
        let settings = case.run_settings(compute.method, compute.first_step(case));
        let planned = observe_shot(case, None, &case.shots[option], watched, &settings, control)?;
        let planned = planned.unwrap_or_else(|| vec![f64::NAN; watched.len()]);
        let drawn = sampling.map(|sampling| samples(context, &shot, &sampling));
        let drawn = drawn.transpose()?;
        let in_common = drawn.as_ref().and_then(InCommon::of);
        let first = all.len();
        let mut deviations = Vec::new();
        for (n, observation) in seen.list[shot.observations()].iter().enumerate() {
            let observable_values = drawn.as_ref().map(|drawn| drawn.observable_values(n, observation.sd));
            let band = observable_values.as_deref().and_then(band);
            let known = in_common.as_ref().zip(drawn.as_ref());
            let in_common = known.and_then(|(inputs, drawn)| inputs.correlation(drawn, n, observation.sd));
            let prediction = Prediction {
                planned: planned[n],
                band: band.map(|[low, _, high]| [low, high]),
                middle: band.map_or(f64::NAN, |[_, middle, _]| middle),
                in_common: in_common.unwrap_or(0.0),
                of_launch: LaunchInformation::default(),
            };
            deviations.push(deviations_often_known(&prediction, &observable_values.unwrap_or_default()));
            all.push(prediction);
        }
        let launch: Vec<f64> = drawn.iter().flat_map(Samples::log_launch).collect();
        let repeating = drawn.as_ref().map_or_else(Vec::new, Samples::repeating_but_launch);
        let found = launch_information(&deviations, &launch, &repeating);
        for (prediction, found) in all[first..].iter_mut().zip(found) {
            prediction.of_launch = found;
        }
    }
    Ok(all)
}

/// 5th, 50th and 95th percentile of the values that are known; NaN if hardly any is known.
fn band(observable_values: &[f64]) -> Option<[f64; 3]> {
    let finite: Vec<f64> = observable_values.iter().copied().filter(|value| value.is_finite()).collect();
    // If every run failed, nothing was predicted, and no observation agrees.
    if finite.is_empty() || (finite.len() as f64) < SELDOM_KNOWN * observable_values.len() as f64 {
        return Some([f64::NAN; 3]);
    }
    percentiles(finite.into_iter(), [0.05, 0.5, 0.95])
}

/// Distance of each value from the middle of its band [standard deviations], 0 if unknown; empty if too many are unknown.
fn deviations_often_known(prediction: &Prediction, observable_values: &[f64]) -> Vec<f64> {
    let deviations = observable_values.iter().filter_map(|value| prediction.deviations(*value));
    let deviations: Vec<f64> = deviations.map(|z| if z.is_finite() { z } else { 0.0 }).collect();
    let known = observable_values.iter().filter(|value| value.is_finite()).count() as f64;
    if known < OFTEN_KNOWN * observable_values.len() as f64 { Vec::new() } else { deviations }
}

/// The single observation in a shot of `option` that would narrow its utilization most; `None` if none removes a hundredth of its
/// variance.
///
/// 1. Only inputs in common repeat in the next shot. Symbols: c are these inputs in a sample, Σ is their covariance, u is the
///    utilization, and y is the observed value. β and γ are the slopes of u and y over c.
/// 2. An observation has the variance v = var y + sd². It removes the part (βᵀΣγ)²/v from the variance of u.
pub fn next_observation(
    context: &Context<'_>,
    option: usize,
    sampling: &Sampling,
) -> Result<Option<NextObservation>, NoResult> {
    let case = &until_rest(context.case);
    let watched = observables(case.scene());
    let shot = ObservedShot { option, times: Vec::new(), watched, first: 0 };
    let drawn = samples(&context.with_case(case), &shot, sampling)?;
    let watched = shot.watched;
    let count = drawn.values.len();
    let Some(in_common) = InCommon::of(&drawn) else { return Ok(None) };
    let utilization: Vec<f64> =
        drawn.values.iter().map(|values| utilization(case, &watched, values)).collect();
    let (beta, variance) = in_common.regression(&DVector::from_vec(utilization));
    let launch = drawn.log_launch();
    let mut best: Option<NextObservation> = None;
    for (n, &watched) in watched.iter().enumerate() {
        let values = DVector::from_iterator(count, drawn.values.iter().map(|sample| sample[n]));
        if values.iter().any(|value| !value.is_finite()) {
            continue;
        }
        let (gamma, scatter) = in_common.regression(&values);
        let sd = assumed_sd(watched.quantity, values.mean());
        let share =
            (beta.transpose() * &in_common.covariance * gamma)[0].powi(2) / (scatter + sd * sd) / variance;
        if share > best.map_or(0.01, |best| best.share) {
            let launch_percent = launch_percent(&launch, values.as_slice(), sd);
            best = Some(NextObservation {
                observable: Observable { option, watched },
                sd,
                share,
                launch_percent,
            });
        }
    }
    Ok(best)
}

/// Least share of the variance of an observation that the launch must explain. Below it, the observation does not show the launch.
const FOLLOWS_LAUNCH: f64 = 0.2;

/// Coefficient of variation of the launch in common that remains after an observation with standard deviation `sd` [%]. It follows
/// from a line through the logarithms of both in samples; `launch` holds logarithms already. Symbols: b is the slope of the line, s
/// is the scatter of the observation about it, and c is the standard deviation of the launch before. What remains is 1/√(1/c² +
/// b²/s²).
fn launch_percent(launch: &[f64], values: &[f64], sd: f64) -> Option<f64> {
    let pairs: Vec<(f64, f64)> = launch
        .iter()
        .zip(values)
        .filter(|(launch, value)| launch.is_finite() && **value > 0.0)
        .map(|(launch, value)| (*launch, value.ln()))
        .collect();
    let count = pairs.len() as f64;
    let [mean_x, mean_y] =
        [pairs.iter().map(|p| p.0).sum::<f64>() / count, pairs.iter().map(|p| p.1).sum::<f64>() / count];
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        pairs.iter().map(|(x, y)| of(x - mean_x, y - mean_y)).sum::<f64>() / (count - 1.0)
    };
    let [xx, xy, yy] = [sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y)];
    let explained = xy * xy / (xx * yy);
    // Most samples must have a value: a line through only the samples in which the tire rises would be another line.
    let is_known = count >= OFTEN_KNOWN * launch.len() as f64 && explained > FOLLOWS_LAUNCH;
    let slope = xy / xx;
    let scatter = (yy - xy * xy / xx).max(0.0) + (sd / mean_y.exp()).powi(2);
    is_known.then(|| 1e2 * (1.0 / xx + slope * slope / scatter).sqrt().recip())
}

/// Utilization of a sample: the greatest share of a limit among all watched values.
fn utilization(case: &Case, watched: &[ObservedPoint], values: &[f64]) -> f64 {
    case.limits.utilization(|quantity| {
        let wanted = match quantity {
            Quantity::Height => ObservedQuantity::FlightHeight,
            Quantity::Force => ObservedQuantity::Force,
            Quantity::Drift => ObservedQuantity::Drift,
        };
        let of_quantity = watched.iter().zip(values).filter(|(watched, _)| watched.quantity == wanted);
        of_quantity.map(|(_, value)| *value).fold(0.0, f64::max)
    })
}
