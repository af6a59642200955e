//! `shelter assumptions`: what the PASS of an option stands on.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::load_plans::{choose_options, open};
use super::print::print;
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::report::assumptions::report;
use crate::report::json::AssumptionsDocument;
use crate::study::Context;
use crate::study::assumptions::{SAMPLES, find_assumptions_of_passing};

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
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    let options = match choose_options(&case, &arguments.option) {
        Ok(options) => options,
        Err(message) => return wrong(&message),
    };
    let sampling = arguments.study.verdict.exactly(SAMPLES);
    let compute = arguments.study.compute.settings(&case.plan);
    let study = |control: &_| {
        find_assumptions_of_passing(&Context::new(&case, compute, control).with_sampling(sampling), &options)
    };
    match run_study(&arguments.study.compute, study) {
        Err(reason) => failed(&reason),
        Ok(found) => {
            let document = || AssumptionsDocument::new(&case, &found);
            print(&[report(&case, &found)], document, arguments.study.format, look)
        }
    }
}
