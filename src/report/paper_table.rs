//! The table of the source paper beside ours, as a part of the report of `accuracy`.

use super::parts::{Block, Cell, Column, Table};
use crate::choice::Method;
use crate::study::accuracy::paper_table::{PAPER, PaperRow};
use crate::units::Unit;

const PAPER_COLUMNS: [Column; 7] = [
    Column::numbers(&[], "step", Unit::One),
    Column::numbers(&[], "height", Unit::Metre).under("paper"),
    Column::numbers(&[], "height", Unit::Metre).under("ours"),
    Column::numbers(&[], "force", Unit::Kilonewton).under("paper"),
    Column::numbers(&[], "force", Unit::Kilonewton).under("ours"),
    Column::numbers(&[], "force at 0.16 s", Unit::Kilonewton).under("paper"),
    Column::numbers(&[], "force at 0.16 s", Unit::Kilonewton).under("ours"),
];

/// The table of the source paper beside our values by one method.
pub(super) fn paper_table(method: Method, ours: &[PaperRow]) -> [Block; 2] {
    let title = format!("Table 1 of the source paper, ours ({}) beside it", method.name());
    let printed = |value: f64| match value.is_nan() {
        true => Cell::Text("-".to_owned()),
        false => Cell::Rounded(value, 3),
    };
    let row = |(paper, ours): (&PaperRow, &PaperRow)| {
        vec![
            Cell::Time(paper.step),
            printed(paper.height),
            Cell::Rounded(ours.height, 4),
            printed(paper.force * 1e-3),
            Cell::Rounded(ours.force * 1e-3, 4),
            printed(paper.force_at_160_ms * 1e-3),
            Cell::Rounded(ours.force_at_160_ms * 1e-3, 4),
        ]
    };
    let table = Table::new(&PAPER_COLUMNS, PAPER.iter().zip(ours).map(row));
    [Block::Text(vec![title]), Block::Table(table)]
}
