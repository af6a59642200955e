//! The judgement of one of many shots, of which no samples are kept.

use super::grounds::{Evidence, Grounds};
use super::one_dud::withstands_one_dud;
use super::recommend::confirm_shot;
use super::samples::risk_summary::{RiskSummary, sample_shots_in_brief};
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::ShotToSample;
use super::{Case, Context, NoResult, ShotSummary};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// What is known of a shot, its parts in the order in which they become known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BriefJudgement {
    /// Verdict, height, force and drift of the shot as planned.
    pub planned: ShotSummary,
    /// Whether the launch velocity is an estimate that nobody observed.
    launch_is_estimated: bool,
    /// What the samples tell.
    pub risk: Evidence<RiskSummary>,
    /// Whether it withstands any one dud, where the plan asks for that.
    one_dud: Evidence<Verdict>,
    /// What fresh draws tell.
    confirmation: Evidence<Verdict>,
}

impl BriefJudgement {
    /// Of a shot as planned; nothing else was asked for.
    pub fn of_planned_alone(case: &Case, planned: ShotSummary) -> Self {
        Self {
            planned,
            launch_is_estimated: case.plan.uncertainty.launch_is_estimated(),
            risk: Evidence::NotAsked,
            one_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        }
    }

    /// Of a shot of which samples were asked for, and with them whatever else the plan makes a part of the verdict; `None` where none
    /// were drawn.
    pub fn of_samples(case: &Case, planned: ShotSummary, risk: Option<RiskSummary>) -> Self {
        Self {
            risk: risk.map_or(Evidence::NoneDrawn, Evidence::Known),
            one_dud: Evidence::asked_if(case.plan.limits.withstands_one_dud),
            ..Self::of_planned_alone(case, planned)
        }
    }

    /// What its verdict rests on.
    pub fn grounds(&self) -> Grounds {
        Grounds {
            planned: self.planned.verdict,
            launch_is_estimated: self.launch_is_estimated,
            samples: self.risk.map(|risk| risk.verdict),
            one_dud: self.one_dud,
            confirmation: self.confirmation,
        }
    }

    /// The verdict.
    pub fn verdict(&self) -> Verdict {
        self.grounds().verdict()
    }

    /// The same with one dud, if it passes so far, and the plan asks for that; `None` where the time was up.
    pub fn with_one_dud(
        self,
        context: &Context<'_>,
        shot: &Shot,
        sampling: &Sampling,
    ) -> Result<Option<Self>, NoResult> {
        if self.grounds().before_one_dud() != Verdict::Pass {
            return Ok(Some(self));
        }
        let withstands = withstands_one_dud(context, shot, sampling)?;
        Ok(withstands.map(|one_dud| Self { one_dud, ..self }))
    }

    /// The same with fresh draws, if it passes so far, as the next of the `confirmations` of a question; `None` where the time was up.
    pub fn confirmed(
        self,
        context: &Context<'_>,
        shot: &Shot,
        sampling: &Sampling,
        confirmations: &mut usize,
    ) -> Result<Option<Self>, NoResult> {
        if self.grounds().before_confirmation() != Verdict::Pass {
            return Ok(Some(self));
        }
        *confirmations += 1;
        let &Context { case, compute, control, .. } = context;
        let target = ShotToSample::new(case, shot, compute, *sampling).with_planned(self.planned);
        let drawn = confirm_shot(&target, *confirmations, control)?;
        Ok(drawn.map(|drawn| Self { confirmation: Evidence::Known(drawn.verdict), ..self }))
    }
}

/// The full verdict on a shot that a study chose: as planned, where that passes its samples, where these pass one dud, and then fresh
/// draws; `None` where the time was up. `confirmations` counts those of the study.
pub fn judge_chosen_shot(
    context: &Context<'_>,
    shot: &Shot,
    planned: ShotSummary,
    sampling: &Sampling,
    confirmations: &mut usize,
) -> Result<Option<BriefJudgement>, NoResult> {
    let drawing = context.control.part(0.4);
    let sampled = sample_shots_in_brief(context, &[(shot.clone(), planned)], sampling)?.remove(0);
    drop(drawing);
    let Some(risk) = sampled else { return Ok(None) };
    let judged = BriefJudgement::of_samples(context.case, planned, Some(risk));
    let Some(judged) = judged.with_one_dud(context, shot, sampling)? else { return Ok(None) };
    judged.confirmed(context, shot, sampling, confirmations)
}
