//! The verdict on a delay option: on the shot as planned, and on the shots that `[uncertainty]` describes.

use super::check::Checked;
use super::margin::LaunchMargin;
use super::risk::Risk;
use crate::verdict::Verdict;

/// A judged delay option.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The shot as planned.
    pub nominal: Checked,
    /// The shots that `[uncertainty]` describes; `None` where only the shot as planned was asked for.
    pub risk: Option<Risk>,
    /// How much faster than planned the tires may leave; `None` where it was not asked for, or the time was up.
    pub launch_margin: Option<LaunchMargin>,
}

impl Judgement {
    /// The judgement of the shot as planned alone.
    pub fn nominal(nominal: Checked) -> Self {
        Self { nominal, risk: None, launch_margin: None }
    }

    /// Pass where the shot as planned passes and surely fewer shots than accepted fail; fail where the shot as planned
    /// fails, or surely more shots than accepted.
    pub fn verdict(&self) -> Verdict {
        let risk = self.risk.as_ref().map_or(Verdict::Pass, Risk::verdict);
        let open = if self.samples_fall_short() { Verdict::Undecided } else { Verdict::Pass };
        Verdict::worst([self.nominal.verdict, risk, open])
    }

    /// Whether the shot as planned, which is refined, lies so far above every sample that samples moved up by twice as much
    /// go past a limit: then the error of their step is greater than what is not known.
    pub fn samples_fall_short(&self) -> bool {
        let Some(risk) = &self.risk else { return false };
        let Checked { height, force, drift, .. } = &self.nominal;
        risk.would_fail_above([height.value, force.value, drift.value])
    }
}
