//! What the plan's file does not hold, edits and what was seen of earlier shots: kept a second after it is told, and back at the next
//! start, however the program ended. Edits are kept in a file of the program's own; what was seen beside the plan, so that it goes
//! where the plan goes, or with the edits where nothing can be written there.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chrono::{DateTime, Local};

use super::config::state_folder;
use super::watched_file::{Stamp, stamp};
use crate::file::{self, checksum};
use crate::study::observed::Observed;
use crate::study::observed_file;

/// The file with what is kept of a plan; of a plan without a file where `plan` is `None`. Its first line is a comment with the
/// checksum of the text of the plan's file and what was seen, as JSON; below it stands the text with the edits.
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

/// What was kept of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// The text of the plan, with the edits.
    pub text: String,
    /// What was seen of earlier shots.
    pub observed: Observed,
    /// When it was kept, in words.
    pub time: String,
    /// Checksum of the text of the file that was edited.
    before: String,
}

impl Recovered {
    /// Whether there are edits that a file with this text does not have.
    pub fn has_edits_of(&self, saved: &str) -> bool {
        self.text != saved && self.before != checksum(&self.text)
    }

    /// Whether the edits are of this text of the file; if not, another program has changed the file since.
    pub fn are_of(&self, saved: &str) -> bool {
        self.before == checksum(saved)
    }
}

/// When a file was written, in words.
fn time_of(path: &Path) -> Option<String> {
    let written = path.metadata().and_then(|data| data.modified()).ok()?;
    Some(DateTime::<Local>::from(written).format("%Y-%m-%d %H:%M").to_string())
}

/// What was kept of a plan.
pub fn find(plan: Option<&Path>) -> Option<Recovered> {
    let kept = find_edits(plan);
    let Some(plan) = plan else { return kept };
    let observed = seen_of(plan, kept.as_ref());
    kept.or_else(|| {
        let text = fs::read_to_string(plan).ok().filter(|_| !observed.is_nothing())?;
        let time = time_of(&observed_file::path(plan))?;
        Some(Recovered { before: checksum(&text), text, observed: Observed::default(), time })
    })
    .map(|kept| Recovered { observed, ..kept })
}

/// What was told of earlier shots of a plan.
pub fn find_seen(plan: &Path) -> Observed {
    seen_of(plan, find_edits(Some(plan)).as_ref())
}

/// What was told of earlier shots: what lies beside the plan, and what could not be written there.
fn seen_of(plan: &Path, kept: Option<&Recovered>) -> Observed {
    let mut observed = observed_file::read(plan);
    observed.join(kept.map(|kept| kept.observed.clone()).unwrap_or_default());
    observed
}

/// What was kept of a plan in the file of the program.
fn find_edits(plan: Option<&Path>) -> Option<Recovered> {
    let path = path(plan)?;
    // What was seen may stand in a file that cannot be read.
    let damaged = |reason: &str| {
        let text = fs::read_to_string(plan?).ok()?;
        let (observed, before) = (Observed::unreadable(&path, reason), checksum(&text));
        Some(Recovered { text, observed, time: time_of(&path)?, before })
    };
    let kept = match fs::read_to_string(&path) {
        Ok(kept) => kept,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(error) => return damaged(&error.to_string()),
    };
    let Some((head, text)) = kept.strip_prefix("# ").and_then(|kept| kept.split_once('\n')) else {
        return damaged("it is damaged");
    };
    let (before, observed) = head.split_once(' ').unwrap_or((head, ""));
    let observed = match observed {
        "" => Observed::default(),
        observed => observed_file::parse(&path, observed),
    };
    Some(Recovered { text: text.to_owned(), observed, time: time_of(&path)?, before: before.to_owned() })
}

/// Drops what was kept of a plan: it is saved now, or given up.
pub fn forget(plan: Option<&Path>) {
    // Where there is no such file nothing is left to do.
    let _ = path(plan).map(fs::remove_file);
}

/// Keeps what a session has in no file.
#[derive(Debug, Default)]
pub struct Keeper {
    /// The text in the file of what is kept, whether it has edits, and what was seen: as far as this session wrote it or took it from
    /// there.
    kept: Option<(String, bool, Observed)>,
    /// When the session was first seen to have something else.
    other_since: Option<Instant>,
    /// What the file beside the plan held when it was last read or written, and its stamp when it was last looked at.
    beside: (Observed, Option<Stamp>),
}

