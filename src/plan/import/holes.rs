//! Reads a list of holes: each line becomes a hole, and every mistake is collected.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::columns::Column;
use super::direction::{Directions, Tilt};
use super::header::{Columns, REMEDY, with_header, without_header};
use super::number::{self, Decimals};
use super::stated_units;
use super::table::{Line, Table, split};
use super::unfired;
use crate::plan::diagnostic::{MOST_KEPT, Mistake};
use crate::plan::keys::{Key, delay, hole};

/// One hole of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct ListedHole {
    /// Name of the hole; `Pattern:::Hole` in a list of several patterns.
    pub id: String,
    pub x_m: f64,
    pub y_m: f64,
    pub row: Option<String>,
    /// Firing time [ms].
    pub fire_ms: Option<f64>,
    /// Delay after the hole `from` [ms].
    pub delay_ms: Option<f64>,
    pub from: Option<String>,
    pub launch_m_s: Option<f64>,
    /// `None`: the launch is vertical.
    pub tilt: Option<Tilt>,
    /// Mass of the explosive in the hole [kg].
    pub charge_kg: Option<f64>,
    /// Bytes of the line in the source.
    pub span: Range<usize>,
}

/// The whole list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Holes {
    pub holes: Vec<ListedHole>,
    /// Lines and columns that were left out.
    pub left_out: Vec<String>,
    /// Notes on what was read in one of several possible ways.
    pub notes: Vec<String>,
    /// Whether rows only say where holes lie: the rows of design programs may fire in any order.
    pub rows_are_places: bool,
}

/// Names of lines that sum up a list, such as totals, in small letters.
const SUMS: &[&str] = &[
    "total",
    "totals",
    "sum",
    "mean",
    "average",
    "avg",
    "min",
    "max",
    "count",
    "итого",
    "всего",
    "сумма",
    "среднее",
    "suma",
    "promedio",
    "media",
    "summe",
    "gesamt",
    "mittel",
    "mittelwert",
    "durchschnitt",
];
/// Signs at the beginning of a line that is switched off.
const REMARKS: &[&str] = &["#", "//", "%", "!"];

/// Notes a mistake for each column that is not read but holds times, such as `500 ms` of the cap in each hole.
fn times_left_out(table: &Table, columns: &Columns, mistakes: &mut Vec<Mistake>) {
    let [header, lines @ ..] = &table.lines[..] else { return };
    let is_left_out = |n: &usize| table.has_header && columns.read.iter().all(|(_, read)| read != n);
    for n in (0..columns.width).filter(is_left_out) {
        let timed = lines.iter().find(|line| line.values.get(n).is_some_and(|value| is_time(value)));
        mistakes.extend(timed.map(|line| {
            let message = format!(
                "`{}` in the column `{}` is a time, and the column is not known",
                line.values[n], header.values[n]
            );
            let remedy = "call it fire_ms if it is the firing time counted from the first hole, or delay_ms if it is a delay after the hole in a column `from`; a delay in the hole goes into in_hole_delay_ms of the plan: remove it here";
            Mistake::new(line.span.clone(), message, remedy)
        }));
    }
}

/// Whether a value begins with one or several numbers of milliseconds or seconds: `500 ms`, `25/500ms EZDet`.
fn is_time(value: &str) -> bool {
    let small = value.trim().to_lowercase();
    let unit = small.trim_start_matches(|sign: char| sign.is_ascii_digit() || " .,/+".contains(sign));
    let word: String = unit.chars().take_while(|letter| letter.is_alphabetic()).collect();
    let is_number = unit.len() < small.len() && small.starts_with(|sign: char| sign.is_ascii_digit());
    is_number
        && ["ms", "msec", "millisec", "milliseconds", "мс", "мсек", "s", "sec", "с", "сек"]
            .contains(&word.as_str())
}

