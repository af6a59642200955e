//! Result of a fit: estimates, and the evidence for and against them.

use super::between_shots::BetweenShots;
use super::determined::NotDetermined;
use super::observation_bands::Prediction;
use super::parameter::Parameter;
use super::what_next::WhatNext;
use crate::choice::Unknown;
use crate::plan::Uncertainty;
use crate::plan::observations::Observation;
use crate::plan::write_fit::{EstimateToWrite, FitToWrite, LaunchUncertainty};

/// Result of a fit.
#[derive(Clone, Debug)]
pub enum FitResult {
    /// Estimates.
    Fitted(Fit),
    /// The observations do not determine some of the unknowns.
    NotDetermined {
        /// The parameters that are not determined, and an observation that would determine them.
        refused: NotDetermined,
        /// The observations, sorted by option.
        observed: Vec<Observation>,
        /// Prediction of the unchanged plan for each observation.
        predictions: Vec<Prediction>,
    },
    /// The plan states this unknown as exact.
    KnownExactly(Unknown),
    /// The method of the plan does not model this unknown.
    NotInMethod(Unknown),
}

/// Estimates, and the evidence for and against them.
#[derive(Clone, Debug, Default)]
pub struct Fit {
    /// Separate answers of nearly equal misfit, the best first; never empty.
    pub answers: Vec<Answer>,
    /// The observations, sorted by option.
    pub observed: Vec<Observation>,
    /// Index of the file of each observation.
    pub file: Vec<usize>,
    /// Prediction of the unchanged plan for each observation.
    pub predictions: Vec<Prediction>,
    /// Scatter of launch velocities between shots that the fit took; `None` if everything but the unknowns counts as exact.
    pub between_shots: Option<BetweenShots>,
    /// Uncertainty of launches after the fit; `None` if no launch was estimated.
    pub launches: Option<LaunchUncertainty>,
    /// What to observe next; `None` without samples, or if the estimates do not explain the observations.
    pub next: Option<WhatNext>,
}

impl Fit {
    /// The best answer, in the form that is written into a plan.
    pub fn to_write(&self) -> FitToWrite {
        let to_write = |estimate: &FittedParameter| EstimateToWrite {
            unknown: estimate.parameter.unknown,
            row: estimate.parameter.row,
            value: estimate.value,
            sd: estimate.sd,
        };
        FitToWrite {
            estimates: self.answers[0].estimates.iter().map(to_write).collect(),
            launches: self.launches,
        }
    }
}

/// One set of estimates.
#[derive(Clone, Debug, Default)]
pub struct Answer {
    /// One estimate per parameter.
    pub estimates: Vec<FittedParameter>,
    /// Correlation of the estimates (`n_parameters` × `n_parameters`).
    pub correlation: Vec<Vec<f64>>,
    /// One residual per observation.
    pub residuals: Vec<Residual>,
    /// Sum of squares of the independent residuals, including the residuals of the priors.
    pub chi_square: f64,
    /// Whether the estimates are final; if not, another round could move them.
    pub is_converged: bool,
    /// Degrees of freedom of `chi_square`; 0 if there are no more observations and priors than parameters.
    pub freedom: usize,
}

/// The estimate of one parameter, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedParameter {
    /// The parameter.
    pub parameter: Parameter,
    /// The estimate.
    pub value: f64,
    /// Standard deviation of the estimate.
    pub sd: f64,
    /// The number in the plan; `None` for ends that are stiff.
    pub was: Option<f64>,
    /// Distance of the estimate from the mean that `[uncertainty]` states, in its standard deviations; `None` if it states none.
    pub from_stated: Option<f64>,
    /// Whether the estimate lies at an end of its plausible range.
    pub is_at_end: bool,
}

/// Difference between an observation and its prediction by the estimates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The predicted value, averaged over the scatter; NaN if the tire never lifts or never lands.
    pub predicted: f64,
    /// Standard deviation of the observation about its prediction, from the stated error, the computation, and the scatter in the plan.
    pub sd: f64,
    /// Observed value minus predicted value, in these standard deviations.
    pub deviation: f64,
    /// Error of the time integration of the prediction.
    pub error: f64,
}

