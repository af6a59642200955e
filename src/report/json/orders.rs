//! Schema `shelter.orders/1`.

use serde::Serialize;

use super::{LimitsObject, SampledValues, Values};
use crate::report::check::judged_inputs;
use crate::report::row_names;
use crate::report::words::warnings;
use crate::study::orders::Orders;
use crate::study::{Case, Computed};

/// The document of all orders tried.
#[derive(Serialize)]
pub struct OrdersDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    judged: &'static str,
    partial: bool,
    limits: LimitsObject,
    count: usize,
    complete: bool,
    /// Number of orders that pass as planned.
    nominal_passing: usize,
    worst: Option<OrderResult>,
    best: Option<OrderResult>,
    ranked: Vec<OrderResult>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct OrderResult {
    order: Vec<String>,
    interval_s: f64,
    #[serde(flatten)]
    values: Values,
    #[serde(flatten)]
    sampled: SampledValues,
}

impl OrdersDocument {
    /// The document of all orders tried, which is partial where the time was up.
    pub fn new(case: &Case, found: &Computed<Orders>) -> Self {
        let Computed { value: orders, partial } = found;
        let result = |n: usize| {
            let tried = &orders.ranked[n];
            OrderResult {
                order: row_names(case, &tried.order),
                interval_s: tried.interval.seconds(),
                values: Values::of(orders.verdict_on(n), &tried.planned),
                sampled: SampledValues::of(tried.planned.verdict, orders.risk(n).known().copied()),
            }
        };
        let count = orders.ranked.len();
        Self {
            schema: "shelter.orders/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: case.verdict_on_file(found.verdict()).for_scripts(),
            judged: judged_inputs(case, orders.has_risk()),
            partial: *partial,
            limits: LimitsObject::of(case),
            count,
            complete: orders.complete,
            nominal_passing: orders.passing_as_planned(),
            worst: (count > 0).then(|| result(0)),
            best: count.checked_sub(1).map(result),
            ranked: (0..count).map(result).collect(),
            warnings: warnings::of_plan(case),
        }
    }
}
