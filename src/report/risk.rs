//! `risk` as a report: how likely each option fails, within which bands it stays, and what decides it.

use super::charts;
use super::check::complete_rows;
use super::option_row::{OptionRow, option_rows};
use super::parts::{Block, Cell, Column, Conclusion, Field, Report, Table};
use super::report_head;
use super::shared_columns::{FAILURES, VERDICT};
use super::words::option_sentences::{compute_label, inputs};
use super::words::warnings;
use crate::study::judge_options::{MustPass, verdict_on_plan};
use crate::study::risk::Risks;
use crate::study::samples::influence::input_shares;
use crate::study::{Case, Computed};
use crate::units::Unit;
use crate::verdict::{Quantity, Verdict};

const SPREAD: &str = "5 · 50 · 95 % · max";

fn spread(row: &OptionRow<'_>, quantity: Quantity, unit: Unit) -> Cell {
    row.sampled(|sampled| sampled.band(quantity).map_or(Cell::Nothing, |band| Cell::Spread(band, unit)))
}

fn fields<'a>() -> [Field<OptionRow<'a>>; 10] {
    let column = |keys, heading, unit| Column::numbers(keys, heading, unit).under(SPREAD);
    let height_keys =
        &["flight_height_p05_m", "flight_height_p50_m", "flight_height_p95_m", "flight_height_max_m"];
    let force_keys = &["cable_force_p05_n", "cable_force_p50_n", "cable_force_p95_n", "cable_force_max_n"];
    [
        Field::new(Column::words(&["name"], "option"), |row| Cell::Text(row.delay.name.clone())),
        Field::new(VERDICT, |row| Cell::Verdict(row.verdict())),
        Field::new(Column::scripts(&["undecided"]), |row| {
            row.sampled(|sampled| Cell::Count(sampled.bounds.undecided))
        }),
        Field::new(Column::scripts(&["probability"]), |row| {
            row.sampled(|sampled| sampled.bounds.probability().map_or(Cell::Nothing, Cell::Number))
        }),
        Field::new(FAILURES, |row| row.sampled(|sampled| Cell::Probability(sampled.bounds.interval))),
        Field::new(column(height_keys, "height", Unit::Metre), |row| {
            spread(row, Quantity::Height, Unit::Metre)
        }),
        Field::new(column(force_keys, "force", Unit::Kilonewton), |row| {
            spread(row, Quantity::Force, Unit::Kilonewton)
        }),
        Field::new(Column::numbers(&["samples"], "samples", Unit::One), |row| {
            row.sampled(|sampled| Cell::Count(sampled.samples.len()))
        }),
        Field::new(Column::numbers(&["failures"], "failures", Unit::One), |row| {
            row.sampled(|sampled| Cell::Count(sampled.bounds.failures))
        }),
        Field::new(Column::words(&["inputs"], "what decides it"), |row| {
            row.sampled(|sampled| {
                let shares = input_shares(sampled, &row.case.limits);
                Cell::Text(shares.map_or_else(String::new, |shares| inputs(&shares)))
            })
        }),
    ]
}

/// The report of the samples of all options, which is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Risks>) -> Report {
    let Computed { value: Risks { sampling, results }, partial } = found;
    let mut table = Table::of(&fields(), option_rows(case, results));
    complete_rows(&mut table, case, results);
    let head = format!("up to {} samples of each option, seed {}", sampling.most, sampling.seed);
    let mut blocks = vec![Block::Text(vec![head]), Block::Table(table)];
    let risks =
        case.plan.delays.iter().zip(results).filter_map(|(delay, result)| {
            Some((delay.name.as_str(), result.as_ref().ok()?.sampled.known()?))
        });
    blocks.extend(risks.map(|(name, risk)| Block::Picture(charts::risk(case, name, risk))));
    let passed = results.iter().flatten().filter(|judged| judged.verdict() == Verdict::Pass).count();
    let mut text =
        format!("{passed} of {} options pass{}", results.len(), if *partial { " so far" } else { "" });
    if let Some(judged) = results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&judged.checked.compute));
    }
    let mut report = report_head(case, true);
    report.blocks = blocks;
    report.warnings.extend(warnings::of_options(case, results, None));
    report.conclusion =
        Some(Conclusion { verdict: case.verdict_on_file(verdict_on_plan(results, MustPass::Every)), text });
    report
}
