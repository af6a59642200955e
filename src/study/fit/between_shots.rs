//! How far launch velocities differ from shot to shot.
//!
//! Observations of one shot do not show how far the next shot differs from it. So the fit takes the number of the plan, or a
//! cautious number. From [`LEAST_SHOTS`] shots on, the shots themselves bound the scatter:
//! 1. Symbols: σ is the standard deviation of launch factors that the fit takes. For shot j, r are the residuals of its
//!    observations, S is their covariance, and g is their change over σ.
//! 2. z = gᵀS⁻¹r / gᵀS⁻¹g estimates how far the factor of the shot lies from the mean, in units of σ.
//! 3. The z scatter by the true standard deviation s, and by all other causes. So Σ (z − z̄)² is at least (s/σ)² times a χ² with f
//!    degrees of freedom. f is the number of shots less the number of parameters, because each parameter may follow the shots.
//! 4. Let q be the 5 % quantile of that χ². Then s is below σ √(Σ (z − z̄)² / q) with a probability of 95 % or more.
//! 5. Shots may lie too close together, by chance or because one was typed twice. Then the bound of line 4 would be far too small.
//!    But a shot shows its factor no better than with the variance n² = 1/gᵀS⁻¹g − 1 of all other scatter, in units of σ² (mean
//!    over the shots). So no bound is smaller than σ n, and none is smaller than [`LEAST_PERCENT`].
//!
//! Two shots are enough to show that the number of the plan is too small. With that number, Σ (z − z̄)² gᵀS⁻¹g is a χ² with f
//! degrees of freedom, where f is now the number of shots less one. If the sum exceeds the 97.5 % quantile, the fit takes σ
//! √(Σ (z − z̄)² / f) instead. That counts all scatter as scatter of the shots. If the plan says that shots do not differ, σ would
//! be 0 and z undefined: then the fit takes [`LEAST_PERCENT`] first.

use nalgebra::DVector;

use super::observed_shots::ObservedShots;
use super::refined_answer::RefinedAnswer;
use crate::plan::Uncertainty;
use crate::plan::write_fit::StatedKeys;

/// Least number of shots that bound the scatter between shots. With five shots the bound is 2.4 times the scatter found, with three
/// 4.4 times.
pub const LEAST_SHOTS: usize = 5;

/// Least scatter between shots that a fit takes if the plan does not state it [%].
const CAUTIOUS_PERCENT: f64 = 5.0;

/// Least scatter between shots that observations can show [%].
const LEAST_PERCENT: f64 = 1.0;

/// Standard normal deviate that 2.5 % exceed.
const EXCEEDED_BY_FEW: f64 = 1.96;

/// Standard normal deviate below which 5 % lie.
const FIVE_PERCENT: f64 = -1.645;

/// Scatter of launch velocities between shots, as a fit took it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetweenShots {
    /// Coefficient of variation that the fit used [%].
    pub percent: f64,
    /// Source of that number.
    pub source: BetweenShotsSource,
    /// Number of observed shots.
    pub shots: usize,
}

/// Source of the scatter between shots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BetweenShotsSource {
    /// The plan states it.
    Stated,
    /// The plan does not state it, so the fit assumes it.
    Assumed,
    /// The shots give this upper bound.
    UpperBound,
    /// The shots differ by more than this number [%], which the plan states or the fit assumed.
    WiderThan(f64),
}

impl BetweenShots {
    /// The scatter that is known before the observations of so many shots.
    pub fn before(uncertainty: &Uncertainty, stated: &StatedKeys, shots: usize) -> Self {
        let cautious = CAUTIOUS_PERCENT.max(uncertainty.launch_common_percent);
        let (percent, source) = match stated.launch_between_shots {
            true => (uncertainty.launch_between_shots_percent, BetweenShotsSource::Stated),
            false => (cautious, BetweenShotsSource::Assumed),
        };
        Self { percent, source, shots }
    }

    /// The scatter that a fit takes first [%].
    pub(super) fn taken_first(self) -> f64 {
        if self.percent == 0.0 && self.shots > 1 { LEAST_PERCENT } else { self.percent }
    }

    /// The upper bound of the scatter in `seen` if it is smaller, or the scatter found if it is surely greater; else the scatter
    /// before. `answer` is the best answer of a fit with `parameters` parameters that took [`Self::taken_first`].
    pub(super) fn of_shots(self, seen: &ObservedShots, answer: &RefinedAnswer, parameters: usize) -> Self {
        // The plan may say that shots do not differ. Only an answer that is final can refute that, not observations that no launch
        // explains.
        let shows = self.percent > 0.0 || answer.is_converged;
        if shows { self.of_factors(&shot_factors(seen, answer), parameters) } else { self }
    }

    fn of_factors(self, told: &[FittedFactor], parameters: usize) -> Self {
        let factors: Vec<f64> = told.iter().map(|told| told.factor).collect();
        if let Some(scatter) = greater_scatter(told) {
            let source = BetweenShotsSource::WiderThan(self.percent);
            return Self { percent: self.taken_first() * scatter, source, ..self };
        }
        let freedom = factors.len().saturating_sub(parameters);
        let unseen = told.iter().map(|told| told.variance - 1.0).sum::<f64>() / told.len() as f64;
        let least = (self.percent * unseen.max(0.0).sqrt()).max(LEAST_PERCENT);
        // NaN if the shots give no bound. Compare before taking a maximum: the maximum would turn NaN into a small bound.
        let bound = self.percent * upper_bound(&factors, freedom);
        match factors.len() >= LEAST_SHOTS && bound < self.percent && least < self.percent {
            true => Self { percent: bound.max(least), source: BetweenShotsSource::UpperBound, ..self },
            false => self,
        }
    }
}

