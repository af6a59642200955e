//! What a fit finds: estimates, and what speaks for and against them.

use super::between_shots::BetweenShots;
use super::determined::NotDetermined;
use super::observation_bands::Prediction;
use super::parameter::Parameter;
use super::what_next::WhatNext;
use crate::choice::Unknown;
use crate::plan::Uncertainty;
use crate::plan::observations::Observation;
use crate::plan::write_fit::{EstimateToWrite, FitToWrite, LaunchUncertainty};

/// What a fit finds.
#[derive(Clone, Debug)]
pub enum FitResult {
    /// Estimates.
    Fitted(Fit),
    /// The observations do not determine some of the unknowns.
    NotDetermined {
        /// Which, and what would.
        refused: NotDetermined,
        /// The observations, in the order of their options.
        observed: Vec<Observation>,
        /// What the plan as it is says of each observation.
        predictions: Vec<Prediction>,
    },
    /// The plan says that an unknown is known exactly.
    KnownExactly(Unknown),
    /// The method of the plan has no such effect.
    NotInMethod(Unknown),
}

/// Estimates and what speaks for and against them.
#[derive(Clone, Debug, Default)]
pub struct Fit {
    /// Separate answers of nearly equal misfit, the best first; never empty.
    pub answers: Vec<Answer>,
    /// The observations, in the order of their options.
    pub observed: Vec<Observation>,
    /// Index of the file of each observation.
    pub file: Vec<usize>,
    /// What the plan as it is says of each observation.
    pub predictions: Vec<Prediction>,
    /// How far launch velocities were taken to differ from shot to shot; `None` where all but the unknowns was taken for exact.
    pub between_shots: Option<BetweenShots>,
    /// How well launches are known after the fit; `None` where none were estimated.
    pub launches: Option<LaunchUncertainty>,
    /// What to observe next; `None` without samples, and where the estimates do not explain what was seen.
    pub next: Option<WhatNext>,
}

impl Fit {
    /// The best answer as a plan writes it.
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
    /// One for each parameter.
    pub estimates: Vec<FittedParameter>,
    /// Correlation of the estimates (`n_parameters` × `n_parameters`).
    pub correlation: Vec<Vec<f64>>,
    /// One for each observation.
    pub residuals: Vec<Residual>,
    /// Sum of the squares of the independent residuals, with those of what the plan knew of the parameters.
    pub chi_square: f64,
    /// Whether the estimates have settled; if not, another round could move them.
    pub is_settled: bool,
    /// Its degrees of freedom; 0 where there are as many parameters as observations.
    pub freedom: usize,
}

/// The estimate of one parameter, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedParameter {
    /// The parameter.
    pub parameter: Parameter,
    /// The estimate.
    pub value: f64,
    /// Its standard deviation.
    pub sd: f64,
    /// The number of the plan; `None` for ends that are stiff.
    pub was: Option<f64>,
    /// How far the estimate lies from what `[uncertainty]` states, in standard deviations of that; `None` where it states nothing.
    pub from_stated: Option<f64>,
    /// Whether the estimate lies at an end of its plausible range.
    pub is_at_end: bool,
}

/// How an observation lies beside the shot of the estimates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The predicted value, on average over what scatters; not a number where the tire never lifts, or never lands.
    pub predicted: f64,
    /// Standard deviation of the observation about its prediction: stated, of computing, of the scatter of the plan.
    pub sd: f64,
    /// Observed less predicted, in these standard deviations.
    pub deviation: f64,
    /// Error of the time integration of the prediction.
    pub error: f64,
}

/// Residual from which an observation is suspicious [standard deviations]: chance alone makes 0.3 % of them so large.
const SUSPICIOUS: f64 = 3.0;
/// Standard normal deviate of a sum of squares that is too great: with a probability of 0.1 %.
const TOO_GREAT: f64 = 3.09;

impl Residual {
    /// Whether the observation is hard to believe beside the others.
    pub fn is_suspicious(&self) -> bool {
        self.deviation.is_nan() || self.deviation.abs() > SUSPICIOUS
    }
}

impl Answer {
    /// Whether the sum of squares is no greater than chance makes it; true where nothing is left to test.
    pub fn explains(&self) -> bool {
        if self.freedom == 0 {
            return true;
        }
        // The cube root of χ²/f is nearly normal (Wilson and Hilferty 1931).
        let f = self.freedom as f64;
        let spread = 2.0 / (9.0 * f);
        ((self.chi_square / f).cbrt() - (1.0 - spread)) / spread.sqrt() <= TOO_GREAT
    }

    /// How well launches are known by this answer: as the least sure of them. What was known `before` is not narrowed by launches by
    /// row, for which a plan has no key of their own, by estimates that have not settled, and by a fit without a scatter from shot to
    /// shot, `between_shots_percent`, which took all else for exact.
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
        let narrows = self.is_settled && between_shots_percent.is_some() && !is_by_row;
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

    /// Launches are known to 2 % by this fit, and were to 3 %: only one that counts on scatter between shots says so, of all
    /// launches at once, once it has settled. What is less sure than before is always told.
    #[test]
    fn nothing_less_sure_is_written_as_surer() {
        let text = include_str!("../../../plans/amur-three-rows.toml");
        let before = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")).uncertainty;
        let percent = |row: Option<usize>, sd: f64, is_settled: bool, between: Option<f64>| {
            let unknown = if row.is_some() { Unknown::LaunchByRow } else { Unknown::Launch };
            let parameter = Parameter { unknown, row };
            let (was, from_stated, is_at_end) = (Some(1.0), None, false);
            let estimate = FittedParameter { parameter, value: 1.1, sd, was, from_stated, is_at_end };
            let (correlation, residuals) = (vec![vec![1.0]], Vec::new());
            let (estimates, chi_square, freedom) = (vec![estimate], 0.0, 0);
            let answer = Answer { estimates, correlation, residuals, chi_square, is_settled, freedom };
            let known = answer.launch_uncertainty(&before, between);
            assert_eq!(known.between_shots_percent, between.unwrap_or(before.launch_between_shots_percent));
            (1e6 * known.common_percent).round() / 1e6
        };
        assert_eq!(before.launch_common_percent, 3.0);
        assert_eq!(percent(None, 0.022, true, Some(5.0)), 2.0);
        assert_eq!(percent(None, 0.022, true, None), 3.0, "all else was taken for exact");
        assert_eq!(percent(None, 0.022, false, Some(5.0)), 3.0, "not settled");
        assert_eq!(percent(Some(1), 0.022, true, Some(5.0)), 3.0, "by row");
        assert_eq!(percent(None, 0.044, true, Some(5.0)), 4.0, "less sure than before");
    }
}
