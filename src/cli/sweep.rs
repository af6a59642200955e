//! `shelter sweep`: height, force and risk against the interval between rows.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals};
use super::load_plans::open_option;
use super::print::print;
use super::run_study::run_saved_study;
use super::save::SaveArguments;
use super::status::{Status, failed, wrong};
use crate::plan::Timing;
use crate::report::json::SweepDocument;
use crate::report::sweep::report;
use crate::study::results_file::Question;
use crate::study::sweep::sweep;
use crate::study::{Case, Context, Intervals, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to sweep; `-` reads standard input
    plan: PathBuf,
    /// Intervals in ms; where intervals pass or the curve jumps, intervals between them are tried as well
    #[arg(long, value_name = "FROM..TO:STEP", default_value = "0..500:0.25", value_parser = intervals, allow_hyphen_values = true)]
    interval: Intervals,
    /// Delay option whose order of rows is swept; default: rows in the order listed
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    #[command(flatten)]
    saved: SaveArguments,
    #[command(flatten)]
    study: StudyArguments,
}

/// The rows in the order of the option of this name, or in the order listed.
pub fn swept_order(case: &Case, name: Option<&str>, option: usize) -> Result<Vec<usize>, String> {
    match (name, &case.plan.delays[option].timing) {
        (None, _) => Ok((0..case.plan.blast_rows.len()).collect()),
        (Some(_), Timing::Interval { order, .. }) => Ok(order.clone()),
        (Some(name), Timing::At(_)) => {
            Err(format!("option '{name}' has firing times of its own, no interval to sweep"))
        }
    }
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some((mut case, option)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    let order = match swept_order(&case, arguments.option.as_deref(), option) {
        Ok(order) => order,
        Err(message) => return wrong(&message),
    };
    case.set_hole_timing_of(arguments.option.as_deref());
    let compute = arguments.study.compute.settings(&case.plan);
    let sampling = arguments.study.verdict.sampling();
    let question = Question::Sweep {
        order: order.clone(),
        intervals: arguments.interval,
        option: arguments.option.clone(),
        sampling,
    };
    let journal = match arguments.saved.journal(&case, question, compute, Shard::WHOLE) {
        Ok(journal) => journal,
        Err(message) => return wrong(&message),
    };
    let swept = run_saved_study(&arguments.study.compute, journal, |control| {
        sweep(&Context::new(&case, compute, control).with_sampling(sampling), &order, &arguments.interval)
    });
    match swept {
        Err(reason) => failed(&reason),
        Ok(swept) => {
            let document = || SweepDocument::new(&case, &swept);
            print(&[report(&case, &swept)], document, arguments.study.format, look)
        }
    }
}
