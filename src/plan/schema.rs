//! The keys of a plan as a JSON Schema, for editors that complete and check while the user types.
//!
//! The schema checks less than the reader: only the reader checks names of rows, positions and sums.

use serde_json::{Map, Value, json};

use super::keys::{DefaultValue, Key, Kind, Section, plan};

/// The schema (draft 2020-12).
pub fn schema() -> Value {
    let mut schema = object(&plan::SECTION);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("Plan of shelter");
    schema
}

fn object(section: &Section) -> Value {
    let properties: Map<String, Value> =
        section.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> = section.keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    json!({
        "type": "object",
        "description": section.doc,
        "required": required,
        "properties": properties,
        "additionalProperties": false,
    })
}

fn property(key: &Key) -> Value {
    let mut schema = value(&key.kind);
    let mut description = key.doc.to_owned();
    if !key.kind.unit().is_empty() {
        description = format!("{description} [{}]", key.kind.unit()).trim_start().to_owned();
    }
    match key.default {
        Some(DefaultValue::Number(number)) if matches!(key.kind, Kind::Whole(_)) => {
            schema["default"] = json!(number as usize);
        }
        Some(DefaultValue::Number(number)) => schema["default"] = json!(number),
        Some(DefaultValue::Name(name)) if matches!(key.kind, Kind::Flag) => {
            schema["default"] = json!(name == "true");
        }
        Some(DefaultValue::Name(name)) => schema["default"] = json!(name),
        Some(DefaultValue::Described(default)) => description += &format!("; default: {default}"),
        None => {}
    }
    if !description.is_empty() {
        schema["description"] = json!(description);
    }
    schema
}

fn value(kind: &Kind) -> Value {
    match kind {
        Kind::Number { .. } | Kind::ShelterRow(_) => {
            let range = kind.range();
            json!({ "type": "number", "minimum": range.start(), "maximum": range.end() })
        }
        Kind::Whole(range) => json!({ "type": "integer", "minimum": range.start(), "maximum": range.end() }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Choice(_) | Kind::Catalogue(_) => json!({ "enum": kind.names() }),
        Kind::RowNames => json!({ "type": "array", "items": value(&Kind::Text) }),
        Kind::List(item) => json!({ "type": "array", "items": value(item) }),
        Kind::Range(number) => {
            let ends = json!({ "type": "array", "items": value(number), "minItems": 2, "maxItems": 2 });
            // A 0 means the same as two ends at the plan's own value.
            json!({ "oneOf": [ends, { "enum": [0] }] })
        }
        Kind::Section(section) => object(section),
        Kind::Sections(section) => json!({ "type": "array", "items": object(section) }),
        Kind::NumberOrSection(number, section) => json!({ "oneOf": [value(number), object(section)] }),
        Kind::ListOrSection(number, section) => {
            json!({ "oneOf": [value(&Kind::List(number)), object(section)] })
        }
        Kind::Flag => json!({ "type": "boolean" }),
    }
}
