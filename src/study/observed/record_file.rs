//! The record file beside a plan: `rows.seen.json` for `rows.toml`. It holds the observations of earlier shots from the terminal, and goes
//! where the plan goes.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, ErrorKind};
use std::iter::zip;
use std::path::{Path, PathBuf};

use super::ObservationRecord;
use crate::file::{self, Stamp, stamp};
use crate::sorting::{sort, sorted};
use crate::study::Case;

/// Path of the record file of a plan.
pub fn path(plan: &Path) -> PathBuf {
    plan.canonicalize().unwrap_or_else(|_| plan.to_owned()).with_extension("seen.json")
}

/// The record beside a plan; empty if there is no file, or its name would be too long to exist.
pub fn read(plan: &Path) -> ObservationRecord {
    read_file(&path(plan))
}

fn read_file(path: &Path) -> ObservationRecord {
    match fs::read_to_string(path) {
        Ok(text) => parse(path, &text),
        Err(_) if path.is_symlink() => {
            ObservationRecord::unreadable(path, "it is a link to a file that cannot be read")
        }
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::InvalidFilename) => {
            ObservationRecord::default()
        }
        Err(error) => ObservationRecord::unreadable(path, &error.to_string()),
    }
}

/// The record file of a plan, and the record of all files about it: the plan's own file, files in its folder that have lost their plan, and
/// files of copies of this plan. A plan that was renamed or copied without its file is on HOLD, whatever its new file says. The HOLD ends
/// once the old file is renamed, copied or moved away, too.
pub fn find(plan: &Path) -> (PathBuf, ObservationRecord) {
    let (own, mut record) = (path(plan), read(plan));
    let Beside { holding, other_blasts } = beside(plan, &record);
    let first = holding.first().map(|(file, _)| file.clone());
    for (file, reason) in holding {
        record.join(ObservationRecord::unreadable(&file, &reason));
    }
    let tells = first.filter(|_| !own.exists() && !own.is_symlink()).unwrap_or(own);
    (tells, record.with_other_blasts(other_blasts))
}

/// Other record files in the plan's folder with observations that the plan's own record lacks.
#[derive(Debug, Default, PartialEq, Eq)]
struct Beside {
    /// Files that put the plan on HOLD, each with the reason.
    holding: Vec<(PathBuf, String)>,
    /// Names of files about other blasts.
    other_blasts: Vec<String>,
}

/// Finds the record files in the plan's folder with observations that `record` lacks.
fn beside(plan: &Path, record: &ObservationRecord) -> Beside {
    let own = path(plan);
    let own_name = own.file_name().unwrap_or_default().to_string_lossy();
    let mut beside = Beside::default();
    let InFolder { of_plans, copies } = InFolder::of(&own, plan);
    for file in copies {
        if !read_file(&file).is_within(record) {
            let reason =
                "by its name it is no plan's: rename it as its plan, with .seen.json behind".to_owned();
            beside.holding.push((file, reason));
        }
    }
    for (file, of) in of_plans {
        let Some(of) = of else {
            let reason = "there is no plan of this name: was the plan renamed?".to_owned();
            beside.holding.push((file, reason));
            continue;
        };
        if read(&of).is_within(record) {
            continue;
        }
        let reason = match is_copy(&of, plan) {
            Some(false) => {
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                beside.other_blasts.push(name.into_owned());
                continue;
            }
            Some(true) => {
                format!("its plan has the same shelter and blast rows: copy it as {own_name}, so that it is compared")
            }
            None => {
                "its plan cannot be read, and may be a copy of this one: mend it, or move it away with this file"
                    .to_owned()
            }
        };
        beside.holding.push((file, reason));
    }
    beside
}

/// Observation records in the folder of `own`, without `own` itself.
struct InFolder {
    /// Files named after a plan, sorted, each with its plan if it exists: a file with the ending of the given plan, or else with the usual
    /// ending.
    of_plans: Vec<(PathBuf, Option<PathBuf>)>,
    /// Copies with the names that systems and people give them: `rows.seen (1).json`, `rows.seen.json.bak`.
    copies: Vec<PathBuf>,
}

