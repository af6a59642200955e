//! From TOML text to a valid [`Plan`]: one small function per section, every mistake noted with its remedy.

use std::collections::{HashMap, HashSet};

use toml::de::{DeTable, DeValue};

use super::diagnostic::Diagnostics;
use super::read::{At, Mistakes, Table, as_number, as_whole, bounded, nearest};
use super::{
    Accuracy, BlastRow, CableSpec, Charge, DelayOption, Hole, Layout, Limits, Links, ListedTire, Mesh,
    Method, Plan, SimulationSpec, Timing, TireSpec,
};
use crate::ropes;

/// Most tires in a shelter.
pub const MOST_TIRES: usize = 4_000_000;

const MASS_KG: std::ops::RangeInclusive<f64> = 1e-3..=1e7;
const LAUNCH_M_S: std::ops::RangeInclusive<f64> = 0.0..=1e4;
const PLACE_M: std::ops::RangeInclusive<f64> = -1e7..=1e7;
const TIME_MS: std::ops::RangeInclusive<f64> = 0.0..=1e9;
const PERCENT: std::ops::RangeInclusive<f64> = 1.0..=100.0;

/// Reads a plan from text; `path` names it in messages.
pub fn parse(path: &str, text: &str) -> Result<Plan, Diagnostics> {
    let source = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (document, errors) = DeTable::parse_recoverable(source);
    let mistakes = Mistakes::default();
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        mistakes.add(span, error.message().to_owned(), "a plan is TOML: `key = value` lines in [sections]");
    }
    if mistakes.count() > 0 {
        return Err(Diagnostics::new(path, source, mistakes.take()));
    }
    let root = Table::new("the plan", 0..0, document.get_ref(), &mistakes);
    let plan = read_plan(path, &root, &mistakes);
    root.finish();
    if mistakes.count() > 0 {
        return Err(Diagnostics::new(path, source, mistakes.take()));
    }
    // Without a mistake every section was there.
    plan.ok_or_else(|| Diagnostics::unreadable(path, "the plan is incomplete".to_owned(), ""))
}

fn read_plan(path: &str, root: &Table<'_>, mistakes: &Mistakes) -> Option<Plan> {
    let title =
        root.text_if("title", "\"…\"").map_or_else(|| path.to_owned(), |title| title.value.to_owned());
    let simulation = read_simulation(root.table_if("simulation"));
    let tire = root.table("tire", "mass_kg = 280").map(read_tire);
    let layout = root
        .table("shelter", "layout, rows, columns and spacing_m")
        .and_then(|table| read_layout(table, mistakes));
    let cable = root.table("cable", "rope = \"GOST 2688-80 6.2\"").map(|table| read_cable(table, mistakes));
    let friction = root.table("ground", "friction = 0.5").map(|table| {
        let friction = table.number("friction", None, 0.0..=1e9, "0.5");
        table.finish();
        friction
    });
    if let (Some(layout), Some(tire)) = (&layout, &tire) {
        check_gaps(layout, tire, root, mistakes);
    }
    let blast_rows = read_blast_rows(root, layout.as_ref(), simulation.gravity_m_s2, mistakes);
    let limits = root.table("limits", "flight_height_m and cable_safety_factor").map(read_limits);
    let delays = read_delays(root, &blast_rows, mistakes);
    Some(Plan {
        path: path.to_owned(),
        title,
        layout: layout?,
        tire: tire?,
        cable: cable?,
        friction: friction?,
        blast_rows,
        limits: limits?,
        delays,
        simulation,
    })
}

fn read_simulation(table: Option<Table<'_>>) -> SimulationSpec {
    let Some(table) = table else {
        return SimulationSpec {
            duration_s: None,
            accuracy: Accuracy::default(),
            method: Method::default(),
            gravity_m_s2: 9.81,
        };
    };
    let accuracies =
        [("field", Accuracy::Field), ("draft", Accuracy::Draft), ("reference", Accuracy::Reference)];
    let spec = SimulationSpec {
        duration_s: table.number_if("duration_s", 1e-6..=1e6, "1.5"),
        accuracy: table.word("accuracy", &accuracies),
        method: table.word("method", &[("verlet", Method::Verlet), ("newmark", Method::Newmark)]),
        gravity_m_s2: table.number("gravity_m_s2", Some(9.81), 0.0..=1e3, "9.81"),
    };
    table.finish();
    spec
}

