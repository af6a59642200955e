//! The page for the blast file: well formed, complete, and nothing in it comes from elsewhere. It is headed by the option to be
//! fired, and one can sign it.

use std::process::Output;
use std::sync::{Arc, LazyLock};

use roxmltree::{Document, Node};
use serde_json::Value;
use shelter::study::Case;
use shelter::study::observed::ObservationRecord;
use shelter::study::observed::record_file;
use shelter::tui::export;

use super::support::stage::finished;
use super::support::{Edited, json, shelter, tested_plan, text};

/// Its first line is empty, and it holds a carriage return: both are kept. Shots differ so much that what its pass stands on is soon known.
pub const PLAN: &str = "
title = \"<script>alert(1)</script> & \\\"quotes\\\" </style>\"
shelter = { layout = \"grid\", rows = 4, columns = 3, spacing_m = 1.5 }
tire = { mass_kg = 280 }\r
cable = { rope = \"GOST 2688-80 14\", slack_percent = 2, termination = \"clips\" }
ground = { friction = 0.5 }
limits = { flight_height_m = 1.8, cable_safety_factor = 1.2 }
delay = [{ name = \"20 & 0\", interval_ms = 20 }, { name = \"<b>\", at_ms = [0, 42], hole_interval_ms = 17 }]
simulation = { accuracy = \"draft\" }
[uncertainty]
launch_common_percent = 2
launch_between_shots_percent = 8
launch_row_cv_percent = 0
launch_tilt_deg = 0
launch_tilt_common_deg = 0
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
[[blast_row]]
name = \"1 < 2\"
under_row = 2
launch_m_s = 6
charge_kg = 25
[[blast_row]]
name = \"2\"
under_row = 3
launch_m_s = 6
charge_kg = 25
";

/// Output of `report` on a plan, and the page it wrote; it names the plan `folder/plan.toml`.
pub fn report(plan: &str, more: &[&str]) -> (Output, Option<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    let [file, page] = ["plan.toml", "page.html"].map(|name| folder.path().join(name));
    std::fs::write(&file, plan).expect("written");
    let [file, written] = [&file, &page].map(|path| path.to_str().expect("UTF-8"));
    let output = shelter(&[&["report", file, "-o", written], more].concat());
    let page = std::fs::read_to_string(&page).ok();
    (output, page.map(|page| page.replace(folder.path().to_str().expect("UTF-8"), "folder")))
}

/// HTML that is XML but for its doctype and the void element meta.
pub fn xml(page: &str) -> String {
    let mut metas = page.split("<meta ");
    let first = metas.next().unwrap_or_default().replace("<!DOCTYPE html>", "");
    let rest = metas.map(|rest| rest.split_once('>').expect("it ends").1);
    std::iter::once(first.as_str()).chain(rest).collect()
}

fn parse(xml: &str) -> Document<'_> {
    Document::parse(xml).unwrap_or_else(|error| panic!("{error}"))
}

fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter(|node| node.is_text()).filter_map(|node| node.text()).collect()
}

/// The element of this class.
fn of_class<'a, 'i>(page: &'a Document<'i>, class: &str) -> Option<Node<'a, 'i>> {
    let is = |node: &Node<'_, '_>| {
        node.attribute("class").is_some_and(|names| names.split(' ').any(|name| name == class))
    };
    page.descendants().find(is)
}

/// The section under a heading that begins with `heading`.
fn section<'a, 'i>(page: &'a Document<'i>, heading: &str) -> Node<'a, 'i> {
    let is = |node: &Node<'_, '_>| node.has_tag_name("h2") && words(*node).starts_with(heading);
    let found = page.descendants().find(is).and_then(|heading| heading.parent());
    found.unwrap_or_else(|| panic!("no section '{heading}'"))
}

/// `report` on the plan with the second option to be fired.
static REPORTED: LazyLock<(Output, Option<String>)> = LazyLock::new(|| report(PLAN, &["--option", "<b>"]));

/// The page of the plan with the second option to be fired, as XML.
static FIRED: LazyLock<String> = LazyLock::new(|| {
    let (output, page) = &*REPORTED;
    xml(page.as_ref().unwrap_or_else(|| panic!("{}", text(&output.stderr))))
});

/// The page of the plan without an option to be fired, as XML.
static PLAIN: LazyLock<String> = LazyLock::new(|| xml(&report(PLAN, &[]).1.expect("a page")));

/// What `check` finds of the same plan.
static CHECKED: LazyLock<Value> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plan.toml");
    std::fs::write(&file, PLAN).expect("written");
    json(&shelter(&["check", file.to_str().expect("UTF-8"), "--format", "json"]))
});

#[test]
fn the_page_holds_every_result_and_nothing_from_elsewhere() {
    let (reported, page) = report(PLAN, &[]);
    let passes =
        CHECKED["options"].as_array().expect("options").iter().all(|option| option["verdict"] == "pass");
    assert_eq!(reported.status.code(), Some(i32::from(!passes)));
    assert!(reported.stdout.is_empty());
    let xml = xml(&page.expect("a page"));
    let parsed = parse(&xml);
    let words = words(parsed.root());
    for option in CHECKED["options"].as_array().expect("options") {
        assert!(words.contains(option["name"].as_str().expect("a name")));
        let height = option["flight_height_m"]["value"].as_f64().expect("a number");
        let digits = (1..5_usize).map(|decimals| format!("{height:.decimals$}"));
        assert!(digits.rev().any(|number| words.contains(&number)), "{height}");
        for reason in option["reasons"].as_array().expect("reasons") {
            assert!(words.contains(reason.as_str().expect("words")), "{reason}");
        }
        // Its charts are those of the samples that decide: where only the height does, or only the force, the one of scripts.
        let number = &option["deciding_sample"];
        let drawn = ["sample {}; ", "by height sample {}, ", "by force sample {}; "];
        let drawn = drawn.map(|words| words.replace("{}", &number.to_string()));
        assert!(drawn.iter().any(|words| words.contains(words.as_str())), "{drawn:?}");
    }
    assert!(words.contains("<script>alert(1)</script> & \"quotes\""), "shown as text");
    for page in [&parsed, &parse(&FIRED)] {
        let nodes = || page.descendants();
        assert!(nodes().all(|node| !node.has_tag_name("script") && node.attribute("src").is_none()));
        assert!(nodes().all(|node| node.attribute("href").is_none()));
        assert_eq!(nodes().filter(|node| node.tag_name().name() == "svg").count(), 1 + 2 * 2);
        let style = nodes().find(|node| node.has_tag_name("style")).and_then(|node| node.text()).expect("it");
        assert!(!style.contains("url(") && !style.contains("@import"));
        assert!(!style.contains('<'), "no title ends the style sheet");
    }
    assert!(words.contains("2007-09-17"), "the date asked for");
    assert_eq!(xml, *PLAIN, "the same page again");
}

#[test]
fn a_page_that_cannot_be_written_says_so() {
    let output = shelter(&["report", &tested_plan("paper-5-tire.toml"), "-o", "/no/such/folder/page.html"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!output.stderr.is_empty());
}

#[test]
fn the_option_to_be_fired_heads_the_page_with_all_its_verdict_rests_on() {
    let page = parse(&FIRED);
    let head = of_class(&page, "fired").expect("the box");
    let first = page.descendants().find(|node| node.has_tag_name("section")).expect("sections");
    assert!(head.range().start < first.range().start, "it heads the page");
    let line = head.first_element_child().map(words).expect("a line");
    assert_eq!(
        line,
        "To be fired only if all that is to be confirmed is right, and a THIN pass, slide NOT checked: <b>, rows at 1 < 2: 0 ms, 2: 42 ms · holes 17 ms left"
    );
    let found = &CHECKED["options"][1];
    assert_eq!(found["nominal_verdict"], "pass", "so that there is a launch margin");
    // A pass under a condition is no larger than it.
    let verdict = head.children().filter(|node| node.is_element()).nth(1).map(words).expect("the verdict");
    assert_eq!((verdict.as_str(), found["verdict"].as_str()), ("THIN", Some("pass")));
    assert!(of_class(&page, "large").is_none());
    assert!(words(head).contains("The pass is thin: only until "), "{}", words(head));
    let facts: Vec<(String, String)> = head
        .descendants()
        .filter(|node| node.has_tag_name("tr"))
        .map(|row| {
            let cells: Vec<String> = row.children().map(words).collect();
            (cells[0].clone(), cells[1].clone())
        })
        .collect();
    let fact = |name: &str| {
        let found = facts.iter().find(|(known, _)| known == name);
        found.map(|(_, text)| text.as_str()).unwrap_or_else(|| panic!("no fact '{name}'"))
    };
    let bound = |end: &str| 100.0 * found["failure_probability"][end].as_f64().expect("a bound");
    assert!(fact("Risk").starts_with(&format!("{:.2} to {:.2} % of", bound("low"), bound("high"))));
    assert!(fact("Risk").ends_with("accepted 1 %"));
    assert!(
        found["launch_margin"].is_number() && facts.iter().all(|(name, _)| name != "Planned shot alone"),
        "beside a thin pass"
    );
    assert!(fact("What decides").contains("launch ") && fact("What decides").ends_with(" %"));
    assert_eq!(fact("Within any 8 ms"), "1 hole, 25 kg, as planned");
    let height = found["flight_height_m"]["value"].as_f64().expect("a height");
    assert!(fact("Height").starts_with(&format!("{height:.2}")[..3]), "{}", fact("Height"));
    // Who signs reads what 1 in 100 is above, as on the screens: beyond 95 of 100.
    let worst = fact("Height").split("1 in 100 is above ").nth(1).and_then(|rest| rest.split(' ').next());
    let worst: f64 = worst.and_then(|number| number.parse().ok()).expect("a height");
    assert!(worst >= found["flight_height_m"]["p95"].as_f64().expect("a band") - 5e-4, "{}", fact("Height"));
    let share = (100.0 * worst / 1.8).ceil();
    assert!(
        fact("Height").contains(&format!(" m, {share:.0} % of the limit; limit 1.800 m; of a tire's centre")),
        "{}",
        fact("Height")
    );
    for reason in found["reasons"].as_array().expect("reasons") {
        assert!(words(head).contains(reason.as_str().expect("words")), "{reason}");
    }
    let row = words(of_class(&page, "options").expect("the options"));
    assert!(row.contains("20 & 0"), "the other options stand below");
}

#[test]
fn an_option_that_has_not_passed_says_why_at_the_head() {
    let (_, page) =
        report(&PLAN.edited("flight_height_m = 1.8", "flight_height_m = 0.5"), &["--option", "<b>"]);
    let xml = xml(&page.expect("a page"));
    let page = parse(&xml);
    let head = words(of_class(&page, "fired").expect("the box"));
    assert!(head.contains("FAIL") && head.contains("is over the limit of 0.5 m"), "{head}");
    assert!(head.contains("none: the planned shot does not pass"), "{head}");
    let signed = words(of_class(&page, "signatures").expect("lines to sign"));
    assert!(
        signed.contains("“<b>”, rows at 1 < 2: 0 ms, 2: 42 ms · holes 17 ms left, FAIL"),
        "who signs reads the verdict: {signed}"
    );
}

/// A text as the style sheet writes it: all but letters and digits of ASCII by their numbers.
fn in_style_sheet(text: &str) -> String {
    let letter = |letter: char| match letter.is_ascii_alphanumeric() {
        true => letter.to_string(),
        false => format!("\\{:x} ", u32::from(letter)),
    };
    text.chars().map(letter).collect()
}

/// A pass of the shot as planned alone must not be signed for one of all shots that may come of the plan.
#[test]
fn a_page_without_samples_says_so_wherever_it_says_pass() {
    let output = shelter(&[
        "report",
        &tested_plan("amur-three-rows.toml"),
        "-o",
        "-",
        "--nominal",
        "--accuracy",
        "draft",
        "--option",
        "42 ms",
    ]);
    let page = text(&output.stdout);
    let caveat = " as planned only, nothing varied: NO permission to fire";
    assert!(
        page.contains("NOT to be fired: 42 ms") && !page.contains("To be fired"),
        "nobody fires by this alone"
    );
    for place in [
        // The head, the signature, the heading of its charts, and the foot of every printed page.
        format!("<p>Judged: PASS{caveat}</p>"),
        format!("“42 ms”, rows at 1: 0 ms, 2: 42 ms, 3: 84 ms, PASS{caveat}"),
        format!("42 ms PASS{caveat} · NOT to be fired"),
        in_style_sheet("“42 ms”: NOT to be fired"),
    ] {
        assert!(page.contains(&place), "{place}\n{page}");
    }
}

#[test]
fn warnings_of_the_option_to_be_fired_stand_at_its_head() {
    let plan = PLAN.edited("at_ms = [0, 42]", "at_ms = [0, 400]");
    let plan = plan.edited("under_row = 3", "under_row = 2");
    let [own, other] =
        ["<b>", "20 & 0"].map(|option| xml(&report(&plan, &["--option", option]).1.expect("a page")));
    let warning = |page: &Document<'_>| {
        let fired = words(of_class(page, "fired").expect("the box"));
        let mut all = fired.split("Warning: ").map(str::trim);
        all.find(|warning| warning.contains("holes fire under a tire")).expect("a warning").to_owned()
    };
    let [of_own, of_other] = [&own, &other].map(|page| warning(&parse(page)));
    assert!(of_own != of_other && !of_other.contains("<b>"), "{of_own} {of_other}");
    let others = words(section(&parse(&other), "Delay options"));
    assert!(others.contains(&format!("Warning: option <b>: {of_own}")), "{others}");
    assert!(!others.contains("option 20 & 0: "), "{others}");
}

#[test]
fn an_unknown_option_to_be_fired_is_refused_with_the_names_and_nothing_is_written() {
    let (output, page) = report(PLAN, &["--option", "43 ms"]);
    assert_eq!((output.status.code(), page), (Some(2), None));
    let error = text(&output.stderr);
    assert!(error.contains("'43 ms'") && error.contains("20 & 0; <b>"), "{error}");
}

#[test]
fn without_an_option_to_be_fired_the_page_says_so_in_one_line() {
    let page = parse(&PLAIN);
    assert!(of_class(&page, "fired").is_none());
    let line = of_class(&page, "chosen").map(words).expect("the line");
    assert!(line.starts_with("No option is chosen to be fired") && line.contains("--option NAME"), "{line}");
    assert!(of_class(&parse(&FIRED), "chosen").is_none());
}

#[test]
fn only_the_plan_as_planned_says_so_at_the_head() {
    let (_, page) = report(PLAN, &["--option", "<b>", "--nominal"]);
    let xml = xml(&page.expect("a page"));
    let page = parse(&xml);
    let head = words(of_class(&page, "fired").expect("the box"));
    assert!(head.contains("Judged: the plan's own numbers only: no permission to fire."), "{head}");
    assert!(head.contains("not judged: the plan's own numbers only, nothing varied"), "{head}");
}

#[test]
fn the_plan_stands_there_letter_by_letter() {
    let page = parse(&FIRED);
    let summary =
        page.descendants().find(|node| node.has_tag_name("summary") && words(*node).starts_with("The plan"));
    let details = summary.and_then(|summary| summary.parent()).expect("the plan");
    let plan = words(details.last_element_child().expect("its text"));
    // A reader of HTML drops the first line end of the element.
    assert_eq!(plan, format!("\n{PLAN}"));
    assert!(!words(page.root()).to_lowercase().contains("not saved"));
}

#[test]
fn the_terminal_says_where_the_plan_is_not_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let exported = |name: &str, edit: &str| {
        let (mut app, path) = (finished(), folder.path().join(name));
        let source = &mut Arc::make_mut(&mut app.case).source;
        source.path = tested_plan("amur-three-rows.toml").into();
        source.text += edit;
        export::write(&app, &path).expect("written");
        xml(&std::fs::read_to_string(path).expect("the page"))
    };
    let (saved, edited) = (exported("saved.html", ""), exported("edited.html", "# edited\n"));
    let [saved, edited] = [parse(&saved), parse(&edited)];
    assert!(!words(saved.root()).to_lowercase().contains("not saved"));
    assert!(words(edited.root()).contains("Not saved: no file holds the plan that was computed"));
    let plan = section(&edited, "The plan, word for word (not saved)");
    assert!(words(plan).ends_with("# edited\n"));
}