impl InFolder {
    fn of(own: &Path, plan: &Path) -> Self {
        let ending = plan.extension().unwrap_or_default();
        let entries =
            own.parent().and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
        let files = entries.map(|entry| entry.path()).filter(|file| file != own);
        let (mut of_plans, mut copies) = (Vec::new(), Vec::new());
        for file in files {
            let without_json = file.with_extension("");
            let endings = [file.extension(), without_json.extension()];
            if endings == ["json", "seen"].map(|ending| Some(OsStr::new(ending))) {
                let plans = [ending, OsStr::new("toml")].map(|ending| without_json.with_extension(ending));
                let of = plans.into_iter().find(|plan| plan.exists());
                of_plans.push((file, of));
            } else if is_name_of_copy(&file) && file.is_file() {
                copies.push(file);
            }
        }
        sort(&mut of_plans);
        sort(&mut copies);
        Self { of_plans, copies }
    }
}

fn is_name_of_copy(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    name.contains(".seen") && name.contains(".json")
}

/// The stamps of all files that decide the record of a plan: the plan, its record file, and the other record files with their plans.
fn stamps(plan: &Path) -> Vec<Option<Stamp>> {
    let own = path(plan);
    let InFolder { of_plans, copies } = InFolder::of(&own, plan);
    let others = of_plans.into_iter().flat_map(|(file, of)| [Some(file), of]).flatten().chain(copies);
    [plan.to_owned(), own].into_iter().chain(others).map(|file| stamp(&file)).collect()
}

/// Whether two plans have the same shelter and blast rows, so that observations under one hold for both. Anything else may differ. `None`
/// if the first plan cannot be read.
fn is_copy(one: &Path, other: &Path) -> Option<bool> {
    // Reading a pipe would wait for a writer.
    let load = |path: &Path| path.is_file().then(|| Case::load(path).ok())?;
    let one = load(one)?;
    Some(load(other).is_some_and(|other| is_same_site(&one, &other)))
}

/// Whether the tires of two plans have nearly the same places and masses, the same cables, and the same blast rows. Ropes, slack, ground
/// and launches may differ, because a film corrects them. Names may differ, too.
fn is_same_site(one: &Case, other: &Case) -> bool {
    let near = |a: f64, b: f64, apart: f64| (a - b).abs() <= NEARLY * a.abs().max(b.abs()) + apart;
    // The tires of each row, without regard to the order of the rows.
    let launched = |case: &Case| {
        let firings = case.shots.first().map_or(&[][..], |shot| &shot.firings);
        let of_row = |row: usize| {
            let firings = firings.iter().filter(move |firing| firing.row == row);
            sorted(firings.map(|firing| firing.tire))
        };
        sorted((0..case.plan.blast_rows.len()).map(of_row))
    };
    let [a, b] = [one.scene(), other.scene()];
    a.tire_count() == b.tire_count()
        && a.cables.len() == b.cables.len()
        && zip(&a.mass, &b.mass).all(|(a, b)| near(*a, *b, 0.0))
        && zip(&a.position, &b.position).all(|(a, b)| (0..2).all(|c| near(a[c], b[c], NEAR_M)))
        && zip(&a.cables, &b.cables).all(|(a, b)| a.ends == b.ends)
        && launched(one) == launched(other)
}

/// Largest relative difference between numbers of one site. Another kind of tire or another pattern differs by more.
const NEARLY: f64 = 0.05;
/// Largest additional difference between places of one site [m].
const NEAR_M: f64 = 0.05;

/// Reads the text of a record file.
pub fn parse(path: &Path, text: &str) -> ObservationRecord {
    serde_json::from_str(text).unwrap_or_else(|error| ObservationRecord::unreadable(path, &error.to_string()))
}

/// Writes the record into the file beside a plan.
pub fn save(plan: &Path, record: &ObservationRecord) -> io::Result<()> {
    file::save(&path(plan), &(serde_json::to_string_pretty(record)? + "\n"))
}

/// The record file of a session's plan as the session knows it, and the files that put the plan on HOLD.
#[derive(Debug, Default)]
pub struct RecordFile {
    /// The record when the session last read or wrote the file.
    held: ObservationRecord,
    /// The other record files at that time.
    beside: Beside,
    /// The stamps of files and plans at the last look.
    stamps: Vec<Option<Stamp>>,
}