impl Keeper {
    /// The keeper of a session of a plan that begins with `text` and has `observed`, taken from `found` where they are the same.
    pub fn new(
        plan: Option<&Path>,
        found: Option<Recovered>,
        [saved, text]: [&str; 2],
        observed: &Observed,
    ) -> Self {
        let kept = found.filter(|found| found.text == text && found.observed == *observed);
        let kept = kept.map(|found| (found.text, text != saved, found.observed));
        let mut keeper = Self { kept, ..Self::default() };
        // What is found there now is in `found` already.
        plan.and_then(|plan| keeper.told_elsewhere(plan));
        keeper
    }

    /// What the file beside the plan holds, where another program has written it since it was last looked at.
    pub fn told_elsewhere(&mut self, plan: &Path) -> Option<Observed> {
        let now = stamp(&observed_file::path(plan));
        let (known, stamp) = &mut self.beside;
        if std::mem::replace(stamp, now) == now {
            return None;
        }
        let there = observed_file::read(plan);
        (there != *known).then(|| known.clone_from(&there)).map(|()| there)
    }

    /// Keeps `text` and what was `observed` once they have differed from what is kept for `pause`; drops the edits that are kept where the
    /// file of the plan holds `text`, as `saved`.
    pub fn keep_after(
        &mut self,
        pause: Duration,
        plan: Option<&Path>,
        [saved, text]: [&str; 2],
        observed: &Observed,
    ) -> io::Result<()> {
        let is_kept = |(kept, has_edits, seen): &(String, bool, Observed)| {
            kept == text && *has_edits == (text != saved) && seen == observed
        };
        if text == saved && observed.is_nothing() {
            self.other_since = None;
            if self.kept.take().is_some() {
                forget(plan);
            }
        } else if self.kept.as_ref().is_some_and(is_kept) {
            self.other_since = None;
        } else if self.other_since.get_or_insert_with(Instant::now).elapsed() >= pause {
            self.other_since = None;
            let readable = observed.readable();
            let is_beside =
                readable.is_nothing() || plan.is_some_and(|plan| self.keep_beside(plan, &readable).is_ok());
            match (is_beside, text == saved) {
                (true, true) => forget(plan),
                (true, false) => keep_edits(plan, [saved, text], "")?,
                (false, _) => keep_edits(plan, [saved, text], &serde_json::to_string(&readable)?)?,
            }
            self.kept = Some((text.to_owned(), text != saved, observed.clone()));
        }
        Ok(())
    }

    /// Writes what was seen beside the plan; what another program has written there since stays, and is still to be taken. A file that
    /// cannot be read is left to whoever can mend it.
    fn keep_beside(&mut self, plan: &Path, observed: &Observed) -> io::Result<()> {
        let there = observed_file::read(plan);
        if there == *observed {
            return Ok(());
        }
        if there.has_unreadable() {
            return Err(io::ErrorKind::InvalidData.into());
        }
        if there == self.beside.0 {
            observed_file::save(plan, observed)?;
            self.beside.0.clone_from(observed);
            return Ok(());
        }
        let mut all = observed.clone();
        all.join(there);
        observed_file::save(plan, &all)
    }
}

/// Writes edits into the file of the program, with what was seen and cannot be kept beside the plan.
fn keep_edits(plan: Option<&Path>, [saved, text]: [&str; 2], seen: &str) -> io::Result<()> {
    let path = path(plan).ok_or(io::ErrorKind::NotFound)?;
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    file::save(&path, &format!("# {} {seen}\n{text}", checksum(saved)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Case;

    /// What was told is written beside the plan, but never over a file that cannot be read: its observations would be lost, and their hold.
    #[test]
    fn a_file_that_cannot_be_read_is_not_written_over() {
        let folder = tempfile::tempdir().expect("a folder");
        let plan = folder.path().join("rows.toml");
        fs::write(&plan, include_str!("../../tests/fixtures/amur-three-rows.toml")).expect("written");
        let (case, mut observed) = (Case::load(&plan).expect("a plan"), Observed::default());
        assert_eq!(observed.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        let (seen, mut keeper) = (observed_file::path(&plan), Keeper::default());
        fs::write(&seen, "{").expect("written");
        assert!(keeper.keep_beside(&plan, &observed).is_err());
        assert!(fs::read_to_string(&seen).is_ok_and(|text| text == "{"));
        fs::remove_file(&seen).expect("removed");
        assert!(keeper.keep_beside(&plan, &observed).is_ok());
        assert_eq!(observed_file::read(&plan), observed);
    }
}
