//! How much faster than planned the tires may leave before the shot as planned no longer passes.

use super::quick_check::quick_or_whole_check;
use crate::scene::Shot;
use crate::study::{Context, NoResult};
use crate::verdict::Verdict;

/// How much faster all launches may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LaunchMargin {
    /// The shot does not pass as planned.
    NotPassing,
    /// The shot passes up to `rise` above the planned launch velocities; at 1 % more the verdict is `above`.
    UpTo {
        /// Share of the planned launch velocities.
        rise: f64,
        /// Fail or undecided.
        above: Verdict,
    },
    /// The shot passes up to [`MOST_PERCENT`] more.
    BeyondTried,
}

/// Rise of all launches that ends a thin pass, at most: a filmed launch is known no better.
pub const THIN_LAUNCH: f64 = 0.05;

impl LaunchMargin {
    /// By how much all launches may rise, as a share of those planned.
    pub fn rise(self) -> f64 {
        match self {
            Self::NotPassing => 0.0,
            Self::UpTo { rise, .. } => rise,
            Self::BeyondTried => f64::INFINITY,
        }
    }

    /// Whether a pass is thin by it.
    pub fn is_thin(self) -> bool {
        self.rise() <= THIN_LAUNCH
    }
}

/// Greatest rise of launches tried [%].
const MOST_PERCENT: usize = 100;

/// Raises the launches of a shot by 1 % at a time until it does not pass; `as_planned` is its verdict as planned.
pub fn launch_margin(
    context: &Context<'_>,
    shot: &Shot,
    as_planned: Verdict,
) -> Result<LaunchMargin, NoResult> {
    margin_within(context, shot, as_planned, MOST_PERCENT)
}

/// The same, looked for no further than where a pass is no longer thin.
pub fn thin_launch_margin(
    context: &Context<'_>,
    shot: &Shot,
    as_planned: Verdict,
) -> Result<LaunchMargin, NoResult> {
    margin_within(context, shot, as_planned, (1e2 * THIN_LAUNCH).round() as usize + 1)
}

fn margin_within(
    context: &Context<'_>,
    shot: &Shot,
    as_planned: Verdict,
    most_percent: usize,
) -> Result<LaunchMargin, NoResult> {
    if as_planned != Verdict::Pass {
        return Ok(LaunchMargin::NotPassing);
    }
    for percent in 1..=most_percent {
        let faster = shot.with_launches(1.0 + 1e-2 * percent as f64);
        let above = quick_or_whole_check(context, &faster)?.verdict;
        if above != Verdict::Pass {
            return Ok(LaunchMargin::UpTo { rise: 1e-2 * (percent - 1) as f64, above });
        }
    }
    Ok(LaunchMargin::BeyondTried)
}
