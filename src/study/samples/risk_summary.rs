//! Risk of many shots of a study: few samples of each, or as many as a verdict needs. Only a summary of each is kept.

use std::ops::ControlFlow;

use super::failure_bounds::FailureBounds;
use super::run_sample::ShotToSample;
use super::sample_count::Sampling;
use super::sample_until_sure::sample_shots_watched;
use super::sampled_shot::SampledShot;
use crate::scene::Shot;
use crate::study::{Context, NoResult, ShotSummary};
use crate::verdict::Verdict;

/// Number of shots sampled together. Their samples are dropped afterwards.
const AT_ONCE: usize = 64;

/// Summary of the samples of one shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RiskSummary {
    /// Bounds of the failure probability.
    pub bounds: FailureBounds,
    /// Verdict of the samples.
    pub verdict: Verdict,
    /// Whether finer runs contradict the samples.
    pub finer_runs_disagree: bool,
    /// Greatest utilization of the samples, with the accepted share at the top left out. Infinite if more samples than that share
    /// are undecided or break cables.
    pub utilization: f64,
}

impl RiskSummary {
    /// The summary of a shot with its samples.
    pub fn of(sampled: &SampledShot) -> Self {
        let utilization = sampled.deciding_utilization();
        let (verdict, finer_runs_disagree) = (sampled.verdict(), sampled.finer_runs_disagree());
        Self { bounds: sampled.bounds, verdict, finer_runs_disagree, utilization }
    }

    /// The summary of a first look. It never passes, because its draws choose which shots are judged further.
    pub fn of_first_look(self) -> Self {
        Self { verdict: self.verdict.max(Verdict::Undecided), ..self }
    }

    /// Share of the samples that fails. Undecided samples count as failing.
    pub fn failing_share(&self) -> f64 {
        let FailureBounds { samples, failures, undecided, .. } = self.bounds;
        (failures + undecided) as f64 / samples.max(1) as f64
    }

    /// Whether the failing share so far does not exceed the accepted risk, and nothing contradicts the samples. This is not yet a
    /// verdict.
    pub fn is_accepted(&self) -> bool {
        let is_not_refuted = !self.finer_runs_disagree && self.verdict != Verdict::Fail;
        self.bounds.samples > 0 && is_not_refuted && self.failing_share() <= self.bounds.accepted + 1e-12
    }
}

/// Samples shots of one case, all with the same draws. Each comes with the check of its planned shot. `None` for shots that ran out
/// of time.
pub fn sample_shots_in_brief<'c>(
    context: &Context<'c>,
    shots: &'c [(Shot, ShotSummary)],
    sampling: &Sampling,
) -> Result<Vec<Option<RiskSummary>>, NoResult> {
    sample_shots_in_brief_watched(context, shots, sampling, &mut |_, _| {})
}

/// The same. `watch` gets the index and the summary of a shot whenever more of its samples are done.
pub fn sample_shots_in_brief_watched<'c>(
    context: &Context<'c>,
    shots: &'c [(Shot, ShotSummary)],
    sampling: &Sampling,
    watch: &mut dyn FnMut(usize, RiskSummary),
) -> Result<Vec<Option<RiskSummary>>, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let (mut all, count) = (Vec::with_capacity(shots.len()), shots.len().div_ceil(AT_ONCE));
    for (n, shots) in shots.chunks(AT_ONCE).enumerate() {
        let _part = control.part(1.0 / (count - n) as f64);
        let target = |(shot, planned): &'c (Shot, ShotSummary)| {
            ShotToSample::new(case, shot, compute, *sampling).with_planned(*planned)
        };
        let targets: Vec<_> = shots.iter().map(target).collect();
        let mut note = |of_chunk: usize, sampled: &SampledShot| {
            watch(n * AT_ONCE + of_chunk, RiskSummary::of(sampled));
            ControlFlow::Continue(())
        };
        let risks = sample_shots_watched(&targets, control, &mut note)?.value;
        let summary = |risk: &SampledShot| sampling.is_complete(risk).then(|| RiskSummary::of(risk));
        all.extend(risks.iter().map(summary));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::scene::Firing;
    use crate::study::samples::failure_bounds::ErrorShare;
    use crate::study::standing::tests::{case, sampled};
    use crate::study::{Case, ComputeSettings, StudyControl};

    fn summary(samples: usize, failures: usize, undecided: usize) -> RiskSummary {
        let mut bounds = FailureBounds::new(0.01, ErrorShare::Whole);
        (bounds.samples, bounds.failures, bounds.undecided) = (samples, failures, undecided);
        RiskSummary { bounds, verdict: Verdict::Undecided, finer_runs_disagree: false, utilization: 0.9 }
    }

    /// More shots than are sampled together. Each is reported by its own index, during sampling and at the end.
    #[test]
    fn every_shot_of_many_has_its_own_summary() {
        let text = include_str!("../../../plans/paper-5-tire.toml");
        let case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let control = StudyControl::default();
        let compute = ComputeSettings::of(&case.plan);
        let sampling = Sampling::exactly(1, 1);
        let context = Context::new(&case, compute, &control);
        let (shot, planned) = (&case.shots[0], ShotSummary::FAILED_RUN);
        // The last two are launched harder and harder.
        let harder = |n: usize| (n as f64 - 62.0).max(1.0);
        let shots: Vec<(Shot, ShotSummary)> = (0..AT_ONCE + 2)
            .map(|n| {
                let harder = |firing: &Firing| Firing { launch: firing.launch * harder(n), ..*firing };
                (shot.with_firings(shot.firings.iter().map(harder).collect()), planned)
            })
            .collect();
        let mut told = vec![None; shots.len()];
        let all =
            sample_shots_in_brief_watched(&context, &shots, &sampling, &mut |n, risk| told[n] = Some(risk));
        let all = all.expect("samples");
        assert!(all == told && all.iter().all(Option::is_some));
        let [first, before, last] = [0, AT_ONCE, AT_ONCE + 1].map(|n| all[n].expect("told").utilization);
        assert!(first < before && before < last, "{first} {before} {last}");
        assert_eq!(
            sample_shots_in_brief(&context, &shots[AT_ONCE..], &sampling),
            Ok(all[AT_ONCE..].to_vec())
        );
    }

    /// Two of 200 are the accepted 1 %; two of 199 are more. An undecided sample counts as failing. Without samples nothing is shown.
    #[test]
    fn a_share_up_to_the_accepted_one_is_accepted_where_nothing_speaks_against_it() {
        let accepted = summary(200, 1, 1);
        assert_eq!((accepted.failing_share(), summary(0, 0, 0).failing_share()), (0.01, 0.0));
        assert!(accepted.is_accepted());
        for refused in [
            summary(199, 2, 0),
            summary(199, 0, 2),
            summary(0, 0, 0),
            RiskSummary { finer_runs_disagree: true, ..accepted },
            RiskSummary { verdict: Verdict::Fail, ..accepted },
        ] {
            assert!(!refused.is_accepted(), "{refused:?}");
        }
    }

    #[test]
    fn a_first_look_passes_nothing() {
        let case = case();
        for (failing, verdict, of_first_look) in
            [(0, Verdict::Pass, Verdict::Undecided), (300, Verdict::Fail, Verdict::Fail)]
        {
            let judged = sampled(&case, 500, failing);
            let risk = RiskSummary::of(judged.sampled.known().expect("samples"));
            assert_eq!([risk.verdict, risk.of_first_look().verdict], [verdict, of_first_look]);
        }
    }
}
