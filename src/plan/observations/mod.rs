//! Reads observations of earlier shots: a table of values of tires and cables, each with its standard deviation.
//!
//! A line may also state the measured firing time of a hole ([`FIRING`]). The header names the columns of [`COLUMNS`], in any order.
//! Separators, decimal commas and a byte order mark are read as in lists of holes ([`import`](super::import)). The reader skips lines that
//! begin with `#`, unless they are rows of the table or describe the shot ([`ShotHead`]).

mod alike;
mod fitted;
mod folder;
mod head;
mod row;

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use serde::{Deserialize, Serialize};

pub use self::alike::nearly_alike;
use self::fitted::{MARK_DIGITS, day};
pub use self::fitted::{fitted_files, fitted_values, named_twice, not_to_be_fitted};
pub use self::folder::{files_of, names_of_films_not_given};
pub use self::head::ShotHead;
use self::head::TEMPLATE_COMMENTS;
pub use self::row::LEAST_FORCE;
use self::row::{Row, Seen};
use super::Diagnostics;
use super::diagnostic::{MOST_KEPT, Mistake};
use super::import::number::{Decimals, both_ways, decimals};
use super::import::table::{Line, lines};
use super::reader::nearest;
use super::source::{read_bytes, text_of};
use crate::choice::ObservedQuantity;
use crate::file::checksum;
use crate::sorting::sort;

/// Names of the columns.
pub const COLUMNS: [&str; 7] = ["option", "tire", "cable", "quantity", "at_s", "value", "sd"];
const OPTION: usize = 0;
const TIRE: usize = 1;
const CABLE: usize = 2;
const QUANTITY: usize = 3;
const AT: usize = 4;
const VALUE: usize = 5;
const SD: usize = 6;

/// One file of observations: of one shot of each delay option in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observations {
    /// The file as the user named it.
    pub path: String,
    /// SHA-256 of the observations and firing times, in hexadecimal digits.
    pub checksum: String,
    /// First digits of a checksum of each observation, without its standard deviation (`n_list`).
    marks: Vec<String>,
    /// Entry of `fitted_from` for the day on which each option was fired; empty if the file does not state the day.
    #[serde(default)]
    days: Vec<String>,
    /// The observations; never empty.
    pub list: Vec<Observation>,
    /// The measured firing times.
    pub firings: Vec<MeasuredFiring>,
    /// Description of the shot.
    pub head: ShotHead,
}

/// Name of the quantity of a line that states a measured firing time.
pub const FIRING: &str = "firing_s";

/// The measured firing time of a hole: electronic systems log it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredFiring {
    /// Index of the delay option that was fired.
    pub option: usize,
    /// Index of the tire above the hole.
    pub tire: usize,
    /// Time since time 0 of the plan [s].
    pub time: f64,
}

/// One observed value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Index of the delay option that was fired.
    pub option: usize,
    /// The observed quantity of a tire or a cable.
    pub watched: ObservedPoint,
    /// The value [SI unit of the quantity].
    pub value: f64,
    /// Standard deviation of the value [the same unit].
    pub sd: f64,
    /// Line of the file, from 1.
    pub line: u64,
}

impl Observation {
    fn what_was_seen(&self) -> (ObservedPoint, f64, f64) {
        (self.watched, self.value, self.sd)
    }

    fn is_as(&self, other: &Self) -> bool {
        self.option == other.option && self.what_was_seen() == other.what_was_seen()
    }
}

/// A quantity of a tire or a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObservedPoint {
    /// The quantity.
    pub quantity: ObservedQuantity,
    /// Index of the tire, or of the cable where the quantity is a force.
    pub index: usize,
    /// Time [s] where the quantity is a height at a time; else 0.
    pub time: f64,
}

/// SI unit of a quantity.
pub fn unit(quantity: ObservedQuantity) -> &'static str {
    match quantity {
        ObservedQuantity::FlightHeight | ObservedQuantity::Height | ObservedQuantity::Drift => "m",
        ObservedQuantity::Lift | ObservedQuantity::Landing => "s",
        ObservedQuantity::Force => "N",
    }
}

