//! `accuracy` as a report: cost and error of every step, and the source paper's table where the plan is the paper's.

use super::charts;
use super::paper_table::paper_table;
use super::parts::{Block, Cell, Column, Field, Report, Table, fact};
use crate::choice::Method;
use crate::study::accuracy::{AccuracyTable, CLASSES, ErrorClass, Measured, NearestLimit, StepRow};
use crate::study::{Case, Computed};
use crate::units::{self, Unit};

/// One method at one step.
struct MeasuredRow<'a> {
    study: &'a AccuracyTable,
    row: &'a StepRow,
}

impl MeasuredRow<'_> {
    /// A cell of the measured run; nothing where the method is not stable.
    fn of<C: Into<Cell>>(&self, cell: impl FnOnce(&Measured) -> C) -> Cell {
        self.row.result.as_ref().map(cell).into()
    }

    /// The accuracy level that starts at this step.
    fn level(&self) -> Cell {
        let of_level = |step: f64| step == self.row.step && self.row.method == Method::Verlet;
        let level = self.study.levels.iter().find(|level| of_level(level.step));
        level.map(|found| found.level.name()).into()
    }
}

fn fields<'a>() -> [Field<MeasuredRow<'a>>; 13] {
    let number = |key, heading| Column::numbers(key, heading, Unit::One);
    [
        Field::new(Column::words(&["method"], "method"), |row| row.row.method.name().into()),
        Field::new(number(&["dt_s"], "step"), |row| Cell::Time(row.row.step)),
        Field::new(number(&["steps"], "steps"), |row| row.of(|m| m.steps)),
        Field::scripts(&["stable"], |row| row.row.result.is_some().into()),
        Field::new(Column::numbers(&["flight_height_m"], "height", Unit::Metre), |row| {
            row.of(|m| Cell::Value(m.height, Unit::Metre))
        }),
        Field::new(Column::numbers(&["cable_force_n"], "force", Unit::Kilonewton), |row| {
            row.of(|m| Cell::Value(m.force, Unit::Kilonewton))
        }),
        Field::new(Column::numbers(&["drift_m"], "slide", Unit::Metre), |row| {
            row.of(|m| Cell::Value(m.drift, Unit::Metre))
        }),
        Field::new(number(&["height_error"], "height error"), |row| {
            row.of(|m| Cell::RelativeError(m.height_error))
        }),
        Field::new(number(&["force_error"], "force error"), |row| {
            row.of(|m| Cell::RelativeError(m.force_error))
        }),
        Field::new(number(&["drift_error"], "slide error"), |row| {
            row.of(|m| Cell::RelativeError(m.drift_error))
        }),
        Field::new(number(&["energy_residual"], "residual"), |row| {
            row.of(|m| Cell::Residual(m.energy_residual))
        }),
        Field::new(number(&["wall_s"], "time"), |row| row.of(|m| Cell::Time(m.wall.as_secs_f64()))),
        Field::new(Column::words(&[], "level"), |row| row.of(|_| row.level())),
    ]
}

/// The report of one option, with our values beside the source paper's table where the plan is the paper's.
pub fn report(case: &Case, Computed { value: study, .. }: &Computed<AccuracyTable>) -> Report {
    let [draft, field, reference] = study.levels.map(|level| level.step);
    let option = &case.plan.delays[study.option].name;
    let method = Method::Verlet.name();
    let mut blocks = vec![
        Block::Facts(vec![fact(&["plan"], case.source.name()), fact(&["option"], option)]),
        Block::Table(steps(study)),
        Block::Facts(vec![
            fact(&["reference.method"], method),
            fact(&["reference.dt_s"], study.reference_step),
            fact(&["recommended.draft.method"], method),
            fact(&["recommended.draft.dt_s"], draft),
            fact(&["recommended.field.method"], method),
            fact(&["recommended.field.dt_s"], field),
            fact(&["recommended.reference.method"], method),
            fact(&["recommended.reference.dt_s"], reference),
        ]),
    ];
    blocks.extend(charts::work_precision(study).map(Block::Chart));
    let mut sentences = vec![enough(case, study)];
    sentences.extend(CLASSES.iter().map(|&class| cheapest(study, class)));
    blocks.push(Block::Text(sentences));
    blocks.extend(study.paper.iter().flat_map(|(method, ours)| paper_table(*method, ours)));
    let reference = units::milliseconds(study.reference_step);
    Report {
        schema: "shelter.accuracy/1",
        title: format!("{}, option {option}", case.title()),
        facts: vec![format!("errors against verlet at {reference}; times on this machine, one thread")],
        blocks,
        ..Report::default()
    }
}

fn steps(study: &AccuracyTable) -> Table {
    let rows = study.rows.iter().map(|row| MeasuredRow { study, row });
    let mut table = Table::of(&fields(), rows).key("rows");
    for (drawn, row) in table.rows.iter_mut().zip(&study.rows) {
        drawn.missing = row.result.is_none().then(|| "not stable".to_owned());
    }
    table
}

/// Sentence: the coarsest level that decides on the limits by its first run.
pub fn enough(case: &Case, study: &AccuracyTable) -> String {
    let levels = study.levels.map(|start| (start.level, study.nearest_limit(start.level, &case.limits)));
    let found =
        levels.into_iter().find_map(|(level, run)| Some((level, run.filter(NearestLimit::is_enough)?)));
    let percent =
        |share: f64| if share < 1e-4 { "under 0.01 %".to_owned() } else { units::percent(share, 2) };
    match found {
        Some((level, NearestLimit { error, margin, is_exceeded })) => format!(
            "{} is enough as planned: error {}, nearest limit {} {}{}",
            level.name(),
            percent(error),
            units::percent(margin.abs(), 1),
            if margin < 0.0 { "below" } else { "above" },
            if is_exceeded { "; a limit is EXCEEDED" } else { "" }
        ),
        None => "no level decides by its first run: a check refines until it is sure".to_owned(),
    }
}

/// Sentence: the cheapest step of each method within a class of errors.
fn cheapest(study: &AccuracyTable, class: ErrorClass) -> String {
    let methods = [Method::Verlet, Method::Newmark];
    let best = methods.map(|method| study.cheapest(method, class));
    let cheapest = methods.into_iter().zip(best).map(|(method, best)| match best {
        Some((step, wall)) => {
            let [step, wall] = [step, wall.as_secs_f64()].map(units::milliseconds);
            format!("{} at {step} in {wall}", method.name())
        }
        None if study.rows.iter().all(|row| row.method != method) => {
            format!("{} not measured", method.name())
        }
        None => format!("{} not reached", method.name()),
    });
    let cheapest: Vec<String> = cheapest.collect();
    let times = match best {
        [Some((_, fast)), Some((_, slow))] => {
            format!("; {} times faster", units::rounded(slow.as_secs_f64() / fast.as_secs_f64(), 0))
        }
        _ => String::new(),
    };
    let (height, force) = (class.height * 100.0, class.force * 100.0);
    format!("within {height} % of height and {force} % of force: {}{times}", cheapest.join("; "))
}
