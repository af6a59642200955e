//! How far launch velocities differ from shot to shot.
//!
//! No observation of one shot tells how far the next one differs from it, so that the plan's number stands, or a cautious one. From
//! [`LEAST_SHOTS`] shots on, the shots themselves bound it:
//! 1. Symbols: σ the standard deviation of launch factors, as the fit takes it; of shot j: r the residuals of its observations,
//!    S their covariance, g their change over σ.
//! 2. z = gᵀS⁻¹r / gᵀS⁻¹g estimates how far the factor of the shot lies from the mean, in units of σ.
//! 3. The z scatter by the true standard deviation s and by all else, so that Σ (z − z̄)² is at least (s/σ)² times a χ² of
//!    f degrees of freedom: f is the number of shots less that of parameters, each of which may follow the shots.
//! 4. With q the 5 % quantile of that χ², s lies below σ √(Σ (z − z̄)² / q) with a probability of 95 % or more.

use nalgebra::DVector;

use super::observed_shots::ObservedShots;
use super::refined_answer::RefinedAnswer;
use crate::plan::Uncertainty;
use crate::plan::write_fit::StatedKeys;

/// Least number of shots that say how far shots differ: of five the upper bound is 2.4 times the spread found, of three 4.4 times.
pub const LEAST_SHOTS: usize = 5;

/// What a fit takes at least where the plan does not say how far shots differ [%].
const CAUTIOUS_PERCENT: f64 = 5.0;

/// Standard normal deviate below which 5 % lie.
const FIVE_PERCENT: f64 = -1.645;

/// How far launch velocities differ from shot to shot, as a fit took it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetweenShots {
    /// The coefficient of variation used [%].
    pub percent: f64,
    /// Where it is from.
    pub source: BetweenShotsSource,
    /// Number of shots that were observed.
    pub shots: usize,
}

/// Where the scatter from shot to shot is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BetweenShotsSource {
    /// The plan states it.
    Stated,
    /// The plan leaves it out.
    Assumed,
    /// The shots bound it.
    UpperBound,
}

impl BetweenShots {
    /// What is known of it before the observations of so many shots.
    pub fn before(uncertainty: &Uncertainty, stated: &StatedKeys, shots: usize) -> Self {
        let cautious = CAUTIOUS_PERCENT.max(uncertainty.launch_common_percent);
        let (percent, source) = match stated.launch_between_shots {
            true => (uncertainty.launch_between_shots_percent, BetweenShotsSource::Stated),
            false => (cautious, BetweenShotsSource::Assumed),
        };
        Self { percent, source, shots }
    }

    /// The upper bound of `seen` where that is smaller; `answer` is the best of a fit with `parameters` that took this scatter.
    pub(super) fn narrowed(self, seen: &ObservedShots, answer: &RefinedAnswer, parameters: usize) -> Self {
        let factors = shot_factors(seen, answer);
        let freedom = factors.len().saturating_sub(parameters);
        let bound = self.percent * upper_bound(&factors, freedom);
        match factors.len() >= LEAST_SHOTS && bound < self.percent {
            true => Self { percent: bound, source: BetweenShotsSource::UpperBound, ..self },
            false => self,
        }
    }
}

/// How far the launch factor of each shot lies from the mean [standard deviations that the fit took]; not a number where a shot
/// does not tell.
fn shot_factors(seen: &ObservedShots, answer: &RefinedAnswer) -> Vec<f64> {
    let of_shot = |range: std::ops::Range<usize>| {
        let residual = |n: usize| seen.list[n].value - answer.predicted[n];
        let residuals = DVector::from_iterator(range.len(), range.clone().map(residual));
        let slopes = answer.over_shot_factor.rows(range.start, range.len());
        let weights = answer.covariance.of(range).cholesky().map(|factor| factor.solve(&slopes));
        weights.map_or(f64::NAN, |weights| weights.dot(&residuals) / weights.dot(&slopes))
    };
    seen.shots().iter().map(|shot| of_shot(shot.observations())).collect()
}

/// Upper bound, at 95 %, of the standard deviation of numbers that scatter at least as a normal variable does with so many degrees
/// of freedom. Not a number where a number is none, and where there is no freedom.
fn upper_bound(numbers: &[f64], freedom: usize) -> f64 {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    (squares / chi_square_quantile(freedom as f64, FIVE_PERCENT)).sqrt()
}

/// Quantile of χ² with `f` degrees of freedom at a standard normal deviate (Wilson and Hilferty 1931); below 5 % a little too small.
fn chi_square_quantile(f: f64, deviate: f64) -> f64 {
    let spread = 2.0 / (9.0 * f);
    f * (1.0 - spread + deviate * spread.sqrt()).powi(3)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Quantiles of tables; a quantile that is too small makes a bound that is too large, by 2 % at most.
    #[test]
    fn quantiles_are_those_of_tables() {
        for (freedom, exact) in [(4.0, 0.7107), (5.0, 1.1455), (9.0, 3.3251), (30.0, 18.4927)] {
            let ratio = chi_square_quantile(freedom, FIVE_PERCENT) / exact;
            assert!((0.96..=1.0005).contains(&ratio), "{freedom}: {ratio}");
        }
    }

    /// Of 4,000 sets of shots 5 % lie above their bound, with a standard error of 0.35 %; noise of each shot only raises the bound.
    #[test]
    fn the_bound_holds_in_95_of_100_sets_of_shots() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for (shots, noise, most) in [(5, 0.0, 0.06), (12, 0.0, 0.06), (5, 1.0, 0.02)] {
            let mut number = || -> f64 { StandardNormal.sample(&mut random) };
            let missed = (0..4000).filter(|_| {
                let factors: Vec<f64> = (0..shots).map(|_| number() + noise * number()).collect();
                upper_bound(&factors, shots - 1) < 1.0
            });
            let share = missed.count() as f64 / 4000.0;
            assert!(share < most && (noise > 0.0 || share > 0.03), "{shots} {noise}: {share}");
        }
        assert!(upper_bound(&[1.0, f64::NAN, 2.0], 2).is_nan() && upper_bound(&[1.0], 0).is_nan());
    }
}
