//! Checks of many shots of one plan. A study keeps only the summary of each.

use super::check::check_shot;
use super::shot_summary::ShotSummary;
use crate::scene::Shot;
use crate::simulation::RunError;
use crate::study::work::batch::run_batch;
use crate::study::{Context, Fingerprint, NoResult, StudyControl};

/// Checks one shot, refined until its verdict is sure.
pub fn check_summary(context: &Context<'_>, shot: &Shot) -> Result<ShotSummary, NoResult> {
    let &Context { case, compute, control, .. } = context;
    control.journal().recall_or(
        || Fingerprint::of(("check", case.fingerprint(), shot, compute)),
        || {
            let checked = check_shot(case, shot, &compute, &mut |_| control.keep_going());
            checked.map(|checked| ShotSummary::of(&checked)).map_err(|failure| control.no_result(failure))
        },
    )
}

/// Checks the shot of every job, like [`run_batch`]. A job whose run fails has the result [`ShotSummary::FAILED_RUN`]. If every run
/// fails, the study has no result.
pub fn run_checks<J: Sync>(
    jobs: &[J],
    control: &StudyControl,
    work: impl Fn(&J) -> Result<ShotSummary, NoResult> + Sync,
) -> Result<Vec<Option<ShotSummary>>, NoResult> {
    let done = run_batch(jobs, control, |job| match work(job) {
        Err(NoResult::Failed(failure)) => Ok(Err(failure)),
        result => result.map(Ok),
    })?;
    if done.iter().flatten().all(Result::is_err)
        && let Some(Err(failure)) = done.iter().flatten().next()
    {
        return Err(NoResult::Failed(failure.clone()));
    }
    let unknown_if_failed = |result: Result<ShotSummary, RunError>| result.unwrap_or(ShotSummary::FAILED_RUN);
    Ok(done.into_iter().map(|result| result.map(unknown_if_failed)).collect())
}

/// Like [`run_checks`], for a part of the jobs of a study: all of this part may fail.
pub fn run_checks_or_failed<J: Sync>(
    jobs: &[J],
    control: &StudyControl,
    work: impl Fn(&J) -> Result<ShotSummary, NoResult> + Sync,
) -> Result<Vec<Option<ShotSummary>>, NoResult> {
    run_batch(jobs, control, |job| or_failed_run(work(job)))
}

/// Turns a failed run into a shot of which nothing is known.
pub fn or_failed_run(checked: Result<ShotSummary, NoResult>) -> Result<ShotSummary, NoResult> {
    match checked {
        Err(NoResult::Failed(_)) => Ok(ShotSummary::FAILED_RUN),
        checked => checked,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Verdict;

    #[test]
    fn a_run_that_fails_is_open_unless_all_fail() {
        let failure = NoResult::Failed(RunError::Diverged { time: 1.0 });
        let good = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        let work = |&job: &i32| if job == 2 { Err(failure.clone()) } else { Ok(good) };
        let some = run_checks(&[1, 2], &StudyControl::default(), work).expect("one of them is good");
        assert_eq!(some, [Some(good), Some(ShotSummary::FAILED_RUN)]);
        assert_eq!(run_checks(&[2, 2], &StudyControl::default(), work), Err(failure.clone()));
    }
}
