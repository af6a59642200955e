//! `check` as a report: one row a delay option.

use super::option_row::{OptionRow, option_rows};
use super::parts::{Audience, Block, Cell, Column, Conclusion, Detail, Field, Report, Table};
use super::shared_columns::{FAILURES, FORCE, HEIGHT, VERDICT, force, height, launch_margin_share};
use super::words::headline::headline;
use super::words::option_sentences::{self, broken, compute_label, launch_margin};
use super::words::reasons;
use super::words::{no_result, warnings};
use super::{remedies, report_head};
use crate::outcome::History;
use crate::study::as_planned::check::CheckedShot;
use crate::study::check::JudgedPlan;
use crate::study::judge_options::{MustPass, OptionResults, verdict_on_plan};
use crate::study::judgement::Judgement;
use crate::study::recommend::recommended;
use crate::study::remedies::Remedies;
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::{Estimate, Limits, Quantity, Verdict};

pub(super) fn band(row: &OptionRow<'_>, quantity: Quantity, unit: Unit) -> Cell {
    row.sampled(|sampled| {
        sampled.band(quantity).map_or(Cell::Nothing, |[p05, _, p95, _]| Cell::Band([p05, p95], unit))
    })
}

/// Why the option does not pass, or has no result.
fn all_reasons(row: &OptionRow<'_>) -> String {
    match row.result {
        Ok(judged) => reasons::sentences(row.case, judged).join("; "),
        Err(reason) => no_result::message(reason),
    }
}

