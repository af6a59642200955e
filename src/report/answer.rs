//! What was found → report: the one place that words an answer.

use super::brief::Brief;
use super::language::phrase;
use super::parts::{Block, Cell, Report};
use crate::study::Case;
use crate::study::question::{Found, with_questions};
use crate::study::standing::Standing;
use crate::verdict::Verdict;

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, {$report:ident $(, $brief:ident)?}), )+) => {
        /// The report of what was found of a plan.
        pub fn answer(case: &Case, found: &Found) -> Report {
            let mut report = match found { $( Found::$Name(found) => super::$study::$report(case, found), )+ };
            if Standing::of(case, false).against_passes().is_some() {
                withhold(&mut report, phrase("the plan is no longer the one that was judged"));
            }
            report
        }

        /// The same in one line, where the question is [listed](crate::study::settings::Listed).
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

/// Key of the table of the sizes that hold.
const CHOICES: &str = "frontier";
/// Facts that tell what is chosen, or among what: of a size all of the lightest stand without a name.
const OF_CHOICE: [&str; 4] = ["found", "windows_s", "nominal_windows_s", ""];

/// Takes the passes back that a report of what was found shows, for a reason; what chooses among options recommends nothing then, and what
/// compares what was seen, or shows a shot, goes on to say it.
pub fn hold(report: &mut Report, found: &Found, why: &str) {
    match found {
        Found::Fit(_) | Found::Flight(_) | Found::Accuracy(_) => take_passes_back(report),
        _ => withhold(report, why),
    }
}

/// Where passes do not stand, nothing passes, and neither a sentence, a number, a chart nor an offer recommends anything; `why` stands in
/// place of what was concluded.
pub fn withhold(report: &mut Report, why: &str) {
    take_passes_back(report);
    // A table without a key is words for people: what is recommended, and which windows pass.
    report.blocks.retain(|block| match block {
        Block::Text(_) => false,
        Block::Table(table) => !table.key.is_empty() && table.key != CHOICES,
        Block::Facts(_) | Block::Chart(_) | Block::Picture(_) => true,
    });
    report.warnings.retain(|warning| !warning.starts_with("the recommended interval"));
    for block in &mut report.blocks {
        match block {
            Block::Facts(facts) => {
                let is_choice = |path: &&str| path.starts_with("recommended") || OF_CHOICE.contains(path);
                let of_choice = facts.iter_mut().filter(|fact| fact.paths.iter().any(is_choice));
                of_choice.for_each(|fact| fact.value = Cell::Nothing);
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

/// Where the plan is no longer what was judged, or what was seen speaks against it, nothing passes.
pub fn take_passes_back(report: &mut Report) {
    fn take_back(cell: &mut Cell) {
        match cell {
            Cell::Verdict(verdict) => *verdict = (*verdict).max(Verdict::Undecided),
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
        conclusion.verdict = conclusion.verdict.max(Verdict::Undecided);
    }
}
