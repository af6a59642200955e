//! What happened to the file of a plan since its text was read: one rule for commands, screens and pages.

use std::path::Path;

use crate::plan::PlanSource;

/// State of a plan's file since its text was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileState {
    /// The file still holds that text.
    AsJudged,
    /// The file holds another text.
    Changed,
    /// The file is gone, so nobody can tell whether the plan is still the same.
    Gone,
    /// The plan came from standard input or another pipe, which is read once.
    Pipe,
}

impl FileState {
    /// The state of the file of `source` at this moment.
    pub fn now(source: &PlanSource) -> Self {
        Self::of(Path::new(&source.path), &source.text)
    }

    /// The state of the file at `path`, which held `text`.
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

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_is_as_judged_changed_or_gone_or_no_file_that_can_be_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let plan = folder.path().join("rows.toml");
        let now = || FileState::of(&plan, "a plan");
        assert_eq!(now(), FileState::Gone);
        fs::write(&plan, "a plan").expect("written");
        assert_eq!(now(), FileState::AsJudged);
        fs::write(&plan, "another").expect("written");
        assert_eq!(now(), FileState::Changed);
        assert_eq!(FileState::of(folder.path(), ""), FileState::Changed, "a folder");
        assert_eq!(FileState::of("-".as_ref(), "a plan"), FileState::Pipe);
    }

    /// Opening a pipe waits for a writer.
    #[cfg(unix)]
    #[test]
    fn a_named_pipe_is_not_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().expect("it runs").success());
        let (sender, answer) = std::sync::mpsc::channel();
        std::thread::spawn(move || sender.send(FileState::of(&pipe, "a plan")));
        assert_eq!(answer.recv_timeout(std::time::Duration::from_secs(20)), Ok(FileState::Pipe));
    }
}
