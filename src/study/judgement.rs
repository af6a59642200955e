//! The verdict on a delay option: on the shot as planned, and on the shots that `[uncertainty]` describes.

use super::as_planned::check::CheckedShot;
use super::as_planned::margin::LaunchMargin;
use super::deciding_shot::DecidingShot;
use super::estimated_launch::verdict_with_launch;
use super::hole_places::HoleBesideTire;
use super::one_dud::OneDud;
use super::reasons::Reason;
use super::reasons::risk::RiskReason;
use super::samples::risk_summary::RiskSummary;
use super::samples::sampled_shot::SampledShot;
use crate::verdict::Verdict;

/// A delay option: the check of the shot as planned, the risk of the possible shots, and what fresh draws say of a pass. Its parts
/// come one after the other, in this order, and [`judge_options`](super::judge_options) puts each in.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The shot as planned.
    pub checked: CheckedShot,
    /// The shots that `[uncertainty]` describes.
    pub sampled: Evidence<SampledShot>,
    /// The sample that decides; `None` where there is none, or it was not run.
    pub deciding: Option<DecidingShot>,
    /// How much faster than planned the tires may leave; `None` where it was not asked for, or the time was up.
    pub launch_margin: Option<LaunchMargin>,
    /// The shot as planned with one hole left out, the worst of all holes; `None` where it was not asked for, or the time was up.
    pub one_dud: Option<OneDud>,
    /// Holes of which another tire may get the impulse, each with the verdict on the shot as planned in which it does.
    pub next_tires: Vec<(HoleBesideTire, Verdict)>,
    /// Whether the option withstands any one dud, where the plan makes that a part of the verdict.
    pub withstands_dud: Evidence<Verdict>,
    /// What fresh draws say of an option that others stand beside: whoever takes the best of several needs them
    /// ([`recommend`](super::recommend)).
    pub confirmation: Evidence<RiskSummary>,
}

impl Judgement {
    /// The judgement of the shot as planned alone.
    pub fn of_planned_alone(checked: CheckedShot) -> Self {
        Self {
            checked,
            sampled: Evidence::NotAsked,
            deciding: None,
            launch_margin: None,
            one_dud: None,
            next_tires: Vec::new(),
            withstands_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        }
    }

    /// Pass where the shot as planned passes, surely fewer shots than accepted fail, and fresh draws confirm that where it was asked
    /// for; fail where the shot as planned fails, or surely more shots than accepted.
    pub fn verdict(&self) -> Verdict {
        let confirmed = self.confirmation.map(|drawn| drawn.verdict.min(Verdict::Undecided));
        verdict_of_both(self.verdict_before_confirmation(), confirmed)
    }

    /// The verdict of the shot as planned, of the samples that all options get, and of one dud where the plan asks for it; no pass on
    /// an estimated launch.
    pub fn verdict_before_confirmation(&self) -> Verdict {
        let planned = verdict_of_both(self.checked.verdict, self.withstands_dud);
        let judged = verdict_of_both(planned, self.sampled.map(SampledShot::verdict));
        verdict_with_launch(judged, self.checked.launch_is_estimated)
    }

    /// Whether fresh draws confirm the pass; `None` where none were drawn.
    pub fn is_confirmed(&self) -> Option<bool> {
        self.confirmation.known().map(|drawn| drawn.verdict == Verdict::Pass)
    }

    /// Whether the option passes but for fresh draws that are still missing.
    pub fn awaits_confirmation(&self) -> bool {
        let is_missing = matches!(self.confirmation, Evidence::NoneDrawn);
        is_missing && self.verdict_before_confirmation() == Verdict::Pass
    }

    /// Whether the option may be headed "to be fired": a full PASS, of planned and sampled shots, that is confirmed where others stand
    /// beside it, and that nothing seen of earlier shots contradicts.
    pub fn may_be_fired(&self, is_contradicted: bool) -> bool {
        self.verdict() == Verdict::Pass && self.sampled.is_asked() && !is_contradicted
    }

