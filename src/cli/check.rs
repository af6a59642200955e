//! `shelter check`: pass or fail of every delay option.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::judge_plans::{judge_plans, print_judged_plans};
use super::load_plans::open_all;
use super::status::{Status, failed};
use crate::report::words::option_sentences::VERDICTS;
use crate::study::check;
use crate::study::judge::recommend::MustPass;

#[derive(Args)]
#[command(after_help = VERDICTS.join("\n"))]
pub struct Arguments {
    /// Plans to check; `-` reads standard input
    #[arg(value_name = "PLAN", required = true)]
    plans: Vec<PathBuf>,
    #[command(flatten)]
    study: StudyArguments,
    /// One passing option is enough
    #[arg(long)]
    any: bool,
    /// For each option that does not pass: the nearest changes of the plan with which it would
    #[arg(long)]
    why: bool,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(cases) = open_all(&arguments.plans, look) else { return Ok(Status::Wrong) };
    let must_pass = if arguments.any { MustPass::One } else { MustPass::Every };
    let question = check::Question { must_pass, why: arguments.why };
    match judge_plans(cases, arguments.study.verdict.sampling(), &arguments.study.compute, &question) {
        Ok(plans) => print_judged_plans(&plans, arguments.study.format, look),
        Err(reason) => failed(&reason),
    }
}
