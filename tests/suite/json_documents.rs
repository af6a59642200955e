//! Which names the JSON documents have, and that every study tells scripts what it tells people: a name that goes is seen here.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::slice;

use itertools::Itertools;
use serde_json::Value;
use shelter::report;
use shelter::report::answer::answer;
use shelter::report::parts::Report;
use shelter::study::FileState;
use shelter::study::observed::{Comparison, NotCompared};
use shelter::study::question::Found;
use shelter::study::standing::Standing;

use crate::support::stage::{finished, spreads, swept};
use crate::support::{json, shelter};

const PLAN: &str = r#"
shelter = { layout = "grid", rows = 2, columns = 3, spacing_m = 1.5 }
tire = { mass_kg = 280 }
cable = { rope = "GOST 2688-80 6.2" }
ground = { friction = 0.5 }
blast_row = [
    { name = "1", under_row = 1, launch_m_s = 4.5, charge_kg = 4 },
    { name = "2", under_row = 2, launch_m_s = 4.5, charge_kg = 4 },
]
limits = { flight_height_m = 1.2, cable_safety_factor = 1.5, drift_m = 3, withstands_one_dud = true }
delay = [{ name = "20 ms", interval_ms = 20 }, { name = "long", at_ms = [0, 300] }]
search = { intervals_ms = [9, 25] }
"#;

/// Every name below `value`, with its path; of the objects of a list all.
fn names(value: &Value, path: &str, all: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                let path = format!("{path}.{name}");
                names(value, &path, all);
                all.insert(path);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| names(value, &format!("{path}[]"), all)),
        _ => {}
    }
}

#[test]
fn documents_keep_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path.to_str().expect("UTF-8").to_owned()
    };
    let path = folder.path().to_string_lossy();
    let plan = file("plan.toml", PLAN);
    let failing = file("failing.toml", &PLAN.replace("flight_height_m = 1.2", "flight_height_m = 0.8"));
    let seen = "option,tire,cable,quantity,at_s,value,sd\n20 ms,1:1,,flight_height_m,,0.9,0.05\n\
                20 ms,1:2,,height_m,0.3,0.5,0.1\n20 ms,,1:1-1:2,cable_force_n,,3000,2000\n";
    let seen = file("seen.csv", seen);
    let commands: [&[&str]; _] = [
        &["check", &plan, "--samples", "220"],
        &["check", &failing, "--why", "--nominal"],
        &["sweep", &plan, "--interval", "0..40:20", "--samples", "30"],
        &["orders", &plan, "--samples", "30"],
        &["risk", &plan, "--samples", "220"],
        &["search", &plan, "--samples", "30"],
        &["effects", &plan, "--samples", "5"],
        &["assumptions", &plan, "--nominal"],
        &["size", &plan, "--nominal"],
        &["size", &failing, "--nominal", "--ropes", "GOST 2688-80"],
        &["fit", &plan, "--samples", "60", "--observed", &seen],
        &["fit", &plan, "--samples", "60", "--next"],
        &[
            "launch",
            &plan,
            "--samples",
            "60",
            "--test-height",
            "1.2",
            "--hole-diameter",
            "105",
            "--stemming",
            "3",
        ],
        &["launch", &plan, "--samples", "60", "--observed", &seen],
        &["accuracy", &plan],
        &["ropes"],
        &["trace", &plan, "--every", "500"],
    ];
    let mut told = String::new();
    for command in commands {
        let draft: &[&str] =
            if matches!(command[0], "accuracy" | "ropes") { &[] } else { &["--accuracy", "draft"] };
        let document = json(&shelter(&[command, draft, &["--format", "json"]].concat()));
        let mut all = BTreeSet::new();
        names(&document, "", &mut all);
        let schema = document["schema"].as_str().expect("a schema");
        writeln!(
            told,
            "{schema} of {}:",
            command.iter().filter(|argument| !argument.contains(&*path)).join(" ")
        )
        .expect("text");
        all.iter().for_each(|name| writeln!(told, "  {name}").expect("text"));
    }
    insta::assert_snapshot!(told);
}

/// What a study recommends has no value where what was seen speaks against its plan, and no face words it.
#[test]
fn nothing_is_recommended_where_no_pass_stands() {
    let app = finished();
    let [stands, held] = [Comparison::nothing_seen(), Comparison::not_compared(NotCompared::OutOfTime)]
        .map(|compared| Standing::of(&app.case, FileState::AsJudged, compared));
    let mut studies: Vec<Found> = spreads(&app).into_iter().map(|(_, found)| found).collect();
    studies.push(swept(&app.case));
    for found in studies {
        let document = |report: &Report| -> Value {
            let text = report::json::json(slice::from_ref(report)).expect("a document");
            serde_json::from_str(&text).expect("JSON")
        };
        let words = |report: &Report| report::text::text(report, report::text::Style::default());
        let [stands, held] = [&stands, &held].map(|standing| answer(&app.case, standing, &found));
        let keys = [
            "recommended_s",
            "recommended_room_s",
            "windows_s",
            "nominal_windows_s",
            "found",
            "rope",
            "frontier",
        ];
        let of = document(&stands);
        let recommended = keys.iter().filter(|key| !of[**key].is_null());
        let told = document(&held);
        recommended.for_each(|key| assert!(told[*key].is_null(), "{key}: {told}"));
        assert!(
            words(&held).contains("not compared with this plan")
                && !words(&stands).contains("not compared with this plan")
        );
        for word in ["recommended", "lightest", "PASS"] {
            assert!(!words(&held).contains(word), "{word}: {}", words(&held));
        }
    }
}
