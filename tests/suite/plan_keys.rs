//! The table of keys against all that use it: the reader, the schema, the editor, docs/plan-keys.md.

use std::collections::BTreeSet;
use std::fs;
use std::ops::RangeInclusive;
use std::path::Path;

use serde_json::Value;
use shelter::plan::Plan;
use shelter::plan::edit::fields::{fields, set};
use shelter::plan::keys::{DefaultValue, Key, Kind, Section, plan};
use shelter::plan::schema::schema;
use toml_edit::{DocumentMut, Item, TableLike};

use super::bad_plans::GOOD;

/// Holes and two spacings, with every section that a plan may leave out.
const HOLES: &str = r#"[shelter]
layout = "grid"
rows = 3
columns = 4
spacing_m = { row = 1.5, column = 1.6 }
[tire]
mass_kg = 280
[cable]
axial_stiffness_kn = 1519
breaking_force_kn = 20.9
[ground]
friction = 0.5
[[blast_row]]
name = "1"
holes = [{ x_m = 1, y_m = 1, launch_m_s = 6 }]
[limits]
flight_height_m = 1.5
cable_safety_factor = 2.0
[[delay]]
name = "a"
at_ms = [0]
[simulation]
[uncertainty]
[size]
[search]
intervals_ms = { from = 8, to = 150, step = 1 }
"#;

const LIST: &str = r#"[shelter]
layout = "list"
[[shelter.tire]]
x_m = 0
y_m = 0
[[shelter.tire]]
x_m = 2
y_m = 0
[[shelter.cable]]
from = 1
to = 2
[tire]
mass_kg = 280
[cable]
rope = "EN 818-2 6"
[ground]
friction = 0.5
[[blast_row]]
name = "1"
under_tires = [1]
launch_m_s = 6
[limits]
flight_height_m = 1
cable_safety_factor = 2
[[delay]]
name = "a"
interval_ms = 20
"#;

/// Every key, with the names of the sections around it.
fn all_keys(section: &'static Section, path: &[&'static str]) -> Vec<(Vec<&'static str>, &'static Key)> {
    let mut all = Vec::new();
    for key in section.keys {
        all.push((path.to_vec(), *key));
        if let Some(inner) = key.kind.section() {
            all.extend(all_keys(inner, &[path, &[key.name]].concat()));
        }
    }
    all
}

/// The plan with `key = value` in the first section at `path`; `None` where it has no such section.
fn with(text: &str, path: &[&str], key: &str, value: &str) -> Option<String> {
    let mut document: DocumentMut = text.parse().expect("TOML");
    let mut table: &mut dyn TableLike = document.as_table_mut();
    for name in path {
        table = match table.get_mut(name)? {
            Item::ArrayOfTables(tables) => tables.get_mut(0)?,
            Item::Value(toml_edit::Value::Array(list)) => list.get_mut(0)?.as_inline_table_mut()?,
            item => item.as_table_like_mut()?,
        };
    }
    if key == "free_flight_height_m" {
        table.remove("launch_m_s");
    }
    table.insert(key, toml_edit::value(value.parse::<toml_edit::Value>().expect("a value")));
    Some(document.to_string())
}

/// Mistakes in each of the plans above that has the section, after `key = value` is put into it.
fn mistakes(path: &[&str], key: &str, value: &str) -> Vec<String> {
    let told = |plan: &str| {
        let text = with(plan, path, key, value)?;
        Some(Plan::parse("plan.toml", &text).err().map_or_else(String::new, |told| told.render(false)))
    };
    [GOOD, HOLES, LIST].into_iter().filter_map(told).collect()
}

fn example(key: &Key) -> String {
    match key.kind {
        Kind::Section(_) => "{}".to_owned(),
        Kind::Sections(_) if !key.example.starts_with('[') => "[]".to_owned(),
        _ => key.example.to_owned(),
    }
}

#[test]
fn the_reader_reads_every_key() {
    let keys = all_keys(&plan::SECTION, &[]);
    assert!(keys.len() > 60, "{}", keys.len());
    for (path, key) in keys {
        let told = mistakes(&path, key.name, &example(key));
        let unknown = format!("has no key `{}`", key.name);
        assert!(told.iter().any(|told| !told.contains(&unknown)), "{path:?} {}: {told:?}", key.name);
    }
}