fn read_tire(table: Table<'_>) -> TireSpec {
    let tire = TireSpec {
        mass_kg: table.number("mass_kg", None, MASS_KG, "280"),
        outer_diameter_m: table.number("outer_diameter_m", Some(0.0), 0.0..=1e3, "1.6"),
    };
    table.finish();
    tire
}

fn read_limits(table: Table<'_>) -> Limits {
    let limits = Limits {
        flight_height_m: table.number("flight_height_m", None, 1e-6..=1e6, "1.5"),
        cable_safety_factor: table.number("cable_safety_factor", None, 1e-3..=1e6, "2.0"),
        drift_m: table.number_if("drift_m", 1e-6..=1e6, "0.5"),
    };
    table.finish();
    limits
}

fn read_cable(table: Table<'_>, mistakes: &Mistakes) -> CableSpec {
    let rope = table.text_if("rope", "\"GOST 2688-80 6.2\"");
    let stiffness = table.number_if("axial_stiffness_kn", 1e-6..=1e9, "1519");
    let breaking = table.number_if("breaking_force_kn", 1e-6..=1e9, "20.9");
    let (axial_stiffness_kn, breaking_force_kn) = match (&rope, stiffness, breaking) {
        (None, Some(stiffness), Some(breaking)) => (stiffness, breaking),
        (Some(rope), None, None) => match ropes::catalogue().find(rope.value) {
            Some(found) => (found.axial_stiffness_kn, found.breaking_force_kn),
            None => {
                let near = ropes::catalogue().suggest(rope.value);
                let remedy = near.map_or_else(
                    || "`shelter ropes` lists the catalogue".to_owned(),
                    |near| format!("did you mean \"{near}\"? `shelter ropes` lists the catalogue"),
                );
                mistakes.add(
                    rope.span.clone(),
                    format!("no rope \"{}\" in the catalogue", rope.value),
                    remedy,
                );
                (1.0, 1.0)
            }
        },
        (Some(_), ..) => {
            let key = if stiffness.is_some() { "axial_stiffness_kn" } else { "breaking_force_kn" };
            table.wrong(key, format!("`{key}` stands beside `rope`, which gives it too"), "keep one of them");
            (1.0, 1.0)
        }
        (None, ..) => {
            let missing = match (stiffness, breaking) {
                (Some(_), _) => "`breaking_force_kn`",
                (_, Some(_)) => "`axial_stiffness_kn`",
                _ => "rope",
            };
            let remedy =
                "add `rope = \"GOST 2688-80 6.2\"`, or both axial_stiffness_kn and breaking_force_kn";
            mistakes.add(table.span.clone(), format!("[cable] has no {missing}"), remedy);
            (1.0, 1.0)
        }
    };
    let percent = table.number_if("termination_percent", PERCENT, "80");
    let termination = table.text_if("termination", "\"clips\"");
    let termination_percent = match (termination, percent) {
        (Some(_), Some(_)) => {
            table.wrong(
                "termination_percent",
                "`termination_percent` stands beside `termination`",
                "keep one of them",
            );
            100.0
        }
        (Some(name), None) => find_termination(&name, mistakes),
        (None, percent) => percent.unwrap_or(100.0),
    };
    let spec = CableSpec {
        rope: rope.map(|rope| rope.value.to_owned()),
        axial_stiffness_kn,
        breaking_force_kn: breaking_force_kn * termination_percent * 1e-2,
        slack_percent: table.number("slack_percent", Some(0.0), 0.0..=1e3, "2"),
        termination_percent,
    };
    table.finish();
    spec
}

