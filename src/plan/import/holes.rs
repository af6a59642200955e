//! Reads a list of holes: finds the columns, reads the lines, and collects every mistake.

use std::collections::HashSet;
use std::ops::Range;

use super::columns::{Column, find, looks_like_timing, plain};
use super::number::{self, Decimals};
use super::table::{Line, split};
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
    /// What was left out of the list, or read in one of several possible ways.
    pub notes: Vec<String>,
}

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
    let table = split(source, REMEDY)?;
    let Some(first) = table.lines.first() else {
        return Err(vec![mistake(0..0, "the list of holes is empty", REMEDY)]);
    };
    let mut notes: Vec<String> =
        table.titles.iter().map(|title| format!("left out: the line `{title}`")).collect();
    let columns = if table.has_header { named_columns(first, &mut notes)? } else { columns_of_kirra(first)? };
    if !table.has_header {
        notes.push(format!(
            "the list has no header: its {} columns are read as Kirra writes them",
            first.values.len()
        ));
    }
    let lines = &table.lines[usize::from(table.has_header)..];
    // Cells without a name at the end of a header are not columns.
    let width = first.values.iter().rposition(|value| !value.is_empty()).map_or(0, |last| last + 1);
    let width = if table.has_header { width } else { first.values.len() };
    let comma = decimal_comma(lines, &columns, &mut notes)?;
    let (mut holes, mut mistakes) = (Vec::new(), Vec::new());
    for line in lines {
        // A separator at the end of a line adds a value that is empty.
        let values = line.values.iter().rposition(|value| !value.is_empty()).map_or(0, |last| last + 1);
        if values > width || line.values.len() < width {
            let message = format!("the line has {} values for {width} columns", line.values.len());
            let remedy =
                "write one value for each column; decimals with a point, or values separated by semicolons";
            mistakes.push(mistake(line.span.clone(), message, remedy));
            continue;
        }
        holes.extend(read_hole(line, &columns, comma, &mut mistakes));
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
    if mistakes.is_empty() { Ok(Holes { holes, notes }) } else { Err(mistakes) }
}

/// Index of every column of a list that Kirra writes without a header: from the number of values.
fn columns_of_kirra(first: &Line) -> Result<Vec<(Column, usize)>, Vec<Mistake>> {
    let known = KIRRA.iter().find(|(count, _)| *count == first.values.len());
    known.map(|(_, columns)| columns.to_vec()).ok_or_else(|| {
        let message = format!("a table of {} columns without a header", first.values.len());
        vec![mistake(first.span.clone(), message, REMEDY)]
    })
}

/// Index of every column that is read, from its name in the header; notes the columns that are left out.
fn named_columns(header: &Line, notes: &mut Vec<String>) -> Result<Vec<(Column, usize)>, Vec<Mistake>> {
    let line = &header.span;
    let mut found: Vec<(Column, usize)> = Vec::new();
    let (mut mistakes, mut left_out) = (Vec::new(), Vec::new());
    let names = header.values.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
    for (n, name) in header.values.iter().enumerate() {
        let Some(column) = find(name) else {
            if looks_like_timing(name) {
                let message = format!(
                    "the column `{name}` looks like a firing time, a delay or a row, and is not known"
                );
                let remedy = "call it fire_ms if it is the firing time in ms counted from the first hole, delay_ms if it is a delay in ms after the hole in a column `from`, or row; else remove it";
                mistakes.push(mistake(line.clone(), message, remedy));
            } else if name.is_empty() && n < names {
                let message = format!("column {} has no name", n + 1);
                mistakes.push(mistake(line.clone(), message, "name it, or remove it"));
            } else if !name.is_empty() {
                left_out.push(format!("`{name}`"));
            }
            continue;
        };
        if found.iter().any(|(known, _)| *known == column) {
            let message =
                format!("two columns are a hole's {column:?}; the second is `{name}`").to_lowercase();
            mistakes.push(mistake(line.clone(), message, "rename or remove one of them"));
        }
        found.push((column, n));
    }
    let has = |column: Column| found.iter().any(|(known, _)| *known == column);
    for (column, word) in [(Column::X, "x"), (Column::Y, "y")] {
        if !has(column) {
            let all: Vec<String> = header.values.iter().map(|name| plain(name)).collect();
            let near = nearest(word, all.iter().map(String::as_str))
                .map(|near| format!("is it `{near}`? "))
                .unwrap_or_default();
            mistakes.push(mistake(line.clone(), format!("no column is {word}"), format!("{near}{REMEDY}")));
        }
    }
    if has(Column::From) && !has(Column::Delay) && !has(Column::Fire) {
        let remedy = "name the column of the delays delay_ms, or remove the column `from`";
        mistakes.push(mistake(
            line.clone(),
            "holes that follow others, without a column of their delays",
            remedy,
        ));
    }
    if has(Column::Delay) && !has(Column::From) && !has(Column::Fire) {
        let remedy = "call it fire_ms if it counts from the first hole; if it counts from another hole, add a column `from` that names it";
        mistakes.push(mistake(line.clone(), "a delay without saying after what", remedy));
    }
    if !left_out.is_empty() {
        notes.push(format!("left out: the columns {}", left_out.join(", ")));
    }
    if mistakes.is_empty() { Ok(found) } else { Err(mistakes) }
}

