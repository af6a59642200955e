//! Schema `shelter.risk/1`.

use serde::Serialize;

use super::LimitsObject;
use crate::report::words::warnings;
use crate::study::judge_options::{MustPass, verdict_on_plan};
use crate::study::judgement::Judgement;
use crate::study::risk::Risks;
use crate::study::samples::influence;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, Computed, NoResult};
use crate::verdict::{Limits, Quantity, Verdict};

/// The document of the samples of all options.
#[derive(Serialize)]
pub struct RiskDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    partial: bool,
    limits: LimitsObject,
    samples: usize,
    seed: u64,
    options: Vec<SampledOption>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct SampledOption {
    name: String,
    verdict: &'static str,
    samples: usize,
    failures: usize,
    undecided: usize,
    probability: Option<f64>,
    interval_95: [f64; 2],
    flight_height_m: Option<PercentilesAndMost>,
    cable_force_n: Option<PercentilesAndMost>,
    inputs: Option<Vec<Share>>,
}

/// Percentiles of the samples, and their greatest value.
#[derive(Serialize)]
pub struct PercentilesAndMost {
    p05: f64,
    p50: f64,
    p95: f64,
    max: f64,
}

impl PercentilesAndMost {
    /// The band of a quantity of the samples; `None` for too few samples.
    pub fn of(sampled: &SampledShot, quantity: Quantity) -> Option<Self> {
        sampled.band(quantity).map(|[p05, p50, p95, max]| Self { p05, p50, p95, max })
    }
}

/// The share of an input in the variance.
#[derive(Serialize)]
pub struct Share {
    name: &'static str,
    share: f64,
}

/// The shares of the inputs, largest first; `None` for too few samples.
pub fn input_shares(sampled: &SampledShot, limits: &Limits) -> Option<Vec<Share>> {
    let all = influence::input_shares(sampled, limits)?.into_iter();
    Some(all.map(|(input, share)| Share { name: input.key().name, share }).collect())
}

impl SampledOption {
    fn new(case: &Case, name: &str, result: &Result<Judgement, NoResult>) -> Self {
        let sampled = result.as_ref().ok().and_then(|judged| judged.sampled.known());
        let bounds = sampled.map(|sampled| sampled.bounds);
        Self {
            name: name.to_owned(),
            verdict: result.as_ref().map_or(Verdict::Undecided, Judgement::verdict).for_scripts(),
            samples: bounds.map_or(0, |c| c.samples),
            failures: bounds.map_or(0, |c| c.failures),
            undecided: bounds.map_or(0, |c| c.undecided),
            probability: bounds.and_then(|c| c.probability()),
            interval_95: bounds.map_or([0.0, 1.0], |c| c.interval),
            flight_height_m: sampled.and_then(|sampled| PercentilesAndMost::of(sampled, Quantity::Height)),
            cable_force_n: sampled.and_then(|sampled| PercentilesAndMost::of(sampled, Quantity::Force)),
            inputs: sampled.and_then(|sampled| input_shares(sampled, &case.limits)),
        }
    }
}

impl RiskDocument {
    /// The document of the samples of all options, which is partial where the time was up.
    pub fn new(case: &Case, found: &Computed<Risks>) -> Self {
        let Computed { value: Risks { sampling, results }, partial } = found;
        let options = case.plan.delays.iter().zip(results);
        Self {
            schema: "shelter.risk/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: case.verdict_on_file(verdict_on_plan(results, MustPass::Every)).for_scripts(),
            partial: *partial,
            limits: LimitsObject::of(case),
            samples: sampling.most,
            seed: sampling.seed,
            options: options.map(|(delay, result)| SampledOption::new(case, &delay.name, result)).collect(),
            warnings: warnings::of_plan(case)
                .into_iter()
                .chain(warnings::of_options(case, results, None))
                .collect(),
        }
    }
}
