//! Changes to the text of a plan. Everything else in the text stays, comments and formatting too.

pub mod change;
pub mod differences;
pub mod fields;

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value, value};

use super::fitted_blast;
use super::keys::blast_row::{FREE_FLIGHT_HEIGHT_M, HOLES, LAUNCH_M_S};
use super::keys::cable::{AXIAL_STIFFNESS_KN, BREAKING_FORCE_KN, ROPE};
use super::keys::shelter::BORDER_ROWS;
use super::keys::tire::MASS_KG;
use super::keys::uncertainty::FITTED_FROM;
use super::keys::{self, Key};
use super::names::look_alike;
use super::{BlastRow, DelayOption, Plan, Timing};
use crate::units::{self, Unit};

/// The text of `plan` with another rope, tire mass [kg] and number of border rows. Launch velocities follow the tire mass at the worse end
/// of the [mass law](super::mass_law).
pub fn write_sizes(
    text: &str,
    plan: &Plan,
    rope: &str,
    tire_mass_kg: f64,
    border_rows: usize,
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = text.parse()?;
    change_section(&mut document, &keys::plan::CABLE, |cable| {
        replace_keys(cable, &[&AXIAL_STIFFNESS_KN, &BREAKING_FORCE_KN], &ROPE, rope.into());
    });
    if plan.tire.mass_kg != tire_mass_kg {
        let set_mass = |tire: &mut dyn TableLike| set(tire, MASS_KG.name, tire_mass_kg.into());
        change_section(&mut document, &keys::plan::TIRE, set_mass);
        scale_launches(&mut document, plan.launch_factor_of_mass(tire_mass_kg));
        note_fitted_tires(&mut document, tire_mass_kg);
    }
    change_section(&mut document, &keys::plan::SHELTER, |shelter| {
        if border_rows > 0 || shelter.contains_key(BORDER_ROWS.name) {
            set(shelter, BORDER_ROWS.name, (border_rows as i64).into());
        }
    });
    Ok(with_line_ends_of(text, &document))
}

/// The text of a plan with all launch velocities times `factor`.
pub fn with_launches(text: &str, factor: f64) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = text.parse()?;
    scale_launches(&mut document, factor);
    Ok(with_line_ends_of(text, &document))
}

/// The text of a plan whose tires have another mass by now, with its launches scaled. `factor` depends on the index of the blast row and
/// its launch velocity [m/s]. `gravity` [m/s²] is the gravity of the plan.
pub fn with_launches_of_mass(
    text: &str,
    factor: &dyn Fn(usize, f64) -> f64,
    tire_mass_kg: f64,
    gravity: f64,
) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = text.parse()?;
    let scaled = |value: f64, by: f64| if by == 1.0 { value } else { rounded(value * by) };
    let of_height = |row, height: f64| factor(row, (2.0 * gravity * height).sqrt());
    change_launches(&mut document, &|row, speed| scaled(speed, factor(row, speed)), &|row, height| {
        scaled(height, of_height(row, height).powi(2))
    });
    note_fitted_tires(&mut document, tire_mass_kg);
    Ok(with_line_ends_of(text, &document))
}

/// Writes the tire mass to which the launches are scaled into `fitted_from`, if that names tires.
fn note_fitted_tires(document: &mut DocumentMut, tire_mass_kg: f64) {
    let section = document.get_mut(keys::plan::UNCERTAINTY.name).and_then(Item::as_table_like_mut);
    let fitted = section.and_then(|section| section.get_mut(FITTED_FROM.name)).and_then(Item::as_array_mut);
    for kept in fitted.into_iter().flat_map(|list| list.iter_mut()) {
        if kept.as_str().is_some_and(|kept| kept.starts_with("tires ")) {
            let decor = kept.decor().clone();
            *kept = fitted_blast::of_tires(tire_mass_kg).into();
            *kept.decor_mut() = decor;
        }
    }
}

