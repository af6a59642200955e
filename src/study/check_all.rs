//! All delay options of one plan or of several, checked in parallel.

use super::batch::each;
use super::check::{Checked, check};
use super::{Case, ComputeSettings, Finding, Found, NoResult, Progress, guarded};
use crate::verdict::Verdict;

/// Results of the options of one plan, in their order (`n_options`).
pub type Results = Vec<Result<Checked, NoResult>>;

/// Checks every option of every case. Returns the results by case; an option that the time did not suffice for has the
/// result [`NoResult::OutOfTime`].
pub fn check_all(cases: &[(&Case, ComputeSettings)], progress: &Progress) -> Finding<Vec<Results>> {
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
    let mut results: Vec<Results> = cases.iter().map(|_| Vec::new()).collect();
    let partial = checked.iter().any(Option::is_none);
    for ((n, _), checked) in jobs.into_iter().zip(checked) {
        results[n].push(checked.unwrap_or(Err(NoResult::OutOfTime)));
    }
    Ok(Found { value: results, partial })
}

/// The verdict on a plan: the worst of its options, or the best where one passing option is enough.
pub fn verdict(results: &Results, any: bool) -> Verdict {
    let each = results.iter().map(|result| result.as_ref().map_or(Verdict::Undecided, |c| c.verdict));
    if any { each.min().unwrap_or(Verdict::Pass) } else { Verdict::worst(each) }
}
