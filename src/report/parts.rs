//! A result as data: what was found, ready to be drawn by every face.
//!
//! Numbers stay numbers, SI, beside the unit in which people read them. A report holds no widths, colours, escapes or
//! rounded numbers: faces choose the first three, [`units`](crate::units) words the last.

use std::ops::Range;

use crate::plan::{DelayOption, Time};
use crate::scene::TireId;
use crate::units::Unit;
use crate::verdict::{Verdict, VerdictWord};

/// What a study found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Name and version of its JSON document; empty where it has none.
    pub schema: &'static str,
    /// Title and file of the plan; empty where the report is about no plan.
    pub title: String,
    /// Facts of the plan that hold for all results: size, limits.
    pub facts: Vec<String>,
    /// Results, from top to bottom.
    pub blocks: Vec<Block>,
    /// What a reader must know beside the results, one sentence each.
    pub warnings: Vec<String>,
    /// What is recommended; begins the last line of text.
    pub answer: Option<String>,
    /// What the results come to; in the last line of text, or in the one before.
    pub conclusion: Option<Conclusion>,
}

impl Report {
    /// The charts, with those that text leaves out.
    pub fn charts(&self) -> impl Iterator<Item = &Chart> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Chart(chart) | Block::Picture(chart) => Some(chart),
            Block::Text(_) | Block::Table(_) | Block::Facts(_) => None,
        })
    }
}

/// A verdict and its reason: `FAIL, slide NOT checked: 1 of 7 options pass`.
#[derive(Clone, Debug, PartialEq)]
pub struct Conclusion {
    /// The verdict on everything asked for, as people read it.
    pub word: VerdictWord,
    /// What none of the passes of the report is about, behind the verdict: `, slide NOT checked`, or nothing.
    pub unchecked: &'static str,
    /// The reason, without the verdict.
    pub text: String,
    /// What people read in place of the word, where it is no verdict on options.
    pub label: Option<&'static str>,
}

impl Conclusion {
    /// A verdict on options, and its reason.
    pub fn new(word: VerdictWord, text: String) -> Self {
        Self { word, unchecked: "", text, label: None }
    }

    /// A verdict that people read by another name, because it is none on options.
    pub fn labelled(word: VerdictWord, label: &'static str, text: String) -> Self {
        Self { label: Some(label), ..Self::new(word, text) }
    }

    /// What stands before the reason.
    pub fn label(&self) -> &'static str {
        self.label.unwrap_or(self.word.for_people())
    }
}

/// A part of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Sentences that belong together, one a line.
    Text(Vec<String>),
    /// Rows of cells.
    Table(Table),
    /// A chart that every face draws; text draws bars or marks.
    Chart(Chart),
    /// A chart for faces that draw pictures; text leaves it out.
    Picture(Chart),
    /// Single values of the JSON document; people read them in sentences.
    Facts(Vec<Fact>),
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

/// Rows of cells under columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Name of the list of its rows in JSON; empty where JSON leaves the table out.
    pub key: &'static str,
    /// Whether it recommends something: it is left out where no pass of the plan stands.
    pub is_advice: bool,
    /// From left to right (`n_columns`).
    pub columns: Vec<Column>,
    /// From top to bottom.
    pub rows: Vec<Row>,
    /// Whether rows run from the worst to the best, so that a face short of room shows both ends.
    pub ranked: bool,
}

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Names of its numbers in CSV, with their SI unit: what scripts read. A value with an error has two names, a number
    /// without a name is left out; a column that CSV does not have has none.
    pub keys: &'static [&'static str],
    /// Names of its numbers in JSON, those of CSV unless told otherwise. A dot puts a name into an object, and `?` at its end
    /// leaves it out where it has no value; numbers under one name are a list; the values of an object without a name stand
    /// among those around it.
    pub paths: &'static [&'static str],
    /// Heading for people, without the unit.
    pub heading: &'static str,
    /// Second line of the heading; empty where there is none.
    pub subheading: &'static str,
    /// Unit in which people read the column.
    pub unit: Unit,
    /// Side on which cells stand.
    pub align: Align,
    /// Who sees the column.
    pub shown: Audience,
    /// Text that is short of room leaves out columns of greater numbers first, and never those of 0.
    pub spare: u8,
    /// A screen of the terminal that is short of room leaves out columns of greater numbers first.
    pub gives_way: u8,
}

