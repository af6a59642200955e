//! What several observed values of one shot together say about its launches.

use nalgebra::{DMatrix, DVector};

/// What one value says about the logarithm of the launch in common, beside the other values of its shot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LaunchInformation {
    /// Mean of the value in samples. It is in standard deviations of its band, like all values here.
    pub mean: f64,
    /// Weight of the value (minus its mean) in the estimate of that logarithm from all values of the shot. The estimate is in
    /// standard deviations of the logarithm. 0 if unknown.
    pub weight: f64,
    /// Share of the value in q.
    pub share: f64,
    /// The part q of the variance of the launch that the values of the shot remove.
    pub taken_away: f64,
    /// Variance of the estimate about the launch that repeats in every shot, because stiffness and friction stay what they are.
    pub repeats: f64,
}

/// Number of samples needed per value to separate its part from the parts of the others.
const SAMPLES_OF_A_VALUE: usize = 10;
/// Least part of the variance of a value that it shares with no other value, however alike they are in samples: no two are observed
/// at one point.
const LEAST_OWN: f64 = 0.01;

/// What each of `values` says about the launch, in standard deviations of their bands (`n_values` × `n_samples`; empty if unknown).
/// `launch` holds the logarithms of the launch in common (`n_samples`). `repeating` holds the other inputs that repeat in every
/// shot (`n_inputs` × `n_samples`).
///
/// 1. Symbols: z are the values, r are their correlations with the launch, and R are the correlations among them. If values and
///    launch are jointly normal, the launch given z has the mean rᵀR⁻¹z and the variance 1 − q with q = rᵀR⁻¹r.
/// 2. With N samples and d values, q is too great by chance. The corrected q is 1 − (1 − q)(N − 1)/(N − d − 1).
/// 3. If there are many values, only the values that follow the launch best count. d counts all values from which they were chosen,
///    up to N/2.
/// 4. The other repeating inputs explain a part of the error of the estimate. More shots do not remove that part.
pub fn launch_information(
    values: &[Vec<f64>],
    launch: &[f64],
    repeating: &[Vec<f64>],
) -> Vec<LaunchInformation> {
    let mut told = vec![LaunchInformation::default(); values.len()];
    let degrees = launch.len() as f64 - 1.0;
    let Some((launch, ..)) = standardized(launch) else { return told };
    let known = values.iter().map(|values| standardized(values)).enumerate();
    let mut follow: Vec<(usize, DVector<f64>, [f64; 3])> = known
        .filter_map(|(n, known)| {
            let (values, mean, deviation) = known?;
            let correlation = values.dot(&launch) / degrees;
            Some((n, values, [mean, deviation, correlation]))
        })
        .collect();
    let among_all = (follow.len() as f64).min(0.5 * degrees);
    follow.sort_by(|a, b| b.2[2].abs().total_cmp(&a.2[2].abs()));
    follow.truncate(launch.len() / SAMPLES_OF_A_VALUE);
    let among = DMatrix::from_fn(follow.len(), follow.len(), |a, b| {
        follow[a].1.dot(&follow[b].1) / degrees + if a == b { LEAST_OWN } else { 0.0 }
    });
    let correlations = DVector::from_iterator(follow.len(), follow.iter().map(|follow| follow.2[2]));
    let Some(weights) = among.cholesky().map(|among| among.solve(&correlations)) else { return told };
    let by_samples = weights.dot(&correlations);
    let taken_away = 1.0 - (1.0 - by_samples) * degrees / (degrees - among_all);
    if by_samples.is_nan() || taken_away <= 0.0 {
        return told;
    }
    let mut off_launch = -launch;
    for ((_, values, _), weight) in follow.iter().zip(&weights) {
        off_launch.axpy(weight / by_samples, values, 1.0);
    }
    let repeats = explained(&off_launch, repeating);
    for ((n, _, [mean, deviation, correlation]), weight) in follow.into_iter().zip(&weights) {
        let weight = weight * taken_away / by_samples;
        let share = weight * correlation;
        told[n] = LaunchInformation { mean, weight: weight / deviation, share, taken_away, repeats };
    }
    told
}

/// The variance of `values` that these inputs explain (`n_inputs` × `n_samples`), minus the variance that chance explains.
fn explained(values: &DVector<f64>, inputs: &[Vec<f64>]) -> f64 {
    let known: Vec<DVector<f64>> = inputs.iter().filter_map(|input| Some(standardized(input)?.0)).collect();
    let degrees = values.len() as f64 - 1.0;
    let among = DMatrix::from_fn(known.len(), known.len(), |a, b| known[a].dot(&known[b]) / degrees);
    let with = DVector::from_iterator(known.len(), known.iter().map(|input| input.dot(values) / degrees));
    let Some(inverse) = among.cholesky() else { return 0.0 };
    let by_chance = known.len() as f64 / degrees * values.norm_squared() / degrees;
    (inverse.solve(&with).dot(&with) - by_chance).max(0.0)
}

