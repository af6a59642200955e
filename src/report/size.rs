//! `size` as a report: the lightest combinations that hold.

use super::brief::Brief;
use super::charts;
use super::check::{NOTHING_VARIED, judged_inputs, pass_caveat};
use super::parts::{Block, Cell, Column, Conclusion, Fact, Field, Offer, Report, Table, advice, fact};
use super::shared_columns::{FORCE, HEIGHT, force, height};
use super::words::assumption_words::thin as thin_words;
use super::words::counted;
use super::words::limits::limits_of_any_rope;
use super::words::no_result::REMEDY_IN_PLAN_WORDS;
use super::words::{plan_warnings, warnings};
use super::{accepted_risk, plan_facts, title};
use crate::plan::{Plan, PlanSource};
use crate::study::size::{Combination, Sizing, Trial, Untried, WorstShotRisk};
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::{Verdict, VerdictWord};

/// Columns of the combinations that hold with more margin than every lighter combination.
fn frontier<'a>() -> [Field<(&'a Combination, Trial)>; 10] {
    let number = |heading, unit, paths| Column::numbers(&[], heading, unit).json(paths);
    [
        Field::new(Column::words(&[], "rope").json(&["rope"]), |(tried, _)| rope(tried)),
        Field::new(number("tire, kg", Unit::One, &["tire_mass_kg"]), |(tried, _)| tried.tire_mass.into()),
        Field::new(number("border rows", Unit::One, &["border_rows"]), |(tried, _)| tried.border_rows.into()),
        Field::new(number("tires", Unit::One, &["tires"]), |(tried, _)| tried.tires.into()),
        Field::new(number("total", Unit::Tonne, &["total_mass_kg"]), |(tried, _)| total(tried)),
        Field::new(number("of limit", Unit::One, &["use_of_limits"]), |(_, trial)| {
            Cell::Utilization(trial.utilization)
        }),
        Field::new(
            HEIGHT.without_keys().json(&["worst.flight_height_m", "worst.flight_height_error_m"]),
            |(_, trial)| height(trial.worst.values.height),
        ),
        Field::new(
            FORCE.without_keys().json(&["worst.cable_force_n", "worst.cable_force_error_n"]),
            |(_, trial)| force(trial.worst.values.force),
        ),
        Field::json(&["worst.verdict"], |(_, trial)| trial.worst.verdict.into()),
        Field::json(&["risk"], |(_, trial)| trial.risk.map(|risk| risk_facts(&risk, trial)).into()),
    ]
}

/// Facts of the verdict on the hardest shots, and of their samples.
fn risk_facts(risk: &WorstShotRisk, trial: &Trial) -> Vec<Fact> {
    vec![
        fact(&["verdict"], trial.verdict()),
        fact(&["samples"], risk.samples),
        fact(&["failures"], risk.failures),
    ]
}

/// Columns of every combination, for scripts.
fn combinations<'a>() -> [Field<&'a Combination>; 11] {
    [
        Field::scripts(&["rope"], |tried| rope(tried)),
        Field::scripts(&["tire_mass_kg"], |tried| tried.tire_mass.into()),
        Field::scripts(&["border_rows"], |tried| tried.border_rows.into()),
        Field::scripts(&["tires"], |tried| tried.tires.into()),
        Field::scripts(&["total_mass_kg"], |tried| total(tried)),
        Field::scripts(&["holds_as_planned"], |tried| tried.trial.is_ok_and(|trial| trial.holds).into()),
        Field::scripts(&["verdict"], |tried| {
            let fails = |trial: &Trial| (!trial.holds).then_some(Verdict::Fail);
            tried.trial.ok().and_then(|trial| trial.verdict().or(fails(&trial))).into()
        }),
        Field::scripts(&["tried"], |tried| tried.trial.is_ok().into()),
        Field::scripts(&["use_of_limits"], |tried| tried.trial.ok().map(|trial| trial.utilization).into()),
        Field::scripts(&["failures"], |tried| sampled(tried).map(|risk| risk.failures).into()),
        Field::scripts(&["samples"], |tried| sampled(tried).map(|risk| risk.samples).into()),
    ]
}

