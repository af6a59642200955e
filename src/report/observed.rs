//! Observations of earlier shots, beside their planned, predicted and fitted values.

use itertools::Itertools;

use super::parts::{Align, Cell, Column, Field, Table};
use crate::choice::ObservedQuantity;
use crate::plan::observations::{Observation, Observations, ObservedPoint, ShotHead, nearly_alike};
use crate::report::language::say;
use crate::study::Case;
use crate::study::fit::observation_bands::Prediction;
use crate::study::fit::{Fit, Residual};
use crate::study::launch::Blast;
use crate::study::observed::contradiction::count_within;
use crate::units::{self, Unit};

/// An observation beside what the plan predicts of it, and after a fit beside its best answer.
#[derive(Clone, Copy, Debug)]
pub struct ObservedRow<'a> {
    /// The plan.
    pub case: &'a Case,
    /// The observation.
    pub observed: &'a Observation,
    /// Planned value and predicted band.
    pub prediction: &'a Prediction,
    /// Residual to the best answer; `None` without a fit.
    pub residual: Option<&'a Residual>,
}

/// Columns of the table. Without a fit only JSON shows the columns of a fit.
fn observed_fields<'a>(is_fitted: bool) -> [Field<ObservedRow<'a>>; 19] {
    let if_fitted = |column: Column| if is_fitted { column } else { column.json_only() };
    // A narrow screen keeps the observation, the prediction, and whether both agree.
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
        Field::new(words("planned").gives_way(3), |row| {
            Cell::Text(value_by_sd(row.prediction.planned, row.observed.sd))
        }),
        Field::new(words("predicted, 90 %"), |row| {
            let ends = row.prediction.band.map(|band| band.map(|end| value_by_sd(end, row.observed.sd)));
            ends.map(|[low, high]| if low == high { low } else { say!("{low} to {high}", low, high) }).into()
        }),
        Field::new(Column::words(&[], "within"), |row| row.prediction.contains(row.observed.value).into()),
        Field::new(if_fitted(words("fitted").gives_way(1)), |row| {
            row.residual.map(|fit| value_by_sd(fit.predicted, row.observed.sd)).into()
        }),
        Field::new(if_fitted(words("residual").gives_way(2)), |row| row.residual.map(residual).into()),
        Field::json(&["option"], |row| (&row.case.plan.delays[row.observed.option].name).into()),
        Field::json(&["tire?"], |row| {
            let ObservedPoint { quantity, index, .. } = row.observed.watched;
            let tire = || row.case.scene().tire_ids[index].to_string();
            (quantity != ObservedQuantity::Force).then(tire).into()
        }),
        Field::json(&["cable?"], |row| {
            let ObservedPoint { quantity, index, .. } = row.observed.watched;
            (quantity == ObservedQuantity::Force).then(|| row.case.scene().cable_name(index)).into()
        }),
        Field::json(&["quantity"], |row| row.observed.watched.quantity.name().into()),
        Field::json(&["at_s?"], |row| {
            let ObservedPoint { quantity, time, .. } = row.observed.watched;
            (quantity == ObservedQuantity::Height).then_some(time).into()
        }),
        Field::json(&["observed"], |row| row.observed.value.into()),
        Field::json(&["sd"], |row| row.observed.sd.into()),
        Field::json(&["fitted"], |row| row.residual.map(|residual| residual.predicted).into()),
        Field::json(&["total_sd"], |row| row.residual.map(|residual| residual.sd).into()),
        Field::json(&["suspicious"], |row| row.residual.is_some_and(Residual::is_suspicious).into()),
        Field::json(&["planned"], |row| row.prediction.planned.into()),
        Field::json(&["band"], |row| row.prediction.band.into()),
    ]
}

fn residual(residual: &Residual) -> String {
    let deviation = units::rounded(residual.deviation, 1);
    let mark = if residual.is_suspicious() { "  suspicious" } else { "" };
    match residual.predicted.is_nan() {
        true => say!("never") + mark,
        false => format!("{deviation} sd{mark}"),
    }
}

/// Rows of all observations, without a fit.
pub fn observed_rows<'a>(
    case: &'a Case,
    observed: &'a [Observation],
    predictions: &'a [Prediction],
) -> Vec<ObservedRow<'a>> {
    let beside = observed.iter().zip(predictions);
    beside.map(|(observed, prediction)| ObservedRow { case, observed, prediction, residual: None }).collect()
}

/// Rows of all observations, with the residuals to the best answer of a fit.
pub fn fitted_rows<'a>(case: &'a Case, fit: &'a Fit) -> Vec<ObservedRow<'a>> {
    let rows = observed_rows(case, &fit.observed, &fit.predictions).into_iter();
    let fitted = rows.zip(&fit.answers[0].residuals);
    fitted.map(|(row, residual)| ObservedRow { residual: Some(residual), ..row }).collect()
}

