//! What was seen of earlier shots, beside what was planned, possible and fitted.

use itertools::Itertools;

use super::parts::{Align, Cell, Column, Field, Table};
use crate::choice::ObservedQuantity;
use crate::plan::fitted_blast::are_alike;
use crate::plan::observations::{MeasuredFiring, Observation, Observations, ObservedPoint, ShotHead};
use crate::report::language::{phrase, say};
use crate::study::Case;
use crate::study::fit::contradiction::{Contradiction, count_within, find_contradictions};
use crate::study::fit::observation_bands::Prediction;
use crate::study::fit::{Fit, Residual};
use crate::study::launch::Blast;
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

/// The columns; those of a fit are in JSON alone where there is none.
fn observed_fields<'a>(is_fitted: bool) -> [Field<ObservedRow<'a>>; 19] {
    let if_fitted = |column: Column| if is_fitted { column } else { column.json_only() };
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
            let ends = row.prediction.band.map(|band| band.map(|end| value_by_sd(end, row.observed.sd)));
            ends.map(|[low, high]| if low == high { low } else { say!("{low} to {high}", low, high) }).into()
        }),
        Field::new(Column::words(&[], "within"), |row| row.prediction.contains(row.observed.value).into()),
        Field::new(if_fitted(words("fitted")), |row| {
            row.residual.map(|fit| value_by_sd(fit.predicted, row.observed.sd)).into()
        }),
        Field::new(if_fitted(words("residual")), |row| row.residual.map(residual).into()),
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
    let is_fitted = rows.iter().any(|row| row.residual.is_some());
    Table::of(&observed_fields(is_fitted), rows.iter().copied()).key("residuals")
}

/// Day, charge, stemming and cover of earlier shots, beside those of the plan; `None` where no file says any of them.
pub fn heads_table(case: &Case, files: &[Observations]) -> Option<Table> {
    const COLUMNS: [Column; 5] = [
        Column::words(&[], "shot"),
        Column::words(&[], "day"),
        Column::numbers(&[], "charge, kg", Unit::One),
        Column::numbers(&[], "stemming, m", Unit::One),
        Column::words(&[], "cover"),
    ];
    if files.iter().all(|file| file.head.is_empty()) {
        return None;
    }
    let blast = Blast::of_plan(&case.plan);
    let text = |text: &Option<String>| text.clone().map_or(Cell::Nothing, Cell::Text);
    let number = |number: Option<f64>| number.map_or(Cell::Nothing, Cell::Number);
    let cover = blast.cover_kg_m2.map(|cover| {
        say!("tires of {} kg, {} kg/m² under a tire", case.plan.tire.mass_kg, units::short(cover))
    });
    let planned = vec![
        Cell::Text(say!("this plan")),
        Cell::Nothing,
        number(blast.charge_kg),
        number(blast.stemming_m),
        text(&cover),
    ];
    let earlier = files.iter().map(|file| {
        let ShotHead { date, charge_kg, stemming_m, cover } = &file.head;
        vec![Cell::Text(file.path.clone()), text(date), number(*charge_kg), number(*stemming_m), text(cover)]
    });
    Some(Table::new(&COLUMNS, [planned].into_iter().chain(earlier)))
}

/// What an earlier shot may have had otherwise than the plan: its launch was another then.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherShot {
    /// Whether both numbers are known, and differ; else one of them is missing.
    pub differs: bool,
    /// Whether it is the charge or the stemming, by which `shelter launch` scales a launch.
    pub is_scaled: bool,
    /// In a sentence.
    pub text: String,
}

