//! `toy` as a report: the holes of each option.

use super::parts::{Block, Cell, Column, Field, Report, Table};
use super::report_head;
use crate::study::{Case, Computed};
use crate::units::Unit;

/// The report of the holes of all options.
pub fn report(case: &Case, found: &Computed<Vec<usize>>) -> Report {
    let fields = [
        Field::new(Column::words(&["name"], "option"), |(name, _): &(&str, usize)| {
            Cell::Text((*name).to_owned())
        }),
        Field::new(Column::numbers(&["holes"], "holes", Unit::One), |&(_, holes)| Cell::Count(holes)),
    ];
    let rows = case.plan.delays.iter().zip(&found.value).map(|(delay, &holes)| (delay.name.as_str(), holes));
    Report {
        blocks: vec![Block::Table(Table::of(&fields, rows).key("options"))],
        ..report_head(case, "shelter.toy/1", false)
    }
}