/// A column, and its cell in the row of an item.
#[derive(Debug)]
pub struct Field<T> {
    /// The column.
    pub column: Column,
    /// The cell of an item.
    pub cell: fn(&T) -> Cell,
}

impl<T> Field<T> {
    /// A field of `column`.
    pub const fn new(column: Column, cell: fn(&T) -> Cell) -> Self {
        Self { column, cell }
    }

    /// A field that only scripts read, by these names in CSV and JSON.
    pub const fn scripts(keys: &'static [&'static str], cell: fn(&T) -> Cell) -> Self {
        Self::new(Column::scripts(keys), cell)
    }

    /// A field of the JSON document alone.
    pub const fn json(paths: &'static [&'static str], cell: fn(&T) -> Cell) -> Self {
        Self::new(Column::scripts(&[]).json(paths), cell)
    }
}

impl Table {
    /// A table of columns and of the cells of its rows, one cell a column.
    pub fn new(columns: &[Column], rows: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        let row = |cells: Vec<Cell>| {
            assert_eq!(cells.len(), columns.len(), "one cell a column");
            Row { cells, ..Row::default() }
        };
        Self { columns: columns.to_vec(), rows: rows.into_iter().map(row).collect(), ..Self::default() }
    }

    /// A table with a row for each item.
    pub fn of<T>(fields: &[Field<T>], items: impl IntoIterator<Item = T>) -> Self {
        let columns: Vec<Column> = fields.iter().map(|field| field.column).collect();
        let cells = |item: T| fields.iter().map(|field| (field.cell)(&item)).collect();
        Self::new(&columns, items.into_iter().map(cells))
    }
}

impl Table {
    /// The same table, whose rows are a list of the JSON document.
    pub fn key(self, key: &'static str) -> Self {
        Self { key, ..self }
    }

    /// The same table, which recommends something.
    pub fn as_advice(self) -> Self {
        Self { is_advice: true, ..self }
    }

    /// The same table with a column more, which only JSON has.
    pub fn and(mut self, paths: &'static [&'static str], cells: impl IntoIterator<Item = Cell>) -> Self {
        self.columns.push(Column::scripts(&[]).json(paths));
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.cells.push(cell);
        }
        self
    }

    /// The same table, which people do not see where it has no rows.
    pub fn unless_empty(self) -> Self {
        if self.rows.is_empty() { self.json_only() } else { self }
    }

    /// The same table in the JSON document alone.
    pub fn json_only(mut self) -> Self {
        self.columns = self.columns.into_iter().map(Column::json_only).collect();
        self
    }

    /// Indices of the columns that a face shows, by for whom they are.
    pub fn columns_for(&self, shown: impl Fn(Audience) -> bool) -> Vec<usize> {
        (0..self.columns.len()).filter(|&n| shown(self.columns[n].shown)).collect()
    }

    /// Indices of the rows that a face leaves out where it shows so many at each end of a ranking.
    pub fn left_out(&self, at_each_end: usize) -> Range<usize> {
        let rows = self.rows.len();
        if self.ranked && rows > 2 * at_each_end { at_each_end..rows - at_each_end } else { 0..0 }
    }

    /// The same table, whose rows offer these changes of the plan, in their order.
    pub fn offering(mut self, offers: impl IntoIterator<Item = Offer>) -> Self {
        for (row, offer) in self.rows.iter_mut().zip(offers) {
            row.offer = Some(offer);
        }
        self
    }
}

impl Row {
    /// How many of the columns `seen` have a value before the reason why the others have none.
    pub fn count_known(&self, seen: &[usize]) -> usize {
        match self.missing {
            Some(_) => seen.iter().take_while(|&&n| self.cells[n] != Cell::Nothing).count(),
            None => seen.len(),
        }
    }
}

