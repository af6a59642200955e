//! `shelter report`: one page for the blast file.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Compute, Look, Status, check, load, long};
use crate::plan::edit;
use crate::report;
use crate::verdict::Verdict;

#[derive(Args)]
pub struct Arguments {
    /// Plan to report; `-` reads standard input
    plan: PathBuf,
    /// Page to write; `-` writes it to standard output
    #[arg(short, long, value_name = "FILE.html")]
    output: PathBuf,
    #[command(flatten)]
    compute: Compute,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some(cases) = load::cases([&arguments.plan], look) else { return Ok(Status::Wrong) };
    let Arguments { plan, output, .. } = arguments;
    let same = |a: &Path, b: &Path| a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
    if same(plan, output) {
        return load::wrong(&format!("{} is the plan itself: give the page another name", output.display()));
    }
    let mut judged = match check::all(&cases, &arguments.compute) {
        Ok(judged) => judged,
        Err(failure) => return long::failed(&failure),
    };
    let (case, results) = (&cases[0], judged.remove(0));
    let page = report::html::page(case, &results, &report::html::today());
    if output.as_os_str() == "-" {
        long::print(&page)?;
    } else {
        edit::save(output, &page)?;
        eprintln!("wrote {}", output.display());
    }
    let passed = report::check::verdict(&results, false) == Verdict::Pass;
    Ok(if passed { Status::Pass } else { Status::Fail })
}
