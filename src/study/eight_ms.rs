//! Holes that fire so closely together that rules on ground vibration count them as one.

use crate::scene::Shot;
use crate::study::Case;

/// Time within which holes count as one [s]: records of blasts name the heaviest charge within any 8 ms
/// (30 CFR 816.68).
const TOGETHER: f64 = 8e-3;

/// Holes and charge that fire together in a planned shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithinEightMs {
    /// Most holes that fire within any 8 ms.
    pub holes: usize,
    /// Heaviest charge within any 8 ms [kg]; `None` if the plan names no charges.
    pub charge: Option<f64>,
}

impl WithinEightMs {
    /// Holes and charge that fire together in a shot of a case. Only the planned times count, without scatter of detonators.
    pub fn of(case: &Case, shot: &Shot) -> Self {
        let charged = case.plan.launches().any(|launch| launch.charge_kg.is_some());
        Self {
            holes: shot.most_holes_within(TOGETHER),
            charge: charged.then(|| shot.heaviest_charge_within(TOGETHER)),
        }
    }
}
