//! Whether observations determine the parameters, and which other observation would.
//!
//! 1. Symbols: J are the derivatives of the predictions, made independent and of unit variance. S is the diagonal matrix of the
//!    standard deviations of uniform distributions over the plausible ranges.
//! 2. A unit vector v is a combination of the parameters. If ‖J S v‖ = σ, the observations know the combination to 1/σ of its range.
//! 3. A combination with σ below [`DETERMINED`] is not determined. Neither is any parameter that is a good part of it.
//!
//! Priors in the plan do not count here: observations that add nothing to them are refused as well.

use nalgebra::{DMatrix, DVector};

use super::observed_shots::ObservedShot;
use super::parameter::Parameter;
use super::predictor::Predictor;
use super::search::SearchBox;
use crate::choice::ObservedQuantity;
use crate::plan::observations::ObservedPoint;
use crate::scene::Scene;
use crate::study::NoResult;

/// Least σ of a combination that the observations determine.
const DETERMINED: f64 = 2.0;
/// Least σ that makes another observation worth while.
const WORTH_OBSERVING: f64 = 1.0;
/// Least share of a parameter in an undetermined combination at which the parameter is named.
const LEAST_SHARE_NAMED: f64 = 0.3;
/// Shift along a combination to each side, in standard deviations of the plausible ranges.
const SHIFT: f64 = 0.15;

/// Parameters that the observations do not determine.
#[derive(Clone, Debug, PartialEq)]
pub struct NotDetermined {
    /// The parameters: a single one, or several of which only a combination is determined.
    pub parameters: Vec<Parameter>,
    /// What else to observe; `None` if no observation of these shots would help.
    pub observe: Option<Observable>,
}

/// A possible observation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observable {
    /// Index of the delay option.
    pub option: usize,
    /// The point to watch.
    pub watched: ObservedPoint,
}

/// Assumed standard deviation of an observation with this value, if none is stated: 5 cm, 20 ms, 5 % (of 1 kN or more).
pub fn assumed_sd(quantity: ObservedQuantity, value: f64) -> f64 {
    match quantity {
        ObservedQuantity::FlightHeight | ObservedQuantity::Height | ObservedQuantity::Drift => 0.05,
        ObservedQuantity::Lift | ObservedQuantity::Landing => 0.02,
        ObservedQuantity::Force => 0.05 * value.abs().max(1e3),
    }
}

/// Possible observations of a shot: flight height, landing and drift of each tire, and force of each cable.
pub fn observables(scene: &Scene) -> Vec<ObservedPoint> {
    let of_tires = [ObservedQuantity::FlightHeight, ObservedQuantity::Landing, ObservedQuantity::Drift];
    let tires = itertools::iproduct!(of_tires, 0..scene.tire_count());
    let cables = (0..scene.cables.len()).map(|cable| (ObservedQuantity::Force, cable));
    tires.chain(cables).map(|(quantity, index)| ObservedPoint { quantity, index, time: 0.0 }).collect()
}

/// A combination of parameters [standard deviations of their ranges] that is not determined; `None` if all are determined. `slopes`
/// are J.
///
/// If several combinations are not determined, the basis that an eigenvalue solver finds depends on the last digit. So the result
/// is a projection onto all of them: the projection of the parameter that is nearest to them, the first of several.
fn undetermined(slopes: &DMatrix<f64>, scales: &DVector<f64>) -> Option<DVector<f64>> {
    let scaled = slopes * DMatrix::from_diagonal(scales);
    let eigen = (scaled.transpose() * scaled).symmetric_eigen();
    let mut projection = DMatrix::zeros(scales.len(), scales.len());
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value < DETERMINED * DETERMINED {
            projection += vector * vector.transpose();
        }
    }
    let near = projection.diagonal();
    let nearest = near.iter().position(|&share| share > 0.0 && share >= near.max() - ALIKE)?;
    Some(projection.column(nearest).normalize())
}

/// Two squared cosines that differ by less than this count as equal.
const ALIKE: f64 = 1e-6;

/// Refuses parameters that observations do not determine; `slopes` are J at the best answer. The search for another observation
/// looks at `own`, the coordinates of the plan: if nothing is determined, the best answer may lie anywhere.
pub fn refuse(
    predictor: &Predictor<'_>,
    space: &SearchBox,
    own: &[f64],
    slopes: &DMatrix<f64>,
) -> Result<Option<NotDetermined>, NoResult> {
    let scales = DVector::from_iterator(
        own.len(),
        space.ranges.iter().map(|[low, high]| (high - low) / 12.0_f64.sqrt()),
    );
    let Some(combination) = undetermined(slopes, &scales) else { return Ok(None) };
    let named = predictor
        .parameters
        .iter()
        .zip(combination.iter())
        .filter(|(_, share)| share.abs() > LEAST_SHARE_NAMED);
    let parameters = named.map(|(&parameter, _)| parameter).collect();
    let all = observables(predictor.case(own).scene());
    let shots =
        predictor.shots.iter().map(|shot| ObservedShot { watched: all.clone(), ..shot.clone() }).collect();
    let wide = Predictor {
        plan: predictor.plan.clone(),
        parameters: predictor.parameters.clone(),
        shots,
        ..*predictor
    };
    let shifted = |side: f64| -> Vec<f64> {
        let shift = |n: usize| own[n] + side * SHIFT * scales[n] * combination[n];
        (0..own.len()).map(|n| shift(n).clamp(space.ranges[n][0], space.ranges[n][1])).collect()
    };
    let [more, less] = [wide.values(&shifted(1.0), 1.0)?, wide.values(&shifted(-1.0), 1.0)?];
    let (Some(more), Some(less)) = (more, less) else {
        return Ok(Some(NotDetermined { parameters, observe: None }));
    };
    let mut best: Option<(f64, Observable)> = None;
    for (n, (more, less)) in more.iter().zip(&less).enumerate() {
        let (option, watched) = (wide.shots[n / all.len()].option, all[n % all.len()]);
        let sigma = (more - less).abs() / (2.0 * SHIFT * assumed_sd(watched.quantity, *more));
        if sigma >= WORTH_OBSERVING && best.is_none_or(|(most, _)| sigma > most) {
            best = Some((sigma, Observable { option, watched }));
        }
    }
    Ok(Some(NotDetermined { parameters, observe: best.map(|(_, candidate)| candidate) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One observation of a sum determines the sum, not the difference. Two observations of different sums determine both.
    #[test]
    fn a_sum_does_not_tell_its_terms() {
        let scales = DVector::from_element(2, 1.0);
        let combination =
            undetermined(&DMatrix::from_row_slice(1, 2, &[50.0, 50.0]), &scales).expect("a difference");
        assert!((combination[0] + combination[1]).abs() < 1e-9 && combination[0].abs() > LEAST_SHARE_NAMED);
        assert_eq!(undetermined(&DMatrix::from_row_slice(2, 2, &[50.0, 50.0, 50.0, 10.0]), &scales), None);
        // Nothing is known of the second and the third, in any basis. The second stands for both.
        let both =
            undetermined(&DMatrix::from_row_slice(1, 3, &[50.0, 0.0, 0.0]), &DVector::from_element(3, 1.0));
        assert!(both.is_some_and(|both| (both - DVector::from_vec(vec![0.0, 1.0, 0.0])).norm() < 1e-9));
        let alone = undetermined(&DMatrix::from_row_slice(2, 2, &[50.0, 0.1, 20.0, 0.0]), &scales)
            .expect("the second");
        assert!(alone[0].abs() < LEAST_SHARE_NAMED && alone[1].abs() > 0.99);
    }
}
