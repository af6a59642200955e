//! What became of the file of a plan since its text was read: one rule for commands, screens and pages.

use std::path::Path;

use crate::plan::PlanSource;

/// What became of a plan's file since its text was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// It holds that text.
    AsJudged,
    /// It says something else.
    Changed,
    /// It is not there: nobody can tell whether the plan is still that one.
    Gone,
    /// The plan came from standard input or another pipe, which is read once.
    Pipe,
}

impl FileState {
    /// The state of the file of `source` at this moment.
    pub fn now(source: &PlanSource) -> Self {
        Self::of(Path::new(&source.path), &source.text)
    }

    /// The state of this file, which held `text`.
    pub fn of(path: &Path, text: &str) -> Self {
        let is_pipe = path.as_os_str() == "-" || path.exists() && !path.is_file() && !path.is_dir();
        let holds_text = || PlanSource::read(path).is_ok_and(|now| now.text == text);
        match path.exists() {
            _ if is_pipe => Self::Pipe,
            true if holds_text() => Self::AsJudged,
            true => Self::Changed,
            false => Self::Gone,
        }
    }
}
