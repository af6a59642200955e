//! Judging all options of some plans and printing their results, for every command that does.

use std::io;
use std::path::Path;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::print::print;
use super::run_study::run_study;
use super::status::{REMEDY_AS_ARGUMENTS, Status};
use crate::report::check::report_of_plan;
use crate::report::language::say;
use crate::report::parts::Report;
use crate::study::check::{self, JudgedPlan};
use crate::study::samples::sample_count::Sampling;
use crate::study::{Case, Computed, Context, NoResult};
use crate::tui::recovery;

/// Judges all options of all cases in parallel and looks at their files again: whoever edits a plan meanwhile gets no pass of the old text.
/// The results stand in the order of plans and options.
pub fn judge_plans(
    cases: Vec<Case>,
    sampling: Option<Sampling>,
    arguments: &ComputeArguments,
    question: &check::Question,
) -> Result<(Vec<Case>, Computed<Vec<JudgedPlan>>), NoResult> {
    let judged = run_study(arguments, |control| {
        let context =
            |case| Context::new(case, arguments.settings(&case.plan), control).with_sampling(sampling);
        question.answer_of_all(&cases.iter().map(context).collect::<Vec<_>>())
    })?;
    Ok((cases.into_iter().map(Case::with_file_now).collect(), judged))
}

/// That observations were typed for a plan in the terminal, which no file holds: no command knows whether they contradict its verdicts.
pub fn typed_in_terminal(case: &Case) -> Option<String> {
    let kept = recovery::find(Some(Path::new(&case.source.path)));
    let has_typed = kept.is_some_and(|kept| kept.observed.has_typed_beside(&case.plan));
    let told = || {
        say!(
            "observations that were typed for this plan in the terminal are not compared here: open it there, or forget them there and name a file that holds them"
        )
    };
    has_typed.then(told)
}

/// Prints the results of all cases.
///
/// What speaks against the verdicts (`contradiction`) stands with them, and nothing is recommended then.
pub fn print_judged_plans(
    cases: &[Case],
    judged: &[JudgedPlan],
    partial: bool,
    contradiction: &[String],
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let reported = |(case, JudgedPlan { results, must_pass, remedies }): (&Case, &JudgedPlan)| {
        let typed = typed_in_terminal(case).into_iter().filter(|told| !contradiction.contains(told));
        let against: Vec<String> = contradiction.iter().cloned().chain(typed).collect();
        report_of_plan(case, results, remedies.as_deref(), *must_pass, &against, partial)
    };
    let reports: Vec<Report> = cases.iter().zip(judged).map(reported).collect();
    let status = print(&reports, format, look)?;
    let needs_finer_step =
        |failed: &NoResult| matches!(failed, NoResult::Failed(failure) if failure.needs_finer_step());
    if judged.iter().flat_map(|plan| &plan.results).any(|result| result.as_ref().is_err_and(needs_finer_step))
    {
        tell!("a run failed: {REMEDY_AS_ARGUMENTS}");
    }
    Ok(status)
}
