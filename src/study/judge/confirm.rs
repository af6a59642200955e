//! The fresh draws that confirm an option that is recommended, offered or headed "to be fired".
//!
//! 1. If you look at several shots and take one that passes, it may be a lucky one. That is more likely than an error in one verdict.
//! 2. So a chosen shot is sampled once more, by draws that no screening, ranking or earlier look used. They follow from the seed alone
//!    ([`Sampling::for_confirmation`]), so every command and screen draws the same.
//! 3. All confirmations of one question share the error probability of a lone verdict. The n-th takes 1/(n (n + 1)). Together they are
//!    wrong as rarely as one verdict, however many shots were looked at before.
//! 4. A shot that is not confirmed is OPEN. A lone option that nothing chose needs no confirmation.

use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::run_sample::ShotToSample;
use crate::study::samples::sample_until_sure::sample_shots;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{NoResult, StudyControl};

/// Samples shots until they are confirmed or surely are not. Each target has the sampling of a confirmation. `None` for a shot without
/// enough time.
pub(in crate::study) fn confirm_shots(
    targets: &[ShotToSample<'_>],
    control: &StudyControl,
) -> Result<Vec<Option<RiskSummary>>, NoResult> {
    let only_pass: Vec<ShotToSample<'_>> = targets.iter().map(|target| target.only_pass()).collect();
    let sampled_shots = sample_shots(&only_pass, control)?.value;
    let summary = |(target, sampled): (&ShotToSample<'_>, &SampledShot)| {
        let is_known = target.sampling.is_complete(sampled) || !sampled.bounds.can_pass(target.sampling.most);
        is_known.then(|| RiskSummary::of(sampled))
    };
    Ok(only_pass.iter().zip(&sampled_shots).map(summary).collect())
}

/// Confirms one shot as the `n`-th of a question, n from 1; `None` if the time was up.
pub(in crate::study) fn confirm_shot(
    target: &ShotToSample<'_>,
    n: usize,
    control: &StudyControl,
) -> Result<Option<RiskSummary>, NoResult> {
    let target = ShotToSample { sampling: target.sampling.for_confirmation(n), ..*target };
    Ok(confirm_shots(&[target], control)?.remove(0))
}
