//! Schema `shelter.trace/1`.

use std::io::{self, Write};

/// The document of a trace, written row by row: a long trace need not fit into memory.
pub struct TraceDocument<W> {
    out: W,
    /// Whether a row is written.
    begun: bool,
}

impl<W: Write> TraceDocument<W> {
    /// Begins the document with the names of its columns.
    pub fn begin(mut out: W, columns: &[String]) -> io::Result<Self> {
        let columns = serde_json::to_string(columns)?;
        write!(out, "{{ \"schema\": \"shelter.trace/1\", \"columns\": {columns}, \"rows\": [")?;
        Ok(Self { out, begun: false })
    }

    /// Writes a row, one number a column.
    pub fn row(&mut self, row: &[f64]) -> io::Result<()> {
        let comma = if std::mem::replace(&mut self.begun, true) { "," } else { "" };
        write!(self.out, "{comma}\n  {}", serde_json::to_string(row)?)
    }

    /// Ends the document.
    pub fn end(mut self) -> io::Result<()> {
        writeln!(self.out, "\n] }}")?;
        self.out.flush()
    }
}
