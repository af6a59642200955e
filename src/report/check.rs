//! `check` as a report: one row per delay option.

use super::answer::held;
use super::option_row::{OptionRow, option_rows};
use super::parts::{
    Audience, Block, Cell, Column, Conclusion, Detail, Fact, Field, Report, Table, advice, fact,
};
use super::remedies::{self, passing_changes, refused_kinds};
use super::shared_columns::{
    FAILURES, FORCE, HEIGHT, NOMINAL_VERDICT, VERDICT, failures_object, force, height, intervals,
    launch_margin_share,
};
use super::words::headline::headline;
use super::words::objections::forbidding;
use super::words::option_sentences::{self, broken, compute_label, launch_margin};
use super::words::reasons;
use super::words::to_be_confirmed::to_be_confirmed;
use super::words::{no_result, warnings};
use super::{judged_facts, report_head};
use crate::outcome::{BrokenCable, History};
use crate::plan::observations::Observations;
use crate::report::language::{phrase, say};
use crate::scene::TireId;
use crate::study::check::JudgedPlan;
use crate::study::judge::Judgement;
use crate::study::judge::OptionResults;
use crate::study::judge::one_dud::OneDud;
use crate::study::judge::recommend::{MustPass, recommended, verdict_on_plan};
use crate::study::observed::Comparison;
use crate::study::remedies::Remedies;
use crate::study::samples::influence::input_shares;
use crate::study::samples::random_shot::Input;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::standing::Standing;
use crate::study::{Case, Computed, FileState};
use crate::units::{self, Unit};
use crate::verdict::{Estimate, Limits, Quantity, Verdict, VerdictWord};

/// Band of a quantity over the samples; nothing for too few samples.
pub(super) fn band(row: &OptionRow<'_>, quantity: Quantity, unit: Unit) -> Cell {
    row.sampled(|sampled| sampled.band(quantity).map(|[p05, p50, p95, _]| Cell::Band([p05, p50, p95], unit)))
}

/// Why the option does not pass, or why it has no result.
pub(super) fn all_reasons(row: &OptionRow<'_>) -> Cell {
    Cell::Sentences(match row.result {
        Ok(judged) => reasons::sentences(row.case, judged),
        Err(reason) => vec![no_result::message(reason)],
    })
}

