//! What a command says beside its results.

use std::fmt::Display;
use std::io::{self, Write};

use crate::plan::{Diagnostics, visible};

/// Prints a line to standard error. Names in it may hold anything.
pub fn line(words: impl Display) {
    write(&visible(&words.to_string()));
}

/// Prints the mistakes of a plan or of a list.
pub fn mistakes(mistakes: &Diagnostics, color: bool) {
    write(mistakes.render(color).trim_end());
}

/// Where nobody reads any more, there is nobody to tell; `eprintln` would panic.
fn write(text: &str) {
    let _ = io::stderr().write_all(format!("{text}\n").as_bytes());
}

/// Prints a line to standard error, like `eprintln`.
macro_rules! tell {
    ($($words:tt)*) => { $crate::cli::tell::line(format_args!($($words)*)) };
}
