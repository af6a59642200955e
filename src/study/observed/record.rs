//! The record of observations that the user typed or read in the terminal: typed lines and files.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::file::checksum;
use crate::plan::observations::{COLUMNS, Observations, named_twice};
use crate::plan::{DelayOption, HoleTiming, Plan, Time};
use crate::study::Case;
use crate::study::fit::observable_names;

/// Observations of earlier shots, as text. The text is read again for every plan that the screen shows.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ObservationRecord {
    /// Typed lines, as rows of a table.
    typed: Vec<String>,
    files: Vec<ObservedFile>,
    /// Firing of each observed option, by name, under the plan of that time. If the plan now fires the option at other times, the
    /// observation is of another shot. `None` if two records name the option but fire it at different times.
    #[serde(default)]
    fired: BTreeMap<String, Option<Fired>>,
    /// Observations that the user withdrew: typed lines as rows, and files by name.
    #[serde(default)]
    withdrawn: Vec<Withdrawn>,
    /// Names of other record files in the plan's folder that are about other blasts. No file stores these names: each search finds them
    /// again.
    #[serde(skip)]
    other_blasts: Vec<String>,
}

/// Firing times of an option. Options that fire alike have equal values, in whatever plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Fired {
    /// Firing times of the rows.
    rows: Vec<Time>,
    /// Firing times of the holes of each row.
    holes: HoleTiming,
}

impl Fired {
    fn of(delay: &DelayOption) -> Self {
        Self { rows: delay.timing.fire_at(), holes: delay.hole_timing }
    }
}

/// A file of observations, or typed lines that the plan was fitted to.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct ObservedFile {
    path: String,
    text: String,
    checksum: String,
}

impl ObservedFile {
    fn is_unreadable(&self) -> bool {
        self.text.is_empty()
    }
}

/// An observation that the user withdrew.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Withdrawn {
    /// The typed line, or the name of the file.
    pub what: String,
    /// Day of the withdrawal.
    pub day: String,
    /// Checksum of the line or of the file's text. If another session brings the same line or text, it is withdrawn there, too.
    mark: String,
    /// Checksum that `fitted_from` of a plan keeps of a file; `None` for a typed line.
    #[serde(default)]
    fitted: Option<String>,
    /// Whether a line about the same place and quantity was typed later. Then the withdrawn line was a typing mistake.
    #[serde(default, alias = "is_told_anew")]
    is_corrected: bool,
}

/// Name of the typed lines among the files. A further shot adds [`NEXT_SHOT`] and its number.
const TYPED: &str = "what was typed";
const NEXT_SHOT: &str = ", shot ";

/// Whether a file of this name holds typed lines.
pub fn is_typed(path: &str) -> bool {
    path.strip_prefix(TYPED).is_some_and(|rest| rest.is_empty() || rest.starts_with(NEXT_SHOT))
}

impl ObservationRecord {
    /// Whether the record holds one typed value and nothing else.
    pub fn is_one_value(&self) -> bool {
        self.typed.len() == 1 && self.files.is_empty()
    }

    /// Whether no observation counts.
    pub fn is_empty(&self) -> bool {
        self.typed.is_empty() && self.files.is_empty()
    }

    /// Whether the record holds neither an observation nor a withdrawn one. Then there is nothing to save.
    pub fn is_nothing(&self) -> bool {
        self.is_empty() && self.withdrawn.is_empty()
    }

    /// A record in place of a file that cannot be read, with the reason. No plan can be compared with it.
    pub fn unreadable(path: &Path, reason: &str) -> Self {
        let path = format!("{}: {reason}", path.display());
        Self { files: vec![ObservedFile { path, ..ObservedFile::default() }], ..Self::default() }
    }

    /// The same record, with the names of `files` beside it that are about other blasts.
    pub fn with_other_blasts(self, files: Vec<String>) -> Self {
        Self { other_blasts: files, ..self }
    }

