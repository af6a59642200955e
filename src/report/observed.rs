//! What was seen of earlier shots, beside what was planned, possible and fitted.

use super::parts::{Align, Cell, Column, Field, Table};
use crate::choice::ObservedQuantity;
use crate::plan::observations::{Observation, ObservedPoint};
use crate::study::Case;
use crate::study::fit::observation_bands::Prediction;
use crate::study::fit::{Fit, Residual};
use crate::units::{self, Unit};

/// An observation beside what the plan, and after a fit its best answer, say of it.
#[derive(Clone, Copy, Debug)]
pub struct ObservedRow<'a> {
    /// The plan.
    pub case: &'a Case,
    /// The observation.
    pub observed: &'a Observation,
    /// What was planned and possible.
    pub prediction: &'a Prediction,
    /// What the best answer says.
    pub residual: Option<&'a Residual>,
}

fn observed_fields<'a>() -> [Field<ObservedRow<'a>>; 7] {
    fn words(heading: &'static str) -> Column {
        Column { align: Align::Right, ..Column::words(&[], heading) }
    }
    [
        Field::new(Column::words(&[], "observed"), |row| {
            Cell::Text(place(row.case, row.observed.option, &row.observed.watched))
        }),
        Field::new(words("value ± sd"), |row| {
            Cell::Text(units::value_and_sd(row.observed.value, row.observed.sd))
        }),
        Field::new(words("planned"), |row| Cell::Text(value_by_sd(row.prediction.planned, row.observed.sd))),
        Field::new(words("predicted, 90 %"), |row| {
            row.prediction.band.map_or(Cell::Nothing, |band| {
                let [low, high] = band.map(|end| value_by_sd(end, row.observed.sd));
                Cell::Text(if low == high { low } else { format!("{low} to {high}") })
            })
        }),
        Field::new(Column::words(&[], "within"), |row| {
            row.prediction.contains(row.observed.value).map_or(Cell::Nothing, Cell::Flag)
        }),
        Field::new(words("fitted"), |row| {
            row.residual.map_or(Cell::Nothing, |fit| Cell::Text(value_by_sd(fit.predicted, row.observed.sd)))
        }),
        Field::new(words("residual"), |row| row.residual.map_or(Cell::Nothing, residual)),
    ]
}

fn residual(residual: &Residual) -> Cell {
    let deviation = units::rounded(residual.deviation, 1);
    let mark = if residual.is_suspicious() { "  suspicious" } else { "" };
    Cell::Text(match residual.predicted.is_nan() {
        true => "never".to_owned() + mark,
        false => format!("{deviation} sd{mark}"),
    })
}

/// The rows of all observations, without a fit.
pub fn observed_rows<'a>(
    case: &'a Case,
    observed: &'a [Observation],
    predictions: &'a [Prediction],
) -> Vec<ObservedRow<'a>> {
    let beside = observed.iter().zip(predictions);
    beside.map(|(observed, prediction)| ObservedRow { case, observed, prediction, residual: None }).collect()
}

/// The rows of all observations, with what the best answer of a fit says.
pub fn fitted_rows<'a>(case: &'a Case, fit: &'a Fit) -> Vec<ObservedRow<'a>> {
    let rows = observed_rows(case, &fit.observed, &fit.predictions).into_iter();
    let fitted = rows.zip(&fit.answers[0].residuals);
    fitted.map(|(row, residual)| ObservedRow { residual: Some(residual), ..row }).collect()
}

