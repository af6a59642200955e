//! Differences between two plans: every key whose values differ, from the texts of both.

use std::collections::BTreeMap;

use itertools::Itertools;
use toml_edit::{DocumentMut, Item, TableLike, Value};

use super::fields::value_text;
use crate::plan::keys::{DefaultValue, Key, plan};
use crate::sorting::sorted;

/// A key with different values in two plans.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Section and key: `limits flight_height_m`. The section alone, as `delay "33 ms"`, where one plan lacks that entry of a list.
    pub key: String,
    /// The values of both plans as written. A plan without the key has its default here, or an empty text if the key has no default.
    pub values: [String; 2],
}

/// The sections of a plan in order, each with its keys and values as written.
type Sections = Vec<(String, Vec<(String, String)>)>;

/// Every key, except the title, with different values in two texts of plans, in the order of the first text.
pub fn differences(texts: [&str; 2]) -> Vec<Difference> {
    let [first, second] = texts.map(sections);
    let lookup: [BTreeMap<&str, &Vec<(String, String)>>; 2] =
        [&first, &second].map(|sections| sections.iter().map(|(name, keys)| (name.as_str(), keys)).collect());
    let names = first.iter().chain(&second).map(|(name, _)| name.as_str()).unique();
    let values =
        names.flat_map(|name| of_section(name, [lookup[0].get(name).copied(), lookup[1].get(name).copied()]));
    values.chain(order_of_rows([&first, &second])).collect()
}

/// Difference in the order of the blast rows, where both plans list the same rows. The order matters: a delay option without an order of
/// its own fires the rows in the listed order.
fn order_of_rows(sections: [&Sections; 2]) -> Option<Difference> {
    let listed = sections.map(|sections| {
        let rows = sections.iter().filter_map(|(name, _)| name.strip_prefix(plan::BLAST_ROW.name));
        rows.map(str::trim).collect::<Vec<_>>()
    });
    let are_alike = sorted(&listed[0]) == sorted(&listed[1]);
    let values = || listed.each_ref().map(|rows| rows.join(", "));
    let key = || format!("{} order", plan::BLAST_ROW.name);
    (are_alike && listed[0] != listed[1]).then(|| Difference { key: key(), values: values() })
}

/// The differences of one section. `None`: the text lacks the section.
fn of_section(name: &str, sections: [Option<&Vec<(String, String)>>; 2]) -> Vec<Difference> {
    let is_entry = name.contains(' ');
    if is_entry && sections.contains(&None) {
        let whole = |keys: &Vec<(String, String)>| {
            keys.iter().map(|(key, value)| format!("{key} {value}")).join(", ")
        };
        let values = sections.map(|section| section.map_or_else(String::new, whole));
        return vec![Difference { key: name.to_owned(), values }];
    }
    let empty = Vec::new();
    let sections = sections.map(|section| section.unwrap_or(&empty));
    let keys = sections.into_iter().flatten().map(|(key, _)| key.as_str()).unique();
    let difference = |key: &str| {
        let written = |section: &Vec<(String, String)>| {
            section.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone())
        };
        let values = sections.map(written);
        let default = default_of(name, key);
        let in_force = values.clone().map(|value| value.or_else(|| default.clone()).unwrap_or_default());
        let differ = normal(&in_force[0]) != normal(&in_force[1]);
        let shown = |(value, in_force): (Option<String>, String)| match value {
            None if !in_force.is_empty() => format!("{in_force} (default)"),
            _ => in_force,
        };
        let [first, second] = values;
        let [in_first, in_second] = in_force;
        let values = [shown((first, in_first)), shown((second, in_second))];
        let title = if name.is_empty() { key.to_owned() } else { format!("{name} {key}") };
        differ.then_some(Difference { key: title, values })
    };
    keys.filter_map(difference).collect()
}

/// A value without spaces, for comparison. A number has one form, however the plan writes it.
fn normal(value: &str) -> String {
    let number = value.replace('_', "").parse::<f64>();
    number.map_or_else(|_| value.split_whitespace().collect(), |number| number.to_string())
}

