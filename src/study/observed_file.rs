//! The file beside a plan that holds what was told of its earlier shots in the terminal: `rows.seen.json` for `rows.toml`. It goes where
//! the plan goes.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::observed::Observed;
use crate::file;

/// The file beside a plan.
pub fn path(plan: &Path) -> PathBuf {
    plan.canonicalize().unwrap_or_else(|_| plan.to_owned()).with_extension("seen.json")
}

/// What the file beside a plan holds; nothing where there is none, or can be none: its name would be too long.
pub fn read(plan: &Path) -> Observed {
    let path = path(plan);
    match fs::read_to_string(&path) {
        Ok(text) => parse(&path, &text),
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::InvalidFilename) => {
            Observed::default()
        }
        Err(error) => Observed::unreadable(&path, &error.to_string()),
    }
}

/// What a text of a file holds.
pub fn parse(path: &Path, text: &str) -> Observed {
    serde_json::from_str(text).unwrap_or_else(|error| Observed::unreadable(path, &error.to_string()))
}

/// Writes what was told into the file beside a plan.
pub fn save(plan: &Path, observed: &Observed) -> io::Result<()> {
    file::save(&path(plan), &(serde_json::to_string_pretty(observed)? + "\n"))
}
