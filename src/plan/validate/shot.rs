//! Blast rows and delay options: what is launched, and when.

use std::collections::{HashMap, HashSet};

use toml::de::{DeTable, DeValue};

use crate::plan::read::{At, Mistakes, Table, as_number, as_whole, bounded, nearest};
use crate::plan::{BlastRow, Charge, DelayOption, Hole, Layout, Timing, range};

pub fn read_blast_rows(
    root: &Table<'_>,
    layout: Option<&Layout>,
    gravity: f64,
    mistakes: &Mistakes,
) -> Vec<BlastRow> {
    let mut rows: Vec<BlastRow> = Vec::new();
    let tables = root.tables("blast_row");
    if tables.is_empty() && !root.has("blast_row") {
        let remedy = "add a section [[blast_row]] with name, under_row and launch_m_s";
        mistakes.add(0..0, "the plan has no [[blast_row]]", remedy);
    }
    for table in tables {
        let name = table.text("name", "\"1\"");
        if rows.iter().any(|row| row.name == name.value) && !name.value.is_empty() {
            let message = format!("two blast rows are named \"{}\"", name.value);
            mistakes.add(name.span.clone(), message, "give each its own name");
        }
        let charge = read_charge(&table, layout, gravity, mistakes);
        rows.push(BlastRow { name: name.value.to_owned(), charge });
        table.finish();
    }
    rows
}

fn read_charge(table: &Table<'_>, layout: Option<&Layout>, gravity: f64, mistakes: &Mistakes) -> Charge {
    let ways = ["under_row", "under_tires", "holes"].map(|key| table.has(key));
    if ways.iter().filter(|&&way| way).count() != 1 {
        let message = if ways.contains(&true) {
            "a blast row says twice what it launches"
        } else {
            "a blast row launches no tire"
        };
        let remedy = "give it exactly one of under_row, under_tires, holes";
        mistakes.add(table.span.clone(), message, remedy);
    }
    if let Some(holes) =
        table.list("holes", "[{ x_m = 1.5, y_m = 4.5, launch_m_s = 6.0 }]", "a table", DeValue::as_table)
    {
        if holes.value.is_empty() {
            mistakes.add(holes.span, "a blast row without a hole", "list its holes, or remove the row");
        }
        let read = |hole: At<&DeTable<'_>>| {
            let hole = Table::new("a hole", hole.span, hole.value, mistakes);
            let read = Hole {
                x_m: hole.number("x_m", None, range::PLACE_M, "1.5"),
                y_m: hole.number("y_m", None, range::PLACE_M, "4.5"),
                launch_m_s: read_launch(&hole, gravity),
            };
            hole.finish();
            read
        };
        return Charge::Holes(holes.value.into_iter().map(read).collect());
    }
    let launch_m_s = read_launch(table, gravity);
    if let Some(tires) = table.list("under_tires", "[3, 4]", "a tire number", as_whole) {
        let count = match layout {
            Some(Layout::List { tires, .. }) => tires.len(),
            Some(_) => {
                let remedy = "use under_row, or holes, in a grid or quincunx";
                table.wrong("under_tires", "`under_tires` numbers the tires of a list layout", remedy);
                usize::MAX
            }
            None => usize::MAX,
        };
        if tires.value.is_empty() {
            mistakes.add(tires.span, "a blast row that launches no tire", "list at least one");
        }
        for tire in tires.value.iter().filter(|tire| tire.value == 0 || tire.value > count) {
            let message = format!("there is no tire {}", tire.value);
            mistakes.add(tire.span.clone(), message, format!("tires are numbered 1 to {count}"));
        }
        let mut known = HashSet::new();
        for tire in &tires.value {
            if !known.insert(tire.value) {
                let message = format!("tire {} is launched twice", tire.value);
                mistakes.add(tire.span.clone(), message, "name each tire once");
            }
        }
        let tires = tires.value.into_iter().map(|tire| tire.value.saturating_sub(1)).collect();
        return Charge::UnderTires { tires, launch_m_s };
    }
    let row = table.number_if("under_row", range::ROW, "2").unwrap_or(1.0);
    check_row(table, layout, row);
    Charge::UnderRow { row, launch_m_s }
}

fn check_row(table: &Table<'_>, layout: Option<&Layout>, row: f64) {
    let (rows, halves) = match layout {
        Some(Layout::Grid(mesh)) => (mesh.rows, false),
        Some(Layout::Quincunx(mesh)) => (mesh.rows, true),
        Some(Layout::List { .. }) if table.has("under_row") => {
            return table.wrong(
                "under_row",
                "a list layout has no rows",
                "use under_tires = [1, 2], or holes",
            );
        }
        _ => return,
    };
    let whole = row.fract() == 0.0 || (halves && row.fract() == 0.5);
    if !(whole && row >= 1.0 && row <= rows as f64) {
        let centres = if halves { ", centres between them at halves such as 1.5" } else { "" };
        let remedy = format!("shelter rows are numbered 1 to {rows}{centres}");
        table.wrong("under_row", format!("there is no shelter row {row}"), remedy);
    }
}