/// All holes of the list, or all its mistakes.
pub fn read(source: &str, directions: Directions) -> Result<Holes, Vec<Mistake>> {
    let table = split(source, REMEDY)?;
    let Some(first) = table.lines.first() else {
        return Err(vec![Mistake::new(0..0, "the list of holes is empty", REMEDY)]);
    };
    let columns =
        if table.has_header { with_header(first, directions)? } else { without_header(first, directions)? };
    let mut list = Holes {
        notes: columns.note.iter().cloned().collect(),
        rows_are_places: columns.rows_are_places,
        ..Holes::default()
    };
    list.left_out.extend(table.titles.iter().map(|(title, _)| format!("the line `{title}`")));
    if !columns.left_out.is_empty() {
        list.left_out.push(format!("the columns {}", columns.left_out.join(", ")));
    }
    let comma = decimal_comma(&table, &columns, &mut list.notes)?;
    let (mut patterns, mut unnamed, mut mistakes) = (Vec::new(), Vec::new(), stated_units::mistakes(&table));
    times_left_out(&table, &columns, &mut mistakes);
    for line in &table.lines[usize::from(table.has_header)..] {
        // A separator at the end of a line adds an empty value.
        let values = line.values.iter().rposition(|value| !value.is_empty()).map_or(0, |last| last + 1);
        if values > columns.width || line.values.len() < columns.width {
            let count = line.values.len();
            let s = if count == 1 { "" } else { "s" };
            let message = format!("the line has {count} value{s} for {} columns", columns.width);
            let remedy =
                "write one value for each column; decimals with a point, or values separated by semicolons";
            mistakes.push(Mistake::new(line.span.clone(), message, remedy));
            continue;
        }
        if mistakes.len() >= MOST_KEPT {
            return Err(mistakes);
        }
        if let Some(hole) = read_hole(line, &columns, comma, &mut mistakes) {
            unnamed.extend(
                columns.index(Column::Id).filter(|&n| line.values[n].is_empty()).map(|_| line.span.clone()),
            );
            list.holes.push(hole);
            patterns.push(columns.index(Column::Pattern).map(|n| line.values[n].clone()).unwrap_or_default());
        }
    }
    if unnamed.len() < list.holes.len() {
        let message = "the line does not name its hole, unlike others";
        let remedy = "name it, or remove the line if it is no hole";
        mistakes.extend(unnamed.into_iter().map(|line| Mistake::new(line, message, remedy)));
    }
    unfired::tells_apart(&table, &mut mistakes);
    unfired::without_charge(&table, &mut mistakes);
    remarks(&list.holes, &mut mistakes);
    rows(&list.holes, &mut mistakes);
    name_patterns(&mut list, &patterns);
    repeated(&list.holes, &mut mistakes);
    if list.holes.is_empty() && mistakes.is_empty() {
        mistakes.push(Mistake::new(0..0, "the list has no hole", "write one line for each hole"));
    }
    if mistakes.is_empty() { Ok(list) } else { Err(mistakes) }
}

/// Notes a mistake for two holes in one place, and for two holes of a row with one name.
pub fn repeated(holes: &[ListedHole], mistakes: &mut Vec<Mistake>) {
    let (mut places, mut names) = (HashSet::new(), HashSet::new());
    for hole in holes {
        let new_place = places.insert([hole.x_m + 0.0, hole.y_m + 0.0].map(f64::to_bits));
        let new_name = names.insert((hole.id.as_str(), hole.row.as_deref()));
        let (what, remedy) = match (new_place, new_name) {
            (true, true) => continue,
            (false, true) => ("lies where another does", "correct its x and y, or remove the line"),
            (false, false) => ("is listed twice in one place", "remove one of the two"),
            (true, false) => (
                "is listed twice in two places",
                "remove the wrong one; if both are holes, give each a name of its own",
            ),
        };
        mistakes.push(Mistake::new(hole.span.clone(), format!("hole {} {what}", hole.id), remedy));
    }
}

/// Notes a mistake for lines that begin with a sign of a remark, if other lines do not: somebody may have switched them off.
fn remarks(holes: &[ListedHole], mistakes: &mut Vec<Mistake>) {
    for sign in REMARKS {
        let marked = |hole: &&ListedHole| hole.id.starts_with(sign);
        if !holes.iter().all(|hole| marked(&hole)) {
            mistakes.extend(holes.iter().filter(marked).map(|hole| {
                let message = format!("the line begins with `{sign}`, unlike others");
                Mistake::new(hole.span.clone(), message, "remove the line if it is a remark, else the sign")
            }));
        }
    }
}

