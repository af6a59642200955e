//! Shots of a study sampled: few samples of many shots, or as many as a verdict needs.

use super::confidence::Confidence;
use super::risk::{FOR_BANDS, Risk, Sampling, Target, percentiles, sample};
use super::{Case, ComputeSettings, Envelope, NoResult, Progress};
use crate::scene::Shot;
use crate::verdict::{Limits, Verdict};

/// Number of shots sampled together; their samples are not kept.
const AT_ONCE: usize = 64;

/// What the samples of one shot tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// Bounds of the failure probability.
    pub confidence: Confidence,
    /// Verdict of the samples.
    pub verdict: Verdict,
    /// 95th percentile of the samples' utilization: the greatest value over its limit.
    pub utilization: f64,
}

impl Sampled {
    /// What no sample tells.
    pub fn nothing(case: &Case) -> Self {
        let confidence = Risk::new(case, None).confidence;
        Self { confidence, verdict: Verdict::Undecided, utilization: f64::INFINITY }
    }

    fn of(risk: &Risk, limits: &Limits) -> Self {
        let shares = risk.samples.iter().map(|sample| sample.utilization(limits));
        let utilization = percentiles(shares, [0.95]).map_or(f64::INFINITY, |[p95]| p95);
        Self { confidence: risk.confidence, verdict: risk.verdict(), utilization }
    }

    /// Whether any sample was drawn.
    pub fn is_drawn(&self) -> bool {
        self.confidence.samples > 0
    }

    /// Whether the failing share does not exceed the accepted risk; undecided samples count as failing.
    pub fn is_accepted(&self) -> bool {
        let Confidence { accepted, samples, failures, undecided, .. } = self.confidence;
        let failing = (failures + undecided) as f64;
        samples > 0 && self.verdict != Verdict::Fail && failing <= accepted * samples as f64 + 1e-9
    }
}

impl Sampling {
    /// Samples of a first look at many shots: 100 of each, fewer of those that surely fail too often.
    pub fn first_look(&self) -> Self {
        Self { least: 0, most: FOR_BANDS.min(self.most), ..*self }
    }
}

/// Samples shots of one case, each judged as planned, all with the same draws; `None` for the shots that the time did not suffice for.
pub fn sample_shots<'c>(
    case: &'c Case,
    shots: &'c [(Shot, Envelope)],
    sampling: &Sampling,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Vec<Option<Sampled>>, NoResult> {
    let mut all = Vec::with_capacity(shots.len());
    for shots in shots.chunks(AT_ONCE) {
        let target = |(shot, planned): &'c (Shot, Envelope)| Target {
            case,
            shot,
            planned: Some(*planned),
            compute: *compute,
        };
        let targets: Vec<_> = shots.iter().map(target).collect();
        let (risks, _) = sample(&targets, sampling, progress, |_| false, &mut |_, _| {})?;
        let is_complete = |risk: &Risk| {
            let (drawn, verdict) = (risk.samples.len(), risk.confidence.verdict());
            drawn >= sampling.most || drawn >= sampling.least && verdict != Verdict::Undecided
        };
        all.extend(risks.iter().map(|risk| is_complete(risk).then(|| Sampled::of(risk, &case.limits))));
    }
    Ok(all)
}
