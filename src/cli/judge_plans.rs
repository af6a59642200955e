//! Judging all options of some plans and printing their results, for every command that does.

use std::io;

use serde::Serialize;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::print::print;
use super::run_study::run_study;
use super::status::{REMEDY_AS_ARGUMENTS, Status};
use crate::report::check::report;
use crate::report::json::CheckDocument;
use crate::report::parts::Report;
use crate::study::judge_options::{MustPass, OptionResults, UNWATCHED};
use crate::study::recommend::judge_and_confirm;
use crate::study::remedies::{Remedies, find_all_remedies, not_passing};
use crate::study::samples::sample_count::Sampling;
use crate::study::{Case, ComputeResult, Computed, Context, NoResult};

/// The results of one plan.
pub struct JudgedPlan {
    /// The results of its options.
    pub results: OptionResults,
    /// The changes that were tried for options that do not pass; `None` where nobody asked.
    pub remedies: Option<Vec<Remedies>>,
}

/// What stands in place of a recommendation where what was seen speaks against it.
const CONTRADICTED: &str = "what was seen of earlier shots speaks against this plan and its verdicts";

/// Share of the work of `check --why` that the verdicts take.
const SHARE_OF_JUDGEMENT: f64 = 0.2;

/// Judges all options of all cases in parallel; the results stand in the order of plans and options. With `why` the changes of the
/// plans are found with which failing options would pass.
pub fn judge_plans(
    cases: &[Case],
    sampling: Option<Sampling>,
    arguments: &ComputeArguments,
    why: bool,
) -> ComputeResult<Vec<JudgedPlan>> {
    run_study(arguments, |control| {
        let context =
            |case| Context::new(case, arguments.settings(&case.plan), control).with_sampling(sampling);
        let contexts: Vec<Context<'_>> = cases.iter().map(context).collect();
        if why {
            control.has_steps(2);
        }
        let judging = control.part(if why { SHARE_OF_JUDGEMENT } else { 1.0 });
        let Computed { value: results, mut partial } = judge_and_confirm(&contexts, UNWATCHED)?;
        drop(judging);
        let _finding = control.part(1.0);
        let mut judged = Vec::new();
        for (n, (results, context)) in results.into_iter().zip(&contexts).enumerate() {
            let mut remedies = None;
            if why {
                let _plan = control.part(1.0 / (cases.len() - n) as f64);
                let options = not_passing(&results);
                let found = find_all_remedies(context, &options)?;
                partial |= found.partial;
                remedies = Some(found.value);
            }
            judged.push(JudgedPlan { results, remedies });
        }
        Ok(Computed { value: judged, partial })
    })
}

/// One document for one plan, a list of documents for several.
#[derive(Serialize)]
#[serde(untagged)]
enum Documents {
    One(Box<CheckDocument>),
    Several(Vec<CheckDocument>),
}

/// Prints the results of all cases.
///
/// What speaks against the verdicts (`contradiction`) stands with them, and nothing is recommended then.
pub fn print_judged_plans(
    cases: &[Case],
    judged: &Computed<Vec<JudgedPlan>>,
    must_pass: MustPass,
    contradiction: &[String],
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let Computed { value: judged, partial } = judged;
    let pairs = || cases.iter().zip(judged);
    let reported = |(case, JudgedPlan { results, remedies }): (&Case, &JudgedPlan)| {
        let mut report = report(case, results, remedies.as_deref(), must_pass, *partial);
        if !contradiction.is_empty() {
            report.answer = Some(CONTRADICTED.to_owned());
            report.warnings.extend(contradiction.iter().cloned());
        }
        report
    };
    let reports: Vec<Report> = pairs().map(reported).collect();
    let documents = || {
        let document = |(case, JudgedPlan { results, remedies }): (&Case, &JudgedPlan)| {
            let document = CheckDocument::new(case, results, remedies.as_deref(), must_pass, *partial);
            document.contradicted_by(contradiction)
        };
        let mut all: Vec<_> = pairs().map(document).collect();
        match all.len() {
            1 => Documents::One(Box::new(all.remove(0))),
            _ => Documents::Several(all),
        }
    };
    let status = print(&reports, documents, format, look)?;
    let needs_finer_step =
        |failed: &NoResult| matches!(failed, NoResult::Failed(failure) if failure.needs_finer_step());
    if judged.iter().flat_map(|plan| &plan.results).any(|result| result.as_ref().is_err_and(needs_finer_step))
    {
        tell!("a run failed: {REMEDY_AS_ARGUMENTS}");
    }
    Ok(status)
}
