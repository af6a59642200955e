//! `size` as a report: the lightest combinations that hold.

use super::charts;
use super::check::NOTHING_VARIED;
use super::parts::{Block, Cell, Column, Conclusion, Field, Offer, Report, Table};
use super::shared_columns::{FORCE, HEIGHT, force, height};
use super::words::limits::limits_of_any_rope;
use super::words::no_result::REMEDY_IN_PLAN_WORDS;
use super::words::warnings;
use super::{accepted_risk, title};
use crate::plan::Plan;
use crate::study::size::{Combination, Sizing, Trial, Untried, WorstShotRisk};
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// Combinations that hold with more margin than any lighter one, for people.
fn frontier<'a>() -> [Field<(&'a Combination, Trial)>; 8] {
    [
        Field::new(Column::words(&[], "rope"), |(tried, _)| rope(tried)),
        Field::new(Column::numbers(&[], "tire, kg", Unit::One), |(tried, _)| Cell::Number(tried.tire_mass)),
        Field::new(Column::numbers(&[], "border rows", Unit::One), |(tried, _)| {
            Cell::Count(tried.border_rows)
        }),
        Field::new(Column::numbers(&[], "tires", Unit::One), |(tried, _)| Cell::Count(tried.tires)),
        Field::new(Column::numbers(&[], "total", Unit::Tonne), |(tried, _)| total(tried)),
        Field::new(Column::numbers(&[], "of limit", Unit::One), |(_, trial)| {
            Cell::Utilization(trial.utilization)
        }),
        Field::new(HEIGHT.without_keys(), |(_, trial)| height(trial.worst.height)),
        Field::new(FORCE.without_keys(), |(_, trial)| force(trial.worst.force)),
    ]
}

/// Every combination, for scripts.
fn combinations<'a>() -> [Field<&'a Combination>; 9] {
    [
        Field::new(Column::scripts(&["rope"]), |tried| rope(tried)),
        Field::new(Column::scripts(&["tire_mass_kg"]), |tried| Cell::Number(tried.tire_mass)),
        Field::new(Column::scripts(&["border_rows"]), |tried| Cell::Count(tried.border_rows)),
        Field::new(Column::scripts(&["tires"]), |tried| Cell::Count(tried.tires)),
        Field::new(Column::scripts(&["total_mass_kg"]), |tried| total(tried)),
        Field::new(Column::scripts(&["holds"]), |tried| {
            Cell::Flag(tried.trial.is_ok_and(|trial| trial.holds))
        }),
        Field::new(Column::scripts(&["tried"]), |tried| Cell::Flag(tried.trial.is_ok())),
        Field::new(Column::scripts(&["use_of_limits"]), |tried| {
            tried.trial.map_or(Cell::Nothing, |trial| Cell::Utilization(trial.utilization))
        }),
        Field::new(Column::scripts(&["failures"]), |tried| {
            let risk = tried.trial.ok().and_then(|trial| trial.risk);
            risk.map_or(Cell::Nothing, |risk| Cell::Count(risk.failures))
        }),
    ]
}

fn rope(combination: &Combination) -> Cell {
    Cell::Text(combination.rope.name.clone())
}

fn total(combination: &Combination) -> Cell {
    Cell::Value(combination.total_mass, Unit::Tonne)
}

/// The report of all combinations.
pub fn report(case: &Case, sizing: &Sizing) -> Report {
    let mut facts = vec![format!("limits: {}", limits_of_any_rope(case))];
    facts[0] += &accepted_risk(case, sizing.is_sampled());
    facts.extend(mass_law(&case.plan, sizing));
    let choices: Vec<(&Combination, Trial)> =
        sizing.choices().filter_map(|combination| Some((combination, combination.trial.ok()?))).collect();
    let mut blocks = vec![Block::Text(tried(sizing))];
    if !choices.is_empty() {
        let offer = |(combination, _): &(&Combination, Trial)| Offer::Sizes {
            rope: combination.rope.name.clone(),
            tire_mass: combination.tire_mass,
            border_rows: combination.border_rows,
        };
        let offers: Vec<Offer> = choices.iter().map(offer).collect();
        blocks.push(Block::Table(Table::of(&frontier(), choices).offering(offers)));
    } else if let Some((combination, trial)) = nearest(sizing) {
        blocks.push(Block::Text(vec![format!("nearest: {}", sentence(combination, &trial))]));
    }
    let lightest = sizing.lightest_choice().and_then(|found| found.trial.ok());
    let mut warnings = warnings::of_plan(case);
    warnings.extend(warnings::uncovered_shot("the lightest", lightest.as_ref().map(|trial| &trial.worst)));
    blocks.push(Block::Table(Table::of(&combinations(), &sizing.combinations)));
    blocks.push(Block::Picture(charts::size(sizing)));
    Report { title: title(case), facts, blocks, warnings, answer: None, conclusion: Some(conclusion(sizing)) }
}

