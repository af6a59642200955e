//! How much faster than planned the tires may leave before the planned shot no longer passes.

use super::quick_check::quick_or_whole_check;
use crate::scene::Shot;
use crate::study::{Context, NoResult};
use crate::verdict::Verdict;

/// How much faster all launches may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LaunchMargin {
    /// The planned shot does not pass.
    NotPassing,
    /// The shot passes up to `rise` above the planned launch velocities. At 1 % more the verdict is `above`.
    UpTo {
        /// Rise, as a share of the planned launch velocities.
        rise: f64,
        /// Verdict at 1 % more: fail or undecided.
        above: Verdict,
    },
    /// The shot passes at every rise that was tried, [`MOST_PERCENT`] at most.
    BeyondTried,
}

/// Greatest launch margin of a thin pass, as a share of the planned launch velocities. A filmed launch is known no better.
pub const THIN_LAUNCH: f64 = 0.05;

impl LaunchMargin {
    /// Greatest rise of all launches, as a share of the planned launch velocities.
    pub fn rise(self) -> f64 {
        match self {
            Self::NotPassing => 0.0,
            Self::UpTo { rise, .. } => rise,
            Self::BeyondTried => f64::INFINITY,
        }
    }

    /// Whether this margin makes a pass thin.
    pub fn is_thin(self) -> bool {
        self.rise() <= THIN_LAUNCH
    }
}

/// Greatest rise of launches tried [%].
const MOST_PERCENT: usize = 100;

/// Raises the launches of a shot by 1 % at a time until it does not pass. `as_planned` is the verdict of the planned shot.
pub fn launch_margin(
    context: &Context<'_>,
    shot: &Shot,
    as_planned: Verdict,
) -> Result<LaunchMargin, NoResult> {
    margin_within(context, shot, as_planned, MOST_PERCENT)
}

/// The same, but it stops where a pass is no longer thin.
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
