//! Reads a list of holes: finds the columns, reads the lines, and collects every mistake.

use std::collections::HashSet;
use std::ops::Range;

use crate::plan::diagnostic::Mistake;
use crate::plan::keys::{Key, delay, hole};
use crate::plan::read::nearest;

/// One hole of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct ListedHole {
    pub id: String,
    pub x_m: f64,
    pub y_m: f64,
    pub row: Option<String>,
    /// Firing time, counted from the first hole of the blast [ms].
    pub fire_ms: Option<f64>,
    /// Delay after the hole `from` [ms].
    pub delay_ms: Option<f64>,
    pub from: Option<String>,
    pub launch_m_s: Option<f64>,
    /// Bytes of the line in the source.
    pub span: Range<usize>,
}

/// The whole list.
#[derive(Clone, Debug, PartialEq)]
pub struct Holes {
    pub holes: Vec<ListedHole>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Id,
    X,
    Y,
    Row,
    Fire,
    Delay,
    From,
    Launch,
}

/// Names of the columns in a header, in small letters and without signs or spaces.
const HEADERS: &[(Column, &[&str])] = &[
    (Column::Id, &["id", "hole", "holeid", "holename", "holeno", "holenumber", "number", "no", "name"]),
    (
        Column::X,
        &["x", "xm", "east", "easting", "eastingm", "startx", "startxlocation", "collarx", "xcollar"],
    ),
    (
        Column::Y,
        &["y", "ym", "north", "northing", "northingm", "starty", "startylocation", "collary", "ycollar"],
    ),
    (Column::Row, &["row", "rowid", "rowname", "rowno", "blastrow"]),
    (
        Column::Fire,
        &[
            "firems",
            "fireatms",
            "firetime",
            "firetimems",
            "firingtime",
            "firingtimems",
            "initiationtime",
            "initiationtimems",
            "holetime",
        ],
    ),
    (Column::Delay, &["delay", "delayms", "timingdelay", "timingdelayms", "timingdelaymilliseconds"]),
    (Column::From, &["from", "fromid", "fromhole", "fromholeid"]),
    (Column::Launch, &["launch", "launchms", "launchmpers", "launchvelocity", "v0"]),
];

/// Lists that Kirra writes without a header: the number of columns, and the index of each column that is read.
const KIRRA: &[(usize, &[(Column, usize)])] = &[
    (4, &[(Column::Id, 0), (Column::X, 1), (Column::Y, 2)]),
    (7, &[(Column::Id, 0), (Column::X, 1), (Column::Y, 2)]),
    (9, &[(Column::Id, 0), (Column::X, 1), (Column::Y, 2)]),
    (12, &[(Column::Id, 0), (Column::X, 1), (Column::Y, 2), (Column::From, 9), (Column::Delay, 10)]),
    (14, &[(Column::Id, 2), (Column::X, 3), (Column::Y, 4), (Column::From, 11), (Column::Delay, 12)]),
];

const REMEDY: &str =
    "name the columns in the first line: hole, x, y in metres, and row, or fire_ms, or delay_ms and from";

fn mistake(span: Range<usize>, message: impl Into<String>, remedy: impl Into<String>) -> Mistake {
    Mistake { span, message: message.into(), remedy: remedy.into() }
}

/// All holes of the list, or all its mistakes.
pub fn read(source: &str) -> Result<Holes, Vec<Mistake>> {
    let first = source.lines().next().unwrap_or_default();
    let separator =
        [b';', b'\t', b','].into_iter().find(|&byte| first.contains(char::from(byte))).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(source.as_bytes());
    let mut records = Vec::new();
    for record in reader.records() {
        match record {
            Ok(record) => records.push(record),
            Err(error) => {
                return Err(vec![mistake(0..0, format!("the table cannot be read: {error}"), REMEDY)]);
            }
        }
    }
    records.retain(|record| record.iter().any(|field| !field.is_empty()));
    let Some(head) = records.first() else {
        return Err(vec![mistake(0..0, "the list of holes is empty", REMEDY)]);
    };
    let columns = columns(head, source)?;
    let named = head.iter().all(|field| number(field).is_none());
    let (mut holes, mut mistakes) = (Vec::new(), Vec::new());
    for record in records.iter().skip(usize::from(named)) {
        holes.extend(read_hole(record, &columns, source, &mut mistakes));
    }
    let mut positions = HashSet::new();
    for hole in &holes {
        if !positions.insert([hole.x_m + 0.0, hole.y_m + 0.0].map(f64::to_bits)) {
            let message = format!("hole {} lies where another does", hole.id);
            mistakes.push(mistake(hole.span.clone(), message, "correct its x and y, or remove the line"));
        }
    }
    if holes.is_empty() && mistakes.is_empty() {
        mistakes.push(mistake(0..0, "the list has no hole", "write one line for each hole"));
    }
    if mistakes.is_empty() { Ok(Holes { holes }) } else { Err(mistakes) }
}

