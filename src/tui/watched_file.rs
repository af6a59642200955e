//! The file of the plan. Notices changes by other programs; saves the file completely or not at all.

use std::io;
use std::path::{Path, PathBuf};

use crate::file::{self, Stamp, stamp};
use crate::study::Case;

/// The file of a plan, with its stamp at the last look.
pub struct WatchedFile {
    path: PathBuf,
    seen: Option<Stamp>,
}

impl WatchedFile {
    /// Watches the file from its present state on.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), seen: stamp(path) }
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The plan in the file or its first mistake, if the file has changed since the last look.
    pub fn changed(&mut self) -> Option<Result<Case, String>> {
        let now = stamp(&self.path);
        if std::mem::replace(&mut self.seen, now) == now {
            return None;
        }
        if now.is_none() {
            return Some(Err("the file is gone".to_owned()));
        }
        Some(Case::load(&self.path).map_err(|mistakes| {
            let first = mistakes.iter().next();
            first.map_or_else(String::new, |(line, column, message, _)| {
                format!("line {line}:{column}: {message}")
            })
        }))
    }

    /// Makes the next call of `changed` report a change.
    pub fn expect_change(&mut self) {
        self.seen = None;
    }

    /// Writes `text`, unless the file's text is no longer `before`.
    pub fn write(&mut self, before: &str, text: &str) -> Result<(), Refusal> {
        let failed = |error: io::Error| Refusal::Failed(error.to_string());
        if self.path.exists() && !self.path.is_file() {
            // Reading a pipe that nobody writes to would block the screen.
            return Err(Refusal::Failed(format!("{} is no file any more", self.path.display())));
        }
        match std::fs::read_to_string(&self.path) {
            Ok(now) if now != before => return Err(Refusal::Changed),
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(failed(error)),
            Ok(_) | Err(_) => {}
        }
        file::save(&self.path, text).map_err(failed)?;
        self.seen = stamp(&self.path);
        Ok(())
    }
}

/// Why a plan was not written.
#[derive(Debug, PartialEq)]
pub enum Refusal {
    /// Another program has changed the file.
    Changed,
    /// The file could not be read or written, for this reason.
    Failed(String),
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, SystemTime};

    use super::*;

    /// Reading a pipe that nobody writes to would never end.
    #[cfg(unix)]
    #[test]
    fn a_file_that_becomes_a_pipe_is_gone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("plan.toml");
        std::fs::write(&path, "title = 1").expect("a file");
        let mut file = WatchedFile::new(&path);
        std::fs::remove_file(&path).expect("removed");
        let made = std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo runs");
        assert!(made.success());
        assert!(matches!(file.changed(), Some(Err(_))));
        assert!(matches!(file.write("title = 1", "title = 2"), Err(Refusal::Failed(_))));
    }

    /// A clock that is set back between two saves makes the later file look older.
    #[test]
    fn a_change_is_noticed_whichever_way_the_clock_went() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("plan.toml");
        std::fs::write(&path, "title = 1").expect("a file");
        let mut file = WatchedFile::new(&path);
        assert!(file.changed().is_none());
        let (now, day) = (SystemTime::now(), Duration::from_secs(86_400));
        for shifted in [now - day, now + 2 * day, now - 3 * day] {
            let written = std::fs::File::options().write(true).open(&path).expect("the file");
            written.set_modified(shifted).expect("a time");
            assert!(file.changed().is_some(), "{shifted:?}");
            assert!(file.changed().is_none());
        }
    }
}
