//! `orders` as a report: one row an order, from the worst to the best.

use super::charts;
use super::check::NOTHING_VARIED;
use super::parts::{Block, Cell, Column, Conclusion, Field, Offer, Report, Table};
use super::shared_columns::{
    FAILURES, FORCE, HEIGHT, INTERVAL, NOMINAL_VERDICT, PROBABILITY, VERDICT, failures, force, height,
    probability, sampled,
};
use super::words::{plan_notes, warnings};
use super::{report_head, row_names};
use crate::study::orders::{Orders, TriedOrder};
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::search::Schedule;
use crate::study::{Case, Computed};

/// An order and its place in the ranking.
struct RankedOrder<'a> {
    case: &'a Case,
    orders: &'a Orders,
    n: usize,
}

impl<'a> RankedOrder<'a> {
    fn tried(&self) -> &'a TriedOrder {
        &self.orders.ranked[self.n]
    }

    fn risk(&self) -> Option<&'a RiskSummary> {
        self.orders.risk(self.n).known().copied()
    }
}

fn fields<'a>() -> [Field<RankedOrder<'a>>; 5] {
    [
        Field::new(Column::words(&["order"], "order"), |row| {
            Cell::Text(row_names(row.case, &row.tried().order).join(" "))
        }),
        Field::new(INTERVAL, |row| Cell::Interval(row.tried().interval.seconds())),
        Field::new(VERDICT, |row| Cell::Verdict(row.orders.verdict_on(row.n))),
        Field::new(HEIGHT, |row| height(row.tried().planned.height)),
        Field::new(FORCE, |row| force(row.tried().planned.force)),
    ]
}

/// What samples add.
fn sampled_fields<'a>() -> [Field<RankedOrder<'a>>; 3] {
    [
        Field::new(FAILURES, |row| failures(row.risk())),
        Field::new(PROBABILITY, |row| probability(row.risk())),
        Field::new(NOMINAL_VERDICT, |row| Cell::Verdict(row.tried().planned.verdict)),
    ]
}

/// Rows at each end that offer their order as an option: no face shows more, and there may be millions between.
const OFFERED: usize = 100;

/// How far the samples reach.
const RANKING: &str = "ranked as planned; the worst and the best get a few samples, those that decide as many as their verdict takes";

/// The report of all orders tried, which is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Orders>) -> Report {
    let Computed { value: orders, partial } = found;
    let count = orders.ranked.len();
    let head = match orders.complete {
        true => format!("{count} orders and intervals, all there are, worst first"),
        false => format!("{count} orders searched: the worst may not be among them, worst first"),
    };
    let mut heads: Vec<String> = [head].into_iter().chain(plan_notes::hole_timing(case)).collect();
    let planned = case.intervals();
    if orders.ranked.iter().all(|tried| planned.contains(&tried.interval)) {
        heads.extend(plan_notes::options_left_out(case));
    }
    if orders.has_risk() {
        heads.push(RANKING.to_owned());
    }
    let mut fields = Vec::from(fields());
    if orders.has_risk() {
        fields.extend(sampled_fields());
    }
    let rows = (0..count).map(|n| RankedOrder { case, orders, n });
    let offer = |tried: &TriedOrder| {
        let schedule = Schedule::at_interval(case, &tried.order, tried.interval);
        Offer::Option(schedule.named_option(&case.plan.blast_rows))
    };
    let mut table = Table { ranked: true, ..Table::of(&fields, rows) };
    for n in (0..count).filter(|&n| n < OFFERED || n + OFFERED >= count) {
        table.rows[n].offer = Some(offer(&orders.ranked[n]));
    }
    let so_far = if *partial { " so far" } else { "" };
    let planned = if orders.has_risk() { " as planned" } else { NOTHING_VARIED };
    let mut text = format!("{} of {count} orders pass{planned}{so_far}", orders.passing_as_planned());
    if let Some((n, best)) = orders.ranked.iter().enumerate().next_back() {
        let (order, interval) = (row_names(case, &best.order).join(" "), best.interval);
        text += &format!("; the best, {order} at {interval} ms: {}", orders.verdict_on(n).for_people());
        text.extend(orders.risk(n).known().map(|risk| format!(", {}", sampled(risk))));
    }
    let picture = charts::orders(case, orders);
    let tried = orders.ranked.iter().map(|tried| &tried.planned);
    let best = orders.ranked.last().map(|best| &best.planned);
    let mut report = report_head(case, orders.has_risk());
    report.blocks = vec![Block::Text(heads), Block::Table(table), Block::Picture(picture)];
    report.warnings.extend(warnings::count_uncovered("orders and intervals", tried));
    report.warnings.extend(warnings::uncovered_shot("the best order", best));
    report.conclusion = Some(Conclusion { verdict: case.verdict_on_file(found.verdict()), text });
    report
}
