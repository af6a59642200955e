//! Whether two files may tell one shot, typed twice.
//!
//! 1. Of two shots the same quantity differs at least by how inexactly both were read: D = Σ (v₁ − v₂)² / (s₁² + s₂²) over the m
//!    quantities that both tell is then χ² with m degrees of freedom, or greater.
//! 2. A D below its 1 % quantile is closer than 99 of 100 pairs of shots. Values that were typed again, with other digits or
//!    another standard deviation, are that close.
//!
//! That is no proof: shots may be so alike, and a shot typed again may be read anew. So it is told and nothing is refused.

use itertools::Itertools;

use super::Observations;

/// Least number of quantities in common that tell something: one may be alike by how coarsely it was read.
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
    // Wilson and Hilferty 1931; with few degrees of freedom the quantile is a little too small.
    let spread = 2.0 / (9.0 * count);
    let quantile = count * (1.0 - spread + ONE_PERCENT * spread.sqrt()).max(0.0).powi(3);
    distances.len() >= LEAST_IN_COMMON && distances.iter().sum::<f64>() < quantile
}
