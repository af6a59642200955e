//! All delay options of one plan or of several, judged in parallel.

use super::batch::run_jobs;
use super::check::check;
use super::judgement::Judgement;
use super::margin::launch_margin;
use super::merge::OptionSample;
use super::sample::Sample;
use super::sampling::{Sampling, ShotToSample, find_risks};
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, guarded};
use crate::verdict::Verdict;

/// Results of the options of one plan, in their order (`n_options`).
pub type OptionResults = Vec<Result<Judgement, NoResult>>;

/// Judges every option of every case: first all shots as planned, then, where a `sampling` is given, how likely they fail.
/// Returns the results by case; an option that the time did not suffice for has the result [`NoResult::OutOfTime`].
pub fn check_all(
    cases: &[(&Case, ComputeSettings)],
    sampling: Option<&Sampling>,
    progress: &Progress,
) -> Finding<Vec<OptionResults>> {
    let jobs: Vec<(usize, usize)> = cases
        .iter()
        .enumerate()
        .flat_map(|(n, (case, _))| (0..case.shots.len()).map(move |option| (n, option)))
        .collect();
    let checked = run_jobs(&jobs, progress, |&(n, option)| {
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
        partial |= add_risks(cases, known.collect(), sampling, progress)?.partial;
    }
    let mut results: Vec<OptionResults> = cases.iter().map(|_| Vec::new()).collect();
    for ((n, _), judged) in jobs.into_iter().zip(judged) {
        results[n].push(judged);
    }
    Ok(Found { value: results, partial })
}

/// Samples options that are judged as planned, each given as `(case, option)`.
fn add_risks(
    cases: &[(&Case, ComputeSettings)],
    mut judged: Vec<((usize, usize), &mut Judgement)>,
    sampling: &Sampling,
    progress: &Progress,
) -> Finding<()> {
    let target = |((n, option), judged): &((usize, usize), &mut Judgement)| {
        let (case, compute) = cases[*n];
        target(case, *option, &Envelope::of(&judged.nominal), sampling, compute)
    };
    let targets: Vec<ShotToSample<'_>> = judged.iter().map(target).collect();
    let Found { value: risks, partial } = find_risks(&targets, progress, &mut |_, _| {})?;
    judged.iter_mut().zip(risks).for_each(|((_, judged), risk)| judged.risk = Some(risk));
    Ok(Found { value: (), partial })
}

/// An option to be sampled, judged as `planned`; one that fails is sampled only to show by how much.
pub fn target<'c>(
    case: &'c Case,
    option: usize,
    planned: &Envelope,
    sampling: &Sampling,
    compute: ComputeSettings,
) -> ShotToSample<'c> {
    let fails = planned.verdict == Verdict::Fail;
    let sampling = if fails { sampling.least_only() } else { *sampling };
    ShotToSample {
        case,
        shot: &case.shots[option],
        planned: Some(*planned),
        compute,
        sampling,
        precomputed: &[],
    }
}

/// Finds the launch margin of every option of every case that has a result.
pub fn find_launch_margins(
    cases: &[(&Case, ComputeSettings)],
    results: &mut [OptionResults],
    progress: &Progress,
) -> Finding<()> {
    let mut known: Vec<((usize, usize), &mut Judgement)> = Vec::new();
    for (n, results) in results.iter_mut().enumerate() {
        let judged = results
            .iter_mut()
            .enumerate()
            .filter_map(|(option, result)| Some((option, result.as_mut().ok()?)));
        known.extend(judged.map(|(option, judged)| ((n, option), judged)));
    }
    let jobs: Vec<_> = known.iter().map(|(at, judged)| (*at, judged.nominal.verdict)).collect();
    let margins = run_jobs(&jobs, progress, |&((n, option), nominal)| {
        let (case, compute) = &cases[n];
        match guarded(|| launch_margin(case, &case.shots[option], nominal, compute, progress)) {
            // The verdicts stand without it.
            Err(NoResult::Panicked(_)) => Ok(None),
            margin => margin.map(Some),
        }
    })?;
    let partial = margins.contains(&None);
    for ((_, judged), margin) in known.into_iter().zip(margins) {
        judged.launch_margin = margin.flatten();
    }
    Ok(Found { value: (), partial })
}

/// Judges every option of a case as planned, and by samples that other machines drew, in order of their numbers.
pub fn judge_drawn(
    case: &Case,
    compute: &ComputeSettings,
    sampling: &Sampling,
    samples: &[OptionSample],
    progress: &Progress,
) -> Result<OptionResults, NoResult> {
    let mut results = check_all(&[(case, *compute)], None, progress)?.value.remove(0);
    for (option, result) in results.iter_mut().enumerate() {
        if let Ok(judged) = result {
            let of_option = samples.iter().filter(|of| of.option == option);
            let drawn: Vec<Sample> = of_option.map(|of| of.sample).collect();
            let planned = Envelope::of(&judged.nominal);
            let target =
                ShotToSample { precomputed: &drawn, ..target(case, option, &planned, sampling, *compute) };
            judged.risk = find_risks(&[target], progress, &mut |_, _| {})?.value.pop();
        }
    }
    Ok(results)
}

/// The verdict on a plan: the worst of its options, or the best where one passing option is enough.
pub fn verdict(results: &OptionResults, any: bool) -> Verdict {
    let each = results.iter().map(|result| result.as_ref().map_or(Verdict::Undecided, Judgement::verdict));
    if any { each.min().unwrap_or(Verdict::Pass) } else { Verdict::worst(each) }
}
