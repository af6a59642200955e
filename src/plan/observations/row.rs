//! One line of observations. Each value is checked, and each mistake has a remedy.

use itertools::Itertools;

use super::{
    AT, CABLE, COLUMNS, Columns, FIRING, MeasuredFiring, OPTION, ObservableNames, Observation, ObservedPoint,
    QUANTITY, SD, TIRE, VALUE, mistake, unit,
};
use crate::choice::ObservedQuantity;
use crate::plan::diagnostic::Mistake;
use crate::plan::import::number::value;
use crate::plan::import::table::Line;
use crate::plan::names;
use crate::plan::reader::nearest;

/// Content of a line.
pub(super) enum Seen {
    /// An observed value.
    Value(Observation),
    /// A measured firing time.
    Firing(MeasuredFiring),
}

/// Greatest distance of a measured firing time from the planned one [s]: more than any detonator scatters.
const FAR_FIRING: f64 = 1.0;

/// A line being read.
pub(super) struct Row<'r> {
    pub(super) line: &'r Line,
    pub(super) columns: &'r Columns,
    pub(super) known: &'r ObservableNames,
    /// Whether numbers have decimal commas.
    pub(super) comma: bool,
}

/// Least force of a cable that is taken for newtons [N]: a smaller number is probably a force in kN.
pub const LEAST_FORCE: f64 = 1000.0;

/// The value, unless it is a force that may be in kN. At a cable that may stay slack, such a small force would contradict nothing.
fn in_newtons(quantity: ObservedQuantity, value: f64) -> Result<f64, (String, String)> {
    match quantity == ObservedQuantity::Force && value > 0.0 && value < LEAST_FORCE {
        false => Ok(value),
        true => Err((
            format!("`{value}` N is very little for a cable: is it in kN?"),
            format!(
                "write newtons, {:.0} where kN were meant; leave the line out where the cable hardly pulled",
                value * 1e3
            ),
        )),
    }
}