/// Columns of the table. People see bands where shots were `sampled`, else the values of the planned shot with their errors. A
/// slide without a limit has room on the page only.
fn fields<'a>(sampled: bool, limits: &Limits) -> Vec<Field<OptionRow<'a>>> {
    let words = |heading| Column::words(&[], heading).shown(Audience::Text);
    let shown_if = |shown: bool, column: Column| if shown { column } else { column.shown(Audience::Scripts) };
    let if_sampled = |column| shown_if(sampled, column);
    let if_planned_alone = |column| shown_if(!sampled, column);
    let drift = if limits.drift.is_some() { DRIFT } else { DRIFT.shown(Audience::Page) };
    let drawn = match sampled {
        true if units::one_in(limits.accepted_risk) == "100" => "1 in 100 above",
        true => "few above",
        false => "over time",
    };
    let shared = SharedFields::new();
    let ([height_time, height_tire], [force_time, force_cable]) = (shared.height_at, shared.force_at);
    let [holes, charge] = shared.together;
    let fields: [Field<OptionRow<'a>>; _] = [
        Field::new(Column::scripts(&["plan"]).json(&[]), |row| row.case.source.name().into()),
        Field::new(Column::words(&["option"], "option").json(&["name"]), |row| (&row.delay.name).into()),
        Field::new(Column::words(&[], "rows fire, as listed, at").shown(Audience::Page), |row| {
            Cell::Text(option_sentences::firing_times(row.delay))
        }),
        shared.fire_at,
        Field::json(&["hole_interval_s"], |row| row.delay.hole_timing.interval.into()),
        Field::json(&["hole_order"], |row| row.delay.hole_timing.order.name().into()),
        Field::new(VERDICT, |row| row.verdict().into()),
        Field::new(Column::scripts(&["judged"]).json(&[]), |row| {
            row.judged(|judged| judged_inputs(row.case, judged.sampled.is_asked()))
        }),
        Field::scripts(&["confirmed"], |row| row.judged(Judgement::is_confirmed)),
        Field::new(NOMINAL_VERDICT, |row| row.as_planned(|checked| checked.verdict)),
        Field::new(if_sampled(FAILURES.json(&[])), |row| {
            row.sampled(|sampled| Cell::Probability(sampled.bounds.interval))
        }),
        Field::json(&["failure_probability"], |row| row.judged(|judged| failures_object(&judged.sampled))),
        Field::json(&["one_dud"], |row| {
            row.judged(|judged| judged.one_dud.map(|one_dud| one_dud_facts(row.case, &one_dud)))
        }),
        Field::new(if_planned_alone(PEAK_HEIGHT), |row| {
            row.as_planned(|checked| height(checked.estimates.height.into()))
        }),
        Field::new(if_sampled(PLANNED_HEIGHT), |row| {
            row.as_planned(|checked| planned(checked.estimates.height, Unit::Metre))
        }),
        Field::new(if_sampled(HEIGHT_BAND), |row| band(row, Quantity::Height, Unit::Metre)),
        height_time,
        height_tire,
        Field::new(if_planned_alone(PEAK_FORCE), |row| {
            row.as_planned(|checked| force(checked.estimates.force.into()))
        }),
        Field::new(if_sampled(PLANNED_FORCE), |row| {
            row.as_planned(|checked| planned(checked.estimates.force, Unit::Kilonewton))
        }),
        Field::new(if_sampled(FORCE_BAND), |row| band(row, Quantity::Force, Unit::Kilonewton)),
        force_time,
        force_cable,
        Field::new(
            Column::numbers(&["cable_safety_factor"], "factor", Unit::One).under("as planned").spare(1),
            |row| row.as_planned(|checked| Cell::Factor(checked.safety_factor)),
        ),
        Field::new(
            Column::scripts(&["low_95_any_cable_breaks", "high_95_any_cable_breaks"]).json(&[]),
            |row| row.sampled(|sampled| Cell::Probability(sampled.breaks.interval)),
        ),
        Field::json(&["any_cable_breaks.low", "any_cable_breaks.high"], |row| {
            row.judged(|judged| intervals(&judged.sampled).map(|[_, breaks]| Cell::Probability(breaks)))
        }),
        Field::new(LAUNCH_MARGIN_SHARE, |row| row.judged(launch_margin_share)),
        Field::new(if_sampled(LAUNCH_MARGIN), |row| {
            let judged = row.result.as_ref().ok();
            let passes = judged.filter(|judged| judged.checked.verdict == Verdict::Pass);
            passes.and_then(|judged| judged.launch_margin).map(launch_margin).into()
        }),
        Field::json(&["inputs"], inputs),
        Field::json(&["deciding_sample"], |row| row.sampled(SampledShot::deciding_sample)),
        Field::new(Column::words(&[], "in 8 ms").spare(5), |row| {
            Cell::Text(option_sentences::together(row.together()))
        }),
        holes,
        charge,
        Field::new(drift, |row| {
            row.as_planned(|checked| {
                let Estimate { value, error, .. } = checked.estimates.drift;
                Cell::Estimate { value, error, unit: Unit::Metre }
            })
        }),
        Field::json(&["drift_m.p05", "drift_m.p50", "drift_m.p95"], |row| match row.case.limits.drift {
            Some(_) => band(row, Quantity::Drift, Unit::Metre),
            None => Cell::Nothing,
        }),
        Field::json(&["drift_m.at_s"], |row| row.as_planned(|checked| checked.estimates.drift.time)),
        Field::json(&["drift_m.tire"], |row| {
            row.as_planned(|checked| row.case.scene().tire_ids[checked.estimates.drift.index])
        }),
        Field::new(Column::scripts(&["broken_cables"]).json(&[]), |row| {
            row.as_planned(|checked| checked.broken.len())
        }),
        Field::json(&["broken?"], broken_cables),
        Field::json(&["cover.holes"], |row| row.as_planned(|checked| checked.cover.holes)),
        Field::new(Column::scripts(&["holes_uncovered"]).json(&["cover.uncovered"]), |row| {
            row.as_planned(|checked| checked.cover.uncovered)
        }),
        Field::new(Column::scripts(&["cover_height_m"]).json(&["cover.height_m"]), |row| {
            row.as_planned(|checked| checked.cover.height)
        }),
        Field::new(Column::scripts(&["cover_shift_m"]).json(&["cover.shift_m"]), |row| {
            row.as_planned(|checked| checked.cover.shift)
        }),
        Field::json(&["method"], |row| row.as_planned(|checked| checked.compute.method.name())),
        Field::scripts(&["dt_s"], |row| row.as_planned(|checked| checked.step)),
        Field::json(&["steps"], |row| row.as_planned(|checked| checked.steps)),
        Field::scripts(&["energy_residual"], |row| row.as_planned(|checked| checked.energy_residual)),
        Field::json(&["wall_s"], |row| row.as_planned(|checked| checked.wall.as_secs_f64())),
        Field::json(&["total_wall_s"], |row| row.as_planned(|checked| checked.total_wall.as_secs_f64())),
        Field::json(&["runs"], |row| row.as_planned(|checked| checked.runs)),
        Field::scripts(&["reasons"], all_reasons),
        Field::json(&["turned_flight_height_m"], |row| row.judged(|judged| judged.turned_height)),
        Field::scripts(&["slide_checked"], |row| row.case.limits.drift.is_some().into()),
        Field::new(words("height").under(drawn), |row| {
            histories(row).map(|[height, _]| bars(&height.height, row.case.limits.height)).into()
        }),
        Field::new(words("force").under(drawn), |row| {
            histories(row).map(|[_, force]| bars(&force.force, row.case.limits.force)).into()
        }),
    ];
    Vec::from(fields)
}

