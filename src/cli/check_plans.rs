//! Checking all options of some plans and printing their results, for every command that does.

use std::io;

use serde::Serialize;

use super::arguments::{Compute, FormatArg, LookArguments};
use super::print::print;
use super::run_study::run_study;
use super::status::{FINER, Status};
use crate::report::check::report;
use crate::report::json::CheckDocument;
use crate::report::model::Report;
use crate::study::check_all::{OptionResults, check_all, find_launch_margins};
use crate::study::sampling::Sampling;
use crate::study::{Case, Finding, Found, NoResult};

/// Checks all options of all cases in parallel; the results stand in the order of plans and options.
pub fn check_plans(
    cases: &[Case],
    sampling: Option<Sampling>,
    compute: &Compute,
) -> Finding<Vec<OptionResults>> {
    let cases: Vec<_> = cases.iter().map(|case| (case, compute.settings(&case.plan))).collect();
    run_study(compute, |progress| {
        let mut found = check_all(&cases, sampling.as_ref(), progress)?;
        if sampling.is_some() {
            found.partial |= find_launch_margins(&cases, &mut found.value, progress, &|_, _| {})?.partial;
        }
        Ok(found)
    })
}

/// One document for one plan, a list of documents for several.
#[derive(Serialize)]
#[serde(untagged)]
enum Documents {
    One(Box<CheckDocument>),
    Several(Vec<CheckDocument>),
}

/// Prints the results of all cases; with `any` one passing option is enough.
pub fn print_checks(
    cases: &[Case],
    checked: &Found<Vec<OptionResults>>,
    any: bool,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let Found { value: checked, partial } = checked;
    let pairs = || cases.iter().zip(checked);
    let reports: Vec<Report> = pairs().map(|(case, results)| report(case, results, any, *partial)).collect();
    let documents = || {
        let document =
            |(case, results): (&Case, &OptionResults)| CheckDocument::new(case, results, any, *partial);
        let mut all: Vec<_> = pairs().map(document).collect();
        match all.len() {
            1 => Documents::One(Box::new(all.remove(0))),
            _ => Documents::Several(all),
        }
    };
    let status = print(&reports, documents, format, look)?;
    let needs_finer_step =
        |failed: &NoResult| matches!(failed, NoResult::Failed(failure) if failure.needs_finer_step());
    if checked.iter().flatten().any(|result| result.as_ref().is_err_and(needs_finer_step)) {
        eprintln!("a run failed: {FINER}");
    }
    Ok(status)
}
