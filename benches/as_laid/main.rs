//! Are the risks of a shelter "as laid" and a shot "as fired" right? The program's, beside those of a sampler and an integrator of
//! their own.
//!
//! | command | what it compares |
//! |---|---|
//! | `cargo bench --bench as_laid -- unknowns 2000` | one unknown at a time, on `tests/fixtures/amur-three-rows.toml`, "42 ms" |
//! | `cargo bench --bench as_laid -- duds 500` | one dud at each place of the same option, as planned and sampled |
//! | `cargo bench --bench as_laid -- plans 2000` | all unknowns at once, on five plans of other kinds |
//! | `cargo bench --bench as_laid -- offset 20` | the true risk of options that pass, holes by position and the pattern 10 cm off |
//!
//! The number is that of samples, of `offset` that of options. Without a word all of them run, with few samples. The exit status is 1
//! where a share of the program and its independent counterpart disagree.

mod duds;
mod motion;
mod offset;
mod plans;
mod random;
mod sampler;
mod shares;
mod unknowns;

use std::process::ExitCode;

use sampler::Planned;
use shares::Share;
use shelter::scene::Shot;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::{Case, ComputeSettings, StudyControl};

/// Seed of the program's samples, and of those that it is compared with.
const SEED: u64 = 1;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let number = |usual: usize| words.get(1).map_or(usual, |text| text.parse().expect("a number"));
    let agrees = match words.first().map(String::as_str) {
        Some("unknowns") => unknowns::compare(number(2000)),
        Some("duds") => duds::compare(number(500)),
        Some("plans") => plans::compare(number(2000)),
        Some("offset") => offset::judge(number(20), 5000),
        Some(other) => panic!("unknown comparison {other}"),
        None => {
            [unknowns::compare(20), duds::compare(5), plans::compare(50), offset::judge(1, 200)] == [true; 4]
        }
    };
    if agrees { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The samples of the program of which a shot of `case` fails; samples without a result count for neither.
fn share_by_program(case: &Case, shot: &Shot, samples: usize) -> Share {
    let sampling = Sampling::exactly(samples, SEED);
    let target = ShotToSample::new(case, shot, ComputeSettings::of(&case.plan), sampling);
    let sampled = sample_shots(&[target], &StudyControl::default()).expect("samples").value.remove(0);
    let bounds = sampled.bounds;
    Share { failures: bounds.failures, samples: bounds.samples - bounds.undecided }
}

/// Prints both shares of the first option of a plan, as a line of a table; true where they agree.
fn compare_plan(what: &str, case: &Case, samples: usize) -> bool {
    let program = share_by_program(case, &case.shots[0], samples);
    let independent = Planned::new(case, 0, None).share(SEED, samples);
    let agrees = program.agrees_with(independent);
    println!(
        "| {what} | {program} | {independent} | {:.1} | {} |",
        program.deviations_from(independent),
        if agrees { "yes" } else { "NO" }
    );
    agrees
}