/// Notes a mistake if rows of one number are written in different ways.
fn rows(holes: &[ListedHole], mistakes: &mut Vec<Mistake>) {
    let mut first_spelling: HashMap<u64, &str> = HashMap::new();
    for hole in holes {
        let Some(row) = hole.row.as_deref() else { continue };
        let Ok(number) = row.parse::<f64>() else { continue };
        let first = *first_spelling.entry(number.to_bits()).or_insert(row);
        if first != row {
            let message = format!("the row is `{row}`, the same as `{first}` written otherwise");
            mistakes.push(Mistake::new(hole.span.clone(), message, "write each row in one way"));
        }
    }
}

/// Gives holes their full names, `Pattern:::Hole`, if the list has several patterns; else leaves the pattern out.
fn name_patterns(list: &mut Holes, patterns: &[String]) {
    let different: Vec<&String> = {
        let mut seen = HashSet::new();
        patterns.iter().filter(|pattern| seen.insert(*pattern)).collect()
    };
    let several = different.len() > 1;
    let followed: HashSet<&str> =
        list.holes.iter().filter_map(|hole| Some(hole.from.as_deref()?.split_once(":::")?.0)).collect();
    // Without a column of patterns, a hole of another pattern would pass for the hole of that name in this one.
    let followed_is_known = followed.len() <= 1;
    for (hole, pattern) in list.holes.iter_mut().zip(patterns) {
        let whole = |id: &str| if id.contains(":::") { id.to_owned() } else { format!("{pattern}:::{id}") };
        if several {
            hole.id = whole(&hole.id);
            hole.row = hole.row.as_deref().map(whole);
            hole.from = hole.from.as_deref().map(whole);
        } else if let Some((before, id)) = hole.from.as_deref().and_then(|from| from.split_once(":::"))
            && (pattern.is_empty() && followed_is_known || before == pattern)
        {
            hole.from = Some(id.to_owned());
        }
    }
    if several {
        let names: Vec<String> = different.iter().map(|pattern| format!("`{pattern}`")).collect();
        list.notes.push(format!("the patterns {} are read as one shot", names.join(", ")));
    }
}

/// Whether the numbers of the list have decimal commas; adds a note if they have.
fn decimal_comma(table: &Table, columns: &Columns, notes: &mut Vec<String>) -> Result<bool, Vec<Mistake>> {
    let lines = &table.lines[usize::from(table.has_header)..];
    let numeric = columns.read.iter().filter(|(column, _)| !column.unit().is_empty());
    let read: Vec<usize> = numeric.map(|(_, n)| *n).collect();
    let others = |n: usize| columns.read.iter().all(|(_, known)| *known != n);
    // A column that is not read shows decimal commas, too.
    let counts = |&(n, value): &(usize, &String)| {
        read.contains(&n) || others(n) && number::surely_decimal_comma(value)
    };
    let numbers = |line: &'_ Line| -> Vec<String> {
        line.values.iter().enumerate().filter(counts).map(|(_, value)| value.clone()).collect()
    };
    let all: Vec<String> = lines.iter().flat_map(numbers).collect();
    let with = |sign: char| all.iter().find(|value| value.contains(sign)).map_or("", String::as_str);
    let wrong = |sign: char, message: String, remedy: &str| {
        let line = lines.iter().find(|line| numbers(line).iter().any(|value| value.contains(sign)));
        Err(vec![Mistake::new(line.map_or(0..0, |line| line.span.clone()), message, remedy)])
    };
    let ambiguous = |sign: char| {
        let message = format!("`{}` may be a decimal number or thousands", with(sign));
        wrong(sign, message, &number::both_ways(with(sign), sign))
    };
    match number::decimals(all.iter().map(String::as_str), table.separator != b',') {
        Decimals::Point => Ok(false),
        Decimals::Comma => {
            let read = number::value(with(','), true).map_or(String::new(), |number| number.to_string());
            notes.push(format!("numbers have decimal commas: `{}` is read as {read}", with(',')));
            Ok(true)
        }
        Decimals::Mixed => {
            let message = format!("`{}` has a comma, other numbers have a decimal point", with(','));
            wrong(',', message, "write all numbers with decimal points, and without signs between thousands")
        }
        Decimals::AmbiguousComma => ambiguous(','),
        Decimals::AmbiguousPoint => ambiguous('.'),
    }
}

