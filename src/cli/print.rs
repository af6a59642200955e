//! Printing results in the format asked for.

use std::io::{self, IsTerminal, Write};

use serde::Serialize;

use super::arguments::{FormatArg, LookArguments};
use super::status::Status;
use crate::report::model::Report;
use crate::report::{csv, json, text};

/// Prints reports, or the JSON document of the same results. Returns their status.
pub fn print<D: Serialize>(
    reports: &[Report],
    document: impl FnOnce() -> D,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    let style = look.style(io::stdout().is_terminal());
    let text = match format {
        FormatArg::Text => reports.iter().map(|report| text::text(report, style)).collect(),
        FormatArg::Json => json::text(&document())?,
        FormatArg::Csv => csv::csv(reports)?,
    };
    print_beside_verdict(&text)?;
    Ok(Status::of(reports))
}

/// Prints a text beside a verdict: a reader that has gone away changes nothing about the verdict.
pub fn print_beside_verdict(text: &str) -> io::Result<()> {
    let printed = print_text(text);
    printed.or_else(|error| if error.kind() == io::ErrorKind::BrokenPipe { Ok(()) } else { Err(error) })
}

/// Prints a finished text.
pub fn print_text(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}
