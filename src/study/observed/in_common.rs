//! What several shots say together of what all shots have in common, as the launch is: that they lie to one side of what is predicted, that
//! they differ further than chance explains, or that they leave faster launches than the plan judges.

use super::contradiction::Contradiction;
use crate::plan::observations::Observation;
use crate::study::Case;
use crate::study::fit::launch_information::LaunchInformation;
use crate::study::fit::observation_bands::Prediction;

/// Share of true plans that each rule of chance contradicts, however many values were seen. Limits and logs are apart from it.
pub const LEVEL: f64 = 0.05;
/// Least square of a correlation that tells something, and least part of a variance.
const LEAST_IN_COMMON: f64 = 0.01;

/// That shots lie to one side, all together, or differ, further than chance explains, or that they leave faster launches than the plan judges.
///
/// 1. Each shot tells something of what all have in common, F, which has the variance 1, with a variance v ([`factor_in_common`]).
/// 2. The mean of shots, each with the weight 1 / (v − 1), has a variance of 1 + 1 / Σ 1 / (v − 1) at most.
/// 3. About it the shots scatter with χ² of one degree of freedom less than their number, at most.
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

/// Probability that a value lies so far from the middle, to either side.
pub fn both_tails(deviations: f64) -> f64 {
    libm::erfc(deviations.abs() / std::f64::consts::SQRT_2)
}

/// What shots tell of a part that every shot has in common, which has the mean 0 and the variance 1.
struct CommonPart {
    /// What each shot tells, and its weight: the inverse of the variance about the truth.
    told: Vec<[f64; 2]>,
    /// The mean of all, and the sum of the weights.
    mean: f64,
    weights: f64,
}

/// A value in standard deviations, and what was predicted of it.
type Deviation<'a> = (f64, &'a Prediction);

/// The values of a shot that lie at a finite distance from the middle of their bands.
fn deviations(shot: &[(Observation, Prediction)]) -> Vec<Deviation<'_>> {
    let all =
        shot.iter().filter_map(|(seen, predicted)| Some((predicted.deviations(seen.value)?, predicted)));
    all.filter(|(z, _)| z.is_finite()).collect()
}

impl CommonPart {
    /// Of what the values of a shot tell of it, and its variance.
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

/// Of values z, in standard deviations, and correlations r with what every shot has in common, T = Σ r z / Σ r² tells that part. Its
/// variance is (Σ |r| / Σ r²)² at most, whatever else the values share. Values that do not follow it count little.
fn factor_in_common(shot: &[Deviation<'_>]) -> Option<[f64; 2]> {
    let sum = |of: fn(f64, f64) -> f64| shot.iter().map(|(z, seen)| of(*z, seen.in_common)).sum::<f64>();
    let squares = sum(|_, r| r * r);
    let told = [sum(|z, r| r * z) / squares, (sum(|_, r| r.abs()) / squares).powi(2)];
    (squares > LEAST_IN_COMMON).then_some(told)
}

/// What all shots tell of the launch in common: its mean and variance, where beforehand these are 0 and 1.
///
/// A shot tells T = Σ w (z − mean) / q, where q is the sum of the shares, with the variance 1 / q, of which 1 is that of the launch and u
/// repeats in every shot. So the mean of shots, each with the weight 1 / (1 / q − 1 − u), has a variance of u and the inverse of the sum of
/// weights about the launch.
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

/// Standard deviations to the fastest one of a hundred launches, and by what factor that may be faster than judged: a pass that is not thin
/// bears launches 5 % faster.
pub const FASTEST: f64 = 2.326;
const LITTLE_FASTER: f64 = 1.03;

/// That the launches that what was seen leaves possible are faster than those that the plan judges: a weak statement of how well launches
/// are known makes no chance of fast ones. How shots differ stays. Launches are lognormal.
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
