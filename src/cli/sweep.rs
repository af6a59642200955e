//! `shelter sweep`: height, force and risk against the interval between rows.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals};
use super::ask::Ask;
use super::load_plans::{find_option, holes_of};
use super::save::SaveArguments;
use super::status::Status;
use crate::plan::Timing;
use crate::study::question::Question;
use crate::study::{Case, Intervals, sweep};

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

/// Order of the rows in the option of this name; without a name, the order in which the plan lists them.
pub fn swept_order(case: &Case, name: Option<&str>) -> Result<Vec<usize>, String> {
    let option = find_option(case, name)?;
    match (name, &case.plan.delays[option].timing) {
        (None, _) => Ok((0..case.plan.blast_rows.len()).collect()),
        (Some(_), Timing::Interval { order, .. }) => Ok(order.clone()),
        (Some(name), Timing::At(_)) => {
            Err(format!("option '{name}' has firing times of its own, no interval to sweep"))
        }
    }
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Arguments { interval, option, saved, .. } = arguments;
    Ask::of_study(&arguments.plan, &arguments.study).saved(saved).run(look, |case| {
        let order = swept_order(case, option.as_deref())?;
        let holes = holes_of(case, option.as_deref())?;
        Ok(Question::Sweep(sweep::Question { order, intervals: *interval, holes }))
    })
}
