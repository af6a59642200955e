//! `sweep`, `orders`, `risk`, `size` and `merge` as scripts use them.

use std::path::Path;
use std::process::{Command, Output};

use super::support::{self, Edited, shelter, small_plan_in, tested_plan};
use serde_json::Value;
use shelter::Case;
use shelter::study::observed::{ObservationRecord, record_file};

/// The document that a command prints, with nothing but warnings on standard error.
fn json(arguments: &[&str]) -> Value {
    let output = shelter(arguments);
    let told = support::text(&output.stderr);
    assert!(told.lines().all(|line| line.starts_with("warning: ")), "{told}");
    support::json(&output)
}

/// A plan of three options as `plan.toml` in a folder: its path.
fn plan_of_three_in(folder: &Path) -> String {
    let file = folder.join("plan.toml");
    std::fs::write(&file, support::small_plan_of(&["all at once", "42 ms"])).expect("written");
    file.to_str().expect("UTF-8").to_owned()
}

#[test]
fn sweep_has_the_fields_scripts_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = small_plan_in(folder.path());
    let arguments = ["sweep", &plan, "--nominal", "--interval", "60..120:10", "--accuracy", "draft"];
    let document = json(&[&arguments[..], &["--format", "json"]].concat());
    let points = document["points"].as_array().expect("points");
    assert!(points.len() >= 7);
    for key in ["interval_s", "flight_height_m", "cable_force_n"] {
        assert!(points[0][key].is_number(), "{key}");
        assert!(document["worst"][key].is_number(), "{key}");
    }
    let passing = |point: &&Value| point["verdict"] == "pass";
    assert_eq!(
        document["windows_s"].as_array().expect("windows").is_empty(),
        !points.iter().any(|p| passing(&p))
    );
    let csv = shelter(&[&arguments[..], &["--format", "csv"]].concat());
    assert_eq!(String::from_utf8_lossy(&csv.stdout).lines().count(), points.len() + 1);
    let is_recommended = document["recommended_s"].is_number();
    assert_eq!(csv.status.code(), Some(if is_recommended { 0 } else { 1 }));
}

/// The last line says what the exit status says; the windows that pass have a line of their own.
#[test]
fn text_and_exit_status_of_a_sweep_agree() {
    let plan = tested_plan("amur-three-rows.toml");
    for (range, status, verdict) in
        [("60..60:5", 1, "OPEN, slide NOT checked: "), ("55..60:5", 0, "PASS, slide NOT checked: ")]
    {
        let output = shelter(&["sweep", &plan, "--nominal", "--interval", range, "--accuracy", "draft"]);
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(status), "{text}");
        assert!(text.lines().last().is_some_and(|line| line.starts_with(verdict)), "{text}");
        assert!(text.lines().any(|line| line.starts_with("windows that pass: ")), "{text}");
    }
}

/// The estimate of a long study's duration is progress: scripts do not get it on standard error.
#[test]
fn the_estimated_duration_is_for_terminals() {
    let plan = tested_plan("amur-three-rows.toml");
    let long =
        ["sweep", &plan, "--dt", "1e-5", "--interval", "0..500:0.1", "--threads", "1", "--timeout", "2.5"];
    let output = shelter(&long);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.lines().skip(1).all(|line| line.starts_with("warning: ")), "{told}");
    let done = told.strip_prefix("the time was up with ").and_then(|told| told.split(' ').next());
    let percent: f64 = done.and_then(|done| done.parse().ok()).unwrap_or_else(|| panic!("{told}"));
    assert!(percent < 50.0, "what was left out counts as done: {told}");
}

