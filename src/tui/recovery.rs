//! Edits that a signal, or a terminal that went away, left unsaved: kept in a file of the program's own, and back at the next
//! start.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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
pub struct RecoveredEdits {
    /// The text with the edits.
    pub text: String,
    /// Checksum of the text of the file that was edited.
    before: String,
}

impl RecoveredEdits {
    /// Whether they are edits of this text of the file; if not, another program has changed the file since.
    pub fn are_of(&self, saved: &str) -> bool {
        self.before == checksum(saved)
    }
}

/// Keeps the text of a plan whose file holds `saved`.
pub fn save(plan: Option<&Path>, saved: &str, text: &str) -> io::Result<()> {
    let path = path(plan).ok_or(io::ErrorKind::NotFound)?;
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    file::save(&path, &format!("# {}\n{text}", checksum(saved)))
}

/// The edits that were kept of a plan.
pub fn find(plan: Option<&Path>) -> Option<RecoveredEdits> {
    let kept = fs::read_to_string(path(plan)?).ok()?;
    let (before, text) = kept.strip_prefix("# ")?.split_once('\n')?;
    Some(RecoveredEdits { text: text.to_owned(), before: before.to_owned() })
}

/// Drops what was kept of a plan: it is saved now, or given up.
pub fn drop(plan: Option<&Path>) {
    // Where there is no such file nothing is left to do.
    let _ = path(plan).map(fs::remove_file);
}
