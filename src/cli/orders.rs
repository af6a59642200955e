//! `shelter orders`: every firing order, the worst and the best.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals};
use super::load_plans::open_option;
use super::print_sharded::print_orders;
use super::run_study::run_saved_study;
use super::save::SharedArguments;
use super::status::{Status, failed, saved, wrong};
use crate::study::orders::{MOST_ROWS, count_orders, orders, tries_all, try_orders};
use crate::study::results_file::Question;
use crate::study::{Computed, Context, Intervals};

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

/// Orders and intervals together, some 200 bytes each.
const MOST_ORDERS: usize = 5_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some((mut case, _)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    case.set_hole_timing_of(arguments.option.as_deref());
    let intervals_s = arguments.interval.map_or_else(|| case.intervals(), |interval| interval.values());
    if arguments.saved.shard.is_some() && !tries_all(&case) {
        return wrong(&format!(
            "orders of more than {MOST_ROWS} rows are searched, not shared: leave out --shard"
        ));
    }
    if tries_all(&case) && count_orders(&case, intervals_s.len()) > MOST_ORDERS {
        let message = format!(
            "more than {MOST_ORDERS} orders and intervals do not fit into memory: take fewer intervals"
        );
        return wrong(&message);
    }
    let compute = arguments.study.compute.settings(&case.plan);
    let sampling = arguments.study.verdict.sampling();
    let (option, intervals) = (arguments.option.clone(), intervals_s.clone());
    let question = Question::Orders { intervals_s: intervals, option, sampling };
    let journal = match arguments.saved.journal(&case, question, compute) {
        Ok(journal) => journal,
        Err(message) => return wrong(&message),
    };
    if let Some(shard) = arguments.saved.shard {
        return saved(run_saved_study(&arguments.study.compute, journal, |control| {
            let tried = try_orders(&Context::new(&case, compute, control), &intervals_s, shard)?;
            Ok(Computed { value: (), partial: tried.partial })
        }));
    }
    let ranked = run_saved_study(&arguments.study.compute, journal, |control| {
        orders(&Context::new(&case, compute, control).with_sampling(sampling), &intervals_s)
    });
    match ranked {
        Err(reason) => failed(&reason),
        Ok(orders) => print_orders(&case, &orders, arguments.study.format, look),
    }
}
