//! Messages of a command beside its results.

use std::fmt::Display;
use std::io::{self, Write};

use crate::plan::{Diagnostics, visible};

/// Prints a line to standard error. Hidden characters are shown, because names in the line may hold any.
pub fn line(words: impl Display) {
    write(&visible(&words.to_string()));
}

/// Prints the mistakes of a plan or of a list.
pub fn mistakes(mistakes: &Diagnostics, color: bool) {
    write(mistakes.render(color).trim_end());
}

/// Writes to standard error, and ignores errors: there may be no reader any more, and `eprintln` would panic.
fn write(text: &str) {
    let _ = io::stderr().write_all(format!("{text}\n").as_bytes());
}

/// Prints a line to standard error, like `eprintln`.
macro_rules! tell {
    ($($words:tt)*) => { $crate::cli::tell::line(format_args!($($words)*)) };
}
