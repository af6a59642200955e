//! Changes that would make an option pass: one sentence and one object of the JSON document per change.

use super::parts::{Block, Cell, Report, fact};
use super::shared_columns::failures_object;
use crate::plan::edit::change::Change;
use crate::plan::keys::{Key, blast_row, cable, delay, plan, shelter};
use crate::plan::{Launch, Layout, Timing};
use crate::study::as_planned::shot_reason::exceeds_together;
use crate::study::judge::Judgement;
use crate::study::remedies::{Remedies, Remedy, TriedKind};
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::standing::verdict_word::ThinPass;
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::{Quantity, VerdictWord};

/// One block per option: the changes with which the option passes, then the changes that do not suffice.
pub fn blocks(case: &Case, all: &[Remedies]) -> Vec<Block> {
    all.iter().map(|remedies| Block::Text(lines(case, remedies))).collect()
}

fn lines(case: &Case, remedies: &Remedies) -> Vec<String> {
    let name = &case.plan.delays[remedies.option].name;
    let passing: Vec<String> =
        remedies.passing().map(|passing| format!("    {}", sentence(case, passing))).collect();
    let head = match passing.len() {
        0 if !remedies.enough_samples || case.plan.uncertainty.launch_is_estimated() => {
            format!("{name}: no change was tried")
        }
        0 => format!("{name} would pass with none of the changes tried"),
        1 => format!("{name} would pass with this change:"),
        _ => format!("{name} would pass with any one of these changes:"),
    };
    let failing = without_pass(case, remedies).into_iter().map(|line| format!("    {line}"));
    [head].into_iter().chain(passing).chain(failing).collect()
}

/// The changes with which an option passes, for scripts.
pub fn passing_changes(case: &Case, remedies: &Remedies) -> Vec<Cell> {
    remedies.passing().map(|passing| passing_change(case, passing)).collect()
}

/// A change, and the value at its key. For launches the value is the factor on every launch.
fn passing_change(case: &Case, Remedy { change, judgement }: &Remedy) -> Cell {
    let FromTo { from, to } = FromTo::new(case, change);
    let (section, key, value): (&Key, &Key, Cell) = match *change {
        Change::Rope(rope) => (&plan::CABLE, &cable::ROPE, (&rope.name).into()),
        Change::Termination(known) => (&plan::CABLE, &cable::TERMINATION, (&known.name).into()),
        Change::BorderRows(rows) => (&plan::SHELTER, &shelter::BORDER_ROWS, rows.into()),
        Change::Slack(percent) => (&plan::CABLE, &cable::SLACK_PERCENT, percent.into()),
        Change::Launch(factor) => (&plan::BLAST_ROW, &blast_row::LAUNCH_M_S, factor.into()),
        Change::Interval { interval, .. } => (&plan::DELAY, &delay::INTERVAL_MS, interval.ms().into()),
    };
    Cell::Object(vec![
        fact(&["kind"], change.kind().name()),
        fact(&["from"], from),
        fact(&["to"], to),
        fact(&["key"], format!("{}.{}", section.name, key.name)),
        fact(&["value"], value),
        fact(&["verdict"], judgement.verdict()),
        fact(&["failure_probability"], failures_object(&judgement.sampled)),
        fact(&["flight_height_m"], judgement.checked.estimates.height.value),
        fact(&["cable_force_n"], judgement.checked.estimates.force.value),
    ])
}

/// Kinds of change without any change that passes, for scripts.
pub fn refused_kinds(_: &Case, remedies: &Remedies) -> Vec<Cell> {
    let refused = remedies.kinds.iter().filter(|tried| tried.passing.is_none());
    let object = |tried: &TriedKind| {
        Cell::Object(vec![
            fact(&["kind"], tried.kind.name()),
            fact(&["tried"], tried.tried.len()),
            fact(&["undecided"], tried.undecided),
            fact(&["complete"], !tried.out_of_time),
        ])
    };
    refused.map(object).collect()
}

/// A change in words: the value now, and the value after the change.
pub struct FromTo {
    /// What the plan says.
    pub from: String,
    /// What the changed plan says.
    pub to: String,
}

