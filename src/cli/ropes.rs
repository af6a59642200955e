//! `shelter ropes`: the catalogue.

use std::io;

use clap::Args;

use super::arguments::{FormatArg, LookArguments};
use super::print::print;
use super::status::Status;
use crate::report::ropes::{ropes, terminations};
use crate::ropes::catalogue;

#[derive(Args)]
pub struct Arguments {
    /// Terminations and the share of a rope's breaking force that they hold
    #[arg(long)]
    terminations: bool,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let catalogue = catalogue();
    let report = if arguments.terminations { terminations(catalogue) } else { ropes(catalogue) };
    print(&[report], arguments.format, look)
}
