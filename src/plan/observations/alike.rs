//! Whether two files may hold observations of the same shot, typed twice.
//!
//! m is the number of quantities that both files hold. v₁ and v₂ are the two values of a quantity, s₁ and s₂ their standard deviations.
//!
//! 1. Two different shots differ in a quantity at least by the reading errors. So D = Σ (v₁ − v₂)² / (s₁² + s₂²) over the m quantities is
//!    χ² with m degrees of freedom, or greater.
//! 2. A D below the 1 % quantile of χ² is closer than 99 of 100 pairs of shots. Values that were typed again, with other digits or another
//!    standard deviation, are that close.
//! 3. The quantile is m (1 − 2/(9m) − 2.326 √(2/(9m)))³ (Wilson and Hilferty 1931).
//!
//! That is no proof: two shots may be that alike, and a second reading of one shot may differ. So the program warns, and refuses nothing.

use itertools::Itertools;

use super::Observations;

/// Least number of common quantities for a comparison: a single quantity may agree because it was read coarsely.
const LEAST_IN_COMMON: usize = 2;

/// Standard normal deviate below which 1 % lie.
const ONE_PERCENT: f64 = -2.326;

/// The first two files whose values lie closer together than reading errors allow.
pub fn nearly_alike<'a>(files: &[&'a Observations]) -> Option<[&'a Observations; 2]> {
    let mut pairs = files.iter().copied().tuple_combinations();
    pairs.find(|(one, other)| are_nearly_alike(one, other)).map(|(one, other)| [one, other])
}

fn are_nearly_alike(one: &Observations, other: &Observations) -> bool {
    let distances = one.list.iter().filter_map(|seen| {
        let same =
            other.list.iter().find(|same| same.option == seen.option && same.watched == seen.watched)?;
        Some((seen.value - same.value).powi(2) / (seen.sd.powi(2) + same.sd.powi(2)))
    });
    let distances: Vec<f64> = distances.collect();
    let count = distances.len() as f64;
    // Wilson and Hilferty 1931. With few degrees of freedom the quantile is a little too small.
    let spread = 2.0 / (9.0 * count);
    let quantile = count * (1.0 - spread + ONE_PERCENT * spread.sqrt()).max(0.0).powi(3);
    distances.len() >= LEAST_IN_COMMON && distances.iter().sum::<f64>() < quantile
}