    /// Names of other record files in the plan's folder that are about other blasts.
    pub fn other_blasts(&self) -> &[String] {
        &self.other_blasts
    }

    /// Whether the record includes a file that cannot be read.
    pub fn has_unreadable(&self) -> bool {
        self.unreadable_file().is_some()
    }

    /// The first file that cannot be read, and the reason.
    pub fn unreadable_file(&self) -> Option<&str> {
        self.files.iter().find(|file| file.is_unreadable()).map(|file| file.path.as_str())
    }

    /// The same record without files that cannot be read. These are looked up each time and never stored.
    pub fn readable(&self) -> Self {
        let files = self.files.iter().filter(|file| !file.is_unreadable()).cloned().collect();
        Self { files, ..self.clone() }
    }

    /// Whether the record holds typed lines. No file of observations holds these.
    pub fn has_typed(&self) -> bool {
        !self.typed.is_empty()
    }

    /// Whether `other` holds every observation of this record.
    pub fn is_within(&self, other: &Self) -> bool {
        self.typed.iter().all(|row| other.typed.contains(row))
            && self.files.iter().all(|file| other.files.contains(file))
    }

    /// Adds the observations of another record. What is withdrawn here stays withdrawn.
    pub fn join(&mut self, other: Self) {
        // All unreadable files have the same, empty text. So a withdrawal of one must not remove the others.
        let is_gone = |what: &str| {
            !what.is_empty() && self.withdrawn.iter().any(|gone| gone.mark == checksum(what.as_bytes()))
        };
        let typed = other.typed.into_iter().filter(|row| !self.typed.contains(row) && !is_gone(row));
        let files = other.files.into_iter().filter(|file| !self.files.contains(file) && !is_gone(&file.text));
        let (typed, files): (Vec<_>, Vec<_>) = (typed.collect(), files.collect());
        let is_known = |gone: &Withdrawn| self.withdrawn.iter().any(|known| known.mark == gone.mark);
        let withdrawn = other.withdrawn.into_iter().filter(|gone| !is_known(gone));
        let withdrawn: Vec<_> = withdrawn.collect();
        self.typed.extend(typed);
        self.files.extend(files);
        self.withdrawn.extend(withdrawn);
        for (option, firing) in other.fired {
            let known = self.fired.entry(option).or_insert_with(|| firing.clone());
            if *known != firing {
                // The two records mean two shots of one name. The plan can match only one of them, so neither counts.
                *known = None;
            }
        }
    }

    /// Whether the plan was fitted to lines typed earlier. Lines typed from now on are of another shot.
    pub fn has_closed(&self) -> bool {
        self.files.iter().any(|file| is_typed(&file.path))
    }

    /// Adds a typed line about a shot of `option`. A second value of the same place and quantity counts as another shot. Returns the
    /// mistake if the line is no observation, or was typed already.
    pub fn add_line(&mut self, case: &Case, option: usize, line: &str) -> Result<(), String> {
        let row = row(&case.plan.delays[option].name, line);
        if self.typed.contains(&row) {
            return Err(format!("NOT taken, {} was typed already", in_words(&row)));
        }
        let mut changed = self.clone();
        changed.note_fired(case, [option].into_iter());
        let mark = checksum(row.as_bytes());
        changed.withdrawn.retain(|gone| gone.mark != mark);
        // The line withdrawn just before was a typing mistake.
        if let Some(gone) = changed.withdrawn.last_mut().filter(|gone| place_of(&gone.what) == place_of(&row))
        {
            gone.is_corrected = true;
        }
        changed.typed.push(row);
        changed.read(case)?;
        *self = changed;
        Ok(())
    }

