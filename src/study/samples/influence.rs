//! Shares of the inputs in the variance of the samples of a shot: which input decides the result.

use super::random_shot::Input;
use super::sampled_shot::SampledShot;
use crate::sorting::sort_by;
use crate::verdict::{Limits, Quantity};

/// Samples needed for the shares of the inputs.
pub const SAMPLES_FOR_SHARES: usize = 200;

/// Share of each input in the variance of the quantity nearest its limit, largest first. The remainder is scatter from hole to hole
/// and interaction between inputs. `None` for fewer than [`SAMPLES_FOR_SHARES`] samples, or if a value is infinite.
pub fn input_shares(sampled: &SampledShot, limits: &Limits) -> Option<Vec<(Input, f64)>> {
    let nearest = nearest_its_limit(sampled, limits)?;
    let values: Vec<f64> = sampled.decided().map(|sample| sample.run.get(nearest)).collect();
    if values.len() < SAMPLES_FOR_SHARES || values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let share = |(n, input): (usize, Input)| {
        let inputs: Vec<f64> = sampled.decided().map(|sample| sample.inputs[n]).collect();
        (input, share_of_variance(&inputs, &values))
    };
    // The inputs along both axes of one key count together.
    let mut shares: Vec<(Input, f64)> = Vec::new();
    for (input, share) in Input::ALL.into_iter().enumerate().map(share) {
        match shares.iter_mut().find(|(known, _)| known.key().name == input.key().name) {
            Some((_, known)) => *known += share,
            None => shares.push((input, share)),
        }
    }
    sort_by(&mut shares, |a, b| b.1.total_cmp(&a.1));
    Some(shares)
}

/// The quantity whose 95th percentile has the greatest share of its limit.
fn nearest_its_limit(sampled: &SampledShot, limits: &Limits) -> Option<Quantity> {
    let mut nearest: Option<(f64, Quantity)> = None;
    for quantity in Quantity::ALL {
        let Some(limit) = limits.get(quantity) else { continue };
        let [_, _, high, _] = sampled.band(quantity)?;
        if nearest.is_none_or(|(most, _)| high / limit > most) {
            nearest = Some((high / limit, quantity));
        }
    }
    nearest.map(|(_, quantity)| quantity)
}

/// Share of the variance of `values` that `input` alone explains: the variance between bins of equal count, minus the variance that
/// bins of random values would show (the ε² of Kelley 1935).
fn share_of_variance(input: &[f64], values: &[f64]) -> f64 {
    let n = values.len();
    let bins = ((n as f64).sqrt() as usize).min(20);
    let mut order: Vec<usize> = (0..n).collect();
    sort_by(&mut order, |&a, &b| input[a].total_cmp(&input[b]));
    if input[order[0]] == input[order[n - 1]] {
        return 0.0;
    }
    let mean = |bin: &[usize]| bin.iter().map(|&i| values[i]).sum::<f64>() / bin.len() as f64;
    let whole = mean(&order);
    let total: f64 = values.iter().map(|value| (value - whole).powi(2)).sum();
    let bin = |b: usize| &order[b * n / bins..(b + 1) * n / bins];
    let between: f64 = (0..bins).map(|b| bin(b).len() as f64 * (mean(bin(b)) - whole).powi(2)).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let within = (total - between) / (n - bins) as f64;
    ((between - (bins - 1) as f64 * within) / total).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// y = 3 a + 4 b + c with three uniform variables of equal variance has the shares 9/26, 16/26 and 1/26. Each holds within four
    /// standard errors of 4,000 draws (0.05). An input without effect has no share.
    #[test]
    fn shares_are_those_of_a_sum() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let draws: Vec<[f64; 4]> = (0..4000).map(|_| random.random()).collect();
        let y: Vec<f64> = draws.iter().map(|[a, b, c, _]| 3.0 * a + 4.0 * b + c).collect();
        for (n, exact) in [9.0 / 26.0, 16.0 / 26.0, 1.0 / 26.0, 0.0].into_iter().enumerate() {
            let input: Vec<f64> = draws.iter().map(|draw| draw[n]).collect();
            let share = share_of_variance(&input, &y);
            assert!((share - exact).abs() < 0.05, "{n}: {share}");
        }
        assert_eq!(share_of_variance(&vec![0.5; 4000], &y), 0.0, "an input known exactly");
    }

    /// For 1, 3, 5, 7 in two bins, the variance is 20, between the bins 16, within a bin 4/2. So ε² is (16 − 2)/20.
    #[test]
    fn a_share_of_few_values_is_that_of_kelley() {
        assert_eq!(share_of_variance(&[4.0, 3.0, 2.0, 1.0], &[7.0, 5.0, 3.0, 1.0]), 0.7);
    }

    /// The bias of bins is removed: for 200 values without any relation, bins of equal count alone would explain 7 %.
    #[test]
    fn inputs_without_effect_have_no_share() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let share = |random: &mut ChaCha8Rng| {
            let mut numbers = || (0..200).map(|_| random.random::<f64>()).collect::<Vec<_>>();
            share_of_variance(&numbers(), &numbers())
        };
        let mean = (0..200).map(|_| share(&mut random)).sum::<f64>() / 200.0;
        assert!(mean < 0.02, "{mean}");
    }
}
