//! `size` as a report: the lightest combinations that hold.

use super::charts;
use super::limits::limits_of_any_rope;
use super::model::{Block, Cell, Column, Conclusion, Report, Table};
use super::no_result::FINER;
use super::shared_columns::{FORCE, HEIGHT, force, height};
use super::{accepted_risk, title};
use crate::study::Case;
use crate::study::size::{Combination, SampledRisk, Sizing, Trial, Untried};
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// Combinations that hold with more margin than any lighter one, for people.
const FRONTIER: [Column; 8] = [
    Column::words(&[], "rope"),
    Column::numbers(&[], "tire, kg", Unit::One),
    Column::numbers(&[], "border rows", Unit::One),
    Column::numbers(&[], "tires", Unit::One),
    Column::numbers(&[], "total", Unit::Tonne),
    Column::numbers(&[], "of limit", Unit::One),
    HEIGHT.unread(),
    FORCE.unread(),
];

/// Every combination, for scripts.
const COMBINATIONS: [Column; 9] = [
    Column::scripts(&["rope"]),
    Column::scripts(&["tire_mass_kg"]),
    Column::scripts(&["border_rows"]),
    Column::scripts(&["tires"]),
    Column::scripts(&["total_mass_kg"]),
    Column::scripts(&["holds"]),
    Column::scripts(&["tried"]),
    Column::scripts(&["use_of_limits"]),
    Column::scripts(&["failures"]),
];

/// The report of all combinations.
pub fn report(case: &Case, sizing: &Sizing) -> Report {
    let mut facts = vec![format!("limits: {}", limits_of_any_rope(case))];
    let sampled = sizing
        .combinations
        .iter()
        .any(|combination| combination.trial.is_ok_and(|trial| trial.risk.is_some()));
    facts[0] += &accepted_risk(case, sampled);
    facts.push(
        "a lighter tire leaves faster, a heavier one slower: the holes give the same momentum".to_owned(),
    );
    let choices: Vec<&Combination> = sizing.choices().collect();
    let rows = choices.iter().filter_map(|combination| {
        let trial = combination.trial.ok()?;
        let used =
            [Cell::Utilization(trial.utilization), height(trial.worst.height), force(trial.worst.force)];
        Some(parts(combination).into_iter().chain(used).collect())
    });
    let mut blocks = vec![Block::Text(tried(sizing))];
    if !choices.is_empty() {
        blocks.push(Block::Table(Table::new(&FRONTIER, rows)));
    } else if let Some((combination, trial)) = nearest(sizing) {
        blocks.push(Block::Text(vec![format!("nearest: {}", sentence(combination, &trial))]));
    }
    let all = sizing.combinations.iter().map(|combination| {
        let trial = combination.trial.ok();
        let used = trial.map_or(Cell::Nothing, |trial| Cell::Utilization(trial.utilization));
        let risk = trial.and_then(|trial| trial.risk);
        let told = [
            Cell::Flag(trial.is_some_and(|trial| trial.holds)),
            Cell::Flag(trial.is_some()),
            used,
            risk.map_or(Cell::Nothing, |risk| Cell::Count(risk.failures)),
        ];
        parts(combination).into_iter().chain(told).collect()
    });
    blocks.push(Block::Table(Table::new(&COMBINATIONS, all)));
    blocks.push(Block::Picture(charts::size(sizing)));
    Report { title: title(case), facts, blocks, conclusion: Some(conclusion(sizing)) }
}

/// Rope, mass of a tire, border rows, tires and total mass.
fn parts(combination: &Combination) -> [Cell; 5] {
    [
        Cell::Text(combination.rope.name.clone()),
        Cell::Number(combination.tire_mass),
        Cell::Count(combination.border_rows),
        Cell::Count(combination.tires),
        Cell::Value(combination.total_mass, Unit::Tonne),
    ]
}

/// How many combinations were tried, and why the others were not.
fn tried(sizing: &Sizing) -> Vec<String> {
    let mut lines =
        vec![format!("{} of {} combinations tried", sizing.count_tried(), sizing.combinations.len())];
    let unstable = format!("the motion cannot be computed at this step: {FINER}");
    let reasons = [
        (Untried::StrongerRopeDoesNotHold, "a stronger rope of the same stiffness does not hold"),
        (Untried::OutOfTime, "the time was up"),
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
        None => " (the plan's own numbers only)".to_owned(),
        Some(SampledRisk { failures, samples, most, .. }) => {
            format!(
                ", at most {} of the possible shots fail ({failures} of {samples})",
                units::percent(most, 2)
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