/// The text of a plan with more delay options behind its own. An option gets another name if its name is taken.
pub fn add_delays(text: &str, plan: &Plan, delays: &[&DelayOption]) -> Result<String, toml_edit::TomlError> {
    let mut document: DocumentMut = text.parse()?;
    let mut names: Vec<String> = plan.delays.iter().map(|delay| delay.name.clone()).collect();
    for &delay in delays {
        let name = free_name(&delay.name, |name| names.iter().any(|taken| look_alike(taken, name)));
        let entries = delay_entries(delay, &name, &plan.blast_rows);
        names.push(name);
        match document.entry(keys::plan::DELAY.name).or_insert(Item::ArrayOfTables(ArrayOfTables::new())) {
            Item::Value(Value::Array(list)) => list.push(entries.into_iter().collect::<InlineTable>()),
            item => {
                if let Some(tables) = item.as_array_of_tables_mut() {
                    let mut table =
                        entries.into_iter().map(|(key, new)| (key, value(new))).collect::<Table>();
                    table.decor_mut().set_prefix("\n");
                    let last = tables.iter().filter_map(Table::position).max();
                    table.set_position(last);
                    tables.push(table);
                }
            }
        }
    }
    Ok(with_line_ends_of(text, &document))
}

/// `name` itself, or if it is taken, the first free name of `name (2)`, `name (3)` and so on.
pub fn free_name(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|n| format!("{name} ({n})"));
    let mut all = std::iter::once(name.to_owned()).chain(numbered);
    all.find(|name| !is_taken(name)).unwrap_or_default()
}

/// Keys and values of a delay option.
fn delay_entries(delay: &DelayOption, name: &str, rows: &[BlastRow]) -> Vec<(&'static str, Value)> {
    let mut entries = vec![(keys::delay::NAME.name, Value::from(name))];
    match &delay.timing {
        Timing::Interval { order, interval } => {
            if !order.is_sorted() {
                let names = order.iter().map(|&row| rows[row].name.as_str());
                entries.push((keys::delay::ORDER.name, Value::from_iter(names)));
            }
            entries.push((keys::delay::INTERVAL_MS.name, plain(interval.ms())));
        }
        Timing::At(times) => {
            let times = Value::from_iter(times.iter().map(|time| plain(time.ms())));
            entries.push((keys::delay::AT_MS.name, times));
        }
    }
    if !delay.hole_timing.is_together() {
        entries.push((keys::delay::HOLE_INTERVAL_MS.name, plain(delay.hole_timing.interval.ms())));
        entries.push((keys::delay::HOLE_ORDER.name, delay.hole_timing.order.name().into()));
    }
    if delay.hole_timing.fired_through {
        entries.push((keys::delay::FIRED_THROUGH.name, true.into()));
    }
    entries
}

/// A number as a person writes it: 42, not 42.0.
fn plain(number: f64) -> Value {
    if number.fract() == 0.0 && number.abs() < 1e15 {
        Value::from(number as i64)
    } else {
        Value::from(number)
    }
}

/// Changes a section of the plan. A section that the plan leaves out is added.
pub(super) fn change_section(document: &mut DocumentMut, key: &Key, change: impl FnOnce(&mut dyn TableLike)) {
    let item = document.entry(key.name).or_insert(Item::Table(Table::new()));
    if let Some(table) = item.as_table_like_mut() {
        change(table);
    }
}

/// Sets `key` in place of the keys `old`; the comment above the first of them stays.
pub(super) fn replace_keys(table: &mut dyn TableLike, old: &[&Key], key: &Key, new: Value) {
    let first = old.first().and_then(|first| table.key(first.name));
    let comment = first.and_then(|first| first.leaf_decor().prefix().cloned());
    for old in old {
        table.remove(old.name);
    }
    set(table, key.name, new);
    if let (Some(comment), Some(mut key)) = (comment, table.key_mut(key.name)) {
        key.leaf_decor_mut().set_prefix(comment);
    }
}

/// The value of a key, if it is a number.
pub(super) fn number(table: &dyn TableLike, key: &str) -> Option<f64> {
    as_number(table.get(key)?.as_value()?)
}

/// A value as a number, if it is a number with or without decimals.
pub(super) fn as_number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Changes the launches of all blast rows and holes. `speed` maps the index of a row and its launch velocity [m/s] to the new velocity.
/// `height` does the same for free flight heights [m], where the plan gives those.
pub(super) fn change_launches(
    document: &mut DocumentMut,
    speed: &dyn Fn(usize, f64) -> f64,
    height: &dyn Fn(usize, f64) -> f64,
) {
    fn each(item: Option<&mut Item>, change: &dyn Fn(usize, &mut dyn TableLike)) {
        match item {
            Some(Item::ArrayOfTables(tables)) => {
                tables.iter_mut().enumerate().for_each(|(n, table)| change(n, table));
            }
            Some(Item::Value(Value::Array(list))) => {
                let tables = list.iter_mut().filter_map(Value::as_inline_table_mut);
                tables.enumerate().for_each(|(n, table)| change(n, table));
            }
            _ => {}
        }
    }
    let change = |row: usize, table: &mut dyn TableLike| {
        for (key, new) in [(LAUNCH_M_S, speed), (FREE_FLIGHT_HEIGHT_M, height)] {
            // A value that stays keeps its digits.
            let changed =
                number(table, key.name).map(|old| (old, new(row, old))).filter(|(old, new)| old != new);
            if let Some((_, new)) = changed {
                set(table, key.name, new.into());
            }
        }
    };
    each(document.get_mut(keys::plan::BLAST_ROW.name), &|row, table| {
        change(row, table);
        each(table.get_mut(HOLES.name), &|_, hole| change(row, hole));
    });
}

