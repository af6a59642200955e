//! The schema for editors against the reader: it never refuses a plan that the reader takes.

use shelter::plan::Plan;
use shelter::plan::schema::schema;

use super::bad_plans::{BAD, GOOD};
use super::support::json_schema::errors;
use super::support::shipped_plans;

fn value(text: &str) -> Option<serde_json::Value> {
    toml::from_str::<toml::Table>(text).ok().and_then(|table| serde_json::to_value(table).ok())
}

#[test]
fn shipped_plans_are_valid() {
    let schema = schema();
    let plans = shipped_plans();
    assert_eq!(plans.len(), 4);
    for path in plans {
        let text = std::fs::read_to_string(&path).expect("a plan");
        let told = errors(&schema, &value(&text).expect("TOML"));
        assert!(told.is_empty(), "{}: {told:?}", path.display());
    }
}

/// Of the wrong plans that are TOML, it finds at least two thirds: it knows keys, types and ranges, but nothing of what stands
/// elsewhere in the plan.
#[test]
fn wrong_plans_are_mostly_found_and_right_ones_never_refused() {
    let schema = schema();
    let (mut all, mut found) = (0, 0);
    for (good, bad) in BAD {
        let text = GOOD.replacen(good, bad, 1);
        let Some(value) = value(&text) else { continue };
        all += 1;
        found += usize::from(!errors(&schema, &value).is_empty());
    }
    assert!(3 * found >= 2 * all, "{found} of {all}");
    for (good, other) in [
        ("spacing_m = 1.5", "spacing_m = { row = 1.5, column = 2 }"),
        ("spacing_m = 1.5", "spacing_m = 2\nlinks = []"),
        ("interval_ms = 20", "at_ms = [0, 20.5]"),
        ("interval_ms = 20", "interval_ms = 20\n[size]\ntire_mass_kg = []"),
        ("launch_m_s = 6.0", "free_flight_height_m = 1"),
    ] {
        let text = GOOD.replacen(good, other, 1);
        assert!(Plan::parse("plan.toml", &text).is_ok(), "{other}");
        assert_eq!(errors(&schema, &value(&text).expect("TOML")), [""; 0], "{other}");
    }
}
