//! `accuracy` as a report: what every step costs and how wrong it is, with the source paper's table where the plan is its.

use super::charts;
use super::model::{Block, Cell, Column, Report, Row, Table};
use crate::choice::Method;
use crate::study::accuracy::{AccuracyTable, CLASSES, PAPER, PaperRow};
use crate::study::{Case, accuracy};
use crate::units::{self, Unit};

const STEPS: [Column; 11] = [
    Column::words(&["method"], "method"),
    Column::numbers(&["dt_s"], "step", Unit::One),
    Column::numbers(&["steps"], "steps", Unit::One),
    Column::scripts(&["stable"]),
    Column::numbers(&["flight_height_m"], "height", Unit::Metre),
    Column::numbers(&["cable_force_n"], "force", Unit::Kilonewton),
    Column::numbers(&["height_error"], "height error", Unit::One),
    Column::numbers(&["force_error"], "force error", Unit::One),
    Column::numbers(&["energy_residual"], "residual", Unit::One),
    Column::numbers(&["wall_s"], "time", Unit::One),
    Column::words(&[], "level"),
];

const PAPER_COLUMNS: [Column; 7] = [
    Column::numbers(&[], "step", Unit::One),
    Column::numbers(&[], "height", Unit::Metre).under("paper"),
    Column::numbers(&[], "height", Unit::Metre).under("ours"),
    Column::numbers(&[], "force", Unit::Kilonewton).under("paper"),
    Column::numbers(&[], "force", Unit::Kilonewton).under("ours"),
    Column::numbers(&[], "force at 0.16 s", Unit::Kilonewton).under("paper"),
    Column::numbers(&[], "force at 0.16 s", Unit::Kilonewton).under("ours"),
];

/// The report of one option; `paper` holds our values for the source paper's table, by method, where the plan is the
/// paper's.
pub fn report(case: &Case, study: &AccuracyTable, paper: &[(Method, Vec<PaperRow>)]) -> Report {
    let mut blocks = vec![Block::Table(steps(study))];
    blocks.extend(charts::work_precision(study).map(Block::Chart));
    blocks.push(Block::Text(CLASSES.iter().map(|&class| cheapest(study, class)).collect()));
    blocks.extend(paper.iter().flat_map(|(method, ours)| paper_table(*method, ours)));
    let reference = units::milliseconds(study.reference_step);
    Report {
        title: format!("{}, option {}", case.title(), case.plan.delays[study.option].name),
        facts: vec![format!("errors against verlet at {reference}; times on this machine, one thread")],
        blocks,
        conclusion: None,
    }
}

fn steps(study: &AccuracyTable) -> Table {
    let row = |row: &accuracy::StepRow| {
        let mut cells = vec![Cell::Nothing; STEPS.len()];
        cells[0] = Cell::Text(row.method.name().to_owned());
        cells[1] = Cell::Time(row.step);
        cells[3] = Cell::Flag(row.result.is_some());
        let Some(m) = row.result else {
            return Row { cells, missing: Some("not stable".to_owned()), details: Vec::new() };
        };
        let level = study.levels.iter().find(|(_, step)| *step == row.step && row.method == Method::Verlet);
        cells[2] = Cell::Count(m.steps);
        cells[4] = Cell::Value(m.height, Unit::Metre);
        cells[5] = Cell::Value(m.force, Unit::Kilonewton);
        cells[6] = Cell::RelativeError(m.height_error);
        cells[7] = Cell::RelativeError(m.force_error);
        cells[8] = Cell::Residual(m.energy_residual);
        cells[9] = Cell::Time(m.wall.as_secs_f64());
        cells[10] = level.map_or(Cell::Nothing, |(level, _)| Cell::Text(level.name().to_owned()));
        Row { cells, ..Row::default() }
    };
    Table { columns: STEPS.to_vec(), rows: study.rows.iter().map(row).collect(), ranked: false }
}

/// The cheapest step of each method within a class of errors.
fn cheapest(study: &AccuracyTable, class: (f64, f64)) -> String {
    let methods = [Method::Verlet, Method::Newmark];
    let best = methods.map(|method| study.cheapest(method, class));
    let found = methods.into_iter().zip(best).map(|(method, best)| match best {
        Some((step, wall)) => {
            let [step, wall] = [step, wall.as_secs_f64()].map(units::milliseconds);
            format!("{} at {step} in {wall}", method.name())
        }
        None if study.rows.iter().all(|row| row.method != method) => {
            format!("{} not measured", method.name())
        }
        None => format!("{} not reached", method.name()),
    });
    let found: Vec<String> = found.collect();
    let times = match best {
        [Some((_, fast)), Some((_, slow))] => {
            format!("; {} times faster", units::rounded(slow.as_secs_f64() / fast.as_secs_f64(), 0))
        }
        _ => String::new(),
    };
    let (height, force) = (class.0 * 100.0, class.1 * 100.0);
    format!("within {height} % of height and {force} % of force: {}{times}", found.join("; "))
}

/// The table of the source paper beside our values by one method.
fn paper_table(method: Method, ours: &[PaperRow]) -> [Block; 2] {
    let title = format!("Table 1 of the source paper, ours ({}) beside it", method.name());
    let printed = |value: f64| match value.is_nan() {
        true => Cell::Text("-".to_owned()),
        false => Cell::Rounded(value, 3),
    };
    let row = |(paper, ours): (&PaperRow, &PaperRow)| {
        vec![
            Cell::Time(paper.0),
            printed(paper.1),
            Cell::Rounded(ours.1, 4),
            printed(paper.2 * 1e-3),
            Cell::Rounded(ours.2 * 1e-3, 4),
            printed(paper.3 * 1e-3),
            Cell::Rounded(ours.3 * 1e-3, 4),
        ]
    };
    let table = Table::new(&PAPER_COLUMNS, PAPER.iter().zip(ours).map(row));
    [Block::Text(vec![title]), Block::Table(table)]
}
