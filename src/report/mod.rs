//! Words and numbers for people and scripts: pure functions from study results to text, JSON and CSV.
//!
//! Serialisable mirrors of the results live here, so that nothing below knows of formats. Field names are those that
//! scripts depend on.

pub mod accuracy;
pub mod check;
pub mod ropes;
pub mod spark;
pub mod table;
pub mod trace;

use serde::Serialize;

/// Output format of every command that computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// For reading.
    #[default]
    Text,
    /// One document.
    Json,
    /// One table with a header.
    Csv,
}

/// A JSON document with a line end.
pub fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).unwrap_or_else(|error| format!("\"{error}\""));
    text.push('\n');
    text
}

/// A CSV table; the header is the fields' names.
pub fn csv<T: Serialize>(rows: impl IntoIterator<Item = T>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        if let Err(error) = writer.serialize(row) {
            return format!("{error}\n");
        }
    }
    writer.into_inner().map_or_else(|error| error.to_string(), |bytes| String::from_utf8_lossy(&bytes).into())
}
