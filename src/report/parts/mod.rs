//! A result as data: what was found, ready to be drawn by every face.
//!
//! Numbers stay numbers, SI, beside the unit in which people read them. A report holds no widths, colours, escapes or
//! rounded numbers: faces choose the first three, [`units`](crate::units) words the last.
//!
//! | what | where |
//! |---|---|
//! | rows under columns, what a row offers to do with the plan | [`table`] |
//! | the values in them, and those that only JSON has | [`cell`] |
//! | series over two axes | [`chart`] |

mod cell;
mod chart;
mod table;

pub use self::cell::{Cell, Fact, advice, fact};
pub use self::chart::{Axis, Chart, Scale, Series, SeriesKind};
pub use self::table::{Align, Audience, Column, Detail, Field, Offer, Row, Table};
use crate::verdict::VerdictWord;

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
