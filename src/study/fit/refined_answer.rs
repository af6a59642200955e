//! An answer of a fit near a minimum, with what its samples tell of its neighbourhood.

use nalgebra::{DMatrix, DVector};

use super::covariance::ObservationCovariance;
use super::search::Minimum;

/// An answer with what is known of its neighbourhood.
pub(super) struct RefinedAnswer {
    pub minimum: Minimum,
    /// The predictions there.
    pub predicted: Vec<f64>,
    /// Their derivatives (`n_observations` × `n_parameters`).
    pub slopes: DMatrix<f64>,
    /// Their change over a standard deviation of the launch factor of their shot (`n_observations`).
    pub over_shot_factor: DVector<f64>,
    pub covariance: ObservationCovariance,
    /// Whether the last round changed little.
    pub is_settled: bool,
}

impl RefinedAnswer {
    /// −2 × the logarithm of the likelihood, but for a constant.
    pub fn unlikelihood(&self) -> f64 {
        self.minimum.misfit + self.covariance.log_determinant
    }
}