/// Greatest height of the planned shot, and its error.
pub(super) const PEAK_HEIGHT: Column = HEIGHT.json(&["flight_height_m.value", "flight_height_m.error"]);
/// Greatest height of the planned shot.
pub(super) const PLANNED_HEIGHT: Column =
    Column::numbers(&[], "height", Unit::Metre).under("as planned").spare(4);
/// Band of the greatest height of the sampled shots.
pub(super) const HEIGHT_BAND: Column =
    Column::numbers(&["flight_height_p05_m", "", "flight_height_p95_m"], "height", Unit::Metre)
        .json(&["flight_height_m.p05", "flight_height_m.p50", "flight_height_m.p95"])
        .under("5 to 95 %")
        .spare(3);
/// Greatest force of the planned shot, and its error.
pub(super) const PEAK_FORCE: Column = FORCE.json(&["cable_force_n.value", "cable_force_n.error"]);
/// Greatest force of the planned shot.
pub(super) const PLANNED_FORCE: Column =
    Column::numbers(&[], "force", Unit::Kilonewton).under("as planned").spare(4);
/// Band of the greatest force of the sampled shots.
pub(super) const FORCE_BAND: Column =
    Column::numbers(&["cable_force_p05_n", "", "cable_force_p95_n"], "force", Unit::Kilonewton)
        .json(&["cable_force_n.p05", "cable_force_n.p50", "cable_force_n.p95"])
        .under("5 to 95 %")
        .spare(3);
/// How much faster the tires may leave.
pub(super) const LAUNCH_MARGIN: Column = Column::words(&[], "launches").under("planned alone").spare(2);
/// How much faster the tires may leave, as a share.
pub(super) const LAUNCH_MARGIN_SHARE: Column = Column::scripts(&["launch_margin"]);
/// Greatest drift and its error.
const DRIFT: Column = Column::numbers(&["drift_m", "drift_error_m"], "slide", Unit::Metre)
    .json(&["drift_m.value", "drift_m.error"]);

