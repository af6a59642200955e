//! What the plan's file does not hold, edits and what was seen of earlier shots: kept a second after it is told, and back at the next
//! start, however the program ended. Edits are kept in a file of the program's own; what was seen beside the plan, so that it goes
//! where the plan goes, or with the edits where nothing can be written there.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chrono::{DateTime, Local};
use etcetera::{BaseStrategy, choose_base_strategy};

use crate::file::{self, checksum};
use crate::study::observed::ObservationRecord;
use crate::study::observed::record_file::{self, RecordFile};

/// Where the program keeps what it remembers between sessions.
pub fn state_folder() -> Option<PathBuf> {
    if cfg!(test) {
        // No test touches what whoever runs it keeps.
        return Some(std::env::temp_dir().join("shelter-tests"));
    }
    let folders = choose_base_strategy().ok()?;
    Some(folders.state_dir().unwrap_or_else(|| folders.data_dir()).join("shelter"))
}

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
    pub record: ObservationRecord,
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
    let (path, record) = record_of(plan, kept.as_ref());
    kept.or_else(|| {
        let text = fs::read_to_string(plan).ok().filter(|_| !record.is_nothing())?;
        let time = time_of(&path)?;
        Some(Recovered { before: checksum(&text), text, record: ObservationRecord::default(), time })
    })
    .map(|kept| Recovered { record, ..kept })
}

/// What was told of earlier shots of a plan.
pub fn find_record(plan: &Path) -> ObservationRecord {
    record_of(plan, find_edits(Some(plan)).as_ref()).1
}

/// What was told of earlier shots, and the file beside the plan that tells it: with what could not be written there.
fn record_of(plan: &Path, kept: Option<&Recovered>) -> (PathBuf, ObservationRecord) {
    let (path, mut record) = record_file::find(plan);
    record.join(kept.map(|kept| kept.record.clone()).unwrap_or_default());
    (path, record)
}

/// What was kept of a plan in the file of the program.
fn find_edits(plan: Option<&Path>) -> Option<Recovered> {
    let path = path(plan)?;
    // What was seen may stand in a file that cannot be read.
    let damaged = |reason: &str| {
        let text = fs::read_to_string(plan?).ok()?;
        let (record, before) = (ObservationRecord::unreadable(&path, reason), checksum(&text));
        Some(Recovered { text, record, time: time_of(&path)?, before })
    };
    let kept = match fs::read_to_string(&path) {
        Ok(kept) => kept,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(error) => return damaged(&error.to_string()),
    };
    let Some((head, text)) = kept.strip_prefix("# ").and_then(|kept| kept.split_once('\n')) else {
        return damaged("it is damaged");
    };
    let (before, record) = head.split_once(' ').unwrap_or((head, ""));
    let record = match record {
        "" => ObservationRecord::default(),
        record => record_file::parse(&path, record),
    };
    Some(Recovered { text: text.to_owned(), record, time: time_of(&path)?, before: before.to_owned() })
}

/// Drops what was kept of a plan: it is saved now, or given up. What was seen and nobody can read is left to whoever can mend it.
pub fn forget(plan: Option<&Path>) {
    if !keeps_unreadable(plan) {
        // Where there is no such file nothing is left to do.
        let _ = path(plan).map(fs::remove_file);
    }
}

/// Whether the file of the program holds something that was seen, or may do, and cannot be read.
fn keeps_unreadable(plan: Option<&Path>) -> bool {
    find_edits(plan).is_some_and(|kept| kept.record.has_unreadable())
}

/// What is kept of a session.
#[derive(Debug)]
struct Kept {
    /// The text of the plan.
    text: String,
    /// Whether the plan's file says something else.
    has_edits: bool,
    /// What was seen of earlier shots.
    record: ObservationRecord,
    /// Whether it lies in the file of the program, not all of it beside the plan.
    is_in_own_file: bool,
}

/// Keeps what a session has in no file.
#[derive(Debug, Default)]
pub struct Keeper {
    /// What is kept, as far as this session wrote it or took it from there.
    kept: Option<Kept>,
    /// When the session was first seen to have something else.
    other_since: Option<Instant>,
    /// The file beside the plan.
    pub record_file: RecordFile,
}

impl Keeper {
    /// The keeper of a session of a plan that begins with `text` and has `told`, taken from `found` where they are the same.
    pub fn new(
        plan: Option<&Path>,
        found: Option<Recovered>,
        [saved, text]: [&str; 2],
        record: &ObservationRecord,
    ) -> Self {
        let kept = found.filter(|found| found.text == text && found.record == *record);
        let kept = kept.map(|Recovered { text, record, .. }| Kept {
            has_edits: text != saved,
            text,
            record,
            is_in_own_file: find_edits(plan).is_some(),
        });
        let mut keeper = Self { kept, ..Self::default() };
        // What is found there now is in `found` already.
        plan.and_then(|plan| keeper.record_file.changed(plan));
        keeper
    }

