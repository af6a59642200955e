//! The face for scripts: tables as CSV, numbers SI and with all their digits.

use std::io;

use csv::WriterBuilder;
use serde::Serialize;

use super::parts::{Block, Cell, Report, Row, Table};

/// Separators between fields and within numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separators {
    /// `0.5,1`: for scripts.
    Comma,
    /// `0,5;1` behind a byte order mark: for spreadsheets where 0,5 is one half.
    Semicolon,
}

impl Separators {
    /// Mark at the beginning of the text; empty where there is none.
    pub fn mark(self) -> &'static str {
        if self == Separators::Semicolon { "\u{feff}" } else { "" }
    }

    /// Character between two fields.
    pub fn between_fields(self) -> char {
        if self == Separators::Semicolon { ';' } else { ',' }
    }

    /// A number with all its digits.
    pub fn number(self, number: f64) -> String {
        let text = number.to_string();
        if self == Separators::Semicolon { text.replace('.', ",") } else { text }
    }
}

/// All tables of all reports that have keys, below one header: the keys of the first table.
pub fn csv(reports: &[Report], separators: Separators) -> io::Result<String> {
    let blocks = reports.iter().flat_map(|report| &report.blocks);
    let tables = blocks.filter_map(|block| match block {
        Block::Table(table) if !keys(table).is_empty() => Some(table),
        _ => None,
    });
    Ok(separators.mark().to_owned() + &write(&tables.collect::<Vec<_>>(), separators)?)
}

fn keys(table: &Table) -> Vec<&'static str> {
    table.columns.iter().flat_map(|column| column.keys).copied().filter(|key| !key.is_empty()).collect()
}

fn write(tables: &[&Table], separators: Separators) -> Result<String, csv::Error> {
    let mut writer =
        WriterBuilder::new().delimiter(separators.between_fields() as u8).from_writer(Vec::new());
    let header = tables.first().map(|table| keys(table)).unwrap_or_default();
    if !header.is_empty() {
        writer.write_record(&header)?;
    }
    for table in tables {
        for row in &table.rows {
            let written = fields(table, row).into_iter().map(|field| match field {
                CsvValue::Number(number) if separators == Separators::Semicolon => {
                    CsvValue::Text(separators.number(number))
                }
                field => field,
            });
            writer.serialize(written.collect::<Vec<_>>())?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into())
}

/// Value under one name of the header.
#[derive(Clone, Serialize)]
#[serde(untagged)]
enum CsvValue {
    Nothing,
    Text(String),
    Flag(bool),
    Count(usize),
    Number(f64),
}

/// A text that no spreadsheet runs as a formula. An apostrophe stands before a text that would be one.
fn as_text(text: &str) -> CsvValue {
    let guard = if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { "'" } else { "" };
    CsvValue::Text(format!("{guard}{text}"))
}

/// The values of a cell, one per key.
fn values(cell: &Cell) -> Vec<CsvValue> {
    // An unknown number leaves its field empty.
    let known = |number: f64| if number.is_finite() { CsvValue::Number(number) } else { CsvValue::Nothing };
    match cell {
        Cell::Text(text) => vec![as_text(text)],
        Cell::List(_) | Cell::Sentences(_) | Cell::Tire(_) | Cell::Cable(_) => vec![as_text(&cell.label(0))],
        Cell::Verdict(verdict) => vec![as_text(verdict.verdict().for_scripts())],
        Cell::Flag(flag) => vec![CsvValue::Flag(*flag)],
        Cell::Count(count) => vec![CsvValue::Count(*count)],
        Cell::Factor(factor) => vec![known(*factor)],
        Cell::Estimate { value, error, .. } => vec![CsvValue::Number(*value), known(*error)],
        numbers => numbers.numbers().into_iter().map(CsvValue::Number).collect(),
    }
}

/// The fields of a row, one per key.
fn fields(table: &Table, row: &Row) -> Vec<CsvValue> {
    let mut fields = Vec::new();
    for (column, cell) in table.columns.iter().zip(&row.cells).filter(|(column, _)| !column.keys.is_empty()) {
        let values = values(cell);
        // A cell without a value leaves all its fields empty; any other cell has a value for each key.
        let empty = vec![CsvValue::Nothing; column.keys.len()];
        let values = if values.is_empty() { empty } else { values };
        assert_eq!(values.len(), column.keys.len(), "{:?}", column.keys);
        fields.extend(
            column.keys.iter().zip(values).filter(|(key, _)| !key.is_empty()).map(|(_, value)| value),
        );
    }
    fields
}
