//! `search` as a report: one row per schedule, the best first, and the front of risk against duration.

use super::brief::Brief;
use super::check::{
    FORCE_BAND, HEIGHT_BAND, LAUNCH_MARGIN, LAUNCH_MARGIN_SHARE, PEAK_FORCE, PEAK_HEIGHT, PLANNED_FORCE,
    PLANNED_HEIGHT, SharedFields, all_reasons, band, complete_rows, pass_caveat, planned, thin_if_reported,
};
use super::option_row::{OptionRow, option_rows};
use super::parts::{Audience, Block, Cell, Column, Conclusion, Fact, Field, Offer, Report, Table, fact};
use super::shared_columns::{
    FAILURES, NOMINAL_VERDICT, PROBABILITY, VERDICT, force, height, intervals, launch_margin_share,
};
use super::words::option_sentences::{compute_label, launch_margin, together};
use super::words::warnings;
use super::{charts, judged_facts, report_head, row_names};
use crate::plan::Time;
use crate::study::search::{FrontPoint, Schedule, Search};
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::Quantity;

fn fields<'a>() -> [Field<OptionRow<'a>>; 29] {
    let shared = SharedFields::new();
    let json_only = |fields: [Field<OptionRow<'a>>; 2]| {
        fields.map(|Field { column, cell }| Field::new(column.json_only(), cell))
    };
    let ([height_time, height_tire], [force_time, force_cable]) =
        (json_only(shared.height_at), json_only(shared.force_at));
    let [holes, charge] = shared.together;
    [
        Field::new(Column::words(&["name"], "schedule"), |row| (&row.delay.name).into()),
        Field::json(&[""], |row| row.schedule.map(|schedule| schedule_facts(row.case, schedule)).into()),
        Field::new(Column::scripts(&["order"]).json(&[]), |row| {
            row.schedule.map(|schedule| row_names(row.case, &schedule.order)).into()
        }),
        Field::new(Column::scripts(&["intervals_ms"]).json(&[]), |row| {
            row.schedule.map(|schedule| Cell::list(schedule.gaps.iter().map(Time::to_string))).into()
        }),
        Field::new(Column::scripts(&["hole_interval_ms"]).json(&[]), |row| {
            row.delay.hole_timing.interval.ms().into()
        }),
        Field::new(Column::scripts(&["hole_order"]).json(&[]), |row| {
            row.delay.hole_timing.order.name().into()
        }),
        shared.fire_at,
        Field::new(VERDICT, |row| row.verdict().into()),
        Field::json(&["reasons"], all_reasons),
        Field::new(NOMINAL_VERDICT.json_only(), |row| row.as_planned(|checked| checked.verdict)),
        Field::new(PROBABILITY.json_only(), |row| row.sampled(|sampled| sampled.bounds.probability())),
        Field::json(&["interval_95"], |row| {
            row.judged(|judged| intervals(&judged.sampled).map(|[fails, _]| Cell::Probability(fails)))
        }),
        Field::new(FAILURES.json(&[]), |row| {
            row.sampled(|sampled| Cell::Probability(sampled.bounds.interval))
        }),
        Field::new(Column::numbers(&["duration_s"], "lasts", Unit::One), |row| {
            Cell::Interval(row.shot.duration())
        }),
        Field::new(Column::words(&[], "in 8 ms"), |row| Cell::Text(together(row.together()))),
        Field::new(LAUNCH_MARGIN, |row| row.judged(|judged| judged.launch_margin.map(launch_margin))),
        Field::new(PEAK_HEIGHT.shown(Audience::Scripts), |row| {
            row.as_planned(|checked| height(checked.estimates.height.into()))
        }),
        Field::new(PLANNED_HEIGHT, |row| {
            row.as_planned(|checked| planned(checked.estimates.height, Unit::Metre))
        }),
        Field::new(HEIGHT_BAND, |row| band(row, Quantity::Height, Unit::Metre)),
        height_time,
        height_tire,
        Field::new(PEAK_FORCE.shown(Audience::Scripts), |row| {
            row.as_planned(|checked| force(checked.estimates.force.into()))
        }),
        Field::new(PLANNED_FORCE, |row| {
            row.as_planned(|checked| planned(checked.estimates.force, Unit::Kilonewton))
        }),
        Field::new(FORCE_BAND, |row| band(row, Quantity::Force, Unit::Kilonewton)),
        force_time,
        force_cable,
        Field::new(LAUNCH_MARGIN_SHARE, |row| row.judged(launch_margin_share)),
        holes,
        charge,
    ]
}

/// Facts of a schedule, for scripts.
fn schedule_facts(case: &Case, schedule: &Schedule) -> Vec<Fact> {
    vec![
        fact(&["order"], row_names(case, &schedule.order)),
        fact(&["intervals_s"], Cell::list(schedule.gaps.iter().copied())),
        fact(&["hole_interval_s"], schedule.hole_timing.interval),
        fact(&["hole_order"], schedule.hole_timing.order.name()),
    ]
}

/// The columns that only samples fill.
const OF_SAMPLES: [Column; 3] = [FAILURES.json(&[]), HEIGHT_BAND, FORCE_BAND];

