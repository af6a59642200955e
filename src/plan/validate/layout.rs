//! The shelter's section: layout, spacing, links, or tires and cables one by one.

use std::collections::HashSet;

use crate::plan::read::{Mistakes, Table};
use crate::plan::{Layout, Links, ListedTire, Mesh, TireSpec, range};

#[derive(Clone, Copy)]
enum Kind {
    Grid,
    Quincunx,
    List,
}

pub fn read_layout(table: Table<'_>, mistakes: &Mistakes) -> Option<Layout> {
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
        Layout::Grid(mesh) => mesh.corners(),
        Layout::Quincunx(mesh) => mesh.corners().saturating_mul(2),
        Layout::List { tires, .. } => tires.len(),
    };
    if tires > range::MOST_TIRES {
        let message = format!("the shelter has more than {} tires", range::MOST_TIRES);
        table.wrong("rows", message, "describe a smaller shelter");
    }
    table.finish();
    (mistakes.count() == before).then_some(layout)
}

fn read_mesh(table: &Table<'_>, least: usize, mistakes: &Mistakes) -> Mesh {
    let rows = table.whole("rows", least..=range::MOST_TIRES, "5");
    let columns = table.whole("columns", least..=range::MOST_TIRES, "10");
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
    let border_rows =
        if table.has("border_rows") { table.whole("border_rows", range::BORDER_ROWS, "1") } else { 0 };
    let links = Links { row, column, diagonal };
    Mesh { rows, columns, row_spacing_m, column_spacing_m, links, border_rows }
}

fn read_spacing(table: &Table<'_>) -> (f64, f64) {
    match table.inline_table("spacing_m") {
        Some(both) => {
            let spacing = (
                both.number("row", None, range::SPACING_M, "1.5"),
                both.number("column", None, range::SPACING_M, "1.6"),
            );
            both.finish();
            spacing
        }
        None => {
            let spacing = table.number("spacing_m", None, range::SPACING_M, "1.5");
            (spacing, spacing)
        }
    }
}

fn read_list(table: &Table<'_>, mistakes: &Mistakes) -> Layout {
    let mut tires = Vec::new();
    let mut places = HashSet::new();
    for tire in table.tables("tire") {
        let place = ListedTire {
            x_m: tire.number("x_m", None, range::PLACE_M, "0"),
            y_m: tire.number("y_m", None, range::PLACE_M, "0"),
            mass_kg: tire.number_if("mass_kg", range::MASS_KG, "280"),
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
pub fn check_gaps(layout: &Layout, tire: &TireSpec, root: &Table<'_>, mistakes: &Mistakes) {
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