/// The table of observations: planned, predicted, observed, and fitted where there is a fit.
pub fn observed_table(rows: &[ObservedRow<'_>]) -> Table {
    let [observed, value, planned, band, within, fitted, residual] = observed_fields();
    let mut fields = vec![observed, value, planned, band, within];
    if rows.iter().any(|row| row.residual.is_some()) {
        fields.extend([fitted, residual]);
    }
    Table::of(&fields, rows.iter().copied())
}

/// `20 ms · 3:1 height_m at 0.3 s`.
pub fn place(case: &Case, option: usize, watched: &ObservedPoint) -> String {
    let scene = case.scene();
    let address = match watched.quantity {
        ObservedQuantity::Force => scene.cable_name(watched.index),
        _ => scene.tire_ids[watched.index].to_string(),
    };
    let when = if watched.quantity == ObservedQuantity::Height {
        format!(" at {} s", watched.time)
    } else {
        String::new()
    };
    let option = if case.plan.delays.len() > 1 {
        format!("{} · ", case.plan.delays[option].name)
    } else {
        String::new()
    };
    format!("{option}{address} {}{when}", watched.quantity)
}

/// A value with the digits of another's standard deviation.
fn value_by_sd(value: f64, sd: f64) -> String {
    if value.is_nan() {
        return "never".to_owned();
    }
    units::value_and_sd(value, sd).split(' ').next().unwrap_or_default().to_owned()
}

/// What was seen that speaks against the verdicts of the plan: values over a limit, and that the plan does not predict what was
/// seen; of ten observations one lies outside by chance.
pub fn contradiction(rows: &[ObservedRow<'_>]) -> Vec<String> {
    rows.iter().filter_map(over_limit).chain(unpredicted(rows)).collect()
}

/// That a value over a limit was seen.
fn over_limit(row: &ObservedRow<'_>) -> Option<String> {
    let ObservedRow { case, observed, .. } = row;
    let (limit, unit) = match observed.watched.quantity {
        ObservedQuantity::FlightHeight | ObservedQuantity::Height => (Some(case.limits.height), Unit::Metre),
        ObservedQuantity::Force => (Some(case.limits.force), Unit::Kilonewton),
        ObservedQuantity::Drift => (case.limits.drift, Unit::Metre),
        ObservedQuantity::Lift | ObservedQuantity::Landing => (None, Unit::Second),
    };
    let limit = limit.filter(|limit| observed.value > *limit)?;
    let place = place(case, observed.option, &observed.watched);
    let [value, limit] = [observed.value, limit].map(|value| units::value(value, unit));
    Some(format!("{place}: {value} {} was seen, over the limit of {limit}", unit.symbol()))
}

fn unpredicted(rows: &[ObservedRow<'_>]) -> Option<String> {
    let within: Vec<bool> =
        rows.iter().filter_map(|row| row.prediction.contains(row.observed.value)).collect();
    let outside = within.iter().filter(|within| !**within).count();
    let expected = within.len().div_ceil(10);
    let is_odd = outside > expected || outside == within.len() && outside > 0;
    let text = || {
        format!(
            "outside what this plan predicts: {outside} of {} observations of earlier shots; do not fire by its verdicts before it agrees with them",
            within.len()
        )
    };
    is_odd.then(text)
}

/// How many observations lie in their bands: of each shot, and of all.
pub fn bands(case: &Case, rows: &[ObservedRow<'_>]) -> Vec<String> {
    let held: Vec<(usize, bool)> = rows
        .iter()
        .filter_map(|row| Some((row.observed.option, row.prediction.contains(row.observed.value)?)))
        .collect();
    let words = |observed: &[(usize, bool)]| {
        let within = observed.iter().filter(|(_, held)| *held).count();
        format!("{within} of {}", observed.len())
    };
    if held.is_empty() {
        return Vec::new();
    }
    let options: Vec<String> = held
        .chunk_by(|a, b| a.0 == b.0)
        .map(|shot| format!("{} of {}", words(shot), case.plan.delays[shot[0].0].name))
        .collect();
    let by_option = if options.len() > 1 { format!(" ({})", options.join("; ")) } else { String::new() };
    vec![format!(
        "{} observations lie within what the plan as it is predicts of them{by_option}; 9 of 10 are to be expected",
        words(&held)
    )]
}