#[test]
fn examples_are_in_range_and_values_out_of_range_are_refused() {
    for (path, key) in all_keys(&plan::SECTION, &[]) {
        let high = match key.kind {
            Kind::Whole(_) => (*key.kind.whole_range().end() as f64 + 1.0).to_string(),
            Kind::Number { .. } | Kind::NumberOrSection(..) => format!("{:?}", key.kind.range().end() * 2.0),
            Kind::List(Kind::Number { .. }) => format!("[{:?}]", key.kind.range().end() * 2.0),
            Kind::Range(_) => format!("[0, {:?}]", key.kind.range().end() * 2.0),
            Kind::Choice(_) | Kind::List(Kind::Choice(_)) => {
                let example = example(key);
                let told = mistakes(&path, key.name, &example.replacen('"', "\"no ", 1));
                assert!(told.iter().any(|told| told.contains("cannot be \"no ")), "{}: {told:?}", key.name);
                continue;
            }
            _ => continue,
        };
        let wrong = |told: &&String| {
            [" is above ", " must be from "].iter().any(|why| told.contains(&format!("`{}`{why}", key.name)))
        };
        let told = mistakes(&path, key.name, &high);
        assert!(told.iter().any(|told| wrong(&told)), "{path:?} {} = {high}: {told:?}", key.name);
        let told = mistakes(&path, key.name, &example(key));
        assert!(!told.iter().any(|told| wrong(&told)), "{path:?} {} = {}: {told:?}", key.name, key.example);
    }
}

/// A file of the sources against the text that the table of keys makes of it; `INSTA_UPDATE=always` writes that text.
fn assert_made_of_the_table(file: &str, made: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    if std::env::var("INSTA_UPDATE").is_ok_and(|wanted| wanted == "always") {
        fs::write(&path, made).expect("written");
    }
    let found = fs::read_to_string(&path).expect("the file is readable");
    assert_eq!(found, made, "{file}: write it with INSTA_UPDATE=always");
}

/// The fuzzer puts these words into plans, so that it reaches every effect.
#[test]
fn the_dictionary_of_the_fuzzer_has_every_key() {
    let quoted = |key: &Key| {
        let line = format!("{} = {}\n", key.name, example(key));
        // libFuzzer reads bytes: those beyond ASCII have their hexadecimal digits.
        let byte = |byte: u8| match byte {
            b'"' | b'\\' => format!("\\{}", char::from(byte)),
            b' '..=b'~' => char::from(byte).to_string(),
            _ => format!("\\x{byte:02X}"),
        };
        format!("\"{}\"\n", line.bytes().map(byte).collect::<String>())
    };
    let words: BTreeSet<String> = all_keys(&plan::SECTION, &[]).iter().map(|(_, key)| quoted(key)).collect();
    assert!(words.len() > 60, "{}", words.len());
    assert_made_of_the_table("fuzz/plan.dict", &words.into_iter().collect::<String>());
}

/// A dash between two numbers, but never before a minus sign.
fn range_words(range: &RangeInclusive<f64>) -> String {
    let between = if *range.start() < 0.0 { " to " } else { "–" };
    format!("{}{between}{}", range.start(), range.end())
}

/// What a value of a kind may be, in words.
fn value_words(kind: &Kind) -> String {
    let keys = |section: &Section| section.keys.iter().map(|key| key.name).collect::<Vec<_>>().join(", ");
    let quoted =
        |names: &[&str]| names.iter().map(|name| format!("`\"{name}\"`")).collect::<Vec<_>>().join(", ");
    match kind {
        Kind::Number { unit: "", range } => range_words(range),
        Kind::Number { unit, range } => format!("{unit}: {}", range_words(range)),
        Kind::ShelterRow(_) => "number of a shelter row".to_owned(),
        Kind::Whole(range) => format!("whole number, {}–{}", range.start(), range.end()),
        Kind::Text => "text".to_owned(),
        Kind::Choice(names) => quoted(names),
        Kind::Catalogue(_) => "name of `shelter ropes`".to_owned(),
        Kind::List(item) => format!("list of {}", value_words(item)),
        Kind::RowNames => "names of the blast rows".to_owned(),
        Kind::Range(number) => format!("`[least, greatest]` in {}", value_words(number)),
        Kind::Section(_) => "section".to_owned(),
        Kind::Sections(_) => "sections, any number".to_owned(),
        Kind::NumberOrSection(number, section) => {
            format!("{}; or a section with {}", value_words(number), keys(section))
        }
        Kind::ListOrSection(number, section) => {
            format!("list of {}; or a section with {}", value_words(number), keys(section))
        }
        Kind::Flag => "`true` or `false`".to_owned(),
    }
}

/// A table of the keys of one section, and of the sections in it. What a table above says of a key is not repeated.
fn section_tables(section: &'static Section, told: &mut BTreeSet<(&'static str, &'static str)>) -> String {
    let mut text = String::new();
    if told.insert((section.title, "")) {
        let title = section.title;
        let heading = if title.starts_with('[') { format!("`{title}`") } else { title.to_owned() };
        text += &format!("\n### {heading}\n\n| key | value | default | what it is |\n|---|---|---|---|\n");
        for key in section.keys {
            let default = match key.default {
                _ if key.required => "required".to_owned(),
                Some(DefaultValue::Number(number)) => number.to_string(),
                Some(DefaultValue::Name(name)) => format!("`{name}`"),
                Some(DefaultValue::Described(default)) => default.to_owned(),
                None => String::new(),
            };
            let is_new = key.doc.is_empty() || told.insert((key.name, key.doc));
            let doc = if is_new { key.doc } else { "as above" };
            text += &format!("| `{}` | {} | {default} | {doc} |\n", key.name, value_words(&key.kind));
        }
    }
    let inner = section.keys.iter().filter_map(|key| key.kind.section());
    inner.for_each(|inner| text += &section_tables(inner, told));
    text
}