impl Row<'_> {
    /// The text in a column; `None` where it is empty.
    fn text(&self, column: usize) -> Option<&str> {
        let text = self.line.values.get(self.columns.position[column]?)?;
        Some(text.as_str()).filter(|text| !text.is_empty())
    }

    /// Content of the line; adds every mistake of the line to `mistakes`.
    pub(super) fn read(&self, mistakes: &mut Vec<Mistake>) -> Option<Seen> {
        let (line, width) = (self.line, self.columns.width);
        if line.runs_on {
            mistakes.push(mistake(line, "a value runs over several lines", "is a quotation mark missing?"));
            return None;
        }
        let extra = line.values.iter().skip(width).any(|value| !value.is_empty());
        if line.values.len() < width || extra {
            let message = format!("the line has {} values, the header {width}", line.values.len());
            let remedy = "leave a value that is not known empty between its separators; numbers with decimal commas need semicolons between them";
            mistakes.push(mistake(line, message, remedy));
            return None;
        }
        if self.text(QUANTITY).is_some_and(|name| name.eq_ignore_ascii_case(FIRING)) {
            return match self.firing() {
                Ok(firing) => Some(Seen::Firing(firing)),
                Err((message, remedy)) => {
                    mistakes.push(mistake(line, message, remedy));
                    None
                }
            };
        }
        let mut keep = |found: Result<f64, (String, String)>| match found {
            Ok(number) => number,
            Err((message, remedy)) => {
                mistakes.push(mistake(line, message, remedy));
                f64::NAN
            }
        };
        let (quantity, is_known) = match self.quantity() {
            Ok(quantity) => (quantity, true),
            Err(wrong) => {
                keep(Err(wrong));
                (ObservedQuantity::FlightHeight, false)
            }
        };
        let option = keep(self.option().map(|option| option as f64));
        let columns = if quantity == ObservedQuantity::Force { [CABLE, TIRE] } else { [TIRE, CABLE] };
        let index =
            if is_known { keep(self.index(quantity.name(), columns).map(|index| index as f64)) } else { 0.0 };
        let time = if is_known { keep(self.at(quantity)) } else { 0.0 };
        let value = self.number(VALUE, unit(quantity), 0.0).and_then(|value| in_newtons(quantity, value));
        let value = keep(value);
        let sd = keep(self.number(SD, unit(quantity), f64::MIN_POSITIVE));
        let whole = is_known && [option, index, time, value, sd].iter().all(|number| number.is_finite());
        let watched = ObservedPoint { quantity, index: index as usize, time };
        let observation = || Observation { option: option as usize, watched, value, sd, line: line.number };
        whole.then(|| Seen::Value(observation()))
    }

    fn firing(&self) -> Result<MeasuredFiring, (String, String)> {
        let option = self.option()?;
        let tire = self.index(FIRING, [TIRE, CABLE])?;
        let time = self.number(VALUE, "s", f64::NEG_INFINITY)?;
        let address = self.text(TIRE).unwrap_or_default();
        if self.text(AT).is_some() {
            return Err((
                format!("`{FIRING}` states its time as the value"),
                "leave `at_s` empty".to_owned(),
            ));
        }
        if self.text(SD).is_some() {
            let message = format!("`{FIRING}` is taken as it was measured");
            return Err((message, "leave `sd` empty, or the line out where the time is not sure".to_owned()));
        }
        let planned =
            self.known.holes[option].iter().filter(|(other, _)| *other == tire).map(|(_, time)| *time);
        match planned.collect::<Vec<_>>()[..] {
            [planned] if (time - planned).abs() <= FAR_FIRING => Ok(MeasuredFiring { option, tire, time }),
            [planned] => Err((
                format!(
                    "`{time}` s is far from the {planned} s at which the hole under tire {address} fires as planned"
                ),
                "write seconds since time 0 of the plan".to_owned(),
            )),
            [] => Err((
                format!("no hole fires under tire {address}"),
                "name the tire above the hole".to_owned(),
            )),
            _ => Err((
                format!("more than one hole fires under tire {address}"),
                "leave the line out: which of them it means is not known".to_owned(),
            )),
        }
    }

    fn quantity(&self) -> Result<ObservedQuantity, (String, String)> {
        let names = || ObservedQuantity::NAMES.iter().copied().chain([FIRING]);
        let Some(name) = self.text(QUANTITY) else {
            return Err((
                "the line has no quantity".to_owned(),
                format!("write one of {}", names().join(", ")),
            ));
        };
        name.to_lowercase().parse().map_err(|_| {
            let near = nearest(&name.to_lowercase(), names());
            let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
            (
                format!("no quantity is called `{name}`"),
                format!("{near}write one of {}; values are in m, s and N", names().join(", ")),
            )
        })
    }

    fn option(&self) -> Result<usize, (String, String)> {
        let options = &self.known.options;
        let Some(name) = self.text(OPTION) else {
            return match options.len() {
                1 => Ok(0),
                _ => Err((
                    "the line does not say which delay option was fired".to_owned(),
                    format!("the plan has: {}", options.join("; ")),
                )),
            };
        };
        names::find(options.iter().map(String::as_str), name).ok_or_else(|| {
            (format!("the plan has no delay option `{name}`"), format!("it has: {}", options.join("; ")))
        })
    }

    /// Index of the tire or cable in the column `wanted`; the column `other` must be empty.
    fn index(&self, quantity: &str, [wanted, other]: [usize; 2]) -> Result<usize, (String, String)> {
        if self.text(other).is_some() {
            let message =
                format!("`{quantity}` is a quantity of a {}, not of a {}", COLUMNS[wanted], COLUMNS[other]);
            return Err((message, format!("leave the column `{}` empty", COLUMNS[other])));
        }
        let Some(text) = self.text(wanted) else {
            let example = if wanted == TIRE { "3:1" } else { "3:1-4:1" };
            let message = format!("`{quantity}` needs a {}", COLUMNS[wanted]);
            return Err((message, format!("write its address, such as {example}")));
        };
        if wanted == TIRE {
            return self.tire(text);
        }
        let (from, to) = text.split_once('-').ok_or_else(|| {
            (format!("`{text}` is no cable"), "write its two tires, such as 3:1-4:1".to_owned())
        })?;
        let ends = [self.tire(from)?, self.tire(to)?];
        let joins = |cable: &[usize; 2]| *cable == ends || *cable == [ends[1], ends[0]];
        self.known.cables.iter().position(joins).ok_or_else(|| {
            (format!("no cable joins the tires {from} and {to}"), "name two tires that are tied".to_owned())
        })
    }

    fn tire(&self, text: &str) -> Result<usize, (String, String)> {
        let parts: Vec<&str> = text.split(':').map(str::trim).collect();
        let numbers: Option<Vec<f64>> =
            parts.iter().map(|part| part.replace(',', ".").parse().ok()).collect();
        let tires = &self.known.tires;
        let last = tires.last().map_or_else(String::new, |numbers| numbers.iter().join(":"));
        match numbers {
            Some(numbers) if numbers.len() == 3 => Err((
                format!("`{text}` is no tire, but a time of day"),
                "a spreadsheet took ROW:COLUMN for a time: format the column as text".to_owned(),
            )),
            Some(numbers) => tires.iter().position(|tire| *tire == numbers).ok_or_else(|| {
                (format!("the shelter has no tire {text}"), format!("its last tire is {last}"))
            }),
            None => Err((format!("`{text}` is no tire"), format!("write its address as in {last}"))),
        }
    }

    fn at(&self, quantity: ObservedQuantity) -> Result<f64, (String, String)> {
        match (quantity == ObservedQuantity::Height, self.text(AT).is_some()) {
            (true, _) => self.number(AT, "s", 0.0),
            (false, false) => Ok(0.0),
            (false, true) => {
                let message = format!("`{quantity}` is no quantity of one time");
                Err((message, "leave `at_s` empty, or observe `height_m`".to_owned()))
            }
        }
    }

    /// A number that is at least `least`.
    fn number(&self, column: usize, unit: &str, least: f64) -> Result<f64, (String, String)> {
        let name = COLUMNS[column];
        let Some(text) = self.text(column) else {
            let remedy = match column {
                SD => format!("write the standard deviation of the value, in {unit}"),
                _ => format!("write a number, in {unit}"),
            };
            return Err((format!("the line has no `{name}`"), remedy));
        };
        match value(text, self.comma) {
            Some(number) if number >= least => Ok(number),
            Some(_) if column == SD => Err((
                format!("`{text}` is no standard deviation"),
                format!("write a number above 0, in {unit}: nothing is seen exactly"),
            )),
            Some(_) => {
                Err((format!("`{text}` is negative"), format!("write a number of 0 or more, in {unit}")))
            }
            None => Err((format!("`{text}` is no number"), format!("write the number alone, in {unit}"))),
        }
    }
}
