//! `shelter assumptions`: the assumptions behind the PASS of an option.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::ask::Ask;
use super::load_plans::choose_options;
use super::status::Status;
use crate::study::assumptions;
use crate::study::question::Question;

#[derive(Args)]
pub struct Arguments {
    /// Plan to study; `-` reads standard input
    plan: PathBuf,
    /// Delay option to study, as often as wanted; default: every option that passes
    #[arg(long, value_name = "NAME")]
    option: Vec<String>,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let StudyArguments { verdict, compute, format } = &arguments.study;
    let sampling = verdict.exactly(assumptions::SAMPLES);
    Ask::new(&arguments.plan, compute, sampling, *format).run(look, |case| {
        let options = choose_options(case, &arguments.option)?;
        Ok(Question::AssumptionsOfPassing(assumptions::OfPassing { options }))
    })
}
