//! `shelter accuracy`: this plan's speed against accuracy, on this machine.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::long::Finished;
use super::{Compute, FormatArg, Look, Status, load, long};
use crate::report;
use crate::study::accuracy::measure;

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
    compute: Compute,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some((case, option)) = load::case_and_option(&arguments.plan, arguments.option.as_deref(), look)
    else {
        return Ok(Status::Wrong);
    };
    let measured = long::run(&arguments.compute, |progress| measure(&case, option, PATIENCE, progress));
    let Finished { value: study, partial } = match measured {
        Ok(finished) => finished,
        Err(failure) => return long::failed(&failure),
    };
    let text = match arguments.format {
        FormatArg::Text => report::accuracy::text(&case, option, &study),
        FormatArg::Json => report::json(&report::accuracy::Document::new(&case, option, &study)),
        FormatArg::Csv => report::csv(report::accuracy::rows(&study)),
    };
    long::print(&text)?;
    Ok(if partial { Status::Fail } else { Status::Pass })
}