#[test]
fn the_reference_ends_with_every_key() {
    const HEADING: &str = "\n## Every key\n";
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/plan-keys.md"))
        .expect("readable");
    let before = page.split(HEADING).next().expect("a page");
    let about = "\nThis list is made from the table by which the program reads a plan.\n";
    let tables = section_tables(&plan::SECTION, &mut BTreeSet::new());
    assert!(tables.matches("\n| `").count() > 60, "{tables}");
    assert_made_of_the_table("docs/plan-keys.md", &[before, HEADING, about, &tables].concat());
}

#[test]
fn a_default_is_a_right_value() {
    for (_, key) in all_keys(&plan::SECTION, &[]) {
        match key.default {
            Some(DefaultValue::Number(number)) if matches!(key.kind, Kind::Whole(_)) => {
                assert!(key.kind.whole_range().contains(&(number as usize)), "{}", key.name);
            }
            Some(DefaultValue::Number(number)) => {
                assert!(key.kind.range().contains(&number), "{}", key.name)
            }
            Some(DefaultValue::Name(name)) => assert!(key.kind.names().contains(&name), "{}", key.name),
            Some(DefaultValue::Described(_)) | None => {}
        }
    }
}

/// Names of all properties of a schema, with the names of the sections around them.
fn properties(schema: &Value, path: &str, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(object) => {
            for (name, inner) in object {
                if name != "properties" {
                    properties(inner, path, found);
                    continue;
                }
                for (key, inner) in inner.as_object().expect("properties are named") {
                    let path = format!("{path}/{key}");
                    properties(inner, &path, found);
                    found.insert(path);
                }
            }
        }
        Value::Array(list) => list.iter().for_each(|inner| properties(inner, path, found)),
        _ => {}
    }
}

#[test]
fn the_schema_has_the_very_keys_of_the_table() {
    let mut found = BTreeSet::new();
    properties(&schema(), "", &mut found);
    let keys = all_keys(&plan::SECTION, &[]);
    let expected: BTreeSet<String> = keys
        .iter()
        .map(|(path, key)| path.iter().map(|name| format!("/{name}")).collect::<String>() + "/" + key.name)
        .collect();
    assert_eq!(found, expected);
}

#[test]
fn the_editor_shows_every_key_that_has_a_label() {
    for (path, key) in all_keys(&plan::SECTION, &[]) {
        let [section] = path[..] else { continue };
        let shown = [GOOD, HOLES, LIST].iter().any(|text| {
            with(text, &path, key.name, &example(key)).is_some_and(|text| {
                fields(&text)
                    .iter()
                    .any(|field| field.path.section == section && field.path.key.name == key.name)
            })
        });
        assert_eq!(shown, key.edit.is_some(), "[{section}] {}", key.name);
    }
}

/// Bytes elsewhere stay when a value is put in place of itself.
#[test]
fn a_value_replaced_by_itself_changes_nothing() {
    for name in ["amur-three-rows.toml", "paper-5-tire.toml"] {
        let path = format!("{}/plans/{name}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("a shipped plan");
        for field in fields(&text).iter().filter(|field| !field.value.is_empty()) {
            assert_eq!(set(&text, &field.path, &field.value).as_ref(), Ok(&text), "{}", field.title());
        }
    }
}

#[test]
fn the_plan_of_the_reference_has_only_keys_of_the_table() {
    let reference = include_str!("../../docs/plan-keys.md");
    let known: BTreeSet<String> = all_keys(&plan::SECTION, &[])
        .into_iter()
        .map(|(path, key)| path.iter().chain([&key.name]).copied().collect::<Vec<_>>().join("."))
        .collect();
    let listing =
        reference.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a plan");
    let document: DocumentMut = listing.parse().expect("TOML");
    let mut checked = 0;
    for (section, item) in document.iter() {
        let tables: Vec<&dyn TableLike> = match item {
            Item::ArrayOfTables(tables) => tables.iter().map(|table| table as _).collect(),
            item => item.as_table_like().into_iter().collect(),
        };
        assert!(known.contains(section), "{section}");
        for (key, _) in tables.iter().flat_map(|table| table.iter()) {
            assert!(known.contains(&format!("{section}.{key}")), "[{section}] {key}");
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked}");
}
