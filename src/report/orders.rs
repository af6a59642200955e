//! `orders` as a report: one row an order, from the worst to the best.

use super::charts;
use super::model::{Block, Cell, Column, Conclusion, Report, Table};
use super::shared_columns::{FORCE, HEIGHT, INTERVAL, VERDICT, force, height};
use super::{limit_facts, row_names};
use crate::study::Case;
use crate::study::orders::{Orders, Tried};
use crate::verdict::Verdict;

const COLUMNS: [Column; 5] = [Column::words(&["order"], "order"), INTERVAL, VERDICT, HEIGHT, FORCE];

/// The report of all orders tried, which is partial where the time was up.
pub fn report(case: &Case, orders: &Orders, partial: bool) -> Report {
    let all = orders.ranked.len();
    let head = match orders.complete {
        true => format!("{all} orders and intervals, all there are, worst first"),
        false => format!("{all} orders searched: the worst may not be among them, worst first"),
    };
    let row = |tried: &Tried| {
        vec![
            Cell::Text(row_names(case, &tried.order).join(" ")),
            Cell::Interval(tried.interval),
            Cell::Verdict(tried.envelope.verdict),
            height(tried.envelope.height),
            force(tried.envelope.force),
        ]
    };
    let table = Table { ranked: true, ..Table::new(&COLUMNS, orders.ranked.iter().map(row)) };
    let verdict = match orders.verdict() {
        Verdict::Pass if partial => Verdict::Undecided,
        verdict => verdict,
    };
    let text = format!("{} of {all} orders pass{}", orders.passing(), if partial { " so far" } else { "" });
    let picture = charts::orders(case, orders);
    Report {
        blocks: vec![Block::Text(vec![head]), Block::Table(table), Block::Picture(picture)],
        conclusion: Some(Conclusion { verdict, text }),
        ..limit_facts(case)
    }
}
