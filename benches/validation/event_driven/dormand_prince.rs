//! One step of Dormand and Prince (J. Comput. Appl. Math. 6, 1980): fifth order, with an estimate of its error from an embedded
//! method of fourth order.

use super::Shelter;
use super::modes::{Modes, Motion};

/// Weights of earlier stages in each later one; the last row is the result of fifth order.
const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Weights of the difference between the results of fifth and of fourth order.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// State `length` [s] after `start` while the modes last, and the greatest error of a place [m] or velocity [m/s], relative where
/// either is greater than 1.
pub fn step(shelter: &Shelter, modes: &Modes, start: &Motion, length: f64) -> (Motion, f64) {
    let mut rates = vec![modes.rate(shelter, start)];
    let mut end = start.clone();
    for weights in STAGES {
        end = start.clone();
        for (weight, rate) in weights.iter().zip(&rates) {
            end.add(length * weight, rate);
        }
        rates.push(modes.rate(shelter, &end));
    }
    let mut error = Motion::at_rest(shelter);
    for (weight, rate) in ERROR.iter().zip(&rates) {
        error.add(length * weight, rate);
    }
    let error = error.greatest_over(&end);
    (end, error)
}
