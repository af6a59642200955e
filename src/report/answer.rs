//! Answer of a study → report. No other module words an answer.

use std::borrow::Cow;

use itertools::Itertools;

use super::brief::Brief;
use super::language::phrase;
use super::parts::{Block, Cell, Report};
use super::words::{headline, objections};
use crate::study::Case;
use crate::study::question::{Found, with_questions};
use crate::study::standing::{Hold, Standing};
use crate::verdict::{Verdict, VerdictWord};

macro_rules! brief_of {
    ($case:ident, $found:ident, $study:ident, $brief:ident) => {
        Some(super::$study::$brief($case, $found))
    };
    ($case:ident, $found:ident, $study:ident) => {{
        let _ = $found;
        None
    }};
}

macro_rules! declare_answer {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, {$report:ident $(, $brief:ident)?}), )+) => {
        fn worded(case: &Case, found: &Found) -> Report {
            match found { $( Found::$Name(found) => super::$study::$report(case, found), )+ }
        }

        /// The answer in one line; `None` where the question is not [listed](crate::study::study_trait::Listed).
        pub fn in_brief(case: &Case, found: &Found) -> Option<Brief> {
            match found {
                $( Found::$Name(found) => brief_of!(case, found, $study $(, $brief)?), )+
            }
        }
    };
}
with_questions!(declare_answer);

/// The report of an answer, worded as if its passes stood. Nobody reads the report without the standing of its plan.
#[derive(Clone, Debug)]
pub struct ReportAsIfStanding(Report);

impl ReportAsIfStanding {
    /// Words the answer `found`.
    pub fn of(case: &Case, found: &Found) -> Self {
        let mut report = worded(case, found);
        say_what_is_unchecked(&mut report, case);
        Self(report)
    }

    /// The report under the standing of its plan. `found` is the answer that the report words. Where passes do not stand, nothing
    /// in the report passes, and a report that chooses among options recommends nothing.
    pub fn under(&self, standing: &Standing, found: &Found) -> Cow<'_, Report> {
        let mut report = Cow::Borrowed(&self.0);
        if standing.against_passes().is_some() {
            hold(report.to_mut(), found, standing);
        }
        report
    }

    /// Conclusion on options, as if passes stood; `None` where the report has no conclusion on options.
    pub fn concluded(&self) -> Option<VerdictWord> {
        let of_options = self.0.conclusion.as_ref().filter(|conclusion| conclusion.label.is_none());
        of_options.map(|conclusion| conclusion.word)
    }
}

/// Adds what no pass covers to the conclusion, where anything in the report passes. A recommendation says so itself.
fn say_what_is_unchecked(report: &mut Report, case: &Case) {
    let tells_passes = report.answer.is_none() && tells_a_pass(report);
    let concluded = report.conclusion.as_mut().filter(|concluded| concluded.label.is_none());
    if let Some(concluded) = concluded.filter(|_| tells_passes) {
        concluded.unchecked = headline::unchecked(case);
    }
}

/// Whether anything in a report passes, also as planned only.
fn tells_a_pass(report: &Report) -> bool {
    fn passes(cell: &Cell) -> bool {
        match cell {
            Cell::Verdict(word) => word.verdict() == Verdict::Pass,
            Cell::List(cells) => cells.iter().any(passes),
            Cell::Object(facts) => facts.iter().any(|fact| passes(&fact.value)),
            _ => false,
        }
    }
    let concluded = report.conclusion.as_ref().is_some_and(|told| told.word.verdict() == Verdict::Pass);
    concluded
        || report.blocks.iter().any(|block| match block {
            Block::Table(table) => table.rows.iter().flat_map(|row| &row.cells).any(passes),
            Block::Facts(facts) => facts.iter().any(|fact| passes(&fact.value)),
            Block::Text(_) | Block::Chart(_) | Block::Picture(_) => false,
        })
}

/// The report of an answer under the standing of its plan, with what speaks against the plan.
pub fn answer(case: &Case, standing: &Standing, found: &Found) -> Report {
    let report = ReportAsIfStanding::of(case, found).under(standing, found).into_owned();
    with_objections(report, case, standing)
}

/// A report that recommends, under the standing of its plan, with what speaks against the plan.
pub fn held(mut report: Report, case: &Case, standing: &Standing) -> Report {
    if let Some(why) = standing.against_passes() {
        withhold(&mut report, why_held(why));
    }
    say_what_is_unchecked(&mut report, case);
    with_objections(report, case, standing)
}