    /// Drops what is kept, as far as it is of this session: another one may be at the same plan.
    pub fn forget(&mut self, plan: Option<&Path>) {
        if self.kept.take().is_some_and(|kept| kept.is_in_own_file) {
            forget(plan);
        }
    }

    /// Keeps `text` and what was `told` once they have differed from what is kept for `pause`; drops the edits that are kept where the
    /// file of the plan holds `text`, as `saved`.
    pub fn keep_after(
        &mut self,
        pause: Duration,
        plan: Option<&Path>,
        [saved, text]: [&str; 2],
        record: &ObservationRecord,
    ) -> io::Result<()> {
        let has_edits = text != saved;
        let is_kept =
            |kept: &Kept| kept.text == text && kept.has_edits == has_edits && kept.record == *record;
        if text == saved && record.is_nothing() {
            self.other_since = None;
            self.forget(plan);
        } else if self.kept.as_ref().is_some_and(is_kept) {
            self.other_since = None;
        } else if self.other_since.get_or_insert_with(Instant::now).elapsed() >= pause {
            self.other_since = None;
            if plan.is_none() && self.kept.is_none() && find_edits(None).is_some() {
                return Err(io::Error::other(
                    "another new plan is kept, not saved: save this one, or that one",
                ));
            }
            let readable = record.readable();
            let is_beside = readable.is_nothing()
                || plan.is_some_and(|plan| self.record_file.write(plan, &readable).is_ok());
            match (is_beside, text == saved) {
                (true, true) => self.forget(plan),
                (true, false) => keep_edits(plan, [saved, text], "")?,
                (false, _) => keep_edits(plan, [saved, text], &serde_json::to_string(&readable)?)?,
            }
            let is_in_own_file = has_edits || !is_beside;
            self.kept =
                Some(Kept { text: text.to_owned(), has_edits, record: record.clone(), is_in_own_file });
        }
        Ok(())
    }
}