/// Default of a key in a section, as text.
fn default_of(section: &str, key: &str) -> Option<String> {
    let section = section.split(' ').next()?;
    let sections = plan::SECTION.keys.iter().find(|known| known.name == section)?;
    let key = sections.kind.section()?.keys.iter().find(|known: &&&Key| known.name == key)?;
    match key.default? {
        DefaultValue::Number(number) => Some(number.to_string()),
        DefaultValue::Name(name) => Some(format!("\"{name}\"")),
        DefaultValue::Described(words) => Some(words.to_owned()),
    }
}

/// The sections of a text; none if the text is not TOML.
fn sections(text: &str) -> Sections {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let mut sections = vec![(String::new(), Vec::new())];
    for (name, item) in document.iter().filter(|(name, _)| *name != plan::TITLE.name) {
        add(&mut sections, name, item);
    }
    sections
}

/// Adds the keys of an item. A table becomes a section, a list of tables becomes one section per table, any other item becomes a value
/// without a section.
fn add(sections: &mut Sections, name: &str, item: &Item) {
    if let Some(table) = item.as_table_like() {
        add_table(sections, name, table);
        return;
    }
    let tables: Vec<&dyn TableLike> = match item {
        Item::ArrayOfTables(tables) => tables.iter().map(|table| table as &dyn TableLike).collect(),
        Item::Value(Value::Array(list)) => {
            list.iter().filter_map(Value::as_inline_table).map(|table| table as &dyn TableLike).collect()
        }
        _ => Vec::new(),
    };
    if tables.is_empty() {
        sections[0].1.push((name.to_owned(), value_text(item)));
    }
    for (n, table) in tables.into_iter().enumerate() {
        let called = table
            .get("name")
            .and_then(Item::as_str)
            .map_or_else(|| (n + 1).to_string(), |name| format!("{name:?}"));
        add_table(sections, &format!("{name} {called}"), table);
    }
}

/// Adds the keys of a table. Tables inside it become sections of their own.
fn add_table(sections: &mut Sections, name: &str, table: &dyn TableLike) {
    let (values, tables): (Vec<_>, Vec<_>) = table.iter().partition(|(_, item)| item.is_value());
    let keys = values.into_iter().filter(|(key, _)| *key != "name");
    sections.push((name.to_owned(), keys.map(|(key, item)| (key.to_owned(), value_text(item))).collect()));
    for (key, item) in tables {
        add(sections, &format!("{name}.{key}"), item);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_is_listed_with_both_values() {
        let first = r#"
            title = "A"
            [cable]
            slack_percent = 0
            [ground]
            friction = 0.50
            [limits]
            flight_height_m = 2.35 # comment
            [[blast_row]]
            name = "1"
            launch_m_s = 6.0
            [[delay]]
            name = "33 ms"
            interval_ms = 33
        "#;
        let second = r#"
            title = "B"
            delay = [{ name = "42 ms", interval_ms = 42 }]
            ground = { friction = 0.5 }
            limits = { flight_height_m = 2.1, drift_m = 0.5, accepted_risk_percent = 2 }
            blast_row = [{ name = "1", launch_m_s = 7 }]
        "#;
        let found = differences([first, second])
            .into_iter()
            .map(|Difference { key, values: [a, b] }| format!("{key}: {a} | {b}"));
        let expected = [
            "limits flight_height_m: 2.35 | 2.1",
            "limits drift_m:  | 0.5",
            "limits accepted_risk_percent: 1 (default) | 2",
            "blast_row \"1\" launch_m_s: 6.0 | 7",
            "delay \"33 ms\": interval_ms 33 | ",
            "delay \"42 ms\":  | interval_ms 42",
        ];
        assert_eq!(found.collect::<Vec<_>>(), expected);
        let rows =
            |names: [&str; 2]| names.map(|name| format!("[[blast_row]]\nname = \"{name}\"\n")).concat();
        let turned = Difference {
            key: "blast_row order".to_owned(),
            values: ["\"1\", \"2\"", "\"2\", \"1\""].map(str::to_owned),
        };
        assert_eq!(differences([&rows(["1", "2"]), &rows(["2", "1"])]), [turned], "they fire in it");
        assert_eq!(differences([first, first]), []);
    }
}
