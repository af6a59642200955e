//! Schema `shelter.scatter/1`.

use serde::Serialize;

use super::Limits;
use crate::report::scatter::{failure_share, swap_warning};
use crate::study::Case;
use crate::study::scatter::{Sample, Sampling, Summary, Swap, summary};

/// The document of all samples.
#[derive(Serialize)]
pub struct ScatterDocument {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    limits: Limits,
    samples: usize,
    seed: u64,
    options: Vec<OptionResult>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct OptionResult {
    name: String,
    samples: usize,
    failures: usize,
    undecided: usize,
    probability: Option<f64>,
    interval_95: [f64; 2],
    flight_height_m: Option<Spread>,
    cable_force_n: Option<Spread>,
}

#[derive(Serialize)]
struct Spread {
    p50: f64,
    p95: f64,
    max: f64,
}

impl OptionResult {
    fn new(name: &str, summary: &Summary) -> Self {
        let spread = |[p50, p95, max]: [f64; 3]| (summary.samples > 0).then_some(Spread { p50, p95, max });
        Self {
            name: name.to_owned(),
            samples: summary.samples,
            failures: summary.failures,
            undecided: summary.undecided,
            probability: failure_share(summary),
            interval_95: summary.interval,
            flight_height_m: spread(summary.height),
            cable_force_n: spread(summary.force),
        }
    }
}

impl ScatterDocument {
    /// The document of all samples, which is partial where the time was up.
    pub fn new(case: &Case, sampling: &Sampling, samples: &[Sample], swaps: &[Swap], partial: bool) -> Self {
        let delays = case.plan.delays.iter().enumerate();
        Self {
            schema: "shelter.scatter/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            limits: Limits::of(case),
            samples: sampling.samples,
            seed: sampling.seed,
            options: delays
                .map(|(option, delay)| OptionResult::new(&delay.name, &summary(samples, option)))
                .collect(),
            warnings: swaps.iter().map(|swap| swap_warning(case, swap)).collect(),
        }
    }
}
