//! The rope catalogue as a report: one table a family.

use super::parts::{Block, Cell, Column, Report, Table};
use crate::ropes::{Catalogue, Rope, Termination};
use crate::units::Unit;

const SCHEMA: &str = "shelter.ropes/1";

const ROPES: [Column; 14] = [
    Column::words(&["name"], "name in plans"),
    Column::scripts(&["family"]),
    Column::scripts(&["standard"]),
    Column::scripts(&["construction"]),
    Column::scripts(&["kind"]).json(&[]),
    Column::scripts(&[]).json(&["kind"]),
    Column::numbers(&["grade"], "grade, N/mm²", Unit::One),
    Column::numbers(&["diameter_mm"], "diameter, mm", Unit::One),
    Column::numbers(&["metallic_area_mm2"], "area, mm²", Unit::One),
    Column::numbers(&["mass_kg_per_m"], "mass, kg/m", Unit::One),
    Column::numbers(&["axial_stiffness_kn"], "EA, kN", Unit::One),
    Column::numbers(&["breaking_force_kn"], "breaks at, kN", Unit::One),
    Column::scripts(&["source"]),
    Column::scripts(&["typical"]),
];

const TERMINATIONS: [Column; 5] = [
    Column::words(&["name"], "termination"),
    Column::numbers(&["efficiency_percent"], "of the rope", Unit::Percent),
    Column::words(&["fits"], "fits").json(&[]),
    Column::scripts(&[]).json(&["fits"]),
    Column::words(&["source"], "source"),
];

/// The ropes by family, each family with its source.
pub fn ropes(catalogue: &Catalogue) -> Report {
    let mut blocks = Vec::new();
    for family in catalogue.ropes.chunk_by(|a, b| a.family == b.family) {
        let Some(first) = family.first() else { continue };
        let mut lines = vec![format!("{}: {}", first.standard, first.construction)];
        if first.typical {
            lines.push("typical values".to_owned());
        }
        lines.push(first.source.clone());
        blocks.push(Block::Text(lines));
        blocks.push(Block::Table(Table::new(&ROPES, family.iter().map(cells)).key("ropes")));
    }
    blocks.push(Block::Table(table_of_terminations(catalogue).json_only()));
    Report { schema: SCHEMA, blocks, ..Report::default() }
}

fn cells(rope: &Rope) -> Vec<Cell> {
    let text = |text: &str| Cell::Text(text.to_owned());
    vec![
        text(&rope.name),
        text(&rope.family),
        text(&rope.standard),
        text(&rope.construction),
        text(rope.kind.label()),
        text(rope.kind.name()),
        Cell::Count(rope.grade as usize),
        Cell::Number(rope.diameter_mm),
        rope.metallic_area_mm2.into(),
        Cell::Rounded(rope.mass_kg_per_m, 3),
        Cell::Rounded(rope.axial_stiffness_kn, 0),
        Cell::Number(rope.breaking_force_kn),
        text(&rope.source),
        Cell::Flag(rope.typical),
    ]
}

/// The terminations.
pub fn terminations(catalogue: &Catalogue) -> Report {
    let ropes = Table::new(&ROPES, catalogue.ropes.iter().map(cells)).key("ropes").json_only();
    let blocks = [ropes, table_of_terminations(catalogue)].map(Block::Table).into();
    Report { schema: SCHEMA, blocks, ..Report::default() }
}

fn table_of_terminations(catalogue: &Catalogue) -> Table {
    let cells = |termination: &Termination| {
        let kinds = || termination.fits.iter();
        vec![
            (&termination.name).into(),
            Cell::Number(termination.efficiency_percent),
            Cell::Text(kinds().map(|kind| kind.label()).collect::<Vec<_>>().join(", ")),
            Cell::list(kinds().map(|kind| kind.name())),
            (&termination.source).into(),
        ]
    };
    Table::new(&TERMINATIONS, catalogue.terminations.iter().map(cells)).key("terminations")
}