fn find_termination(name: &At<&str>, mistakes: &Mistakes) -> f64 {
    let all = &ropes::catalogue().terminations;
    if let Some(found) = all.iter().find(|termination| termination.name == name.value) {
        return found.efficiency_percent;
    }
    let names: Vec<_> = all.iter().map(|termination| format!("\"{}\"", termination.name)).collect();
    let message = format!("no termination \"{}\"", name.value);
    mistakes.add(name.span.clone(), message, format!("write one of {}", names.join(", ")));
    100.0
}

#[derive(Clone, Copy)]
enum Kind {
    Grid,
    Quincunx,
    List,
}

fn read_layout(table: Table<'_>, mistakes: &Mistakes) -> Option<Layout> {
    let before = mistakes.count();
    if !table.has("layout") {
        table.text("layout", "\"grid\"");
    }
    let kinds = [("grid", Kind::Grid), ("quincunx", Kind::Quincunx), ("list", Kind::List)];
    let kind = table.word("layout", &kinds);
    let layout = match kind {
        Kind::List => read_list(&table, mistakes),
        Kind::Grid => Layout::Grid(read_mesh(&table, 1, mistakes)),
        Kind::Quincunx => Layout::Quincunx(read_mesh(&table, 2, mistakes)),
    };
    let tires = match &layout {
        Layout::Grid(mesh) => mesh.rows.saturating_mul(mesh.columns),
        Layout::Quincunx(mesh) => mesh.rows.saturating_mul(mesh.columns).saturating_mul(2),
        Layout::List { tires, .. } => tires.len(),
    };
    if tires > MOST_TIRES {
        let message = format!("the shelter has more than {MOST_TIRES} tires");
        table.wrong("rows", message, "describe a smaller shelter");
    }
    table.finish();
    (mistakes.count() == before).then_some(layout)
}

fn read_mesh(table: &Table<'_>, least: usize, mistakes: &Mistakes) -> Mesh {
    let rows = table.whole("rows", least..=MOST_TIRES, "5");
    let columns = table.whole("columns", least..=MOST_TIRES, "10");
    let (row_spacing_m, column_spacing_m) = read_spacing(table);
    let words = [("row", 0), ("column", 1), ("diagonal", 2)];
    let example = "[\"row\", \"column\", \"diagonal\"]";
    let mut tied = [true; 3];
    if let Some(list) = table.list("links", example, "a text in quotes", |item| item.as_str()) {
        tied = [false; 3];
        for item in list.value {
            match words.iter().find(|(word, _)| *word == item.value) {
                Some(&(_, n)) => tied[n] = true,
                None => mistakes.add(
                    item.span,
                    format!("\"{}\" names no neighbours", item.value),
                    "write any of \"row\", \"column\", \"diagonal\"",
                ),
            }
        }
    }
    let [row, column, diagonal] = tied;
    Mesh { rows, columns, row_spacing_m, column_spacing_m, links: Links { row, column, diagonal } }
}

fn read_spacing(table: &Table<'_>) -> (f64, f64) {
    const SPACING_M: std::ops::RangeInclusive<f64> = 1e-4..=1e5;
    match table.inline_table("spacing_m") {
        Some(both) => {
            let spacing =
                (both.number("row", None, SPACING_M, "1.5"), both.number("column", None, SPACING_M, "1.6"));
            both.finish();
            spacing
        }
        None => {
            let spacing = table.number("spacing_m", None, SPACING_M, "1.5");
            (spacing, spacing)
        }
    }
}

