//! Units and times that a list states outside the names of its columns. If the import reads them otherwise, that is a mistake.

use super::columns::plain;
use super::table::Table;
use crate::plan::diagnostic::Mistake;

/// Names of columns that hold the unit of a hole, in small letters, without signs and spaces.
#[rustfmt::skip]
const UNIT_COLUMNS: &[&str] = &[
    "unit", "units", "uom", "xyunit", "coordunit", "единица", "единицы", "едизм", "einheit", "einheiten", "unidad", "unidades",
];
/// Values of such a column for lengths in metres, which the import reads.
#[rustfmt::skip]
const METRES: &[&str] = &["", "m", "metre", "metres", "meter", "meters", "м", "метр", "метры", "metro", "metros"];
/// Words for other units of length.
#[rustfmt::skip]
const OTHER_LENGTHS: &[&str] = &[
    "ft", "foot", "feet", "inch", "inches", "yd", "yards", "mm", "cm", "millimetres", "millimeters", "centimetres", "centimeters",
    "фут", "футы", "футах", "дюйм", "дюймы", "дюймах", "мм", "см", "pies", "pulgadas", "fuß", "zoll",
];
/// Beginnings of words in a line that states the unit of coordinates.
#[rustfmt::skip]
const OF_UNITS: &[&str] = &["unit", "coord", "dimension", "координат", "единиц", "einheit", "koordinat", "unidad", "medida"];
/// Beginnings of words in a line that states from when times count; below, for its times.
const SINCE: &[&str] =
    &["relativ", "previous", "preceding", "относительн", "предыдущ", "vorherig", "anterior"];
const OF_TIMES: &[&str] =
    &["time", "timing", "delay", "fire", "firing", "врем", "замедл", "zeit", "tiempo", "retard"];

/// Mistakes about lines above the header, and about columns that name a unit.
pub fn mistakes(table: &Table) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    for (title, span) in &table.titles {
        let words: Vec<String> =
            title.split(|sign: char| !sign.is_alphanumeric()).map(str::to_lowercase).collect();
        let begins = |with: &[&str]| words.iter().any(|word| with.iter().any(|part| word.starts_with(part)));
        let other = words.iter().find(|word| OTHER_LENGTHS.contains(&word.as_str()));
        if let Some(unit) = other.filter(|_| begins(OF_UNITS) || words.iter().any(|word| word == "in")) {
            let message = format!("the line says `{unit}`, and x and y are read in metres");
            let remedy = "convert x and y to metres, and remove the line";
            mistakes.push(Mistake::new(span.clone(), message, remedy));
        }
        if begins(SINCE) && begins(OF_TIMES) {
            let message = "the line says from when times count, and a firing time is read as counted from the first hole";
            let remedy = "give delays in a column delay_ms, after the hole in a column `from`; or count from the first hole, and remove the line";
            mistakes.push(Mistake::new(span.clone(), message, remedy));
        }
    }
    let Some((head, lines)) = table.lines.split_first().filter(|_| table.has_header) else { return mistakes };
    for (n, name) in head.values.iter().enumerate() {
        if !UNIT_COLUMNS.contains(&plain(name).as_str()) {
            continue;
        }
        let is_other = |value: &str| !METRES.contains(&value.to_lowercase().trim_end_matches('.'));
        let other = lines.iter().find(|line| line.values.get(n).is_some_and(|value| is_other(value)));
        mistakes.extend(other.map(|line| {
            let message =
                format!("`{}` in the column `{name}`, and x and y are read in metres", line.values[n]);
            Mistake::new(line.span.clone(), message, "convert x and y to metres, and remove the column")
        }));
    }
    mistakes
}
