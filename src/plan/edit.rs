//! Changes to the text of a plan. Everything else in the text stays, comments and formatting too.

use toml_edit::{DocumentMut, Item, Table, value};

use super::Plan;
use super::keys::cable::{AXIAL_STIFFNESS_KN, BREAKING_FORCE_KN, ROPE};
use super::keys::shelter::BORDER_ROWS;
use super::keys::tire::MASS_KG;
use super::keys::{Key, plan};
use crate::ropes::Rope;

impl Plan {
    /// The plan with another rope, tire mass and border; all other values stay.
    pub fn with(&self, rope: &Rope, tire_mass_kg: f64, border_rows: usize) -> Plan {
        let mut plan = self.clone();
        plan.cable.rope = Some(rope.name.clone());
        plan.cable.axial_stiffness_kn = rope.axial_stiffness_kn;
        plan.cable.breaking_force_kn = rope.breaking_force_kn * plan.cable.termination_percent * 1e-2;
        plan.tire.mass_kg = tire_mass_kg;
        if let super::Layout::Grid(mesh) | super::Layout::Quincunx(mesh) = &mut plan.layout {
            mesh.border_rows = border_rows;
        }
        plan
    }
}

/// The text of a plan with another rope, tire mass and border.
pub fn write_sizes(
    text: &str,
    rope: &str,
    tire_mass_kg: f64,
    border_rows: usize,
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = text.parse()?;
    let section = |document: &mut DocumentMut, key: &Key, change: &dyn Fn(&mut dyn toml_edit::TableLike)| {
        let item = document.entry(key.name).or_insert(Item::Table(Table::new()));
        if let Some(table) = item.as_table_like_mut() {
            change(table);
        }
    };
    section(&mut document, &plan::CABLE, &|cable| {
        let first = cable.key(AXIAL_STIFFNESS_KN.name);
        let comment = first.and_then(|key| key.leaf_decor().prefix().cloned());
        cable.remove(AXIAL_STIFFNESS_KN.name);
        cable.remove(BREAKING_FORCE_KN.name);
        set(cable, ROPE.name, rope.into());
        if let (Some(comment), Some(mut key)) = (comment, cable.key_mut(ROPE.name)) {
            key.leaf_decor_mut().set_prefix(comment);
        }
    });
    section(&mut document, &plan::TIRE, &|tire| {
        let now =
            tire.get(MASS_KG.name).and_then(|mass| mass.as_float().or(mass.as_integer().map(|kg| kg as f64)));
        if now != Some(tire_mass_kg) {
            set(tire, MASS_KG.name, tire_mass_kg.into());
        }
    });
    section(&mut document, &plan::SHELTER, &|shelter| {
        if border_rows > 0 || shelter.contains_key(BORDER_ROWS.name) {
            set(shelter, BORDER_ROWS.name, (border_rows as i64).into());
        }
    });
    Ok(with_line_ends_of(text, &document))
}

/// The text of a changed document, with the line ends of the text before the change.
pub(super) fn with_line_ends_of(text: &str, document: &DocumentMut) -> String {
    let new = document.to_string();
    if text.contains("\r\n") { new.replace("\r\n", "\n").replace('\n', "\r\n") } else { new }
}

/// Sets the value of a key; the comment beside an old value stays.
pub(super) fn set(table: &mut dyn toml_edit::TableLike, key: &str, mut new: toml_edit::Value) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            *new.decor_mut() = old.decor().clone();
            *old = new;
        }
        None => {
            table.insert(key, value(new));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_chosen_values_change() {
        let text = "# top\n[shelter] # here\nrows = 5\n\n[tire]\nmass_kg = 280 # worn\n\n[cable]\n# ours\naxial_stiffness_kn = 1519\nbreaking_force_kn = 20.9\nslack_percent = 2\n";
        let windows = write_sizes(&text.replace('\n', "\r\n"), "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        let written = write_sizes(text, "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        assert_eq!(windows, written.replace('\n', "\r\n"));
        let same = write_sizes(&written, "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        assert_eq!(same, written);
        let expected = "# top\n[shelter] # here\nrows = 5\nborder_rows = 1\n\n[tire]\nmass_kg = 350.0 # worn\n\n[cable]\nslack_percent = 2\n# ours\nrope = \"GOST 2688-80 8.3\"\n";
        assert_eq!(written, expected);
    }
}
