//! `shelter accuracy`: this plan's speed against accuracy, on this machine.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::load_plans::open_option;
use super::print::print;
use super::run_study::run_study;
use super::status::{Status, failed};
use crate::choice::Method;
use crate::report::accuracy::report;
use crate::report::json::AccuracyDocument;
use crate::study::accuracy::measure;
use crate::study::accuracy::paper_table::{PaperRow, paper_table};
use crate::study::{Computed, Context};

/// Runs that are expected to take longer are left out.
const PATIENCE: Duration = Duration::from_secs(8);

#[derive(Args)]
pub struct Arguments {
    /// Plan to measure
    plan: PathBuf,
    /// Name of the delay option; default: the first
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: ComputeArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some((case, option)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    let measured = run_study(&arguments.compute, |control| {
        measure(&Context::new(&case, arguments.compute.settings(&case.plan), control), option, PATIENCE)
    });
    let Computed { value: study, partial } = match measured {
        Ok(finished) => finished,
        Err(reason) => return failed(&reason),
    };
    let document = || AccuracyDocument::new(&case, &study);
    // Scripts do not read the table of the paper, which takes time.
    let paper: Vec<(Method, Vec<PaperRow>)> = match arguments.format {
        FormatArg::Text => {
            let methods = [Method::Verlet, Method::Newmark].into_iter();
            methods.filter_map(|method| Some((method, paper_table(&case, method)?))).collect()
        }
        FormatArg::Json | FormatArg::Csv | FormatArg::CsvSemicolon => Vec::new(),
    };
    let status = print(&[report(&case, &study, &paper)], document, arguments.format, look)?;
    Ok(if partial { Status::Fail } else { status })
}
