//! `orders` as a report: one row an order, from the worst to the best.

use super::charts;
use super::model::{Block, Cell, Column, Conclusion, Report, Table};
use super::shared_columns::{
    FAILURES, FORCE, HEIGHT, INTERVAL, NOMINAL_VERDICT, PROBABILITY, VERDICT, failures, force, height,
    probability, sampled,
};
use super::{report_head, row_names};
use crate::study::Case;
use crate::study::orders::Orders;
use crate::verdict::Verdict;

const COLUMNS: [Column; 5] = [Column::words(&["order"], "order"), INTERVAL, VERDICT, HEIGHT, FORCE];

/// How far the samples reach.
const RANKING: &str =
    "ranked as planned; the worst and the best are sampled a little, the very best until its verdict is sure";

/// With samples.
const SAMPLED: [Column; 3] = [FAILURES, PROBABILITY, NOMINAL_VERDICT];

/// The report of all orders tried, which is partial where the time was up.
pub fn report(case: &Case, orders: &Orders, partial: bool) -> Report {
    let all = orders.ranked.len();
    let head = match orders.complete {
        true => format!("{all} orders and intervals, all there are, worst first"),
        false => format!("{all} orders searched: the worst may not be among them, worst first"),
    };
    let mut heads = vec![head];
    if orders.has_risk() {
        heads.push(RANKING.to_owned());
    }
    let row = |n: usize| {
        let tried = &orders.ranked[n];
        let mut cells = vec![
            Cell::Text(row_names(case, &tried.order).join(" ")),
            Cell::Interval(tried.interval),
            Cell::Verdict(orders.verdict_on(n)),
            height(tried.as_planned.height),
            force(tried.as_planned.force),
        ];
        if orders.has_risk() {
            let risk = orders.risk(n).drawn().copied();
            cells.extend([failures(risk), probability(risk), Cell::Verdict(tried.as_planned.verdict)]);
        }
        cells
    };
    let columns = [&COLUMNS[..], if orders.has_risk() { &SAMPLED } else { &[] }].concat();
    let table = Table { ranked: true, ..Table::new(&columns, (0..all).map(row)) };
    let verdict = match orders.verdict() {
        Verdict::Pass if partial => Verdict::Undecided,
        verdict => verdict,
    };
    let so_far = if partial { " so far" } else { "" };
    let planned = if orders.has_risk() { " as planned" } else { " (the plan's own numbers only)" };
    let mut text = format!("{} of {all} orders pass{planned}{so_far}", orders.passing_as_planned());
    if let Some((n, risk)) = all.checked_sub(1).and_then(|n| Some((n, *orders.risk(n).drawn()?))) {
        text += &format!("; the best: {}, {}", orders.verdict_on(n).label(), sampled(risk));
    }
    let picture = charts::orders(case, orders);
    Report {
        blocks: vec![Block::Text(heads), Block::Table(table), Block::Picture(picture)],
        conclusion: Some(Conclusion { verdict, text }),
        ..report_head(case, orders.has_risk())
    }
}