#[test]
fn shards_merge_into_the_whole_byte_for_byte() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = plan_of_three_in(folder.path());
    let orders: &[&str] = &["orders", &plan, "--accuracy", "draft", "--nominal"];
    let sampled: &[&str] = &["orders", &plan, "--accuracy", "draft", "--samples", "60", "--seed", "3"];
    let risk: &[&str] = &["risk", &plan, "--accuracy", "draft", "--samples", "31", "--seed", "4"];
    let fixed: &[&str] = &["risk", &plan, "--dt", "2e-3", "--samples", "10", "--seed", "4"];
    let search: &[&str] = &["search", &plan, "--accuracy", "draft", "--nominal"];
    let searched: &[&str] = &["search", &plan, "--accuracy", "draft", "--samples", "10", "--seed", "5"];
    // Each format is an unbroken run of its own: all of them of the quick commands.
    let every = &["json", "csv", "text"][..];
    for (command, formats) in [
        (orders, every),
        (sampled, &["json"]),
        (risk, every),
        (fixed, &["text"]),
        (search, every),
        (searched, &["json"]),
    ] {
        let whole = |format: &&'static str| {
            (*format, shelter(&[command, &["--format", format, "--threads", "1"]].concat()))
        };
        let wholes: Vec<(&str, Output)> = formats.iter().map(whole).collect();
        for of in [1, 3] {
            let shard = |index: i32| {
                let file = folder
                    .path()
                    .join(format!("{}-{index}-{of}", command.join("-").replace(['/', '\\', ':'], "")));
                let file = file.to_str().expect("UTF-8").to_owned();
                let shard = shelter(&[command, &["--shard", &format!("{index}/{of}"), "-o", &file]].concat());
                assert_eq!((shard.status.code(), shard.stdout.len()), (Some(0), 0));
                file
            };
            let files: Vec<String> = (1..=of).rev().map(shard).collect();
            let files: Vec<&str> = files.iter().map(String::as_str).collect();
            for (format, whole) in &wholes {
                let merged = shelter(&[&["merge", "--format", format], &files[..]].concat());
                assert_eq!(merged.stdout, whole.stdout, "{format} of {of}");
                assert_eq!(merged.status.code(), whole.status.code());
                let [told, told_of_whole] = [merged, whole.clone()].map(|output| {
                    let told = String::from_utf8_lossy(&output.stderr).into_owned();
                    assert_eq!(told.contains("computed at a step that somebody fixed"), command == fixed);
                    told
                });
                assert_eq!(told, told_of_whole);
            }
            if of > 1 {
                let missing = shelter(&[&["merge"], &files[1..]].concat());
                assert_eq!(missing.status.code(), Some(2));
                assert!(String::from_utf8_lossy(&missing.stderr).contains("is missing"));
            }
        }
    }
}

/// What was told of earlier shots beside the plan counts when shards are joined, too; where nobody can look at it, no pass stands.
#[test]
fn merged_shards_are_compared_with_what_was_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    let safe = support::small_plan()
        .edited("launch_m_s = 6.0", "launch_m_s = 1.0")
        .edited("accepted_risk_percent = 1 ", "accepted_risk_percent = 5 ");
    std::fs::write(&plan, safe).expect("written");
    let run = |folder: &Path, arguments: &[&str]| {
        Command::new(support::PROGRAM).args(arguments).current_dir(folder).output().expect("it runs")
    };
    let risk = ["risk", "plan.toml", "--samples", "250", "--accuracy", "draft"];
    let saved = run(folder.path(), &[&risk[..], &["--shard", "1/1", "-o", "shard.jsonl"]].concat());
    assert_eq!(saved.status.code(), Some(0), "{}", support::text(&saved.stderr));
    let shard = folder.path().join("shard.jsonl");
    let merge = |folder: &Path| {
        let merged = run(folder, &["merge", shard.to_str().expect("UTF-8")]);
        let told = support::text(&merged.stdout).to_owned() + support::text(&merged.stderr);
        (merged.status.code(), told)
    };
    let case = Case::load(&plan).expect("a plan");
    let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
    let (passes, _) = merge(folder.path());
    assert_eq!(passes, Some(0), "a test that can fail");
    for (line, against) in [("3:1 0.05 0.05", None), ("3:1 9.5 0.05", Some("over the limit of"))] {
        let mut seen = ObservationRecord::default();
        assert_eq!(seen.add_line(&case, option, line), Ok(()));
        record_file::save(&plan, &seen).expect("written");
        let (status, told) = merge(folder.path());
        assert_eq!(status, Some(i32::from(against.is_some())), "{told}");
        assert!(against.is_none_or(|against| told.contains(against)), "{told}");
        let whole = run(folder.path(), &risk);
        assert!(told.contains(support::text(&whole.stdout)), "{told}");
    }
    let elsewhere = tempfile::tempdir().expect("a folder");
    let (status, told) = merge(elsewhere.path());
    assert_eq!(status, Some(1), "{told}");
    assert!(told.contains("lie beside the plan, which is not here"), "{told}");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = plan_of_three_in(folder.path());
    for command in [
        &["risk", &plan, "--samples", "60"][..],
        &["orders", &plan, "--samples", "60"],
        &["size", &plan, "--samples", "60", "--option", "42 ms", "--ropes", "EN 12385-4 6x36 FC"],
        &["sweep", &plan, "--samples", "200", "--interval", "50..70:10"],
    ] {
        let [one, two] = ["1", "2"].map(|n| {
            shelter(&[command, &["--accuracy", "draft", "--threads", n, "--format", "json"]].concat())
        });
        assert!(!one.stdout.is_empty());
        assert_eq!(one.stdout, two.stdout, "{command:?}");
    }
}

