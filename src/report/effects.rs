//! `effects` as a report: one row per effect, and the effects that the scene requires.

use itertools::Itertools;

use super::brief::Brief;
use super::parts::{Audience, Block, Cell, Column, Conclusion, Field, Report, Table, fact};
use super::report_head;
use crate::plan::starter::RIGID_ENDS;
use crate::study::effects::{Effect, EffectOnOption, EffectsOnOptions, LEAST_RELATIVE_CHANGE};
use crate::study::{Case, Computed};
use crate::units;
use crate::verdict::{Quantity, VerdictWord};

/// One effect on every option, for people.
fn for_people<'a>() -> [Field<&'a Vec<&'a EffectOnOption>>; 8] {
    fn words(heading: &'static str) -> Column {
        Column::words(&[], heading).shown(Audience::People)
    }
    [
        Field::new(words("effect"), |all| all[0].effect.name().into()),
        Field::new(words("required"), |all| {
            let required = all.iter().filter(|row| row.is_required()).count();
            Cell::Text(if required > 0 { format!("by {required} of {}", all.len()) } else { "no".to_owned() })
        }),
        Field::new(words("height"), |all| Cell::Text(changes(all, Quantity::Height))),
        Field::new(words("force"), |all| Cell::Text(changes(all, Quantity::Force))),
        Field::new(words("slide"), |all| Cell::Text(changes(all, Quantity::Drift))),
        Field::new(words("verdicts change"), |all| {
            let changed = all.iter().filter(|row| row.verdict_changes()).count();
            Cell::Text(format!("{changed} of {}", all.len()))
        }),
        Field::new(words("value"), |all| Cell::Text(value(all[0]))),
        Field::new(words("run time"), |all| {
            Cell::Text(format!("x {}", units::short(median(all.iter().map(|row| row.cost)))))
        }),
    ]
}

/// One effect on one option, with the name of the option, for scripts.
fn for_scripts<'a>() -> [Field<(&'a str, &'a EffectOnOption)>; 12] {
    [
        Field::new(Column::scripts(&["option"]).json(&[]), |(option, _)| (*option).into()),
        Field::scripts(&["name"], |(_, row)| row.effect.script_name().into()),
        Field::scripts(&["value"], |(_, row)| row.value.into()),
        Field::scripts(&["unit"], |(_, row)| row.effect.key().kind.unit().into()),
        Field::scripts(&["flight_height_change"], |(_, row)| row.change(Quantity::Height).into()),
        Field::scripts(&["cable_force_change"], |(_, row)| row.change(Quantity::Force).into()),
        Field::scripts(&["drift_change"], |(_, row)| row.change(Quantity::Drift).into()),
        Field::scripts(&["verdict"], |(_, row)| row.verdict_with.into()),
        Field::scripts(&["verdict_without"], |(_, row)| row.verdict_without.into()),
        Field::scripts(&["required"], |(_, row)| row.is_required().into()),
        Field::scripts(&["source"], |(_, row)| if row.assumed { "assumed" } else { "plan" }.into()),
        Field::scripts(&["cost"], |(_, row)| row.cost.into()),
    ]
}

/// The report of all effects. It is partial where the time was up.
pub fn report(case: &Case, Computed { value: found, partial }: &Computed<EffectsOnOptions>) -> Report {
    let case = &case.with_options(&found.options);
    let rows_of =
        |effect: Effect| -> Vec<&EffectOnOption> { found.all().filter(|row| row.effect == effect).collect() };
    let tried: Vec<Vec<&EffectOnOption>> =
        Effect::ALL.into_iter().map(rows_of).filter(|all| !all.is_empty()).collect();
    let options = || case.plan.delays.iter().map(|delay| delay.name.as_str()).zip(&found.effects);
    let scripts = options().flat_map(|(name, all)| all.iter().flatten().map(move |row| (name, row)));
    let option = |(name, all): (_, &Option<Vec<_>>)| {
        let objects =
            |all: &Vec<_>| Cell::list(all.iter().map(|row| Cell::object(&for_scripts(), &(name, row))));
        vec![fact(&["name"], name), fact(&["effects"], all.as_ref().map(objects))]
    };
    let mut report = report_head(case, "shelter.effects/1", false);
    report.blocks.extend([
        Block::Facts(vec![
            fact(&["judged"], "nominal"),
            fact(&["partial"], *partial),
            fact(&["options"], Cell::list(options().map(option))),
        ]),
        Block::Text(vec![MEANING.to_owned()]),
        Block::Table(Table::of(&for_people(), &tried)),
        Block::Text([requirement(found)].into_iter().chain(sentences(&tried)).collect()),
        Block::Table(Table::of(&for_scripts(), scripts)),
    ]);
    let ended_early =
        || Conclusion::new(VerdictWord::Open, "ended early: not every option was tried".to_owned());
    report.conclusion = partial.then(ended_early);
    report
}

