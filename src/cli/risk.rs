//! `shelter risk`: how likely each option fails, and what decides it.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{Compute, FormatArg, LookArguments, SamplingArguments, shard};
use super::load_plans::open;
use super::print::print_text;
use super::print_sharded::print_risks;
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::study::merge::{Question, ShardResults, write_shard};
use crate::study::samples::rounds::{ShotToSample, draw_shard};
use crate::study::samples::sample::OptionSample;
use crate::study::samples::sampling::Sampling;
use crate::study::{Case, Found, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to study, whose [uncertainty] says what is not known; `-` reads standard input
    plan: PathBuf,
    #[command(flatten)]
    sampling: SamplingArguments,
    /// This machine's shard; `shelter merge` joins the shards
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with_all = ["timeout", "format"])]
    shard: Option<Shard>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: Compute,
}

/// Samples of each option where the command line does not say.
const SAMPLES: usize = Sampling::OF_RISK.most;
/// Samples of all options together, some 150 bytes each.
const MOST_SAMPLES: usize = 20_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    let sampling = arguments.sampling.exactly(SAMPLES);
    if sampling.most.saturating_mul(case.shots.len()) > MOST_SAMPLES {
        let message =
            format!("more than {MOST_SAMPLES} samples of all options do not fit into memory: take fewer");
        return wrong(&message);
    }
    if let Some(shard) = arguments.shard {
        return draw(arguments, &case, &sampling, shard);
    }
    let compute = arguments.compute.settings(&case.plan);
    let judge = |progress: &_| case.judge_options(&compute, Some(&sampling), progress);
    match run_study(&arguments.compute, judge) {
        Err(reason) => failed(&reason),
        Ok(Found { value: results, partial }) => {
            print_risks(&case, &results, &sampling, partial, arguments.format, look)
        }
    }
}

/// Draws and prints this machine's shard of the samples.
fn draw(arguments: &Arguments, case: &Case, sampling: &Sampling, shard: Shard) -> io::Result<Status> {
    let compute = arguments.compute.settings(&case.plan);
    let target = |shot| ShotToSample::new(case, shot, compute, *sampling);
    let targets: Vec<_> = case.shots.iter().map(target).collect();
    let drawn = run_study(&arguments.compute, |progress| {
        let drawn = draw_shard(&targets, shard, progress)?;
        let samples =
            drawn.into_iter().filter_map(|(option, sample)| Some(OptionSample { option, sample: sample? }));
        Ok(Found { value: samples.collect(), partial: false })
    });
    match drawn {
        Err(reason) => failed(&reason),
        Ok(Found { value: samples, .. }) => {
            let question = Question::Risk { sampling: *sampling };
            print_text(&write_shard(case, question, compute, shard, &ShardResults::Risk(samples))?)?;
            Ok(Status::Pass)
        }
    }
}