#[test]
fn risk_counts_its_samples() {
    let whole = [
        "risk",
        &tested_plan("amur-three-rows.toml"),
        "--samples",
        "103",
        "--format",
        "json",
        "--accuracy",
        "draft",
    ];
    let document = json(&whole);
    assert_eq!(document["samples"], 103);
    let option = &document["options"][0];
    for key in ["p05", "p50", "p95", "max"] {
        assert!(option["flight_height_m"][key].is_number() && option["cable_force_n"][key].is_number());
    }
    assert_eq!(option["interval_95"].as_array().map(Vec::len), Some(2));
}

/// The choice goes into the plan, which then passes; everything else in it stays.
#[test]
fn size_writes_its_choice() {
    let text = support::small_plan_of(&["42 ms"]);
    // Few combinations: each that holds as planned is sampled.
    let text = text
        .edited("ropes = \"GOST 2688-80\"", "ropes = \"EN 12385-4 6x36 IWRC\"")
        .edited("tire_mass_kg = [280, 350]", "tire_mass_kg = [280]");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plan.toml");
    std::fs::write(&file, &text).expect("written");
    let path = file.to_str().expect("UTF-8");
    let size = ["size", path, "--option", "42 ms", "--write", "--format", "json", "--accuracy", "draft"];
    let output = shelter(&size);
    let document: Value = serde_json::from_slice(&output.stdout).expect("one JSON document");
    assert_eq!(document["found"], true, "{document}");
    assert_eq!(document["risk"]["verdict"], "pass");
    assert_eq!(output.status.code(), Some(0));
    let written = std::fs::read_to_string(&file).expect("the plan");
    assert!(written.contains(document["rope"].as_str().expect("a rope")), "{written}");
    let kept =
        |line: &&str| !["rope = ", "mass_kg = ", "border_rows = "].iter().any(|key| line.starts_with(key));
    assert_eq!(
        written.lines().filter(kept).collect::<Vec<_>>(),
        text.lines().filter(kept).collect::<Vec<_>>()
    );
    assert_eq!(shelter(&["check", path, "--any", "--accuracy", "draft"]).status.code(), Some(0));
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1, "nothing is left beside it");
}

#[test]
fn mistaken_ranges_and_shards_are_explained() {
    let plan = tested_plan("amur-three-rows.toml");
    for (arguments, words) in [
        (&["sweep", &plan, "--interval", "0-500"][..], "FROM..TO:STEP"),
        (&["sweep", &plan, "--interval", "0..500:0"], "FROM..TO:STEP"),
        (&["sweep", &plan, "--interval", "0..1e6:1e-6"], "longer step"),
        (&["orders", &plan, "--shard", "3/2"], "1/4 to 4/4"),
        (&["orders", &plan, "--shard", "1/2"], "--save <FILE>"),
        (&["risk", &plan, "--shard", "1/2", "-o", "x", "--format", "csv"], "cannot be used with"),
        (&["check", &plan, "--nominal", "--samples", "9"], "cannot be used with"),
        (&["size", &plan, "--option", "none"], "it has: all at once"),
        (&["size", &plan, "--ropes", "string"], "GOST 2688-80"),
        (&["size", &plan, "--ropes", "EN 818-2"], "fits no rope of EN 818-2"),
        (&["sweep", &plan, "--nominal", "--seed", "9"], "cannot be used with"),
        (&["sweep", &plan, "--option", "long period"], "firing times of its own"),
        (&["merge", &plan], "holds no results of a study"),
    ] {
        let output = shelter(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty());
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(words), "{arguments:?}: {told}");
    }
}

