//! All delay options of one plan or of several, judged in parallel.

use super::batch::each;
use super::check::check;
use super::judgement::Judgement;
use super::margin::launch_margin;
use super::merge::OptionSample;
use super::risk::{Risk, Sampling, Target, sample};
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, guarded};
use crate::verdict::Verdict;

/// Results of the options of one plan, in their order (`n_options`).
pub type Results = Vec<Result<Judgement, NoResult>>;

/// Judges every option of every case: first all shots as planned, then, where a `sampling` is given, how likely they fail.
/// Returns the results by case; an option that the time did not suffice for has the result [`NoResult::OutOfTime`].
pub fn check_all(
    cases: &[(&Case, ComputeSettings)],
    sampling: Option<&Sampling>,
    progress: &Progress,
) -> Finding<Vec<Results>> {
    let jobs: Vec<(usize, usize)> = cases
        .iter()
        .enumerate()
        .flat_map(|(n, (case, _))| (0..case.shots.len()).map(move |option| (n, option)))
        .collect();
    let checked = each(&jobs, progress, |&(n, option)| {
        let (case, compute) = &cases[n];
        let checked = guarded(|| {
            check(case, option, compute, &mut |_| progress.flow())
                .map_err(|failure| progress.no_result(failure))
        });
        match checked {
            Err(ended @ (NoResult::Stopped | NoResult::OutOfTime)) => Err(ended),
            // An option without a result is no reason for the others to have none.
            result => Ok(result),
        }
    })?;
    let mut partial = checked.iter().any(Option::is_none);
    let checked = checked.into_iter().map(|checked| checked.unwrap_or(Err(NoResult::OutOfTime)));
    let mut judged: Vec<_> = checked.map(|checked| checked.map(Judgement::nominal)).collect();
    if let Some(sampling) = sampling {
        let known = jobs.iter().zip(&mut judged).filter_map(|(&at, of)| Some((at, of.as_mut().ok()?)));
        let (at, mut judged): (Vec<_>, Vec<&mut Judgement>) = known.unzip();
        let nominal: Vec<Verdict> = judged.iter().map(|judged| judged.nominal.verdict).collect();
        // A shot that fails as planned is sampled only to show by how much.
        let enough = |n: usize| nominal[n] == Verdict::Fail;
        let planned = judged.iter().map(|judged| Envelope::of(&judged.nominal));
        let targets = targets(cases, &at).into_iter().zip(planned);
        let targets: Vec<_> =
            targets.map(|(target, planned)| Target { planned: Some(planned), ..target }).collect();
        let (risks, out_of_time) = sample(&targets, sampling, progress, enough, &mut |_, _| {})?;
        partial |= out_of_time;
        judged.iter_mut().zip(risks).for_each(|(judged, risk)| judged.risk = Some(risk));
    }
    let mut results: Vec<Results> = cases.iter().map(|_| Vec::new()).collect();
    for ((n, _), judged) in jobs.into_iter().zip(judged) {
        results[n].push(judged);
    }
    Ok(Found { value: results, partial })
}

/// Options with a result, as `(case, option)`, and how to compute each.
fn targets<'c>(cases: &[(&'c Case, ComputeSettings)], at: &[(usize, usize)]) -> Vec<Target<'c>> {
    let target = |&(n, option): &(usize, usize)| {
        let (case, compute) = cases[n];
        Target { case, shot: &case.shots[option], planned: None, compute }
    };
    at.iter().map(target).collect()
}

/// Finds the launch margin of every option of every case that has a result; returns whether the time sufficed.
pub fn find_launch_margins(
    cases: &[(&Case, ComputeSettings)],
    results: &mut [Results],
    progress: &Progress,
) -> Result<bool, NoResult> {
    let mut known: Vec<((usize, usize), &mut Judgement)> = Vec::new();
    for (n, results) in results.iter_mut().enumerate() {
        let judged = results
            .iter_mut()
            .enumerate()
            .filter_map(|(option, result)| Some((option, result.as_mut().ok()?)));
        known.extend(judged.map(|(option, judged)| ((n, option), judged)));
    }
    let at: Vec<_> = known.iter().map(|(at, _)| *at).collect();
    let nominal: Vec<Verdict> = known.iter().map(|(_, judged)| judged.nominal.verdict).collect();
    let jobs: Vec<_> = targets(cases, &at).into_iter().zip(nominal).collect();
    let margins = each(&jobs, progress, |(target, nominal)| {
        let Target { case, shot, compute, .. } = target;
        guarded(|| launch_margin(case, shot, *nominal, compute, progress))
    })?;
    let complete = !margins.contains(&None);
    for ((_, judged), margin) in known.into_iter().zip(margins) {
        judged.launch_margin = margin;
    }
    Ok(complete)
}

/// Judges every option of a case as planned, and by samples that were drawn before, in order of their numbers.
pub fn judge_drawn(
    case: &Case,
    compute: &ComputeSettings,
    samples: &[OptionSample],
    progress: &Progress,
) -> Result<Results, NoResult> {
    let mut results = check_all(&[(case, *compute)], None, progress)?.value.remove(0);
    for (option, result) in results.iter_mut().enumerate() {
        if let Ok(judged) = result {
            let mut risk = Risk::new(case, Some(Envelope::of(&judged.nominal)));
            samples.iter().filter(|of| of.option == option).for_each(|of| risk.push(of.sample));
            judged.risk = Some(risk);
        }
    }
    Ok(results)
}

/// The verdict on a plan: the worst of its options, or the best where one passing option is enough.
pub fn verdict(results: &Results, any: bool) -> Verdict {
    let each = results.iter().map(|result| result.as_ref().map_or(Verdict::Undecided, Judgement::verdict));
    if any { each.min().unwrap_or(Verdict::Pass) } else { Verdict::worst(each) }
}