/// Charge, stemming and mass of the tires of earlier shots that differ from those of the plan, or that only one of both says.
pub fn other_shots(case: &Case, files: &[Observations]) -> Vec<OtherShot> {
    let blast = Blast::of_plan(&case.plan);
    let mut others = Vec::new();
    for ShotHead { charge_kg, stemming_m, cover, .. } in files.iter().map(|file| &file.head) {
        let mass = cover.as_deref().and_then(mass_of_tires);
        for (what, unit, is_scaled, then, planned) in [
            ("charge", "kg", true, *charge_kg, blast.charge_kg),
            ("stemming", "m", true, *stemming_m, blast.stemming_m),
            ("mass of a tire", "kg", false, mass, Some(case.plan.tire.mass_kg)),
        ] {
            let what = phrase(what);
            let told = match (then, planned) {
                (Some(then), Some(planned)) if !are_alike(then, planned) => {
                    let [then, planned] = [then, planned].map(units::short);
                    Some(say!(
                        "{what}: {then} {unit} in an earlier shot, {planned} {unit} in the plan: its launch was another",
                        what,
                        then,
                        unit,
                        planned
                    ))
                }
                (Some(_), None) => {
                    Some(say!("{what}: an earlier shot says it, the plan does not: was it the same?", what))
                }
                (None, Some(_)) if is_scaled || cover.is_some() => {
                    Some(say!("{what}: the plan says it, an earlier shot does not: was it the same?", what))
                }
                _ => None,
            };
            let differs = then.is_some() && planned.is_some();
            others.extend(told.map(|text| OtherShot { differs, is_scaled, text }));
        }
    }
    others.into_iter().unique_by(|other| other.text.clone()).collect()
}

/// What of earlier shots differs from the plan, in sentences: such observations tell of no shot of it.
pub fn shots_that_differ(case: &Case, files: &[Observations]) -> Vec<String> {
    other_shots(case, files).into_iter().filter(|other| other.differs).map(|other| other.text).collect()
}

/// The mass of a tire [kg] in the words of a cover, such as `280 kg tires, 140 kg/m2`: the first that is not of an area.
fn mass_of_tires(cover: &str) -> Option<f64> {
    cover.match_indices("kg").find_map(|(at, _)| {
        let (before, after) = (cover[..at].trim_end(), &cover[at + 2..]);
        let number = before.rsplit(|sign: char| !sign.is_ascii_digit() && sign != '.').next()?;
        number.parse().ok().filter(|_| !after.trim_start().starts_with('/'))
    })
}

/// `20 ms · 3:1 height_m at 0.3 s`.
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

/// A value with the digits of another's standard deviation.
fn value_by_sd(value: f64, sd: f64) -> String {
    if value.is_nan() {
        return say!("never");
    }
    units::value_and_sd(value, sd).split(' ').next().unwrap_or_default().to_owned()
}

