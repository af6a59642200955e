//! What a fit finds: estimates, and what speaks for and against them.

use super::determined::NotDetermined;
use super::observation_bands::{NextObservation, Prediction};
use super::parameter::Parameter;
use crate::choice::Unknown;
use crate::plan::observations::Observation;
use crate::plan::write_fit::EstimateToWrite;

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
#[derive(Clone, Debug)]
pub struct Fit {
    /// Separate answers of nearly equal misfit, the best first; never empty.
    pub answers: Vec<Answer>,
    /// The observations, in the order of their options.
    pub observed: Vec<Observation>,
    /// Index of the file of each observation.
    pub file: Vec<usize>,
    /// What the plan as it is says of each observation.
    pub predictions: Vec<Prediction>,
    /// What to observe next.
    pub next: Option<NextObservation>,
}

/// One set of estimates.
#[derive(Clone, Debug)]
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

/// Residual from which an observation is suspicious [standard deviations].
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

    /// The estimates as a plan writes them.
    pub fn to_write(&self) -> Vec<EstimateToWrite> {
        let to_write = |estimate: &FittedParameter| EstimateToWrite {
            unknown: estimate.parameter.unknown,
            row: estimate.parameter.row,
            value: estimate.value,
            sd: estimate.sd,
        };
        self.estimates.iter().map(to_write).collect()
    }
}
