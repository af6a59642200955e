//! What was found → report: the one place that words an answer.

use std::borrow::Cow;

use itertools::Itertools;

use super::brief::Brief;
use super::language::phrase;
use super::parts::{Block, Cell, Report};
use super::words::objections;
use crate::study::Case;
use crate::study::question::{Found, with_questions};
use crate::study::standing::{Hold, Standing};
use crate::verdict::Verdict;

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, {$report:ident $(, $brief:ident)?}), )+) => {
        fn worded(case: &Case, found: &Found) -> Report {
            match found { $( Found::$Name(found) => super::$study::$report(case, found), )+ }
        }

        /// The same in one line, where the question is [listed](crate::study::study_trait::Listed).
        pub fn in_brief(case: &Case, found: &Found) -> Option<Brief> {
            match found {
                $( Found::$Name(found) => {
                    let _ = (case, found);
                    Vec::from([$( super::$study::$brief(case, found) )?]).pop()
                } )+
            }
        }
    };
}
with_questions!(declare_answer);

/// The report of what was found of a plan, as if its passes stood: nobody reads it without saying how the plan stands.
#[derive(Clone, Debug)]
pub struct Unheld(Report);

impl Unheld {
    /// Words what was found.
    pub fn of(case: &Case, found: &Found) -> Self {
        Self(worded(case, found))
    }

    /// The report of a plan that stands so, of what was `found`, which it is of. Where passes do not stand, nothing passes in it, and what
    /// chooses among options recommends nothing.
    pub fn under(&self, standing: &Standing, found: &Found) -> Cow<'_, Report> {
        let mut report = Cow::Borrowed(&self.0);
        if standing.against_passes().is_some() {
            hold(report.to_mut(), found, standing);
        }
        report
    }

    /// What the report concludes of options, as if passes stood.
    pub fn concluded(&self) -> Option<Verdict> {
        let of_options = self.0.conclusion.as_ref().filter(|conclusion| conclusion.label.is_none());
        of_options.map(|conclusion| conclusion.word.verdict())
    }
}

/// The report of what was found of a plan that stands so, with what speaks against it.
pub fn answer(case: &Case, standing: &Standing, found: &Found) -> Report {
    let report = Unheld::of(case, found).under(standing, found).into_owned();
    with_objections(report, case, standing)
}

/// A report that recommends, of a plan that stands so, with what speaks against it.
pub fn held(mut report: Report, case: &Case, standing: &Standing) -> Report {
    if let Some(why) = standing.against_passes() {
        withhold(&mut report, why_held(why));
    }
    with_objections(report, case, standing)
}

fn with_objections(mut report: Report, case: &Case, standing: &Standing) -> Report {
    let against = objections::against_plan(case, standing);
    report.warnings = report.warnings.into_iter().chain(against).unique().collect();
    report
}

/// Where passes of the plan do not stand, takes those back that a report of what was found shows; what chooses among options recommends
/// nothing then, and what compares what was seen, or shows a shot, goes on to say it.
fn hold(report: &mut Report, found: &Found, standing: &Standing) {
    let Some(why) = standing.against_passes() else { return };
    match found {
        Found::Fit(_) | Found::Flight(_) | Found::Accuracy(_) => take_passes_back(report),
        _ => withhold(report, why_held(why)),
    }
}

/// Why no pass of a plan stands.
pub fn why_held(hold: Hold) -> &'static str {
    phrase(match hold {
        Hold::FileChanged => "the plan is no longer the one that was judged",
        Hold::NotCompared => "observations of earlier shots are not compared with this plan",
        Hold::Contradicted => "observations of earlier shots speak against this plan and its verdicts",
    })
}

/// Nothing of a report passes, and neither a sentence, a number, a chart nor an offer recommends anything; `why` stands in place of what was
/// concluded.
pub fn withhold(report: &mut Report, why: &str) {
    take_passes_back(report);
    // A table without a key is words for people, as sentences are.
    report.blocks.retain(|block| match block {
        Block::Text(_) => false,
        Block::Table(table) => !table.key.is_empty() && !table.is_advice,
        Block::Facts(_) | Block::Chart(_) | Block::Picture(_) => true,
    });
    for block in &mut report.blocks {
        match block {
            Block::Facts(facts) => {
                let advice = facts.iter_mut().filter(|fact| fact.is_advice);
                advice.for_each(|fact| fact.value = Cell::Nothing);
            }
            Block::Table(table) => table.rows.iter_mut().for_each(|row| row.offer = None),
            Block::Chart(chart) => chart.windows.clear(),
            Block::Text(_) | Block::Picture(_) => {}
        }
    }
    report.answer = None;
    if let Some(conclusion) = &mut report.conclusion {
        conclusion.text = why.to_owned();
    }
}

/// Nothing of a report passes.
pub fn take_passes_back(report: &mut Report) {
    fn take_back(cell: &mut Cell) {
        match cell {
            Cell::Verdict(word) => *word = word.held(),
            Cell::List(cells) => cells.iter_mut().for_each(take_back),
            Cell::Object(facts) => facts.iter_mut().for_each(|fact| take_back(&mut fact.value)),
            _ => {}
        }
    }
    for block in &mut report.blocks {
        match block {
            Block::Table(table) => table.rows.iter_mut().flat_map(|row| &mut row.cells).for_each(take_back),
            Block::Facts(facts) => facts.iter_mut().for_each(|fact| take_back(&mut fact.value)),
            Block::Text(_) | Block::Chart(_) | Block::Picture(_) => {}
        }
    }
    if let Some(conclusion) = &mut report.conclusion {
        conclusion.word = conclusion.word.held();
    }
}
