//! A table: rows of cells under columns, for people and for scripts.

use std::ops::Range;

use super::cell::{Cell, fact};
use crate::plan::DelayOption;
use crate::units::Unit;
use crate::verdict::Verdict;

/// Rows of cells under columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Name of the list of rows in JSON; empty where JSON leaves the table out.
    pub key: &'static str,
    /// Whether the table recommends something. Where no pass of the plan stands, the table is left out.
    pub is_advice: bool,
    /// Columns from left to right (`n_columns`).
    pub columns: Vec<Column>,
    /// Rows from top to bottom.
    pub rows: Vec<Row>,
    /// Whether rows run from the worst to the best. A face short of room then shows both ends.
    pub ranked: bool,
}

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Names of the column's numbers in CSV, with their SI unit. Scripts read these names. A value with an error has two names. CSV
    /// leaves out a number whose name is empty, and a column without names.
    pub keys: &'static [&'static str],
    /// Names of the column's numbers in JSON; the CSV names unless set otherwise. A dot puts a name into an object. A `?` at the
    /// end of a name leaves the name out where it has no value. Several numbers under one name become a list. The values of an
    /// object with an empty name stand among the values around it.
    pub paths: &'static [&'static str],
    /// Heading for people, without the unit.
    pub heading: &'static str,
    /// Second line of the heading; empty where there is none.
    pub subheading: &'static str,
    /// Unit in which people read the column.
    pub unit: Unit,
    /// Side on which the cells stand.
    pub align: Align,
    /// Who sees the column.
    pub shown: Audience,
    /// Rank for leaving the column out. Text short of room leaves out columns with greater numbers first, and never columns with 0.
    pub spare: u8,
    /// Rank for leaving the column out. A terminal screen short of room leaves out columns with greater numbers first.
    pub gives_way: u8,
}

/// A column, and the function that returns its cell for an item.
#[derive(Debug)]
pub struct Field<T> {
    /// The column.
    pub column: Column,
    /// Returns the cell of an item.
    pub cell: fn(&T) -> Cell,
}

impl<T> Field<T> {
    /// A field of `column`.
    pub const fn new(column: Column, cell: fn(&T) -> Cell) -> Self {
        Self { column, cell }
    }

    /// A field that only scripts read, with these names in CSV and JSON.
    pub const fn scripts(keys: &'static [&'static str], cell: fn(&T) -> Cell) -> Self {
        Self::new(Column::scripts(keys), cell)
    }

    /// A field that only JSON shows.
    pub const fn json(paths: &'static [&'static str], cell: fn(&T) -> Cell) -> Self {
        Self::new(Column::scripts(&[]).json(paths), cell)
    }
}

impl Table {
    /// A table of columns, and of rows with one cell per column.
    pub fn new(columns: &[Column], rows: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        let row = |cells: Vec<Cell>| {
            assert_eq!(cells.len(), columns.len(), "one cell a column");
            Row { cells, ..Row::default() }
        };
        Self { columns: columns.to_vec(), rows: rows.into_iter().map(row).collect(), ..Self::default() }
    }

    /// A table with one row per item.
    pub fn of<T>(fields: &[Field<T>], items: impl IntoIterator<Item = T>) -> Self {
        let columns: Vec<Column> = fields.iter().map(|field| field.column).collect();
        let cells = |item: T| fields.iter().map(|field| (field.cell)(&item)).collect();
        Self::new(&columns, items.into_iter().map(cells))
    }
}

impl Table {
    /// The same table; its rows become a list of the JSON document under this name.
    pub fn key(self, key: &'static str) -> Self {
        Self { key, ..self }
    }

    /// The same table, marked as a recommendation.
    pub fn as_advice(self) -> Self {
        Self { is_advice: true, ..self }
    }

    /// The same table with one more column, which only JSON shows.
    pub fn and(mut self, paths: &'static [&'static str], cells: impl IntoIterator<Item = Cell>) -> Self {
        self.columns.push(Column::scripts(&[]).json(paths));
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.cells.push(cell);
        }
        self
    }

    /// The same table; people do not see it where it has no rows.
    pub fn unless_empty(self) -> Self {
        if self.rows.is_empty() { self.json_only() } else { self }
    }

    /// The same table, only in the JSON document.
    pub fn json_only(mut self) -> Self {
        self.columns = self.columns.into_iter().map(Column::json_only).collect();
        self
    }

    /// Indices of the columns that a face shows. `shown` says for which audiences.
    pub fn columns_for(&self, shown: impl Fn(Audience) -> bool) -> Vec<usize> {
        (0..self.columns.len()).filter(|&n| shown(self.columns[n].shown)).collect()
    }

    /// Indices of the rows that a face leaves out. The face shows `at_each_end` rows at each end of a ranking.
    pub fn left_out(&self, at_each_end: usize) -> Range<usize> {
        let rows = self.rows.len();
        if self.ranked && rows > 2 * at_each_end { at_each_end..rows - at_each_end } else { 0..0 }
    }

    /// The same table; each row offers one of these changes of the plan, in their order.
    pub fn offering(mut self, offers: impl IntoIterator<Item = Offer>) -> Self {
        for (row, offer) in self.rows.iter_mut().zip(offers) {
            row.offer = Some(offer);
        }
        self
    }
}

impl Row {
    /// Number of leading columns of `seen` that have a cell to show. A row with a reason for missing values shows the columns
    /// before its first empty cell. Any other row shows all.
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

    /// The same column, for another audience.
    pub const fn shown(self, shown: Audience) -> Self {
        Self { shown, ..self }
    }

    /// The same column, with a rank for leaving it out of text that is short of room: greater numbers go first.
    pub const fn spare(self, spare: u8) -> Self {
        Self { spare, ..self }
    }

    /// The same column, with a rank for leaving it out of a screen that is short of room: greater numbers go first.
    pub const fn gives_way(self, gives_way: u8) -> Self {
        Self { gives_way, ..self }
    }

    /// The same column, hidden from scripts.
    pub const fn without_keys(self) -> Self {
        Self { keys: &[], paths: &[], ..self }
    }

    /// The same column, only in the JSON document.
    pub const fn json_only(self) -> Self {
        Self { keys: &[], shown: Audience::Scripts, ..self }
    }

    /// The same column, with these names in JSON.
    pub const fn json(self, paths: &'static [&'static str]) -> Self {
        Self { paths, ..self }
    }

    /// The same column, with a second heading line.
    pub const fn under(self, subheading: &'static str) -> Self {
        Self { subheading, ..self }
    }
}

impl Cell {
    /// The JSON object of an item.
    pub fn object<T>(fields: &[Field<T>], item: &T) -> Self {
        let fact = |field: &Field<T>| fact(field.column.paths, (field.cell)(item));
        Cell::Object(fields.iter().map(fact).collect())
    }
}

/// Side of a column on which the cells stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// For names and sentences.
    Left,
    /// For numbers.
    Right,
}

/// People who see a column. Scripts read the column by its keys, whatever the audience.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Audience {
    /// Readers of text, terminal and page.
    People,
    /// Readers of text and terminal.
    Text,
    /// Readers of the page.
    Page,
    /// Nobody: the column is for scripts.
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
    /// Cells, one per column (`n_columns`).
    pub cells: Vec<Cell>,
    /// Reason why the row has no values. It stands in their place.
    pub missing: Option<String>,
    /// Sentences below the row, each with its verdict.
    pub details: Vec<Detail>,
    /// Change of the plan that the row offers.
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
