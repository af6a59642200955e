//! Values of a report. Each value knows how exact it is, and in which unit people read it.

use crate::plan::Time;
use crate::scene::TireId;
use crate::units::Unit;
use crate::verdict::{Verdict, VerdictWord};

/// One entry of a table. Numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// No value.
    Nothing,
    /// A name or words.
    Text(String),
    /// Several values.
    List(Vec<Cell>),
    /// Sentences.
    Sentences(Vec<String>),
    /// Address of a tire.
    Tire(TireId),
    /// Addresses of the tires at both ends of a cable.
    Cable([TireId; 2]),
    /// Named values. Only JSON shows them.
    Object(Vec<Fact>),
    /// Verdict as people read it: PASS, THIN, HOLD, OPEN or FAIL.
    Verdict(VerdictWord),
    /// Yes or no.
    Flag(bool),
    /// A count.
    Count(usize),
    /// A number as the plan or the catalogue gives it, with all its digits.
    Number(f64),
    /// A number, and the number of its decimals.
    Rounded(f64, usize),
    /// A value with its one-sided error.
    Estimate {
        /// Value [SI].
        value: f64,
        /// One-sided error [SI].
        error: f64,
        /// Unit in which people read the value.
        unit: Unit,
    },
    /// A value without an error beside it: the error stands elsewhere. Faces show the finest digits that are worth reading.
    Value(f64, Unit),
    /// 5th, 50th and 95th percentile, and the greatest value.
    Spread([f64; 4], Unit),
    /// 5th, 50th and 95th percentile. People read the first and the last.
    Band([f64; 3], Unit),
    /// A duration [s].
    Time(f64),
    /// A firing time or an interval between firings [s], with all its digits: somebody programs it into detonators.
    Interval(f64),
    /// Breaking force over force; infinite where no cable pulls.
    Factor(f64),
    /// Greatest value over its limit: utilization.
    Utilization(f64),
    /// Error over value.
    RelativeError(f64),
    /// Lower and upper bound of a probability, 0 to 1.
    Probability([f64; 2]),
    /// Energy residual over the energy that the holes put in.
    Residual(f64),
    /// A series over equal stretches of time, drawn as bars.
    Sparkline {
        /// Greatest value of each stretch.
        series: Vec<f64>,
        /// Value that fills a bar.
        top: f64,
    },
}

macro_rules! cell_from {
    ($($from:ty => $cell:expr),* $(,)?) => {
        $(impl From<$from> for Cell {
            fn from(value: $from) -> Self {
                $cell(value)
            }
        })*
    };
}

cell_from! {
    String => Cell::Text,
    &str => |text: &str| Cell::Text(text.to_owned()),
    &String => |text: &String| Cell::Text(text.clone()),
    VerdictWord => Cell::Verdict,
    Verdict => |verdict: Verdict| Cell::Verdict(verdict.into()),
    bool => Cell::Flag,
    usize => Cell::Count,
    f64 => Cell::Number,
    Time => |time: Time| Cell::Number(time.seconds()),
    [f64; 2] => |ends: [f64; 2]| Cell::list(ends),
    [Time; 2] => |ends: [Time; 2]| Cell::list(ends),
    TireId => Cell::Tire,
    [TireId; 2] => Cell::Cable,
    Vec<Fact> => Cell::Object,
    Vec<String> => |texts: Vec<String>| Cell::list(texts),
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Nothing, Into::into)
    }
}

impl Cell {
    /// Numbers of the cell, with all their digits. Empty where the cell holds no numbers.
    pub fn numbers(&self) -> Vec<f64> {
        match *self {
            Cell::Number(number)
            | Cell::Rounded(number, _)
            | Cell::Value(number, _)
            | Cell::Time(number)
            | Cell::Interval(number)
            | Cell::Factor(number)
            | Cell::Utilization(number)
            | Cell::RelativeError(number)
            | Cell::Residual(number) => vec![number],
            Cell::Estimate { value, error, .. } => vec![value, error],
            Cell::Spread(values, _) => values.to_vec(),
            Cell::Band(values, _) => values.to_vec(),
            Cell::Probability(interval) => interval.to_vec(),
            _ => Vec::new(),
        }
    }

    /// A cell with a list of values.
    pub fn list<T: Into<Cell>>(values: impl IntoIterator<Item = T>) -> Self {
        Cell::List(values.into_iter().map(Into::into).collect())
    }
}

/// A named value of the JSON document.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Names of the numbers of the value, as [`paths`](Column::paths) of a column.
    pub paths: &'static [&'static str],
    /// The value.
    pub value: Cell,
    /// Whether the value recommends something. Where no pass of the plan stands, the fact has no value.
    pub is_advice: bool,
}

/// A fact with these names and this value.
pub fn fact(paths: &'static [&'static str], value: impl Into<Cell>) -> Fact {
    Fact { paths, value: value.into(), is_advice: false }
}

/// A fact that recommends something.
pub fn advice(paths: &'static [&'static str], value: impl Into<Cell>) -> Fact {
    Fact { is_advice: true, ..fact(paths, value) }
}
