//! `shelter risk`: how likely each option fails, and what decides it.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LookArguments, SamplingArguments};
use super::load_plans::open;
use super::print_sharded::print_risks;
use super::run_study::run_saved_study;
use super::save::SharedArguments;
use super::status::{Status, failed, saved, wrong};
use crate::study::results_file::Question;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::{ShotToSample, run_shard};
use crate::study::{Case, Computed, Context, Journal, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to study, whose [uncertainty] says what is not known; `-` reads standard input
    plan: PathBuf,
    #[command(flatten)]
    sampling: SamplingArguments,
    #[command(flatten)]
    saved: SharedArguments,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: ComputeArguments,
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
    let compute = arguments.compute.settings(&case.plan);
    let journal = match arguments.saved.journal(&case, Question::Risk { sampling }, compute) {
        Ok(journal) => journal,
        Err(message) => return wrong(&message),
    };
    if let Some(shard) = arguments.saved.shard {
        return draw(arguments, &case, &sampling, shard, journal);
    }
    let judge = |control: &_| Context::new(&case, compute, control).with_sampling(sampling).sample_options();
    match run_saved_study(&arguments.compute, journal, judge) {
        Err(reason) => failed(&reason),
        Ok(results) => print_risks(&case, &results, &sampling, arguments.format, look),
    }
}

/// Draws this machine's shard of the samples into the journal.
fn draw(
    arguments: &Arguments,
    case: &Case,
    sampling: &Sampling,
    shard: Shard,
    journal: Journal,
) -> io::Result<Status> {
    let compute = arguments.compute.settings(&case.plan);
    let target = |shot| ShotToSample::new(case, shot, compute, *sampling);
    let targets: Vec<_> = case.shots.iter().map(target).collect();
    let drawn = run_saved_study(&arguments.compute, journal, |control| {
        let drawn = run_shard(&targets, shard, control)?;
        Ok(Computed { value: (), partial: drawn.iter().any(|(_, sample)| sample.is_none()) })
    });
    saved(drawn)
}