/// What is computed by then is told, with the status of what is not sure.
#[test]
fn a_timeout_ends_with_what_is_there() {
    let plan = &tested_plan("large-50x50.toml");
    let many: &[&[&str]] = &[
        &["check", plan, "--dt", "2e-7"],
        &["sweep", plan, "--dt", "2e-5"],
        &["orders", plan, "--dt", "2e-5"],
        &["size", plan],
        &["trace", plan, "--dt", "2e-7", "--every", "100"],
    ];
    for arguments in many {
        let output = shelter(&[*arguments, &["--timeout", "0.3", "--threads", "1"]].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains("the time was up"), "{arguments:?}: {told}");
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    }
    let check = shelter(&["check", plan, "--dt", "2e-7", "--timeout", "0.3"]);
    assert!(String::from_utf8_lossy(&check.stdout).contains("not computed: ended early"));
}

#[test]
fn studies_that_do_not_fit_into_memory_are_refused_beforehand() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    let text = include_str!("../fixtures/amur-three-rows.toml").edited("rows = 5 ", "rows = 7 ");
    let more: String = (4..=7)
        .map(|row| format!("[[blast_row]]\nname = \"{row}\"\nunder_row = {row}\nlaunch_m_s = 6.0\n"))
        .collect();
    let text = text.replacen("[limits]", &format!("{more}[limits]"), 1);
    let (head, _) = text.split_once("[[delay]]").expect("an option");
    let section = "[uncertainty]\ndetonator = \"electronic\"\n";
    std::fs::write(&plan, format!("{head}[[delay]]\nname = \"a\"\ninterval_ms = 9\n{section}"))
        .expect("written");
    let plan = plan.to_str().expect("UTF-8");
    for arguments in
        [&["risk", plan, "--samples", "100000000"][..], &["orders", plan, "--interval", "0..1000:1"]]
    {
        let output = shelter(arguments);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains("do not fit into memory"), "{told}");
    }
}

/// The same table twice: with commas for scripts, and for spreadsheets where 0,5 is one half.
#[test]
fn csv_for_spreadsheets_with_decimal_commas() {
    let plan = tested_plan("paper-5-tire.toml");
    for command in [&["check", &plan, "--nominal"][..], &["trace", &plan, "--every", "50"]] {
        let [commas, semicolons] = ["csv", "csv-semicolon"].map(|format| {
            let output = shelter(&[command, &["--format", format]].concat());
            String::from_utf8(output.stdout).expect("UTF-8")
        });
        let text = semicolons.strip_prefix('\u{feff}').expect("a byte order mark");
        let read = |text: &str, between: u8| -> Vec<Vec<String>> {
            let mut reader = csv::ReaderBuilder::new().delimiter(between).from_reader(text.as_bytes());
            reader.records().map(|row| row.expect("a row").iter().map(str::to_owned).collect()).collect()
        };
        let (commas, semicolons) = (read(&commas, b','), read(text, b';'));
        assert!(!commas.is_empty() && commas.len() == semicolons.len());
        for (a, b) in commas.concat().iter().zip(&semicolons.concat()) {
            match a.parse::<f64>() {
                Ok(number) => assert_eq!(b.replace(',', ".").parse(), Ok(number)),
                Err(_) => assert_eq!(a, b),
            }
            assert!(a.parse::<f64>().is_err() || !b.contains('.'), "{b}");
        }
    }
}
