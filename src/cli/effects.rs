//! `shelter effects`: which physical effects a scene requires.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::ask::Ask;
use super::load_plans::choose_options;
use super::status::Status;
use crate::study::effects;
use crate::study::question::Question;

#[derive(Args)]
pub struct Arguments {
    /// Plan to study; `-` reads standard input
    plan: PathBuf,
    /// Delay option to study, as often as wanted; default: all
    #[arg(long, value_name = "NAME")]
    option: Vec<String>,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let StudyArguments { verdict, compute, format } = &arguments.study;
    let sampling = verdict.exactly(effects::SAMPLES);
    Ask::new(&arguments.plan, compute, sampling, *format).run(look, |case| {
        let options = choose_options(case, &arguments.option)?;
        Ok(Question::Effects(effects::Question { options }))
    })
}