/// Sentence: the effects that the scene requires.
pub fn requirement(effects: &EffectsOnOptions) -> String {
    let is_required = |effect: &Effect| effects.all().any(|row| row.effect == *effect && row.is_required());
    let of_plan = Effect::ALL.into_iter().filter(|effect| effect.is_of_plan());
    let names: Vec<&str> = of_plan.filter(is_required).map(Effect::name).collect();
    format!("this scene requires: {}", listed(&names))
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() { "none of these".to_owned() } else { names.join(", ") }
}

/// Meaning of the columns.
const MEANING: &str = "change by each effect of the median over some sampled shots, in the hardest direction, from the least to the greatest over the options; verdicts are those of the limits on the planned shot alone, not those of `check`";

/// Value of an effect: `10 %`, `2000 kN/m (assumed)`.
fn value(row: &EffectOnOption) -> String {
    if !row.effect.is_of_plan() {
        return String::new();
    }
    let unit = row.effect.key().kind.unit();
    let assumed = if row.assumed { " (assumed)" } else { "" };
    format!("{}{}{unit}{assumed}", row.value, if unit.is_empty() { "" } else { " " })
}

/// Changes of a quantity over the options: `-3 to +12 %`.
fn changes(all: &[&EffectOnOption], quantity: Quantity) -> String {
    let values = || all.iter().map(|row| row.change(quantity));
    if values().any(f64::is_nan) {
        return "unknown".to_owned();
    }
    if values().any(f64::is_infinite) {
        return "from 0".to_owned();
    }
    let signed = |share: f64| format!("{:+}", (1e2 * share).round() + 0.0);
    let (least, most) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let [least, most] = [least, most].map(signed);
    if least == most { format!("{least} %") } else { format!("{least} to {most} %") }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Sentences: the effects that the scene does not require, and on which side a left-out effect errs.
fn sentences(tried: &[Vec<&EffectOnOption>]) -> Vec<String> {
    let names = |is: &dyn Fn(&[&EffectOnOption]) -> bool| -> Vec<&'static str> {
        tried.iter().filter(|all| is(all)).map(|all| all[0].effect.name()).collect()
    };
    let is_required = |all: &[&EffectOnOption]| all.iter().any(|row| row.is_required());
    let is_unsafe = |all: &[&EffectOnOption]| all.iter().any(|row| row.is_missed_on_the_unsafe_side);
    let others = names(&|all| !is_required(all));
    let mut lines = Vec::new();
    if !others.is_empty() {
        let most = units::percent(LEAST_RELATIVE_CHANGE, 0);
        lines.push(format!(
            "not, at the values tried: {} (no verdict changes; of what has a limit the median changes and the 95th percentile rises by less than {most}, or hardly against its limit)",
            listed(&others)
        ));
    }
    let overstated = names(&|all| is_required(all) && !is_unsafe(all));
    if !overstated.is_empty() {
        lines.push(format!(
            "at the values tried, leaving these out only overstates what has a limit: {}",
            listed(&overstated)
        ));
    }
    let lacking = names(&|all| all.iter().any(|row| is_lacking(row)));
    if !lacking.is_empty() {
        lines.push(format!(
            "required and not in the plan, tried at assumed values: {}; put yours into the plan, or show that it is 0",
            listed(&lacking)
        ));
    }
    if tried.iter().any(|all| all[0].effect == Effect::Turn && is_required(all)) {
        lines.push(TURNING.to_owned());
    }
    if tried.iter().any(|all| all[0].effect == Effect::Ends && all[0].assumed) {
        lines.push(RIGID_ENDS.to_owned());
    }
    lines
}

/// Whether an effect is required, and the plan could have it but does not.
fn is_lacking(row: &EffectOnOption) -> bool {
    row.is_required() && row.assumed && row.effect.is_of_plan()
}

/// What a plan can do about tires that turn.
const TURNING: &str = "no plan can have tires that turn: one that is free to turn toward a cable at its rim is pulled less, and its centre rises higher; one that is tied on all sides hardly turns. The truth lies between: leave that room below the limit of height";

/// Required effects that the plan lacks.
pub fn lacking(effects: &EffectsOnOptions) -> Vec<&'static str> {
    effects.all().filter(|row| is_lacking(row)).map(|row| row.effect.name()).unique().collect()
}

/// Number of required effects that the plan lacks, in one line.
pub fn in_brief(_case: &Case, effects: &Computed<EffectsOnOptions>) -> Brief {
    let names = lacking(&effects.value);
    let text = match names.len() {
        0 if effects.partial || effects.value.all().next().is_none() => "not all were tried".to_owned(),
        0 => "the plan has all that is required".to_owned(),
        1 => "1 effect that is required is not in the plan".to_owned(),
        count => format!("{count} that are required are not in the plan"),
    };
    let named = (!names.is_empty()).then(|| format!("required, not in the plan: {}", names.join(", ")));
    Brief { texts: named.into_iter().chain([text]).collect(), ..Brief::default() }
}