impl RecordFile {
    /// The new record, if another program has written the file since the last look, or a file that puts the plan on HOLD has come or gone;
    /// `None` otherwise.
    pub fn changed(&mut self, plan: &Path) -> Option<ObservationRecord> {
        let now = stamps(plan);
        if std::mem::replace(&mut self.stamps, now.clone()) == now {
            return None;
        }
        let there = read(plan);
        let beside = beside(plan, &there);
        let is_news = there != self.held || beside != self.beside;
        (self.held, self.beside) = (there, beside);
        is_news.then(|| find(plan).1)
    }

    /// Writes the record. Changes that another program has made to the file stay in it, and [`changed`](Self::changed) will report them. A
    /// file that cannot be read is not touched.
    pub fn write(&mut self, plan: &Path, record: &ObservationRecord) -> io::Result<()> {
        let there = read(plan);
        if there == *record {
            return Ok(());
        }
        if there.has_unreadable() {
            return Err(ErrorKind::InvalidData.into());
        }
        if there == self.held {
            save(plan, record)?;
            self.held.clone_from(record);
            return Ok(());
        }
        let mut all = record.clone();
        all.join(there);
        save(plan, &all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Case;

    /// The record is written beside the plan, but never over a file that cannot be read. Otherwise its observations and their HOLD would be
    /// lost.
    #[test]
    fn a_file_that_cannot_be_read_is_not_written_over() {
        let folder = tempfile::tempdir().expect("a folder");
        let plan = folder.path().join("rows.toml");
        fs::write(&plan, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        let (case, mut record) = (Case::load(&plan).expect("a plan"), ObservationRecord::default());
        assert_eq!(record.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        let (file, mut session) = (path(&plan), RecordFile::default());
        fs::write(&file, "{").expect("written");
        assert!(session.write(&plan, &record).is_err());
        assert!(fs::read_to_string(&file).is_ok_and(|text| text == "{"));
        fs::remove_file(&file).and_then(|()| fs::create_dir(&file)).expect("made");
        assert!(
            read(&plan).has_unreadable() && session.write(&plan, &record).is_err(),
            "a folder in its place"
        );
        fs::remove_dir(&file).expect("removed");
        assert!(session.write(&plan, &record).is_ok());
        assert_eq!(read(&plan), record);
    }

    /// Two sessions with one plan keep the observations of both.
    #[test]
    fn two_sessions_lose_nothing_of_each_other() {
        let folder = tempfile::tempdir().expect("a folder");
        let plan = folder.path().join("rows.toml");
        fs::write(&plan, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        let case = Case::load(&plan).expect("a plan");
        for line in ["3:1 1.95 0.05", "3:2 1.90 0.05"] {
            let mut record = ObservationRecord::default();
            assert_eq!(record.add_line(&case, 2, line), Ok(()));
            assert!(RecordFile::default().write(&plan, &record).is_ok());
        }
        assert_eq!(read(&plan).lines(&case.plan).len(), 2);
    }

    /// A renamed plan stays on HOLD because of its old record. A file beside its own plan does not affect another plan.
    #[test]
    fn a_file_that_has_lost_its_plan_is_found_by_the_others() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let [rows, renamed] = ["rows.toml", "renamed.toml"].map(path);
        for file in [&rows, &path("rows.seen.json"), &renamed] {
            fs::write(file, "{\"typed\":[],\"files\":[]}").expect("written");
        }
        assert!(find(&renamed).1.is_nothing() && find(&rows).0.ends_with("rows.seen.json"));
        fs::remove_file(&rows).expect("removed");
        let (lone, record) = find(&renamed);
        assert!(lone.ends_with("rows.seen.json") && record.has_unreadable());
        // Observations under the new name do not end the HOLD. Renaming the old file does.
        fs::copy(path("rows.seen.json"), path("renamed.seen.json")).expect("copied");
        assert!(find(&renamed).1.has_unreadable());
        let mut session = RecordFile::default();
        assert!(session.changed(&renamed).is_some_and(|record| record.has_unreadable()));
        assert!(session.changed(&renamed).is_none(), "the file says what the session knows");
        fs::write(path("renamed.seen.json"), "{\"typed\":[\"a row\"],\"files\":[]}").expect("written");
        let record = RecordFile::default().changed(&renamed).expect("news");
        assert!(record.has_typed() && record.has_unreadable(), "nor does what another session tells");
        fs::rename(path("rows.seen.json"), path("renamed.seen.json")).expect("renamed");
        assert!(find(&renamed).1.is_nothing());
    }

    /// A copy of a plan is on HOLD because of the record under the first name. Another site is not, and neither is a copy that holds the
    /// whole record.
    #[test]
    fn what_was_seen_under_a_plan_holds_for_its_copies() {
        let folder = tempfile::tempdir().expect("a folder");
        let path_of = |name: &str| folder.path().join(name);
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let [rows, copied, elsewhere] = ["rows.toml", "copied.toml", "elsewhere.toml"].map(path_of);
        fs::write(&rows, text).expect("written");
        fs::write(&copied, text.replace("interval_ms = 42", "interval_ms = 43")).expect("written");
        fs::write(&elsewhere, text.replace("mass_kg = 280", "mass_kg = 300")).expect("written");
        let case = Case::load(&rows).expect("a plan");
        let mut record = ObservationRecord::default();
        assert_eq!(record.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        save(&rows, &record).expect("written");
        let (tells, found) = find(&copied);
        assert!(tells.ends_with("rows.seen.json") && found.has_unreadable(), "a session begins with it");
        let why = found.read(&case).expect_err("a file that holds the plan");
        assert!(why.contains("rows.seen.json: ") && why.contains("copy it as copied.seen.json"), "{why}");
        assert!(find(&elsewhere).1.is_nothing(), "what was seen under other tires");
        // Another label does not free a copy from its film. Neither do differences that no film can show.
        for (own, other, is_free) in [
            ("\"1\"", "\"A\"", false),
            ("mass_kg = 280", "mass_kg = 281", false),
            ("spacing_m = 2.6", "spacing_m = 2.601", false),
            ("spacing_m = 2.6", "spacing_m = 2.8", true),
            ("under_row = 1", "under_row = 5", true),
        ] {
            assert!(text.contains(own), "{own}");
            fs::write(&elsewhere, text.replace(own, other)).expect("written");
            let found = find(&elsewhere).1;
            assert_eq!(found.is_nothing(), is_free, "{other}");
            let beside: &[&str] = if is_free { &["rows.seen.json"] } else { &[] };
            assert_eq!(found.other_blasts(), beside, "{other}: told of another blast, it is asked about");
        }
        let [first, last] = ["under_row = 1", "under_row = 3"];
        let turned = text.replace(first, "").replace(last, first).replacen(
            "\n\nlaunch",
            &format!("\n{last}\nlaunch"),
            1,
        );
        assert!(
            turned != text
                && Case::new(crate::plan::Plan::parse("", &turned).expect("a plan")).shots.len() > 1
        );
        fs::write(&elsewhere, turned).expect("written");
        assert!(find(&elsewhere).1.has_unreadable(), "the rows in another order");
        assert!(!find(&rows).1.has_unreadable(), "its own file");
        save(&copied, &ObservationRecord::default()).expect("written");
        assert!(find(&copied).1.has_unreadable(), "a file of its own that lacks it does not set it free");
        fs::copy(path(&rows), path(&copied)).expect("copied");
        assert_eq!(find(&copied).1, record);
    }

    /// A copy named by a system puts its plan on HOLD. The HOLD ends once the copy has a plan's name, or the plan's own file holds the same
    /// record.
    #[test]
    fn a_copy_that_a_system_named_is_not_overlooked() {
        let folder = tempfile::tempdir().expect("a folder");
        let rows = folder.path().join("rows (1).toml");
        fs::write(&rows, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        let case = Case::load(&rows).expect("a plan");
        let mut record = ObservationRecord::default();
        assert_eq!(record.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        for name in [
            "rows.seen (1).json",
            "rows.seen - Kopie.json",
            "rows.seen.json.bak",
            "ROWS.SEEN(2).JSON",
            "ROWS.SEEN.JSON",
        ] {
            let copy = folder.path().join(name);
            save(&rows, &record).expect("written");
            fs::rename(path(&rows), &copy).expect("renamed");
            let mut session = RecordFile::default();
            assert!(session.changed(&rows).is_some_and(|record| record.has_unreadable()), "{name}");
            save(&rows, &record).expect("written");
            assert!(!find(&rows).1.has_unreadable(), "{name}: its own file says as much");
            fs::remove_file(path(&rows)).and_then(|()| fs::remove_file(copy)).expect("removed");
        }
    }

    /// The target of a link may be on a missing disk. It was not read, so the program cannot know that there are no observations.
    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_nowhere_holds_its_plan() {
        let folder = tempfile::tempdir().expect("a folder");
        let rows = folder.path().join("rows.toml");
        fs::write(&rows, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        std::os::unix::fs::symlink(folder.path().join("away.seen.json"), path(&rows)).expect("a link");
        let (tells, record) = find(&rows);
        assert!(record.has_unreadable() && tells.ends_with("rows.seen.json"));
    }

    /// A plan that was fitted to its films, or is being edited, keeps an earlier copy on HOLD.
    #[test]
    fn a_fitted_or_broken_plan_holds_its_copies() {
        let folder = tempfile::tempdir().expect("a folder");
        let [rows, copied] = ["rows.toml", "copied.toml"].map(|name| folder.path().join(name));
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        fs::write(&copied, text).expect("written");
        fs::write(path(&rows), "{\"typed\":[\"a row\"],\"files\":[]}").expect("written");
        let fitted = crate::plan::edit::with_launches(text, 1.1).expect("TOML");
        for text in [fitted.as_str(), "[layout"] {
            fs::write(&rows, text).expect("written");
            assert!(find(&copied).1.has_unreadable(), "{text}");
        }
        let rope = crate::ropes::catalogue().find("GOST 2688-80 14 1960").expect("a rope");
        let fitted_stiffness =
            format!("axial_stiffness_kn = 5000\nbreaking_force_kn = {}", rope.breaking_force_kn);
        for [own, other] in [
            ["rope = \"GOST 2688-80 14 1960\"", &fitted_stiffness],
            ["slack_percent = 2", "slack_percent = 7"],
            ["slack_percent = 2", "slack_percent = 2\ndamping_percent = 3"],
            ["slack_percent = 2", "slack_percent = 2\nend_stiffness_kn_m = 150"],
            ["friction = 0.5 ", "friction = 0.31 "],
        ] {
            fs::write(&rows, text.replacen(own, other, 1)).expect("written");
            let [one, two] = [&rows, &copied].map(|path| crate::plan::Plan::load(path).expect("a plan"));
            assert!(one != two && find(&copied).1.has_unreadable(), "{other}");
        }
    }

    /// A record that another session writes, or that appears beside the plan, puts an open session on HOLD.
    #[test]
    fn an_open_session_is_told_what_is_seen_under_a_copy() {
        let folder = tempfile::tempdir().expect("a folder");
        let [rows, copied] = ["rows.toml", "copied.toml"].map(|name| folder.path().join(name));
        for plan in [&rows, &copied] {
            fs::write(plan, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        }
        let mut session = RecordFile::default();
        assert!(session.changed(&copied).is_none());
        fs::write(path(&rows), "{\"typed\":[\"a row\"],\"files\":[]}").expect("written");
        assert!(session.changed(&copied).is_some_and(|record| record.has_unreadable()));
        assert!(session.changed(&copied).is_none(), "once");
        fs::remove_file(path(&rows)).expect("removed");
        assert!(session.changed(&copied).is_some_and(|record| record.is_nothing()), "moved away");
    }

    /// Opening a pipe waits for a writer.
    #[cfg(unix)]
    #[test]
    fn a_pipe_is_no_copy_and_is_not_waited_for() {
        let folder = tempfile::tempdir().expect("a folder");
        let [rows, pipe] = ["rows.toml", "pipe.toml"].map(|name| folder.path().join(name));
        fs::write(&rows, include_str!("../../../tests/fixtures/amur-three-rows.toml")).expect("written");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().expect("it runs").success());
        let (sender, answer) = std::sync::mpsc::channel();
        std::thread::spawn(move || sender.send(is_copy(&rows, &pipe)));
        assert_eq!(answer.recv_timeout(std::time::Duration::from_secs(60)), Ok(Some(false)));
    }
}