/// Risk from the samples of a combination; `None` where none was drawn.
fn sampled(combination: &Combination) -> Option<WorstShotRisk> {
    combination.trial.ok().and_then(|trial| trial.risk)
}

fn rope(combination: &Combination) -> Cell {
    (&combination.rope.name).into()
}

fn total(combination: &Combination) -> Cell {
    Cell::Value(combination.total_mass, Unit::Tonne)
}

/// The report of all combinations. The report itself says what was not tried.
pub fn report(case: &Case, Computed { value: sizing, .. }: &Computed<Sizing>) -> Report {
    let mut facts = vec![format!("limits: {}", limits_of_any_rope(case))];
    facts[0] += &accepted_risk(case, sizing.is_sampled());
    facts.extend(mass_law(&case.plan, sizing));
    let choices: Vec<(&Combination, Trial)> =
        sizing.choices().filter_map(|combination| Some((combination, combination.trial.ok()?))).collect();
    let (lightest, nearest) = match choices.first() {
        None => (None, nearest(sizing)),
        lightest => (lightest.copied(), None),
    };
    let object = |found: Option<(&Combination, Trial)>| found.map(|found| Cell::object(&frontier(), &found));
    let open_or_failing = [Verdict::Fail, Verdict::Undecided].map(|verdict| sizing.count_with_risk(verdict));
    let offer = |(combination, _): &(&Combination, Trial)| Offer::Sizes {
        rope: combination.rope.name.clone(),
        tire_mass: combination.tire_mass,
        border_rows: combination.border_rows,
    };
    let offers: Vec<Offer> = choices.iter().map(offer).collect();
    let nearest_in_words = nearest.map(|(found, trial)| format!("nearest: {}", sentence(found, &trial)));
    let blocks = vec![
        Block::Facts(plan_facts(case)),
        Block::Facts(vec![
            fact(&["verdict"], sizing.verdict()),
            fact(&["judged"], judged_inputs(case, sizing.is_sampled())),
            advice(&["found"], lightest.is_some()),
            advice(&[""], object(lightest)),
            fact(&["tried"], sizing.count_tried()),
            fact(&["not_tried"], sizing.combinations.len() - sizing.count_tried()),
            fact(&["fragile"], open_or_failing.iter().sum::<usize>()),
            fact(&["partial"], sizing.count_untried(Untried::OutOfTime) > 0),
            fact(&["nearest?"], object(nearest)),
        ]),
        Block::Text(tried(sizing)),
        Block::Table(
            Table::of(&frontier(), choices).key("frontier").as_advice().offering(offers).unless_empty(),
        ),
        Block::Text(nearest_in_words.into_iter().collect()),
        Block::Table(Table::of(&combinations(), &sizing.combinations)),
        Block::Picture(charts::size(sizing)),
    ];
    // Warnings of the plan that would be written: another rope has other ends.
    let with_lightest = lightest.as_ref().and_then(|(found, _)| with_sizes(case, found));
    let warned = with_lightest.as_ref().unwrap_or(case);
    let mut warnings = plan_warnings::of_plan(warned);
    warnings.extend(plan_warnings::nearly_exact_inputs(warned));
    warnings.extend(
        lightest.as_ref().and_then(|(_, trial)| warnings::uncovered_shot("the lightest", &trial.worst)),
    );
    let (schema, conclusion) = ("shelter.size/1", Some(conclusion(case, sizing)));
    Report { schema, title: title(case), facts, blocks, warnings, answer: None, conclusion }
}

/// The plan as `--write` leaves it; `None` where its text cannot be changed so.
fn with_sizes(case: &Case, found: &Combination) -> Option<Case> {
    let text = found.written(case).ok()?;
    Case::parse(PlanSource { text, ..case.source.clone() }).ok()
}

