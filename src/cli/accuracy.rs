//! `shelter accuracy`: this plan's speed against accuracy, on this machine.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::ask::Ask;
use super::load_plans::find_option;
use super::status::Status;
use crate::study::Case;
use crate::study::accuracy;
use crate::study::question::Question;

/// Longest expected duration of a run. Longer runs are left out.
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
    let Arguments { plan, compute, format, .. } = arguments;
    let question = |case: &Case| {
        let option = find_option(case, arguments.option.as_deref())?;
        // The table of the paper takes time, and scripts do not read it.
        let with_paper_table = matches!(format, FormatArg::Text);
        Ok(Question::Accuracy(accuracy::Question { option, patience: PATIENCE, with_paper_table }))
    };
    Ask::new(plan, compute, None, *format).run_then(look, question, |answered, status| {
        Ok(if answered.found.is_partial() { Status::Fail } else { status })
    })
}
