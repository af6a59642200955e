//! Edits that are not saved: kept in a file of the program's own a second after they are made, and back at the next start, however
//! the program ended.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chrono::{DateTime, Local};

use super::config::state_folder;
use crate::file::{self, checksum};

/// The file with the unsaved edits of a plan; of a plan without a file where `plan` is `None`.
fn path(plan: Option<&Path>) -> Option<PathBuf> {
    let name = match plan {
        Some(plan) => {
            let path = plan.canonicalize().ok()?;
            checksum(path.as_os_str().as_encoded_bytes())
        }
        None => "new-plan".to_owned(),
    };
    Some(state_folder()?.join("unsaved").join(name).with_extension("toml"))
}

/// Edits that were kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecoveredEdits {
    /// The text with the edits.
    pub text: String,
    /// When they were kept, in words.
    pub time: String,
    /// Checksum of the text of the file that was edited.
    before: String,
}

impl RecoveredEdits {
    /// Whether they are edits of this text of the file; if not, another program has changed the file since.
    pub fn are_of(&self, saved: &str) -> bool {
        self.before == checksum(saved)
    }
}

/// The edits that were kept of a plan.
pub fn find(plan: Option<&Path>) -> Option<RecoveredEdits> {
    let path = path(plan)?;
    let kept = fs::read_to_string(&path).ok()?;
    let (before, text) = kept.strip_prefix("# ")?.split_once('\n')?;
    let written = path.metadata().and_then(|data| data.modified()).ok()?;
    let time = DateTime::<Local>::from(written).format("%Y-%m-%d %H:%M").to_string();
    Some(RecoveredEdits { text: text.to_owned(), time, before: before.to_owned() })
}

/// Drops what was kept of a plan: it is saved now, or given up.
pub fn drop(plan: Option<&Path>) {
    // Where there is no such file nothing is left to do.
    let _ = path(plan).map(fs::remove_file);
}

/// Keeps the edits of a session while they are not saved.
#[derive(Debug, Default)]
pub struct Keeper {
    /// The text in the file of kept edits, as far as this session wrote it or took it from there.
    kept: Option<String>,
    /// When the text was first seen to be another one.
    other_since: Option<Instant>,
}

impl Keeper {
    /// The keeper of a session that begins with `text`.
    pub fn new(plan: Option<&Path>, text: &str) -> Self {
        let kept = find(plan).map(|kept| kept.text).filter(|kept| kept == text);
        Self { kept, other_since: None }
    }

    /// Keeps `text` once it has differed from what is kept for `pause`; drops what is kept where the file of the plan holds `text`,
    /// as `saved`.
    pub fn keep_after(
        &mut self,
        pause: Duration,
        plan: Option<&Path>,
        saved: &str,
        text: &str,
    ) -> io::Result<()> {
        if text == saved {
            self.other_since = None;
            if self.kept.take().is_some() {
                drop(plan);
            }
        } else if self.kept.as_deref() == Some(text) {
            self.other_since = None;
        } else if self.other_since.get_or_insert_with(Instant::now).elapsed() >= pause {
            self.other_since = None;
            let path = path(plan).ok_or(io::ErrorKind::NotFound)?;
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            file::save(&path, &format!("# {}\n{text}", checksum(saved)))?;
            self.kept = Some(text.to_owned());
        }
        Ok(())
    }
}
