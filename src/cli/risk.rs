//! `shelter risk`: how likely each option fails, and what decides it.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LookArguments, SamplingArguments};
use super::ask::Ask;
use super::save::SharedArguments;
use super::status::Status;
use crate::study::question::Question;
use crate::study::risk;
use crate::study::samples::sample_count::Sampling;

#[derive(Args)]
pub struct Arguments {
    /// Plan to study, whose [uncertainty] names the unknowns; `-` reads standard input
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

/// Samples of each option if the command line does not state a number.
const SAMPLES: usize = Sampling::OF_RISK.most;
/// Largest number of samples of all options together. Each takes some 150 bytes.
const MOST_SAMPLES: usize = 20_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Arguments { plan, compute, format, saved, .. } = arguments;
    let sampling = arguments.sampling.exactly(SAMPLES);
    Ask::new(plan, compute, Some(sampling), *format).shared(saved).run(look, |case| {
        if sampling.most.saturating_mul(case.shots.len()) > MOST_SAMPLES {
            return Err(format!(
                "more than {MOST_SAMPLES} samples of all options do not fit into memory: take fewer"
            )
            .into());
        }
        Ok(Question::Risk(risk::Question {}))
    })
}
