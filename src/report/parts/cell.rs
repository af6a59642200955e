//! The values of a report: each knows how exact it is, and in which unit people read it.

use crate::plan::Time;
use crate::scene::TireId;
use crate::units::Unit;
use crate::verdict::{Verdict, VerdictWord};

/// One entry of a table; numbers are SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// No value.
    Nothing,
    /// A name, or words.
    Text(String),
    /// Several values.
    List(Vec<Cell>),
    /// Sentences.
    Sentences(Vec<String>),
    /// The address of a tire.
    Tire(TireId),
    /// The addresses of both ends of a cable.
    Cable([TireId; 2]),
    /// Values with names, which only JSON has.
    Object(Vec<Fact>),
    /// Pass, open or fail, as people read it.
    Verdict(VerdictWord),
    /// Yes or no.
    Flag(bool),
    /// How many.
    Count(usize),
    /// A number as the plan or the catalogue gives it.
    Number(f64),
    /// A number, and its number of decimals.
    Rounded(f64, usize),
    /// A value with its error, one-sided.
    Estimate {
        /// The value.
        value: f64,
        /// The error.
        error: f64,
        /// Unit for people.
        unit: Unit,
    },
    /// A value whose error stands elsewhere, at the finest digits worth reading.
    Value(f64, Unit),
    /// 5th, 50th and 95th percentile, and greatest value.
    Spread([f64; 4], Unit),
    /// 5th, 50th and 95th percentile, of which people read the first and the last.
    Band([f64; 3], Unit),
    /// A stretch of time [s].
    Time(f64),
    /// A firing time or an interval between firings [s], with all its digits: somebody programs it.
    Interval(f64),
    /// Breaking force over force; infinite where no cable pulls.
    Factor(f64),
    /// Greatest value over its limit.
    Utilization(f64),
    /// Error over value.
    RelativeError(f64),
    /// Interval of a probability.
    Probability([f64; 2]),
    /// Energy residual over the energy put in.
    Residual(f64),
    /// A series over even stretches of time, as bars.
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
    /// The numbers of the cell, with all their digits; none where it holds something else.
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

    /// A list of values.
    pub fn list<T: Into<Cell>>(values: impl IntoIterator<Item = T>) -> Self {
        Cell::List(values.into_iter().map(Into::into).collect())
    }
}

/// A value of the JSON document.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its names, as the [`paths`](Column::paths) of a column.
    pub paths: &'static [&'static str],
    /// The value.
    pub value: Cell,
    /// Whether it recommends something: it has no value where no pass of the plan stands.
    pub is_advice: bool,
}

/// A fact of these names and this value.
pub fn fact(paths: &'static [&'static str], value: impl Into<Cell>) -> Fact {
    Fact { paths, value: value.into(), is_advice: false }
}

/// A fact that recommends something.
pub fn advice(paths: &'static [&'static str], value: impl Into<Cell>) -> Fact {
    Fact { is_advice: true, ..fact(paths, value) }
}
