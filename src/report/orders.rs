//! `orders` as a report: one row per order, from the worst to the best.

use super::brief::Brief;
use super::charts;
use super::check::{NOTHING_VARIED, pass_caveat};
use super::parts::{Block, Cell, Column, Conclusion, Field, Offer, Report, Table, fact};
use super::shared_columns::{
    FAILURES, FORCE, HEIGHT, INTERVAL, NOMINAL_VERDICT, PROBABILITY, SAMPLES, VERDICT, failures, force,
    height, probability, sampled, samples,
};
use super::words::assumption_words::thin as thin_words;
use super::words::{plan_notes, warnings};
use super::{judged_facts, report_head, row_names};
use crate::study::orders::{Orders, TriedOrder};
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::search::Schedule;
use crate::study::{Case, Computed};
use crate::verdict::{Verdict, VerdictWord};

/// An order with its place in the ranking.
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
        self.orders.judged(self.n).risk.known()
    }
}

/// Columns of the table. Without samples only JSON shows the columns that samples fill.
fn fields<'a>(has_risk: bool) -> [Field<RankedOrder<'a>>; 9] {
    let sampled = |column: Column| if has_risk { column } else { column.json_only() };
    [
        Field::new(Column::words(&["order"], "order"), |row| row_names(row.case, &row.tried().order).into()),
        Field::new(INTERVAL, |row| Cell::Interval(row.tried().interval.seconds())),
        Field::new(VERDICT, |row| row.orders.word(row.n).into()),
        Field::new(HEIGHT, |row| height(row.tried().planned.values.height)),
        Field::new(FORCE, |row| force(row.tried().planned.values.force)),
        Field::new(SAMPLES, |row| samples(row.risk())),
        Field::new(sampled(FAILURES), |row| failures(row.risk())),
        Field::new(sampled(PROBABILITY), |row| probability(row.risk())),
        Field::new(sampled(NOMINAL_VERDICT), |row| row.tried().planned.verdict.into()),
    ]
}

/// Rows at each end that offer their order as an option. No face shows more rows, and there may be millions between.
const OFFERED: usize = 100;

/// Note on which orders are sampled.
const RANKING: &str = "in order of the planned shots; both ends are sampled, the worst, the best and what fails most often in full";

