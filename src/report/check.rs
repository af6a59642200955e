//! `check` as a report: one row a delay option.

use super::explain::{broken, compute_label, reason};
use super::model::{Block, Cell, Column, Conclusion, Detail, Field, Report, Shown, Table};
use super::shared_columns::{FORCE, HEIGHT, VERDICT, force, height};
use super::{limit_facts, no_result};
use crate::plan::DelayOption;
use crate::study::check::Checked;
use crate::study::check_all::{Results, verdict};
use crate::study::reason::Reason;
use crate::study::{Case, NoResult};
use crate::units::Unit;
use crate::verdict::Verdict;

/// A delay option and its result.
struct OptionRow<'a> {
    case: &'a Case,
    delay: &'a DelayOption,
    result: &'a Result<Checked, NoResult>,
}

impl OptionRow<'_> {
    /// A cell of the result; nothing where there is none.
    fn of(&self, cell: impl FnOnce(&Checked) -> Cell) -> Cell {
        self.result.as_ref().map_or(Cell::Nothing, cell)
    }

    fn verdict(&self) -> Verdict {
        self.result.as_ref().map_or(Verdict::Undecided, |checked| checked.verdict)
    }

    /// Why the option does not pass, or has no result.
    fn reasons(&self) -> String {
        match self.result {
            Ok(checked) => checked.reasons.iter().map(reason).collect::<Vec<_>>().join("; "),
            Err(reason) => no_result::message(reason),
        }
    }

    /// Firing times of the rows in the order of the plan: `0, 20, 40 ms`.
    fn firing(&self) -> String {
        let times: Vec<String> = self.delay.timing.fire_at_ms().iter().map(f64::to_string).collect();
        format!("{} ms", times.join(", "))
    }
}

fn fields<'a>() -> [Field<OptionRow<'a>>; 18] {
    let words = |heading| Column::words(&[], heading).shown(Shown::Text);
    [
        Field::new(Column::scripts(&["plan"]), |row| Cell::Text(row.case.source.path.clone())),
        Field::new(Column::words(&["option"], "option"), |row| Cell::Text(row.delay.name.clone())),
        Field::new(Column::words(&[], "rows fire, as listed, at").shown(Shown::Page), |row| {
            Cell::Text(row.firing())
        }),
        Field::new(VERDICT, |row| Cell::Verdict(row.verdict())),
        Field::new(HEIGHT, |row| row.of(|checked| height(checked.height.into()))),
        Field::new(Column::scripts(&["flight_height_at_s"]), |row| {
            row.of(|checked| Cell::Number(checked.height.at))
        }),
        Field::new(Column::scripts(&["flight_height_tire"]), |row| {
            row.of(|checked| Cell::Text(row.case.scene().tire[checked.height.index].to_string()))
        }),
        Field::new(FORCE, |row| row.of(|checked| force(checked.force.into()))),
        Field::new(Column::scripts(&["cable_force_at_s"]), |row| {
            row.of(|checked| Cell::Number(checked.force.at))
        }),
        Field::new(Column::scripts(&["cable_force_cable"]), |row| {
            row.of(|checked| Cell::Text(row.case.scene().cable_name(checked.force.index)))
        }),
        Field::new(Column::numbers(&["cable_safety_factor"], "factor", Unit::One), |row| {
            row.of(|checked| Cell::Factor(checked.safety_factor))
        }),
        Field::new(DRIFT, |row| {
            row.of(|Checked { drift, .. }| Cell::Estimate {
                value: drift.value,
                error: drift.error,
                unit: Unit::Metre,
            })
        }),
        Field::new(Column::scripts(&["broken_cables"]), |row| {
            row.of(|checked| Cell::Count(checked.broken.len()))
        }),
        Field::new(Column::scripts(&["dt_s"]), |row| row.of(|checked| Cell::Number(checked.step))),
        Field::new(Column::scripts(&["energy_residual"]), |row| {
            row.of(|checked| Cell::Number(checked.energy_residual))
        }),
        Field::new(Column::scripts(&["reasons"]), |row| Cell::Text(row.reasons())),
        Field::new(words("height over time"), |row| {
            row.of(|checked| bars(&checked.history.height, row.case.limits.height))
        }),
        Field::new(words("force over time"), |row| {
            row.of(|checked| bars(&checked.history.force, row.case.limits.force))
        }),
    ]
}

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
    let mut table = Table::of(&fields(), options.map(|(delay, result)| OptionRow { case, delay, result }));
    table.columns = table.columns.iter().map(shown).collect();
    for (row, result) in table.rows.iter_mut().zip(results) {
        match result {
            Ok(checked) => row.details = details(case, checked),
            Err(reason) => row.missing = Some(no_result::message(reason)),
        }
    }
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

fn bars(series: &[f64], top: f64) -> Cell {
    Cell::Sparkline { series: series.to_vec(), top }
}

fn details(case: &Case, checked: &Checked) -> Vec<Detail> {
    let detail = |of: &Reason| Detail { verdict: of.verdict(), text: reason(of) };
    let mut details: Vec<Detail> = checked.reasons.iter().map(detail).collect();
    if !checked.broken.is_empty() {
        details.push(Detail { verdict: Verdict::Fail, text: broken(case.scene(), checked) });
    }
    details
}
