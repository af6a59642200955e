//! `shelter merge`: the shards of a study joined.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{FormatArg, LookArguments};
use super::print_sharded::{print_orders, print_risks, print_search};
use super::status::{Status, failed, wrong};
use crate::plan::PlanSource;
use crate::study::judge::judge_from_samples;
use crate::study::merge::{Question, ShardResults, merge};
use crate::study::orders::{rank, refine};
use crate::study::search::search_after;
use crate::study::{Case, Found, Progress};

#[derive(Args)]
pub struct Arguments {
    /// Files that `orders`, `risk` or `search` wrote with --shard, all of them
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let mut shards = Vec::new();
    for file in &arguments.files {
        match std::fs::read_to_string(file) {
            Ok(text) => shards.push((file.display().to_string(), text)),
            Err(error) => return wrong(&format!("cannot read {}: {error}", file.display())),
        }
    }
    let (head, results) = match merge(&shards) {
        Ok(merged) => merged,
        Err(message) => return wrong(&message),
    };
    let case = match Case::parse(PlanSource { path: head.plan.clone(), text: head.text.clone() }) {
        Ok(case) => case,
        Err(mistakes) => return wrong(&mistakes.to_string()),
    };
    if !results.belong_to(&case) {
        return wrong("the shards hold results that do not belong to their plan: one shard is damaged");
    }
    match (head.question, results) {
        // Only all shards together tell which orders may be the worst.
        (Question::Orders { intervals_s, sampling }, ShardResults::Orders(tried)) => {
            let (compute, progress) = (&head.compute, Progress::default());
            let ranked = refine(&case, tried, compute, &progress).and_then(|tried| {
                rank(&case, tried, intervals_s.len(), sampling.as_ref(), compute, &progress)
            });
            match ranked {
                Ok(Found { value: orders, .. }) => {
                    print_orders(&case, &orders, false, arguments.format, look)
                }
                Err(reason) => failed(&reason),
            }
        }
        (Question::Risk { sampling }, ShardResults::Risk(samples)) => {
            match judge_from_samples(&case, &head.compute, &sampling, &samples, &Progress::default()) {
                Ok(results) => print_risks(&case, &results, &sampling, false, arguments.format, look),
                Err(reason) => failed(&reason),
            }
        }
        (Question::Search { sampling }, ShardResults::Search(tried)) => {
            let (compute, progress) = (&head.compute, Progress::default());
            match search_after(&case, &tried, sampling.as_ref(), compute, &progress) {
                Ok(Found { value: found, .. }) => print_search(&case, &found, false, arguments.format, look),
                Err(reason) => failed(&reason),
            }
        }
        _ => wrong("the shards do not fit together"),
    }
}
