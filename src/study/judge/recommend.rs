//! What is recommended, offered or headed "to be fired", and the fresh draws that confirm it.
//!
//! 1. Whoever looks at several shots and takes one that passes takes a lucky one more often than a lone verdict would be wrong.
//! 2. So a shot that was chosen is sampled once more, by draws that no screening, ranking or earlier look used. They follow from the
//!    seed alone ([`Sampling::for_confirmation`]), so that every command and screen draws the same.
//! 3. The confirmations of one question share the probability of an error that a lone verdict has: the n-th takes 1/(n (n + 1)).
//!    All together are wrong as rarely as one verdict, however many shots were looked at before.
//! 4. A shot that is not confirmed is OPEN. A lone option that nothing chose needs no confirmation.

use std::cmp::Ordering;

use itertools::Itertools;

use super::grounds::Evidence;
use super::judgement::Judgement;
use super::options::{
    CaseOption, JudgeEvent, OnEvent, OptionResults, UNWATCHED, find_deciding_shots, find_duds,
    find_launch_margins, judge_all,
};
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::{ShotToSample, sample_shots};
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, ComputeResult, Computed, Context, NoResult, ShotSummary, StudyControl};
use crate::verdict::Verdict;

impl Context<'_> {
    /// Judges every delay option as `check` does: as planned, and where samples are asked for, by samples and fresh draws.
    pub fn judge_options(&self) -> ComputeResult<OptionResults> {
        let Computed { mut value, partial } = judge_and_confirm(&[*self], UNWATCHED)?;
        Ok(Computed { value: value.remove(0), partial })
    }
}