fn read_hole(line: &Line, columns: &Columns, comma: bool, mistakes: &mut Vec<Mistake>) -> Option<ListedHole> {
    let before = mistakes.len();
    let field = |column: Column| {
        let empty =
            |field: &&str| !["", "na", "nan", "null", "none"].contains(&field.to_lowercase().as_str());
        line.values.get(columns.index(column)?).map(String::as_str).filter(empty)
    };
    let mut value = |column: Column, word: &str, key: &Key, must: bool| {
        let range = key.kind.range();
        // `unfired` refuses a hole without charge.
        let is_empty_hole = |text: &&str| column == Column::Charge && number::value(text, comma) == Some(0.0);
        let found = field(column).filter(|text| !is_empty_hole(text));
        // Two delays in one cell, `25 500`, are no thousands: no hole fires that late.
        let is_time = matches!(column, Column::Fire | Column::Delay);
        let number = |text: &str| {
            number::value(text, comma).filter(|_| !(is_time && text.contains(char::is_whitespace)))
        };
        match found.map(|text| (text, number(text))) {
            Some((_, Some(number))) if range.contains(&number) => Some(number),
            Some((text, _)) => {
                let message = format!("{word} is `{text}`");
                let remedy = format!(
                    "write a number from {} to {}, all its digits and no unit",
                    range.start(),
                    range.end()
                );
                mistakes.push(Mistake::new(line.span.clone(), message, remedy));
                None
            }
            None if must => {
                let message = format!("the line has no {}", word.trim_start_matches("the "));
                let unit = if column.unit() == "m" { "metres" } else { "degrees" };
                let remedy = format!("write a number in {unit}, or remove the line");
                mistakes.push(Mistake::new(line.span.clone(), message, remedy));
                None
            }
            None => None,
        }
    };
    let (x_m, y_m) = (value(Column::X, "x", &hole::X_M, true), value(Column::Y, "y", &hole::Y_M, true));
    let fire_ms = value(Column::Fire, "the firing time", &delay::INTERVAL_MS, false);
    let delay_ms = value(Column::Delay, "the delay", &delay::INTERVAL_MS, false);
    let launch_m_s = value(Column::Launch, "the launch velocity", &hole::LAUNCH_M_S, false);
    let inclined = columns.index(Column::Angle).is_some();
    let angle_deg = value(Column::Angle, "the angle from the vertical", &hole::TILT_DEG, inclined);
    let has_bearing = angle_deg.is_some_and(|angle| angle > 0.0);
    let bearing_deg = value(Column::Bearing, "the bearing", &hole::TILT_TOWARD_DEG, has_bearing);
    let charge_kg = value(Column::Charge, "the charge", &hole::CHARGE_KG, false);
    let text = |column: Column| field(column).map(str::to_owned);
    let id = text(Column::Id).unwrap_or_else(|| line.number.to_string());
    let sums_up = |name: &&str| SUMS.contains(&name.to_lowercase().trim_end_matches([':', ' ']));
    if let Some(name) = [id.as_str(), line.values[0].as_str()].into_iter().find(sums_up) {
        let message = format!("the line `{name}` seems to sum up others");
        mistakes.push(Mistake::new(line.span.clone(), message, "remove it"));
    }
    let names = [Column::Id, Column::Pattern, Column::Row, Column::From].map(|column| columns.index(column));
    let is_said = |(n, value): &(usize, &String)| unfired::says(value, !names.contains(&Some(*n)));
    if let Some((_, word)) = line.values.iter().enumerate().find(is_said) {
        let message = format!("the line says `{word}`: does hole {id} fire?");
        let remedy = "remove the line if it does not; else reword the remark";
        mistakes.push(Mistake::new(line.span.clone(), message, remedy));
    }
    if line.runs_on {
        let message = "a value runs over several lines";
        mistakes.push(Mistake::new(
            line.span.clone(),
            message,
            "is a quotation mark missing? write each hole in one line",
        ));
    }
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
        from: text(Column::From),
        launch_m_s,
        tilt: angle_deg.zip(bearing_deg).and_then(|(angle, bearing)| Tilt::against_hole(angle, bearing)),
        charge_kg,
        span: line.span.clone(),
    })
}