/// Names that observations may use: the delay options of a plan, and the tires and cables of its shelter.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservableNames {
    /// Names of the delay options.
    pub options: Vec<String>,
    /// Numbers of each tire: row and column, or its number in the list (`n_tires`).
    pub tires: Vec<Vec<f64>>,
    /// Indices of the two tires of each cable (`n_cables`).
    pub cables: Vec<[usize; 2]>,
    /// For each delay option: index of the tire above each hole, and planned firing time of the hole [s].
    pub holes: Vec<Vec<(usize, f64)>>,
}

impl ObservableNames {
    /// Quantity, tires, time and value of an observation, as a text that is the same for every plan with this tire or cable.
    fn seen(&self, seen: &Observation) -> String {
        let ObservedPoint { quantity, index, time } = seen.watched;
        let tires = match quantity {
            ObservedQuantity::Force => self.cables[index].map(|tire| &self.tires[tire]).to_vec(),
            _ => vec![&self.tires[index]],
        };
        format!("{quantity:?} {tires:?} {time:?} {:?}", seen.value)
    }
}

impl Observations {
    /// Reads a file; `-` is standard input.
    pub fn read(path: &Path, known: &ObservableNames) -> Result<Self, Diagnostics> {
        Self::parse(&name_of(path), &read_text(path)?, known)
    }

    /// Reads the text of the file `path`.
    pub fn parse(path: &str, text: &str, known: &ObservableNames) -> Result<Self, Diagnostics> {
        let source = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut mistakes = Vec::new();
        let head = ShotHead::read(source, &mut mistakes);
        let read = if mistakes.is_empty() { read(source, known) } else { Err(mistakes) };
        let (list, firings) = read.map_err(|mistakes| Diagnostics::new(path, source, mistakes))?;
        // The checksum covers the observations, not the text, and names tires by their numbers. So a shot stays the same shot if the file
        // has other comments or another order of lines, if an option gets another name or other firing times, or if the shelter gets more
        // columns.
        let seen = |seen: &Observation| format!("{} {:?}", known.seen(seen), seen.sd);
        let fired =
            |fired: &MeasuredFiring| format!("{FIRING} {:?} {:?}", known.tires[fired.tire], fired.time);
        let mut lines: Vec<String> = list.iter().map(seen).chain(firings.iter().map(fired)).collect();
        sort(&mut lines);
        let mark = |seen: &Observation| checksum(known.seen(seen))[..MARK_DIGITS].to_owned();
        let marks = list.iter().map(mark).collect();
        let checksum = checksum(lines.join("\n"));
        let fired: BTreeSet<usize> = list.iter().map(|seen| seen.option).collect();
        let days = |date: &String| fired.iter().map(|&option| day(date, &known.options[option])).collect();
        let days = head.date.as_ref().map(days).unwrap_or_default();
        Ok(Self { path: path.to_owned(), checksum, marks, days, list, firings, head })
    }

    /// Whether this file holds every observation of `other`, and describes the shot in the same way.
    pub fn holds_all_of(&self, other: &Self) -> bool {
        self.head == other.head
            && other.list.iter().all(|seen| self.list.iter().any(|own| own.is_as(seen)))
            && other.firings.iter().all(|fired| self.firings.contains(fired))
    }

    /// Whether more than half of the observations of one file are in the other: two shots are not that alike. Shots with different measured
    /// firing times are two shots.
    pub fn overlaps(&self, other: &Self) -> bool {
        let are_told_apart = !self.firings.is_empty() && !other.firings.is_empty();
        if are_told_apart && self.firings != other.firings {
            return false;
        }
        let is_in_other = |seen: &&Observation| other.list.iter().any(|known| known.is_as(seen));
        let common = self.list.iter().filter(is_in_other).count();
        2 * common > self.list.len().min(other.list.len())
    }
}

/// The text of a file of observations; `-` is standard input.
pub fn read_text(path: &Path) -> Result<String, Diagnostics> {
    read_bytes(path).and_then(text_of).map_err(|(message, _)| {
        let remedy = "check the path; `shelter fit --template` prints a file to begin with";
        Diagnostics::unreadable(&name_of(path), message, remedy)
    })
}

fn name_of(path: &Path) -> String {
    super::visible(&path.display().to_string()).into_owned()
}

