//! `shelter toy`: how many holes each option fires.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::ask::Ask;
use super::status::Status;
use crate::study::question::Question;
use crate::study::toy;

#[derive(Args)]
pub struct Arguments {
    /// Plan to study; `-` reads standard input
    plan: PathBuf,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    Ask::of_study(&arguments.plan, &arguments.study).run(look, |_| Ok(Question::Toy(toy::Question {})))
}
