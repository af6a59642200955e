//! The verdict on a delay option: on the shot as planned, and on the shots that `[uncertainty]` describes.

use super::deciding_shot::DecidingShot;
use super::grounds::{Evidence, Grounds};
use super::one_dud::OneDud;
use super::reason::Reason;
use crate::study::as_planned::check::CheckedShot;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::hole_places::HoleBesideTire;
use crate::study::samples::risk_reason::RiskReason;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sampled_shot::SampledShot;
use crate::verdict::Verdict;

/// A delay option: the check of the shot as planned, the risk of the possible shots, and what fresh draws say of a pass. Its parts
/// come one after the other, in this order, and [`judge_options`](super::options) puts each in.
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

    /// What the verdict rests on.
    pub fn grounds(&self) -> Grounds {
        Grounds {
            planned: self.checked.verdict,
            launch_is_estimated: self.checked.launch_is_estimated,
            samples: self.sampled.map(SampledShot::verdict),
            one_dud: self.withstands_dud,
            confirmation: self.confirmation.map(|drawn| drawn.verdict),
        }
    }

    /// Pass where the shot as planned passes, surely fewer shots than accepted fail, and fresh draws confirm that where it was asked
    /// for; fail where the shot as planned fails, or surely more shots than accepted.
    pub fn verdict(&self) -> Verdict {
        self.grounds().verdict()
    }

    /// Whether fresh draws confirm the pass; `None` where none were drawn.
    pub fn is_confirmed(&self) -> Option<bool> {
        self.confirmation.known().map(|drawn| drawn.verdict == Verdict::Pass)
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
            _ if self.grounds().before_confirmation() != Verdict::Pass => None,
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

impl Evidence<SampledShot> {
    /// What a shot with its samples so far tells.
    pub fn of(sampled: SampledShot) -> Self {
        if sampled.samples.is_empty() { Evidence::NoneDrawn } else { Evidence::Known(sampled) }
    }
}
