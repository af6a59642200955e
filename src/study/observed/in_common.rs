//! What several shots say together about the part that all shots share, such as the launch. The shots can lie to one side of the
//! prediction, differ further than chance explains, or leave faster launches possible than the plan judges.

use super::contradiction::Contradiction;
use crate::plan::observations::Observation;
use crate::study::Case;
use crate::study::fit::launch_information::LaunchInformation;
use crate::study::fit::observation_bands::Prediction;

/// Share of true plans that each rule of chance contradicts by mistake, for any number of values. Limits and logs have rules of their own.
pub const LEVEL: f64 = 0.05;
/// Least sum of squared correlations from which a shot says something about the shared part. Also the least variance of a shot's estimate
/// about the true value.
const LEAST_IN_COMMON: f64 = 0.01;

/// The contradiction of all shots together: they lie to one side, they differ, each further than chance explains, or they leave faster
/// launches possible than the plan judges.
///
/// 1. Symbols: F the part that all shots share, with mean 0 and variance 1; T the estimate of F by one shot, and v its variance
///    ([`factor_in_common`]).
/// 2. Each shot has the weight 1 / (v − 1). The mean of the shots has at most the variance 1 + 1 / Σ 1 / (v − 1).
/// 3. The shots scatter about their mean with at most χ². Its degrees of freedom are the number of shots less one.
pub fn in_common(case: &Case, shots: &[Vec<(Observation, Prediction)>]) -> Option<Contradiction> {
    let CommonPart { told, mean, weights } = CommonPart::of(shots);
    let shots_told = told.len();
    if both_tails(mean / (1.0 + weights.recip()).sqrt()) <= LEVEL {
        return Some(Contradiction::ToOneSide { shots: shots_told, is_faster: mean > 0.0 });
    }
    let scatter: f64 = told.iter().map(|[of_shot, weight]| weight * (of_shot - mean).powi(2)).sum();
    let differ = shots_told > 1 && above_chi_square(scatter, shots_told - 1) <= LEVEL;
    let differ = differ.then_some(Contradiction::Differ { shots: shots_told });
    differ.or_else(|| leaves_faster(case, shots))
}

/// Probability that a standard normal value lies so far from the middle, to either side.
pub fn both_tails(deviations: f64) -> f64 {
    libm::erfc(deviations.abs() / std::f64::consts::SQRT_2)
}

/// What shots say about the part that all shots share, which has mean 0 and variance 1.
struct CommonPart {
    /// Estimate and weight of each shot. The weight is the inverse of the estimate's variance about the true value.
    told: Vec<[f64; 2]>,
    /// Weighted mean of the estimates.
    mean: f64,
    /// Sum of the weights.
    weights: f64,
}

/// A value in standard deviations from the middle of its band, and its prediction.
type Deviation<'a> = (f64, &'a Prediction);

/// The values of a shot that lie at a finite distance from the middle of their bands.
fn deviations(shot: &[(Observation, Prediction)]) -> Vec<Deviation<'_>> {
    let all =
        shot.iter().filter_map(|(seen, predicted)| Some((predicted.deviations(seen.value)?, predicted)));
    all.filter(|(z, _)| z.is_finite()).collect()
}

impl CommonPart {
    /// Combines the estimates of all shots.
    fn of(shots: &[Vec<(Observation, Prediction)>]) -> Self {
        let of_shot = |shot: &Vec<(Observation, Prediction)>| {
            let [told, variance] = factor_in_common(&deviations(shot))?;
            Some([told, (variance - 1.0).max(LEAST_IN_COMMON).recip()])
        };
        let told: Vec<[f64; 2]> = shots.iter().filter_map(of_shot).collect();
        let weights: f64 = told.iter().map(|[_, weight]| weight).sum();
        let mean = told.iter().map(|[of_shot, weight]| of_shot * weight).sum::<f64>() / weights;
        Self { told, mean, weights }
    }
}

