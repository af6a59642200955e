//! An answer of a fit near a minimum, with the predictions around it from samples.

use nalgebra::{DMatrix, DVector};

use super::covariance::ObservationCovariance;
use super::search::Minimum;

/// An answer, and what is known of its neighborhood.
pub(super) struct RefinedAnswer {
    pub minimum: Minimum,
    /// The predictions at the answer (`n_observations`).
    pub predicted: Vec<f64>,
    /// Derivatives of the predictions (`n_observations` × `n_parameters`).
    pub slopes: DMatrix<f64>,
    /// Change of each prediction over a standard deviation of the launch factor of its shot (`n_observations`).
    pub over_shot_factor: DVector<f64>,
    pub covariance: ObservationCovariance,
    /// Whether the answer is final: the last round changed little.
    pub is_converged: bool,
}

impl RefinedAnswer {
    /// −2 times the logarithm of the likelihood, up to a constant.
    pub fn unlikelihood(&self) -> f64 {
        self.minimum.misfit + self.covariance.log_determinant
    }
}