    /// The typed lines of each shot, in the order of typing. A line begins a new shot if the current one already has its place and
    /// quantity.
    fn typed_shots(&self) -> Vec<&[String]> {
        let mut begins = vec![0];
        for (at, row) in self.typed.iter().enumerate() {
            let shot = &self.typed[begins[begins.len() - 1]..at];
            if shot.iter().any(|known| place_of(known) == place_of(row)) {
                begins.push(at);
            }
        }
        begins.push(self.typed.len());
        begins.windows(2).map(|ends| &self.typed[ends[0]..ends[1]]).filter(|rows| !rows.is_empty()).collect()
    }

    /// Number of shots in the typed lines.
    pub fn typed_shot_count(&self) -> usize {
        self.typed_shots().len()
    }

    /// Adds a file in place of one of the same name. If the new file lacks an observation of the old one, the old text counts as withdrawn
    /// on this `day`. Returns the mistake if the file holds no observations of this plan.
    pub fn add_file(&mut self, case: &Case, path: &str, text: &str, day: &str) -> Result<(), String> {
        let file = parse(case, path, text)?;
        let mut changed = self.clone();
        changed.note_fired(case, options_of(&file));
        for before in changed.files.extract_if(.., |known| known.path == path) {
            let has_all = parse(case, path, &before.text).is_ok_and(|before| file.holds_all_of(&before));
            let what = format!("{path} as it was read before");
            let mark = checksum(before.text.as_bytes());
            let day = day.to_owned();
            changed.withdrawn.extend((!has_all).then_some(Withdrawn {
                what,
                day,
                mark,
                fitted: None,
                is_corrected: false,
            }));
        }
        let mark = checksum(text.as_bytes());
        changed.withdrawn.retain(|gone| gone.mark != mark);
        changed.files.push(ObservedFile {
            path: path.to_owned(),
            text: text.to_owned(),
            checksum: file.checksum,
        });
        changed.read(case)?;
        *self = changed;
        Ok(())
    }

    /// Notes how observed options fire, unless that is known already.
    fn note_fired(&mut self, case: &Case, options: impl Iterator<Item = usize>) {
        for delay in options.map(|option| &case.plan.delays[option]) {
            self.fired.entry(delay.name.clone()).or_insert_with(|| Some(Fired::of(delay)));
        }
    }

    /// Withdraws the last typed line, or the last file if there is no typed line, and notes the `day`. Returns the withdrawn observation in
    /// words.
    pub fn withdraw_last(&mut self, day: &str) -> Option<String> {
        let last = self.last();
        let slip = self.typed.last().and_then(|row| place_of(row)).map(str::to_owned);
        let taken = self.typed.pop().map(|row| (row.clone(), row, None)).or_else(|| {
            let readable = self.files.iter().rposition(|file| !file.is_unreadable())?;
            let ObservedFile { path, text, checksum } = self.files.remove(readable);
            let rows = || text.lines().skip(1).map(in_words).collect::<Vec<_>>().join(", ");
            let what = if is_typed(&path) { format!("{path}: {}", rows()) } else { path };
            Some((what, text, Some(checksum)))
        });
        let gone = |(what, text, fitted): (String, String, Option<String>)| Withdrawn {
            what,
            day: day.to_owned(),
            mark: checksum(text.as_bytes()),
            fitted,
            is_corrected: false,
        };
        // The corrected line is withdrawn. So the mistake that it corrected counts as withdrawn again.
        let is_of_slip = |gone: &Withdrawn| slip.is_some() && place_of(&gone.what) == slip.as_deref();
        if let Some(before) = self.withdrawn.iter_mut().rfind(|gone| is_of_slip(gone)) {
            before.is_corrected = false;
        }
        self.withdrawn.extend(taken.map(gone));
        if self.is_empty() {
            self.fired.clear();
        }
        last
    }

    /// Whether the plan was fitted to a withdrawn file that was neither corrected nor added again. Then the plan's launches are unknown.
    pub fn is_fitted_to_withdrawn(&self, plan: &Plan) -> bool {
        let gone = self.withdrawn.iter().filter(|gone| !gone.is_corrected);
        let counts = |fitted: &&String| self.files.iter().any(|file| file.checksum == **fitted);
        let mut fitted = gone.filter_map(|gone| gone.fitted.as_ref()).filter(|fitted| !counts(fitted));
        fitted.any(|fitted| plan.fitted_from.contains(fitted))
    }

