//! All delay options of one plan or of several, judged in parallel.

use super::batch::each;
use super::check::check;
use super::judgement::Judgement;
use super::margin::launch_margin;
use super::merge::OptionSample;
use super::sample::Sample;
use super::sampling::{Sampling, Target, find_risks};
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
        partial |= add_risks(cases, known.collect(), sampling, progress)?;
    }
    let mut results: Vec<Results> = cases.iter().map(|_| Vec::new()).collect();
    for ((n, _), judged) in jobs.into_iter().zip(judged) {
        results[n].push(judged);
    }
    Ok(Found { value: results, partial })
}

/// Samples options that are judged as planned, each given as `(case, option)`; returns whether the time was up.
fn add_risks(
    cases: &[(&Case, ComputeSettings)],
    mut judged: Vec<((usize, usize), &mut Judgement)>,
    sampling: &Sampling,
    progress: &Progress,
) -> Result<bool, NoResult> {
    let target = |((n, option), judged): &((usize, usize), &mut Judgement)| {
        let (case, compute) = cases[*n];
        target(case, *option, &Envelope::of(&judged.nominal), sampling, compute)
    };
    let targets: Vec<Target<'_>> = judged.iter().map(target).collect();
    let (risks, out_of_time) = find_risks(&targets, progress, &mut |_, _| {})?;
    judged.iter_mut().zip(risks).for_each(|((_, judged), risk)| judged.risk = Some(risk));
    Ok(out_of_time)
}

/// An option to be sampled, judged as `planned`; one that fails is sampled only to show by how much.
pub fn target<'c>(
    case: &'c Case,
    option: usize,
    planned: &Envelope,
    sampling: &Sampling,
    compute: ComputeSettings,
) -> Target<'c> {
    let fails = planned.verdict == Verdict::Fail;
    let sampling = if fails { sampling.least_only() } else { *sampling };
    Target { case, shot: &case.shots[option], planned: Some(*planned), compute, sampling, drawn: &[] }
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
    let jobs: Vec<_> = known.iter().map(|(at, judged)| (*at, judged.nominal.verdict)).collect();
    let margins = each(&jobs, progress, |&((n, option), nominal)| {
        let (case, compute) = &cases[n];
        guarded(|| launch_margin(case, &case.shots[option], nominal, compute, progress))
    })?;
    let complete = !margins.contains(&None);
    for ((_, judged), margin) in known.into_iter().zip(margins) {
        judged.launch_margin = margin;
    }
    Ok(complete)
}

/// Judges every option of a case as planned, and by samples that other machines drew, in order of their numbers.
pub fn judge_drawn(
    case: &Case,
    compute: &ComputeSettings,
    sampling: &Sampling,
    samples: &[OptionSample],
    progress: &Progress,
) -> Result<Results, NoResult> {
    let mut results = check_all(&[(case, *compute)], None, progress)?.value.remove(0);
    for (option, result) in results.iter_mut().enumerate() {
        if let Ok(judged) = result {
            let of_option = samples.iter().filter(|of| of.option == option);
            let drawn: Vec<Sample> = of_option.map(|of| of.sample).collect();
            let planned = Envelope::of(&judged.nominal);
            let target = Target { drawn: &drawn, ..target(case, option, &planned, sampling, *compute) };
            let (mut risks, _) = find_risks(&[target], progress, &mut |_, _| {})?;
            judged.risk = risks.pop();
        }
    }
    Ok(results)
}

/// The verdict on a plan: the worst of its options, or the best where one passing option is enough.
pub fn verdict(results: &Results, any: bool) -> Verdict {
    let each = results.iter().map(|result| result.as_ref().map_or(Verdict::Undecided, Judgement::verdict));
    if any { each.min().unwrap_or(Verdict::Pass) } else { Verdict::worst(each) }
}
