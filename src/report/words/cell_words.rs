//! Words of cells, headings and axes, the same in text, page and terminal.

use super::option_sentences;
use crate::report::language::{phrase, say};
use crate::report::parts::{Axis, Block, Cell, Column, Offer, Report, Row, Scale, Table};
use crate::report::spark::sparkline;
use crate::units;

impl Cell {
    /// The cell as people read it. A series gets `bars` bars.
    pub fn label(&self, bars: usize) -> String {
        match self {
            Cell::Nothing | Cell::Object(_) => String::new(),
            Cell::Text(text) => text.clone(),
            Cell::List(cells) => cells.iter().map(|cell| cell.label(bars)).collect::<Vec<_>>().join(" "),
            Cell::Sentences(sentences) => sentences.join("; "),
            Cell::Tire(tire) => tire.to_string(),
            Cell::Cable([from, to]) => format!("{from}-{to}"),
            Cell::Verdict(verdict) => phrase(verdict.for_people()).to_owned(),
            Cell::Flag(flag) => phrase(if *flag { "yes" } else { "no" }).to_owned(),
            Cell::Count(count) => count.to_string(),
            Cell::Number(number) => number.to_string(),
            Cell::Rounded(number, decimals) => units::rounded(*number, *decimals),
            Cell::Estimate { value, error, unit } => units::value_and_error(*value, *error, *unit),
            Cell::Value(value, unit) => units::computed(*value, *unit),
            Cell::Spread(values, unit) => values.map(|value| units::value(value, *unit)).join(" · "),
            Cell::Band([low, _, high], unit) => {
                let [low, high] = [low, high].map(|value| units::value(*value, *unit));
                say!("{low} to {high}", low, high)
            }
            Cell::Time(time) => units::milliseconds(*time),
            Cell::Interval(time) => units::exact_milliseconds(*time),
            Cell::Factor(factor) => units::factor(*factor),
            Cell::Utilization(share) => format!("{} %", units::whole_percent(*share)),
            Cell::RelativeError(share) => units::percent(*share, 4),
            Cell::Probability(interval) => option_sentences::percent_range(*interval),
            Cell::Residual(share) => units::residual(*share),
            Cell::Sparkline { series, top } => sparkline(series, bars, *top),
        }
    }
}

impl Row {
    /// Whether the row contains `filter`, in the columns that readers of text see. `filter` must be in lower case.
    pub fn contains(&self, columns: &[Column], filter: &str) -> bool {
        let seen = columns.iter().zip(&self.cells).filter(|(column, _)| column.shown.is_in_text());
        let words = seen.map(|(_, cell)| cell.label(0)).chain(self.missing.clone());
        words.collect::<Vec<_>>().join(" ").to_lowercase().contains(filter)
    }
}

impl Report {
    /// Changes of the plan that the rows offer; only rows that contain `filter` count.
    pub fn offers(&self, filter: &str) -> Vec<&Offer> {
        let filter = filter.to_lowercase();
        let tables = self.blocks.iter().filter_map(|block| match block {
            Block::Table(table) => Some(table),
            _ => None,
        });
        let rows = tables.flat_map(|table| table.rows.iter().map(move |row| (table, row)));
        let kept = rows.filter(|(table, row)| row.contains(&table.columns, &filter));
        kept.filter_map(|(_, row)| row.offer.as_ref()).collect()
    }
}

impl Table {
    /// Lines above the rows, each with one text per index of `columns`: the headings, and below them the subheadings where there
    /// are any.
    pub fn heading(&self, columns: &[usize]) -> Vec<Vec<String>> {
        let line = |text: fn(&Column) -> String| columns.iter().map(|&n| text(&self.columns[n])).collect();
        let mut lines: Vec<Vec<String>> =
            vec![line(Column::label), line(|column| column.subheading.to_owned())];
        lines.retain(|line| line.iter().any(|text| !text.is_empty()));
        lines
    }
}

impl Column {
    /// Heading with unit: `height, m`.
    pub fn label(&self) -> String {
        with_unit(phrase(self.heading), self.unit)
    }
}

impl Axis {
    /// Name with unit: `interval, ms`.
    pub fn label(&self) -> String {
        with_unit(phrase(self.name), self.unit)
    }

    /// Coordinate of a value [SI]: the number in the unit of the axis, or its logarithm to base 10.
    pub fn coordinate(&self, value: f64) -> f64 {
        let number = value / self.unit.size();
        match self.scale {
            Scale::Linear => number,
            Scale::Logarithmic => number.log10(),
        }
    }

    /// Text of the number at a coordinate.
    pub fn mark(&self, coordinate: f64) -> String {
        match self.scale {
            Scale::Linear => coordinate.to_string(),
            Scale::Logarithmic => units::power_of_ten(coordinate),
        }
    }

    /// Coordinates of both ends.
    pub fn ends(&self) -> [f64; 2] {
        self.range.map(|value| self.coordinate(value))
    }
}

fn with_unit(name: &str, unit: units::Unit) -> String {
    match unit.symbol() {
        "" => name.to_owned(),
        symbol => format!("{name}, {symbol}"),
    }
}
