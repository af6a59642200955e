//! Schema `shelter.orders/1`.

use serde::Serialize;

use super::{Limits, Values};
use crate::report::row_names;
use crate::study::Case;
use crate::study::orders::{Orders, Tried};

/// The document of all orders tried.
#[derive(Serialize)]
pub struct OrdersDocument {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    limits: Limits,
    count: usize,
    complete: bool,
    passing: usize,
    worst: Option<OrderResult>,
    best: Option<OrderResult>,
    ranked: Vec<OrderResult>,
}

#[derive(Serialize)]
struct OrderResult {
    order: Vec<String>,
    interval_s: f64,
    #[serde(flatten)]
    values: Values,
}

impl OrdersDocument {
    /// The document of all orders tried, which is partial where the time was up.
    pub fn new(case: &Case, orders: &Orders, partial: bool) -> Self {
        let result = |tried: &Tried| OrderResult {
            order: row_names(case, &tried.order),
            interval_s: tried.interval,
            values: Values::of(&tried.envelope),
        };
        Self {
            schema: "shelter.orders/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            limits: Limits::of(case),
            count: orders.ranked.len(),
            complete: orders.complete,
            passing: orders.passing(),
            worst: orders.ranked.first().map(result),
            best: orders.ranked.last().map(result),
            ranked: orders.ranked.iter().map(result).collect(),
        }
    }
}
