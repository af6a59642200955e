//! Keeps what the plan's file does not hold: unsaved edits, and the record of earlier shots. Both are kept a second after they
//! change, and are back at the next start, however the program ended.
//!
//! Edits lie in a file of the program's own. The record lies beside the plan, so that it goes where the plan goes. If nothing can
//! be written there, the record lies with the edits.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use chrono::{DateTime, Local};
use etcetera::{BaseStrategy, choose_base_strategy};

use crate::file::{self, checksum};
use crate::study::observed::ObservationRecord;
use crate::study::observed::record_file::{self, RecordFile};

/// Folder in which the program keeps data between sessions.
pub fn state_folder() -> Option<PathBuf> {
    if cfg!(test) {
        // A test must not touch the data of the person who runs it.
        return Some(std::env::temp_dir().join("shelter-tests"));
    }
    let folders = choose_base_strategy().ok()?;
    Some(folders.state_dir().unwrap_or_else(|| folders.data_dir()).join("shelter"))
}

/// File of the program with the edits of a plan; of a plan without a file if `plan` is `None`. Its first line is a comment with the
/// checksum of the text of the plan's file, and with the record as JSON. Below that line stands the text with the edits.
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

/// Edits and record that were kept of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// The text of the plan, with the edits.
    pub text: String,
    /// Observations of earlier shots.
    pub record: ObservationRecord,
    /// Time at which they were kept, in words.
    pub time: String,
    /// Checksum of the text of the plan's file that was edited.
    before: String,
}

impl Recovered {
    /// Whether the text has edits that a file with the text `saved` does not have.
    pub fn has_edits_of(&self, saved: &str) -> bool {
        self.text != saved && self.before != checksum(&self.text)
    }

    /// Whether the edits began from the text `saved` of the file. If not, another program has changed the file since.
    pub fn are_of(&self, saved: &str) -> bool {
        self.before == checksum(saved)
    }
}

/// Time at which a file was written, in words.
fn time_of(path: &Path) -> Option<String> {
    let written = path.metadata().and_then(|data| data.modified()).ok()?;
    Some(DateTime::<Local>::from(written).format("%Y-%m-%d %H:%M").to_string())
}

/// Finds the edits and the record that were kept of a plan.
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

/// Record of earlier shots of a plan, from the file beside the plan and from the program's own file.
pub fn find_record(plan: &Path) -> ObservationRecord {
    record_of(plan, find_edits(Some(plan)).as_ref()).1
}

/// File beside the plan that holds the record, and the record. The record includes what could not be written beside the plan.
fn record_of(plan: &Path, kept: Option<&Recovered>) -> (PathBuf, ObservationRecord) {
    let (path, mut record) = record_file::find(plan);
    record.join(kept.map(|kept| kept.record.clone()).unwrap_or_default());
    (path, record)
}

/// Finds what the program's own file keeps of a plan.
fn find_edits(plan: Option<&Path>) -> Option<Recovered> {
    let path = path(plan)?;
    // A file that cannot be read may hold observations.
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

/// Drops what was kept of a plan, because the plan is saved now or given up. A file with observations that nobody can read stays,
/// so that somebody can mend it.
pub fn forget(plan: Option<&Path>) {
    if !keeps_unreadable(plan) {
        // If there is no such file, nothing is left to do.
        let _ = path(plan).map(fs::remove_file);
    }
}

/// Whether the program's own file holds, or may hold, observations that cannot be read.
fn keeps_unreadable(plan: Option<&Path>) -> bool {
    find_edits(plan).is_some_and(|kept| kept.record.has_unreadable())
}

/// Edits and record that are kept of a session.
#[derive(Debug)]
struct Kept {
    /// The text of the plan.
    text: String,
    /// Whether the text differs from the plan's file.
    has_edits: bool,
    /// Observations of earlier shots.
    record: ObservationRecord,
    /// Whether something lies in the program's own file, and not everything beside the plan.
    is_in_own_file: bool,
}

/// Keeps the edits and the record of a session, because the plan's file does not hold them.
#[derive(Debug, Default)]
pub struct Keeper {
    /// What is kept, if this session wrote it or took it over.
    kept: Option<Kept>,
    /// Time at which the session first differed from what is kept.
    other_since: Option<Instant>,
    /// File beside the plan with the record.
    pub record_file: RecordFile,
}

impl Keeper {
    /// Keeper of a session of a plan that begins with `text` and `record`. If `found` has the same text and record, the session
    /// takes it over.
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
        // `found` already has what lies beside the plan now.
        plan.and_then(|plan| keeper.record_file.changed(plan));
        keeper
    }

    /// Drops what this session kept or took over. Another session may be at the same plan.
    pub fn forget(&mut self, plan: Option<&Path>) {
        if self.kept.take().is_some_and(|kept| kept.is_in_own_file) {
            forget(plan);
        }
    }

    /// Keeps `text` and `record` once they have differed from what is kept for `pause`. If `text` equals `saved`, the text of the
    /// plan's file, drops the kept edits.
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

/// Writes edits into the program's own file, together with a record, `seen`, that cannot be kept beside the plan.
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

    /// A plan in a folder of its own, and two records: one observation, and two.
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
        // Another program saves another text, or the text with the edits. In the second case no edit is left.
        let found = find(Some(&plan)).expect("edits");
        assert!(found.has_edits_of("other") && !found.are_of("other") && !found.has_edits_of("more"));
        assert!(keeper.keep_after(AT_ONCE, Some(&plan), ["more"; 2], &one).is_ok());
        assert_eq!(find_edits(Some(&plan)), None, "they are saved");
        assert!(!Recovered { text: SAVED.to_owned(), ..found }.has_edits_of("other"));
    }

    /// A record that could not be written beside the plan is kept with the edits, and joined with the record beside the plan.
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

    /// Edits that a session takes over are dropped once the plan is as it was. Edits of another session, which this session does
    /// not show, stay.
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
        // Edits that a session took over are kept already: nothing is written anew.
        keep(&mut Keeper::default(), &plan, "edits", &nothing);
        let mut keeper = Keeper::new(Some(&plan), find(Some(&plan)), [SAVED, "edits"], &nothing);
        forget(Some(&plan));
        keep(&mut keeper, &plan, "edits", &nothing);
        assert_eq!(find_edits(Some(&plan)), None);
    }

    /// A session that kept nothing leaves what another session keeps, when it ends and when it records observations. Nor does a
    /// plan without a file replace another plan without a file.
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

    /// A damaged file, or a folder in its place, may hold observations. So the plan is on hold. Neither edits nor a saved plan
    /// remove the file.
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