#[test]
fn rope_and_termination_stand_there_with_their_figures() {
    let page = parse(&FIRED);
    let facts = words(section(&page, "Shelter"));
    for figure in [
        "GOST 2688-80 14: 6x19",
        "diameter 14 mm",
        "grade 1570 N/mm²",
        "EA 7193 kN",
        "breaking force 98.95 kN",
        "clips, efficiency 80 %",
        "79.16 kN, of rope and termination",
        "3 holes fire from 42 ms to 76 ms",
    ] {
        assert!(facts.contains(figure), "no '{figure}' in {facts}");
    }
    let own = "cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60, termination_percent = 90,";
    let plan =
        PLAN.edited("cable = { rope = \"GOST 2688-80 14\",", own).edited(", termination = \"clips\"", "");
    let xml = xml(&report(&plan, &["--nominal"]).1.expect("a page"));
    let facts = words(section(&parse(&xml), "Shelter"));
    for figure in ["EA 1400 kN, breaking force 60 kN, as the plan says", "efficiency 90 %", "54 kN, of rope"]
    {
        assert!(facts.contains(figure), "no '{figure}' in {facts}");
    }
}

/// The greatest values of the option to be fired stand in a table, as `check` finds them.
#[test]
fn the_greatest_values_of_the_option_stand_there() {
    let page = parse(&FIRED);
    let row = |heading: &str| {
        let is = |node: &Node<'_, '_>| node.has_tag_name("tr") && words(*node).starts_with(heading);
        page.descendants().find(is).map(words).unwrap_or_default()
    };
    let planned = row("As planned");
    let height = CHECKED["options"][1]["flight_height_m"]["value"].as_f64().expect("a height");
    let shown = (2..6_usize).any(|decimals| planned.contains(&format!("height {height:.decimals$} ")));
    assert!(shown, "{height}: {planned}");
    assert!(planned.contains(" · force ") && planned.contains(" · slide "), "{planned}");
    assert!(row("Sampled shots").contains(" m"), "no bands of samples");
}

