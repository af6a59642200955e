//! The rope catalogue as a report: one table per family.

use super::parts::{Block, Cell, Column, Field, Report, Table};
use crate::ropes::{Catalogue, Kind, Rope, Termination};
use crate::units::Unit;

const SCHEMA: &str = "shelter.ropes/1";

fn rope_fields<'a>() -> [Field<&'a Rope>; 14] {
    let number = |keys, heading| Column::numbers(keys, heading, Unit::One);
    [
        Field::new(Column::words(&["name"], "name in plans"), |rope| (&rope.name).into()),
        Field::scripts(&["family"], |rope| (&rope.family).into()),
        Field::scripts(&["standard"], |rope| (&rope.standard).into()),
        Field::scripts(&["construction"], |rope| (&rope.construction).into()),
        Field::new(Column::scripts(&["kind"]).json(&[]), |rope| rope.kind.label().into()),
        Field::json(&["kind"], |rope| rope.kind.name().into()),
        Field::new(number(&["grade"], "grade, N/mm²"), |rope| Cell::Count(rope.grade as usize)),
        Field::new(number(&["diameter_mm"], "diameter, mm"), |rope| rope.diameter_mm.into()),
        Field::new(number(&["metallic_area_mm2"], "area, mm²"), |rope| rope.metallic_area_mm2.into()),
        Field::new(number(&["mass_kg_per_m"], "mass, kg/m"), |rope| Cell::Rounded(rope.mass_kg_per_m, 3)),
        Field::new(number(&["axial_stiffness_kn"], "EA, kN"), |rope| {
            Cell::Rounded(rope.axial_stiffness_kn, 0)
        }),
        Field::new(number(&["breaking_force_kn"], "breaks at, kN"), |rope| rope.breaking_force_kn.into()),
        Field::scripts(&["source"], |rope| (&rope.source).into()),
        Field::scripts(&["typical"], |rope| rope.typical.into()),
    ]
}

fn termination_fields<'a>() -> [Field<&'a Termination>; 5] {
    [
        Field::new(Column::words(&["name"], "termination"), |known| (&known.name).into()),
        Field::new(Column::numbers(&["efficiency_percent"], "of the rope", Unit::Percent), |known| {
            known.efficiency_percent.into()
        }),
        Field::new(Column::words(&["fits"], "fits").json(&[]), |known| {
            known.fits.iter().map(|kind| kind.label()).collect::<Vec<_>>().join(", ").into()
        }),
        Field::json(&["fits"], |known| Cell::list(known.fits.iter().copied().map(Kind::name))),
        Field::new(Column::words(&["source"], "source"), |known| (&known.source).into()),
    ]
}

fn table_of_ropes<'a>(ropes: impl IntoIterator<Item = &'a Rope>) -> Table {
    Table::of(&rope_fields(), ropes).key("ropes")
}

fn table_of_terminations(catalogue: &Catalogue) -> Table {
    Table::of(&termination_fields(), &catalogue.terminations).key("terminations")
}

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
        blocks.extend([Block::Text(lines), Block::Table(table_of_ropes(family))]);
    }
    blocks.push(Block::Table(table_of_terminations(catalogue).json_only()));
    Report { schema: SCHEMA, blocks, ..Report::default() }
}

/// The terminations.
pub fn terminations(catalogue: &Catalogue) -> Report {
    let ropes = table_of_ropes(&catalogue.ropes).json_only();
    let blocks = [ropes, table_of_terminations(catalogue)].map(Block::Table).into();
    Report { schema: SCHEMA, blocks, ..Report::default() }
}
