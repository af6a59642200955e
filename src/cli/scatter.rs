//! `shelter scatter`: how often each option fails.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::long::Finished;
use super::merge::{self, Answer};
use super::{Compute, FormatArg, Look, Status, load, long};
use crate::report;
use crate::study::merge::{Findings, Question};
use crate::study::scatter::{Draw, scatter, swaps};
use crate::study::{NoResult, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to study, with a section [scatter]; `-` reads standard input
    plan: PathBuf,
    #[command(flatten)]
    draw: DrawArguments,
    /// This machine's share; `shelter merge` joins the shares
    #[arg(long, value_name = "I/N", value_parser = long::shard, conflicts_with_all = ["until_certain", "timeout", "format"])]
    shard: Option<Shard>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
    #[command(flatten)]
    compute: Compute,
}

/// How many samples, from which seed.
#[derive(Args, Clone, Copy)]
pub struct DrawArguments {
    /// Samples of every option; default: 1000
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    samples: Option<u32>,
    /// Of the random numbers; default: 1
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Stop an option once it certainly fails less, or more, often than this [%; 1 where none is given]
    #[arg(long, value_name = "PERCENT", num_args = 0..=1, default_missing_value = "1", value_parser = percent)]
    until_certain: Option<f64>,
}

impl DrawArguments {
    pub fn draw(self) -> Draw {
        Draw {
            samples: self.samples.unwrap_or(1000) as usize,
            seed: self.seed.unwrap_or(1),
            certain_at: self.until_certain.map(|percent| percent * 1e-2),
        }
    }

    /// Whether any of it was asked for.
    pub fn is_given(self) -> bool {
        self.samples.is_some() || self.seed.is_some() || self.until_certain.is_some()
    }
}

fn percent(text: &str) -> Result<f64, String> {
    super::positive(text)
        .and_then(|value| if value < 100.0 { Ok(value) } else { Err("must be less than 100".to_owned()) })
}

/// Samples of all options together, some 100 bytes each.
const MOST_SAMPLES: usize = 20_000_000;

/// A swap of rows is worth a warning from this probability on.
pub const SWAP: f64 = 1e-4;

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some(case) = load::cases([&arguments.plan], look).and_then(|mut cases| cases.pop()) else {
        return Ok(Status::Wrong);
    };
    let Some(spec) = case.plan.scatter else { return long::failed(&NoResult::NoScatter) };
    for swap in swaps(&case, &spec, SWAP) {
        eprintln!("warning: {}", report::scatter::warning(&case, &swap));
    }
    let draw = arguments.draw.draw();
    if draw.samples.saturating_mul(case.shots.len()) > MOST_SAMPLES {
        let words =
            format!("more than {MOST_SAMPLES} samples of all options do not fit into memory: take fewer");
        return load::wrong(&words);
    }
    let (settings, shard) = (arguments.compute.settings(&case.plan), arguments.shard.unwrap_or(Shard::WHOLE));
    let samples =
        long::run(&arguments.compute, |progress| scatter(&case, &spec, &draw, shard, &settings, progress));
    match samples {
        Err(failure) => long::failed(&failure),
        Ok(Finished { value: samples, partial }) => {
            let question = Question::Scatter { spec, draw };
            let answer =
                Answer { case: &case, question, settings, findings: Findings::Scatter(samples), partial };
            merge::print(answer, arguments.shard, arguments.format, look)
        }
    }
}