/// Texts of the map.
fn map_texts(page: &Document<'_>) -> Vec<String> {
    let map = section(page, "The shelter from above");
    map.descendants()
        .filter(|node| node.tag_name().name() == "text")
        .map(|text| words(text).trim().to_owned())
        .collect()
}

#[test]
fn the_map_has_numbers_at_its_edges_a_scale_bar_and_a_legend() {
    let page = parse(&FIRED);
    let texts = map_texts(&page);
    let count = |wanted: &str| texts.iter().filter(|text| *text == wanted).count();
    assert_eq!(["row", "column"].map(count), [1, 1]);
    // Four rows, three columns; no hole fires at 1, 2, 3 or 4 ms.
    assert_eq!(["1", "2", "3", "4", "5"].map(count), [2, 2, 2, 1, 0]);
    for time in ["0", "17", "34", "42", "59", "76"] {
        assert_eq!(count(time), 1, "a hole fires at {time} ms");
    }
    assert_eq!(count("1 m"), 1, "of {texts:?}");
    let has = |start: &str| texts.iter().any(|text| text.starts_with(start));
    let found = &CHECKED["options"][1];
    let tire = &found["flight_height_m"]["tire"];
    assert!(has("hole, with its firing time in ms"));
    assert!(has(&format!("highest as planned: tire {}:{}, ", tire[0], tire[1])), "{texts:?}");
    let [a, b] = [0, 1].map(|end| &found["cable_force_n"]["cable"][end]);
    assert!(
        has(&format!("greatest force as planned: cable {}:{}-{}:{}, ", a[0], a[1], b[0], b[1])),
        "{texts:?}"
    );
    let strokes = |page: &Document<'_>, width: &str| {
        let map = section(page, "The shelter from above");
        map.descendants().filter(|node| node.attribute("stroke-width") == Some(width)).count()
    };
    assert_eq!([strokes(&page, "5"), strokes(&page, "3")], [2, 2], "each mark on the map and in the legend");
    let plain = parse(&PLAIN);
    assert_eq!([strokes(&plain, "5"), strokes(&plain, "3")], [0, 0]);
    assert!(map_texts(&plain).contains(&"1 < 2".to_owned()), "without an option the rows have their names");
}