/// Launch velocity of tires of another mass; `None` where all combinations have the mass of the plan.
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
    let undecided = match sizing.launch_is_estimated {
        true => "nobody observed the launch velocity",
        false => "samples, one dud or fresh draws leave open whether more shots fail than accepted",
    };
    let reasons = [
        (Verdict::Fail, "more shots surely fail than accepted, with one dud or without"),
        (Verdict::Undecided, undecided),
    ];
    for (verdict, reason) in reasons {
        match sizing.count_with_risk(verdict) {
            0 => {}
            count => lines.push(format!("{count} not chosen: the planned shots pass, but {reason}")),
        }
    }
    lines
}

fn conclusion(case: &Case, sizing: &Sizing) -> Conclusion {
    let found = sizing.lightest_choice().and_then(|found| Some((found, found.trial.ok()?)));
    let text = match found {
        Some((found, trial)) => {
            let so_far = if sizing.is_incomplete() { " so far" } else { "" };
            format!("lightest{so_far} {}", sentence(found, &trial))
        }
        None if sizing.launch_is_estimated => {
            "no combination is chosen on an estimated launch: film one first".to_owned()
        }
        None if sizing.is_incomplete() => "no combination tried so far holds".to_owned(),
        None if sizing.count_with_risk(Verdict::Undecided) > 0 => {
            "no combination surely holds: give more samples".to_owned()
        }
        None if sizing.is_open_as_planned() => {
            "no combination surely holds as planned: too near a limit, or a run that ends early".to_owned()
        }
        None if sizing.count_with_risk(Verdict::Fail) > 0 => {
            "no combination holds for more than the planned shots".to_owned()
        }
        None => "no combination holds".to_owned(),
    };
    let caveat = if sizing.is_sampled() { pass_caveat(case, true) } else { "" };
    Conclusion::new(word_of(sizing), text + caveat)
}

/// The word of a sizing: the word of the pass of its lightest choice.
fn word_of(sizing: &Sizing) -> VerdictWord {
    let thin = sizing.lightest_choice().and_then(|choice| choice.trial.ok()?.thin);
    match (sizing.verdict(), thin) {
        (Verdict::Pass, Some(_)) => VerdictWord::Thin,
        (verdict, _) => verdict.into(),
    }
}

/// The combination with the least utilization, whether it holds or not.
fn nearest(sizing: &Sizing) -> Option<(&Combination, Trial)> {
    let trials = sizing.combinations.iter().filter_map(|c| Some((c, c.trial.ok()?)));
    trials.min_by(|a, b| a.1.utilization.total_cmp(&b.1.utilization))
}

fn sentence(combination: &Combination, trial: &Trial) -> String {
    let risk = match trial.risk {
        None => NOTHING_VARIED.to_owned(),
        Some(WorstShotRisk { failures, samples, failure_upper_bound, .. }) => {
            format!(
                ", at most {} of the sampled shots fail ({failures} of {samples})",
                units::at_most(failure_upper_bound)
            )
        }
    };
    let thin = trial.thin.map_or_else(String::new, |thin| format!("; passes thinly: {}", thin_words(thin)));
    format!(
        "{}, tires of {} kg, {}: {} t in all, {} % of the limits used, {} judged{risk}{thin}",
        combination.rope.name,
        combination.tire_mass,
        counted(combination.border_rows, "border row"),
        units::computed(combination.total_mass, Unit::Tonne),
        units::whole_percent(trial.utilization),
        counted(trial.shots, "shot"),
    )
}

/// The lightest combination, in one line.
pub fn in_brief(case: &Case, sizing: &Computed<Sizing>) -> Brief {
    let texts = match sizing.value.lightest_choice() {
        Some(choice) => {
            let (rope, mass) = (&choice.rope.name, choice.tire_mass);
            vec![format!("{rope}, tires of {mass} kg"), rope.clone()]
        }
        None => vec![format!("none for all {} options", case.shots.len()), "none".to_owned()],
    };
    let shares = charts::shares_along(&charts::size(&sizing.value), f64::min);
    Brief::judged(sizing.value.verdict(), texts).drawn_as(shares)
}