impl FromTo {
    /// The words of a change of the plan of `case`.
    pub fn new(case: &Case, change: &Change) -> Self {
        let cable = &case.plan.cable;
        let (from, to) = match change {
            Change::Rope(rope) => (cable.rope.clone().unwrap_or_default(), rope.name.clone()),
            Change::Termination(termination) => {
                let planned = cable.termination.clone();
                let percent = || format!("{} %", cable.termination_percent);
                (planned.unwrap_or_else(percent), termination.name.clone())
            }
            Change::BorderRows(rows) => {
                let planned = match &case.plan.layout {
                    Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.border_rows,
                    Layout::List { .. } => 0,
                };
                (planned.to_string(), rows.to_string())
            }
            Change::Slack(percent) => (format!("{} %", cable.slack_percent), format!("{percent} %")),
            Change::Launch(factor) => launches(case, *factor),
            Change::Interval { option, interval } => {
                let planned = match &case.plan.delays[*option].timing {
                    Timing::Interval { interval, .. } => format!("{interval} ms"),
                    Timing::At(_) => String::new(),
                };
                (planned, format!("{interval} ms"))
            }
        };
        Self { from, to }
    }
}

/// Least and greatest launch velocity, now and times `factor`: `5 to 6 m/s`.
fn launches(case: &Case, factor: f64) -> (String, String) {
    let speeds = || case.plan.launches().map(|launch: &Launch| launch.speed_m_s);
    let (least, most) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
    let words = |factor: f64| match [least, most].map(|speed| units::short(factor * speed)) {
        [least, most] if least == most => format!("{most} m/s"),
        [least, most] => format!("{least} to {most} m/s"),
    };
    (words(1.0), words(factor))
}

/// Sentence for a change with which an option passes, and the result: `rope … instead of … (at most 0.88 % fail, height …)`.
pub fn sentence(case: &Case, passing: &Remedy) -> String {
    let what = words(case, &passing.change);
    format!("{what} ({}){}", result(&passing.judgement), thinly(passing))
}

/// PASS or THIN of an option after a change, as far as the planned shot and one dud show.
pub fn word_as_planned(passing: &Remedy) -> VerdictWord {
    match ThinPass::of_planned(&passing.judgement) {
        Some(_) => VerdictWord::Thin,
        None => VerdictWord::Pass,
    }
}

/// Words behind a change after which the pass is thin, as far as the planned shot and one dud show.
pub fn thinly(passing: &Remedy) -> &'static str {
    if word_as_planned(passing) == VerdictWord::Thin { ", but thinly" } else { "" }
}

/// Upper bound of the share of shots that fail, in words.
pub fn at_most_fail(sampled: &SampledShot) -> String {
    format!("at most {} of shots fail", units::at_most(sampled.bounds.interval[1]))
}

/// A change in words: `rope … instead of …`.
pub fn words(case: &Case, change: &Change) -> String {
    let FromTo { from, to } = FromTo::new(case, change);
    match change {
        Change::Rope(_) => format!("rope {to} instead of {from}"),
        Change::Termination(_) => format!("termination {to} instead of {from}"),
        Change::BorderRows(1) => format!("1 border row instead of {from} (tires all around, as ballast)"),
        Change::BorderRows(_) => format!("{to} border rows instead of {from} (tires all around, as ballast)"),
        Change::Slack(_) => format!("slack {to} instead of {from}"),
        Change::Launch(factor) => {
            let lower = units::percent(1.0 - factor, 0);
            format!("a smaller charge, seen to launch {to} instead of {from} ({lower} slower)")
        }
        Change::Interval { .. } => format!("interval {to} instead of {from}"),
    }
}