#[test]
fn the_words_of_the_page_are_explained() {
    let page = parse(&FIRED);
    let glossary = section(&page, "The words of this page");
    let explained: Vec<String> =
        glossary.descendants().filter(|node| node.has_tag_name("dt")).map(words).collect();
    for word in ["Verdict", "Risk", "Planned shot alone", "Slack", "Slide", "Energy residual"] {
        assert!(explained.iter().any(|known| known == word), "{word}");
    }
    let meanings = glossary.descendants().filter(|node| node.has_tag_name("dd")).map(words);
    assert!(meanings.filter(|meaning| meaning.ends_with('.')).count() == explained.len());
}

#[test]
fn what_the_law_asks_and_no_program_knows_is_blank_and_there_is_room_to_sign() {
    let page = parse(&FIRED);
    let blanks = words(of_class(&page, "blanks").expect("blanks"));
    for asked in [
        "Site",
        "Date and time of the shot",
        "Blaster in charge",
        "Crew",
        "Cover: layers, overlap",
        "Explosive",
        "Stemming",
        "Initiation system",
        "Weather",
        "Guards posted",
        "Distance and direction to what is protected",
        "misfires, flyrock",
        "To be kept until",
    ] {
        assert!(blanks.contains(asked), "{asked}");
    }
    let sheet = of_class(&page, "sheet").expect("the first sheet");
    assert!(sheet.descendants().any(|node| node.has_tag_name("svg")), "the drawing");
    assert!(
        of_class(&page, "fired").is_some_and(|answer| sheet.range().contains(&answer.range().start)),
        "the answer"
    );
    let signatures = of_class(&page, "signatures").expect("lines to sign");
    assert!(
        sheet.range().contains(&signatures.range().start),
        "who signs reads the answer on the same sheet"
    );
    let signed = words(signatures);
    assert_eq!(signed.matches("signature").count(), 2);
    assert!(
        signed.contains("To be fired only if all that is to be confirmed is right, and a THIN pass, slide NOT checked: option “<b>”, "),
        "what is signed: {signed}"
    );
}

#[test]
fn the_page_prints_on_any_paper_and_reads_on_a_phone() {
    let (_, page) = report(PLAN, &["--nominal"]);
    let page = page.expect("a page");
    assert!(page.contains("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"));
    let xml = xml(&page);
    let parsed = parse(&xml);
    let style = parsed.descendants().find(|node| node.has_tag_name("style")).map(words).expect("a sheet");
    assert!(style.contains("\"Page \" counter(page) \" of \" counter(pages)"), "pages are numbered");
    let paper = style.split("@page").nth(1).expect("a rule for paper");
    assert!(!paper.contains(" size:"), "the printer chooses the paper: {paper}");
    for rule in ["break-inside: avoid", "break-after: avoid", "display: table-header-group"] {
        assert!(style.contains(rule), "{rule}");
    }
    let phone = style.split("@media screen and (max-width: 600px)").nth(1).expect("a rule for phones");
    assert!(phone.contains(".charts, .blanks, .signatures { display: block }"), "charts are stacked");
    assert!(style.contains(".scroll { overflow-x: auto }"));
    let options = of_class(&parsed, "options").expect("the options");
    assert!(options.attribute("class").is_some_and(|names| names.contains("scroll")), "wide tables scroll");
}

