//! The values of a plan that are often changed, as its text has them: to be shown, and to be replaced one by one.

use toml_edit::{DocumentMut, Item, Value};

use super::edit::with_line_ends_of;

/// One value of a plan's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// What it is, in words.
    pub label: String,
    /// Where it stands.
    pub path: Path,
    /// As the text has it; empty where the plan leaves it out.
    pub value: String,
}

/// Where a value stands: a section, which of several, and a key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path {
    /// Name of the section.
    pub section: &'static str,
    /// Which of several sections of that name, from 0.
    pub index: Option<usize>,
    /// The key.
    pub key: &'static str,
}

/// Single sections: section, key, label.
const SINGLE: &[(&str, &str, &str)] = &[
    ("limits", "flight_height_m", "limit of flight height, m"),
    ("limits", "cable_safety_factor", "cable safety factor"),
    ("limits", "drift_m", "limit of drift, m"),
    ("cable", "rope", "rope"),
    ("cable", "termination", "termination"),
    ("cable", "slack_percent", "slack, %"),
    ("cable", "axial_stiffness_kn", "axial stiffness EA, kN"),
    ("cable", "breaking_force_kn", "breaking force, kN"),
    ("tire", "mass_kg", "tire mass, kg"),
    ("tire", "outer_diameter_m", "outer diameter, m"),
    ("ground", "friction", "friction"),
    ("shelter", "rows", "shelter rows"),
    ("shelter", "columns", "shelter columns"),
    ("shelter", "spacing_m", "spacing, m"),
    ("shelter", "border_rows", "border rows"),
    ("simulation", "duration_s", "duration, s"),
    ("scatter", "detonator", "detonators"),
    ("scatter", "delay_sd_ms", "scatter of times, ms"),
    ("scatter", "delay_cv_percent", "scatter of times, %"),
    ("scatter", "launch_cv_percent", "scatter of launches, %"),
];

/// The fields of a plan's text; those it leaves out are listed where they may be added.
pub fn fields(text: &str) -> Vec<Field> {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let mut fields = Vec::new();
    let rope = document.get("cable").is_some_and(|cable| cable.get("rope").is_some());
    for &(section, key, label) in SINGLE {
        let value = document.get(section).and_then(|table| table.get(key)).map(words).unwrap_or_default();
        let offered = ["drift_m", "termination", "slack_percent", "outer_diameter_m", "border_rows"]
            .contains(&key)
            || (key == "rope" && rope);
        if !value.is_empty() || offered {
            fields.push(Field { label: label.to_owned(), path: Path { section, index: None, key }, value });
        }
    }
    for (section, keys) in [
        ("blast_row", &["launch_m_s", "free_flight_height_m", "under_row"][..]),
        ("delay", &["name", "interval_ms", "at_ms", "order"]),
    ] {
        for (n, table) in tables(&document, section).enumerate() {
            let name = table.get("name").and_then(Item::as_str).unwrap_or_default();
            for &key in keys {
                let value = table.get(key).map(words).unwrap_or_default();
                let offered = key == "order" && table.get("interval_ms").is_some();
                if !value.is_empty() || offered {
                    let what = key
                        .replace("_m_s", ", m/s")
                        .replace("_ms", ", ms")
                        .replace("_m", ", m")
                        .replace('_', " ");
                    let label = format!("{} {name}: {what}", section.trim_start_matches("blast_"));
                    fields.push(Field { label, path: Path { section, index: Some(n), key }, value });
                }
            }
        }
    }
    fields
}

fn tables<'d>(
    document: &'d DocumentMut,
    section: &str,
) -> Box<dyn Iterator<Item = &'d dyn toml_edit::TableLike> + 'd> {
    match document.get(section) {
        Some(Item::ArrayOfTables(tables)) => {
            Box::new(tables.iter().map(|table| table as &dyn toml_edit::TableLike))
        }
        Some(Item::Value(Value::Array(list))) => Box::new(
            list.iter()
                .filter_map(|value| value.as_inline_table())
                .map(|table| table as &dyn toml_edit::TableLike),
        ),
        _ => Box::new(std::iter::empty()),
    }
}

/// Names of the blast rows in the order of firing that a delay option's field has, or in that of the plan.
pub fn order(text: &str, path: &Path) -> Vec<String> {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let written =
        path.index.and_then(|index| tables(&document, path.section).nth(index)?.get("order")?.as_array());
    let names = |list: &toml_edit::Array| list.iter().filter_map(Value::as_str).map(str::to_owned).collect();
    let all = || {
        let name = |row: &dyn toml_edit::TableLike| Some(row.get("name")?.as_str()?.to_owned());
        tables(&document, "blast_row").filter_map(name).collect()
    };
    written.map_or_else(all, names)
}

/// A value without what stands around it.
fn words(item: &Item) -> String {
    let mut value = item.as_value().cloned();
    if let Some(value) = &mut value {
        value.decor_mut().clear();
    }
    value.map_or_else(String::new, |value| value.to_string())
}