    /// Why the verdict is no pass; empty for a pass.
    pub fn reasons(&self) -> Vec<Reason> {
        let as_planned = self.checked.reasons.iter().copied().map(Reason::AsPlanned);
        let of_samples = match &self.sampled {
            Evidence::NotAsked => {
                self.checked.launch_is_estimated.then_some(Reason::Samples(RiskReason::LaunchEstimated))
            }
            Evidence::NoneDrawn => Some(Reason::NoSamples),
            Evidence::Known(sampled) => sampled.reason().map(Reason::Samples),
        };
        let confirmation = match &self.confirmation {
            _ if self.verdict_before_confirmation() != Verdict::Pass => None,
            Evidence::Known(RiskSummary { verdict, bounds, .. }) if *verdict != Verdict::Pass => {
                Some(Reason::NotConfirmed {
                    failures: bounds.failures + bounds.undecided,
                    samples: bounds.samples,
                })
            }
            Evidence::NoneDrawn => Some(Reason::AwaitsConfirmation),
            Evidence::Known(_) | Evidence::NotAsked => None,
        };
        let dud = match self.withstands_dud {
            Evidence::Known(Verdict::Pass) | Evidence::NotAsked => None,
            Evidence::Known(verdict) => Some(Reason::OneDud(verdict)),
            Evidence::NoneDrawn => Some(Reason::OneDud(Verdict::Undecided)),
        };
        as_planned.chain(of_samples).chain(dud).chain(confirmation).collect()
    }
}

/// What the samples of a shot tell, where they were asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence<R> {
    /// Only the shot as planned was asked for.
    NotAsked,
    /// Samples were asked for, and none was drawn yet, or before the time was up.
    NoneDrawn,
    /// What the samples tell.
    Known(R),
}

impl Evidence<SampledShot> {
    /// What a shot with its samples so far tells.
    pub fn of(sampled: SampledShot) -> Self {
        if sampled.samples.is_empty() { Evidence::NoneDrawn } else { Evidence::Known(sampled) }
    }
}

impl<R> Evidence<R> {
    /// What the samples tell; `None` where none were asked for, or none was drawn.
    pub fn known(&self) -> Option<&R> {
        match self {
            Evidence::Known(told) => Some(told),
            Evidence::NotAsked | Evidence::NoneDrawn => None,
        }
    }

    /// Whether samples were asked for.
    pub fn is_asked(&self) -> bool {
        !matches!(self, Evidence::NotAsked)
    }

    /// The same with `change` of what the samples tell.
    pub fn map<'r, T>(&'r self, change: impl FnOnce(&'r R) -> T) -> Evidence<T> {
        match self {
            Evidence::NotAsked => Evidence::NotAsked,
            Evidence::NoneDrawn => Evidence::NoneDrawn,
            Evidence::Known(told) => Evidence::Known(change(told)),
        }
    }
}

/// The verdict on a shot, from the verdicts on the shot as planned and on its samples: the worse of both. Where samples were asked
/// for and none was drawn, the verdict is no pass.
pub fn verdict_of_both(as_planned: Verdict, samples: Evidence<Verdict>) -> Verdict {
    match samples {
        Evidence::NotAsked => as_planned,
        Evidence::NoneDrawn => as_planned.max(Verdict::Undecided),
        Evidence::Known(sampled) => as_planned.max(sampled),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_pass_of_all_that_was_asked_for_is_a_pass() {
        use Verdict::{Fail, Pass, Undecided};
        for as_planned in [Pass, Undecided, Fail] {
            assert_eq!(verdict_of_both(as_planned, Evidence::NotAsked), as_planned);
            assert_eq!(verdict_of_both(as_planned, Evidence::Known(Pass)), as_planned);
            assert_eq!(verdict_of_both(as_planned, Evidence::Known(Fail)), Fail);
        }
        for samples in [Evidence::NoneDrawn, Evidence::Known(Undecided)] {
            assert_eq!(
                [Pass, Undecided, Fail].map(|planned| verdict_of_both(planned, samples)),
                [Undecided, Undecided, Fail]
            );
        }
    }
}