#[test]
fn a_file_that_is_no_page_of_this_program_is_not_overwritten() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("page.html");
    let page = page.to_str().expect("UTF-8");
    let plan = tested_plan("paper-5-tire.toml");
    let report = |more: &[&str]| {
        let arguments = ["report", &plan, "-o", page, "--nominal", "--accuracy", "draft"];
        shelter(&[&arguments[..], more].concat())
    };
    std::fs::write(page, "mine").expect("written");
    let refused = report(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("--force"), "{}", text(&refused.stderr));
    assert_eq!(std::fs::read_to_string(page).expect("a file"), "mine");
    for more in [&["--force"][..], &[]] {
        let written = report(more);
        assert_ne!(written.status.code(), Some(2), "{more:?}");
        assert!(std::fs::read_to_string(page).expect("a file").starts_with("<!DOCTYPE html>"));
        assert!(!text(&written.stderr).contains("earlier"), "{}", text(&written.stderr));
    }
    // Who asks for another page and gets none has the one before under its name.
    let none = text(&report(&["--option", "no such option"]).stderr).to_owned();
    assert!(
        none.contains("no page was written") && none.contains("is an earlier one, do not fire by it"),
        "{none}"
    );
    assert!(!text(&refused.stderr).contains("earlier one"), "what is no page permits nothing");
}

#[test]
fn what_was_seen_of_earlier_shots_stands_on_the_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = folder.path().join("seen.csv");
    let line =
        |value: f64| format!("option,tire,quantity,value,sd\n20 & 0,1:1,flight_height_m,{value},0.05\n");
    std::fs::write(&seen, line(1.6)).expect("written");
    let path = seen.display().to_string();
    let (_, page) = report(PLAN, &["--nominal", "--observed", &path]);
    let page = page.expect("a page");
    assert!(page.contains("Earlier shots: planned, predicted, observed") && page.contains("1.600 ± 0.050"));
    assert!(page.contains("the plan is not fitted to all that was seen"), "nothing was fitted");
    let (_, without) = report(PLAN, &["--nominal"]);
    assert!(!without.expect("a page").contains("Earlier shots"));

    // The limit is 1.8 m.
    std::fs::write(&seen, line(1.9)).expect("written");
    let (_, page) = report(PLAN, &["--nominal", "--observed", &path, "--option", "<b>"]);
    let page = xml(&page.expect("a page"));
    let page = Document::parse(&page).expect("XML");
    let [head, signed] =
        ["fired", "signatures"].map(|class| words(of_class(&page, class).expect("such a part")));
    assert!(head.starts_with("NOT to be fired: <b>") && head.contains("over the limit of 1.800"), "{head}");
    assert!(
        head.contains("Do not fire this option as it stands.") && !head.contains("To be fired"),
        "{head}"
    );
    assert!(
        signed.contains("NOT to be fired: option “<b>”") && signed.contains("speak against the plan"),
        "{signed}"
    );
    section(&page, "<b> ")
        .descendants()
        .find(|node| words(*node).ends_with("NOT to be fired"))
        .expect("at its charts");

    let (_, page) = report(PLAN, &["--nominal", "--observed", &path]);
    assert!(page.expect("a page").contains("speak against this plan"), "also where no option is chosen");

    std::fs::write(&seen, line(1.6).replace("1:1", "9:9")).expect("written");
    let (wrong, _) = report(PLAN, &["--nominal", "--observed", &path]);
    assert_eq!(wrong.status.code(), Some(2));
}

/// What was told in the terminal counts in every command, from the file beside the plan: what agrees is no objection, what does not, or
/// cannot be read, is one.
#[test]
fn what_was_told_in_the_terminal_counts_in_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, page] = ["plan.toml", "page.html"].map(|name| folder.path().join(name));
    std::fs::write(&plan, PLAN).expect("written");
    let case = Case::load(&plan).expect("a plan");
    let [file, written] = [&plan, &page].map(|path| path.to_str().expect("UTF-8"));
    let told = |command: &[&str]| {
        let output = shelter(&[command, &["--nominal"]].concat());
        text(&output.stdout).to_owned() + text(&output.stderr)
    };
    for (line, against) in
        [("1:1 1.6 0.05", None), ("1:1 1.9 0.05", Some("1.900 m was seen, over the limit of 1.800"))]
    {
        let mut seen = ObservationRecord::default();
        assert_eq!(seen.add_line(&case, 0, line), Ok(()));
        record_file::save(&plan, &seen).expect("written");
        let says =
            |told: &str| against.map_or(!told.contains("speak against"), |against| told.contains(against));
        for command in
            [&["check", file][..], &["orders", file, "--option", "20 & 0"], &["report", file, "-o", written]]
        {
            assert!(says(&told(command)), "{command:?}: {}", told(command));
        }
        assert!(std::fs::read_to_string(&page).is_ok_and(|page| page.contains("Earlier shots: planned")));
    }
    // A plan that is renamed alone is not free of what was seen.
    let renamed = plan.with_file_name("renamed.toml");
    std::fs::rename(&plan, &renamed).expect("renamed");
    let of_renamed = told(&["check", renamed.to_str().expect("UTF-8")]);
    assert!(of_renamed.contains("plan.seen.json: there is no plan of this name"), "{of_renamed}");
    std::fs::rename(&renamed, &plan).expect("renamed");
    std::fs::write(record_file::path(&plan), "{").expect("written");
    for command in [&["check", file][..], &["report", file, "-o", written]] {
        assert!(told(command).contains("not compared with this plan: "), "{command:?}");
    }
}

