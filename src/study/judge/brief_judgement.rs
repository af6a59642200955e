//! The judgement of one of many shots, without its samples.

use super::confirm::confirm_shot;
use super::grounds::{Evidence, Grounds};
use super::one_dud::withstands_one_dud;
use crate::scene::Shot;
use crate::study::samples::risk_summary::{RiskSummary, sample_shots_in_brief};
use crate::study::samples::run_sample::ShotToSample;
use crate::study::samples::sample_count::Sampling;
use crate::study::{Case, Context, NoResult, ShotSummary};
use crate::verdict::Verdict;

/// What is known of a shot. The parts become known in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BriefJudgement {
    /// Verdict, height, force and drift of the planned shot.
    pub planned: ShotSummary,
    /// Whether the launch velocity is an estimate that nobody observed.
    launch_is_estimated: bool,
    /// The result of the samples.
    pub risk: Evidence<RiskSummary>,
    /// Whether the shot withstands any one dud, if the plan asks for that.
    one_dud: Evidence<Verdict>,
    /// The result of fresh draws.
    confirmation: Evidence<Verdict>,
}

impl BriefJudgement {
    /// The judgement of a planned shot, if nothing else was asked for.
    pub fn of_planned_alone(case: &Case, planned: ShotSummary) -> Self {
        Self {
            planned,
            launch_is_estimated: case.plan.uncertainty.launch_is_estimated(),
            risk: Evidence::NotAsked,
            one_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        }
    }

    /// The judgement of a shot with samples, which awaits everything else that the plan makes part of the verdict. `risk` is `None` if no
    /// sample was drawn.
    pub fn of_samples(case: &Case, planned: ShotSummary, risk: Option<RiskSummary>) -> Self {
        Self {
            risk: risk.map_or(Evidence::Awaited, Evidence::Known),
            one_dud: Evidence::asked_if(case.plan.limits.withstands_one_dud),
            ..Self::of_planned_alone(case, planned)
        }
    }

    /// The grounds of the verdict.
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

    /// Adds one dud, if the shot passes so far and the plan asks for that; `None` if the time was up.
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

    /// Adds fresh draws, if the shot passes so far. They are the next of the `confirmations` of a question. `None` if the time was up.
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

/// The full verdict on a shot that a study chose and checked as `planned`; `None` if the time was up. Samples come first. If they pass, one
/// dud follows, and if that passes, fresh draws. `confirmations` counts the confirmations of the study.
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

#[cfg(test)]
pub(in crate::study) mod tests {
    use super::super::confirm::confirm_shots;
    use super::*;
    use crate::plan::Plan;
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::{ComputeSettings, StudyControl, ValueWithError};

    /// Two tires launched together and alike, tied or not, under limits that no shot reaches.
    pub fn case(links: &str, withstands_one_dud: bool) -> Case {
        let text = format!(
            r#"
shelter = {{ layout = "grid", rows = 1, columns = 2, spacing_m = 1.5, links = [{links}] }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 100 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 3 }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1, withstands_one_dud = {withstands_one_dud} }}
delay = [{{ name = "1", interval_ms = 0 }}]
[uncertainty]
delay_sd_ms = 0
launch_cv_percent = 0
launch_common_percent = 0
launch_between_shots_percent = 0
launch_row_cv_percent = 0
launch_tilt_deg = 0
launch_tilt_common_deg = 0
tire_mass_cv_percent = 0
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
"#
        );
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    fn passing() -> ShotSummary {
        let values = ShotSummary::FAILED_RUN.values.map(|_| ValueWithError::default());
        ShotSummary { verdict: Verdict::Pass, values, ..ShotSummary::FAILED_RUN }
    }

    fn risk(verdict: Verdict) -> RiskSummary {
        let bounds = FailureBounds::new(0.01, ErrorShare::Whole);
        RiskSummary { bounds, verdict, finer_runs_disagree: false, utilization: 0.5 }
    }

    /// A shot does not pass if samples fail, are open or are missing, or if its duds were not tried.
    #[test]
    fn samples_and_duds_that_are_asked_for_count() {
        let verdict =
            |withstands, drawn| BriefJudgement::of_samples(&case("", withstands), passing(), drawn).verdict();
        for of_samples in [Verdict::Pass, Verdict::Undecided, Verdict::Fail] {
            assert_eq!(verdict(false, Some(risk(of_samples))), of_samples);
            assert_eq!(verdict(true, Some(risk(of_samples))), of_samples.max(Verdict::Undecided));
        }
        assert_eq!(verdict(false, None), Verdict::Undecided);
    }

    /// If no allowed number of draws can confirm a shot, it is refused without a draw. If the time is up, nothing is known.
    #[test]
    fn a_confirmation_that_cannot_come_is_refused_at_once() {
        let case = case("", false);
        let confirmed = |most: usize, control: &StudyControl| {
            let sampling = Sampling { least: 0, most, ..Sampling::OF_VERDICT };
            let compute = ComputeSettings::of(&case.plan);
            let target = ShotToSample::new(&case, &case.shots[0], compute, sampling);
            confirm_shots(&[target], control).expect("a result").remove(0)
        };
        let refused = confirmed(100, &StudyControl::default()).expect("a summary");
        assert_eq!((refused.bounds.samples, refused.verdict), (0, Verdict::Undecided));
        let control = StudyControl::default();
        control.expire();
        assert_eq!(confirmed(5000, &control), None);
    }

    /// A tire without a tie flies the same without the other. So one dud changes nothing, and fresh draws confirm the shot. If the two are
    /// tied, a tire that flies alone pulls at its cable. That fails, and no draws follow.
    #[test]
    fn a_chosen_shot_is_judged_with_one_dud_and_confirmed_by_draws_of_its_own() {
        let judged = |case: &Case, planned: ShotSummary| {
            let control = StudyControl::default();
            let context = Context::new(case, ComputeSettings::of(&case.plan), &control);
            let mut confirmations = 1;
            let sampling = Sampling { most: 600, ..Sampling::OF_VERDICT };
            let found = judge_chosen_shot(&context, &case.shots[0], planned, &sampling, &mut confirmations);
            (found.expect("a result").expect("in time"), confirmations)
        };
        let (loose, confirmations) = judged(&case("", true), passing());
        assert_eq!([loose.one_dud, loose.confirmation], [Evidence::Known(Verdict::Pass); 2]);
        assert_eq!((loose.verdict(), confirmations), (Verdict::Pass, 2));
        // Samples are no evidence if the planned shot exceeds them by far.
        let exceeding = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        assert_eq!(judged(&case("", true), exceeding).0.verdict(), Verdict::Undecided);
        // A later confirmation has a smaller share of the error, and takes more draws.
        let loose = case("", true);
        let control = StudyControl::default();
        let target = ShotToSample::new(
            &loose,
            &loose.shots[0],
            ComputeSettings::of(&loose.plan),
            Sampling::OF_VERDICT,
        );
        let drawn =
            |n| confirm_shot(&target, n, &control).expect("a result").expect("in time").bounds.samples;
        assert!(drawn(1) > 440 && drawn(1) < drawn(4), "{} {}", drawn(1), drawn(4));
        let mut tied = case("\"row\"", true);
        tied.limits.force = 1.0;
        let (tied, confirmations) = judged(&tied, passing());
        assert_eq!(tied.risk.map(|risk| risk.verdict), Evidence::Known(Verdict::Pass));
        assert_eq!(
            (tied.verdict(), tied.confirmation, confirmations),
            (Verdict::Fail, Evidence::NotAsked, 1)
        );
    }
}