    /// Withdrawn observations that were not corrected, in words.
    pub fn withdrawn(&self) -> Vec<Withdrawn> {
        let gone = self.withdrawn.iter().filter(|gone| !gone.is_corrected);
        gone.map(|gone| Withdrawn { what: in_words(&gone.what), ..gone.clone() }).collect()
    }

    /// The last typed line in words, or the last file if there is no typed line. Files that cannot be read are left out: the user must mend
    /// them.
    pub fn last(&self) -> Option<String> {
        let typed = self.typed.last().map(|row| in_words(row));
        typed.or_else(|| Some(self.files.iter().rfind(|file| !file.is_unreadable())?.path.clone()))
    }

    /// Turns the typed lines into files that the plan was fitted to. `files` holds the observations of these lines. Lines typed later are
    /// of another shot.
    pub fn close_typed(&mut self, files: &[Observations]) {
        let closed = self.typed_texts().into_iter().map(|(path, text)| {
            let file = files.iter().find(|file| file.path == path)?;
            Some(ObservedFile { path, text, checksum: file.checksum.clone() })
        });
        if let Some(closed) = closed.collect::<Option<Vec<_>>>() {
            self.files.extend(closed);
            self.typed.clear();
        }
    }

    /// The typed lines of each shot, as name and text of a file.
    fn typed_texts(&self) -> Vec<(String, String)> {
        let text = |rows: &[String]| [COLUMNS.join(";"), rows.join("\n")].join("\n");
        let path = |n: usize| if n == 0 { TYPED.to_owned() } else { format!("{TYPED}{NEXT_SHOT}{}", n + 1) };
        let shots = self.typed_shots().into_iter().enumerate();
        shots.map(|(n, rows)| (path(n), text(rows))).collect()
    }

    /// Reads all observations for the plan of `case`: one list for each typed shot, then one for each file. The error is the first mistake.
    pub fn read(&self, case: &Case) -> Result<Vec<Observations>, String> {
        if let Some(file) = self.unreadable_file() {
            return Err(file.to_owned());
        }
        let typed = self.typed_texts();
        let typed = typed.iter().map(|(path, text)| (path.as_str(), text.as_str()));
        let files = self.files.iter().map(|file| (file.path.as_str(), file.text.as_str()));
        let read = typed.chain(files).map(|(path, text)| parse(case, path, text));
        let all = read.collect::<Result<Vec<_>, _>>()?;
        for delay in all.iter().flat_map(options_of).map(|option| &case.plan.delays[option]) {
            if self.fired.get(&delay.name) != Some(&Some(Fired::of(delay))) {
                return Err(format!(
                    "the observations are not of “{}” as it fires now: take the change back, or the observations",
                    delay.name
                ));
            }
        }
        named_twice(&all).map_or(Ok(all), Err)
    }

    /// The record line by line: typed lines, names of files, and withdrawn observations.
    pub fn lines(&self, plan: &Plan) -> Vec<String> {
        let file = |file: &ObservedFile| match plan.fitted_from.contains(&file.checksum) {
            true => format!("{} (the plan was fitted to it)", file.path),
            false => file.path.clone(),
        };
        let counted = self.typed.iter().map(|row| in_words(row)).chain(self.files.iter().map(file));
        let withdrawn = self.withdrawn().into_iter();
        counted
            .chain(withdrawn.map(|Withdrawn { what, day, .. }| format!("{what}: taken back on {day}")))
            .collect()
    }
}

/// Indices of the options that observations name.
fn options_of(list: &Observations) -> impl Iterator<Item = usize> {
    let seen = list.list.iter().map(|seen| seen.option);
    seen.chain(list.firings.iter().map(|fired| fired.option))
}