/// A plan is found again under the bytes of its name, whatever the screen shows of it, and what lies beside it counts.
#[cfg(unix)]
#[test]
fn what_was_told_beside_a_plan_of_an_odd_name_counts() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().expect("a folder");
    for name in [&b"pl\xffan.toml"[..], "pl\u{202e}an.toml".as_bytes()] {
        let plan = folder.path().join(std::ffi::OsStr::from_bytes(name));
        std::fs::write(&plan, PLAN).expect("written");
        let mut seen = ObservationRecord::default();
        assert_eq!(seen.add_line(&Case::load(&plan).expect("a plan"), 0, "1:1 1.9 0.05"), Ok(()));
        record_file::save(&plan, &seen).expect("written");
        let check = std::process::Command::new(crate::support::PROGRAM)
            .args(["check", "--nominal"])
            .arg(&plan)
            .output();
        let told = text(&check.expect("it runs").stdout).to_owned();
        assert!(
            told.contains("1.900 m was seen, over the limit of 1.800") && !told.contains("is not here"),
            "{told}"
        );
    }
}

/// The exit status says what the head of the page says: only a full PASS that nothing seen contradicts may be fired.
#[test]
fn the_exit_status_of_a_page_is_whether_its_option_may_be_fired() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = folder.path().join("seen.csv");
    std::fs::write(&seen, "option,tire,quantity,value,sd\n20 & 0,1:1,flight_height_m,1.9,0.05\n")
        .expect("written");
    let seen = seen.display().to_string();
    let option = ["--option", "<b>"];
    for (more, may_be_fired) in [
        (&[][..], true),
        (&["--nominal"][..], false),
        (&["--samples", "100"][..], false),
        (&["--dt", "0.002"][..], false),
        (&["--observed", &seen, "--format", "text"][..], false),
    ] {
        let (output, page) = match more {
            [] => &*REPORTED,
            _ => &report(PLAN, &[&option[..], more].concat()),
        };
        let page = page.as_ref().expect("a page");
        assert_eq!(page.contains("\">To be fired"), may_be_fired, "{more:?}");
        assert_eq!(output.status.code(), Some(i32::from(!may_be_fired)), "{more:?}");
        // What is printed beside a page that was contradicted recommends nothing, either, and says why.
        let [printed, told] = [&output.stdout, &output.stderr].map(|bytes| text(bytes));
        let is_contradicted = more.contains(&"--observed");
        assert_eq!(told.contains("was seen, over the limit"), is_contradicted);
        assert_eq!(printed.contains("was seen, over the limit of 1.800"), is_contradicted, "{printed}");
        assert!(!printed.contains("passes, the "), "{printed}");
    }
    let example = PLAN.edited("title = \"", "title = \"EXAMPLE, ");
    let (output, page) = report(&example, &option);
    let page = page.expect("a page");
    assert!(page.contains("NOT to be fired, the plan is an example: ") && !page.contains("To be fired: "));
    assert_eq!(output.status.code(), Some(1), "nobody signs the copy of an example");
    // Without the section everything counts as known to 1 %; what is left out of it, and marks of what was assumed, are told.
    let unknown =
        PLAN.find("[uncertainty]").expect("the section")..PLAN.find("[[blast_row]]").expect("a row");
    let silent = [&PLAN[..unknown.start], &PLAN[unknown.end..]].concat();
    let silent = silent.replace("launch_m_s = 6\n", "launch_m_s = 2\n");
    let (output, page) = report(&silent, &option);
    let page = page.expect("a page");
    assert!(page.contains("<p>Judged: PASS</p>"), "a test that can fail");
    // A sheet that lies alone is no permission: neither its foot nor a large word says that the option passes.
    let at_foot = |words: &str| page.contains(&in_style_sheet(&format!("“<b>”: {words}")));
    assert!(at_foot("NOT to be fired, the plan has no [uncertainty]") && !at_foot("PASS"), "{page}");
    assert!(
        page.contains("NOT to be fired, the plan has no [uncertainty]") && !page.contains("To be fired: ")
    );
    assert_eq!(output.status.code(), Some(1), "nobody said what is not known");
    // Nor who says nothing of how well the launch is known, which decides most.
    let unstated =
        PLAN.edited("launch_common_percent = 2\n", "").replace("launch_m_s = 6\n", "launch_m_s = 2\n");
    let (output, page) = report(&unstated, &option);
    let told = "NOT to be fired, launch_common_percent does not say how well the launch is known: ";
    assert!(page.is_some_and(|page| page.contains("<p>Judged: PASS</p>") && page.contains(told)));
    assert_eq!(output.status.code(), Some(1), "nobody said how well the launch is known");
    let marked = PLAN.edited("launch_common_percent = 2\n", "launch_common_percent = 2 # assumed\n");
    let page = report(&marked, &[&option[..], &["--nominal"]].concat()).1.expect("a page");
    let listed = xml(&page);
    let listed = parse(&listed);
    let sheet = of_class(&listed, "sheet").map(words).expect("the first sheet");
    assert!(sheet.contains("☐ launch_common_percent = 2 launch in common, %"), "{sheet}");
    assert!(page.contains("[uncertainty] leaves out `detonator`, `launch_cv_percent`, "), "{page}");
    let (output, page) = report(PLAN, &["--nominal", "--observed", &seen]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(!page.expect("a page").contains("passes, the "), "nothing is recommended");
    let document = json(&report(PLAN, &["--observed", &seen, "--format", "json"]).0);
    assert!(document["recommended"].is_null(), "{document}");
    assert!(document["warnings"].to_string().contains("was seen, over the limit"), "{document}");
}

