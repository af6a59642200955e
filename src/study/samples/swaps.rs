//! Blast rows that may fire in reverse order, because the detonators in their holes scatter.

use crate::plan::Time;
use crate::sorting::sorted;
use crate::study::Case;

/// Two successive blast rows that may fire in reverse order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swap {
    /// Indices of the blast rows, in the planned order.
    pub rows: [usize; 2],
    /// Planned interval between the rows [s].
    pub interval: f64,
    /// Probability that the first hole of the second row fires before the first hole of the first row. If the holes of a row fire
    /// together, it is the probability for any one hole of each row.
    pub probability: f64,
}

/// Pairs of successive rows of an option that fire in reverse order with a probability of at least `least`. In reverse order, the
/// first hole of the second row fires before the first hole of the first row.
pub fn find_swaps(case: &Case, option: usize, least: f64) -> Vec<Swap> {
    let uncertainty = &case.plan.uncertainty;
    let in_hole = uncertainty.in_hole_deviation();
    let times = case.plan.delays[option].timing.fire_at();
    let rows: Vec<(Time, usize)> = sorted(times.into_iter().zip(0..));
    let swap = |pair: &[(Time, usize)]| {
        let [(early, first), (late, second)] = [pair[0], pair[1]];
        let interval = (late - early).seconds();
        let deviation = uncertainty.delay.deviation(interval).hypot(in_hole.hypot(in_hole));
        // The gap between rows is never negative: without detonators in the holes rows keep their order.
        let may_swap = interval > 0.0 && in_hole > 0.0;
        let probability = 0.5 * libm::erfc(interval / (deviation * std::f64::consts::SQRT_2));
        (may_swap && probability >= least).then_some(Swap { rows: [first, second], interval, probability })
    };
    rows.windows(2).filter_map(swap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{DelayScatter, Plan};

    /// Two rows fire 20 ms apart. The gap between them scatters by 10 ms, and so does each hole. With √3 × 10 ms the probability is
    /// 1 − Φ(20 / 17.32) = 0.1241; for 45 ms it is 0.0047. Rows that fire together have no order. Rows whose holes fire with the
    /// row keep their order.
    #[test]
    fn rows_that_may_swap_are_named() {
        let text = r#"
shelter = { layout = "grid", rows = 2, columns = 2, spacing_m = 1.5 }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 6 }, { name = "2", under_row = 2, launch_m_s = 6 }]
limits = { flight_height_m = 5, cable_safety_factor = 1 }
delay = [
    { name = "late", at_ms = [30, 10] },
    { name = "later", at_ms = [0, 45] },
    { name = "together", at_ms = [0, 0] },
]
"#;
        let mut case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        case.plan.uncertainty.delay = DelayScatter { sd_ms: 10.0, cv_percent: 0.0 };
        case.plan.uncertainty.in_hole_delay_ms = 500.0;
        let [late, later, together] = [0, 1, 2].map(|option| find_swaps(&case, option, 1e-2));
        let [Swap { rows: [1, 0], interval, probability }] = late[..] else { panic!("{late:?}") };
        assert!((interval - 0.02).abs() < 1e-12 && (probability - 0.124_1).abs() < 1e-4, "{probability}");
        assert!(later.is_empty() && together.is_empty());
        case.plan.uncertainty.in_hole_delay_ms = 0.0;
        assert!(find_swaps(&case, 0, 1e-2).is_empty());
    }
}
