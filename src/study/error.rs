//! The error of a value computed at one step, estimated from runs of the same shot at neighbouring steps.
//!
//! 1. Symbols: h the step, v the value at h, vⱼ the value at the neighbouring step rⱼ h.
//! 2. The method is of second order: the run at r h differs from the run at h by (r² − 1) times the error at h.
//! 3. So each neighbour j gives an estimate of the error at h: sⱼ = (vⱼ − v) / (rⱼ² − 1).
//! 4. The reported error is MARGIN · max |sⱼ|.
//!
//! Where the motion is smooth in the step, the estimates agree. Where tires land and are launched anew, or cables go slack
//! and snap, the value jumps between nearby steps, and the estimates differ. The largest estimate counts, so two runs that
//! agree by luck are not believed.
//!
//! MARGIN was fitted on 600 random scenes. `cargo bench --bench calibration` measures on other scenes how often the true
//! error is within the reported error (about 19 of 20 times) and how large the reported error is (in the median about 5 to
//! 6.5 times the true error). The estimate covers the time integration alone. It does not cover the model, the numbers of
//! the plan, or a motion so sensitive that all steps miss the same event.

/// Ratio of neighbouring steps.
pub const RATIO: f64 = std::f64::consts::SQRT_2;
/// Number of neighbours wanted beside the run itself.
pub const NEIGHBOURS: usize = 4;
/// Reported error over the largest estimate.
const MARGIN: f64 = 3.05;

/// Estimated error of `value`, computed at `step`, from `(step, value)` of its neighbours; 0 without neighbours.
pub fn estimate(step: f64, value: f64, neighbours: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let estimates = neighbours.into_iter().map(|(other, near)| {
        let ratio = other / step;
        ((near - value) / (ratio * ratio - 1.0)).abs()
    });
    MARGIN * estimates.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ladder(value: impl Fn(f64) -> f64) -> f64 {
        estimate(1.0, value(1.0), (1..=4).map(|n| RATIO.powi(n)).map(|step| (step, value(step))))
    }

    #[test]
    fn a_second_order_error_is_found_with_the_margin() {
        assert!((ladder(|h| 7.0 + 0.01 * h * h) - 0.0305).abs() < 1e-12);
    }

    #[test]
    fn runs_that_agree_by_luck_are_not_believed() {
        // Peak force in kN at steps of 1, 2, 4 ms … of a long delay: the first two agree, the converged value is 35.7.
        let values = [31.03, 31.61, 38.26, 39.5, 40.68];
        let steps = (0..5).map(|n| RATIO.powi(n));
        let error = estimate(1.0, values[0], steps.zip(values).skip(1));
        assert!(error > 4.67, "{error}");
    }

    #[test]
    fn a_finer_neighbour_serves_as_well() {
        let value = |h: f64| 7.0 + 0.01 * h * h;
        assert!((estimate(1.0, value(1.0), [(0.5, value(0.5))]) - 0.0305).abs() < 1e-12);
    }
}
