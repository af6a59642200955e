//! `shelter report`: one page for the blast file.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::{Compute, Look, Status, check, load, long};
use crate::report;
use crate::verdict::Verdict;

#[derive(Args)]
pub struct Arguments {
    /// Plan to report; `-` reads standard input
    plan: PathBuf,
    /// Page to write
    #[arg(short, long, value_name = "FILE.html")]
    output: PathBuf,
    #[command(flatten)]
    compute: Compute,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some(cases) = load::cases([&arguments.plan], look) else { return Ok(Status::Wrong) };
    let mut judged = match check::all(&cases, &arguments.compute) {
        Ok(judged) => judged,
        Err(failure) => return long::failed(&failure),
    };
    let (case, results) = (&cases[0], judged.remove(0));
    let page = report::html::page(case, &results, &report::html::today());
    long::save(&arguments.output, &page)?;
    let passed = report::check::verdict(&results, false) == Verdict::Pass;
    Ok(if passed { Status::Pass } else { Status::Fail })
}