fn with_objections(mut report: Report, case: &Case, standing: &Standing) -> Report {
    let against = objections::against_plan(case, standing);
    report.warnings = report.warnings.into_iter().chain(against).unique().collect();
    report
}

/// Takes back the passes in the report of an answer, where passes of the plan do not stand. A report that chooses among options
/// then recommends nothing. A report that compares observations, or shows a shot, keeps its words.
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

/// Takes back the passes of a report, and every sentence, number, chart window and offer that recommends. `why` replaces the text
/// of the conclusion.
pub fn withhold(report: &mut Report, why: &str) {
    take_passes_back(report);
    // A table without a key holds words for people, as sentences do.
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

/// Takes back the passes of a report: PASS and THIN become HOLD.
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
        conclusion.unchecked = "";
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::parts::{Column, Conclusion, Fact, Offer, Row, Table, advice, fact};
    use crate::study::fit::ComparedWithObservations;
    use crate::study::fit::observed_shots::ObservedShots;
    use crate::study::observed::{Comparison, NotCompared};
    use crate::study::standing::tests::case;
    use crate::study::{Computed, FileState};
    use crate::verdict::VerdictWord;

    /// A report with passes in cells, in lists, in objects and in the conclusion.
    fn report() -> Report {
        let (pass, fail) = (Cell::Verdict(VerdictWord::Pass), Cell::Verdict(VerdictWord::Fail));
        let facts =
            || -> Vec<Fact> { vec![fact(&["verdict"], pass.clone()), advice(&["best"], Cell::Count(1))] };
        let cells =
            vec![pass.clone(), Cell::List(vec![pass.clone(), fail.clone()]), Cell::Object(facts()), fail];
        let offer = Offer::Sizes { rope: "r".to_owned(), tire_mass: 280.0, border_rows: 0 };
        let row = Row { cells, offer: Some(offer), ..Row::default() };
        let columns = vec![Column::scripts(&[]); 4];
        let table = |key, is_advice| {
            let (columns, rows) = (columns.clone(), vec![row.clone()]);
            Block::Table(Table { key, is_advice, columns, rows, ranked: false })
        };
        let words = Block::Text(vec!["42 ms is the best".to_owned()]);
        let blocks = vec![
            words,
            table("options", false),
            table("advice", true),
            table("", false),
            Block::Facts(facts()),
        ];
        let conclusion = Conclusion::new(VerdictWord::Thin, "1 of 1 passes".to_owned());
        let answer = Some("42 ms is recommended".to_owned());
        Report { blocks, conclusion: Some(conclusion), answer, ..Report::default() }
    }

    /// The verdicts that a report shows, and the number of its cells with a value.
    fn shown(report: &Report) -> (Vec<VerdictWord>, usize) {
        fn of(cell: &Cell) -> (Vec<VerdictWord>, usize) {
            let inner = match cell {
                Cell::Verdict(word) => return (vec![*word], 1),
                Cell::Nothing => return (vec![], 0),
                Cell::List(cells) => cells.iter().map(of).collect(),
                Cell::Object(facts) => facts.iter().map(|fact| of(&fact.value)).collect(),
                _ => vec![(vec![], 1)],
            };
            inner
                .into_iter()
                .fold((vec![], 0), |(words, count), (more, n)| ([words, more].concat(), count + n))
        }
        let cells = report.blocks.iter().flat_map(|block| match block {
            Block::Table(table) => table.rows.iter().flat_map(|row| row.cells.clone()).collect(),
            Block::Facts(facts) => facts.iter().map(|fact| fact.value.clone()).collect(),
            _ => Vec::new(),
        });
        of(&Cell::List(cells.collect()))
    }

    const HELD: [VerdictWord; 5] =
        [VerdictWord::Hold, VerdictWord::Hold, VerdictWord::Fail, VerdictWord::Hold, VerdictWord::Fail];

    #[test]
    fn a_report_of_a_plan_on_hold_passes_nothing_and_recommends_nothing() {
        for (file, compared, why) in [
            (FileState::Changed, Comparison::nothing_seen(), Hold::FileChanged),
            (FileState::AsJudged, Comparison::not_compared(NotCompared::NotYet), Hold::NotCompared),
        ] {
            let held = held(report(), &case(), &Standing::of(&case(), file, compared));
            let (words, count) = shown(&held);
            assert_eq!((words, count), ([&HELD[..], &[VerdictWord::Hold]].concat(), 7));
            assert!(held.blocks.iter().all(|block| match block {
                Block::Table(table) =>
                    table.key == "options" && table.rows.iter().all(|row| row.offer.is_none()),
                block => matches!(block, Block::Facts(_)),
            }));
            let conclusion = held.conclusion.expect("it holds");
            assert_eq!((conclusion.word, conclusion.text.as_str()), (VerdictWord::Hold, why_held(why)));
            assert_eq!(held.answer, None);
        }
        assert!(why_held(Hold::FileChanged).contains("no longer the one that was judged"));
        let stands = Standing::of(&case(), FileState::AsJudged, Comparison::nothing_seen());
        assert_eq!(held(report(), &case(), &stands).blocks, report().blocks);
    }

    /// A report that compares observations keeps its words, but nothing in it passes.
    #[test]
    fn a_comparison_of_a_plan_on_hold_keeps_its_words() {
        let compared = ComparedWithObservations {
            fitted: None,
            new: Vec::new(),
            files: Vec::new(),
            seen: ObservedShots::new(&[]),
            predictions: Vec::new(),
            is_sampled: false,
        };
        let found = Found::Fit(Box::new(Computed::complete(compared)));
        let unheld = ReportAsIfStanding(report());
        let [stands, changed] = [FileState::AsJudged, FileState::Changed]
            .map(|file| Standing::of(&case(), file, Comparison::nothing_seen()));
        assert_eq!(*unheld.under(&stands, &found), report());
        let held = unheld.under(&changed, &found);
        let (words, _) = shown(&held);
        assert!(held.blocks.len() == report().blocks.len() && held.answer.is_some());
        assert!(words.iter().all(|word| matches!(word, VerdictWord::Hold | VerdictWord::Fail)), "{words:?}");
        assert_eq!(held.conclusion.as_ref().map(|conclusion| conclusion.word), Some(VerdictWord::Hold));
    }

    /// A conclusion says what no pass covers as long as anything passes: the conclusion itself, a cell, or a value deep in a cell.
    /// It does not where an answer says so itself, where a label shows that it covers no options, or where the plan limits slide.
    #[test]
    fn a_conclusion_that_tells_of_a_pass_says_what_no_pass_is_about() {
        let [limited, unlimited] = [Some(1.0), None].map(|drift| {
            let mut case = case();
            case.limits.drift = drift;
            case
        });
        let said = |change: fn(&mut Report), case: &Case| {
            let mut report = report();
            report.answer = None;
            change(&mut report);
            say_what_is_unchecked(&mut report, case);
            report.conclusion.map(|conclusion| conclusion.unchecked)
        };
        fn fails(report: &mut Report) {
            report.conclusion = Some(Conclusion::new(VerdictWord::Fail, "0 of 1 pass".to_owned()));
            report.blocks.clear();
        }
        fn with(report: &mut Report, cell: Cell) {
            fails(report);
            report.blocks.push(Block::Facts(vec![fact(&["deep"], cell)]));
        }
        const SAID: Option<&str> = Some(", slide NOT checked");
        assert_eq!([&unlimited, &limited].map(|case| said(|_| {}, case)), [SAID, Some("")]);
        assert_eq!(said(fails, &unlimited), Some(""));
        assert_eq!(said(|report| report.answer = Some("42 ms passes".to_owned()), &unlimited), Some(""));
        assert_eq!(
            said(|report| report.conclusion.as_mut().expect("one").label = Some("Done"), &unlimited),
            Some("")
        );
        fn thin() -> Cell {
            Cell::Verdict(VerdictWord::Thin)
        }
        assert_eq!(said(|report| with(report, thin()), &unlimited), SAID);
        assert_eq!(said(|report| with(report, Cell::List(vec![Cell::Count(1), thin()])), &unlimited), SAID);
        assert_eq!(said(|report| with(report, Cell::Object(vec![fact(&["in"], thin())])), &unlimited), SAID);
        assert_eq!(said(|report| with(report, Cell::Verdict(VerdictWord::Open)), &unlimited), Some(""));
    }

    #[test]
    fn what_is_concluded_of_options_has_no_other_label() {
        let word = report().conclusion.map(|conclusion| conclusion.word);
        assert_eq!(ReportAsIfStanding(report()).concluded(), word);
        let mut labelled = report();
        labelled.conclusion.as_mut().expect("one").label = Some("Done");
        assert_eq!(ReportAsIfStanding(labelled).concluded(), None);
    }
}
