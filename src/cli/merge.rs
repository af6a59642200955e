//! `shelter merge`: the shards of a study joined.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{FormatArg, LookArguments};
use super::print_sharded::{print_orders, print_risks, print_search};
use super::status::{Status, failed, wrong};
use crate::file::read;
use crate::study::merge::{MergeFailure, Merged, MergedResult, merge};

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
    let Merged { case, answer } = match merge(&shards) {
        Ok(merged) => merged,
        Err(MergeFailure::Shards(message)) => return wrong(&message),
        Err(MergeFailure::NoResult(reason)) => return failed(&reason),
    };
    match answer {
        MergedResult::Orders(orders) => print_orders(&case, &orders, arguments.format, look),
        MergedResult::Risk(sampling, results) => {
            print_risks(&case, &results, &sampling, arguments.format, look)
        }
        MergedResult::Search(found) => print_search(&case, &found, arguments.format, look),
    }
}
