//! `search` as a report: one row a schedule, the best first, and the front of risk against duration.

use super::check::{
    FORCE_BAND, HEIGHT_BAND, LAUNCH_MARGIN, NOMINAL_FORCE, NOMINAL_HEIGHT, band, complete_rows, planned,
};
use super::explain::{compute_label, launch_margin, together};
use super::model::{Block, Cell, Column, Conclusion, Field, Offer, Report, Shown, Table};
use super::option_row::{OptionRow, option_rows};
use super::shared_columns::{FAILURES, FORCE, HEIGHT, VERDICT, force, height};
use super::{charts, report_head, row_names};
use crate::study::Case;
use crate::study::judgement::Judgement;
use crate::study::search::{FrontPoint, Schedule, Search, duration};
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// A schedule found, and its result as that of a delay option.
struct FoundRow<'a> {
    option: OptionRow<'a>,
    schedule: &'a Schedule,
}

fn fields<'a>() -> [Field<FoundRow<'a>>; 18] {
    [
        Field::new(Column::words(&["name"], "schedule"), |row| Cell::Text(row.option.delay.name.clone())),
        Field::new(Column::scripts(&["order"]), |row| {
            Cell::Text(row_names(row.option.case, &row.schedule.order).join(" "))
        }),
        Field::new(Column::scripts(&["intervals_ms"]), |row| {
            let gaps: Vec<String> = row.schedule.gaps_ms.iter().map(f64::to_string).collect();
            Cell::Text(gaps.join(" "))
        }),
        Field::new(Column::scripts(&["hole_interval_ms"]), |row| {
            Cell::Number(row.schedule.holes.interval_ms)
        }),
        Field::new(Column::scripts(&["hole_order"]), |row| Cell::Text(row.schedule.holes.order.to_string())),
        Field::new(VERDICT, |row| Cell::Verdict(row.option.verdict())),
        Field::new(FAILURES, |row| row.option.sampled(|risk| Cell::Probability(risk.bounds.interval))),
        Field::new(HEIGHT.shown(Shown::Scripts), |row| {
            row.option.as_planned(|checked| height(checked.height.into()))
        }),
        Field::new(NOMINAL_HEIGHT, |row| {
            row.option.as_planned(|checked| planned(checked.height, Unit::Metre))
        }),
        Field::new(HEIGHT_BAND, |row| band(&row.option, Quantity::Height, Unit::Metre)),
        Field::new(FORCE.shown(Shown::Scripts), |row| {
            row.option.as_planned(|checked| force(checked.force.into()))
        }),
        Field::new(NOMINAL_FORCE, |row| {
            row.option.as_planned(|checked| planned(checked.force, Unit::Kilonewton))
        }),
        Field::new(FORCE_BAND, |row| band(&row.option, Quantity::Force, Unit::Kilonewton)),
        Field::new(LAUNCH_MARGIN, |row| {
            let margin = row.option.result.as_ref().ok().and_then(|judged| judged.launch_margin);
            margin.map_or(Cell::Nothing, |margin| Cell::Text(launch_margin(margin)))
        }),
        Field::new(Column::scripts(&["launch_margin"]), |row| {
            let margin = row.option.result.as_ref().ok().and_then(Judgement::known_launch_margin);
            margin.map_or(Cell::Nothing, Cell::Number)
        }),
        Field::new(Column::numbers(&["duration_s"], "lasts", Unit::One), |row| {
            Cell::Interval(duration(row.option.shot))
        }),
        Field::new(Column::words(&[], "in 8 ms"), |row| Cell::Text(together(row.option.together()))),
        Field::new(Column::scripts(&["holes_in_8_ms"]), |row| Cell::Count(row.option.together().holes)),
    ]
}

/// The columns that only samples fill.
const OF_SAMPLES: [Column; 3] = [FAILURES, HEIGHT_BAND, FORCE_BAND];

/// The report of a search of the plan of `case`, which is partial where the time was up.
pub fn report(case: &Case, search: &Search, partial: bool) -> Report {
    let sampled = search.results.iter().flatten().any(|judged| judged.risk.is_asked());
    let rows = option_rows(&search.case, &search.results).zip(&search.schedules);
    let mut table = Table::of(&fields(), rows.map(|(option, schedule)| FoundRow { option, schedule }));
    for column in table.columns.iter_mut().filter(|column| OF_SAMPLES.contains(column) && !sampled) {
        *column = column.shown(Shown::Scripts);
    }
    complete_rows(&mut table, &search.case, &search.results);
    table = table.offering(search.case.plan.delays.iter().cloned().map(Offer::Option));
    let mut blocks = vec![Block::Text(reach(search, sampled)), Block::Table(table)];
    if search.front.len() > 1 {
        blocks.push(Block::Text(front(case, &search.front)));
        blocks.push(Block::Picture(charts::front(case, &search.front)));
    }
    let so_far = if partial { " so far, the time was up" } else { "" };
    let mut text = match search.case.plan.delays.first() {
        None => "no schedule keeps the longest duration and the most holes within 8 ms".to_owned(),
        Some(best) => format!("the best schedule found{so_far}: {}", best.name),
    };
    if let Some(judged) = search.results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&judged.as_planned.compute));
    }
    Report {
        blocks,
        conclusion: Some(Conclusion { verdict: search.verdict(), text }),
        ..report_head(case, sampled)
    }
}

/// How many schedules there are, how many were judged, and how sure it is that none better was missed.
fn reach(search: &Search, sampled: bool) -> Vec<String> {
    let Search { possible, judged, complete, without_failure, .. } = search;
    let possible = match *possible {
        usize::MAX => "more schedules than can be counted are possible".to_owned(),
        1 => "1 schedule is possible".to_owned(),
        count => format!("{count} schedules are possible"),
    };
    let how = match complete {
        true => "all that keep the limits of [search], mirror images once",
        false => "a search: a better one may have been missed",
    };
    let mut lines = vec![format!("{possible}, {judged} were judged: {how}")];
    if sampled {
        lines.push(match without_failure {
            0 => "of every schedule judged and not listed a sample failed".to_owned(),
            1 => "1 more had no failing sample among the few drawn of it: it may be as good".to_owned(),
            more => {
                format!("{more} more had no failing sample among the few drawn of each: some may be as good")
            }
        });
        lines.push(
            "schedules whose bounds overlap are ties: the larger launch margin stands first, then the shorter"
                .to_owned(),
        );
    } else {
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
    let head = "no shorter schedule judged fails less (by the samples that chose them):".to_owned();
    [head].into_iter().chain(front.iter().map(line)).collect()
}
