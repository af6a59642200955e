//! `assumptions` as a report: for each option that passes, what its PASS stands on, the nearest assumption first.

use super::brief::Brief;
use super::parts::{Block, Cell, Column, Conclusion, Fact, Field, Report, Table, fact};
use super::report_head;
use super::words::assumption_words::{ADVICE, holds, name, nearest, value};
use super::words::no_result;
use crate::study::assumptions::{Assumption, Assumptions, OptionAssumptions};
use crate::study::judge::verdict_of;
use crate::study::{Case, Computed};
use crate::units::Unit;
use crate::verdict::{Verdict, VerdictWord};

fn words(found: &Assumption, of: Option<f64>) -> Cell {
    of.map(|number| value(found.assumed, number)).into()
}

/// The first value that does not pass, in words.
fn fails_from(found: &Assumption) -> Cell {
    match found.fails_from {
        None if found.is_complete => "no more tried".into(),
        None => "not tried further".into(),
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

/// An assumption of an option, for scripts.
struct ScriptRow<'a> {
    option: &'a str,
    samples: usize,
    found: &'a Assumption,
}

fn for_scripts<'a>() -> [Field<ScriptRow<'a>>; 7] {
    [
        Field::new(Column::scripts(&["option"]).json(&[]), |row| row.option.into()),
        Field::scripts(&["name"], |row| row.found.assumed.name().into()),
        Field::scripts(&["value"], |row| row.found.stated.into()),
        Field::scripts(&["unit"], |row| row.found.assumed.unit().into()),
        Field::scripts(&["passes_until"], |row| row.found.passes_until.into()),
        Field::scripts(&["fails_from"], |row| row.found.fails_from.into()),
        Field::scripts(&["samples"], |row| row.samples.into()),
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
    Block::Table(Table::of(&for_scripts(), all.flat_map(|of_option| script_rows(case, of_option))))
}

fn script_rows<'a>(case: &'a Case, of_option: &'a Assumptions) -> impl Iterator<Item = ScriptRow<'a>> {
    let option = option_name(case, of_option.option);
    of_option.all.iter().map(move |found| ScriptRow { option, samples: of_option.samples, found })
}

/// Facts of an option for scripts: its assumptions, where the option passes and the time was not up before.
fn option_facts(case: &Case, of_option: &OptionAssumptions) -> Vec<Fact> {
    let objects = |found| Cell::list(script_rows(case, found).map(|row| Cell::object(&for_scripts(), &row)));
    vec![
        fact(&["name"], option_name(case, of_option.option)),
        fact(&["verdict"], verdict_of(&of_option.judged)),
        fact(&["assumptions"], of_option.assumptions.as_ref().map(objects)),
    ]
}

/// Meaning of the numbers, and the number of draws behind them.
fn meaning(found: Option<&Assumptions>) -> Block {
    let draws = found.map(|found| match found.samples {
        0 => "the plan's own numbers only, nothing varied".to_owned(),
        samples => format!(
            "a value holds where the planned shot does and at most {} of {samples} sampled shots fail",
            found.accepted
        ),
    });
    Block::Text([ADVICE.to_owned()].into_iter().chain(draws).collect())
}

fn ended_early(partial: bool) -> Option<Conclusion> {
    let text = "ended early: not all values were tried".to_owned();
    partial.then_some(Conclusion::new(VerdictWord::Open, text))
}

/// The report of the options asked for. It is partial where the time was up.
pub fn report(case: &Case, Computed { value: all, partial }: &Computed<Vec<OptionAssumptions>>) -> Report {
    let found = || all.iter().filter_map(|of_option| of_option.assumptions.as_ref());
    let sampled = found().next().is_none_or(|found| found.samples > 0);
    let mut report = report_head(case, "shelter.assumptions/1", sampled);
    report.blocks.push(Block::Facts(vec![
        fact(&["partial"], *partial),
        fact(&["options"], Cell::list(all.iter().map(|of_option| option_facts(case, of_option)))),
    ]));
    report.blocks.extend(found().flat_map(|found| blocks(case, found)));
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
    report.blocks.extend([Block::Text(sentences.collect()), meaning(found().next()), scripts(case, found())]);
    report.conclusion = ended_early(*partial);
    report
}

/// The report of one option. It is partial where the time was up.
pub fn report_of_one(case: &Case, Computed { value: found, partial }: &Computed<Assumptions>) -> Report {
    let mut report = report_head(case, "shelter.assumptions/1", found.samples > 0);
    report.blocks.extend(blocks(case, found));
    report.blocks.extend([meaning(Some(found)), scripts(case, [found].into_iter())]);
    report.conclusion = ended_early(*partial);
    report
}

/// The value up to which the option holds, in one line.
pub fn in_brief(case: &Case, found: &Computed<Assumptions>) -> Brief {
    let Computed { value: found, partial } = found;
    let option = &case.plan.delays[found.option].name;
    let until = nearest(found).into_iter().next();
    let until = until
        .unwrap_or_else(|| if *partial { "not tried to the end" } else { "at every value tried" }.to_owned());
    match found.pass_as_stated() {
        // The answer is no verdict: these draws do not say whether the option passes.
        true => Brief { texts: vec![format!("{option}: {until}"), until], ..Brief::default() },
        false => {
            let texts = vec![format!("{option}: not even as assumed"), "not as assumed".to_owned()];
            Brief::judged(Verdict::Fail, texts)
        }
    }
}
