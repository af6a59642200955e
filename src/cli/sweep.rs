//! `shelter sweep`: height and force against the interval between rows.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use clap::Args;

use super::long::Finished;
use super::{Compute, FormatArg, Look, Status, load, long};
use crate::plan::Timing;
use crate::report;
use crate::study::Intervals;
use crate::study::sweep::sweep;

#[derive(Args)]
pub struct Arguments {
    /// Plan to sweep; `-` reads standard input
    plan: PathBuf,
    /// Intervals in ms; where the curve jumps, closer ones are tried as well
    #[arg(long, value_name = "FROM..TO:STEP", default_value = "0..500:5", value_parser = long::intervals, allow_hyphen_values = true)]
    interval: Intervals,
    /// Delay option whose order of rows is swept; default: rows in the order listed
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: Compute,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some((case, option)) = load::case_and_option(&arguments.plan, arguments.option.as_deref(), look)
    else {
        return Ok(Status::Wrong);
    };
    let order = match (&arguments.option, &case.plan.delays[option].timing) {
        (None, _) => (0..case.plan.blast_rows.len()).collect(),
        (Some(_), Timing::Interval { order, .. }) => order.clone(),
        (Some(name), Timing::At(_)) => {
            return load::wrong(&format!(
                "option '{name}' has firing times of its own, no interval to sweep"
            ));
        }
    };
    let settings = arguments.compute.settings(&case.plan);
    let swept = long::run(&arguments.compute, |progress| {
        sweep(&case, &order, &arguments.interval, &settings, progress)
    });
    let Finished { value: swept, partial } = match swept {
        Ok(finished) => finished,
        Err(failure) => return long::failed(&failure),
    };
    long::print(&match arguments.format {
        FormatArg::Text => {
            report::sweep::text(&case, &swept, partial, look.style(io::stdout().is_terminal()))
        }
        FormatArg::Json => report::json(&report::sweep::Document::new(&case, &swept, partial)),
        FormatArg::Csv => report::csv(swept.points.iter().map(report::sweep::Row::new)),
    })?;
    let all = swept.windows().len() == 1 && swept.windows()[0] == swept.range();
    Ok(if all && !partial { Status::Pass } else { Status::Fail })
}
