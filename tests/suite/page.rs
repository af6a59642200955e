//! The page for the blast file: well formed, complete, and nothing in it comes from elsewhere.

use serde_json::Value;

use super::support::{shelter, shipped};

const PLAN: &str = r#"
title = "<script>alert(1)</script> & \"quotes\""
shelter = { layout = "grid", rows = 4, columns = 6, spacing_m = 1.5 }
tire = { mass_kg = 280 }
cable = { rope = "GOST 2688-80 14", slack_percent = 2 }
ground = { friction = 0.5 }
blast_row = [{ name = "1 < 2", under_row = 2, launch_m_s = 6 }, { name = "2", under_row = 3, launch_m_s = 6 }]
limits = { flight_height_m = 1.8, cable_safety_factor = 1.5 }
delay = [{ name = "20 & 0", interval_ms = 20 }, { name = "<b>", at_ms = [0, 42] }]
simulation = { accuracy = "draft" }
"#;

#[test]
fn the_page_holds_every_result_and_nothing_from_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, page] = ["plan.toml", "page.html"].map(|name| folder.path().join(name));
    std::fs::write(&plan, PLAN).expect("written");
    let [plan, page] = [plan.to_str().expect("UTF-8"), page.to_str().expect("UTF-8")];
    let reported = shelter(&["report", plan, "-o", page]);
    let checked = shelter(&["check", plan, "--format", "json"]);
    assert_eq!(reported.status.code(), checked.status.code());
    assert!(reported.stdout.is_empty());
    let document: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let text = std::fs::read_to_string(page).expect("the page");
    // HTML that is XML but for its doctype and the void element meta.
    let xml = text.replace("<!DOCTYPE html>", "").replace("<meta charset=\"utf-8\">", "");
    let parsed = roxmltree::Document::parse(&xml).unwrap_or_else(|error| panic!("{error}"));
    let words: String = parsed.descendants().filter_map(|node| node.text()).collect();
    for option in document["options"].as_array().expect("options") {
        assert!(words.contains(option["name"].as_str().expect("a name")));
        let height = option["flight_height_m"]["value"].as_f64().expect("a number");
        let digits = (1..5_usize).map(|decimals| format!("{height:.decimals$}"));
        assert!(digits.rev().any(|number| words.contains(&number)), "{height}");
        for reason in option["reasons"].as_array().expect("reasons") {
            assert!(words.contains(reason.as_str().expect("words")), "{reason}");
        }
    }
    assert!(words.contains("<script>alert(1)</script> & \"quotes\""), "shown as text");
    assert!(parsed.descendants().all(|node| !node.has_tag_name("script") && node.attribute("src").is_none()));
    assert!(parsed.descendants().all(|node| node.attribute("href").is_none()));
    assert_eq!(parsed.descendants().filter(|node| node.tag_name().name() == "svg").count(), 1 + 2 * 2);
    assert!(words.contains("2007-09-17"), "the date asked for");
}

#[test]
fn a_page_that_cannot_be_written_says_so() {
    let output = shelter(&["report", &shipped("paper-5-tire.toml"), "-o", "/no/such/folder/page.html"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!output.stderr.is_empty());
}
