//! How far a value at one step is from the converged one, judged from the same run at neighbouring steps.
//!
//! Where the motion is smooth in the step, the method is of second order: two runs at steps h and r h differ by
//! (r² − 1) times the error at h. Where tires land and are launched anew, cables go slack and snap, the value jumps between
//! nearby steps and all differences are alike. [`estimate`] divides by (r² − 1) to the power [`TRUST`] only, between the
//! two, and takes the largest over several neighbours, so that two runs that agree by luck are not believed.
//!
//! It estimates the error of the time integration. What the model leaves out it cannot know.

/// How many times coarser each neighbour is.
pub const RATIO: f64 = std::f64::consts::SQRT_2;
/// Neighbours wanted beside the run itself.
pub const NEIGHBOURS: usize = 3;
/// 1: differences shrink as second order promises; 0: not at all.
const TRUST: f64 = 0.5;
/// Widens the estimate.
const MARGIN: f64 = 1.2;

/// Estimated error of `value`, computed at `step`, from `(step, value)` of neighbours.
pub fn estimate(step: f64, value: f64, neighbours: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let error = |(other, near): (f64, f64)| {
        let ratio = other / step;
        (near - value).abs() / (ratio * ratio - 1.0).abs().powf(TRUST)
    };
    MARGIN * neighbours.into_iter().map(error).fold(0.0, f64::max)
}
