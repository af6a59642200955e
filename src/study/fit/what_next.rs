//! What to observe next, in a shot that no verdict forbids to fire.

use super::observation_bands::{NextObservation, next_observation};
use crate::study::judge::OptionResults;
use crate::study::samples::sample_count::Sampling;
use crate::study::{Context, NoResult};
use crate::verdict::Verdict;

/// What to observe next.
#[derive(Clone, Debug, PartialEq)]
pub enum WhatNext {
    /// The observation that would narrow a verdict most.
    Observe {
        /// The observation.
        next: NextObservation,
        /// The verdict on its option; never a fail.
        verdict: Verdict,
    },
    /// None of these options may be fired: each fails or has no result.
    NoneMayBeFired(Vec<usize>),
    /// No single observation would remove a hundredth of the variance of a utilization.
    NothingNarrows,
}

impl WhatNext {
    /// The observation, if there is one.
    pub fn observation(&self) -> Option<&NextObservation> {
        match self {
            WhatNext::Observe { next, .. } => Some(next),
            WhatNext::NoneMayBeFired(_) | WhatNext::NothingNarrows => None,
        }
    }
}

/// Share of the remaining progress that the verdicts take.
const SHARE_OF_VERDICTS: f64 = 0.5;

/// The single observation that would narrow the utilization of its option most. It looks at all options that do not fail by the
/// verdicts of `check`.
pub fn next_observation_of_all(context: &Context<'_>, sampling: &Sampling) -> Result<WhatNext, NoResult> {
    let options: Vec<usize> = (0..context.case.shots.len()).collect();
    next_of(context, &options, sampling, verdicts(context, sampling)?)
}

/// The same for one option.
pub(super) fn next_observation_of(
    context: &Context<'_>,
    option: usize,
    sampling: &Sampling,
) -> Result<WhatNext, NoResult> {
    let alone = context.case.with_options(&[option]);
    let verdicts = verdicts(&context.with_case(&alone), sampling)?;
    next_of(context, &[option], sampling, verdicts)
}

/// The verdict on each option (`n_options`); a fail if it has no result.
fn verdicts(context: &Context<'_>, sampling: &Sampling) -> Result<Vec<Verdict>, NoResult> {
    let _judging = context.control.part(SHARE_OF_VERDICTS);
    let results: OptionResults = context.with_sampling(*sampling).judge_options()?.value;
    Ok(results
        .iter()
        .map(|result| result.as_ref().map_or(Verdict::Fail, |judged| judged.verdict()))
        .collect())
}

/// The best observation of `options` with these verdicts.
fn next_of(
    context: &Context<'_>,
    options: &[usize],
    sampling: &Sampling,
    verdicts: Vec<Verdict>,
) -> Result<WhatNext, NoResult> {
    let may_be: Vec<(usize, Verdict)> =
        options.iter().copied().zip(verdicts).filter(|(_, verdict)| *verdict != Verdict::Fail).collect();
    if may_be.is_empty() {
        return Ok(WhatNext::NoneMayBeFired(options.to_vec()));
    }
    let mut best: Option<(NextObservation, Verdict)> = None;
    for (n, &(option, verdict)) in may_be.iter().enumerate() {
        let _one = context.control.part(1.0 / (may_be.len() - n) as f64);
        let next = next_observation(context, option, sampling)?;
        let is_better = |next: &NextObservation| best.is_none_or(|(best, _)| next.share > best.share);
        best = next.filter(is_better).map(|next| (next, verdict)).or(best);
    }
    Ok(best.map_or(WhatNext::NothingNarrows, |(next, verdict)| WhatNext::Observe { next, verdict }))
}
