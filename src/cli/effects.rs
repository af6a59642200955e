//! `shelter effects`: which physical effects a scene requires.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::load_plans::{choose_options, open};
use super::print::print;
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::report::effects::report;
use crate::report::json::EffectsDocument;
use crate::study::Context;
use crate::study::effects::{SAMPLES, effects};

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
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    let case = match choose_options(&case, &arguments.option) {
        Ok(options) => case.with_options(&options),
        Err(message) => return wrong(&message),
    };
    let sampling = arguments.study.verdict.exactly(SAMPLES);
    let compute = arguments.study.compute.settings(&case.plan);
    match run_study(&arguments.study.compute, |control| {
        effects(&Context::new(&case, compute, control).with_sampling(sampling))
    }) {
        Err(reason) => failed(&reason),
        Ok(found) => {
            let document = || EffectsDocument::new(&case, &found);
            print(&[report(&case, &found)], document, arguments.study.format, look)
        }
    }
}
