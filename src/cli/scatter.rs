//! `shelter scatter`: how often each option fails.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{Compute, FormatArg, LookArguments, SamplingArguments, shard};
use super::load_plans::open;
use super::print_findings::{Answer, print_findings};
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::report::notes;
use crate::study::merge::{Findings, Question};
use crate::study::scatter::scatter;
use crate::study::{Found, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to study, whose [uncertainty] says what varies; `-` reads standard input
    plan: PathBuf,
    #[command(flatten)]
    sampling: SamplingArguments,
    /// This machine's share; `shelter merge` joins the shares
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with_all = ["until_certain", "timeout", "format"])]
    shard: Option<Shard>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: Compute,
}

/// Samples of all options together, some 100 bytes each.
const MOST_SAMPLES: usize = 20_000_000;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    let spec = case.plan.uncertainty;
    notes::scatter(&case).iter().for_each(|note| eprintln!("{note}"));
    let sampling = arguments.sampling.sampling();
    if sampling.samples.saturating_mul(case.shots.len()) > MOST_SAMPLES {
        let message =
            format!("more than {MOST_SAMPLES} samples of all options do not fit into memory: take fewer");
        return wrong(&message);
    }
    let (settings, shard) = (arguments.compute.settings(&case.plan), arguments.shard.unwrap_or(Shard::WHOLE));
    let samples = run_study(&arguments.compute, |progress| {
        scatter(&case, &spec, &sampling, shard, &settings, progress)
    });
    match samples {
        Err(reason) => failed(&reason),
        Ok(Found { value: samples, partial }) => {
            let question = Question::Scatter { spec, sampling };
            let answer =
                Answer { case: &case, question, settings, findings: Findings::Scatter(samples), partial };
            print_findings(answer, arguments.shard, arguments.format, look)
        }
    }
}
