//! `shelter orders`: every firing order, the worst and the best.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals, shard};
use super::load_plans::open_option;
use super::print::print_text;
use super::print_sharded::print_orders;
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::study::merge::{Question, ShardResults, write_shard};
use crate::study::orders::{MOST_ROWS, count_orders, orders, tries_all, try_orders};
use crate::study::{Found, Intervals, Shard};

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
    /// This machine's shard; `shelter merge` joins the shards
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with_all = ["timeout", "format"])]
    shard: Option<Shard>,
    #[command(flatten)]
    study: StudyArguments,
}

/// Orders and intervals together, some 200 bytes each.
const MOST_ORDERS: usize = 5_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some((mut case, option)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    if arguments.option.is_some() {
        case.hole_timing = Some(case.plan.delays[option].hole_timing);
    }
    let intervals_s = arguments.interval.map_or_else(|| case.intervals(), |interval| interval.values());
    if arguments.shard.is_some() && !tries_all(&case) {
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
    if let Some(shard) = arguments.shard {
        let tried = run_study(&arguments.study.compute, |progress| {
            try_orders(&case, &intervals_s, shard, &compute, progress)
        });
        return match tried {
            Err(reason) => failed(&reason),
            Ok(Found { value: tried, .. }) => {
                let question = Question::Orders { intervals_s, sampling };
                print_text(&write_shard(&case, question, compute, shard, &ShardResults::Orders(tried))?)?;
                Ok(Status::Pass)
            }
        };
    }
    let ranked = run_study(&arguments.study.compute, |progress| {
        orders(&case, &intervals_s, sampling.as_ref(), &compute, progress)
    });
    match ranked {
        Err(reason) => failed(&reason),
        Ok(Found { value: orders, partial }) => {
            print_orders(&case, &orders, partial, arguments.study.format, look)
        }
    }
}
