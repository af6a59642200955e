//! `shelter check`: pass or fail of every delay option.

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;

use clap::Args;

use super::{Compute, FormatArg, Look, Status, load, long};
use crate::report;
use crate::study::plans::{Results, check_plans, verdict};
use crate::study::{Case, NoResult};
use crate::verdict::Verdict;

#[derive(Args)]
pub struct Arguments {
    /// Plans to check; `-` reads standard input
    #[arg(value_name = "PLAN", required = true)]
    plans: Vec<PathBuf>,
    #[command(flatten)]
    compute: Compute,
    #[command(flatten)]
    output: Output,
}

/// What to print.
#[derive(Args, Clone, Default)]
pub struct Output {
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    pub format: FormatArg,
    /// One passing option is enough
    #[arg(long)]
    pub any: bool,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    match load::cases(&arguments.plans, look) {
        None => Ok(Status::Wrong),
        Some(cases) => print(cases, &arguments.compute, look, &arguments.output),
    }
}

/// Checks every option of every case and prints the results.
pub fn print(cases: Vec<Case>, compute: &Compute, look: &Look, output: &Output) -> io::Result<Status> {
    match all(&cases, compute) {
        Ok(judged) => show(&cases, &judged, look, output),
        Err(no_result) => long::failed(&no_result),
    }
}

/// Prints results; whether all pass.
pub fn show(cases: &[Case], judged: &[Results], look: &Look, output: &Output) -> io::Result<Status> {
    let mut out = io::stdout().lock();
    let pairs = || cases.iter().zip(judged);
    match output.format {
        FormatArg::Text => {
            let style = look.style(out.is_terminal());
            for (case, results) in pairs() {
                write!(out, "{}", report::table::check(case, results, output.any, style))?;
            }
        }
        FormatArg::Json => {
            let mut documents: Vec<_> = pairs()
                .map(|(case, results)| report::check::Document::new(case, results, output.any))
                .collect();
            let text = match documents.len() {
                1 => report::json(&documents.remove(0)),
                _ => report::json(&documents),
            };
            write!(out, "{text}")?;
        }
        FormatArg::Csv => {
            let rows = pairs().flat_map(|(case, results)| report::check::Row::of(case, results));
            write!(out, "{}", report::csv(rows))?;
        }
    }
    out.flush()?;
    let verdicts = judged.iter().map(|results| verdict(results, output.any));
    let passed = Verdict::worst(verdicts) == Verdict::Pass;
    Ok(if passed { Status::Pass } else { Status::Fail })
}

/// All options of all cases in parallel; results in the order of plans and options.
pub fn all(cases: &[Case], compute: &Compute) -> Result<Vec<Results>, NoResult> {
    let cases: Vec<_> = cases.iter().map(|case| (case, compute.settings(&case.plan))).collect();
    Ok(long::run(compute, |progress| check_plans(&cases, progress))?.value)
}