impl Column {
    /// A column of words.
    pub const fn words(keys: &'static [&'static str], heading: &'static str) -> Self {
        Self {
            keys,
            paths: keys,
            heading,
            subheading: "",
            unit: Unit::One,
            align: Align::Left,
            shown: Audience::People,
            spare: 0,
            gives_way: 0,
        }
    }

    /// A column of numbers.
    pub const fn numbers(keys: &'static [&'static str], heading: &'static str, unit: Unit) -> Self {
        Self { unit, align: Align::Right, ..Self::words(keys, heading) }
    }

    /// A column that only scripts read.
    pub const fn scripts(keys: &'static [&'static str]) -> Self {
        Self { shown: Audience::Scripts, ..Self::words(keys, "") }
    }

    /// The same column, shown to others.
    pub const fn shown(self, shown: Audience) -> Self {
        Self { shown, ..self }
    }

    /// The same column, left out by text that is short of room: those of greater numbers first.
    pub const fn spare(self, spare: u8) -> Self {
        Self { spare, ..self }
    }

    /// The same column, left out by a screen that is short of room: those of greater numbers first.
    pub const fn gives_way(self, gives_way: u8) -> Self {
        Self { gives_way, ..self }
    }

    /// The same column, not read by scripts.
    pub const fn without_keys(self) -> Self {
        Self { keys: &[], paths: &[], ..self }
    }

    /// The same column in the JSON document alone.
    pub const fn json_only(self) -> Self {
        Self { keys: &[], shown: Audience::Scripts, ..self }
    }

    /// The same column, with these names in JSON.
    pub const fn json(self, paths: &'static [&'static str]) -> Self {
        Self { paths, ..self }
    }

    /// The same column with a second line of heading.
    pub const fn under(self, subheading: &'static str) -> Self {
        Self { subheading, ..self }
    }
}

/// Side of a column on which its cells stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Names and sentences.
    Left,
    /// Numbers.
    Right,
}

/// Who sees a column, besides the scripts that read its keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Audience {
    /// Readers of text, terminal and page.
    People,
    /// Readers of text and terminal.
    Text,
    /// Readers of the page.
    Page,
    /// No reader: the column is for scripts.
    Scripts,
}

impl Audience {
    /// Whether readers of text and terminal see the column.
    pub fn is_in_text(self) -> bool {
        matches!(self, Audience::People | Audience::Text)
    }
}

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// One cell a column (`n_columns`).
    pub cells: Vec<Cell>,
    /// Why the row has no values; stands in their place.
    pub missing: Option<String>,
    /// Sentences below the row.
    pub details: Vec<Detail>,
    /// What the row offers to do with the plan.
    pub offer: Option<Offer>,
}

/// A change of the plan that a row offers.
#[derive(Clone, Debug, PartialEq)]
pub enum Offer {
    /// A delay option to add.
    Option(DelayOption),
    /// A shelter to use.
    Sizes {
        /// Name of the rope.
        rope: String,
        /// Mass of a tire [kg].
        tire_mass: f64,
        /// Rows of ballast on each side.
        border_rows: usize,
    },
}

/// A sentence below a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// The verdict that the sentence explains.
    pub verdict: Verdict,
    /// The sentence.
    pub text: String,
}

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

    /// What JSON has of an item.
    pub fn object<T>(fields: &[Field<T>], item: &T) -> Self {
        let fact = |field: &Field<T>| fact(field.column.paths, (field.cell)(item));
        Cell::Object(fields.iter().map(fact).collect())
    }
}

/// Series over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What is drawn: `flight height against the interval`.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Drawn in this order.
    pub series: Vec<Series>,
    /// Limit of the quantity on the vertical axis.
    pub limit: Option<f64>,
    /// Ranges of the horizontal axis that are marked, and what they are.
    pub windows: Vec<[f64; 2]>,
    /// What the marked ranges are, for the key: no pass of them is proven.
    pub windows_are: &'static str,
    /// Firing times, on the horizontal axis.
    pub firings: Vec<f64>,
}

/// An axis; its numbers are SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Quantity.
    pub name: &'static str,
    /// Unit in which people read it.
    pub unit: Unit,
    /// Even distances or even ratios.
    pub scale: Scale,
    /// Both ends; powers of ten where the scale is logarithmic.
    pub range: [f64; 2],
}

/// How numbers lie on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// At even distances.
    Linear,
    /// At even ratios.
    Logarithmic,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in a legend.
    pub name: &'static str,
    /// What the points are.
    pub kind: SeriesKind,
    /// Values on the horizontal and on the vertical axis.
    pub points: Vec<(f64, f64)>,
}

/// What the points of a series are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// The quantity that the chart is about: a line.
    Curve,
    /// What the curve is compared with: a line.
    Comparison,
    /// The shot as planned behind the one that decides: a line.
    Planned,
    /// The lower end of the band of nine in ten shots: a line.
    Low,
    /// Its upper end: a line.
    High,
    /// Single results: points.
    Points,
}
