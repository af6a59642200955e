//! Error of a value computed at one step, estimated from runs of the same shot at neighboring steps.
//!
//! 1. Symbols: h is the step, v is the value at h, vⱼ is the value at the neighboring step rⱼ h.
//! 2. The method is of second order: the run at r h differs from the run at h by (r² − 1) times the error at h.
//! 3. So each neighbor j gives an estimate of the error at h: sⱼ = (vⱼ − v) / (rⱼ² − 1).
//! 4. The reported error is MARGIN · max |sⱼ|.
//!
//! If the motion is smooth in the step, the estimates agree. If tires land and are launched anew, or cables go slack and snap, the
//! value jumps between nearby steps, and the estimates differ. The largest estimate counts. So two runs that agree by luck are not
//! believed.
//!
//! All steps of a ladder may miss the same event and agree on a wrong value. Nearby shots show this. They are pairs of shots whose
//! inputs are changed a little to both sides ([`Shot::nearby_pair`](crate::scene::Shot::nearby_pair)), and they run at the step of
//! the coarsest neighbor. A value that depends smoothly on the inputs lies in the middle of each pair: |v₊ + v₋ − 2v| is of second
//! order in the change. If this disagreement is more than [`FAR_ERROR_FACTOR`] times the error, an event is near, and the
//! disagreement becomes the error.
//!
//! A greatest value has rivals: peaks at other times. If a rival reaches above the greatest value within the rival's own error, the
//! greatest value is uncertain up to there. `study::as_planned::peaks` takes care of this.
//!
//! MARGIN and FAR_ERROR_FACTOR were fitted on 1,680 random scenes of 14 regimes. `cargo bench --bench calibration` measures on
//! other scenes how often the true error is within the reported error, by level, quantity and regime. The estimate covers the time
//! integration alone: not the model, and not the numbers of the plan.

/// Ratio of neighboring steps. Line 3 divides by 1 for the next step, so the difference is the error itself.
pub const RATIO: f64 = std::f64::consts::SQRT_2;
/// Number of neighbors beside the run itself. The coarsest has four times the step and sixteen times the error.
pub const NEIGHBOURS: usize = 4;
/// Reported error over the largest estimate. On the scenes of the fit, the lowest coverage of any level and quantity is 94.3 % with
/// 2.0, 91.2 % with 1.6, and 96.4 % with 2.5. But with 2.5 the errors are 5.6 instead of 4.5 times the true errors
/// (`benches/RESULTS.md`).
const MARGIN: f64 = 2.0;

/// Number of pairs of nearby shots. With two pairs the lowest coverage rises from 94.3 to 96.4 %.
pub const PAIRS: u64 = 2;
/// Disagreement of nearby shots over the error, above which the disagreement becomes the error. In four of five scenes it never does.
const FAR_ERROR_FACTOR: f64 = 3.0;

/// Error of a value, from its `error` by neighboring steps and its values `[v₊, v₋]` in pairs of nearby shots. `between` is the
/// value of the shot itself at the step of the pairs.
pub fn widened(error: f64, between: f64, pairs: impl IntoIterator<Item = [f64; 2]>) -> f64 {
    let disagreements = pairs.into_iter().map(|[more, less]| (more + less - 2.0 * between).abs());
    let greatest = disagreements.fold(0.0, f64::max);
    if greatest > FAR_ERROR_FACTOR * error { greatest } else { error }
}

/// Estimated error of `value`, computed at `step`, from `(step, value)` of its neighbors; infinite without neighbors, or if
/// one of them is no number.
pub fn estimate(step: f64, value: f64, neighbours: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let estimates = neighbours.into_iter().map(|(other, near)| {
        let ratio = other / step;
        ((near - value) / (ratio * ratio - 1.0)).abs()
    });
    // 0 would say that the value is exact, and `max` passes over what is no number.
    let known = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
    MARGIN * estimates.map(known).reduce(f64::max).unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ladder(value: impl Fn(f64) -> f64) -> f64 {
        estimate(1.0, value(1.0), (1..=4).map(|n| RATIO.powi(n)).map(|step| (step, value(step))))
    }

    #[test]
    fn what_is_not_known_is_not_exact() {
        assert_eq!(estimate(1.0, 7.0, []), f64::INFINITY);
        assert_eq!(estimate(1.0, 7.0, [(2.0, 7.0), (4.0, f64::NAN)]), f64::INFINITY);
        assert_eq!(estimate(1.0, 7.0, [(2.0, 7.0)]), 0.0);
    }

    #[test]
    fn a_second_order_error_is_found_with_the_margin() {
        assert!((ladder(|h| 7.0 + 0.01 * h * h) - 0.01 * MARGIN).abs() < 1e-12);
    }

    #[test]
    fn runs_that_agree_by_luck_are_not_believed() {
        // Peak force in kN at steps of 1, √2, 2 ms … of a long delay: the first two agree, the converged value is 35.7.
        let values = [31.03, 31.61, 38.26, 39.5, 40.68];
        let steps = (0..5).map(|n| RATIO.powi(n));
        let error = estimate(1.0, values[0], steps.zip(values).skip(1));
        assert!(error > 4.6, "{error}");
    }

    #[test]
    fn shots_on_both_sides_of_an_event_widen_the_error() {
        let smooth = |launch: f64| launch * launch / 19.62;
        let pair = |peak: fn(f64) -> f64| [peak(6.006), peak(5.994)];
        assert_eq!(widened(1e-5, smooth(6.0), [pair(|launch| launch * launch / 19.62)]), 1e-5);
        // Above 6 m/s a cable catches the tire.
        let caught = |launch: f64| if launch > 6.0 { 1.5 } else { launch * launch / 19.62 };
        let error = widened(1e-5, caught(6.0), [pair(caught)]);
        assert!(error > 0.3, "{error}");
    }

    #[test]
    fn a_finer_neighbour_serves_as_well() {
        let value = |h: f64| 7.0 + 0.01 * h * h;
        assert!((estimate(1.0, value(1.0), [(0.5, value(0.5))]) - 0.01 * MARGIN).abs() < 1e-12);
    }
}
