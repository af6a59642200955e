//! The properties of a plan's key: name, kind of value, default, description, and display in the terminal's editor.
//!
//! [`table`] holds the keys themselves. The reader, the schema, the starter plan and the editor know a key only from that table.

mod table;

use std::ops::RangeInclusive;

pub use table::*;

/// One section of a plan.
#[derive(Debug)]
pub struct Section {
    /// Header of the section in messages: `[tire]`, `[[delay]]`.
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
    /// Kind of the value.
    pub kind: Kind,
    /// A valid value as a plan writes it; for a section, the keys to begin with.
    pub example: &'static str,
    /// Description, without the unit.
    pub doc: &'static str,
    /// Whether a section without the key is always a mistake.
    pub required: bool,
    /// Value that counts if the plan leaves the key out.
    pub default: Option<DefaultValue>,
    /// Least and greatest usual value. Other values are valid, but the program warns of them.
    pub usual: Option<[f64; 2]>,
    /// Display in the terminal's editor. `None`: the user edits the key only in the file.
    pub edit: Option<Edit>,
}

/// Kind of a key's value.
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
    /// A name from the rope catalogue.
    Catalogue(fn() -> Vec<&'static str>),
    /// A list of values of one kind.
    List(&'static Kind),
    /// Names of the blast rows in an order.
    RowNames,
    /// Two numbers of one kind, the smaller first. The value is any number between them.
    Range(&'static Kind),
    /// A section.
    Section(&'static Section),
    /// Any number of sections.
    Sections(&'static Section),
    /// A number, or a section with a number for each direction.
    NumberOrSection(&'static Kind, &'static Section),
    /// A list of numbers, or a section that describes them.
    ListOrSection(&'static Kind, &'static Section),
    /// Yes or no.
    Flag,
}

/// Value that counts if the plan leaves a key out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// A number.
    Number(f64),
    /// A name.
    Name(&'static str),
    /// A value that depends on the plan, described.
    Described(&'static str),
}

/// Display of a key in the terminal's editor.
#[derive(Clone, Copy, Debug)]
pub struct Edit {
    /// Label beside the value, with the unit.
    pub label: &'static str,
    /// When the editor shows the key although the plan leaves it out.
    pub offered: Offered,
}

/// When the editor shows a key although the plan leaves it out.
#[derive(Clone, Copy, Debug)]
pub enum Offered {
    /// Never.
    Never,
    /// Always.
    Always,
    /// If the section has this other key.
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

    /// The names to choose from; empty if the value is no name.
    pub fn names(&self) -> Vec<&'static str> {
        match self {
            Self::Choice(names) => names.to_vec(),
            Self::Catalogue(names) => names(),
            Self::Flag => vec!["true", "false"],
            Self::List(item) => item.names(),
            _ => Vec::new(),
        }
    }

    /// Unit of the numbers; empty if they have none.
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

    /// Name of the kind in messages.
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

    /// Shows the key in the editor, for plans that have the key.
    const fn edit(mut self, label: &'static str) -> Self {
        self.edit = Some(Edit { label, offered: Offered::Never });
        self
    }

    /// Shows the key in the editor, for every plan.
    const fn offered(self) -> Self {
        self.offered_where(Offered::Always)
    }

    /// Shows the key in the editor, if its section has this other key.
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
