//! Quantities over time: the columns and the document of `trace`, and the rows of a history.

use std::io::{self, Write};

use super::parts::{Block, Cell, Column, Report, Table};
use crate::outcome::History;
use crate::scene::Scene;
use crate::study::trace::TracedItems;
use crate::units::Unit;

/// Column names: time, then the quantities of each tire and each cable, with the address as in the plan.
pub fn header(scene: &Scene, chosen: &TracedItems) -> Vec<String> {
    let mut names = vec!["t_s".to_owned()];
    for &tire in &chosen.tires {
        let id = scene.tire_ids[tire];
        let quantities = ["x_m", "y_m", "height_m", "friction_n", "friction_limit_n"];
        names.extend(quantities.map(|quantity| format!("{quantity}[{id}]")));
    }
    names.extend(chosen.cables.iter().map(|&cable| format!("force_n[{}]", scene.cable_name(cable))));
    names
}

const HISTORY: [Column; 4] = [
    Column::numbers(&["from_s"], "from", Unit::One),
    Column::numbers(&["to_s"], "to", Unit::One),
    Column::numbers(&["flight_height_m"], "height", Unit::Metre),
    Column::numbers(&["cable_force_n"], "force", Unit::Kilonewton),
];

/// The report of a history: greatest height and force of each stretch of time.
pub fn history(history: &History) -> Report {
    let row = |(n, (&height, &force)): (usize, (&f64, &f64))| {
        let [from, to] = [n, n + 1].map(|n| Cell::Time(n as f64 * history.width));
        vec![from, to, Cell::Value(height, Unit::Metre), Cell::Value(force, Unit::Kilonewton)]
    };
    let rows = history.height.iter().zip(&history.force).enumerate().map(row);
    Report { blocks: vec![Block::Table(Table::new(&HISTORY, rows))], ..Report::default() }
}

/// The document of a trace, written row by row: a long trace may not fit into memory.
pub struct TraceDocument<W> {
    out: W,
    /// Whether a row was written.
    begun: bool,
}

impl<W: Write> TraceDocument<W> {
    /// Begins the document with the names of its columns.
    pub fn begin(mut out: W, columns: &[String]) -> io::Result<Self> {
        let columns = serde_json::to_string(columns)?;
        write!(out, "{{ \"schema\": \"shelter.trace/1\", \"columns\": {columns}, \"rows\": [")?;
        Ok(Self { out, begun: false })
    }

    /// Writes a row, one number per column.
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