/// The template of a file of observations: the header, and examples of a tire and of a cable.
pub fn template(option: &str, tire: &str, cable: Option<&str>) -> String {
    let quoted = format!("\"{}\"", option.replace('"', "\"\""));
    let [of_shot, example, logged] = TEMPLATE_COMMENTS;
    let mut text = format!(
        "# {of_shot}\n\
         # date:\n# charge:\n# stemming:\n# cover:\n{}\n# {example}\n\
         {quoted},{tire},,flight_height_m,,1.25,0.05\n\
         {quoted},{tire},,height_m,0.3,0.9,0.1\n\
         {quoted},{tire},,landing_s,,0.95,0.02\n\
         # {logged}\n\
         {quoted},{tire},,{FIRING},,0.0003,\n",
        COLUMNS.join(",")
    );
    if let Some(cable) = cable {
        text += &format!("{quoted},,{cable},cable_force_n,,30000,2000\n");
    }
    text
}

fn mistake(line: &Line, message: impl Into<String>, remedy: impl Into<String>) -> Mistake {
    Mistake::new(line.span.clone(), message, remedy)
}

fn read(
    source: &str,
    known: &ObservableNames,
) -> Result<(Vec<Observation>, Vec<MeasuredFiring>), Vec<Mistake>> {
    let separator = separator(source);
    let all = lines(source, separator).map_err(|error| {
        let message = format!("the table cannot be read: {error}");
        vec![Mistake { span: 0..0, message, remedy: "save it as CSV in UTF-8".to_owned() }]
    })?;
    let is_data = |line: &Line| {
        let first = line.values.first().map_or("", String::as_str);
        let is_comment = first.starts_with('#') || first.starts_with("sep=");
        // The name of an option may begin with `#`. Its observations are rows of the table, and no comments. So are rows of an option that
        // the plan no longer has, and rows that somebody switched off.
        let is_row = || {
            let plain = |value: &String| value.trim_start_matches('#').trim().to_lowercase();
            let values: Vec<String> = line.values.iter().map(plain).collect();
            let is_quantity =
                |value: &String| value == FIRING || ObservedQuantity::NAMES.contains(&value.as_str());
            let is_number = |value: &String| value.replace(',', ".").parse::<f64>().is_ok();
            let is_option = known.options.iter().any(|option| option == first);
            is_option || values.iter().any(is_quantity) && values.iter().any(is_number)
        };
        !is_comment || is_row()
    };
    let mut all = all.into_iter().filter(is_data);
    let header_remedy = format!("begin with the line {}", COLUMNS.join(","));
    let Some(header) = all.next() else {
        let message = "there is no observation in the file".to_owned();
        return Err(vec![Mistake { span: 0..0, message, remedy: header_remedy }]);
    };
    let columns = read_header(&header, known)?;
    let rows: Vec<Line> = all.collect();
    if rows.is_empty() {
        return Err(vec![mistake(
            &header,
            "there is no observation below the header",
            "add a line for each",
        )]);
    }
    let comma = decimal_comma(&rows, &columns, separator)?;
    let (mut list, mut firings, mut mistakes) = (Vec::new(), Vec::new(), Vec::new());
    // Line of each observation, by option, quantity, tire or cable, and time. A firing time has no quantity.
    let mut lines: HashMap<(usize, Option<ObservedQuantity>, usize, u64), u64> = HashMap::new();
    for line in &rows {
        if mistakes.len() >= MOST_KEPT {
            return Err(mistakes);
        }
        let Some(seen) = (Row { line, columns: &columns, known, comma }).read(&mut mistakes) else {
            continue;
        };
        let what = match seen {
            Seen::Value(Observation { option, watched, .. }) => {
                (option, Some(watched.quantity), watched.index, watched.time.to_bits())
            }
            Seen::Firing(MeasuredFiring { option, tire, .. }) => (option, None, tire, 0),
        };
        if let Some(other) = lines.insert(what, line.number) {
            mistakes.push(mistake(
                line,
                format!("line {other} has this observation already"),
                "remove one of them, or give their mean; another shot of the same option goes into a file of its own",
            ));
        }
        match seen {
            Seen::Value(observation) => list.push(observation),
            Seen::Firing(firing) => firings.push(firing),
        }
    }
    if list.is_empty() && mistakes.is_empty() {
        let message = "the file states firing times and nothing that was seen";
        mistakes.push(mistake(&header, message, "add a line for what was seen, such as flight_height_m"));
    }
    if mistakes.is_empty() { Ok((list, firings)) } else { Err(mistakes) }
}

