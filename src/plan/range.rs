//! What each number of a plan may be: the reader refuses anything else, and the schema says so.

use std::ops::RangeInclusive;

type Range = RangeInclusive<f64>;

/// Most tires in a shelter.
pub const MOST_TIRES: usize = 4_000_000;
pub const BORDER_ROWS: RangeInclusive<usize> = 0..=1000;
/// Border rows that `shelter size` may try.
pub const SIZED_BORDER_ROWS: RangeInclusive<usize> = 0..=100;

pub const PLACE_M: Range = -1e7..=1e7;
pub const SPACING_M: Range = 1e-4..=1e5;
pub const MASS_KG: Range = 1e-3..=1e7;
pub const DIAMETER_M: Range = 0.0..=1e3;
/// Axial stiffness and breaking force.
pub const CABLE_KN: Range = 1e-6..=1e9;
pub const SLACK_PERCENT: Range = 0.0..=1e3;
pub const TERMINATION_PERCENT: Range = 1.0..=100.0;
pub const FRICTION: Range = 0.0..=1e9;
/// A shelter row, halves included.
pub const ROW: Range = 0.0..=1e7;
pub const LAUNCH_M_S: Range = 0.0..=1e4;
pub const FREE_FLIGHT_M: Range = 0.0..=1e5;
/// Limits of flight height and drift.
pub const LIMIT_M: Range = 1e-6..=1e6;
pub const SAFETY_FACTOR: Range = 1e-3..=1e6;
pub const TIME_MS: Range = 0.0..=1e9;
pub const DURATION_S: Range = 1e-6..=1e6;
pub const GRAVITY_M_S2: Range = 0.0..=1e3;
pub const SCATTER_MS: Range = 0.0..=1e6;
pub const SCATTER_PERCENT: Range = 0.0..=100.0;