/// A film in the plan's own folder of shots that nobody names has a box, and so has a limit of height in feet.
#[test]
fn a_film_that_the_page_does_not_read_and_a_far_limit_have_boxes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [plan, page, shots] = ["plan.toml", "page.html", "plan.shots"].map(path);
    let film = path("plan.shots/film.csv");
    std::fs::write(&plan, PLAN.edited("flight_height_m = 1.8", "flight_height_m = 18")).expect("written");
    std::fs::create_dir(&shots).expect("made");
    std::fs::write(&film, "option,tire,quantity,value,sd\n20 & 0,2:1,flight_height_m,1,0.3\n")
        .expect("written");
    let boxes = |more: &[&str]| {
        let report = ["report", &plan, "--option", "<b>", "-o", &page];
        let reported = shelter(&[&report, more].concat());
        assert_eq!(reported.status.code(), Some(0), "{}", text(&reported.stderr));
        let page = std::fs::read_to_string(&page).expect("a page");
        ["film.csv: this page does not read it", "is it in metres?"].map(|told| page.contains(told))
    };
    assert_eq!(boxes(&[]), [true, true]);
    // Wherever it lies beside the plan; a list of holes is no film, and the shots of another plan are that plan's.
    let rename = |from: &str, to: &str| std::fs::rename(path(from), path(to)).expect("renamed");
    std::fs::write(path("holes.csv"), "hole,x,y\n1,0,0\n").expect("written");
    for (folder, is_told) in [("duds", true), ("other.shots", false)] {
        rename("plan.shots", folder);
        assert_eq!(boxes(&[])[0], is_told, "{folder}");
        rename(folder, "plan.shots");
    }
    rename("plan.shots/film.csv", "film.csv");
    assert!(boxes(&[])[0]);
    rename("film.csv", "plan.shots/film.csv");
    assert_eq!(boxes(&["--observed", &shots]), [false, true]);
    std::fs::write(&plan, PLAN).expect("written");
    assert_eq!(boxes(&["--observed", &film]), [false, false]);
}

/// In no face and no language does anything pass of a plan that observations speak against; without them it does.
#[test]
fn nothing_passes_of_a_plan_that_observations_contradict() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = folder.path().join("seen.csv");
    std::fs::write(&seen, "option,tire,quantity,value,sd\n20 & 0,1:1,flight_height_m,1.9,0.05\n")
        .expect("written");
    let seen = seen.display().to_string();
    for (observed, passes) in [(&[][..], true), (&["--observed", &seen][..], false)] {
        let report = |more: &[&str]| report(PLAN, &[observed, &["--nominal"], more].concat());
        for more in [&[][..], &["--option", "<b>"], &["--option", "20 & 0", "--sweep"]] {
            for lang in ["en", "ru"] {
                let page = report(&[more, &["--lang", lang]].concat()).1.expect("a page");
                let says_pass = [">PASS<", ">ПРОХОДИТ<", "”: PASS"].iter().any(|pass| page.contains(pass));
                assert_eq!(says_pass, passes, "{more:?} {lang}");
                // Of shots of which nothing is varied none may be fired, and none has the colour of a pass.
                assert!(!page.contains("class=\"pass\""), "{more:?} {lang}");
            }
        }
        let printed = |format: &str| text(&report(&["--format", format]).0.stdout).to_owned();
        assert_eq!(printed("text").contains("PASS"), passes, "{}", printed("text"));
        assert_eq!(printed("csv").split([',', '\n']).any(|field| field == "pass"), passes);
        let document = json(&report(&["--format", "json"]).0);
        assert_eq!(document["verdict"] == "pass", passes, "{document}");
        assert_eq!(document["options"].to_string().contains("\"pass\""), passes, "{document}");
    }
}

#[test]
fn a_sweep_stands_on_the_page_where_it_is_asked_for() {
    let without = words(Document::parse(&PLAIN).expect("XML").root());
    assert!(!without.contains("Other intervals between rows"));
    // The options fire the holes of a row in different ways: which of them is swept must be said.
    let (unclear, page) = report(PLAN, &["--sweep", "--nominal"]);
    assert!(unclear.status.code() != Some(0) && page.is_none(), "{}", text(&unclear.stderr));
    // Of the planned shots alone it recommends nothing: the charts stand there, and what speaks against intervals.
    let (_, page) = report(PLAN, &["--sweep", "--nominal", "--option", "20 & 0"]);
    let page = xml(&page.expect("a page"));
    let page = Document::parse(&page).expect("XML");
    let swept = section(&page, "Other intervals between rows");
    assert!(!words(swept).contains("PASS") && !words(swept).contains("0 ms to 500 ms"), "{}", words(swept));
    assert!(words(swept).contains("have holes that fire under a tire in the air"), "{}", words(swept));
    assert_eq!(swept.descendants().filter(|node| node.has_tag_name("svg")).count(), 2);
}