/// The columns. People see bands where the possible shots were `sampled`, else the values of the shot as planned with their errors.
/// Drift without a limit has room on the page only.
fn fields<'a>(sampled: bool, limits: &Limits) -> Vec<Field<OptionRow<'a>>> {
    let words = |heading| Column::words(&[], heading).shown(Audience::Text);
    let shown_if = |shown: bool, column: Column| if shown { column } else { column.shown(Audience::Scripts) };
    let if_sampled = |column| shown_if(sampled, column);
    let if_planned_alone = |column| shown_if(!sampled, column);
    let drift = if limits.drift.is_some() { DRIFT } else { DRIFT.shown(Audience::Page) };
    let drawn = match sampled {
        true if units::one_in(limits.accepted_risk) == "100" => "worst of 100",
        true => "worst",
        false => "over time",
    };
    let fields: [Field<OptionRow<'a>>; _] = [
        Field::new(Column::scripts(&["plan"]), |row| Cell::Text(row.case.source.path.clone())),
        Field::new(Column::words(&["option"], "option"), |row| Cell::Text(row.delay.name.clone())),
        Field::new(Column::words(&[], "rows fire, as listed, at").shown(Audience::Page), |row| {
            Cell::Text(option_sentences::firing_times(row.delay))
        }),
        Field::new(VERDICT, |row| Cell::Verdict(row.verdict())),
        Field::new(Column::scripts(&["judged"]), |row| {
            row.result.as_ref().map_or(Cell::Nothing, |judged| {
                Cell::Text(judged_inputs(row.case, judged.sampled.is_asked()).to_owned())
            })
        }),
        Field::new(Column::scripts(&["confirmed"]), |row| {
            let confirmed = row.result.as_ref().ok().and_then(Judgement::is_confirmed);
            confirmed.map_or(Cell::Nothing, Cell::Flag)
        }),
        Field::new(Column::scripts(&["nominal_verdict"]), |row| {
            row.as_planned(|checked| Cell::Verdict(checked.verdict))
        }),
        Field::new(if_sampled(FAILURES), |row| {
            row.sampled(|sampled| Cell::Probability(sampled.bounds.interval))
        }),
        Field::new(if_planned_alone(HEIGHT), |row| row.as_planned(|checked| height(checked.height.into()))),
        Field::new(if_sampled(PLANNED_HEIGHT), |row| {
            row.as_planned(|checked| planned(checked.height, Unit::Metre))
        }),
        Field::new(if_sampled(HEIGHT_BAND), |row| band(row, Quantity::Height, Unit::Metre)),
        Field::new(Column::scripts(&["flight_height_at_s"]), |row| {
            row.as_planned(|checked| Cell::Number(checked.height.time))
        }),
        Field::new(Column::scripts(&["flight_height_tire"]), |row| {
            row.as_planned(|checked| Cell::Text(row.case.scene().tire_ids[checked.height.index].to_string()))
        }),
        Field::new(if_planned_alone(FORCE), |row| row.as_planned(|checked| force(checked.force.into()))),
        Field::new(if_sampled(PLANNED_FORCE), |row| {
            row.as_planned(|checked| planned(checked.force, Unit::Kilonewton))
        }),
        Field::new(if_sampled(FORCE_BAND), |row| band(row, Quantity::Force, Unit::Kilonewton)),
        Field::new(Column::scripts(&["cable_force_at_s"]), |row| {
            row.as_planned(|checked| Cell::Number(checked.force.time))
        }),
        Field::new(Column::scripts(&["cable_force_cable"]), |row| {
            row.as_planned(|checked| Cell::Text(row.case.scene().cable_name(checked.force.index)))
        }),
        Field::new(
            Column::numbers(&["cable_safety_factor"], "factor", Unit::One).under("as planned").spare(1),
            |row| row.as_planned(|checked| Cell::Factor(checked.safety_factor)),
        ),
        Field::new(Column::scripts(&["low_95_any_cable_breaks", "high_95_any_cable_breaks"]), |row| {
            row.sampled(|sampled| Cell::Probability(sampled.breaks.interval))
        }),
        Field::new(Column::scripts(&["launch_margin"]), |row| {
            let margin = row.result.as_ref().ok().and_then(launch_margin_share);
            margin.map_or(Cell::Nothing, Cell::Number)
        }),
        Field::new(if_sampled(LAUNCH_MARGIN), |row| {
            let judged = row.result.as_ref().ok();
            let passes = judged.filter(|judged| judged.checked.verdict == Verdict::Pass);
            let margin = passes.and_then(|judged| judged.launch_margin);
            margin.map_or(Cell::Nothing, |margin| Cell::Text(launch_margin(margin)))
        }),
        Field::new(Column::words(&[], "in 8 ms").spare(5), |row| {
            Cell::Text(option_sentences::together(row.together()))
        }),
        Field::new(Column::scripts(&["holes_in_8_ms"]), |row| Cell::Count(row.together().holes)),
        Field::new(Column::scripts(&["charge_in_8_ms_kg"]), |row| {
            row.together().charge.map_or(Cell::Nothing, Cell::Number)
        }),
        Field::new(drift, |row| {
            row.as_planned(|CheckedShot { drift, .. }| Cell::Estimate {
                value: drift.value,
                error: drift.error,
                unit: Unit::Metre,
            })
        }),
        Field::new(Column::scripts(&["broken_cables"]), |row| {
            row.as_planned(|checked| Cell::Count(checked.broken.len()))
        }),
        Field::new(Column::scripts(&["holes_uncovered"]), |row| {
            row.as_planned(|checked| Cell::Count(checked.cover.uncovered))
        }),
        Field::new(Column::scripts(&["cover_height_m"]), |row| {
            row.as_planned(|checked| Cell::Number(checked.cover.height))
        }),
        Field::new(Column::scripts(&["cover_shift_m"]), |row| {
            row.as_planned(|checked| Cell::Number(checked.cover.shift))
        }),
        Field::new(Column::scripts(&["dt_s"]), |row| row.as_planned(|checked| Cell::Number(checked.step))),
        Field::new(Column::scripts(&["energy_residual"]), |row| {
            row.as_planned(|checked| Cell::Number(checked.energy_residual))
        }),
        Field::new(Column::scripts(&["reasons"]), |row| Cell::Text(all_reasons(row))),
        Field::new(words("height").under(drawn), |row| {
            history(row).map_or(Cell::Nothing, |history| bars(&history.height, row.case.limits.height))
        }),
        Field::new(words("force").under(drawn), |row| {
            history(row).map_or(Cell::Nothing, |history| bars(&history.force, row.case.limits.force))
        }),
    ];
    Vec::from(fields)
}

/// Greatest height of the shot as planned.
pub(super) const PLANNED_HEIGHT: Column =
    Column::numbers(&[], "height", Unit::Metre).under("as planned").spare(4);
/// Band of the greatest height of the possible shots.
pub(super) const HEIGHT_BAND: Column =
    Column::numbers(&["flight_height_p05_m", "flight_height_p95_m"], "height", Unit::Metre)
        .under("5 to 95 %")
        .spare(3);
/// Greatest force of the shot as planned.
pub(super) const PLANNED_FORCE: Column =
    Column::numbers(&[], "force", Unit::Kilonewton).under("as planned").spare(4);
/// Band of the greatest force of the possible shots.
pub(super) const FORCE_BAND: Column =
    Column::numbers(&["cable_force_p05_n", "cable_force_p95_n"], "force", Unit::Kilonewton)
        .under("5 to 95 %")
        .spare(3);
