//! `shelter accuracy`: this plan's speed against accuracy, on this machine.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use super::{Compute, FormatArg, Look, Status, load};
use crate::report;
use crate::study::accuracy::measure;

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
    let study = arguments.compute.on_threads(|| measure(&case, option));
    let text = match arguments.format {
        FormatArg::Text => report::accuracy::text(&case, option, &study),
        FormatArg::Json => report::json(&report::accuracy::Document::new(&case, option, &study)),
        FormatArg::Csv => report::csv(report::accuracy::rows(&study)),
    };
    io::stdout().write_all(text.as_bytes())?;
    Ok(Status::Pass)
}