/// Whether the numbers of the list have decimal commas; notes it where they have.
fn decimal_comma(
    lines: &[Line],
    columns: &[(Column, usize)],
    notes: &mut Vec<String>,
) -> Result<bool, Vec<Mistake>> {
    let numeric = |column: &Column| {
        matches!(column, Column::X | Column::Y | Column::Fire | Column::Delay | Column::Launch)
    };
    let numbers = |line: &'_ Line| -> Vec<String> {
        let of = |(column, n): &(Column, usize)| {
            numeric(column).then(|| line.values.get(*n).cloned().unwrap_or_default())
        };
        columns.iter().filter_map(of).collect()
    };
    let all: Vec<String> = lines.iter().flat_map(numbers).collect();
    let with_comma = || all.iter().find(|value| value.contains(',')).map_or("", String::as_str);
    let wrong = |message: String, remedy: &str| {
        let line = lines.iter().find(|line| numbers(line).iter().any(|value| value.contains(',')));
        Err(vec![mistake(line.map_or(0..0, |line| line.span.clone()), message, remedy)])
    };
    match number::decimals(all.iter().map(String::as_str)) {
        Decimals::Point => Ok(false),
        Decimals::Comma => {
            let read = number::value(with_comma(), true).map_or(String::new(), |number| number.to_string());
            notes.push(format!("numbers have decimal commas: `{}` is read as {read}", with_comma()));
            Ok(true)
        }
        Decimals::Mixed => wrong(
            format!("`{}` has a comma, other numbers have a decimal point", with_comma()),
            "write all numbers with decimal points, and without signs between thousands",
        ),
        Decimals::Ambiguous => wrong(
            format!("`{}` may be a decimal number or thousands", with_comma()),
            "write all numbers with decimal points, and without signs between thousands",
        ),
    }
}

fn read_hole(
    line: &Line,
    columns: &[(Column, usize)],
    comma: bool,
    mistakes: &mut Vec<Mistake>,
) -> Option<ListedHole> {
    let before = mistakes.len();
    let field = |column: Column| {
        let n = columns.iter().find(|(known, _)| *known == column)?.1;
        let empty =
            |field: &&str| !["", "na", "nan", "null", "none"].contains(&field.to_lowercase().as_str());
        line.values.get(n).map(String::as_str).filter(empty)
    };
    let mut value = |column: Column, word: &str, key: &Key, must: bool| {
        let range = key.kind.range();
        let found = field(column);
        match found.map(|text| (text, number::value(text, comma))) {
            Some((_, Some(number))) if range.contains(&number) => Some(number),
            Some((text, _)) => {
                let message = format!("{word} is `{text}`");
                let remedy = format!("write a number from {} to {}", range.start(), range.end());
                mistakes.push(mistake(line.span.clone(), message, remedy));
                None
            }
            None if must => {
                let message = format!("the line has no {word}");
                mistakes.push(mistake(
                    line.span.clone(),
                    message,
                    "write a number in metres, or remove the line",
                ));
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
    let id = text(Column::Id).unwrap_or_else(|| line.number.to_string());
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
        span: line.span.clone(),
    })
}