/// Result of the changed plan: by its samples, or as planned where no samples were asked for.
fn result(judgement: &Judgement) -> String {
    let Some(sampled) = judgement.sampled.known() else {
        let checked = &judgement.checked;
        let value = |estimate: f64, error: f64, unit: Unit| {
            format!("{} {}", units::value_by_error(estimate, error, unit), unit.symbol())
        };
        return format!(
            "height {}, force {} as planned",
            value(checked.estimates.height.value, checked.estimates.height.error, Unit::Metre),
            value(checked.estimates.force.value, checked.estimates.force.error, Unit::Kilonewton)
        );
    };
    let band = |name: &str, quantity: Quantity, unit: Unit| {
        let [low, _, high, _] = sampled.band(quantity)?;
        Some(format!(
            "{name} {} to {} {}",
            units::significant(low, unit, 3),
            units::significant(high, unit, 3),
            unit.symbol()
        ))
    };
    let height = band("height", Quantity::Height, Unit::Metre);
    let force = band("force", Quantity::Force, Unit::Kilonewton);
    let bands: Vec<String> = height.into_iter().chain(force).collect();
    let bands = if bands.is_empty() {
        String::new()
    } else {
        format!("; each in 90 of 100 shots: {}", bands.join(", "))
    };
    format!("{}{bands}", at_most_fail(sampled))
}

/// Sentences: the kinds of change of which none suffices, and whether all changes were tried; empty where there is nothing to say.
pub fn without_pass(case: &Case, remedies: &Remedies) -> Vec<String> {
    let too_much_together = exceeds_together(case, &case.shots[remedies.option]);
    let failed = remedies.kinds.iter().filter(|tried| tried.passing.is_none() && !tried.out_of_time);
    let sentences: Vec<String> = failed.filter_map(refusal).collect();
    let mut lines = Vec::new();
    if too_much_together {
        lines.push(
            "too much fires within 8 ms: spread the holes, by hole_interval_ms or by `shelter search`"
                .to_owned(),
        );
    }
    if case.plan.uncertainty.launch_is_estimated() {
        lines.push("no change passes on an estimated launch: film a shot or a test tire first".to_owned());
    }
    if !remedies.enough_samples {
        lines.push("so few samples prove no pass: give more".to_owned());
    }
    if !sentences.is_empty() {
        lines.push(sentences.join("; "));
        if remedies.passing().next().is_none() {
            lines.push(
                "none suffices alone: try a rope of another kind (`shelter ropes`), two changes together, or a smaller charge"
                    .to_owned(),
            );
        }
    }
    if remedies.kinds.iter().any(|tried| tried.out_of_time) {
        lines.push("not all changes were tried: ended early".to_owned());
    }
    lines
}

/// Sentence: no change of a kind suffices, and how far the changes went; `None` where no change was tried.
fn refusal(tried: &TriedKind) -> Option<String> {
    let text = match tried.tried.last()? {
        Change::Rope(rope) => format!("no stronger rope of {} passes", rope.family),
        Change::Termination(_) => "no stronger termination passes".to_owned(),
        Change::BorderRows(1) => "a border row does not suffice".to_owned(),
        Change::BorderRows(rows) => format!("not even {rows} border rows pass"),
        Change::Slack(_) => format!("no slack tried from {} % passes", range(tried)),
        Change::Launch(factor) => format!("not even launches {} lower pass", units::percent(1.0 - factor, 0)),
        // Another option may have one of these intervals, and pass.
        Change::Interval { .. } if tried.undecided > 0 => format!(
            "no interval tried from {} ms passes, {} of {} stay open",
            range(tried),
            tried.undecided,
            tried.tried.len()
        ),
        Change::Interval { .. } => format!("no interval tried from {} ms passes", range(tried)),
    };
    Some(text)
}

/// Least and greatest number tried: `1 to 4`.
fn range(tried: &TriedKind) -> String {
    let numbers = || {
        tried.tried.iter().filter_map(|change| match change {
            Change::Slack(percent) => Some(*percent),
            Change::Interval { interval, .. } => Some(interval.ms()),
            _ => None,
        })
    };
    let (least, most) = (numbers().fold(f64::INFINITY, f64::min), numbers().fold(0.0, f64::max));
    format!("{least} to {most}")
}

/// The report of the changes for one option.
pub fn report(case: &Case, found: &Computed<Remedies>) -> Report {
    Report { blocks: blocks(case, std::slice::from_ref(&found.value)), ..Report::default() }
}
