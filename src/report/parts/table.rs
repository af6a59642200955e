//! A table: rows of cells under columns, for people and for scripts.

use std::ops::Range;

use super::cell::{Cell, fact};
use crate::plan::DelayOption;
use crate::units::Unit;
use crate::verdict::Verdict;

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

impl Cell {
    /// What JSON has of an item.
    pub fn object<T>(fields: &[Field<T>], item: &T) -> Self {
        let fact = |field: &Field<T>| fact(field.column.paths, (field.cell)(item));
        Cell::Object(fields.iter().map(fact).collect())
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