/// Fields that `check` and `search` share.
pub(super) struct SharedFields<'a> {
    /// Time and tire of the greatest height.
    pub height_at: [Field<OptionRow<'a>>; 2],
    /// Time and cable of the greatest force.
    pub force_at: [Field<OptionRow<'a>>; 2],
    /// Firing time of each blast row.
    pub fire_at: Field<OptionRow<'a>>,
    /// Holes and charge that fire within 8 ms.
    pub together: [Field<OptionRow<'a>>; 2],
}

impl SharedFields<'_> {
    pub fn new() -> Self {
        let at = |csv, json| Column::scripts(csv).json(json);
        Self {
            height_at: [
                Field::new(at(&["flight_height_at_s"], &["flight_height_m.at_s"]), |row| {
                    row.as_planned(|checked| checked.estimates.height.time)
                }),
                Field::new(at(&["flight_height_tire"], &["flight_height_m.tire"]), |row| {
                    row.as_planned(|checked| row.case.scene().tire_ids[checked.estimates.height.index])
                }),
            ],
            force_at: [
                Field::new(at(&["cable_force_at_s"], &["cable_force_n.at_s"]), |row| {
                    row.as_planned(|checked| checked.estimates.force.time)
                }),
                Field::new(at(&["cable_force_cable"], &["cable_force_n.cable"]), |row| {
                    row.as_planned(|checked| cable(row.case, checked.estimates.force.index))
                }),
            ],
            fire_at: Field::json(&["fire_at_s"], |row| Cell::list(row.delay.timing.fire_at())),
            together: [
                Field::scripts(&["holes_in_8_ms"], |row| row.together().holes.into()),
                Field::scripts(&["charge_in_8_ms_kg"], |row| row.together().charge.into()),
            ],
        }
    }
}

/// The tires that a cable ties; nothing where there is no cable.
fn cable(case: &Case, cable: usize) -> Option<[TireId; 2]> {
    let scene = case.scene();
    scene.cables.get(cable).map(|cable| cable.ends.map(|end| scene.tire_ids[end]))
}

fn broken_cables(row: &OptionRow<'_>) -> Cell {
    row.as_planned(|checked| {
        let facts = |broken: &BrokenCable| {
            vec![fact(&["cable"], cable(row.case, broken.cable)), fact(&["at_s"], broken.time)]
        };
        (!checked.broken.is_empty()).then(|| Cell::list(checked.broken.iter().map(facts)))
    })
}

/// Shares of the inputs in the variance, the largest first; nothing for too few samples.
pub(super) fn inputs(row: &OptionRow<'_>) -> Cell {
    row.sampled(|sampled| {
        let share =
            |(input, share): (Input, f64)| vec![fact(&["name"], input.key().name), fact(&["share"], share)];
        input_shares(sampled, &row.case.limits).map(|shares| Cell::list(shares.into_iter().map(share)))
    })
}

/// Facts of the planned shot with one dud, at the worst of all holes.
fn one_dud_facts(case: &Case, one_dud: &OneDud) -> Vec<Fact> {
    let OneDud { row, number, planned, .. } = *one_dud;
    let place = |row: usize, number: usize| {
        Cell::List(vec![Cell::from(&case.plan.blast_rows[row].name), Cell::Count(number + 1)])
    };
    vec![
        fact(&["verdict"], one_dud.verdict()),
        fact(&["hole"], place(row, number)),
        fact(&["places"], one_dud.places),
        fact(&["not_passing"], one_dud.not_passing),
        fact(PEAK_HEIGHT.paths, height(planned.values.height)),
        fact(PEAK_FORCE.paths, force(planned.values.force)),
        fact(
            &["failure_probability.low", "failure_probability.high"],
            one_dud.sampled.map(|sampled| Cell::Probability(sampled.risk.bounds.interval)),
        ),
        fact(&["failure_probability.hole"], one_dud.sampled.map(|dud| place(dud.row, dud.number))),
    ]
}

/// The report of one plan, partial where the time was up. `remedies` are the changes with which options would pass, where they were
/// asked for. `files` are observations of earlier shots. The report says what speaks against the plan. Where passes do not stand,
/// nothing in the report passes.
pub fn report_of_plan(
    case: &Case,
    results: &OptionResults,
    remedies: Option<&[Remedies]>,
    must_pass: MustPass,
    (standing, files): (&Standing, &[Observations]),
    partial: bool,
) -> Report {
    let first = results.iter().flatten().next();
    let sampled = results.iter().flatten().any(|judged| judged.sampled.is_asked());
    let mut table = Table::of(&fields(sampled, &case.limits), option_rows(case, results)).key("options");
    // Where no pass stands, no change makes a pass.
    let remedies = remedies.filter(|_| standing.against_passes().is_none());
    let tried = |option: usize| remedies.map(|all| all.iter().find(|tried| tried.option == option));
    let cells = |changes: fn(&Case, &Remedies) -> Vec<Cell>| {
        (0..results.len()).map(move |option| {
            tried(option)
                .map(|tried| Cell::List(tried.map_or_else(Vec::new, |tried| changes(case, tried))))
                .into()
        })
    };
    table = table.and(&["would_pass"], cells(passing_changes)).and(&["would_not_pass"], cells(refused_kinds));
    complete_rows(&mut table, case, results);
    let passes = |judged: &&Judgement| judged.verdict() == Verdict::Pass;
    let passed = results.iter().flatten().filter(passes).count();
    let so_far = if partial { phrase(" so far, ended early") } else { "" };
    let caveat = match pass_caveat(case, sampled) {
        // A check does not try how little ends a pass.
        "" if passed > 0 => phrase(" (until when: see `shelter assumptions`)"),
        caveat => caveat,
    };
    let mut text = say!("{passed} of {} options pass{so_far}{caveat}", passed, results.len(), so_far, caveat);
    text.extend(first.map(|judged| format!(" · {}", compute_label(&judged.checked.compute))));
    let verdict = verdict_on_plan(results, must_pass);
    let chosen = recommended(case, results);
    // The option to be fired: the recommended option, or the only option.
    let lone_or_chosen = if results.len() == 1 { Some(0) } else { chosen };
    let fired = lone_or_chosen.and_then(|option| Some((option, results[option].as_ref().ok()?)));
    // Under HOLD nothing passes, so confirmed lines would release nothing.
    let stands = standing.against_passes().is_none();
    let fired = fired.filter(|(_, judged)| judged.verdict() == Verdict::Pass && stands);
    let forbidden = standing.against_plan().and_then(forbidding).filter(|_| passed > 0);
    let method = first.map_or(case.plan.simulation.method, |judged| judged.checked.compute.method);
    let mut report = report_head(case, "shelter.check/2", sampled);
    report.blocks.push(Block::Facts(vec![
        fact(&["accepted_risk_percent"], case.plan.limits.accepted_risk_percent),
        advice(&["recommended"], chosen.map(|option| &case.plan.delays[option].name)),
        fact(
            &["to_be_confirmed"],
            fired.map(|fired| {
                let confirmed = to_be_confirmed(case, Some(fired), files, standing.compared()).into_iter();
                let confirmed = confirmed.map(|line| line.text);
                Cell::Sentences(forbidden.map(str::to_owned).into_iter().chain(confirmed).collect())
            }),
        ),
        fact(&["scene.tires"], case.scene().tire_count()),
        fact(&["scene.cables"], case.scene().cables.len()),
        fact(&["scene.modelled_tires"], case.modelled_tires(method)),
    ]));
    report.blocks.extend([Block::Facts(judged_facts(case, verdict, sampled, partial)), Block::Table(table)]);
    report.blocks.extend(remedies.iter().flat_map(|changes| remedies::blocks(case, changes)));
    report.warnings.extend(warnings::of_options(case, results, None));
    let mut changes = remedies.into_iter().flatten();
    let would_pass = changes.any(|changes| changes.passing().next().is_some());
    let is_fixed = first.is_some_and(|judged| judged.checked.compute.step.is_some());
    report.warnings.extend(
        (is_fixed && sampled && (passed > 0 || would_pass)).then(|| phrase(warnings::FIXED_STEP).to_owned()),
    );
    report.answer = chosen.filter(|_| results.len() > 1).map(|_| headline(case, results).to_string());
    let told = lone_or_chosen.and_then(|option| results[option].as_ref().ok());
    report.conclusion = Some(Conclusion::new(thin_if_reported(verdict, told), text));
    let mut report = held(report, case, standing);
    if let Some(forbidden) = forbidden {
        let answer = report.answer.take();
        report.answer =
            Some(answer.map_or_else(|| forbidden.to_owned(), |told| format!("{forbidden}: {told}")));
    }
    report
}

/// The word for a verdict on several shots, of which the report names one: a pass is as thin as the pass of that shot.
pub(super) fn thin_if_reported(verdict: Verdict, told: Option<&Judgement>) -> VerdictWord {
    match told.map(|judged| judged.word(None)) {
        Some(VerdictWord::Thin) if verdict == Verdict::Pass => VerdictWord::Thin,
        _ => verdict.into(),
    }
}

/// A value of the planned shot, with no more digits than its error leaves.
pub(super) fn planned(peak: Estimate, unit: Unit) -> Cell {
    Cell::Text(units::value_by_error(peak.value, peak.error, unit))
}

/// What was judged, as scripts read it. `sampled`: more than the planned shot alone.
pub fn judged_inputs(case: &Case, sampled: bool) -> &'static str {
    match (sampled, case.plan.uncertainty.assumed) {
        (false, _) => "nominal",
        (true, true) => "default",
        (true, false) => "plan",
    }
}

