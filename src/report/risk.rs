//! `risk` as a report: how likely each option fails, its bands, and the inputs that decide it.

use itertools::Itertools;

use super::brief::Brief;
use super::charts;
use super::check::{self, complete_rows, pass_caveat};
use super::option_row::{OptionRow, option_rows};
use super::parts::{Block, Cell, Column, Conclusion, Field, Report, Table, fact};
use super::shared_columns::{FAILURES, PROBABILITY, VERDICT, intervals};
use super::words::option_sentences::{compute_label, inputs};
use super::words::warnings;
use super::{judged_facts, report_head};
use crate::study::judge::Judgement;
use crate::study::judge::recommend::{MustPass, verdict_on_plan};
use crate::study::risk::Risks;
use crate::study::samples::failure_bounds::FailureBounds;
use crate::study::samples::influence::input_shares;
use crate::study::{Case, Computed};
use crate::units::Unit;
use crate::verdict::{Quantity, Verdict};

const SPREAD: &str = "5 · 50 · 95 % · max";

fn spread(row: &OptionRow<'_>, quantity: Quantity, unit: Unit) -> Cell {
    row.sampled(|sampled| sampled.band(quantity).map(|band| Cell::Spread(band, unit)))
}

/// A count of samples; 0 where the option has no result.
fn count(row: &OptionRow<'_>, count: fn(&FailureBounds) -> usize) -> Cell {
    let sampled = row.result.as_ref().ok().and_then(|judged| judged.sampled.known());
    Cell::Count(sampled.map_or(0, |sampled| count(&sampled.bounds)))
}

fn fields<'a>() -> [Field<OptionRow<'a>>; 12] {
    let spread_of = |keys, heading, unit| Column::numbers(keys, heading, unit).under(SPREAD);
    let height_keys =
        &["flight_height_p05_m", "flight_height_p50_m", "flight_height_p95_m", "flight_height_max_m"];
    let force_keys = &["cable_force_p05_n", "cable_force_p50_n", "cable_force_p95_n", "cable_force_max_n"];
    let height = spread_of(height_keys, "height", Unit::Metre).json(&[
        "flight_height_m.p05",
        "flight_height_m.p50",
        "flight_height_m.p95",
        "flight_height_m.max",
    ]);
    let force = spread_of(force_keys, "force", Unit::Kilonewton).json(&[
        "cable_force_n.p05",
        "cable_force_n.p50",
        "cable_force_n.p95",
        "cable_force_n.max",
    ]);
    [
        Field::new(Column::words(&["name"], "option"), |row| (&row.delay.name).into()),
        Field::new(VERDICT, |row| row.verdict().into()),
        Field::scripts(&["undecided"], |row| count(row, |bounds| bounds.undecided)),
        Field::new(PROBABILITY, |row| row.sampled(|sampled| sampled.bounds.probability())),
        Field::new(FAILURES.json(&[]), |row| {
            row.sampled(|sampled| Cell::Probability(sampled.bounds.interval))
        }),
        Field::json(&["interval_95"], |row| {
            let interval = row.result.as_ref().ok().and_then(|judged| intervals(&judged.sampled));
            Cell::Probability(interval.map_or([0.0, 1.0], |[failures, _]| failures))
        }),
        Field::new(height, |row| spread(row, Quantity::Height, Unit::Metre)),
        Field::new(force, |row| spread(row, Quantity::Force, Unit::Kilonewton)),
        Field::new(Column::numbers(&["samples"], "samples", Unit::One), |row| {
            count(row, |bounds| bounds.samples)
        }),
        Field::new(Column::numbers(&["failures"], "failures", Unit::One), |row| {
            count(row, |bounds| bounds.failures)
        }),
        Field::new(Column::words(&["inputs"], "what decides it").json(&[]), |row| {
            row.sampled(|sampled| {
                let shares = input_shares(sampled, &row.case.limits);
                shares.map_or_else(String::new, |shares| inputs(&shares))
            })
        }),
        Field::json(&["inputs"], check::inputs),
    ]
}

/// The report of the samples of all options. It is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Risks>) -> Report {
    let Computed { value: Risks { sampling, results }, partial } = found;
    let mut table = Table::of(&fields(), option_rows(case, results)).key("options");
    complete_rows(&mut table, case, results);
    let head = format!("up to {} samples of each option, seed {}", sampling.most, sampling.seed);
    let verdict = verdict_on_plan(results, MustPass::Every);
    let mut report = report_head(case, "shelter.risk/1", true);
    report.blocks.extend([
        Block::Facts(judged_facts(case, verdict, true, *partial)),
        Block::Facts(vec![fact(&["samples"], sampling.most), fact(&["seed"], sampling.seed as usize)]),
        Block::Text(vec![head]),
        Block::Table(table),
    ]);
    let risks =
        case.plan.delays.iter().zip(results).filter_map(|(delay, result)| {
            Some((delay.name.as_str(), result.as_ref().ok()?.sampled.known()?))
        });
    report.blocks.extend(risks.map(|(name, risk)| Block::Picture(charts::risk(case, name, risk))));
    let passes = |judged: &&Judgement| judged.verdict() == Verdict::Pass;
    let passed = results.iter().flatten().filter(passes).count();
    let mut text =
        format!("{passed} of {} options pass{}", results.len(), if *partial { " so far" } else { "" });
    text += pass_caveat(case, true);
    if let Some(judged) = results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&judged.checked.compute));
    }
    report.warnings.extend(warnings::of_options(case, results, None));
    report.conclusion = Some(Conclusion::new(verdict.into(), text));
    report
}

/// The options that fail least, and how often they fail, in one line.
pub fn in_brief(case: &Case, risks: &Computed<Risks>) -> Brief {
    let results = &risks.value.results;
    let known = results.iter().enumerate().filter_map(|(n, result)| {
        let judged = result.as_ref().ok()?;
        let name = case.plan.delays[n].name.as_str();
        Some((name, judged, judged.sampled.known()?.bounds, judged.failing_share()?))
    });
    let best = known.min_set_by(|a, b| a.3.total_cmp(&b.3));
    let Some((first, judged, least, _)) = best.first() else {
        return Brief { texts: vec!["no result".to_owned()], ..Brief::default() };
    };
    let words = if least.undecided > 0 { "fail or are open" } else { "fail" };
    let failing = format!("{} of {} shots {words}", least.failures + least.undecided, least.samples);
    let texts = match best.len() {
        1 => vec![
            format!("{first} fails least: {failing}"),
            format!("{first}: {failing}"),
            (*first).to_owned(),
        ],
        count => {
            let names: Vec<&str> = best.iter().map(|(name, ..)| *name).collect();
            let is_alike = best.iter().all(|(_, _, bounds, _)| {
                (bounds.samples, bounds.undecided) == (least.samples, least.undecided)
            });
            let each = if is_alike { format!(": {failing} of each") } else { String::new() };
            let several = [names.join(", "), format!("{count} options")];
            let told = several.map(|names| format!("{names} fail least{each}"));
            told.into_iter().chain([format!("{count} options fail least")]).collect()
        }
    };
    // Whoever takes the best of several options needs fresh draws. This study draws none.
    let verdict = if results.len() > 1 { judged.verdict().max(Verdict::Undecided) } else { judged.verdict() };
    // One bar per option.
    let risk = |judged: &Judgement| judged.sampled.known()?.bounds.probability();
    let risks = results.iter().map(|result| result.as_ref().ok().and_then(risk).unwrap_or(f64::INFINITY));
    let shares = risks.map(|risk| risk / case.limits.accepted_risk).collect();
    Brief::judged(verdict, texts).drawn_as(shares)
}