/// What was seen that speaks against the verdicts of the plan, and logged firing times that do, in words.
pub fn contradiction(case: &Case, rows: &[ObservedRow<'_>], logged: &[MeasuredFiring]) -> Vec<String> {
    let found = find_contradictions(case, seen_and_predicted(rows), logged);
    found.iter().map(|found| contradiction_words(case, found)).collect()
}

/// What was seen of each row, and what was possible.
pub fn seen_and_predicted(rows: &[ObservedRow<'_>]) -> Vec<(Observation, Prediction)> {
    rows.iter().map(|row| (*row.observed, *row.prediction)).collect()
}

/// What speaks against the verdicts of a plan, in words.
pub fn contradiction_words(case: &Case, contradiction: &Contradiction) -> String {
    match contradiction {
        Contradiction::OverLimit { seen, limit } => {
            let unit = match seen.watched.quantity {
                ObservedQuantity::Force => Unit::Kilonewton,
                _ => Unit::Metre,
            };
            let place = place(case, seen.option, &seen.watched);
            let [value, limit] = [seen.value, *limit].map(|value| units::value(value, unit));
            say!(
                "{place}: {value} {} was seen, over the limit of {limit}",
                place,
                value,
                unit.symbol(),
                limit
            )
        }
        Contradiction::FarOutside { seen, band: [low, _] } if low.is_nan() => {
            let (place, value) = (place(case, seen.option, &seen.watched), value_by_sd(seen.value, seen.sd));
            say!("{place}: {value} was seen; by this plan it hardly ever flies", place, value)
        }
        Contradiction::FarOutside { seen, band: [low, high] } => {
            let [value, low, high] = [seen.value, *low, *high].map(|value| value_by_sd(value, seen.sd));
            let place = place(case, seen.option, &seen.watched);
            say!(
                "{place}: {value} was seen, far outside what this plan predicts, {low} to {high}",
                place,
                value,
                low,
                high
            )
        }
        Contradiction::Unpredicted { of: 1, .. } => say!(
            "outside what this plan predicts: the one observation of an earlier shot; do not fire by its verdicts before it agrees with it"
        ),
        Contradiction::Unpredicted { outside, of } => say!(
            "outside what this plan predicts: {outside} of {of} observations of earlier shots; do not fire by its verdicts before it agrees with them",
            outside,
            of
        ),
        Contradiction::FiredOtherwise { far, logged, fired, planned } => {
            let [at, planned] = [fired.time, *planned].map(units::milliseconds);
            let (tire, option) = (case.scene().tire_ids[fired.tire], &case.plan.delays[fired.option].name);
            say!(
                "{} of {} logged firing times are not those of the plan, nor within what [uncertainty] says of delays: {option}, under tire {tire}, {at} instead of {planned}",
                far,
                logged,
                option,
                tire,
                at,
                planned
            )
        }
    }
}

/// How many observations lie in their bands: of each shot, and of all.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What an option was seen at, of values that the plan predicts between 0.9 and 1.1 m.
    fn told(seen: &[(usize, f64)]) -> Vec<String> {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml").to_owned();
        let source = crate::plan::PlanSource { path: String::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let watched = ObservedPoint { quantity: ObservedQuantity::FlightHeight, index: 0, time: 0.0 };
        let observation =
            |&(option, value): &(usize, f64)| Observation { option, watched, value, sd: 0.02, line: 1 };
        let observed: Vec<Observation> = seen.iter().map(observation).collect();
        let predictions = vec![Prediction { planned: 1.0, band: Some([0.9, 1.1]) }; seen.len()];
        contradiction(&case, &observed_rows(&case, &observed, &predictions), &[])
    }

    /// A log within what the detonators scatter says nothing; 10 ms later, and rows in another order, are told.
    #[test]
    fn logged_times_that_are_not_those_of_the_plan_are_told() {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml").to_owned();
        let source = crate::plan::PlanSource { path: String::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let second = *case.shots[option].firings.iter().find(|firing| firing.row == 1).expect("a row");
        let told = |time: f64| {
            let fired = MeasuredFiring { option, tire: second.tire, time: second.time + time };
            contradiction(&case, &[], &[fired]).join("; ")
        };
        assert_eq!(told(0.3e-3), "");
        for off in [10e-3, -0.042] {
            assert!(told(off).starts_with("1 of 1 logged"), "{off}");
        }
        // Of delays that scatter by their length all together scatter by no more than one: 5 x 4 % of 42 ms and 1 ms are 9.4 ms.
        let mut case = case.clone();
        case.plan.uncertainty.delay = crate::plan::DelayScatter { sd_ms: 0.0, cv_percent: 4.0 };
        for (off, is_told) in [(9e-3, false), (10e-3, true)] {
            let fired = MeasuredFiring { option, tire: second.tire, time: second.time + off };
            assert_eq!(contradiction(&case, &[], &[fired]).len(), usize::from(is_told), "{off}");
        }
    }

    /// One of ten lies outside by chance, one far outside does not, to neither side; and calm shots do not hide one that was not.
    #[test]
    fn neither_many_others_nor_calm_shots_hide_what_contradicts_the_plan() {
        let ten = [(0, 1.0); 10];
        assert_eq!(told(&ten), [""; 0]);
        assert_eq!(told(&[&ten[..], &[(0, 1.2)]].concat()), [""; 0]);
        for far in [1.25, 0.75] {
            let told = told(&[&ten[..], &[(0, far)]].concat());
            assert!(told.len() == 1 && told[0].contains("far outside"), "{told:?}");
        }
        assert!(
            told(&[(0, 1.12)])[0].contains("the one observation of an earlier shot"),
            "{:?}",
            told(&[(0, 1.12)])
        );
        let of_two = told(&[&ten[..], &[(1, 1.12), (1, 1.12)]].concat());
        assert!(of_two.len() == 1 && of_two[0].contains("2 of 2 observations"), "{of_two:?}");
        let one_shot = [(1, 1.2), (1, 1.0), (1, 1.2)];
        let against = told(&[&ten[..], &one_shot].concat());
        assert!(against.len() == 1 && against[0].contains("2 of 3 observations"), "{against:?}");
        // Those of new shots stand apart from those of shots that the plan was fitted to.
        assert_eq!(told(&[&one_shot[..1], &ten, &one_shot[1..]].concat()), against);
    }
}