/// Caveat of a pass where nothing was varied, in brackets.
pub const NOTHING_VARIED: &str = " (the plan's own numbers only: no permission to fire)";

/// Caveat of a pass, in brackets; empty where the plan states its unknowns and they were sampled.
pub(super) fn pass_caveat(case: &Case, sampled: bool) -> &'static str {
    match (sampled, case.plan.uncertainty.assumed) {
        (false, _) => phrase(NOTHING_VARIED),
        (true, true) => phrase(" (inputs assumed: see `shelter assumptions`)"),
        (true, false) => "",
    }
}

/// Histories of height and force to draw: of the deciding shots where options are sampled, else of the planned shot. Beside
/// deciding shots a milder shot would flatter its option.
fn histories<'a>(row: &OptionRow<'a>) -> Option<[&'a History; 2]> {
    let judged = row.result.as_ref().ok()?;
    match judged.sampled.is_asked() {
        true => judged.deciding.as_ref().map(|deciding| [&deciding.height.history, &deciding.force.history]),
        false => Some([&judged.checked.history; 2]),
    }
}

fn bars(series: &[f64], top: f64) -> Cell {
    Cell::Sparkline { series: series.to_vec(), top }
}

/// Adds to the row of each option why the option does not pass, or why it has no result.
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
pub fn report(case: &Case, Computed { value: judged, partial }: &Computed<JudgedPlan>) -> Report {
    let standing = Standing::of(case, FileState::AsJudged, Comparison::nothing_seen());
    report_of_plan(
        case,
        &judged.results,
        judged.remedies.as_deref(),
        judged.must_pass,
        (&standing, &[]),
        *partial,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::json::json;
    use crate::study::standing::tests::{case, passing};

    /// A script may release a plan without lines to confirm. What forbids to fire heads these lines, so such a script releases
    /// nothing that the page forbids. The last line says the same.
    #[test]
    fn what_forbids_to_fire_is_to_be_confirmed_and_heads_the_answer() {
        let mut case = case().with_options(&[4]);
        let told = |case: &Case| {
            let standing = Standing::of(case, FileState::AsJudged, Comparison::nothing_seen());
            let results = vec![Ok(passing(case, 500))];
            let report = report_of_plan(case, &results, None, MustPass::Every, (&standing, &[]), false);
            let document = json(std::slice::from_ref(&report)).expect("a document");
            let document: serde_json::Value = serde_json::from_str(&document).expect("JSON");
            let first = document["to_be_confirmed"][0].as_str().unwrap_or_default().to_owned();
            (report.answer, first)
        };
        assert!(told(&case).0.is_none() && !told(&case).1.contains("NOT to be fired"));
        case.plan.cable.slack_percent = case.plan.uncertainty.slack_percent[1] + 1.0;
        let forbidden = "NOT to be fired, a range of [uncertainty] leaves out the plan's own value";
        assert_eq!(told(&case), (Some(forbidden.to_owned()), forbidden.to_owned()));
    }
}