/// Residual above which an observation is suspicious [standard deviations]. By chance alone, 0.3 % of the residuals are so large.
const SUSPICIOUS: f64 = 3.0;
/// Standard normal deviate above which a sum of squares is too great. Chance exceeds it with a probability of 0.1 %.
const TOO_GREAT: f64 = 3.09;

impl Residual {
    /// Whether the observation is hard to believe, given the others.
    pub fn is_suspicious(&self) -> bool {
        self.deviation.is_nan() || self.deviation.abs() > SUSPICIOUS
    }
}

impl Answer {
    /// Whether the sum of squares is no greater than chance makes it; true if there is nothing left to test.
    pub fn explains(&self) -> bool {
        if self.freedom == 0 {
            return true;
        }
        // The cube root of χ²/f is nearly normal (Wilson and Hilferty 1931).
        let f = self.freedom as f64;
        let spread = 2.0 / (9.0 * f);
        ((self.chi_square / f).cbrt() - (1.0 - spread)) / spread.sqrt() <= TOO_GREAT
    }

    /// Uncertainty of launches by this answer: that of the launch that is known worst. The uncertainty `before` is never narrowed
    /// by three kinds of fits: by launches by row, because a plan has no key of its own for them; by estimates that are not final;
    /// and by a fit without `between_shots_percent`, because it takes all other inputs as exact.
    pub(super) fn launch_uncertainty(
        &self,
        before: &Uncertainty,
        between_shots_percent: Option<f64>,
    ) -> LaunchUncertainty {
        let is_launch = |estimate: &&FittedParameter| {
            matches!(estimate.parameter.unknown, Unknown::Launch | Unknown::LaunchByRow)
        };
        let percents =
            self.estimates.iter().filter(is_launch).map(|estimate| 1e2 * estimate.sd / estimate.value);
        let fitted = percents.fold(0.0, f64::max);
        let is_by_row = self.estimates.iter().any(|estimate| estimate.parameter.row.is_some());
        let narrows = self.is_converged && between_shots_percent.is_some() && !is_by_row;
        LaunchUncertainty {
            common_percent: if narrows { fitted } else { fitted.max(before.launch_common_percent) },
            between_shots_percent: between_shots_percent.unwrap_or(before.launch_between_shots_percent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    /// This fit knows launches to 2 %, the plan before to 3 %. The 2 % count only if the fit includes scatter between shots,
    /// estimates all launches at once, and is final. A greater uncertainty than before always counts.
    #[test]
    fn nothing_less_sure_is_written_as_surer() {
        let text = include_str!("../../../plans/amur-three-rows.toml");
        let before = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")).uncertainty;
        let percent = |row: Option<usize>, sd: f64, is_converged: bool, between: Option<f64>| {
            let unknown = if row.is_some() { Unknown::LaunchByRow } else { Unknown::Launch };
            let parameter = Parameter { unknown, row };
            let (was, from_stated, is_at_end) = (Some(1.0), None, false);
            let estimate = FittedParameter { parameter, value: 1.1, sd, was, from_stated, is_at_end };
            let (correlation, residuals) = (vec![vec![1.0]], Vec::new());
            let (estimates, chi_square, freedom) = (vec![estimate], 0.0, 0);
            let answer = Answer { estimates, correlation, residuals, chi_square, is_converged, freedom };
            let known = answer.launch_uncertainty(&before, between);
            assert_eq!(known.between_shots_percent, between.unwrap_or(before.launch_between_shots_percent));
            (1e6 * known.common_percent).round() / 1e6
        };
        assert_eq!(before.launch_common_percent, 3.0);
        assert_eq!(percent(None, 0.022, true, Some(5.0)), 2.0);
        assert_eq!(percent(None, 0.022, true, None), 3.0, "all else was taken for exact");
        assert_eq!(percent(None, 0.022, false, Some(5.0)), 3.0, "not converged");
        assert_eq!(percent(Some(1), 0.022, true, Some(5.0)), 3.0, "by row");
        assert_eq!(percent(None, 0.044, true, Some(5.0)), 4.0, "less sure than before");
    }
}
