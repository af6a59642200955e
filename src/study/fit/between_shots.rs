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
//! 5. Shots that lie freakishly close together, by chance or because one was typed again, would make that bound as small as one
//!    likes. But a shot tells its factor no better than 1/gᵀS⁻¹g − 1 says, the variance n² of what else scatters, in units of σ².
//!    So no bound is smaller than σ n, and none smaller than [`LEAST_PERCENT`], which a plan without a word assumes.
//!
//! From two shots on, they can show that the plan's number is too small: under it Σ (z − z̄)² gᵀS⁻¹g is a χ² with one degree of
//! freedom less than shots. Where it exceeds the 97.5 % quantile, the fit takes σ √(Σ (z − z̄)² / f) instead, which counts all scatter as
//! that of the shots. A plan that says that shots do not differ is asked so with [`LEAST_PERCENT`]: of no scatter there is no z.

use nalgebra::DVector;

use super::observed_shots::ObservedShots;
use super::refined_answer::RefinedAnswer;
use crate::plan::Uncertainty;
use crate::plan::write_fit::StatedKeys;

/// Least number of shots that say how far shots differ: of five the upper bound is 2.4 times the spread found, of three 4.4 times.
pub const LEAST_SHOTS: usize = 5;

/// What a fit takes at least where the plan does not say how far shots differ [%].
const CAUTIOUS_PERCENT: f64 = 5.0;

/// Least scatter from shot to shot that shots can show [%].
const LEAST_PERCENT: f64 = 1.0;

/// Standard normal deviate above which 2.5 % lie.
const EXCEEDED_BY_FEW: f64 = 1.96;

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BetweenShotsSource {
    /// The plan states it.
    Stated,
    /// The plan leaves it out.
    Assumed,
    /// The shots bound it.
    UpperBound,
    /// The shots differ by more than the plan states, or leaves to be assumed, which is this number [%].
    WiderThan(f64),
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

    /// What a fit takes first [%].
    pub(super) fn taken_first(self) -> f64 {
        if self.percent == 0.0 && self.shots > 1 { LEAST_PERCENT } else { self.percent }
    }

    /// The upper bound of `seen` where that is smaller, and their own scatter where that is surely greater; `answer` is the best of
    /// a fit with `parameters` that took the scatter of [`Self::taken_first`].
    pub(super) fn of_shots(self, seen: &ObservedShots, answer: &RefinedAnswer, parameters: usize) -> Self {
        // What a plan says that shots do not do is not shown by observations that no launch explains.
        let shows = self.percent > 0.0 || answer.is_settled;
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
        // Not a number where the shots tell no bound: no maximum may make a small one of it.
        let bound = self.percent * upper_bound(&factors, freedom);
        match factors.len() >= LEAST_SHOTS && bound < self.percent && least < self.percent {
            true => Self { percent: bound.max(least), source: BetweenShotsSource::UpperBound, ..self },
            false => self,
        }
    }
}

/// What one shot tells of its launch factor, in standard deviations that the fit took.
#[derive(Clone, Copy)]
struct FittedFactor {
    /// How far the factor lies from the mean; not a number where the shot does not tell.
    factor: f64,
    /// Variance of that number under the scatter that the fit took: 1 of the shot, the rest of all else.
    variance: f64,
}

/// What each shot tells.
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

/// Scatter of the factors [standard deviations that the fit took], where it is more than chance makes it. A shot that does not tell
/// hides none of it.
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

    /// Six shots much alike narrow 5 %; not where as many parameters follow them, and not where one of them does not tell. Nor does that
    /// one hide that the others scatter more.
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
        // A plan that says that they do not differ at all is widened, too.
        let none = BetweenShots { percent: 0.0, source: BetweenShotsSource::Stated, shots: 6 };
        assert_eq!(none.of_factors(&alike, 1), none);
        let wide = none.of_factors(&told(&[4.0, -4.0, 5.0, -5.0, 4.0, -4.0]), 1);
        assert!((4.0..6.0).contains(&wide.percent) && wide.source == BetweenShotsSource::WiderThan(0.0));
    }
}