/// Multiplies all launch velocities of a plan by `factor`. A free flight height grows with the square of the velocity. At a factor of 1 all
/// values keep their digits.
pub(super) fn scale_launches(document: &mut DocumentMut, factor: f64) {
    if factor != 1.0 {
        let scaled = |by: f64| move |_, value: f64| rounded(value * by);
        change_launches(document, &scaled(factor), &scaled(factor * factor));
    }
}

/// The number rounded to six digits: 6 × 0.95 is 5.7.
pub(super) fn rounded(number: f64) -> f64 {
    units::exact(number, Unit::One).parse().unwrap_or(number)
}

/// The text of a changed document, with the line ends of the text before the change.
pub(super) fn with_line_ends_of(text: &str, document: &DocumentMut) -> String {
    let new = document.to_string();
    if text.contains("\r\n") { new.replace("\r\n", "\n").replace('\n', "\r\n") } else { new }
}

/// Sets the value of a key; the comment beside an old value stays.
pub(super) fn set(table: &mut dyn TableLike, key: &str, mut new: Value) {
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

    /// A plan with tires of 280 kg.
    fn plan() -> Plan {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    #[test]
    fn only_the_chosen_values_change() {
        let text = "# top\n[shelter] # here\nrows = 5\n\n[tire]\nmass_kg = 280 # worn\n\n[cable]\n# ours\naxial_stiffness_kn = 1519\nbreaking_force_kn = 20.9\nslack_percent = 2\n";
        let windows =
            write_sizes(&text.replace('\n', "\r\n"), &plan(), "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        let written = write_sizes(text, &plan(), "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        let mut heavy = plan();
        heavy.tire.mass_kg = 350.0;
        assert_eq!(windows, written.replace('\n', "\r\n"));
        let same = write_sizes(&written, &heavy, "GOST 2688-80 8.3", 350.0, 1).expect("TOML");
        assert_eq!(same, written);
        let expected = "# top\n[shelter] # here\nrows = 5\nborder_rows = 1\n\n[tire]\nmass_kg = 350.0 # worn\n\n[cable]\nslack_percent = 2\n# ours\nrope = \"GOST 2688-80 8.3\"\n";
        assert_eq!(written, expected);
    }

    /// A tire of half the mass may leave twice as fast, and rise four times as high. A heavier tire may leave as fast, and rise as high.
    #[test]
    fn launches_take_the_worse_end_of_the_mass_law() {
        let text = "tire = { mass_kg = 280 }\n[[blast_row]]\nlaunch_m_s = 6 # filmed\n[[blast_row]]\n\
                    holes = [{ x_m = 0, free_flight_height_m = 1.5 }]\n";
        // A fitted plan belongs to the tires to which its launches are scaled.
        let fitted = format!("{text}[uncertainty]\nfitted_from = [\"ab12\", \"tires 280 kg\"] # seen\n");
        let lighter = write_sizes(&fitted, &plan(), "GOST 2688-80 8.3", 140.0, 0).expect("TOML");
        assert!(lighter.contains("fitted_from = [\"ab12\", \"tires 140 kg\"] # seen"), "{lighter}");
        let written = write_sizes(text, &plan(), "GOST 2688-80 8.3", 140.0, 0).expect("TOML");
        assert!(written.contains("launch_m_s = 12.0 # filmed"), "{written}");
        assert!(written.contains("free_flight_height_m = 6.0 }"), "{written}");
        let heavier = write_sizes(text, &plan(), "GOST 2688-80 8.3", 350.0, 0).expect("TOML");
        assert!(heavier.contains("launch_m_s = 6 # filmed") && heavier.contains("= 1.5 }"), "{heavier}");
    }
}
