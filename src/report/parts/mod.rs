//! A result as data, ready for every face to draw.
//!
//! Numbers stay numbers in SI, beside the unit in which people read them. A report holds no widths, colours, escapes or rounded
//! numbers. Faces choose widths, colours and escapes; [`units`](crate::units) rounds and words the numbers.
//!
//! | what | where |
//! |---|---|
//! | rows under columns, and the change of the plan that a row offers | [`table`] |
//! | the values in a table, and the values that only JSON shows | [`cell`] |
//! | series over two axes | [`chart`] |

mod cell;
mod chart;
mod table;

pub use self::cell::{Cell, Fact, advice, fact};
pub use self::chart::{Axis, Chart, Scale, Series, SeriesKind};
pub use self::table::{Align, Audience, Column, Detail, Field, Offer, Row, Table};
use crate::verdict::VerdictWord;

/// Report of a study: its results, warnings and conclusion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Name and version of the JSON document; empty where there is none.
    pub schema: &'static str,
    /// Title and file of the plan; empty where the report belongs to no plan.
    pub title: String,
    /// Facts of the plan that hold for all results: size and limits.
    pub facts: Vec<String>,
    /// Results, from top to bottom.
    pub blocks: Vec<Block>,
    /// Warnings that a reader needs beside the results, one sentence each.
    pub warnings: Vec<String>,
    /// Recommendation. It begins the last line of text, or is the last line where one line has no room for both.
    pub answer: Option<String>,
    /// Conclusion from all results. It ends the last line of text, or stands in the line before the recommendation.
    pub conclusion: Option<Conclusion>,
}

impl Report {
    /// All charts, also those that text leaves out.
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
    /// Verdict on everything asked for, as people read it.
    pub word: VerdictWord,
    /// What no pass of the report covers, behind the verdict: `, slide NOT checked`, or nothing.
    pub unchecked: &'static str,
    /// The reason, without the verdict.
    pub text: String,
    /// Text that people read instead of the verdict, where the conclusion is no verdict on options.
    pub label: Option<&'static str>,
}

impl Conclusion {
    /// A verdict on options and its reason.
    pub fn new(word: VerdictWord, text: String) -> Self {
        Self { word, unchecked: "", text, label: None }
    }

    /// A conclusion under another label, because it is no verdict on options.
    pub fn labelled(word: VerdictWord, label: &'static str, text: String) -> Self {
        Self { label: Some(label), ..Self::new(word, text) }
    }

    /// Label before the reason.
    pub fn label(&self) -> &'static str {
        self.label.unwrap_or(self.word.for_people())
    }
}

/// A part of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Sentences that belong together, one per line.
    Text(Vec<String>),
    /// Rows of cells.
    Table(Table),
    /// A chart that every face draws. Text draws it as bars or marks.
    Chart(Chart),
    /// A chart for faces that draw pictures. Text leaves it out.
    Picture(Chart),
    /// Single values of the JSON document. People read these values in sentences.
    Facts(Vec<Fact>),
}
