//! The keys of a plan as a JSON Schema, for editors that complete and check as one types.
//!
//! It says less than the reader does: names of rows, places and sums are checked there alone.

use std::ops::RangeInclusive;

use serde_json::{Map, Value, json};

use super::range;
use crate::choice::{Accuracy, Method};
use crate::ropes::catalogue;

/// The schema (draft 2020-12).
pub fn schema() -> Value {
    let mut schema = table(
        "A blast row, the shelter over it, and the delay options to choose from",
        &["shelter", "tire", "cable", "ground", "blast_row", "limits", "delay"],
        [
            ("title", json!({ "type": "string" })),
            ("shelter", shelter()),
            ("tire", tire()),
            ("cable", cable()),
            ("ground", ground()),
            ("blast_row", list(blast_row(), "in the order listed")),
            ("limits", limits()),
            ("delay", list(delay(), "options to compare")),
            ("simulation", simulation()),
            ("scatter", scatter()),
            ("size", size()),
        ],
    );
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("Plan of shelter");
    schema
}

fn shelter() -> Value {
    let spacing = number(range::SPACING_M, "centre to centre [m]");
    let link = json!({ "enum": ["row", "column", "diagonal"] });
    let listed_tire = table(
        "one tire",
        &["x_m", "y_m"],
        [
            ("x_m", number(range::PLACE_M, "[m]")),
            ("y_m", number(range::PLACE_M, "[m]")),
            ("mass_kg", number(range::MASS_KG, "instead of that of [tire]")),
        ],
    );
    let listed_cable = table("one cable", &["from", "to"], [("from", tire_number()), ("to", tire_number())]);
    table(
        "tires and the ties between them",
        &["layout"],
        [
            ("layout", json!({ "enum": ["grid", "quincunx", "list"] })),
            ("rows", whole(1..=range::MOST_TIRES, "along y, numbered from 1")),
            ("columns", whole(1..=range::MOST_TIRES, "along x, numbered from 1")),
            ("border_rows", whole(range::BORDER_ROWS, "rows of ballast laid around the mesh, over no hole")),
            (
                "spacing_m",
                json!({ "oneOf": [spacing.clone(), table("between rows, between columns [m]", &["row", "column"], [("row", spacing.clone()), ("column", spacing)])] }),
            ),
            ("links", json!({ "type": "array", "items": link, "description": "which neighbours are tied" })),
            ("tire", list(listed_tire, "of a list")),
            ("cable", list(listed_cable, "of a list")),
        ],
    )
}

fn tire() -> Value {
    table(
        "the tire at every place",
        &["mass_kg"],
        [
            ("mass_kg", number(range::MASS_KG, "[kg]")),
            (
                "outer_diameter_m",
                number(range::DIAMETER_M, "cables run from rim to rim; 0: from centre to centre [m]"),
            ),
        ],
    )
}

fn cable() -> Value {
    let ropes: Vec<&str> = catalogue().ropes.iter().map(|rope| rope.name.as_str()).collect();
    let terminations: Vec<&str> = catalogue().terminations.iter().map(|known| known.name.as_str()).collect();
    table(
        "the rope of every tie: from the catalogue, or stiffness and breaking force",
        &[],
        [
            ("rope", json!({ "enum": ropes })),
            ("axial_stiffness_kn", number(range::CABLE_KN, "EA [kN]")),
            ("breaking_force_kn", number(range::CABLE_KN, "[kN]")),
            ("slack_percent", number(range::SLACK_PERCENT, "length over distance [%]")),
            ("termination", json!({ "enum": terminations })),
            (
                "termination_percent",
                number(range::TERMINATION_PERCENT, "what it leaves of the breaking force [%]"),
            ),
            ("on_overload", json!({ "enum": ["report", "break"] })),
        ],
    )
}

fn ground() -> Value {
    table("", &["friction"], [("friction", number(range::FRICTION, "of a tire on the ground"))])
}

