//! Edits that a signal, or a terminal that went away, left unsaved: kept in a file of the program's own, and back at the next
//! start.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::config::state_folder;
use crate::file;

/// The file with the unsaved edits of a plan; of a plan without a file where `plan` is `None`.
fn path(plan: Option<&Path>) -> Option<PathBuf> {
    let name = match plan {
        Some(plan) => {
            let path = plan.canonicalize().ok()?;
            let hash = Sha256::digest(path.as_os_str().as_encoded_bytes());
            hash.iter().take(8).map(|byte| format!("{byte:02x}")).collect()
        }
        None => "new-plan".to_owned(),
    };
    Some(state_folder()?.join("unsaved").join(name).with_extension("toml"))
}

/// Keeps the text of a plan.
pub fn keep(plan: Option<&Path>, text: &str) -> io::Result<()> {
    let path = path(plan).ok_or(io::ErrorKind::NotFound)?;
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    file::save(&path, text)
}

/// The text that was kept of a plan.
pub fn kept(plan: Option<&Path>) -> Option<String> {
    fs::read_to_string(path(plan)?).ok()
}

/// Drops what was kept of a plan: it is saved now, or given up.
pub fn drop(plan: Option<&Path>) {
    // Where there is no such file nothing is left to do.
    let _ = path(plan).map(fs::remove_file);
}
