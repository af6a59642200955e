//! `shelter merge`: joins the shards of a study.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{FormatArg, LookArguments};
use super::ask::Answered;
use super::status::{Status, failed, wrong};
use crate::file::read;
use crate::kept;
use crate::study::merge::{MergeFailure, Merged, merge};
use crate::study::observed::objection::compare_record;
use crate::study::observed::{Comparison, NotCompared, ObservationRecord};
use crate::study::standing::Standing;
use crate::study::{FileState, StudyControl};

#[derive(Args)]
pub struct Arguments {
    /// Files that `orders`, `risk` or `search` saved with --shard, all of them
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let mut shards = Vec::new();
    for file in &arguments.files {
        match read(file) {
            Ok(text) => shards.push((file.display().to_string(), text)),
            Err(error) => return wrong(&format!("cannot read {}: {error}", file.display())),
        }
    }
    match merge(&shards) {
        Ok(Merged { case, file, asked, found, paths }) => {
            let compared = match file {
                FileState::Gone => Comparison::not_compared(NotCompared::NoPlan),
                FileState::AsJudged | FileState::Changed | FileState::Pipe => {
                    let mut record = ObservationRecord::default();
                    paths.iter().for_each(|path| record.join(kept::find_record(path.as_ref())));
                    compare_record(&asked.context(&case, &StudyControl::default()), &record)
                }
            };
            let standing = Standing::of(&case, file, compared);
            let is_step_fixed = asked.is_step_fixed();
            Answered { case, standing, found, is_step_fixed }.print(arguments.format, look)
        }
        Err(MergeFailure::Shards(message)) => wrong(&message),
        Err(MergeFailure::NoResult(reason)) => failed(&reason),
    }
}