/// How fast tires of another mass leave; nothing where all have the mass of the plan.
fn mass_law(plan: &Plan, sizing: &Sizing) -> Option<String> {
    let mass = plan.tire.mass_kg;
    if sizing.combinations.iter().all(|combination| combination.tire_mass == mass) {
        return None;
    }
    let law = format!("a tire of mass m leaves with V0 ({mass} kg / m)^n");
    Some(match plan.uncertainty.launch_mass_exponent {
        [least, most] if least == most => format!("{law}, n = {most}"),
        [least, most] => format!(
            "{law}: tires of another mass must hold at n = {least} and at n = {most}; the plan gets the worse of both"
        ),
    })
}

/// How many combinations were tried, and why the others were not.
fn tried(sizing: &Sizing) -> Vec<String> {
    let mut lines =
        vec![format!("{} of {} combinations tried", sizing.count_tried(), sizing.combinations.len())];
    let unstable = format!("the motion cannot be computed at this step: {REMEDY_IN_PLAN_WORDS}");
    let reasons = [
        (Untried::StrongerRopeDoesNotHold, "a stronger rope of the same stiffness does not hold"),
        (Untried::OutOfTime, "ended early"),
        (Untried::RunFailed, unstable.as_str()),
    ];
    for (why, reason) in reasons {
        match sizing.count_untried(why) {
            0 => {}
            count => lines.push(format!("{count} not tried: {reason}")),
        }
    }
    let reasons = [
        (Verdict::Fail, "more of the possible shots surely fail than accepted"),
        (Verdict::Undecided, "too few samples to tell whether more of the possible shots fail than accepted"),
    ];
    for (verdict, reason) in reasons {
        match sizing.count_with_risk(verdict) {
            0 => {}
            count => lines.push(format!("{count} not chosen: the shots as planned pass, but {reason}")),
        }
    }
    lines
}

fn conclusion(sizing: &Sizing) -> Conclusion {
    let found = sizing.lightest_choice().and_then(|found| Some((found, found.trial.ok()?)));
    let text = match found {
        Some((found, trial)) => {
            let so_far = if sizing.is_incomplete() { " so far" } else { "" };
            format!("lightest{so_far} {}", sentence(found, &trial))
        }
        None if sizing.is_incomplete() => "no combination tried so far holds".to_owned(),
        None if sizing.count_with_risk(Verdict::Undecided) > 0 => {
            "no combination surely holds: give more samples".to_owned()
        }
        None if sizing.is_open_as_planned() => {
            "no combination surely holds as planned: too near a limit, or a run that ends early".to_owned()
        }
        None if sizing.count_with_risk(Verdict::Fail) > 0 => {
            "no combination holds for more than the shots as planned".to_owned()
        }
        None => "no combination holds".to_owned(),
    };
    Conclusion { verdict: sizing.verdict(), text }
}

/// The combination with the least utilization.
pub(super) fn nearest(sizing: &Sizing) -> Option<(&Combination, Trial)> {
    let trials = sizing.combinations.iter().filter_map(|c| Some((c, c.trial.ok()?)));
    trials.min_by(|a, b| a.1.utilization.total_cmp(&b.1.utilization))
}

fn sentence(combination: &Combination, trial: &Trial) -> String {
    let risk = match trial.risk {
        None => NOTHING_VARIED.to_owned(),
        Some(WorstShotRisk { failures, samples, failure_upper_bound, .. }) => {
            format!(
                ", at most {} of the possible shots fail ({failures} of {samples})",
                units::percent(failure_upper_bound, 2)
            )
        }
    };
    format!(
        "{}, tires of {} kg, {}: {} t in all, {} of the limits used, {} judged{risk}",
        combination.rope.name,
        combination.tire_mass,
        counted(combination.border_rows, "border row"),
        units::computed(combination.total_mass, Unit::Tonne),
        units::percent(trial.utilization, 0),
        counted(trial.shots, "shot"),
    )
}

fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// The report of sizing, which itself says what was not tried.
pub fn answer(case: &Case, found: &Computed<Sizing>) -> Report {
    report(case, &found.value)
}
