//! `--save`: keeps the results of a long study, so that it goes on where it stopped. `--shard`: saves the part of one machine.

use std::path::PathBuf;

use clap::Args;

use super::arguments::shard;
use crate::study::question::Asked;
use crate::study::results_file::{self, Head};
use crate::study::{Case, Journal, Shard};

/// The file of a study's results.
#[derive(Args, Clone)]
pub struct SaveArguments {
    /// File to which results are appended as they come; the same command goes on from it
    #[arg(short = 'o', long, value_name = "FILE")]
    save: Option<PathBuf>,
}

impl SaveArguments {
    /// The journal of a study of `case`, or the reason why its file cannot be used.
    pub fn journal(&self, case: &Case, asked: &Asked, shard: Shard) -> Result<Journal, String> {
        let Some(path) = &self.save else { return Ok(Journal::default()) };
        results_file::open(path, &Head::new(case, asked, shard))
    }
}

/// The file of the results of a study that can be shared.
#[derive(Args, Clone)]
pub struct SharedArguments {
    #[command(flatten)]
    pub file: SaveArguments,
    /// Compute this machine's shard only, into the file of --save; `shelter merge` joins the shards
    #[arg(long, value_name = "I/N", value_parser = shard, requires = "save", conflicts_with = "format")]
    pub shard: Option<Shard>,
}
