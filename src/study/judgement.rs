//! The verdict on a delay option: on the shot as planned, and on the shots that `[uncertainty]` describes.

use super::check::CheckedShot;
use super::margin::LaunchMargin;
use super::risk::Risk;
use super::sampled::{self, Sampled};
use crate::verdict::Verdict;

/// A delay option, judged as planned and by samples.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The shot as planned.
    pub as_planned: CheckedShot,
    /// The shots that `[uncertainty]` describes. Of a sampling that the time cut short there may be no sample.
    pub risk: Sampled<Risk>,
    /// How much faster than planned the tires may leave; `None` where it was not asked for, or the time was up.
    pub launch_margin: Option<LaunchMargin>,
}

impl Judgement {
    /// How much faster than planned the tires may leave, as a share; `None` where nothing fails up to the greatest rise tried,
    /// or where only a shot that passes as planned was asked for. A margin that is not known is none.
    pub fn known_launch_margin(&self) -> Option<f64> {
        match self.launch_margin {
            Some(LaunchMargin::UpTo { rise, .. }) => Some(rise),
            Some(LaunchMargin::BeyondTried) => None,
            None if !self.risk.is_asked() && self.as_planned.verdict == Verdict::Pass => None,
            Some(LaunchMargin::NotPassing) | None => Some(0.0),
        }
    }

    /// The judgement of the shot as planned alone.
    pub fn of_planned_alone(as_planned: CheckedShot) -> Self {
        Self { as_planned, risk: Sampled::NotAsked, launch_margin: None }
    }

    /// Pass where the shot as planned passes and surely fewer shots than accepted fail; fail where the shot as planned
    /// fails, or surely more shots than accepted.
    pub fn verdict(&self) -> Verdict {
        sampled::verdict_of_both(self.as_planned.verdict, self.risk.map(Risk::verdict))
    }
}
