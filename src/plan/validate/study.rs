//! What the studies ask of a plan: how far things scatter, and what `size` may choose from.

use crate::plan::read::{Mistakes, Table, as_number, bounded};
use crate::plan::{DelayScatter, ScatterSpec, SizeSpec, range};
use crate::ropes;

/// Detonators by kind, with the scatter that domain sources give; see [`DelayScatter`].
const DETONATORS: [(&str, DelayScatter); 3] = [
    ("electronic", DelayScatter { sd_ms: 0.1, cv_percent: 0.01 }),
    ("pyrotechnic", DelayScatter { sd_ms: 0.0, cv_percent: 2.0 }),
    ("pyrotechnic surface", DelayScatter { sd_ms: 0.0, cv_percent: 4.0 }),
];

pub fn read_scatter(table: Table<'_>, mistakes: &Mistakes) -> ScatterSpec {
    let detonator = table.text_if("detonator", "\"electronic\"");
    let sd_ms = table.number_if("delay_sd_ms", range::SCATTER_MS, "0.5");
    let cv_percent = table.number_if("delay_cv_percent", range::SCATTER_PERCENT, "2");
    let delay = match &detonator {
        Some(name) => {
            for key in ["delay_sd_ms", "delay_cv_percent"] {
                if table.has(key) {
                    let message = format!("`{key}` stands beside `detonator`, which gives it too");
                    table.wrong(key, message, "keep one of them");
                }
            }
            let known = DETONATORS.iter().find(|(known, _)| *known == name.value);
            if known.is_none() {
                let names = DETONATORS.map(|(name, _)| format!("\"{name}\"")).join(", ");
                let message = format!("no detonator \"{}\"", name.value);
                mistakes.add(name.span.clone(), message, format!("write one of {names}"));
            }
            known.map_or_else(DelayScatter::default, |(_, scatter)| *scatter)
        }
        None => DelayScatter { sd_ms: sd_ms.unwrap_or(0.0), cv_percent: cv_percent.unwrap_or(0.0) },
    };
    let spec = ScatterSpec {
        delay,
        launch_cv_percent: table.number("launch_cv_percent", Some(0.0), range::SCATTER_PERCENT, "10"),
        friction: read_friction(&table, mistakes),
    };
    table.finish();
    spec
}

fn read_friction(table: &Table<'_>, mistakes: &Mistakes) -> Option<[f64; 2]> {
    let list = table.list("friction", "[0.3, 0.5]", "a number", as_number)?;
    for value in &list.value {
        if let Some(message) = bounded(value.value, &range::FRICTION) {
            mistakes.add(value.span.clone(), format!("`friction` {message}"), "write it as [0.3, 0.5]");
        }
    }
    match list.value.as_slice() {
        [low, high] if low.value <= high.value => Some([low.value, high.value]),
        _ => {
            let message = "`friction` must be a range, the lower end first";
            mistakes.add(list.span, message, "write `friction = [0.3, 0.5]`");
            None
        }
    }
}

pub fn read_size(table: Table<'_>, mistakes: &Mistakes) -> SizeSpec {
    let masses = table.list("tire_mass_kg", "[200, 280, 350]", "a number", as_number);
    let mut tire_mass_kg = Vec::new();
    for mass in masses.map_or_else(Vec::new, |list| list.value) {
        match bounded(mass.value, &range::MASS_KG) {
            Some(message) => {
                mistakes.add(mass.span, format!("`tire_mass_kg` {message}"), "list masses in kg")
            }
            None => tire_mass_kg.push(mass.value),
        }
    }
    let families = &ropes::catalogue().families();
    let family = table.text_if("ropes", "\"GOST 2688-80\"").filter(|family| {
        let known = families.contains(&family.value);
        if !known {
            let message = format!("no family of ropes \"{}\" in the catalogue", family.value);
            mistakes.add(family.span.clone(), message, format!("write one of {}", families.join(", ")));
        }
        known
    });
    let spec = SizeSpec {
        tire_mass_kg,
        family: family.map(|family| family.value.to_owned()),
        most_border_rows: if table.has("most_border_rows") {
            table.whole("most_border_rows", range::SIZED_BORDER_ROWS, "2")
        } else {
            0
        },
    };
    table.finish();
    spec
}