/// The table of observations: observed, planned, predicted, and fitted where there is a fit.
pub fn observed_table(rows: &[ObservedRow<'_>]) -> Table {
    let is_fitted = rows.iter().any(|row| row.residual.is_some());
    Table::of(&observed_fields(is_fitted), rows.iter().copied()).key("residuals")
}

/// Remarks of files on their shots that the program does not read, one sentence per file.
pub fn remarks(files: &[Observations]) -> impl Iterator<Item = String> {
    let remarking = files.iter().filter(|file| !file.head.remarks.is_empty());
    remarking.map(|file| {
        let said = file.head.remarks.iter().map(|remark| format!("“{remark}”")).join(", ");
        say!("{path} says {said}: nothing is computed of it", file.path, said)
    })
}

/// Warnings that two files may hold one shot, which makes the launch look surer than it is. The files have nearly the same values,
/// or they observe the same option and one of them states no day.
pub fn perhaps_one_shot(files: &[&Observations]) -> impl Iterator<Item = String> + use<> {
    let of_one_option = |a: &Observations, b: &Observations| {
        a.list.iter().any(|seen| b.list.iter().any(|other| other.option == seen.option))
    };
    let may_be_one = |a: &Observations, b: &Observations| a.head.date.is_none() || b.head.date.is_none();
    let mut pairs = files.iter().copied().tuple_combinations();
    let undated = pairs.find(|(a, b)| of_one_option(a, b) && may_be_one(a, b)).map(|(one, other)| {
        say!(
            "{} and {} count as two shots, which makes the launch surer: the lines of one shot, of all its films, belong into one file; \
             `# date: ...` in each file tells shots apart",
            one.path,
            other.path
        )
    });
    let alike = nearly_alike(files).map(|[one, other]| {
        say!(
            "{} and {} tell values that lie closer together than their reading errors allow, as 1 in 100 pairs of shots do: \
             is it the same shot, typed again? Then leave one out; a shot that counts twice looks surer than it is",
            one.path,
            other.path
        )
    });
    [alike, undated].into_iter().flatten()
}

/// Day, charge, stemming and cover of earlier shots, beside the plan's; `None` where no file states any of them.
pub fn heads_table(case: &Case, files: &[Observations]) -> Option<Table> {
    const COLUMNS: [Column; 5] = [
        Column::words(&[], "shot"),
        Column::words(&[], "day"),
        Column::numbers(&[], "charge, kg", Unit::One),
        Column::numbers(&[], "stemming, m", Unit::One),
        Column::words(&[], "cover"),
    ];
    let says_nothing = |head: &ShotHead| ShotHead { remarks: Vec::new(), ..head.clone() }.is_empty();
    if files.iter().all(|file| says_nothing(&file.head)) {
        return None;
    }
    let blast = Blast::of_plan(&case.plan);
    let text = |text: &Option<String>| text.clone().map_or(Cell::Nothing, Cell::Text);
    let number = |number: Option<f64>| number.map_or(Cell::Nothing, Cell::Number);
    let cover = blast.cover_kg_m2.map(|cover| match case.plan.mass_of_all_tires() {
        Some(mass) => say!("tires of {} kg, {} kg/m² under a tire", mass, units::short(cover)),
        None => say!("{} kg/m² under a tire", units::short(cover)),
    });
    let planned = vec![
        Cell::Text(say!("this plan")),
        Cell::Nothing,
        number(blast.charge_kg),
        number(blast.stemming_m),
        text(&cover),
    ];
    let earlier = files.iter().map(|file| {
        let ShotHead { date, charge_kg, stemming_m, cover, dud, .. } = &file.head;
        let dud = dud.as_ref().map_or_else(String::new, |dud| say!(" (dud: {dud})", dud));
        vec![
            Cell::Text(format!("{}{dud}", file.path)),
            text(date),
            number(*charge_kg),
            number(*stemming_m),
            text(cover),
        ]
    });
    Some(Table::new(&COLUMNS, [planned].into_iter().chain(earlier)))
}

/// Place of an observation: `20 ms · 3:1 height_m at 0.3 s`.
pub fn place(case: &Case, option: usize, watched: &ObservedPoint) -> String {
    let scene = case.scene();
    let address = match watched.quantity {
        ObservedQuantity::Force => scene.cable_name(watched.index),
        _ => scene.tire_ids[watched.index].to_string(),
    };
    let when = if watched.quantity == ObservedQuantity::Height {
        say!(" at {} s", watched.time)
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

/// A value with the digits that a standard deviation `sd` leaves; `never` for NaN.
pub fn value_by_sd(value: f64, sd: f64) -> String {
    if value.is_nan() {
        return say!("never");
    }
    units::value_and_sd(value, sd).split(' ').next().unwrap_or_default().to_owned()
}

/// The observation and the prediction of each row.
pub fn seen_and_predicted(rows: &[ObservedRow<'_>]) -> Vec<(Observation, Prediction)> {
    rows.iter().map(|row| (*row.observed, *row.prediction)).collect()
}

/// Sentence: how many observations lie in their bands, of each shot and of all.
pub fn bands(case: &Case, rows: &[ObservedRow<'_>]) -> Option<String> {
    let words = |(within, of): (usize, usize)| say!("{within} of {of}", within, of);
    let counts = count_within(&seen_and_predicted(rows))?;
    match counts {
        (0, 1) => {
            return Some(say!("the one observation lies outside what the plan as it is predicts of it"));
        }
        (1, 1) => return Some(say!("the one observation lies within what the plan as it is predicts of it")),
        _ => {}
    }
    let all = words(counts);
    let of_shot = |shot: &[ObservedRow<'_>]| {
        Some(say!(
            "{} of {}",
            words(count_within(&seen_and_predicted(shot))?),
            case.plan.delays[shot[0].observed.option].name
        ))
    };
    let shots: Vec<String> =
        rows.chunk_by(|a, b| a.observed.option == b.observed.option).filter_map(of_shot).collect();
    let by_shot = if shots.len() > 1 { format!(" ({})", shots.join("; ")) } else { String::new() };
    Some(say!(
        "{all} observations lie within what the plan as it is predicts of them{by_shot}; 9 of 10 are to be expected",
        all,
        by_shot
    ))
}