/// The report of a search of the plan of `case`. It is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Search>) -> Report {
    let Computed { value: search, partial } = found;
    let sampled = search.sampled;
    let rows = option_rows(&search.case, &search.results).zip(&search.schedules);
    let rows = rows.map(|(row, schedule)| OptionRow { schedule: Some(schedule), ..row });
    let mut table = Table::of(&fields(), rows).key("found");
    for column in table.columns.iter_mut().filter(|column| OF_SAMPLES.contains(column) && !sampled) {
        *column = column.shown(Audience::Scripts);
    }
    complete_rows(&mut table, &search.case, &search.results);
    table = table.offering(search.case.plan.delays.iter().cloned().map(Offer::Option));
    let mut report = report_head(case, "shelter.search/1", sampled);
    let blocks = &mut report.blocks;
    let verdict = found.verdict();
    let in_front = |point: &FrontPoint| {
        let mut facts = schedule_facts(case, &point.schedule);
        facts.extend([
            fact(&["duration_s"], point.duration),
            fact(&["failures"], point.share.failures),
            fact(&["samples"], point.share.samples),
        ]);
        facts
    };
    blocks.extend([
        Block::Facts(judged_facts(case, verdict, sampled, *partial)),
        Block::Facts(vec![
            fact(&["count"], search.screened),
            fact(&["possible"], search.possible),
            fact(&["complete"], search.complete),
        ]),
        Block::Text(coverage_lines(case, search, sampled)),
        Block::Table(table.unless_empty()),
        Block::Facts(vec![fact(&["front"], Cell::list(search.front.iter().map(in_front)))]),
    ]);
    if search.front.len() > 1 {
        blocks.push(Block::Text(front(case, &search.front)));
        blocks.push(Block::Picture(charts::front(case, &search.front)));
    }
    let so_far = if *partial { " so far, ended early" } else { "" };
    let mut text = match search.case.plan.delays.first() {
        None if search.complete => "no schedule keeps the limits of the search".to_owned(),
        None => format!("no schedule was judged{so_far}"),
        Some(best) => format!("the best schedule found{so_far}: {}", best.name),
    };
    text += pass_caveat(case, sampled);
    if let Some(judged) = search.results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&judged.checked.compute));
    }
    report.warnings.extend(warnings::of_options(&search.case, &search.results, None));
    let best = search.results.first().and_then(|result| result.as_ref().ok());
    report.conclusion = Some(Conclusion::new(thin_if_reported(verdict, best), text));
    report
}

/// Note on the order in which schedules are ranked.
const RANKING: &str = "ranked as on Compare: who passes, thin passes behind firm ones, then who fails least, then who keeps farthest from its limits, then spare launch speed, \
    then the shorter; the best may be one that the plan does not list";

/// Sentences: how many schedules there are, how many were tried, and how sure it is that no better schedule was missed.
fn coverage_lines(case: &Case, search: &Search, sampled: bool) -> Vec<String> {
    let Search { possible, within_limits, refused, screened, complete, without_failure, .. } = search;
    let possible = match *possible {
        usize::MAX => "more schedules than can be counted are possible".to_owned(),
        1 => "1 schedule is possible".to_owned(),
        count => format!("{count} schedules are possible"),
    };
    let within_limits = within_limits.map_or(String::new(), |count| format!(", {count} keep the limits"));
    let how = match complete {
        true => "all of them; shots that fire alike or are mirror images count once",
        false => "a search: a better one may have been missed",
    };
    let mut lines = vec![format!("{possible}{within_limits}; {screened} were tried, {how}")];
    let limits = &case.limits;
    let most_holes = case.plan.search.most_holes_in_8_ms.into_iter().chain(limits.holes_in_8_ms).min();
    let refused = [
        (refused.too_long, case.plan.search.longest.map(|longest| format!("last longer than {longest} ms"))),
        (refused.too_many_holes, most_holes.map(|most| format!("fire more than {most} holes within 8 ms"))),
        (
            refused.too_heavy,
            limits.charge_in_8_ms.map(|most| format!("fire more than {most} kg within 8 ms")),
        ),
    ];
    let refused = refused.into_iter().filter(|(count, _)| *count > 0);
    let refused: Vec<String> =
        refused.filter_map(|(count, limit)| Some(format!("{count} {}", limit?))).collect();
    if sampled {
        lines.push(RANKING.to_owned());
    }
    if !refused.is_empty() {
        lines.push(format!("left out: {}", refused.join(", ")));
    }
    if sampled && *screened > 0 {
        lines.extend((*without_failure > 0).then(|| match without_failure {
            1 => "1 more had no failing sample among the few drawn of it: it may be as good".to_owned(),
            more => {
                format!("{more} more had no failing sample among the few drawn of each: some may be as good")
            }
        }));
        lines.push("bounds are wider than those of `check`: several schedules are judged at once".to_owned());
        lines.push("risks whose bounds overlap do not differ surely, whatever stands first".to_owned());
    } else if !sampled {
        lines.push("ranked by the planned shots only, nothing varied".to_owned());
    }
    lines
}

/// Lines of the front of risk against duration, one per schedule.
fn front(case: &Case, front: &[FrontPoint]) -> Vec<String> {
    let line = |FrontPoint { schedule, duration, share }: &FrontPoint| {
        format!(
            "{}: {} of {} samples fail · {}",
            units::exact_milliseconds(*duration),
            share.failures,
            share.samples,
            schedule.name(&case.plan.blast_rows)
        )
    };
    let head = "least failing share for each duration, roughly, from the samples that chose them:".to_owned();
    [head].into_iter().chain(front.iter().map(line)).collect()
}

/// The best schedule, and how many schedules pass, in one line.
pub fn in_brief(case: &Case, search: &Computed<Search>) -> Brief {
    let found = &search.value;
    let texts = match found.case.plan.delays.first().map(|best| best.name.clone()) {
        Some(best) => {
            let (passing, judged) = (found.passing().count(), found.schedules.len());
            vec![format!("{best}; {passing} of {judged} judged pass"), best]
        }
        None => vec!["no schedule keeps the limits".to_owned()],
    };
    Brief::judged(search.verdict(), texts)
        .drawn_as(charts::shares_along(&charts::front(case, &found.front), f64::min))
}
