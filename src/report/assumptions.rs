//! `assumptions` as a report: for each option that passes, what its PASS stands on, the nearest first.

use super::parts::{Block, Cell, Column, Conclusion, Field, Report, Table};
use super::report_head;
use super::words::assumption_words::{ADVICE, holds, name, value};
use super::words::no_result;
use crate::study::assumptions::{Assumption, Assumptions, OptionAssumptions};
use crate::study::{Case, Computed};
use crate::units::Unit;
use crate::verdict::Verdict;

fn words(found: &Assumption, of: Option<f64>) -> Cell {
    of.map_or(Cell::Nothing, |number| Cell::Text(value(found.assumed, number)))
}

/// The first value that does not pass, in words.
fn fails_from(found: &Assumption) -> Cell {
    match found.fails_from {
        None if found.is_complete => Cell::Text("nothing fails".to_owned()),
        None => Cell::Text("not tried further".to_owned()),
        from => words(found, from),
    }
}

fn for_people<'a>() -> [Field<&'a Assumption>; 4] {
    let column = |heading| Column::numbers(&[], heading, Unit::One);
    [
        Field::new(Column::words(&[], "assumed"), |found| Cell::Text(name(found.assumed))),
        Field::new(column("stated"), |found| words(found, Some(found.stated))),
        Field::new(column("holds until"), |found| words(found, found.passes_until)),
        Field::new(column("fails from"), |found| fails_from(found)),
    ]
}

/// An assumption of an option.
struct ScriptRow<'a> {
    option: &'a str,
    samples: usize,
    found: &'a Assumption,
}

fn for_scripts<'a>() -> [Field<ScriptRow<'a>>; 7] {
    fn number(of: Option<f64>) -> Cell {
        of.map_or(Cell::Nothing, Cell::Number)
    }
    [
        Field::new(Column::scripts(&["option"]), |row| Cell::Text(row.option.to_owned())),
        Field::new(Column::scripts(&["name"]), |row| Cell::Text(row.found.assumed.name())),
        Field::new(Column::scripts(&["value"]), |row| Cell::Number(row.found.stated)),
        Field::new(Column::scripts(&["unit"]), |row| Cell::Text(row.found.assumed.unit().to_owned())),
        Field::new(Column::scripts(&["passes_until"]), |row| number(row.found.passes_until)),
        Field::new(Column::scripts(&["fails_from"]), |row| number(row.found.fails_from)),
        Field::new(Column::scripts(&["samples"]), |row| Cell::Count(row.samples)),
    ]
}

fn option_name(case: &Case, option: usize) -> &str {
    &case.plan.delays[option].name
}

/// The nearest assumptions of an option in a sentence, then all of them.
fn blocks(case: &Case, found: &Assumptions) -> Vec<Block> {
    let sentence = Block::Text(vec![format!("{} {}", option_name(case, found.option), holds(found))]);
    let table = Block::Table(Table::of(&for_people(), &found.all));
    if found.pass_as_stated() { vec![sentence, table] } else { vec![sentence] }
}

/// The table that scripts read.
fn scripts<'a>(case: &'a Case, all: impl Iterator<Item = &'a Assumptions>) -> Block {
    let rows = all.flat_map(|of_option| {
        let option = option_name(case, of_option.option);
        of_option.all.iter().map(move |found| ScriptRow { option, samples: of_option.samples, found })
    });
    Block::Table(Table::of(&for_scripts(), rows))
}

/// What the numbers are, and how many draws they rest on.
fn meaning(found: Option<&Assumptions>) -> Block {
    let draws = found.map(|found| match found.samples {
        0 => "the plan's own numbers only, nothing varied".to_owned(),
        samples => format!(
            "a value holds where the shot as planned does and at most {} of {samples} possible shots fail",
            found.accepted
        ),
    });
    Block::Text([ADVICE.to_owned()].into_iter().chain(draws).collect())
}

fn ended_early(partial: bool) -> Option<Conclusion> {
    let text = "ended early: not all values were tried".to_owned();
    partial.then_some(Conclusion { verdict: Verdict::Undecided, text })
}

/// The report of the options asked for, which is partial where the time was up.
pub fn report(case: &Case, Computed { value: all, partial }: &Computed<Vec<OptionAssumptions>>) -> Report {
    let found = || all.iter().filter_map(|of_option| of_option.assumptions.as_ref());
    let mut blocks_of_all: Vec<Block> = found().flat_map(|found| blocks(case, found)).collect();
    let without = all.iter().filter(|of_option| of_option.assumptions.is_none());
    let sentences = without.map(|of_option| {
        let why = match &of_option.judged {
            Err(reason) => no_result::message(reason),
            Ok(judged) => match judged.verdict() {
                Verdict::Pass => "PASS, the time was up before it was known on what it stands".to_owned(),
                verdict => format!("{}, there is no PASS to ask about", verdict.for_people()),
            },
        };
        format!("{}: {why}", option_name(case, of_option.option))
    });
    blocks_of_all.push(Block::Text(sentences.collect()));
    blocks_of_all.push(meaning(found().next()));
    blocks_of_all.push(scripts(case, found()));
    let sampled = found().next().is_none_or(|found| found.samples > 0);
    Report { blocks: blocks_of_all, conclusion: ended_early(*partial), ..report_head(case, sampled) }
}

/// The report of one option, which is partial where the time was up.
pub fn report_of_one(case: &Case, Computed { value: found, partial }: &Computed<Assumptions>) -> Report {
    let mut blocks = blocks(case, found);
    blocks.push(meaning(Some(found)));
    blocks.push(scripts(case, [found].into_iter()));
    Report { blocks, conclusion: ended_early(*partial), ..report_head(case, found.samples > 0) }
}
