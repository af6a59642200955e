//! Reads `[shelter]`: layout, spacing and links, or tires and cables one by one.

use std::collections::HashSet;

use crate::choice::{LayoutKind, Link};
use crate::plan::keys::{MOST_TIRES, listed_cable, listed_tire, plan, shelter, size, spacing, tire};
use crate::plan::reader::{Mistakes, SectionReader};
use crate::plan::{Layout, ListedTire, Mesh, TireSpec};

pub fn read_layout(section: SectionReader<'_>, mistakes: &Mistakes) -> Option<Layout> {
    let before = mistakes.count();
    let layout = match section.choice(&shelter::LAYOUT, LayoutKind::Grid) {
        LayoutKind::List => read_list(&section, mistakes),
        LayoutKind::Grid => Layout::Grid(read_mesh(&section, 1)),
        LayoutKind::Quincunx => Layout::Quincunx(read_mesh(&section, 2)),
    };
    let tires = match &layout {
        Layout::Grid(mesh) => mesh.corners(),
        Layout::Quincunx(mesh) => mesh.corners().saturating_mul(2),
        Layout::List { tires, .. } => tires.len(),
    };
    if tires > MOST_TIRES {
        let message = format!("the shelter has more than {MOST_TIRES} tires");
        section.wrong(&shelter::ROWS, message, "describe a smaller shelter");
    }
    section.finish();
    (mistakes.count() == before).then_some(layout)
}

fn read_mesh(section: &SectionReader<'_>, least: usize) -> Mesh {
    let rows = section.whole_within(&shelter::ROWS, least..=MOST_TIRES);
    let columns = section.whole_within(&shelter::COLUMNS, least..=MOST_TIRES);
    let (row_spacing_m, column_spacing_m) = read_spacing(section);
    let links = section.choices(&shelter::LINKS).unwrap_or_else(|| Link::ALL.to_vec());
    let border_rows = section.whole(&shelter::BORDER_ROWS);
    Mesh { rows, columns, row_spacing_m, column_spacing_m, links, border_rows }
}

/// Distances between rows and between columns [m].
fn read_spacing(section: &SectionReader<'_>) -> (f64, f64) {
    match section.inline_section(&shelter::SPACING_M) {
        Some(both) => {
            let distances = (both.number(&spacing::ROW), both.number(&spacing::COLUMN));
            both.finish();
            distances
        }
        None => {
            let distance = section.number(&shelter::SPACING_M);
            (distance, distance)
        }
    }
}

fn read_list(section: &SectionReader<'_>, mistakes: &Mistakes) -> Layout {
    let mut tires = Vec::new();
    let mut positions = HashSet::new();
    for tire in section.sections(&shelter::TIRE) {
        let listed = ListedTire {
            x_m: tire.number(&listed_tire::X_M),
            y_m: tire.number(&listed_tire::Y_M),
            mass_kg: tire.number_if(&listed_tire::MASS_KG),
        };
        let bits = [listed.x_m + 0.0, listed.y_m + 0.0].map(f64::to_bits);
        if !positions.insert(bits) {
            let message = format!("tire {} lies where another one does", tires.len() + 1);
            mistakes.add(tire.span.clone(), message, "move or remove one of them");
        }
        tires.push(listed);
        tire.finish();
    }
    if tires.is_empty() {
        let remedy = "add a section [[shelter.tire]] with x_m and y_m for each tire";
        mistakes.add(section.span.clone(), "the shelter has no tire", remedy);
    }
    let mut cables = Vec::new();
    let mut tied = HashSet::new();
    for cable in section.sections(&shelter::CABLE) {
        let most = tires.len().max(1);
        let before = mistakes.count();
        let first = cable.whole_within(&listed_cable::FROM, 1..=most);
        let second = cable.whole_within(&listed_cable::TO, 1..=most);
        if mistakes.count() == before {
            if first == second {
                cable.wrong(
                    &listed_cable::TO,
                    format!("a cable from tire {first} to itself"),
                    "name another tire",
                );
            } else if !tied.insert((first.min(second), first.max(second))) {
                let message = format!("tires {first} and {second} are tied twice");
                mistakes.add(cable.span.clone(), message, "remove one of the two cables");
            }
        }
        cables.push((first - 1, second - 1));
        cable.finish();
    }
    Layout::List { tires, cables }
}

/// Notes a mistake if tires have no room beside one another, in the plan's shelter or with the rows of ballast that `[size]` may add.
pub fn check_gaps(
    layout: &Layout,
    tire: &TireSpec,
    most_border_rows: usize,
    root: &SectionReader<'_>,
    mistakes: &Mistakes,
) {
    let border = match layout {
        Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.border_rows,
        Layout::List { .. } => 0,
    };
    let lacks_room = |border: usize| layout.lacks_room(tire.outer_diameter_m, border);
    if let Some(message) = lacks_room(border) {
        let remedy = "a larger spacing, or a smaller outer_diameter_m (0: cables run from centre to centre)";
        let span =
            root.section_if(&plan::TIRE).map_or(0..0, |section| section.span_of(&tire::OUTER_DIAMETER_M));
        mistakes.add(span, message, remedy);
    } else if let Some(message) = lacks_room(most_border_rows) {
        let of_size = root.section_if(&plan::SIZE);
        let span = of_size.map_or(0..0, |section| section.span_of(&size::MOST_BORDER_ROWS));
        mistakes.add(span, message, "a larger spacing, or leave out most_border_rows");
    }
}