/// The separator of the values: the sign that the first line declares, or the first of `;`, tab and `,` that the header holds.
fn separator(source: &str) -> u8 {
    if let Some(declared) = source.lines().next().and_then(|line| line.trim().strip_prefix("sep=")) {
        return declared.bytes().next().unwrap_or(b'\t');
    }
    let is_header = |line: &&str| !line.trim().is_empty() && !line.starts_with('#');
    let header = source.lines().find(is_header).unwrap_or_default();
    [b';', b'\t'].into_iter().find(|&sign| header.contains(char::from(sign))).unwrap_or(b',')
}

/// Index of each of [`COLUMNS`] among the values of a line, and the number of values of a line.
struct Columns {
    position: [Option<usize>; COLUMNS.len()],
    width: usize,
}

fn read_header(header: &Line, known: &ObservableNames) -> Result<Columns, Vec<Mistake>> {
    let width = header.values.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
    let mut columns = Columns { position: [None; COLUMNS.len()], width };
    let mut mistakes = Vec::new();
    for (n, name) in header.values[..width].iter().enumerate() {
        let name = name.to_lowercase();
        match COLUMNS.iter().position(|column| *column == name) {
            Some(column) if columns.position[column].is_some() => {
                mistakes.push(mistake(
                    header,
                    format!("two columns are called `{name}`"),
                    "remove one of them",
                ));
            }
            Some(column) => columns.position[column] = Some(n),
            None => {
                let near = nearest(&name, COLUMNS.into_iter());
                let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
                let remedy =
                    format!("{near}the columns are {}; values are in m, s and N", COLUMNS.join(", "));
                mistakes.push(mistake(header, format!("the column `{name}` is not known"), remedy));
            }
        }
    }
    if columns.position == [None; COLUMNS.len()] {
        let remedy = format!("begin with the line {}", COLUMNS.join(","));
        return Err(vec![mistake(header, "the first line does not name the columns", remedy)]);
    }
    let mut wanted = vec![QUANTITY, VALUE, SD];
    if known.options.len() > 1 {
        wanted.push(OPTION);
    }
    if mistakes.is_empty() {
        for column in wanted.into_iter().filter(|&column| columns.position[column].is_none()) {
            let name = COLUMNS[column];
            let remedy = match column {
                SD => "add the standard deviation of each value, in the unit of the value".to_owned(),
                OPTION => format!("add the delay option that was fired: {}", known.options.join("; ")),
                _ => format!("begin with the line {}", COLUMNS.join(",")),
            };
            mistakes.push(mistake(header, format!("no column is called `{name}`"), remedy));
        }
    }
    if mistakes.is_empty() { Ok(columns) } else { Err(mistakes) }
}

/// Whether the numbers have decimal commas; mistakes if the numbers are ambiguous, or mix commas and points.
fn decimal_comma(rows: &[Line], columns: &Columns, separator: u8) -> Result<bool, Vec<Mistake>> {
    let numbers = |line: &Line| -> Vec<String> {
        let read = [AT, VALUE, SD].into_iter().filter_map(|column| columns.position[column]);
        read.filter_map(|n| line.values.get(n)).cloned().collect()
    };
    let all: Vec<String> = rows.iter().flat_map(&numbers).collect();
    let wrong = |sign: char, message: &dyn Fn(&str) -> String, remedy: &dyn Fn(&str) -> String| {
        let with = all.iter().find(|value| value.contains(sign)).map_or("", String::as_str);
        let line = rows.iter().find(|line| numbers(line).iter().any(|value| value == with));
        Err(line.into_iter().map(|line| mistake(line, message(with), remedy(with))).collect())
    };
    let ambiguous = |sign: char| {
        let message = |with: &str| format!("`{with}` may be a decimal number or thousands");
        wrong(sign, &message, &|with| both_ways(with, sign))
    };
    match decimals(all.iter().map(String::as_str), separator != b',') {
        Decimals::Point => Ok(false),
        Decimals::Comma => Ok(true),
        Decimals::AmbiguousComma => ambiguous(','),
        Decimals::AmbiguousPoint => ambiguous('.'),
        Decimals::Mixed => {
            let message = |with: &str| format!("`{with}` has a comma, other numbers have a decimal point");
            wrong(',', &message, &|_| "write all numbers with decimal points".to_owned())
        }
    }
}
