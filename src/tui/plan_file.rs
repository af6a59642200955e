//! The plan's file: noticed when another program changes it, and replaced whole when saved.

use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::file;
use crate::study::Case;

/// A plan's file and how it was last seen.
pub struct PlanFile {
    path: PathBuf,
    seen: Option<(SystemTime, u64)>,
}

impl PlanFile {
    /// As it is now.
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), seen: stamp(path) }
    }

    /// The plan in the file, or what is wrong with it, if the file has changed since it was last seen.
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

    /// The next look will find it changed.
    pub fn forget(&mut self) {
        self.seen = None;
    }

    /// Writes `text`, unless the file is no longer the one whose text was `before`.
    pub fn write(&mut self, before: &str, text: &str) -> Result<(), Refusal> {
        let failed = |error: io::Error| Refusal::Failed(error.to_string());
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
    /// In words.
    Failed(String),
}

fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let data = path.metadata().ok()?;
    Some((data.modified().ok()?, data.len()))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    /// A clock set back between two saves makes the later one look older.
    #[test]
    fn a_change_is_noticed_whichever_way_the_clock_went() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("plan.toml");
        std::fs::write(&path, "title = 1").expect("a file");
        let mut file = PlanFile::new(&path);
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
