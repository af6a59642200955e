//! `shelter report`: one page for the blast file.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Compute, FormatArg, Look, Status, check, load, long};
use crate::file;
use crate::report;
use crate::study::plans::verdict;
use crate::verdict::Verdict;

#[derive(Args)]
pub struct Arguments {
    /// Plan to report; `-` reads standard input
    plan: PathBuf,
    /// Page to write; `-` writes it to standard output
    #[arg(short, long, value_name = "FILE.html")]
    output: PathBuf,
    /// Print what `check` prints as well
    #[arg(long, value_enum)]
    format: Option<FormatArg>,
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
    if output.as_os_str() == "-" && arguments.format.is_some() {
        return load::wrong("page and results cannot both go to standard output: write the page to a file");
    }
    let judged = match check::all(&cases, &arguments.compute) {
        Ok(judged) => judged,
        Err(failure) => return long::failed(&failure),
    };
    let page = report::html::page(&cases[0], &judged[0], &report::html::today());
    if output.as_os_str() == "-" {
        long::print(&page)?;
    } else {
        file::save(output, &page)?;
        eprintln!("wrote {}", output.display());
    }
    if let Some(format) = arguments.format {
        return check::show(&cases, &judged, look, &check::Output { format, any: false });
    }
    let passed = verdict(&judged[0], false) == Verdict::Pass;
    Ok(if passed { Status::Pass } else { Status::Fail })
}