/// Reads the observations of a text. The error is the first mistake.
fn parse(case: &Case, path: &str, text: &str) -> Result<Observations, String> {
    Observations::parse(path, text, &observable_names(case)).map_err(|mistakes| {
        let first = mistakes.iter().next();
        let (line, message, remedy) =
            first.map_or((0, "", ""), |(line, _, message, remedy)| (line, message, remedy));
        let place = if is_typed(path) { String::new() } else { format!("{path}, line {line}: ") };
        format!("{place}{message}: {remedy}")
    })
}

/// The part of a row before its value and standard deviation: option, place, quantity and time.
fn place_of(row: &str) -> Option<&str> {
    row.rsplitn(3, ';').nth(2)
}

/// A row in the words in which it was typed.
fn in_words(row: &str) -> String {
    let parts = row.split(';').map(|part| part.trim_matches('"')).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join(" ")
}

/// The row of a typed line. The line holds a tire or cable, a value and a standard deviation. A quantity stands before the value, unless it
/// is the greatest height or force. A time stands before the value if the quantity is the height at a time.
fn row(option: &str, line: &str) -> String {
    let mut words = line.split_whitespace();
    let address = words.next().unwrap_or_default();
    let [tire, cable] = if address.contains('-') { ["", address] } else { [address, ""] };
    let mut rest: Vec<&str> = words.collect();
    let is_quantity = |word: &&str| word.starts_with(|letter: char| letter.is_alphabetic());
    let quantity = match rest.first().copied().filter(is_quantity) {
        Some(named) => {
            rest.remove(0);
            named
        }
        None if cable.is_empty() => "flight_height_m",
        None => "cable_force_n",
    };
    let [at, value, sd] = match rest[..] {
        [value] => ["", value, ""],
        [value, sd] => ["", value, sd],
        [at, value, sd] => [at, value, sd],
        _ => ["", "", ""],
    };
    let option = option.replace('"', "\"\"");
    format!("\"{option}\";{tire};{cable};{quantity};{at};{value};{sd}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanSource;

    const TODAY: &str = "2026-11-26";

    #[test]
    fn typed_lines_are_observations_or_are_refused() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let source = PlanSource { path: "plan.toml".into(), text: text.to_owned() };
        let case = Case::parse(source).expect("a plan");
        let mut record = ObservationRecord::default();
        for line in ["3:1 1.95 0.05", "3:1-4:1 52000 2000", "3:1 height_m 0.3 0.9 0.1", "1:2 firing_s 0.0003"]
        {
            assert_eq!(record.add_line(&case, 2, line), Ok(()), "{line}");
        }
        let read = record.read(&case).expect("observations");
        assert_eq!((read[0].list.len(), read[0].firings.len(), read[0].list[0].option), (3, 1, 2));
        assert_eq!((read[0].list[1].value, read[0].list[2].watched.time), (52000.0, 0.3));
        for line in
            ["", "3:1", "3:1 1.95", "9:9 1.95 0.05", "3:1 1.95 0.05", "3:2 speed 2 0.1", "3:2 1 2 3 4"]
        {
            assert!(record.add_line(&case, 2, line).is_err(), "{line}");
        }
        assert_eq!(record.read(&case).map(|read| read[0].list.len()), Ok(3), "a wrong line is not kept");
        assert!(
            record
                .add_file(&case, "seen.csv", "tire\n", TODAY)
                .is_err_and(|mistake| mistake.contains("seen.csv, line 1"))
        );
        // Another shot: an option of that name that fires at other times, or another lone option where the file names none.
        let edited = |was: &str, is: &str| {
            let source = PlanSource { path: "plan.toml".into(), text: text.replace(was, is) };
            Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
        };
        let other = edited("name = \"20 ms\"\ninterval_ms = 20", "name = \"20 ms\"\ninterval_ms = 21");
        assert_ne!(other.plan, case.plan, "a test that can fail");
        assert!(record.read(&other).is_err_and(|mistake| mistake.contains("not of “20 ms” as it fires now")));
        let alone = |n: usize| case.with_options(&[n]);
        let mut of_one = ObservationRecord::default();
        assert_eq!(
            of_one.add_file(
                &alone(4),
                "seen.csv",
                "tire,quantity,value,sd\n3:1,flight_height_m,1.9,0.05\n",
                TODAY
            ),
            Ok(())
        );
        assert!(of_one.read(&alone(4)).is_ok() && of_one.read(&alone(2)).is_err());
        let same = "option,tire,cable,quantity,at_s,value,sd\n20 ms,3:1,,flight_height_m,,1.95,0.05\n";
        assert_eq!(
            record
                .clone()
                .add_file(&case, "other.csv", same, TODAY)
                .map_err(|mistake| mistake.contains("same")),
            Err(true)
        );
        assert_eq!(record.lines(&case.plan).len(), 4);
    }

    /// A withdrawn line stays in the record until it is typed again. Then it was a typing mistake.
    #[test]
    fn what_is_taken_back_stays_told() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let mut record = ObservationRecord::default();
        assert_eq!(record.add_line(&case, 2, "3:1 19.5 0.05"), Ok(()));
        let gone = record.withdraw_last(TODAY);
        assert_eq!(gone.as_deref(), Some("20 ms 3:1 flight_height_m 19.5 0.05"));
        assert!(record.is_empty() && !record.is_nothing());
        assert_eq!(record.withdrawn().len(), 1);
        assert_eq!(
            record.lines(&case.plan),
            ["20 ms 3:1 flight_height_m 19.5 0.05: taken back on 2026-11-26"]
        );
        assert_eq!(record.add_line(&case, 2, "3:1 1.95 0.05"), Ok(()));
        assert_eq!(record.withdrawn(), []);
        // A damaged record is compared with no plan.
        let damaged = ObservationRecord::unreadable("plan.seen.json".as_ref(), "it ends early");
        // The error names the damaged file, and no mistake in a table that nobody wrote.
        assert!(!damaged.is_empty());
        assert_eq!(damaged.read(&case), Err("plan.seen.json: it ends early".to_owned()));
    }

    /// A second film of one tire counts beside the first. If it is withdrawn, the record says so, even though a line about the same tire
    /// remains.
    #[test]
    fn a_second_value_is_of_another_shot() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let mut record = ObservationRecord::default();
        for line in ["3:1 1.95 0.05", "3:2 1.90 0.05", "3:1 2.65 0.05", "3:2 2.60 0.05"] {
            assert_eq!(record.add_line(&case, 2, line), Ok(()), "{line}");
        }
        let read = record.read(&case).expect("observations");
        let values = |file: &Observations| file.list.iter().map(|seen| seen.value).collect::<Vec<_>>();
        assert_eq!(read.iter().map(values).collect::<Vec<_>>(), [[1.95, 1.90], [2.65, 2.60]]);
        assert!(read.iter().all(|file| is_typed(&file.path)) && read[0].path != read[1].path);
        for left in [3, 2] {
            record.withdraw_last(TODAY);
            assert_eq!((record.typed.len(), record.withdrawn().len()), (left, 4 - left));
        }
        assert_eq!(record.add_line(&case, 2, "3:1 2.25 0.05"), Ok(()), "a slip of the finger is mended");
        assert_eq!((record.typed_shot_count(), record.withdrawn().len()), (2, 1));
        record.withdraw_last(TODAY);
        assert_eq!(record.withdrawn().len(), 3, "what stands for nothing any more was taken back, too");
        assert_eq!(record.add_line(&case, 2, "3:1 2.25 0.05"), Ok(()));
        assert_eq!(record.withdrawn().len(), 1, "as before");
        let mut elsewhere = ObservationRecord::default();
        assert_eq!(elsewhere.add_line(&case, 2, "3:1 2.65 0.05"), Ok(()));
        record.join(elsewhere);
        assert_eq!(record.typed.len(), 3, "what was a slip comes from nowhere else");
        record.close_typed(&record.read(&case).expect("observations"));
        assert!(!record.has_typed() && record.files.len() == 2);
        assert!(record.read(&case).is_ok());
    }

    /// A line that is typed again counts, here and in joined records. The other lines stay withdrawn, each once.
    #[test]
    fn a_line_typed_anew_counts_and_no_other() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let lines = ["3:1 1.95 0.05", "3:2 1.90 0.05"];
        let mut record = ObservationRecord::default();
        for line in lines {
            assert_eq!(record.add_line(&case, 2, line), Ok(()));
            record.withdraw_last(TODAY);
        }
        assert_eq!(record.add_line(&case, 2, lines[0]), Ok(()));
        let is_second_gone = |record: &ObservationRecord| {
            let gone = record.withdrawn();
            gone.len() == 1 && gone[0].what.contains("3:2")
        };
        assert!(is_second_gone(&record));
        let mut joined = ObservationRecord::default();
        joined.join(record.clone());
        joined.join(record.clone());
        assert!(is_second_gone(&joined) && joined.typed == record.typed);
        let mut with_both = ObservationRecord::default();
        assert_eq!(with_both.add_line(&case, 2, lines[0]), Ok(()));
        assert_eq!(with_both.add_line(&case, 2, lines[1]), Ok(()));
        record.join(with_both);
        assert_eq!(record.typed.len(), 1, "what was taken back comes from nowhere else");
    }

    /// A file that grew holds all its earlier observations. A file that changed or lost a value withdrew it.
    #[test]
    fn a_file_that_is_read_again_takes_nothing_back_unseen() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let line = |tire: &str, value: f64| format!("42 ms,{tire},flight_height_m,{value},0.05\n");
        let file = |lines: &[String]| format!("option,tire,quantity,value,sd\n{}", lines.concat());
        let mut record = ObservationRecord::default();
        let mut read = |lines: &[String]| {
            assert_eq!(record.add_file(&case, "seen.csv", &file(lines), TODAY), Ok(()));
            record.withdrawn().len()
        };
        assert_eq!(read(&[line("3:1", 9.5)]), 0);
        assert_eq!(read(&[line("3:1", 9.5), line("2:3", 1.1)]), 0);
        assert_eq!(read(&[line("2:3", 1.1)]), 1);
        assert_eq!(read(&[line("2:3", 1.2)]), 2);
        // If a film of another charge loses its head, that counts as a withdrawal, too.
        let mut record = ObservationRecord::default();
        let headed = format!("# charge: 30 kg\n{}", file(&[line("3:1", 1.9)]));
        assert_eq!(record.add_file(&case, "seen.csv", &headed, TODAY), Ok(()));
        assert_eq!(record.add_file(&case, "seen.csv", &file(&[line("3:1", 1.9)]), TODAY), Ok(()));
        assert_eq!(record.withdrawn().len(), 1);
        // A withdrawn file comes back with a line missing. The withdrawal is still reported.
        let mut record = ObservationRecord::default();
        assert_eq!(
            record.add_file(&case, "seen.csv", &file(&[line("3:1", 9.5), line("2:3", 1.1)]), TODAY),
            Ok(())
        );
        record.withdraw_last(TODAY);
        assert_eq!(record.add_file(&case, "seen.csv", &file(&[line("2:3", 1.1)]), TODAY), Ok(()));
        assert_eq!(record.withdrawn().len(), 1);
    }

    /// Observations of two sessions about one plan count together. What one session withdraws stays withdrawn.
    #[test]
    fn what_was_told_elsewhere_counts_too() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let record = |lines: &[&str]| {
            let mut record = ObservationRecord::default();
            lines.iter().for_each(|line| assert_eq!(record.add_line(&case, 2, line), Ok(())));
            record
        };
        let (mut here, there) = (record(&["3:1 1.95 0.05"]), record(&["3:1 1.95 0.05", "2:3 9.5 0.05"]));
        assert!(here.is_within(&there) && !there.is_within(&here));
        here.join(there.clone());
        assert!(there.is_within(&here) && here.typed.len() == 2);
        here.withdraw_last(TODAY);
        here.join(there.clone());
        assert_eq!((here.typed.len(), here.withdrawn().len()), (1, 1));
        // A line that is typed again counts, here and in joined records.
        assert_eq!(here.add_line(&case, 2, "2:3 9.5 0.05"), Ok(()));
        assert_eq!((here.typed.len(), here.withdrawn().len()), (2, 0));
        let with = |value: f64| {
            let mut record = ObservationRecord::default();
            let text = format!("option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,{value},0.05\n");
            assert_eq!(record.add_file(&case, "seen.csv", &text, TODAY), Ok(()));
            record
        };
        let mut here = with(9.5);
        here.withdraw_last(TODAY);
        here.join(with(9.5));
        assert!(here.is_empty(), "the very same was taken back");
        here.join(with(1.9));
        assert_eq!(here.files.len(), 1, "the file of that name was corrected");
        let damaged = || ObservationRecord::unreadable("plan.seen.json".as_ref(), "it ends early");
        assert!(damaged().has_unreadable() && damaged().readable().is_nothing());
        let mut mended = damaged();
        assert_eq!(mended.withdraw_last(TODAY), None, "no key takes back what nobody could read");
        assert!(mended.has_unreadable());
        mended.join(damaged());
        assert!(!mended.is_empty(), "damaged again");
        // Two shots of one name that fire at different times: neither is compared.
        let other = ObservationRecord {
            fired: BTreeMap::from([("42 ms".to_owned(), Some(Fired::of(&case.plan.delays[0])))]),
            ..with(1.9)
        };
        here.join(other);
        assert!(here.read(&case).is_err_and(|mistake| mistake.contains("as it fires now")));
    }

    /// Once the plan is fitted to them, typed lines count as one file. Lines typed later are of another shot.
    #[test]
    fn lines_that_were_fitted_are_closed() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let mut case = Case::parse(PlanSource { path: "plan.toml".into(), text }).expect("a plan");
        let (mut record, line) = (ObservationRecord::default(), "3:1 1.95 0.05");
        let film = "option,tire,quantity,value,sd\n20 ms,2:1,flight_height_m,1.5,0.05\n";
        assert_eq!(record.add_file(&case, "film.csv", film, TODAY), Ok(()));
        assert_eq!(record.add_line(&case, 2, line), Ok(()));
        assert!(record.has_typed() && !record.has_closed());
        let typed = record.read(&case).expect("observations").into_iter().find(|file| file.path == TYPED);
        case.plan.fitted_from.extend(typed.map(|typed| typed.checksum));
        for _ in 0..2 {
            record.close_typed(&record.read(&case).expect("observations"));
            assert!(!record.has_typed() && record.has_closed());
            assert_eq!(record.lines(&case.plan), ["film.csv", "what was typed (the plan was fitted to it)"]);
        }
        assert!(!record.is_fitted_to_withdrawn(&case.plan));
        let before = record.clone();
        assert_eq!(record.withdraw_last(TODAY).as_deref(), Some(TYPED));
        assert!(record.is_fitted_to_withdrawn(&case.plan), "its launches stand on what nobody vouches for");
        let mut both = before;
        both.withdrawn.clone_from(&record.withdrawn);
        assert!(!both.is_fitted_to_withdrawn(&case.plan), "it counts again");
        assert_eq!(record.withdraw_last(TODAY).as_deref(), Some("film.csv"));
        let gone: Vec<String> = record.withdrawn().into_iter().map(|gone| gone.what).collect();
        assert_eq!(gone, ["what was typed: 20 ms 3:1 flight_height_m 1.95 0.05", "film.csv"]);
    }
}