fn read_list(table: &Table<'_>, mistakes: &Mistakes) -> Layout {
    let mut tires = Vec::new();
    let mut places = HashSet::new();
    for tire in table.tables("tire") {
        let place = ListedTire {
            x_m: tire.number("x_m", None, PLACE_M, "0"),
            y_m: tire.number("y_m", None, PLACE_M, "0"),
            mass_kg: tire.number_if("mass_kg", MASS_KG, "280"),
        };
        let bits = [place.x_m + 0.0, place.y_m + 0.0].map(f64::to_bits);
        if !places.insert(bits) {
            let message = format!("tire {} lies where another one does", tires.len() + 1);
            mistakes.add(tire.span.clone(), message, "move or remove one of them");
        }
        tires.push(place);
        tire.finish();
    }
    if tires.is_empty() {
        let remedy = "add a section [[shelter.tire]] with x_m and y_m for each tire";
        mistakes.add(table.span.clone(), "the shelter has no tire", remedy);
    }
    let mut cables = Vec::new();
    let mut known = HashSet::new();
    for cable in table.tables("cable") {
        let most = tires.len().max(1);
        let before = mistakes.count();
        let (from, to) = (cable.whole("from", 1..=most, "1"), cable.whole("to", 1..=most, "2"));
        if mistakes.count() == before {
            if from == to {
                cable.wrong("to", format!("a cable from tire {from} to itself"), "name another tire");
            } else if !known.insert((from.min(to), from.max(to))) {
                let message = format!("tires {from} and {to} are tied twice");
                mistakes.add(cable.span.clone(), message, "remove one of the two cables");
            }
        }
        cables.push((from - 1, to - 1));
        cable.finish();
    }
    Layout::List { tires, cables }
}

/// Tied tires must lie further apart than a diameter, or there is no room for a cable.
fn check_gaps(layout: &Layout, tire: &TireSpec, root: &Table<'_>, mistakes: &Mistakes) {
    let diameter = tire.outer_diameter_m;
    let least = match layout {
        Layout::Grid(mesh) | Layout::Quincunx(mesh) => {
            let (x, y) = (mesh.column_spacing_m, mesh.row_spacing_m);
            let half = if matches!(layout, Layout::Quincunx(_)) { 0.5 } else { 1.0 };
            let mut gaps = vec![f64::INFINITY];
            gaps.extend(mesh.links.row.then_some(x).filter(|_| mesh.columns > 1));
            gaps.extend(mesh.links.column.then_some(y).filter(|_| mesh.rows > 1));
            let diagonal = half * x.hypot(y);
            gaps.extend(
                mesh.links.diagonal.then_some(diagonal).filter(|_| mesh.rows > 1 && mesh.columns > 1),
            );
            gaps.into_iter().fold(f64::INFINITY, f64::min)
        }
        Layout::List { tires, cables } => cables
            .iter()
            .filter_map(|&(a, b)| Some((tires.get(a)?, tires.get(b)?)))
            .map(|(a, b)| (a.x_m - b.x_m).hypot(a.y_m - b.y_m))
            .fold(f64::INFINITY, f64::min),
    };
    if least - diameter < 1e-6 * least {
        let message =
            format!("centres {least} m apart leave no room for a cable between tires of {diameter} m");
        let remedy = "a larger spacing, or a smaller outer_diameter_m (0: cables run from centre to centre)";
        let place = root.table_if("tire").map_or(0..0, |table| table.span_of("outer_diameter_m"));
        mistakes.add(place, message, remedy);
    }
}

fn read_blast_rows(
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
                x_m: hole.number("x_m", None, PLACE_M, "1.5"),
                y_m: hole.number("y_m", None, PLACE_M, "4.5"),
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
        let tires = tires.value.into_iter().map(|tire| tire.value.saturating_sub(1)).collect();
        return Charge::UnderTires { tires, launch_m_s };
    }
    let row = table.number_if("under_row", 0.0..=1e7, "2").unwrap_or(1.0);
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
            let height = table.number("free_flight_height_m", None, 0.0..=1e5, "1.83");
            (2.0 * gravity * height).sqrt()
        }
        _ => table.number("launch_m_s", None, LAUNCH_M_S, "6.0"),
    }
}

fn read_delays(root: &Table<'_>, rows: &[BlastRow], mistakes: &Mistakes) -> Vec<DelayOption> {
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
            if let Some(message) = bounded(time.value, &TIME_MS) {
                mistakes.add(
                    time.span.clone(),
                    format!("a firing time {message}"),
                    "write 0 ms or later, up to 1e9",
                );
            }
        }
        return Timing::At(at.value.into_iter().map(|time| time.value).collect());
    }
    let interval_ms = table.number("interval_ms", None, TIME_MS, "20");
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