fn span(record: &csv::StringRecord, source: &str) -> Range<usize> {
    let start = record.position().map_or(0, |position| position.byte() as usize).min(source.len());
    let line = source.get(start..).unwrap_or_default();
    let skipped = line.len() - line.trim_start().len();
    let end = line.trim_start().find(['\r', '\n']).unwrap_or(line.len() - skipped);
    start + skipped..start + skipped + end
}

/// Index of every column that is read: from the header, or without a header from the number of columns.
fn columns(head: &csv::StringRecord, source: &str) -> Result<Vec<(Column, usize)>, Vec<Mistake>> {
    let line = span(head, source);
    if head.iter().any(|field| number(field).is_some()) {
        let known = KIRRA.iter().find(|(count, _)| *count == head.len());
        return known.map(|(_, columns)| columns.to_vec()).ok_or_else(|| {
            let message = format!("a table of {} columns without a header", head.len());
            vec![mistake(line, message, REMEDY)]
        });
    }
    let plain = |field: &str| field.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "");
    let mut found: Vec<(Column, usize)> = Vec::new();
    let mut mistakes = Vec::new();
    for (n, field) in head.iter().enumerate() {
        let name = plain(field);
        let Some((column, _)) = HEADERS.iter().find(|(_, names)| names.contains(&name.as_str())) else {
            continue;
        };
        if found.iter().any(|(known, _)| known == column) {
            let message =
                format!("two columns are a hole's {column:?}; the second is `{field}`").to_lowercase();
            mistakes.push(mistake(line.clone(), message, "rename or remove one of them"));
        }
        found.push((*column, n));
    }
    let has = |column: Column| found.iter().any(|(known, _)| *known == column);
    for (column, word) in [(Column::X, "x"), (Column::Y, "y")] {
        if !has(column) {
            let all: Vec<String> = head.iter().map(plain).collect();
            let near = nearest(word, all.iter().map(String::as_str))
                .map(|near| format!("is it `{near}`? "))
                .unwrap_or_default();
            mistakes.push(mistake(line.clone(), format!("no column is {word}"), format!("{near}{REMEDY}")));
        }
    }
    if has(Column::Delay) && !has(Column::From) && !has(Column::Fire) {
        let remedy = "call it fire_ms if it counts from the first hole; if it counts from another hole, add a column `from` that names it";
        mistakes.push(mistake(line, "a delay without saying after what", remedy));
    }
    if mistakes.is_empty() { Ok(found) } else { Err(mistakes) }
}

/// A number, with a decimal point or a decimal comma.
fn number(field: &str) -> Option<f64> {
    field.parse().or_else(|_| field.replace(',', ".").parse()).ok().filter(|number: &f64| number.is_finite())
}

fn read_hole(
    record: &csv::StringRecord,
    columns: &[(Column, usize)],
    source: &str,
    mistakes: &mut Vec<Mistake>,
) -> Option<ListedHole> {
    let before = mistakes.len();
    let line = span(record, source);
    let field = |column: Column| {
        let n = columns.iter().find(|(known, _)| *known == column)?.1;
        let empty =
            |field: &&str| !["", "na", "nan", "null", "none"].contains(&field.to_lowercase().as_str());
        record.get(n).filter(empty)
    };
    let mut value = |column: Column, word: &str, key: &Key, must: bool| {
        let range = key.kind.range();
        let found = field(column);
        match found.map(|text| (text, number(text))) {
            Some((_, Some(number))) if range.contains(&number) => Some(number),
            Some((text, _)) => {
                let message = format!("{word} is `{text}`");
                let remedy = format!("write a number from {} to {}", range.start(), range.end());
                mistakes.push(mistake(line.clone(), message, remedy));
                None
            }
            None if must => {
                let message = format!("the line has no {word}");
                mistakes.push(mistake(line.clone(), message, "write a number in metres, or remove the line"));
                None
            }
            None => None,
        }
    };
    let (x_m, y_m) = (value(Column::X, "x", &hole::X_M, true), value(Column::Y, "y", &hole::Y_M, true));
    let fire_ms = value(Column::Fire, "the firing time", &delay::INTERVAL_MS, false);
    let delay_ms = value(Column::Delay, "the delay", &delay::INTERVAL_MS, false);
    let launch_m_s = value(Column::Launch, "the launch velocity", &hole::LAUNCH_M_S, false);
    let text = |column: Column| field(column).map(str::to_owned);
    // Kirra writes `Pattern:::Hole`.
    let from = text(Column::From).map(|from| from.rsplit(":::").next().unwrap_or_default().to_owned());
    let number = record.position().map_or(0, csv::Position::line);
    let id = text(Column::Id).unwrap_or_else(|| number.to_string());
    if mistakes.len() > before {
        return None;
    }
    Some(ListedHole {
        id,
        x_m: x_m?,
        y_m: y_m?,
        row: text(Column::Row),
        fire_ms,
        delay_ms,
        from,
        launch_m_s,
        span: line,
    })
}