/// Launch factor that the observations of one shot show, in standard deviations that the fit took.
#[derive(Clone, Copy)]
struct FittedFactor {
    /// Distance of the factor from the mean; NaN if the shot does not show it.
    factor: f64,
    /// Variance of that distance under the scatter that the fit took: 1 from the shot, the rest from all other scatter.
    variance: f64,
}

/// The launch factor of each shot (`n_shots`).
fn shot_factors(seen: &ObservedShots, answer: &RefinedAnswer) -> Vec<FittedFactor> {
    let of_shot = |range: std::ops::Range<usize>| {
        let residual = |n: usize| seen.list[n].value - answer.predicted[n];
        let residuals = DVector::from_iterator(range.len(), range.clone().map(residual));
        let slopes = answer.over_shot_factor.rows(range.start, range.len());
        let weights = answer.covariance.of(range).cholesky().map(|factor| factor.solve(&slopes));
        weights.map_or(FittedFactor { factor: f64::NAN, variance: f64::NAN }, |weights| {
            let information = weights.dot(&slopes);
            FittedFactor { factor: weights.dot(&residuals) / information, variance: 1.0 / information }
        })
    };
    seen.shots().iter().map(|shot| of_shot(shot.observations())).collect()
}

/// Scatter of the factors [standard deviations that the fit took] if it exceeds chance. A shot that shows no factor is left out, so
/// it does not hide the scatter of the others.
fn greater_scatter(told: &[FittedFactor]) -> Option<f64> {
    let told: Vec<FittedFactor> = told.iter().copied().filter(|told| told.factor.is_finite()).collect();
    let freedom = told.len().checked_sub(1).filter(|freedom| *freedom > 0)? as f64;
    let weight = told.iter().map(|told| 1.0 / told.variance).sum::<f64>();
    let mean = told.iter().map(|told| told.factor / told.variance).sum::<f64>() / weight;
    let from_mean = |told: &FittedFactor| (told.factor - mean).powi(2);
    let chi_square: f64 = told.iter().map(|told| from_mean(told) / told.variance).sum();
    let scatter = (told.iter().map(from_mean).sum::<f64>() / freedom).sqrt();
    (chi_square > chi_square_quantile(freedom, EXCEEDED_BY_FEW) && scatter > 1.0).then_some(scatter)
}

/// Upper bound, at 95 %, of the standard deviation of numbers that scatter at least as much as a normal variable with `freedom`
/// degrees of freedom. NaN if a number is NaN or `freedom` is 0.
fn upper_bound(numbers: &[f64], freedom: usize) -> f64 {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    (squares / chi_square_quantile(freedom as f64, FIVE_PERCENT)).sqrt()
}

/// Quantile of χ² with `f` degrees of freedom at a standard normal deviate (Wilson and Hilferty 1931). Below 5 % it is slightly too
/// small.
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

    /// Quantiles from tables. A quantile that is too small makes a bound that is too large, by 2 % at most.
    #[test]
    fn quantiles_are_those_of_tables() {
        for (freedom, exact) in [(4.0, 0.7107), (5.0, 1.1455), (9.0, 3.3251), (30.0, 18.4927)] {
            let ratio = chi_square_quantile(freedom, FIVE_PERCENT) / exact;
            assert!((0.96..=1.0005).contains(&ratio), "{freedom}: {ratio}");
        }
    }

    /// Of 4,000 sets of shots, 5 % lie above their bound, with a standard error of 0.35 %. Noise of each shot only raises the bound.
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

    /// Six shots that are much alike narrow 5 %. They do not if six parameters follow them, or if one of them shows no factor. But
    /// that one does not hide that the others scatter more.
    #[test]
    fn shots_that_tell_no_bound_narrow_nothing() {
        let assumed = BetweenShots { percent: 5.0, source: BetweenShotsSource::Assumed, shots: 6 };
        let told = |factors: &[f64]| -> Vec<FittedFactor> {
            factors
                .iter()
                .map(|&factor| FittedFactor { factor, variance: if factor.is_nan() { factor } else { 1.0 } })
                .collect()
        };
        let alike = told(&[0.1, -0.1, 0.2, -0.2, 0.1, -0.1]);
        assert!(assumed.of_factors(&alike, 1).percent < 5.0);
        assert_eq!(assumed.of_factors(&alike, 6), assumed);
        assert_eq!(assumed.of_factors(&told(&[0.1, -0.1, 0.2, -0.2, 0.1, f64::NAN]), 1), assumed);
        let wide = assumed.of_factors(&told(&[4.0, -4.0, 5.0, -5.0, 4.0, f64::NAN]), 1);
        assert!(wide.percent > 5.0 && matches!(wide.source, BetweenShotsSource::WiderThan(_)), "{wide:?}");
        // A plan that says that shots do not differ at all is widened, too.
        let none = BetweenShots { percent: 0.0, source: BetweenShotsSource::Stated, shots: 6 };
        assert_eq!(none.of_factors(&alike, 1), none);
        let wide = none.of_factors(&told(&[4.0, -4.0, 5.0, -5.0, 4.0, -4.0]), 1);
        assert!((4.0..6.0).contains(&wide.percent) && wide.source == BetweenShotsSource::WiderThan(0.0));
    }
}
