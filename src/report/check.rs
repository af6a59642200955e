//! `check` as a report: one row a delay option.

use super::explain::{broken, compute_label, reason};
use super::model::{Block, Cell, Column, Conclusion, Detail, Report, Row, Shown, Table};
use super::shared_columns::{FORCE, HEIGHT, VERDICT, force, height};
use super::{limit_facts, no_result};
use crate::plan::DelayOption;
use crate::study::check::Checked;
use crate::study::check_all::{Results, verdict};
use crate::study::reason::Reason;
use crate::study::{Case, NoResult};
use crate::units::Unit;
use crate::verdict::Verdict;

const COLUMNS: &[Column] = &[
    Column::scripts(&["plan"]),
    Column::words(&["option"], "option"),
    Column::words(&[], "rows fire, as listed, at").shown(Shown::Page),
    VERDICT,
    HEIGHT,
    Column::scripts(&["flight_height_at_s"]),
    Column::scripts(&["flight_height_tire"]),
    FORCE,
    Column::scripts(&["cable_force_at_s"]),
    Column::scripts(&["cable_force_cable"]),
    Column::numbers(&["cable_safety_factor"], "factor", Unit::One),
    DRIFT,
    Column::scripts(&["broken_cables"]),
    Column::scripts(&["dt_s"]),
    Column::scripts(&["energy_residual"]),
    Column::scripts(&["reasons"]),
    Column::words(&[], "height over time").shown(Shown::Text),
    Column::words(&[], "force over time").shown(Shown::Text),
];

/// Greatest drift and its error.
const DRIFT: Column = Column::numbers(&["drift_m", "drift_error_m"], "drift", Unit::Metre);

/// The report of one plan; with `any` one passing option is enough.
pub fn report(case: &Case, results: &Results, any: bool) -> Report {
    // Without a limit on drift only the page has room for drift.
    let shown = |column: &Column| match column {
        column if *column == DRIFT && case.limits.drift.is_none() => column.shown(Shown::Page),
        column => *column,
    };
    let options = case.plan.delays.iter().zip(results);
    let table = Table {
        columns: COLUMNS.iter().map(shown).collect(),
        rows: options.map(|(delay, result)| row(case, delay, result)).collect(),
        ranked: false,
    };
    let passed = results.iter().flatten().filter(|checked| checked.verdict == Verdict::Pass).count();
    let mut text = format!("{passed} of {} options pass", results.len());
    if let Some(checked) = results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&checked.compute));
    }
    Report {
        blocks: vec![Block::Table(table)],
        conclusion: Some(Conclusion { verdict: verdict(results, any), text }),
        ..limit_facts(case)
    }
}

fn row(case: &Case, delay: &DelayOption, result: &Result<Checked, NoResult>) -> Row {
    match result {
        Ok(checked) => {
            Row { cells: cells(case, delay, checked), missing: None, details: details(case, checked) }
        }
        Err(reason) => {
            let message = no_result::message(reason);
            let mut cells = vec![Cell::Nothing; COLUMNS.len()];
            let [plan, option, firing, verdict, ..] = cells.as_mut_slice() else { return Row::default() };
            [*plan, *option, *firing, *verdict] = names(case, delay, Verdict::Undecided);
            if let Some(at) = COLUMNS.iter().position(|column| column.keys == ["reasons"]) {
                cells[at] = Cell::Text(message.clone());
            }
            Row { cells, missing: Some(message), details: Vec::new() }
        }
    }
}

fn names(case: &Case, delay: &DelayOption, verdict: Verdict) -> [Cell; 4] {
    let times: Vec<String> = delay.timing.fire_at_ms().iter().map(f64::to_string).collect();
    [
        Cell::Text(case.source.path.clone()),
        Cell::Text(delay.name.clone()),
        Cell::Text(format!("{} ms", times.join(", "))),
        Cell::Verdict(verdict),
    ]
}

fn cells(case: &Case, delay: &DelayOption, checked: &Checked) -> Vec<Cell> {
    let (scene, history) = (case.scene(), &checked.history);
    let reasons: Vec<String> = checked.reasons.iter().map(reason).collect();
    let drift = Cell::Estimate { value: checked.drift.value, error: checked.drift.error, unit: Unit::Metre };
    let bars = |series: &[f64], top: f64| Cell::Sparkline { series: series.to_vec(), top };
    let mut cells = Vec::from(names(case, delay, checked.verdict));
    cells.extend([
        height(checked.height.into()),
        Cell::Number(checked.height.at),
        Cell::Text(scene.tire[checked.height.index].to_string()),
        force(checked.force.into()),
        Cell::Number(checked.force.at),
        Cell::Text(scene.cable_name(checked.force.index)),
        Cell::Factor(checked.safety_factor),
        drift,
        Cell::Count(checked.broken.len()),
        Cell::Number(checked.step),
        Cell::Number(checked.energy_residual),
        Cell::Text(reasons.join("; ")),
        bars(&history.height, case.limits.height),
        bars(&history.force, case.limits.force),
    ]);
    cells
}

fn details(case: &Case, checked: &Checked) -> Vec<Detail> {
    let detail = |of: &Reason| Detail { verdict: of.verdict(), text: reason(of) };
    let mut details: Vec<Detail> = checked.reasons.iter().map(detail).collect();
    if !checked.broken.is_empty() {
        details.push(Detail { verdict: Verdict::Fail, text: broken(case.scene(), checked) });
    }
    details
}