/// What `check`, the page and the terminal show. Without samples it is [`judge_all`]: the plan's own numbers alone, nothing varies, the
/// launches neither. With samples, also the run of the sample that decides and the launch margin of every option, and fresh draws for
/// the options that pass where a plan has several.
pub fn judge_and_confirm(contexts: &[Context<'_>], watch: OnEvent<'_>) -> ComputeResult<Vec<OptionResults>> {
    match contexts.first().and_then(|context| context.sampling) {
        Some(_) => judge_with_margins(contexts, |case| case.shots.len() > 1, watch),
        None => judge_all(contexts, watch),
    }
}

/// Like [`judge_and_confirm`], where the program itself chose the options: a lone one is confirmed, too.
pub(in crate::study) fn judge_chosen(context: &Context<'_>) -> ComputeResult<OptionResults> {
    let Computed { mut value, partial } = judge_with_margins(&[*context], |_| true, UNWATCHED)?;
    Ok(Computed { value: value.remove(0), partial })
}

/// Shares of what is left that the steps of a judgement take.
struct Shares {
    judging: f64,
    margins: f64,
    duds: f64,
}

const SHARES: Shares = Shares { judging: 0.5, margins: 0.25, duds: 0.5 };

fn judge_with_margins(
    contexts: &[Context<'_>],
    must_be_confirmed: impl Fn(&Case) -> bool,
    watch: OnEvent<'_>,
) -> ComputeResult<Vec<OptionResults>> {
    let Some(&Context { sampling, control, .. }) = contexts.first() else {
        return Ok(Computed::complete(Vec::new()));
    };
    control.has_steps(if sampling.is_some() { 4 } else { 2 });
    let judging = control.part(SHARES.judging);
    let Computed { value: mut results, mut partial } = judge_all(contexts, watch)?;
    if let Some(Sampling { seed, .. }) = sampling {
        partial |= find_deciding_shots(contexts, &mut results, seed, control, watch)?.partial;
    }
    drop(judging);
    let finding_margins = control.part(if sampling.is_some() { SHARES.margins } else { 1.0 });
    partial |= find_launch_margins(contexts, &mut results, control, watch)?.partial;
    drop(finding_margins);
    let Some(sampling) = sampling else { return Ok(Computed { value: results, partial }) };
    let leaving_out = control.part(SHARES.duds);
    partial |= find_duds(contexts, &mut results, &sampling, control, watch)?.partial;
    drop(leaving_out);
    for (context, results) in contexts.iter().zip(&mut results) {
        if must_be_confirmed(context.case) {
            results.iter_mut().flatten().for_each(|judged| judged.confirmation = Evidence::NoneDrawn);
        }
    }
    let _confirming = control.part(1.0);
    let confirmed = confirm_options(contexts, &mut results, &sampling, control, watch)?;
    Ok(Computed { value: results, partial: partial || confirmed.partial })
}

/// Samples shots until they are confirmed or surely are not; each target has the sampling of a confirmation. `None` for a shot
/// that the time did not suffice for.
pub(in crate::study) fn confirm_shots(
    targets: &[ShotToSample<'_>],
    control: &StudyControl,
) -> Result<Vec<Option<RiskSummary>>, NoResult> {
    let only_pass: Vec<ShotToSample<'_>> = targets.iter().map(|target| target.only_pass()).collect();
    let sampled_shots = sample_shots(&only_pass, control)?.value;
    let summary = |(target, sampled): (&ShotToSample<'_>, &SampledShot)| {
        let is_known = target.sampling.is_complete(sampled) || !sampled.bounds.can_pass(target.sampling.most);
        is_known.then(|| RiskSummary::of(sampled, &target.case.limits))
    };
    Ok(only_pass.iter().zip(&sampled_shots).map(summary).collect())
}

/// Confirms one shot, checked as `planned`, as the `n`-th of a question, n from 1; `None` where the time was up.
pub(in crate::study) fn confirm_shot(
    target: &ShotToSample<'_>,
    n: usize,
    control: &StudyControl,
) -> Result<Option<RiskSummary>, NoResult> {
    let target = ShotToSample { sampling: target.sampling.for_confirmation(n), ..*target };
    Ok(confirm_shots(&[target], control)?.remove(0))
}

/// Confirms the options that await it, the safest first; those of a plan share the probability of an error.
pub fn confirm_options(
    contexts: &[Context<'_>],
    results: &mut [OptionResults],
    sampling: &Sampling,
    control: &StudyControl,
    watch: OnEvent<'_>,
) -> ComputeResult<()> {
    let ranked = |(case, results): (usize, &OptionResults)| {
        let passing = safest_first(contexts[case].case, results, |_| 1.0).into_iter().filter(|&option| {
            results[option].as_ref().is_ok_and(|judged| judged.grounds().awaits_confirmation())
        });
        passing.enumerate().map(move |(n, option)| (CaseOption { case, option }, n + 1)).collect_vec()
    };
    let chosen: Vec<(CaseOption, usize)> = results.iter().enumerate().flat_map(ranked).collect();
    let target = |&(CaseOption { case, option }, n): &(CaseOption, usize)| {
        let Context { case: plan, compute, .. } = contexts[case];
        let target = ShotToSample::new(plan, &plan.shots[option], compute, sampling.for_confirmation(n));
        let planned = results[case][option].as_ref().ok().map(|judged| ShotSummary::of(&judged.checked));
        ShotToSample { planned, ..target }
    };
    let targets: Vec<ShotToSample<'_>> = chosen.iter().map(target).collect();
    let confirmations = confirm_shots(&targets, control)?;
    let partial = confirmations.contains(&None);
    for ((at, _), confirmation) in chosen.into_iter().zip(confirmations) {
        if let (Ok(judged), Some(confirmation)) = (&mut results[at.case][at.option], confirmation) {
            judged.confirmation = Evidence::Known(confirmation);
            watch(at, JudgeEvent::Confirmed(&confirmation));
        }
    }
    Ok(Computed { value: (), partial })
}

/// Index of the option to be recommended: the safest of those that pass with everything asked for; `None` where none does.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(|judged| judged.may_be_fired(false)))
}

/// Indices of all options, the safest first: by verdict before any confirmation, then by the share of the samples that fail; `share_without_samples` stands
/// in for it where no sample tells. Options that pass, and whose bounds overlap with those of the best of them, are ties: the one
/// with the larger launch margin stands first, then the one that takes less time.
pub fn safest_first(
    case: &Case,
    results: &OptionResults,
    share_without_samples: impl Fn(usize) -> f64,
) -> Vec<usize> {
    let judged = |n: usize| results[n].as_ref().ok();
    let bounds = |n: usize| judged(n).and_then(|judged| Some(judged.sampled.known()?.bounds));
    let key = |&n: &usize| {
        let share = bounds(n).and_then(|bounds| bounds.probability());
        let verdict = judged(n).map_or(Verdict::Undecided, |judged| judged.grounds().before_confirmation());
        (verdict, share.unwrap_or_else(|| share_without_samples(n)))
    };
    let interval = |n: usize| bounds(n).map_or([0.0, 1.0], |bounds| bounds.interval);
    let mut waiting: Vec<usize> =
        (0..results.len()).sorted_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal)).collect();
    let mut ranked = Vec::new();
    while let Some(&best) = waiting.first() {
        let passes = key(&best).0 == Verdict::Pass;
        let overlaps = |n: usize| interval(n)[0] <= interval(best)[1];
        let is_tie = |n: &usize| *n == best || passes && key(n).0 == Verdict::Pass && overlaps(*n);
        let (mut ties, others): (Vec<usize>, Vec<usize>) = waiting.into_iter().partition(is_tie);
        ties.sort_by(|&a, &b| {
            let [margin_a, margin_b] = [a, b].map(|n| spare_launch(judged(n)));
            let [duration_a, duration_b] = [a, b].map(|n| case.shots[n].duration());
            margin_b.total_cmp(&margin_a).then(duration_a.total_cmp(&duration_b))
        });
        ranked.extend(ties);
        waiting = others;
    }
    ranked
}

/// How much faster the tires may leave, as a share of the planned launch velocities.
fn spare_launch(judged: Option<&Judgement>) -> f64 {
    match judged.and_then(|judged| judged.launch_margin) {
        Some(LaunchMargin::BeyondTried) => f64::INFINITY,
        Some(LaunchMargin::UpTo { rise, .. }) => rise,
        Some(LaunchMargin::NotPassing) | None => 0.0,
    }
}
