//! `search` as a report: one row a schedule, the best first, and the front of risk against duration.

use super::check::{
    FORCE_BAND, HEIGHT_BAND, LAUNCH_MARGIN, PLANNED_FORCE, PLANNED_HEIGHT, band, complete_rows, pass_caveat,
    planned,
};
use super::option_row::{OptionRow, option_rows};
use super::parts::{Audience, Block, Cell, Column, Conclusion, Field, Offer, Report, Table};
use super::shared_columns::{FAILURES, FORCE, HEIGHT, VERDICT, force, height, launch_margin_share};
use super::words::option_sentences::{compute_label, launch_margin, together};
use super::words::warnings;
use super::{charts, report_head, row_names};
use crate::plan::Time;
use crate::study::search::{FrontPoint, Schedule, Search};
use crate::study::{Case, Computed};
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// A schedule found, and its result as that of a delay option.
struct FoundRow<'a> {
    option: OptionRow<'a>,
    schedule: &'a Schedule,
}

fn fields<'a>() -> [Field<FoundRow<'a>>; 19] {
    [
        Field::new(Column::words(&["name"], "schedule"), |row| Cell::Text(row.option.delay.name.clone())),
        Field::new(Column::scripts(&["order"]), |row| {
            Cell::Text(row_names(row.option.case, &row.schedule.order).join(" "))
        }),
        Field::new(Column::scripts(&["intervals_ms"]), |row| {
            let gaps: Vec<String> = row.schedule.gaps.iter().map(Time::to_string).collect();
            Cell::Text(gaps.join(" "))
        }),
        Field::new(Column::scripts(&["hole_interval_ms"]), |row| {
            Cell::Number(row.schedule.hole_timing.interval.ms())
        }),
        Field::new(Column::scripts(&["hole_order"]), |row| {
            Cell::Text(row.schedule.hole_timing.order.to_string())
        }),
        Field::new(VERDICT, |row| Cell::Verdict(row.option.verdict())),
        Field::new(FAILURES, |row| row.option.sampled(|sampled| Cell::Probability(sampled.bounds.interval))),
        Field::new(Column::numbers(&["duration_s"], "lasts", Unit::One), |row| {
            Cell::Interval(row.option.shot.duration())
        }),
        Field::new(Column::words(&[], "in 8 ms"), |row| Cell::Text(together(row.option.together()))),
        Field::new(LAUNCH_MARGIN, |row| {
            let margin = row.option.result.as_ref().ok().and_then(|judged| judged.launch_margin);
            margin.map_or(Cell::Nothing, |margin| Cell::Text(launch_margin(margin)))
        }),
        Field::new(HEIGHT.shown(Audience::Scripts), |row| {
            row.option.as_planned(|checked| height(checked.height.into()))
        }),
        Field::new(PLANNED_HEIGHT, |row| {
            row.option.as_planned(|checked| planned(checked.height, Unit::Metre))
        }),
        Field::new(HEIGHT_BAND, |row| band(&row.option, Quantity::Height, Unit::Metre)),
        Field::new(FORCE.shown(Audience::Scripts), |row| {
            row.option.as_planned(|checked| force(checked.force.into()))
        }),
        Field::new(PLANNED_FORCE, |row| {
            row.option.as_planned(|checked| planned(checked.force, Unit::Kilonewton))
        }),
        Field::new(FORCE_BAND, |row| band(&row.option, Quantity::Force, Unit::Kilonewton)),
        Field::new(Column::scripts(&["launch_margin"]), |row| {
            let margin = row.option.result.as_ref().ok().and_then(launch_margin_share);
            margin.map_or(Cell::Nothing, Cell::Number)
        }),
        Field::new(Column::scripts(&["holes_in_8_ms"]), |row| Cell::Count(row.option.together().holes)),
        Field::new(Column::scripts(&["charge_in_8_ms_kg"]), |row| {
            row.option.together().charge.map_or(Cell::Nothing, Cell::Number)
        }),
    ]
}

/// The columns that only samples fill.
const OF_SAMPLES: [Column; 3] = [FAILURES, HEIGHT_BAND, FORCE_BAND];

/// The report of a search of the plan of `case`, which is partial where the time was up.
pub fn report(case: &Case, found: &Computed<Search>) -> Report {
    let Computed { value: search, partial } = found;
    let sampled = search.sampled;
    let rows = option_rows(&search.case, &search.results).zip(&search.schedules);
    let mut table = Table::of(&fields(), rows.map(|(option, schedule)| FoundRow { option, schedule }));
    for column in table.columns.iter_mut().filter(|column| OF_SAMPLES.contains(column) && !sampled) {
        *column = column.shown(Audience::Scripts);
    }
    complete_rows(&mut table, &search.case, &search.results);
    table = table.offering(search.case.plan.delays.iter().cloned().map(Offer::Option));
    let mut blocks = vec![Block::Text(coverage_lines(case, search, sampled))];
    if !search.results.is_empty() {
        blocks.push(Block::Table(table));
    }
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
    let mut report = report_head(case, sampled);
    report.blocks = blocks;
    report.warnings.extend(warnings::of_options(&search.case, &search.results, None));
    report.conclusion = Some(Conclusion { verdict: case.verdict_on_file(found.verdict()), text });
    report
}

/// The rule by which one schedule stands before another.
const RANKING: &str = "ranked as on Compare: who passes, then who fails least, then spare launch speed, then the shorter; the best may be \
    one that the plan does not list";

/// How many schedules there are, how many were tried, and how sure it is that none better was missed.
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
        lines.push(
            "of those that pass, overlapping bounds are ties: the larger launch margin stands first, then the shorter"
                .to_owned(),
        );
    } else if !sampled {
        lines.push("ranked by the shots as planned only, nothing varied".to_owned());
    }
    lines
}

/// The front of risk against duration, one line a schedule.
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