fn read_launch(table: &Table<'_>, gravity: f64) -> f64 {
    match (table.has("launch_m_s"), table.has("free_flight_height_m")) {
        (true, true) => {
            table.wrong(
                "free_flight_height_m",
                "`free_flight_height_m` stands beside `launch_m_s`",
                "keep one of them",
            );
            0.0
        }
        (false, true) => {
            let height = table.number("free_flight_height_m", None, range::FREE_FLIGHT_M, "1.83");
            if gravity == 0.0 {
                let message = "without gravity no launch velocity follows from a height";
                table.wrong("free_flight_height_m", message, "give launch_m_s instead");
            }
            (2.0 * gravity * height).sqrt()
        }
        _ => table.number("launch_m_s", None, range::LAUNCH_M_S, "6.0"),
    }
}

pub fn read_delays(root: &Table<'_>, rows: &[BlastRow], mistakes: &Mistakes) -> Vec<DelayOption> {
    let mut delays: Vec<DelayOption> = Vec::new();
    let tables = root.tables("delay");
    if tables.is_empty() && !root.has("delay") {
        let remedy = "add a section [[delay]] with name and interval_ms";
        mistakes.add(0..0, "the plan has no delay option", remedy);
    }
    for table in tables {
        let name = table.text("name", "\"20 ms\"");
        if delays.iter().any(|delay| delay.name == name.value) && !name.value.is_empty() {
            let message = format!("two delay options are named \"{}\"", name.value);
            mistakes.add(name.span.clone(), message, "give each its own name");
        }
        let timing = read_timing(&table, rows, mistakes);
        delays.push(DelayOption { name: name.value.to_owned(), timing });
        table.finish();
    }
    delays
}

fn read_timing(table: &Table<'_>, rows: &[BlastRow], mistakes: &Mistakes) -> Timing {
    if let Some(at) = table.list("at_ms", "[0, 20, 40]", "a number", as_number) {
        for key in ["interval_ms", "order"] {
            if table.has(key) {
                table.wrong(key, format!("`{key}` stands beside `at_ms`"), "keep one of them");
            }
        }
        if at.value.len() != rows.len() {
            let message = format!("{} firing times for {} blast rows", at.value.len(), rows.len());
            mistakes.add(at.span, message, "give one time for each blast row, in the order listed");
        }
        for time in &at.value {
            if let Some(message) = bounded(time.value, &range::TIME_MS) {
                mistakes.add(
                    time.span.clone(),
                    format!("a firing time {message}"),
                    "write 0 ms or later, up to 1e9",
                );
            }
        }
        return Timing::At(at.value.into_iter().map(|time| time.value).collect());
    }
    let interval_ms = table.number("interval_ms", None, range::TIME_MS, "20");
    let names: HashMap<&str, usize> =
        rows.iter().enumerate().map(|(n, row)| (row.name.as_str(), n)).collect();
    let Some(list) =
        table.list("order", "[\"2\", \"1\"]", "the name of a blast row in quotes", |item| item.as_str())
    else {
        return Timing::Interval { order: (0..rows.len()).collect(), interval_ms };
    };
    let mut order = Vec::new();
    for name in &list.value {
        match names.get(name.value) {
            None => {
                let near = nearest(name.value, names.keys().copied());
                let all: Vec<_> = rows.iter().map(|row| format!("\"{}\"", row.name)).collect();
                let remedy = near.map_or_else(
                    || format!("the rows are {}", all.join(", ")),
                    |near| format!("did you mean \"{near}\"?"),
                );
                mistakes.add(name.span.clone(), format!("no blast row is named \"{}\"", name.value), remedy);
            }
            Some(row) if order.contains(row) => {
                let message = format!("the order names row \"{}\" twice", name.value);
                mistakes.add(name.span.clone(), message, "name each row once");
            }
            Some(&row) => order.push(row),
        }
    }
    if order.len() < rows.len() && list.value.len() < rows.len() {
        let absent = rows.iter().enumerate().filter(|(n, _)| !order.contains(n));
        let names: Vec<_> = absent.map(|(_, row)| format!("\"{}\"", row.name)).collect();
        mistakes.add(list.span, "the order leaves out a blast row", format!("add {}", names.join(", ")));
    }
    Timing::Interval { order, interval_ms }
}
