//! Splits a list of holes into lines: finds the separator of the values, the header, and the values of each line.

use std::ops::Range;

use super::columns::{Column, meaning};
use crate::plan::diagnostic::Mistake;

/// One line of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Values, without spaces around them.
    pub values: Vec<String>,
    /// Number of the line in the source, from 1.
    pub number: u64,
    /// Bytes of the line in the source.
    pub span: Range<usize>,
    /// Whether a value holds separators and several lines: it may have swallowed holes.
    pub runs_on: bool,
}

/// The lines of a list, from the header on; blank lines are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Whether the first line names the columns.
    pub has_header: bool,
    /// Header and holes.
    pub lines: Vec<Line>,
    /// Lines before the header, each with its bytes in the source.
    pub titles: Vec<(String, Range<usize>)>,
    /// Separator of the values.
    pub separator: u8,
}

/// Characters that may separate values. Of two that fit equally well, the first counts.
const SEPARATORS: [u8; 3] = [b';', b'\t', b','];
/// Number of lines among which the header may be.
const HEADER_WITHIN: usize = 12;

/// Splits the source into lines of values.
pub fn split(source: &str, remedy: &str) -> Result<Table, Vec<Mistake>> {
    let wrong = |message: String| vec![Mistake { span: 0..0, message, remedy: remedy.to_owned() }];
    // Spreadsheets write the separator into a line of its own.
    let declared = source.lines().next().and_then(|line| line.trim().strip_prefix("sep="));
    let tried: Vec<u8> = match declared.map(str::as_bytes) {
        Some([]) => vec![b'\t'],
        Some(bytes) => vec![bytes[0]],
        None => SEPARATORS.to_vec(),
    };
    let mut found: Option<(usize, Vec<Line>, u8)> = None;
    for &separator in &tried {
        let lines =
            lines(source, separator).map_err(|error| wrong(format!("the table cannot be read: {error}")));
        let Ok(lines) = lines else { continue };
        let names_both = |line: &Line| {
            let named = |column| line.values.iter().any(|name| meaning(name).column() == Some(column));
            named(Column::X) && named(Column::Y)
        };
        let header = lines.iter().take(HEADER_WITHIN).position(names_both);
        if let Some(at) = header.filter(|&at| found.as_ref().is_none_or(|(best, ..)| at < *best)) {
            found = Some((at, lines, separator));
        }
    }
    if let Some((at, mut all, separator)) = found {
        let title = |line: &Line| {
            let text = source.get(line.span.clone()).unwrap_or_default();
            (text.replace(char::is_control, " "), line.span.clone())
        };
        if let Some(line) = all[..at].iter().find(|line| line.runs_on) {
            let message = "a value above the header runs over several lines, and may hold holes".to_owned();
            return Err(vec![Mistake {
                span: line.span.clone(),
                message,
                remedy: "write it in one line, or remove it; is a quotation mark missing?".to_owned(),
            }]);
        }
        let titles = all[..at].iter().map(title).filter(|(title, _)| !title.starts_with("sep=")).collect();
        return Ok(Table { has_header: true, lines: all.split_off(at), titles, separator });
    }
    // No line names x and y: the list has no header, or the user must correct the header.
    let first = source.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let fits = |separator: &u8| first.contains(char::from(*separator));
    let separator = tried.iter().copied().find(fits).unwrap_or(b',');
    let mut lines =
        lines(source, separator).map_err(|error| wrong(format!("the table cannot be read: {error}")))?;
    if declared.is_some() && !lines.is_empty() {
        lines.remove(0);
    }
    let is_name = |value: &String| super::number::value(value, true).is_none();
    let has_header = lines.first().is_some_and(|line| line.values.iter().all(is_name));
    Ok(Table { has_header, lines, titles: Vec::new(), separator })
}

/// Largest number of values in a table: a list of 50,000 holes with twenty columns.
const MOST_VALUES: usize = 1_000_000;

/// The lines of a table that are not blank, split at `separator`; or why they cannot be read, in words.
pub fn lines(source: &str, separator: u8) -> Result<Vec<Line>, String> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(source.as_bytes());
    let (mut lines, mut values) = (Vec::new(), 0);
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        // A hole has a name and two coordinates. With a wrong separator a line may be one value, but takes as much memory as a hole.
        values += record.len().max(3);
        if values > MOST_VALUES {
            return Err(format!(
                "it has more than {MOST_VALUES} values, as no blast has; is it the right file?"
            ));
        }
        if record.iter().any(|value| !value.is_empty()) {
            lines.push(Line {
                // A plan refuses names with control characters.
                values: record
                    .iter()
                    .map(|value| value.replace(char::is_control, " ").trim().to_owned())
                    .collect(),
                number: record.position().map_or(0, csv::Position::line),
                span: span(&record, source),
                runs_on: record
                    .iter()
                    .any(|value| value.contains(['\n', '\r']) && value.contains(char::from(separator))),
            });
        }
    }
    Ok(lines)
}

fn span(record: &csv::StringRecord, source: &str) -> Range<usize> {
    let start = record.position().map_or(0, |position| position.byte() as usize).min(source.len());
    let line = source.get(start..).unwrap_or_default();
    let skipped = line.len() - line.trim_start().len();
    let end = line.trim_start().find(['\r', '\n']).unwrap_or(line.len() - skipped);
    start + skipped..start + skipped + end
}