/// How much faster the tires may leave.
pub(super) const LAUNCH_MARGIN: Column = Column::words(&[], "launches").under("as planned").spare(2);
/// Greatest drift and its error.
const DRIFT: Column = Column::numbers(&["drift_m", "drift_error_m"], "drift", Unit::Metre);

/// The report of one plan, which is partial where the time was up; with the changes with which options would pass, where they were
/// asked for.
pub fn report(
    case: &Case,
    results: &OptionResults,
    remedies: Option<&[Remedies]>,
    must_pass: MustPass,
    partial: bool,
) -> Report {
    let sampled = results.iter().flatten().any(|judged| judged.sampled.is_asked());
    let fields = fields(sampled, &case.limits);
    let mut table = Table::of(&fields, option_rows(case, results));
    complete_rows(&mut table, case, results);
    let passed = results.iter().flatten().filter(|judged| judged.verdict() == Verdict::Pass).count();
    let so_far = if partial { " so far, ended early" } else { "" };
    let caveat = pass_caveat(case, sampled);
    let mut text = format!("{passed} of {} options pass{so_far}{caveat}", results.len());
    if let Some(judged) = results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&judged.checked.compute));
    }
    let mut report = report_head(case, sampled);
    report.blocks.push(Block::Table(table));
    report.blocks.extend(remedies.iter().flat_map(|changes| remedies::blocks(case, changes)));
    report.warnings.extend(warnings::of_options(case, results, None));
    let is_chosen = results.len() > 1 && recommended(case, results).is_some();
    report.answer = is_chosen.then(|| headline(case, results));
    report.conclusion = Some(Conclusion { verdict: verdict_on_plan(results, must_pass), text });
    report
}

/// A value of the shot as planned, with no more digits than its error leaves.
pub(super) fn planned(peak: Estimate, unit: Unit) -> Cell {
    Cell::Text(units::value_by_error(peak.value, peak.error, unit))
}

/// What was judged, as scripts read it; `sampled`: not the planned shot alone.
pub fn judged_inputs(case: &Case, sampled: bool) -> &'static str {
    match (sampled, case.plan.uncertainty.assumed) {
        (false, _) => "nominal",
        (true, true) => "default",
        (true, false) => "plan",
    }
}

/// What a pass is worth where nothing was varied, in brackets.
pub const NOTHING_VARIED: &str = " (the plan's own numbers only: no permission to fire)";

/// What a pass is about, in brackets.
pub(super) fn pass_caveat(case: &Case, sampled: bool) -> &'static str {
    match (sampled, case.plan.uncertainty.assumed) {
        (false, _) => NOTHING_VARIED,
        (true, true) => " (inputs assumed: see `shelter assumptions`)",
        (true, false) => "",
    }
}

/// Height and force over time of the shot that decides where options are sampled, else of the shot as planned. Beside shots that
/// decide a milder one would flatter its option.
fn history<'a>(row: &OptionRow<'a>) -> Option<&'a History> {
    let judged = row.result.as_ref().ok()?;
    match judged.sampled.is_asked() {
        true => judged.deciding.as_ref().map(|deciding| &deciding.history),
        false => Some(&judged.checked.history),
    }
}

fn bars(series: &[f64], top: f64) -> Cell {
    Cell::Sparkline { series: series.to_vec(), top }
}

/// Adds to the row of each option why it does not pass, or has no result.
pub(super) fn complete_rows(table: &mut Table, case: &Case, results: &OptionResults) {
    for (row, result) in table.rows.iter_mut().zip(results) {
        match result {
            Ok(judged) => row.details = details(case, judged),
            Err(reason) => row.missing = Some(no_result::message(reason)),
        }
    }
}

fn details(case: &Case, judged: &Judgement) -> Vec<Detail> {
    let checked = &judged.checked;
    let mut details = reasons::details(case, judged);
    let next_tires = option_sentences::next_tires(case, judged).into_iter();
    details.extend(next_tires.map(|text| Detail { verdict: Verdict::Undecided, text }));
    details
        .extend(option_sentences::dud_of(case, judged).map(|text| Detail { verdict: Verdict::Pass, text }));
    if !checked.broken.is_empty() {
        details.push(Detail { verdict: Verdict::Fail, text: broken(case.scene(), checked) });
    }
    details
}

/// The report of the answer of `check`.
pub fn answer(case: &Case, Computed { value: judged, partial }: &Computed<JudgedPlan>) -> Report {
    report(case, &judged.results, judged.remedies.as_deref(), judged.must_pass, *partial)
}