fn blast_row() -> Value {
    let launch = number(range::LAUNCH_M_S, "launch velocity of the tires [m/s]");
    let hole = table(
        "one hole; it launches the nearest tire",
        &["x_m", "y_m", "launch_m_s"],
        [
            ("x_m", number(range::PLACE_M, "[m]")),
            ("y_m", number(range::PLACE_M, "[m]")),
            ("launch_m_s", launch.clone()),
        ],
    );
    table(
        "holes that fire together",
        &["name"],
        [
            ("name", json!({ "type": "string" })),
            ("under_row", number(range::ROW, "launches every tire of this shelter row")),
            ("under_tires", list(tire_number(), "launches these tires")),
            ("holes", list(hole, "one by one")),
            ("launch_m_s", launch),
            ("free_flight_height_m", number(range::FREE_FLIGHT_M, "seen on a loose test tire [m]")),
        ],
    )
}

fn limits() -> Value {
    table(
        "what an option must keep to pass",
        &["flight_height_m", "cable_safety_factor"],
        [
            ("flight_height_m", number(range::LIMIT_M, "[m]")),
            ("cable_safety_factor", number(range::SAFETY_FACTOR, "breaking force / greatest force")),
            ("drift_m", number(range::LIMIT_M, "greatest horizontal shift of any tire at the end [m]")),
        ],
    )
}

fn delay() -> Value {
    table(
        "one delay option",
        &["name"],
        [
            ("name", json!({ "type": "string" })),
            ("interval_ms", number(range::TIME_MS, "between successive blast rows [ms]")),
            ("order", list(json!({ "type": "string" }), "names of the blast rows as they fire")),
            (
                "at_ms",
                list(number(range::TIME_MS, "[ms]"), "firing time of each blast row, in the order listed"),
            ),
        ],
    )
}

fn simulation() -> Value {
    table(
        "how to compute",
        &[],
        [
            ("duration_s", number(range::DURATION_S, "default: until every tire is at rest [s]")),
            ("accuracy", json!({ "enum": Accuracy::NAMES })),
            ("method", json!({ "enum": Method::NAMES })),
            ("gravity_m_s2", number(range::GRAVITY_M_S2, "[m/s²]")),
        ],
    )
}

fn scatter() -> Value {
    table(
        "what scatters from shot to shot",
        &[],
        [
            ("detonator", json!({ "enum": ["electronic", "pyrotechnic", "pyrotechnic surface"] })),
            ("delay_sd_ms", number(range::SCATTER_MS, "standard deviation of firing times [ms]")),
            ("delay_cv_percent", number(range::SCATTER_PERCENT, "standard deviation over delay [%]")),
            ("launch_cv_percent", number(range::SCATTER_PERCENT, "of launch velocities, lognormal [%]")),
            ("friction", list(number(range::FRICTION, "from, to"), "anything between")),
        ],
    )
}

fn size() -> Value {
    table(
        "what `shelter size` may choose from",
        &[],
        [
            ("ropes", json!({ "enum": catalogue().families() })),
            ("tire_mass_kg", list(number(range::MASS_KG, "[kg]"), "masses of tires at hand")),
            ("most_border_rows", whole(range::SIZED_BORDER_ROWS, "rows of ballast")),
        ],
    )
}

/// Of a list layout.
fn tire_number() -> Value {
    json!({ "type": "integer", "minimum": 1 })
}

fn whole(range: RangeInclusive<usize>, words: &str) -> Value {
    json!({ "type": "integer", "minimum": range.start(), "maximum": range.end(), "description": words })
}

fn number(range: RangeInclusive<f64>, words: &str) -> Value {
    json!({ "type": "number", "minimum": range.start(), "maximum": range.end(), "description": words })
}

fn list(items: Value, words: &str) -> Value {
    json!({ "type": "array", "items": items, "description": words })
}

fn table<const N: usize>(words: &str, required: &[&str], keys: [(&str, Value); N]) -> Value {
    let properties: Map<String, Value> =
        keys.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
    json!({
        "type": "object",
        "description": words,
        "required": required,
        "properties": properties,
        "additionalProperties": false,
    })
}
