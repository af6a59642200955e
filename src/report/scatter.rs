//! `scatter` as a report: how often each option fails.

use super::charts;
use super::limit_facts;
use super::model::{Block, Cell, Column, Conclusion, Report, Row, Table};
use crate::study::Case;
use crate::study::scatter::{Sample, Sampling, Summary, Swap, summary, verdict};
use crate::units::{self, Unit};
use crate::verdict::Verdict;

const SPREAD: &str = "median · 95 % · max";

const COLUMNS: [Column; 7] = [
    Column::words(&["name"], "option"),
    Column::numbers(&["samples"], "samples", Unit::One),
    Column::numbers(&["failures"], "failures", Unit::One),
    Column::scripts(&["probability"]),
    Column::numbers(&["low_95", "high_95"], "probability", Unit::Percent).under("95 % interval"),
    Column::numbers(
        &["flight_height_p50_m", "flight_height_p95_m", "flight_height_max_m"],
        "height",
        Unit::Metre,
    )
    .under(SPREAD),
    Column::numbers(
        &["cable_force_p50_n", "cable_force_p95_n", "cable_force_max_n"],
        "force",
        Unit::Kilonewton,
    )
    .under(SPREAD),
];

/// The report of all samples, which is partial where the time was up.
pub fn report(case: &Case, sampling: &Sampling, samples: &[Sample], partial: bool) -> Report {
    let options = case.plan.delays.iter().enumerate();
    let rows = options.map(|(option, delay)| row(&delay.name, &summary(samples, option))).collect();
    let table = Table { columns: COLUMNS.to_vec(), rows, ranked: false };
    let failures = samples.iter().filter(|sample| sample.envelope.verdict != Verdict::Pass).count();
    let mut text =
        format!("{failures} of {} samples fail{}", samples.len(), if partial { " so far" } else { "" });
    if let Some(bound) = sampling.certain_at {
        let bound = 1e2 * bound;
        text += &format!("; what is asked is that every option surely fails less often than {bound} %");
    }
    let verdict = match verdict(case, sampling, samples) {
        Verdict::Pass if partial => Verdict::Undecided,
        verdict => verdict,
    };
    let head = format!("up to {} samples of each option, seed {}", sampling.samples, sampling.seed);
    let mut blocks = vec![Block::Text(vec![head]), Block::Table(table)];
    blocks.extend(charts::scatter(case, samples).map(Block::Picture));
    Report { blocks, conclusion: Some(Conclusion { verdict, text }), ..limit_facts(case) }
}

fn row(name: &str, summary: &Summary) -> Row {
    let known = |cell: Cell| if summary.samples > 0 { cell } else { Cell::Nothing };
    let cells = vec![
        Cell::Text(name.to_owned()),
        Cell::Count(summary.samples),
        Cell::Count(summary.failures),
        failure_share(summary).map_or(Cell::Nothing, Cell::Number),
        Cell::Probability(summary.interval),
        known(Cell::Spread(summary.height, Unit::Metre)),
        known(Cell::Spread(summary.force, Unit::Kilonewton)),
    ];
    Row { cells, ..Row::default() }
}

/// Failures over samples; `None` without a sample.
pub(super) fn failure_share(summary: &Summary) -> Option<f64> {
    (summary.samples > 0).then(|| summary.failures as f64 / summary.samples as f64)
}

/// The warning that two blast rows may fire in the wrong order.
pub fn swap_warning(case: &Case, swap: &Swap) -> String {
    let [first, second] = swap.rows.map(|row| &case.plan.blast_rows[row].name);
    format!(
        "option {}: {} between rows {first} and {second} is short for the scatter of the detonators; a hole of row {second} fires before one of row {first} with a probability of {}",
        case.plan.delays[swap.option].name,
        units::exact_milliseconds(swap.interval),
        units::percent(swap.probability, 2),
    )
}
