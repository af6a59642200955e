//! `shelter orders`: every firing order, the worst and the best.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals};
use super::ask::{Ask, Refusal};
use super::load_plans::holes_of;
use super::save::SharedArguments;
use super::status::Status;
use crate::study::orders::{self, MOST_ROWS, count_orders, tries_all};
use crate::study::question::Question;
use crate::study::{Case, Intervals};

#[derive(Args)]
pub struct Arguments {
    /// Plan to study; `-` reads standard input
    plan: PathBuf,
    /// Intervals in ms; default: those of the delay options
    #[arg(long, value_name = "FROM..TO:STEP", value_parser = intervals, allow_hyphen_values = true)]
    interval: Option<Intervals>,
    /// Delay option whose holes fire as in every order; needed where the options differ in that
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    #[command(flatten)]
    saved: SharedArguments,
    #[command(flatten)]
    study: StudyArguments,
}

/// Largest number of pairs of order and interval. Each takes some 200 bytes.
const MOST_ORDERS: usize = 5_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let ask = Ask::of_study(&arguments.plan, &arguments.study).shared(&arguments.saved);
    ask.run(look, |case| question(arguments, case))
}

fn question(arguments: &Arguments, case: &Case) -> Result<Question, Refusal> {
    let holes = holes_of(case, arguments.option.as_deref())?;
    let of_plan = || case.plan.intervals(holes);
    let intervals = arguments.interval.map_or_else(of_plan, |interval| interval.values());
    if arguments.saved.shard.is_some() && !tries_all(case) {
        return Err(format!(
            "orders of more than {MOST_ROWS} rows are searched, not shared: leave out --shard"
        )
        .into());
    }
    if tries_all(case) && count_orders(case, intervals.len()) > MOST_ORDERS {
        return Err(format!(
            "more than {MOST_ORDERS} orders and intervals do not fit into memory: take fewer intervals"
        )
        .into());
    }
    Ok(Question::Orders(orders::Question { intervals, holes }))
}
