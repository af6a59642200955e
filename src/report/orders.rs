//! The results of `orders`; schema `shelter.orders/1`.

use serde::Serialize;

use super::table::Style;
use crate::study::orders::{Orders, Tried};
use crate::study::{Case, Envelope};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::Verdict;

/// The document of one study.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    limits: super::Limits,
    count: usize,
    complete: bool,
    passing: usize,
    worst: Option<Row>,
    best: Option<Row>,
    ranked: Vec<Row>,
}

/// One order, for JSON.
#[derive(Serialize)]
pub struct Row {
    order: Vec<String>,
    interval_s: f64,
    #[serde(flatten)]
    values: super::Values,
}

/// One order, for CSV.
#[derive(Serialize)]
pub struct Line {
    order: String,
    interval_s: f64,
    verdict: Verdict,
    flight_height_m: f64,
    flight_height_error_m: f64,
    cable_force_n: f64,
    cable_force_error_n: f64,
}

impl Row {
    fn new(case: &Case, tried: &Tried) -> Self {
        Self {
            order: super::row_names(case, &tried.order),
            interval_s: tried.interval,
            values: super::Values::new(&tried.envelope),
        }
    }
}

impl Line {
    /// Of a tried order.
    pub fn new(case: &Case, tried: &Tried) -> Self {
        let Tried { envelope, .. } = tried;
        Self {
            order: super::row_names(case, &tried.order).join(" "),
            interval_s: tried.interval,
            verdict: envelope.verdict,
            flight_height_m: envelope.height.value,
            flight_height_error_m: envelope.height.error,
            cable_force_n: envelope.force.value,
            cable_force_error_n: envelope.force.error,
        }
    }
}

impl Document {
    /// Of all orders tried.
    pub fn new(case: &Case, orders: &Orders, partial: bool) -> Self {
        let row = |tried: &Tried| Row::new(case, tried);
        Self {
            schema: "shelter.orders/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            limits: super::Limits::new(case),
            count: orders.ranked.len(),
            complete: orders.complete,
            passing: orders.passing(),
            worst: orders.ranked.first().map(row),
            best: orders.ranked.last().map(row),
            ranked: orders.ranked.iter().map(row).collect(),
        }
    }
}

/// The ranking for reading, so many orders at each end of it.
pub fn text(case: &Case, orders: &Orders, shown: usize, partial: bool, style: Style) -> String {
    let mut text = super::heading(case);
    let all = orders.ranked.len();
    text += &format!(
        "{all} orders {}, worst first\n\n",
        if orders.complete {
            "and intervals, all there are"
        } else {
            "searched: the worst may not be among them"
        }
    );
    let names = |tried: &Tried| super::row_names(case, &tried.order).join(" ");
    let width = orders.ranked.iter().map(|tried| names(tried).chars().count()).max().unwrap_or(0).max(5);
    text += &format!(
        "{:width$}  {:>8}  {:4}  {:>17}  {:>17}\n",
        "order", "interval", "", "height, m", "force, kN"
    );
    for (n, tried) in orders.ranked.iter().enumerate() {
        if n == shown && all > 2 * shown {
            text += &format!("… {} more\n", all - 2 * shown);
        }
        if n < shown || n + shown >= all {
            let Envelope { height, force, .. } = tried.envelope;
            text += &format!(
                "{:width$}  {:>8}  {}  {:>17}  {:>17}\n",
                names(tried),
                units::milliseconds(tried.interval),
                style.verdict(tried.envelope.verdict),
                value_and_error(height.value, height.error, Unit::Metre),
                value_and_error(force.value, force.error, Unit::Kilonewton),
            );
        }
    }
    let verdict = match orders.verdict() {
        Verdict::Pass if partial => Verdict::Undecided,
        verdict => verdict,
    };
    text += &format!("\n{}: {} of {all} orders pass\n", style.verdict(verdict), orders.passing());
    style.plain(text)
}
