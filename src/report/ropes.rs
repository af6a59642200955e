//! The rope catalogue as text, JSON and CSV.

use serde::Serialize;

use crate::ropes::{Catalogue, Rope, Termination};

/// The catalogue as a document.
#[derive(Serialize)]
pub struct Document<'a> {
    schema: &'static str,
    ropes: &'a [Rope],
    terminations: &'a [Termination],
}

impl<'a> Document<'a> {
    /// All of it.
    pub fn new(catalogue: &'a Catalogue) -> Self {
        Self { schema: "shelter.ropes/1", ropes: &catalogue.ropes, terminations: &catalogue.terminations }
    }
}

/// Ropes as a table by family, each with its source.
pub fn text(catalogue: &Catalogue) -> String {
    let mut text = String::new();
    let mut family = "";
    for rope in &catalogue.ropes {
        if rope.family != family {
            family = &rope.family;
            let typical = if rope.typical { "\n  typical values" } else { "" };
            text += &format!("\n{}: {}{typical}\n  {}\n", rope.standard, rope.construction, rope.source);
            text += &format!(
                "  {:28} {:>7} {:>8} {:>8} {:>8} {:>9} {:>9}\n",
                "name in plans", "d, mm", "A, mm2", "kg/m", "N/mm2", "EA, kN", "break, kN"
            );
        }
        let area = rope.metallic_area_mm2.map_or_else(|| "-".to_owned(), |area| format!("{area}"));
        text += &format!(
            "  {:28} {:>7} {area:>8} {:>8.3} {:>8} {:>9.0} {:>9}\n",
            rope.name,
            rope.diameter_mm,
            rope.mass_kg_per_m,
            rope.grade,
            rope.axial_stiffness_kn,
            rope.breaking_force_kn
        );
    }
    text
}

/// Terminations as a table.
pub fn terminations(catalogue: &Catalogue) -> String {
    let row = |t: &Termination| format!("{:20} {:>5} %  {}\n", t.name, t.efficiency_percent, t.source);
    catalogue.terminations.iter().map(row).collect()
}
