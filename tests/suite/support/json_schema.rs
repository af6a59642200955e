//! A validator for the part of JSON Schema (draft 2020-12) that the schema of a plan uses. Any other keyword is a panic, so that none
//! is passed over.

use serde_json::{Map, Value};

/// What speaks against `value`, each with its place in the document; nothing where the schema allows it.
pub fn errors(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, value, "", &mut found);
    found
}

fn check(schema: &Value, value: &Value, place: &str, found: &mut Vec<String>) {
    let schema = schema.as_object().expect("a schema is an object");
    for (keyword, argument) in schema {
        let holds = match keyword.as_str() {
            "$schema" | "title" | "description" | "default" => true,
            "type" => is_of_type(value, argument.as_str().expect("the name of a type")),
            "enum" => argument.as_array().expect("values").contains(value),
            "minimum" => value.as_f64().is_none_or(|number| number >= number_of(argument)),
            "maximum" => value.as_f64().is_none_or(|number| number <= number_of(argument)),
            "minItems" => value.as_array().is_none_or(|items| items.len() as f64 >= number_of(argument)),
            "maxItems" => value.as_array().is_none_or(|items| items.len() as f64 <= number_of(argument)),
            "required" => {
                let names = argument.as_array().expect("names").iter().filter_map(Value::as_str);
                value.as_object().is_none_or(|object| names.into_iter().all(|name| object.contains_key(name)))
            }
            "oneOf" => {
                let schemas = argument.as_array().expect("schemas").iter();
                schemas.filter(|schema| errors(schema, value).is_empty()).count() == 1
            }
            "items" => {
                for (n, item) in value.as_array().into_iter().flatten().enumerate() {
                    check(argument, item, &format!("{place}/{n}"), found);
                }
                true
            }
            "properties" => {
                let properties = argument.as_object().expect("properties");
                for (name, property) in value.as_object().into_iter().flatten() {
                    if let Some(schema) = properties.get(name) {
                        check(schema, property, &format!("{place}/{name}"), found);
                    }
                }
                true
            }
            "additionalProperties" => {
                assert_eq!(argument, &Value::Bool(false), "the one form that is understood");
                value.as_object().is_none_or(|object| object.keys().all(|name| has_property(schema, name)))
            }
            other => panic!("{place}: the keyword '{other}' is not understood"),
        };
        if !holds {
            found.push(format!("{place}: {value} is not as {keyword} {argument} asks"));
        }
    }
}

fn number_of(argument: &Value) -> f64 {
    argument.as_f64().expect("a number")
}

fn has_property(schema: &Map<String, Value>, name: &str) -> bool {
    schema.get("properties").is_some_and(|properties| properties.get(name).is_some())
}

fn is_of_type(value: &Value, name: &str) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        other => panic!("there is no type '{other}'"),
    }
}

#[test]
fn each_keyword_is_checked() {
    use serde_json::json;
    let section = json!({
        "type": "object",
        "required": ["a"],
        "properties": {
            "a": { "type": "number", "minimum": 1, "maximum": 2 },
            "b": { "oneOf": [{ "type": "integer" }, { "type": "number", "minimum": 5 }] },
            "c": { "type": "array", "items": { "enum": ["x", "y"] }, "minItems": 1, "maxItems": 2 },
        },
        "additionalProperties": false,
    });
    let is_valid = |value: Value| errors(&section, &value).is_empty();
    assert!(is_valid(json!({ "a": 1.5, "b": 3, "c": ["x", "y"] })));
    for wrong in [
        json!([]),
        json!({}),
        json!({ "a": "1" }),
        json!({ "a": 0.5 }),
        json!({ "a": 2.5 }),
        json!({ "a": 1, "b": 4.5 }),
        json!({ "a": 1, "b": 6 }),
        json!({ "a": 1, "c": ["z"] }),
        json!({ "a": 1, "c": [] }),
        json!({ "a": 1, "c": ["x", "x", "x"] }),
        json!({ "a": 1, "d": 1 }),
    ] {
        assert!(!is_valid(wrong.clone()), "{wrong}");
    }
}