/// Writes edits into the file of the program, with what was seen and cannot be kept beside the plan.
fn keep_edits(plan: Option<&Path>, [saved, text]: [&str; 2], seen: &str) -> io::Result<()> {
    if keeps_unreadable(plan) {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let path = path(plan).ok_or(io::ErrorKind::NotFound)?;
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    file::save(&path, &format!("# {} {seen}\n{text}", checksum(saved)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Case;

    const SAVED: &str = include_str!("../tests/fixtures/amur-three-rows.toml");
    const AT_ONCE: Duration = Duration::ZERO;

    /// A plan in a folder of its own, and one line and two that were seen.
    fn record() -> (tempfile::TempDir, PathBuf, [ObservationRecord; 2]) {
        let folder = tempfile::tempdir().expect("a folder");
        let plan = folder.path().join("rows.toml");
        fs::write(&plan, SAVED).expect("written");
        let case = Case::load(&plan).expect("a plan");
        let mut one = ObservationRecord::default();
        assert_eq!(one.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        let mut two = one.clone();
        assert_eq!(two.add_line(&case, 2, "3:2 1.90 0.05"), Ok(()));
        (folder, plan, [one, two])
    }

    fn keep(keeper: &mut Keeper, plan: &Path, text: &str, record: &ObservationRecord) {
        assert!(keeper.keep_after(AT_ONCE, Some(plan), [SAVED, text], record).is_ok());
    }

    #[test]
    fn what_was_told_last_is_kept_beside_the_plan_with_edits_and_without() {
        let (_folder, plan, [one, two]) = record();
        let mut keeper = Keeper::new(Some(&plan), None, [SAVED, SAVED], &ObservationRecord::default());
        assert_eq!(find(Some(&plan)), None);
        keep(&mut keeper, &plan, SAVED, &one);
        let found = find(Some(&plan)).expect("what was told");
        assert_eq!((&found.record, found.text.as_str(), found.has_edits_of(SAVED)), (&one, SAVED, false));
        for (text, record) in [(SAVED, &two), ("edits", &two), ("more", &two), ("more", &one)] {
            keep(&mut keeper, &plan, text, record);
            let found = find(Some(&plan)).expect("what was told");
            assert_eq!((&found.record, found.text.as_str()), (record, text));
            assert_eq!((found.has_edits_of(SAVED), found.are_of(SAVED)), (text != SAVED, true));
            assert_eq!([record_file::read(&plan), find_record(&plan)], [record.clone(), record.clone()]);
        }
        // Another program saves something else, or the same: then nothing of it is an edit.
        let found = find(Some(&plan)).expect("edits");
        assert!(found.has_edits_of("other") && !found.are_of("other") && !found.has_edits_of("more"));
        assert!(keeper.keep_after(AT_ONCE, Some(&plan), ["more"; 2], &one).is_ok());
        assert_eq!(find_edits(Some(&plan)), None, "they are saved");
        assert!(!Recovered { text: SAVED.to_owned(), ..found }.has_edits_of("other"));
    }

    /// What could not be written beside the plan is kept with the edits, and told with what is there.
    #[test]
    fn what_cannot_be_told_beside_the_plan_is_kept_with_its_edits() {
        let (_folder, plan, [one, _]) = record();
        let beside = record_file::path(&plan);
        fs::write(&beside, "{").expect("written");
        keep(&mut Keeper::default(), &plan, SAVED, &one);
        fs::remove_file(&beside).expect("removed");
        assert_eq!(find_record(&plan), one);
        forget(Some(&plan));
        assert_eq!(find(Some(&plan)), None);
    }

    /// Edits that a session takes over are dropped once the plan is as it was; those of another session, which it shows to nobody, stay.
    #[test]
    fn a_session_drops_only_the_edits_that_it_took_over() {
        let (_folder, plan, [one, _]) = record();
        let nothing = ObservationRecord::default();
        for (text, record, is_dropped) in
            [("edits", &nothing, true), (SAVED, &nothing, false), ("edits", &one, false)]
        {
            keep(&mut Keeper::default(), &plan, "edits", &nothing);
            let mut keeper = Keeper::new(Some(&plan), find(Some(&plan)), [SAVED, text], record);
            keep(&mut keeper, &plan, SAVED, &nothing);
            assert_eq!(find_edits(Some(&plan)).is_none(), is_dropped, "{text} {record:?}");
            forget(Some(&plan));
        }
        // What a session took over is kept already: nothing is written anew.
        keep(&mut Keeper::default(), &plan, "edits", &nothing);
        let mut keeper = Keeper::new(Some(&plan), find(Some(&plan)), [SAVED, "edits"], &nothing);
        forget(Some(&plan));
        keep(&mut keeper, &plan, "edits", &nothing);
        assert_eq!(find_edits(Some(&plan)), None);
    }

    /// A session that kept nothing leaves what another one keeps, when it ends and when it tells what was seen. Nor does a plan without a
    /// file take the place of another one.
    #[test]
    fn a_session_leaves_what_another_one_keeps() {
        let (_folder, plan, [one, two]) = record();
        let nothing = ObservationRecord::default();
        keep(&mut Keeper::default(), &plan, "edits", &nothing);
        let mut other = Keeper::new(Some(&plan), None, [SAVED, SAVED], &nothing);
        for record in [&one, &two, &one] {
            keep(&mut other, &plan, SAVED, record);
            assert!(find_edits(Some(&plan)).is_some_and(|kept| kept.text == "edits"));
        }
        Keeper::new(Some(&plan), None, [SAVED, SAVED], &nothing).forget(Some(&plan));
        assert!(find_edits(Some(&plan)).is_some());
        forget(Some(&plan));

        let mut new = Keeper::default();
        assert!(new.keep_after(AT_ONCE, None, ["", "new"], &nothing).is_ok());
        assert!(Keeper::default().keep_after(AT_ONCE, None, ["", "an example"], &nothing).is_err());
        assert!(find(None).is_some_and(|kept| kept.text == "new"));
        assert!(new.keep_after(AT_ONCE, None, ["", "newer"], &nothing).is_ok());
        assert!(find(None).is_some_and(|kept| kept.text == "newer"));
        new.forget(None);
        assert_eq!(find(None), None);
    }

    /// A file that is damaged, or that is none, may hold what was seen: it is on hold, and neither edits nor a plan that was saved take it
    /// away.
    #[test]
    fn a_file_of_edits_that_cannot_be_read_stays_and_holds_the_plan() {
        let (_folder, plan, _) = record();
        let file = path(Some(&plan)).expect("a file");
        for make in [|file: &Path| fs::write(file, "damaged"), |file: &Path| fs::create_dir(file)] {
            fs::create_dir_all(file.parent().expect("a folder")).and_then(|()| make(&file)).expect("written");
            forget(Some(&plan));
            let mut keeper = Keeper::default();
            assert!(
                keeper
                    .keep_after(AT_ONCE, Some(&plan), [SAVED, "edits"], &ObservationRecord::default())
                    .is_err()
            );
            let found = find(Some(&plan)).expect("what cannot be read");
            assert!(found.record.has_unreadable() && found.text == SAVED && file.exists());
            assert!(find_record(&plan).has_unreadable());
            let _ = fs::remove_file(&file).or_else(|_| fs::remove_dir(&file));
        }
    }
}
