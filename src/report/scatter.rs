//! The results of `scatter`; schema `shelter.scatter/1`.

use serde::Serialize;

use super::table::Style;
use crate::study::Case;
use crate::study::scatter::{Draw, Sample, Summary, Swap, summary, verdict};
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// The document of one study.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    limits: super::Limits,
    samples: usize,
    seed: u64,
    options: Vec<Row>,
    warnings: Vec<String>,
}

/// One option, for JSON.
#[derive(Serialize)]
pub struct Row {
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

/// One option, for CSV.
#[derive(Serialize)]
pub struct Line {
    name: String,
    samples: usize,
    failures: usize,
    probability: Option<f64>,
    low_95: f64,
    high_95: f64,
    flight_height_p50_m: Option<f64>,
    flight_height_p95_m: Option<f64>,
    flight_height_max_m: Option<f64>,
    cable_force_p50_n: Option<f64>,
    cable_force_p95_n: Option<f64>,
    cable_force_max_n: Option<f64>,
}

/// Name and summary of each option.
fn summaries<'c>(case: &'c Case, samples: &'c [Sample]) -> impl Iterator<Item = (String, Summary)> + 'c {
    let names = case.plan.delays.iter().map(|delay| delay.name.clone());
    names.enumerate().map(|(option, name)| (name, summary(samples, option)))
}

fn probability(summary: &Summary) -> Option<f64> {
    sampled(summary, summary.failures as f64 / summary.samples as f64)
}

/// What a summary says, if it is one of any sample.
fn sampled<T>(summary: &Summary, value: T) -> Option<T> {
    (summary.samples > 0).then_some(value)
}

/// One line of CSV for each option.
pub fn lines<'c>(case: &'c Case, samples: &'c [Sample]) -> impl Iterator<Item = Line> + 'c {
    summaries(case, samples).map(|(name, summary)| Line {
        name,
        samples: summary.samples,
        failures: summary.failures,
        probability: probability(&summary),
        low_95: summary.interval[0],
        high_95: summary.interval[1],
        flight_height_p50_m: sampled(&summary, summary.height[0]),
        flight_height_p95_m: sampled(&summary, summary.height[1]),
        flight_height_max_m: sampled(&summary, summary.height[2]),
        cable_force_p50_n: sampled(&summary, summary.force[0]),
        cable_force_p95_n: sampled(&summary, summary.force[1]),
        cable_force_max_n: sampled(&summary, summary.force[2]),
    })
}

impl Document {
    /// Of all samples.
    pub fn new(case: &Case, draw: &Draw, samples: &[Sample], swaps: &[Swap], partial: bool) -> Self {
        let spread = |[p50, p95, max]: [f64; 3]| Spread { p50, p95, max };
        let row = |(name, summary): (String, Summary)| Row {
            name,
            samples: summary.samples,
            failures: summary.failures,
            undecided: summary.undecided,
            probability: probability(&summary),
            interval_95: summary.interval,
            flight_height_m: sampled(&summary, spread(summary.height)),
            cable_force_n: sampled(&summary, spread(summary.force)),
        };
        Self {
            schema: "shelter.scatter/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial,
            limits: super::Limits::new(case),
            samples: draw.samples,
            seed: draw.seed,
            options: summaries(case, samples).map(row).collect(),
            warnings: swaps.iter().map(|swap| warning(case, swap)).collect(),
        }
    }
}

/// Rows that may swap, in words.
pub fn warning(case: &Case, swap: &Swap) -> String {
    let [first, second] = swap.rows.map(|row| &case.plan.blast_rows[row].name);
    format!(
        "option {}: {} between rows {first} and {second} is short for the scatter of the detonators; a hole of row {second} fires before one of row {first} with a probability of {:.2} %",
        case.plan.delays[swap.option].name,
        units::milliseconds(swap.interval),
        1e2 * swap.probability,
    )
}

/// The study for reading.
pub fn text(case: &Case, draw: &Draw, samples: &[Sample], partial: bool, style: Style) -> String {
    let mut text = super::heading(case);
    text += &format!("up to {} samples of each option, seed {}\n\n", draw.samples, draw.seed);
    let width = case.plan.delays.iter().map(|delay| delay.name.chars().count()).max().unwrap_or(0).max(6);
    text += &format!(
        "{:width$}  {:>7}  {:>8}  {:>16}  {:>22}  {:>22}\n{:width$}  {:>7}  {:>8}  {:>16}  {:>22}  {:>22}\n",
        "option",
        "samples",
        "failures",
        "probability, %",
        "height, m",
        "force, kN",
        "",
        "",
        "",
        "95 % interval",
        "median · 95 % · max",
        "median · 95 % · max"
    );
    for (name, summary) in summaries(case, samples) {
        if summary.samples == 0 {
            text += &format!("{name:width$}  {:>7}\n", "none");
            continue;
        }
        let spread = |values: [f64; 3], unit: Unit| values.map(|value| units::value(value, unit)).join(" · ");
        let [low, high] = summary.interval.map(|share| 1e2 * share);
        text += &format!(
            "{name:width$}  {:>7}  {:>8}  {:>16}  {:>22}  {:>22}\n",
            summary.samples,
            summary.failures,
            format!("{low:.2} to {high:.2}"),
            spread(summary.height, Unit::Metre),
            spread(summary.force, Unit::Kilonewton),
        );
    }
    let failures = samples.iter().filter(|sample| sample.envelope.verdict != Verdict::Pass).count();
    let word = style.verdict(match verdict(case, draw, samples) {
        Verdict::Pass if partial => Verdict::Undecided,
        verdict => verdict,
    });
    text += &format!("\n{word}: {failures} of {} samples fail", samples.len());
    if let Some(bound) = draw.certain_at {
        text +=
            &format!("; what is asked is that every option surely fails less often than {} %", bound * 1e2);
    }
    text.push('\n');
    style.plain(text)
}