/// Estimate T of the shared part by one shot, and its variance v; `None` if the shot says nothing about it.
///
/// 1. Symbols: z the values of the shot in standard deviations, r their correlations with the shared part.
/// 2. The estimate is T = Σ r z / Σ r². Values with a small r count little.
/// 3. Its variance is at most v = (Σ |r| / Σ r²)², whatever else the values share.
fn factor_in_common(shot: &[Deviation<'_>]) -> Option<[f64; 2]> {
    let sum = |of: fn(f64, f64) -> f64| shot.iter().map(|(z, seen)| of(*z, seen.in_common)).sum::<f64>();
    let squares = sum(|_, r| r * r);
    let told = [sum(|z, r| r * z) / squares, (sum(|_, r| r.abs()) / squares).powi(2)];
    (squares > LEAST_IN_COMMON).then_some(told)
}

/// Mean and variance of the logarithm of the common launch given all shots, in standard deviations of the plan. Without a shot they are 0
/// and 1.
///
/// 1. Symbols, see [`LaunchInformation`]: w the weight of a value, q the sum of the shares of a shot, u the variance that repeats in every
///    shot.
/// 2. A shot estimates the launch as T = Σ w (z − mean) / q, with the variance 1 / q. Of this variance, 1 is that of the launch, and u
///    repeats in every shot.
/// 3. Each shot has the weight 1 / (1 / q − 1 − u). The mean m of the shots has the variance s = u + 1 / Σ weights about the launch, with
///    the greatest u of the shots.
/// 4. Combined with the plan's mean 0 and variance 1, the launch has the mean m / (1 + s) and the variance s / (1 + s).
fn launch_of_shots(shots: &[Vec<(Observation, Prediction)>]) -> [f64; 2] {
    let of_shot = |shot: &Vec<(Observation, Prediction)>| {
        let known = deviations(shot).into_iter().map(|(z, seen)| (z, seen.of_launch));
        let all: Vec<(f64, LaunchInformation)> = known.filter(|(_, told)| told.weight != 0.0).collect();
        let LaunchInformation { taken_away, repeats, .. } = all.first()?.1;
        let sum = |of: fn(&(f64, LaunchInformation)) -> f64| all.iter().map(of).sum::<f64>();
        let told = sum(|(z, told)| told.weight * (z - told.mean)) / sum(|(_, told)| told.share);
        let own = (taken_away.recip() - 1.0 - repeats).max(LEAST_IN_COMMON);
        Some([told, own.recip(), repeats])
    };
    let told: Vec<[f64; 3]> = shots.iter().filter_map(of_shot).collect();
    let weights: f64 = told.iter().map(|[_, weight, _]| weight).sum();
    if weights == 0.0 {
        return [0.0, 1.0];
    }
    let mean = told.iter().map(|[of_shot, weight, _]| of_shot * weight).sum::<f64>() / weights;
    let about = weights.recip() + told.iter().map(|[.., repeats]| *repeats).fold(0.0, f64::max);
    [mean / (1.0 + about), about / (1.0 + about)]
}

/// Standard deviations from the median launch to the fastest 1 in 100.
pub const FASTEST: f64 = 2.326;
/// Factor by which the fastest launches may exceed those that the plan judges. A pass that is not thin bears launches 5 % faster.
const LITTLE_FASTER: f64 = 1.03;

/// [`Contradiction::LeavesFaster`] if the observations leave faster launches possible than the plan judges. So a plan that states the
/// launch loosely does not excuse fast launches as chance. The scatter between shots stays as the plan says. Launches are lognormal.
fn leaves_faster(case: &Case, shots: &[Vec<(Observation, Prediction)>]) -> Option<Contradiction> {
    let unknown = &case.plan.uncertainty;
    let [known, between] =
        [unknown.launch_common_percent, unknown.launch_between_shots_percent].map(|percent| percent * 1e-2);
    let judged = (FASTEST * known.hypot(between)).exp();
    let [mean, variance] = launch_of_shots(shots);
    let left = (known * mean + FASTEST * (known * variance.sqrt()).hypot(between)).exp();
    let faster = [left, judged].map(|factor| factor - 1.0);
    (left > LITTLE_FASTER * judged).then_some(Contradiction::LeavesFaster { faster })
}

/// The probability of a χ² so great or greater (Wilson and Hilferty 1931).
pub fn above_chi_square(value: f64, degrees: usize) -> f64 {
    let degrees = degrees as f64;
    let variance = 2.0 / (9.0 * degrees);
    0.5 * libm::erfc(((value / degrees).cbrt() - 1.0 + variance) / (2.0 * variance).sqrt())
}