/// Values minus their mean, in standard deviations; then the mean and the standard deviation. `None` if all values are alike, or
/// some are unknown.
fn standardized(values: &[f64]) -> Option<(DVector<f64>, f64, f64)> {
    let values = DVector::from_column_slice(values);
    let mean = values.mean();
    let from_mean = values.add_scalar(-mean);
    let deviation = (from_mean.norm_squared() / (values.len() as f64 - 1.0)).sqrt();
    (deviation.is_finite() && deviation > 0.0).then(|| (from_mean / deviation, mean, deviation))
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::StandardNormal;

    use super::*;

    /// Values x = √c F + √(1 − c) e have R = (1 − c) I + c 11ᵀ. So each has the weight √c / (1 − c + d c), and d values remove d c
    /// / (1 − c + d c). 20,000 samples err by 0.007 in each correlation; each value has 1 % more of its own. Unknown values say
    /// nothing, and a value that is given twice says hardly more than once.
    #[test]
    fn values_that_scatter_by_themselves_tell_more_together() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        let normal = &mut || random.sample::<f64, _>(StandardNormal);
        let launch: Vec<f64> = (0..20_000).map(|_| 0.1 * normal()).collect();
        let (common, count) = (0.4_f64, 5);
        let value = |_| -> Vec<f64> {
            launch
                .iter()
                .map(|launch| common.sqrt() * 10.0 * launch + (1.0 - common).sqrt() * normal())
                .collect()
        };
        let mut values: Vec<Vec<f64>> = (0..count).map(value).collect();
        values.push(Vec::new());
        let told = launch_information(&values, &launch, &[]);
        let expected = common.sqrt() / (1.0 - common + 0.01 + count as f64 * common);
        for told in &told[..count] {
            assert!((told.share - expected * common.sqrt()).abs() < 0.015, "{told:?}");
            assert!(
                (told.weight - expected).abs() < 0.015 && told.mean.abs() < 0.03,
                "{told:?} {expected:?}"
            );
        }
        assert_eq!(told[count], LaunchInformation::default());
        let taken_away = |values: &[Vec<f64>]| launch_information(values, &launch, &[])[0].taken_away;
        let once = taken_away(&values[..1]);
        let twice = taken_away(&[values[0].clone(), values[0].clone()]);
        assert!((once - common).abs() < 0.015 && (twice - once).abs() < 0.005, "{once} {twice}");
        // The same value in another unit and about another mean.
        let moved: Vec<f64> = values[0].iter().map(|value| 2.0 * value + 3.0).collect();
        let [own, moved] = [&values[0], &moved]
            .map(|values| launch_information(std::slice::from_ref(values), &launch, &[])[0]);
        assert!(
            (moved.weight - 0.5 * own.weight).abs() < 1e-9
                && (moved.mean - 2.0 * own.mean - 3.0).abs() < 1e-9
        );
    }

    /// For x = 0.6 F + 0.6 S + 0.53 e with a constant stiffness S, the estimate T is x / 0.6. T differs from F by S and e. S
    /// repeats with the variance 1.
    #[test]
    fn what_repeats_beside_the_launch_is_told_apart() {
        let random = &mut ChaCha8Rng::seed_from_u64(3);
        let mut drawn = || -> Vec<f64> { (0..20_000).map(|_| random.sample(StandardNormal)).collect() };
        let [launch, stiffness, own, friction] = [drawn(), drawn(), drawn(), drawn()];
        let values =
            (0..launch.len()).map(|n| 0.6 * launch[n] + 0.6 * stiffness[n] + 0.28_f64.sqrt() * own[n]);
        let told = launch_information(&[values.collect()], &launch, &[stiffness, friction])[0];
        assert!((told.taken_away - 0.36).abs() < 0.015 && (told.repeats - 1.0).abs() < 0.05, "{told:?}");
    }

    /// Values that follow no launch remove nothing, on average over 100 films of 200 samples. Each film alone seems to remove a
    /// tenth; with 20 values the standard error is 0.003. With 100 values, the twenty best seem to remove more, but that is chance,
    /// too. Values say nothing about a launch that is known exactly, and nineteen values from 9 samples say nothing either.
    #[test]
    fn chance_tells_nothing_of_launches() {
        let random = &mut ChaCha8Rng::seed_from_u64(2);
        let mut drawn =
            |count: usize| -> Vec<f64> { (0..count).map(|_| random.sample(StandardNormal)).collect() };
        for count in [20, 100] {
            let mut total = 0.0;
            for _ in 0..100 {
                let values: Vec<Vec<f64>> = (0..count).map(|_| drawn(200)).collect();
                let told = launch_information(&values, &drawn(200), &[]);
                total += told.iter().map(|told| told.taken_away).fold(0.0, f64::max);
            }
            assert!(total / 100.0 < 0.03, "{count}: {total}");
        }
        let nothing = [LaunchInformation::default(); 19];
        let values: Vec<Vec<f64>> = (0..19).map(|_| drawn(9)).collect();
        assert_eq!(launch_information(&values, &drawn(9), &[]), nothing);
        let values: Vec<Vec<f64>> = (0..19).map(|_| drawn(200)).collect();
        assert_eq!(launch_information(&values, &[0.0; 200], &[]), nothing);
        assert_eq!(launch_information(&values, &[], &[]), nothing);
    }
}
