//! What a key of a plan is: name, kind of value, default, description, and how the terminal's editor shows it.
//!
//! [`table`] holds the keys themselves. The reader, the schema, the starter plan and the editor take all they know of a
//! key from that table.

mod table;

use std::ops::RangeInclusive;

pub use table::*;

/// One section of a plan.
#[derive(Debug)]
pub struct Section {
    /// The section as messages name it: `[tire]`, `[[delay]]`.
    pub title: &'static str,
    /// Description.
    pub doc: &'static str,
    /// Keys that the section may have.
    pub keys: &'static [&'static Key],
}

/// One key of a section.
#[derive(Debug)]
pub struct Key {
    /// Name in the plan.
    pub name: &'static str,
    /// What the value may be.
    pub kind: Kind,
    /// A right value as a plan writes it; for a section the keys to begin with.
    pub example: &'static str,
    /// Description, without the unit.
    pub doc: &'static str,
    /// Whether a section without the key is always a mistake.
    pub required: bool,
    /// The value where the plan leaves the key out.
    pub default: Option<DefaultValue>,
    /// Least and greatest value that is no surprise; others are right, but are warned of.
    pub usual: Option<[f64; 2]>,
    /// How the terminal's editor shows the key; `None`: the key is edited in the file only.
    pub edit: Option<Edit>,
}

/// What the value of a key may be.
#[derive(Debug)]
pub enum Kind {
    /// A number in a unit; the unit may be empty.
    Number {
        /// Unit of the value.
        unit: &'static str,
        /// Smallest and largest value.
        range: RangeInclusive<f64>,
    },
    /// The number of a shelter row; half numbers address the centres of a quincunx.
    ShelterRow(RangeInclusive<f64>),
    /// A whole number.
    Whole(RangeInclusive<usize>),
    /// A text in one line.
    Text,
    /// One of a few names.
    Choice(&'static [&'static str]),
    /// A name of the rope catalogue.
    Catalogue(fn() -> Vec<&'static str>),
    /// A list of values of one kind.
    List(&'static Kind),
    /// Names of the blast rows in an order.
    RowNames,
    /// Two numbers of one kind, the smaller first: the value is anything between.
    Range(&'static Kind),
    /// A section.
    Section(&'static Section),
    /// Any number of sections.
    Sections(&'static Section),
    /// A number, or a section with a number for each direction.
    NumberOrSection(&'static Kind, &'static Section),
    /// A list of numbers, or a section that says which.
    ListOrSection(&'static Kind, &'static Section),
    /// Yes or no.
    Flag,
}

/// The value of a key that the plan leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// A number.
    Number(f64),
    /// A name.
    Name(&'static str),
    /// A value that depends on the plan, described.
    Described(&'static str),
}

/// How the terminal's editor shows a key.
#[derive(Clone, Copy, Debug)]
pub struct Edit {
    /// Label beside the value, with the unit.
    pub label: &'static str,
    /// When the editor shows a key that the plan leaves out.
    pub offered: Offered,
}

/// When the editor shows a key that the plan leaves out.
#[derive(Clone, Copy, Debug)]
pub enum Offered {
    /// Never.
    Never,
    /// Always.
    Always,
    /// Where the section has this key.
    Beside(&'static str),
}

const UNBOUNDED: &RangeInclusive<f64> = &(f64::MIN..=f64::MAX);

impl Kind {
    /// Smallest and largest number that a value of this kind may hold.
    pub fn range(&self) -> &RangeInclusive<f64> {
        match self {
            Self::Number { range, .. } | Self::ShelterRow(range) => range,
            Self::List(number)
            | Self::Range(number)
            | Self::NumberOrSection(number, _)
            | Self::ListOrSection(number, _) => number.range(),
            _ => UNBOUNDED,
        }
    }

    /// Smallest and largest whole number that a value of this kind may hold.
    pub fn whole_range(&self) -> RangeInclusive<usize> {
        if let Self::Whole(range) = self { range.clone() } else { 0..=usize::MAX }
    }

    /// The names to choose from; empty where the value is no name.
    pub fn names(&self) -> Vec<&'static str> {
        match self {
            Self::Choice(names) => names.to_vec(),
            Self::Catalogue(names) => names(),
            Self::Flag => vec!["true", "false"],
            Self::List(item) => item.names(),
            _ => Vec::new(),
        }
    }

    /// The unit of its numbers; empty where they have none.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Number { unit, .. } => unit,
            Self::List(number)
            | Self::Range(number)
            | Self::NumberOrSection(number, _)
            | Self::ListOrSection(number, _) => number.unit(),
            _ => "",
        }
    }

    /// The section or sections that the key holds.
    pub fn section(&self) -> Option<&'static Section> {
        match self {
            Self::Section(section)
            | Self::Sections(section)
            | Self::NumberOrSection(_, section)
            | Self::ListOrSection(_, section) => Some(section),
            _ => None,
        }
    }

    /// Whether a value is a text in quotes.
    pub fn is_text(&self) -> bool {
        matches!(self, Self::Text | Self::Choice(_) | Self::Catalogue(_))
    }

    /// The kind as messages name it.
    pub fn wanted(&self) -> &'static str {
        match self {
            Self::Number { .. } | Self::ShelterRow(_) | Self::NumberOrSection(..) => "a number",
            Self::Whole(_) => "a whole number of 0 or more",
            Self::Text | Self::Choice(_) | Self::Catalogue(_) => "a text in quotes",
            Self::List(_) | Self::RowNames | Self::Range(_) | Self::ListOrSection(..) => "a list",
            Self::Flag => "true or false",
            Self::Section(_) => "one table",
            Self::Sections(_) => "a list of tables",
        }
    }
}

const fn key(name: &'static str, kind: Kind, example: &'static str, doc: &'static str) -> Key {
    Key { name, kind, example, doc, required: false, default: None, usual: None, edit: None }
}

const fn number(unit: &'static str, range: RangeInclusive<f64>) -> Kind {
    Kind::Number { unit, range }
}

const fn section(name: &'static str, section: &'static Section, example: &'static str) -> Key {
    key(name, Kind::Section(section), example, section.doc)
}

impl Key {
    const fn required(mut self) -> Self {
        self.required = true;
        self
    }

    const fn default(mut self, number: f64) -> Self {
        self.default = Some(DefaultValue::Number(number));
        self
    }

    const fn usual(mut self, low: f64, high: f64) -> Self {
        self.usual = Some([low, high]);
        self
    }

    const fn named(mut self, default: &'static str) -> Self {
        self.default = Some(DefaultValue::Name(default));
        self
    }

    const fn described(mut self, default: &'static str) -> Self {
        self.default = Some(DefaultValue::Described(default));
        self
    }

    /// The editor shows the key, in a plan that has the key.
    const fn edit(mut self, label: &'static str) -> Self {
        self.edit = Some(Edit { label, offered: Offered::Never });
        self
    }

    /// The editor shows the key in every plan.
    const fn offered(self) -> Self {
        self.offered_where(Offered::Always)
    }

    /// The editor shows the key in a section that has this other key.
    const fn offered_beside(self, key: &'static str) -> Self {
        self.offered_where(Offered::Beside(key))
    }

    const fn offered_where(mut self, offered: Offered) -> Self {
        if let Some(edit) = &mut self.edit {
            edit.offered = offered;
        }
        self
    }
}
