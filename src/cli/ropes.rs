//! `shelter ropes`: the catalogue.

use std::io::{self, Write};

use clap::Args;

use super::{FormatArg, Status};
use crate::report;
use crate::ropes::catalogue;

#[derive(Args)]
pub struct Arguments {
    /// Terminations and what they leave of a rope's strength
    #[arg(long)]
    terminations: bool,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
}

pub fn run(arguments: &Arguments) -> io::Result<Status> {
    let catalogue = catalogue();
    let text = match (arguments.format, arguments.terminations) {
        (FormatArg::Text, false) => report::ropes::text(catalogue),
        (FormatArg::Text, true) => report::ropes::terminations(catalogue),
        (FormatArg::Json, _) => report::json(&report::ropes::Document::new(catalogue)),
        (FormatArg::Csv, false) => report::csv(&catalogue.ropes),
        (FormatArg::Csv, true) => report::csv(&catalogue.terminations),
    };
    io::stdout().write_all(text.as_bytes())?;
    Ok(Status::Pass)
}