/// The report of all orders tried. It is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Orders>) -> Report {
    let Computed { value: orders, partial } = found;
    let count = orders.ranked.len();
    let head = match orders.complete {
        true => format!("{count} orders and intervals, all there are, worst first"),
        false => format!("{count} orders searched: the worst may not be among them, worst first"),
    };
    let mut heads: Vec<String> =
        [head].into_iter().chain(plan_notes::hole_timing(case, &orders.holes)).collect();
    let planned = case.plan.intervals(Some(orders.holes));
    if orders.ranked.iter().all(|tried| planned.contains(&tried.interval)) {
        heads.extend(plan_notes::options_left_out(case));
    }
    if orders.has_risk() {
        heads.push(RANKING.to_owned());
    }
    let fields = fields(orders.has_risk());
    let row = |n: usize| RankedOrder { case, orders, n };
    let ranked = |n: Option<usize>| n.map(|n| Cell::object(&fields, &row(n)));
    let offer = |tried: &TriedOrder| {
        let schedule = Schedule::at_interval(&tried.order, tried.interval, orders.holes);
        Offer::Option(schedule.named_option(&case.plan.blast_rows))
    };
    let mut table = Table { ranked: true, key: "ranked", ..Table::of(&fields, (0..count).map(row)) };
    for n in (0..count).filter(|&n| n < OFFERED || n + OFFERED >= count) {
        table.rows[n].offer = Some(offer(&orders.ranked[n]));
    }
    let so_far = if *partial { " so far" } else { "" };
    let planned = if orders.has_risk() { " as planned" } else { NOTHING_VARIED };
    // Where no order can pass, "pass" would contradict the verdict before it.
    let pass = if case.plan.uncertainty.launch_is_estimated() { "keep every limit" } else { "pass" };
    let mut text = format!("{} of {count} orders {pass}{planned}{so_far}", orders.passing_as_planned());
    text.extend(by_shots(orders).map(|(count, what)| format!("; by shots {count} {what}")));
    text.extend(orders.has_risk().then(|| pass_caveat(case, true)));
    if let Some((n, best)) = orders.ranked.iter().enumerate().next_back() {
        let (order, interval) = (row_names(case, &best.order).join(" "), best.interval);
        text += &format!("; the best as planned, {order} at {interval} ms: {}", orders.word(n).for_people());
        text.extend(orders.thin(n).map(|thin| format!(", {}", thin_words(thin))));
        text.extend(orders.judged(n).risk.known().map(|risk| format!(", {}", sampled(risk))));
    }
    let picture = charts::orders(case, orders);
    let tried = orders.ranked.iter().map(|tried| &tried.planned);
    let best = orders.ranked.last().map(|best| &best.planned);
    let mut report = report_head(case, "shelter.orders/1", orders.has_risk());
    let verdict = found.verdict();
    let facts = vec![
        fact(&["count"], count),
        fact(&["complete"], orders.complete),
        fact(&["nominal_passing"], orders.passing_as_planned()),
        fact(&["worst"], ranked((count > 0).then_some(0))),
        fact(&["best"], ranked(count.checked_sub(1))),
    ];
    report.blocks.extend([
        Block::Facts(judged_facts(case, verdict, orders.has_risk(), *partial)),
        Block::Facts(facts),
        Block::Text(heads),
        Block::Table(table),
        Block::Picture(picture),
    ]);
    report.warnings.extend(warnings::count_uncovered("orders and intervals", tried));
    let not_sampled = orders.not_sampled();
    report.warnings.extend((not_sampled > 0).then(|| {
        format!(
            "{not_sampled} of {count} orders are not sampled: so that nobody can say that every order passes; check one before it is fired"
        )
    }));
    report.warnings.extend(best.and_then(|best| warnings::uncovered_shot("the best order", best)));
    let is_thin = verdict == Verdict::Pass && orders.has_thin();
    let thin_worst = orders.thin(0).filter(|_| is_thin && count > 1);
    text.extend(thin_worst.map(|thin| format!("; the worst passes thinly: {}", thin_words(thin))));
    let word = if is_thin { VerdictWord::Thin } else { verdict.into() };
    report.conclusion = Some(Conclusion::new(word, text));
    report
}

/// Number of orders that pass as planned but fail or are open by their sampled shots, and which of both; `None` where there are
/// none.
fn by_shots(orders: &Orders) -> Option<(String, &'static str)> {
    let passes = |n: &usize| orders.ranked[*n].planned.verdict == Verdict::Pass;
    let count = |verdict| {
        let of_verdict = |n: &usize| passes(n) && orders.judged(*n).verdict() == verdict;
        (0..orders.ranked.len()).filter(of_verdict).count()
    };
    match (count(Verdict::Fail), count(Verdict::Undecided)) {
        _ if !orders.has_risk() => None,
        (0, 0) => None,
        (0, open) => Some((open.to_string(), "are open")),
        (fail, 0) => Some((fail.to_string(), "fail")),
        // Orders far from both ends have few samples, or none.
        (fail, _) => Some((format!("at least {fail}"), "fail")),
    }
}

/// Number of orders that pass, as planned and by sampled shots, and the worst order, in one line.
pub fn in_brief(case: &Case, orders: &Computed<Orders>) -> Brief {
    let Computed { value: found, .. } = orders;
    let (planned, all) = (found.passing_as_planned(), found.ranked.len());
    let by_shots = by_shots(found);
    let text = match orders.verdict() {
        Verdict::Pass => format!("every order passes, all {all}"),
        // The sampled shots decide.
        _ => match &by_shots {
            Some((count, what)) => {
                format!("{count} of {all} orders {what} by shots; {planned} pass as planned")
            }
            None => format!("{planned} of {all} orders pass as planned"),
        },
    };
    let worst =
        found.ranked.first().map(|worst| format!("; worst {}", row_names(case, &worst.order).join("-")));
    let fewest = match by_shots {
        Some((count, what)) => {
            [" by shots", ""].map(|by_shots| format!("{count} of {all} orders {what}{by_shots}"))
        }
        None => ["orders ", ""].map(|orders| format!("{planned} of {all} {orders}pass as planned")),
    };
    let texts = [format!("{text}{}", worst.unwrap_or_default()), text].into_iter().chain(fewest).collect();
    Brief::judged(orders.verdict(), texts)
        .drawn_as(charts::shares_along(&charts::orders(case, found), f64::max))
}