/// Somebody edits the plan while it is computed: what is found of the old text is no permission. The command has read the plan, and waits
/// for its second file, when the plan is edited.
#[cfg(unix)]
#[test]
fn a_plan_that_is_edited_meanwhile_passes_nowhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [plan, second, page] = ["plan.toml", "second", "page.html"].map(path);
    assert!(std::process::Command::new("mkfifo").arg(&second).status().expect("it runs").success());
    let answered = |arguments: &[&str], sent: &str, is_edited: bool| {
        std::fs::write(&plan, PLAN).expect("written");
        std::thread::scope(|scope| {
            let answer = scope.spawn(|| shelter(arguments));
            let mut pipe = std::fs::OpenOptions::new().write(true).open(&second).expect("somebody reads");
            if is_edited {
                std::fs::write(&plan, PLAN.edited("launch_m_s = 6\n", "launch_m_s = 9\n")).expect("written");
            }
            std::io::Write::write_all(&mut pipe, sent.as_bytes()).expect("sent");
            drop(pipe);
            answer.join().expect("an answer")
        })
    };
    let seen = "option,tire,quantity,value,sd\n20 & 0,2:1,flight_height_m,1,0.3\n";
    let report = ["report", &plan, "--option", "<b>", "--observed", &second, "-o", &page];
    for is_edited in [false, true] {
        let reported = answered(&report, seen, is_edited);
        assert_eq!(reported.status.code(), Some(i32::from(is_edited)), "{}", text(&reported.stderr));
        let page = std::fs::read_to_string(&page).expect("a page");
        assert_eq!(page.contains("\">To be fired"), !is_edited);
        assert_eq!(page.contains("plan.toml does not say what was judged"), is_edited);
    }
    // Beside a pipe nobody finds what was seen.
    let of_pipe = answered(&["report", &second, "--option", "<b>", "-o", &page], PLAN, false);
    assert_eq!(of_pipe.status.code(), Some(1), "{}", text(&of_pipe.stderr));
    assert!(std::fs::read_to_string(&page).is_ok_and(|page| page.contains("NOT to be fired: ")));
    let checked = answered(&["check", &plan, &second, "--any"], PLAN, true);
    let shown = text(&checked.stdout);
    assert_eq!(checked.status.code(), Some(1), "{shown}");
    assert!(shown.contains("plan.toml does not say what was judged"), "{shown}");
    assert_eq!(shown.matches("<b> passes, ").count(), 1, "the plan of the pipe alone: {shown}");
    // So does the program without a command, where output is no terminal.
    let shown = answered(&[&plan, &second], PLAN, true);
    let shown = text(&shown.stdout);
    assert!(shown.contains("plan.toml does not say what was judged"), "{shown}");
    assert_eq!(shown.matches("<b> passes, ").count(), 1, "{shown}");
}

/// Four tires in a row, each of 900 kg, over two holes beside the second one that fire one after the other; what the model counts beside
/// that of the paper.
const LISTED: &str = r#"
[shelter]
layout = "list"
tire = [{ x_m = 0, y_m = 0, mass_kg = 900 }, { x_m = 2, y_m = 0, mass_kg = 900 }, { x_m = 4, y_m = 0, mass_kg = 900 }]
cable = [{ from = 1, to = 2 }, { from = 2, to = 3 }]
[tire]
mass_kg = 280
outer_diameter_m = 1.6
restitution = 0.3
[cable]
rope = "Polyester 24"
damping_percent = 10
end_stiffness_kn_m = 300
[ground]
friction = 0.5
[simulation]
duration_s = 4
[[blast_row]]
name = "A"
holes = [{ x_m = 2.3, y_m = 0.5, launch_m_s = 2.0 }, { x_m = 1.7, y_m = -0.5, launch_m_s = 2.0 }]
[limits]
flight_height_m = 2.4
cable_safety_factor = 1.3
[[delay]]
name = "hole by hole"
at_ms = [0]
hole_interval_ms = 25
hole_order = "left"
[[delay]]
name = "at once"
at_ms = [0]
"#;

/// The page says what is laid, where each hole lies and when it fires, and what the verdict counts beside the paper's model.
#[test]
fn the_page_says_what_is_laid_where_holes_lie_and_what_is_counted() {
    let (_, page) = report(LISTED, &["--option", "hole by hole", "--samples", "200", "--seed", "7"]);
    let page = page.expect("a page");
    assert!(page.contains("3 of 900 kg"), "{page}");
    // Ordered from the right, though the list begins with the other one.
    let holes = "2 holes: (2.3, 0.5) m 2 m/s, 25 ms · (1.7, -0.5) m 2 m/s, 0 ms";
    assert!(page.contains(holes), "{page}");
    for counted in
        ["landings rebound with 0.3", "cables damped with 10 %", "300 kN/m each", "followed for 4 s"]
    {
        assert!(page.contains(counted), "{counted}:\n{page}");
    }
    let asked = "shelter trace folder/plan.toml --option='hole by hole' --seed 7 --sample";
    assert!(page.contains(asked), "{page}");
    // On the map each hole is where it was drilled, with its own time.
    let page = xml(&page);
    let document = parse(&page);
    let view = document
        .descendants()
        .find(|node| node.attribute("class").is_some_and(|class| class.starts_with("view")))
        .expect("the map");
    let circles = |is_filled: bool| {
        let all = view.descendants().filter(move |node| {
            node.has_tag_name("circle") && (node.attribute("fill") != Some("none")) == is_filled
        });
        let number = |node: &Node<'_, '_>, name: &str| -> f64 {
            node.attribute(name).and_then(|at| at.parse().ok()).unwrap_or_default()
        };
        all.map(move |node| ["cx", "cy"].map(|name| number(&node, name))).collect::<Vec<_>>()
    };
    let (holes, tires) = (&circles(true)[..2], &circles(false)[..3]);
    // 2 m lie between two tires.
    let metre = (tires[1][0] - tires[0][0]) / 2.0;
    for (hole, [x, y]) in holes.iter().zip([[-0.3, -0.5], [0.3, 0.5]]) {
        let away = [(hole[0] - tires[1][0]) / metre - x, (tires[1][1] - hole[1]) / metre - y];
        assert!(away.iter().all(|away| away.abs() < 0.02), "{holes:?} {tires:?}: a pixel is 7 mm");
        assert!(hole[1] >= 20.0, "within the picture: {hole:?}");
    }
    let said = words(view);
    assert!(!said.contains("0 + 25"), "{said}");
}

/// A page of no option has no line on which a hand could write one, and no pass in it looks tried.
#[test]
fn a_page_of_no_option_is_not_signed() {
    let (_, page) = report(LISTED, &[]);
    let page = page.expect("a page");
    assert!(
        page.contains("No option may be fired by this page") && !page.contains("div class=\"signature\""),
        "{page}"
    );
    assert!(page.contains("PASS, margin not tried"), "{page}");
}