/// The text with one value replaced, added, or, where `new` is empty, removed; or why `new` is no value.
///
/// A text need not be quoted. Comments and formatting stay.
pub fn set(text: &str, path: &Path, new: &str) -> Result<String, String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| error.message().to_owned())?;
    let table =
        table_mut(&mut document, path).ok_or_else(|| format!("the plan has no [{}]", path.section))?;
    if new.trim().is_empty() {
        table.remove(path.key);
        return Ok(with_line_ends_of(text, &document));
    }
    let textual = ["name", "rope", "termination", "detonator"].contains(&path.key);
    // A list of numbers may be typed without its brackets.
    let typed = new.trim().parse::<Value>().or_else(|error| match path.key {
        "at_ms" => format!("[{}]", new.trim()).parse(),
        _ => Err(error),
    });
    let value = match typed {
        Ok(value) if !textual || value.is_str() => value,
        _ if textual => Value::from(new.trim()),
        _ => return Err(format!("'{}' is no value: write it as the plan does", new.trim())),
    };
    super::edit::set(table, path.key, value);
    Ok(with_line_ends_of(text, &document))
}

fn table_mut<'d>(document: &'d mut DocumentMut, path: &Path) -> Option<&'d mut dyn toml_edit::TableLike> {
    let item = document.get_mut(path.section)?;
    let Some(index) = path.index else { return item.as_table_like_mut() };
    match item {
        Item::ArrayOfTables(tables) => {
            tables.get_mut(index).map(|table| table as &mut dyn toml_edit::TableLike)
        }
        Item::Value(Value::Array(list)) => {
            list.get_mut(index)?.as_inline_table_mut().map(|table| table as &mut dyn toml_edit::TableLike)
        }
        _ => None,
    }
}

/// The text with a copy of one delay option behind it, under a name of its own.
pub fn copy_delay(text: &str, index: usize) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    let Item::ArrayOfTables(tables) = document.get_mut("delay")? else { return None };
    let mut all: Vec<toml_edit::Table> = tables.iter().cloned().collect();
    let name =
        |table: &toml_edit::Table| table.get("name").and_then(Item::as_str).unwrap_or_default().to_owned();
    let names: Vec<String> = all.iter().map(name).collect();
    let mut copy = all.get(index)?.clone();
    let new = (2..).map(|n| format!("{} ({n})", names[index])).find(|new| !names.contains(new))?;
    super::edit::set(&mut copy, "name", Value::from(new));
    copy.decor_mut().set_prefix("\n");
    all.insert(index + 1, copy);
    replace(tables, all);
    Some(with_line_ends_of(text, &document))
}

/// The text without one delay option; `None` for the last one left.
pub fn remove_delay(text: &str, index: usize) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    let Item::ArrayOfTables(tables) = document.get_mut("delay")? else { return None };
    (tables.len() > 1 && index < tables.len()).then(|| tables.remove(index))?;
    Some(with_line_ends_of(text, &document))
}

/// Puts tables in the place of others; each follows the one before it in the text.
fn replace(tables: &mut toml_edit::ArrayOfTables, all: Vec<toml_edit::Table>) {
    let first = tables.iter().filter_map(toml_edit::Table::position).min();
    tables.clear();
    for mut table in all {
        table.set_position(first);
        tables.push(table);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = include_str!("../../plans/amur-three-rows.toml");

    fn find(text: &str, section: &str, index: Option<usize>, key: &str) -> Field {
        let mut all = fields(text).into_iter();
        all.find(|f| f.path.section == section && f.path.index == index && f.path.key == key)
            .expect("a field")
    }

    #[test]
    fn one_value_changes_and_nothing_else() {
        let field = find(PLAN, "delay", Some(1), "interval_ms");
        assert_eq!(field.value, "9");
        let new = set(PLAN, &field.path, "12.5").expect("a value");
        assert_eq!(new, PLAN.replace("interval_ms = 9", "interval_ms = 12.5"));
        let rope = find(PLAN, "cable", None, "rope");
        let new = set(PLAN, &rope.path, "GOST 2688-80 15").expect("a value");
        assert_eq!(new, PLAN.replace("\"GOST 2688-80 14\"  ", "\"GOST 2688-80 15\"  "));
        assert!(set(PLAN, &field.path, "nine").is_err());
        let windows = PLAN.replace('\n', "\r\n");
        let new = set(&windows, &field.path, "12.5").expect("a value");
        assert_eq!(new, windows.replace("interval_ms = 9", "interval_ms = 12.5"));
    }

    #[test]
    fn options_are_copied_behind_themselves_and_removed() {
        let copied = copy_delay(PLAN, 1).expect("a copy");
        let plan =
            crate::plan::Plan::parse("", &copied).unwrap_or_else(|mistakes| panic!("{mistakes}\n{copied}"));
        let names: Vec<&str> = plan.delays.iter().map(|delay| delay.name.as_str()).collect();
        assert_eq!(&names[..4], ["all at once", "9 ms", "9 ms (2)", "20 ms"]);
        let removed = remove_delay(&copied, 2).expect("removed");
        assert_eq!(crate::plan::Plan::parse("", &removed).map(|plan| plan.delays.len()).ok(), Some(7));
        assert!(PLAN.lines().all(|line| removed.contains(line)), "comments stay:\n{removed}");
        assert_eq!(remove_delay("[[delay]]\nname = \"a\"\n", 0), None);
    }
}
