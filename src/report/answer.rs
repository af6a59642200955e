//! What was found → report: the one place that words an answer.

use super::brief::Brief;
use super::parts::{Block, Cell, Report};
use crate::study::question::{Found, with_questions};
use crate::study::{Case, PlanFile};
use crate::verdict::Verdict;

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, {$report:ident $(, $brief:ident)?}), )+) => {
        /// The report of what was found of a plan.
        pub fn answer(case: &Case, found: &Found) -> Report {
            let mut report = match found { $( Found::$Name(found) => super::$study::$report(case, found), )+ };
            if case.file == PlanFile::Changed {
                take_passes_back(&mut report);
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
