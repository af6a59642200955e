//! Judges all options of some plans and prints their results, for every command that needs this.

use std::io;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::print::print;
use super::run_study::run_study;
use super::standing::{observation_record, standing_now};
use super::status::{REMEDY_AS_ARGUMENTS, Status};
use crate::plan::observations::Observations;
use crate::report::check::report_of_plan;
use crate::report::parts::Report;
use crate::study::check::{self, JudgedPlan};
use crate::study::observed::objection::compare_record;
use crate::study::samples::sample_count::Sampling;
use crate::study::standing::Standing;
use crate::study::{Case, Computed, Context, NoResult};

/// A plan whose options are judged.
pub struct JudgedCase {
    /// The plan.
    pub case: Case,
    /// Standing of the plan now.
    pub standing: Standing,
    /// Observations of earlier shots that the plan was compared with.
    pub files: Vec<Observations>,
    /// The results.
    pub judged: JudgedPlan,
}

/// Judges all options of all cases in parallel, then looks at their files again. If a plan was edited meanwhile, none of its passes stands.
/// The results are in the order of plans and options.
pub fn judge_plans(
    cases: Vec<Case>,
    sampling: Option<Sampling>,
    arguments: &ComputeArguments,
    question: &check::Question,
) -> Result<Computed<Vec<JudgedCase>>, NoResult> {
    let Computed { value: (judged, compared), partial } = run_study(arguments, |control| {
        let context =
            |case| Context::new(case, arguments.settings(&case.plan), control).with_sampling(sampling);
        let contexts: Vec<_> = cases.iter().map(context).collect();
        let Computed { value, partial } = question.answer_of_all(&contexts)?;
        let compared = |context: &Context<'_>| {
            let record = observation_record(context.case);
            (compare_record(context, &record), record.read(context.case).unwrap_or_default())
        };
        Ok(Computed { value: (value, contexts.iter().map(compared).collect::<Vec<_>>()), partial })
    })?;
    let now = |((case, judged), (compared, files))| {
        let standing = standing_now(&case, compared);
        JudgedCase { case, standing, files, judged }
    };
    Ok(Computed { value: cases.into_iter().zip(judged).zip(compared).map(now).collect(), partial })
}

/// Prints the results of all plans, and the objections to them.
pub fn print_judged_plans(
    plans: &Computed<Vec<JudgedCase>>,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let Computed { value: plans, partial } = plans;
    let reported = |JudgedCase { case, standing, files, judged }: &JudgedCase| {
        let JudgedPlan { results, must_pass, remedies } = judged;
        report_of_plan(case, results, remedies.as_deref(), *must_pass, (standing, files), *partial)
    };
    let reports: Vec<Report> = plans.iter().map(reported).collect();
    let status = print(&reports, format, look)?;
    let needs_finer_step =
        |failed: &NoResult| matches!(failed, NoResult::Failed(failure) if failure.needs_finer_step());
    let mut results = plans.iter().flat_map(|plan| &plan.judged.results);
    if results.any(|result| result.as_ref().is_err_and(needs_finer_step)) {
        tell!("a run failed: {REMEDY_AS_ARGUMENTS}");
    }
    Ok(status)
}
