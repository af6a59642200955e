//! Prints results in the requested format.

use std::io::{self, IsTerminal, Write};

use super::arguments::{FormatArg, LookArguments};
use super::status::Status;
use crate::report::parts::Report;
use crate::report::{csv, json, text};

/// Prints reports and returns their status. Warnings also go to standard error, unless the text already shows them to the user.
pub fn print(reports: &[Report], format: FormatArg, look: &LookArguments) -> io::Result<Status> {
    let to_terminal = io::stdout().is_terminal();
    let text_is_seen = to_terminal || is_one_stream();
    if !(text_is_seen && matches!(format, FormatArg::Text)) {
        print_warnings(reports);
    }
    let style = look.style(to_terminal);
    let text = match format {
        FormatArg::Text => {
            let each = reports.iter().map(|report| text::text(report, style));
            each.chain(text::of_all(reports, style)).collect()
        }
        FormatArg::Json => json::json(reports)?,
        FormatArg::Csv | FormatArg::CsvSemicolon => csv::csv(reports, format.separators())?,
    };
    print_text(&text)?;
    Ok(Status::of(reports))
}

/// Whether standard output and standard error are one stream, as after `2>&1`. Warnings of a text would then appear twice.
#[cfg(unix)]
fn is_one_stream() -> bool {
    use std::os::fd::{AsFd, BorrowedFd};
    use std::os::unix::fs::MetadataExt;
    let place = |stream: BorrowedFd<'_>| {
        let stream = std::fs::File::from(stream.try_clone_to_owned()?);
        stream.metadata().map(|data| (data.dev(), data.ino()))
    };
    match (place(io::stdout().as_fd()), place(io::stderr().as_fd())) {
        (Ok(out), Ok(error)) => out == error,
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_one_stream() -> bool {
    false
}

/// Prints the warnings of reports to standard error. If there are several reports, each warning begins with the title of its report.
pub fn print_warnings(reports: &[Report]) {
    for report in reports {
        let title = if reports.len() > 1 { format!("{}: ", report.title) } else { String::new() };
        report.warnings.iter().for_each(|warning| tell!("warning: {title}{warning}"));
    }
}

/// Prints a finished text. If the reader of the text has gone away, that is no error: the exit status still states the verdict.
pub fn print_text(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let printed = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    printed.or_else(|error| if error.kind() == io::ErrorKind::BrokenPipe { Ok(()) } else { Err(error) })
}
