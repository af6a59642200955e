//! Plans that are wrong: each mistake with its line, column, message and remedy.

use std::fmt::Write;

use shelter::plan::observations::{ObservableNames, Observations};
use shelter::plan::{Plan, Time};

use super::support::{Edited, PROGRAM, output, shelter};

pub const GOOD: &str = r#"title = "T"
[shelter]
layout = "grid"
rows = 3
columns = 4
spacing_m = 1.5
[tire]
mass_kg = 280
[cable]
rope = "GOST 2688-80 6.2"
[ground]
friction = 0.5
[[blast_row]]
name = "1"
under_row = 1
launch_m_s = 6.0
[[blast_row]]
name = "2"
under_row = 2
launch_m_s = 6.0
[limits]
flight_height_m = 1.5
cable_safety_factor = 2.0
[[delay]]
name = "20 ms"
interval_ms = 20
"#;

/// What is replaced in the good plan, and by what.
pub const BAD: &[(&str, &str)] = &[
    ("rows = 3", "rows = 0"),
    ("rows = 3", "rows = -3"),
    ("rows = 3", "rows = 1000000000"),
    ("rows = 3", "rows = 99999999999999999999999999999999999999999"),
    ("rows = 3", "rows = 3.0"),
    ("rows = 3", "rows = \"3\""),
    ("rows = 3", "rows = 3000\ncolumns = 3000"),
    ("rows = 3\ncolumns = 4", "rows = 3000\ncolumns = 3000"),
    ("rows = 3\n", ""),
    ("flight_height_m = 1.5", "flight_height_m = 1.5\nslide_m = 0.5"),
    ("columns = 4", "colums = 4"),
    ("spacing_m = 1.5", "spacing_m = 0"),
    ("spacing_m = 1.5", "spacing_m = -1.5"),
    ("spacing_m = 1.5", "spacing_m = nan"),
    ("spacing_m = 1.5", "spacing_m = inf"),
    ("spacing_m = 1.5", "spacing_m = 1e400"),
    ("spacing_m = 1.5", "spacing_m = 1e-320"),
    ("spacing_m = 1.5", "spacing_m = { row = 1.5 }"),
    ("spacing_m = 1.5", "spacing_m = { row = 1.5, column = 1, diagonal = 2 }"),
    ("spacing_m = 1.5", "spacing_m = [1.5]"),
    ("spacing_m = 1.5", "spacing_m = 1.5\nlinks = [\"row\", \"diag\"]"),
    ("spacing_m = 1.5", "spacing_m = 1.5\nlinks = \"row\""),
    ("layout = \"grid\"", "layout = \"gird\""),
    ("layout = \"grid\"", "layout = 3"),
    ("layout = \"grid\"\n", ""),
    ("layout = \"grid\"\nrows = 3", "layout = \"quincunx\"\nrows = 1"),
    ("layout = \"grid\"", "layout = \"list\""),
    ("mass_kg = 280", "mass_kg = 0"),
    ("mass_kg = 280", "mass_kg = -280"),
    ("mass_kg = 280", "mass = 280"),
    ("mass_kg = 280", "mass_kg = 280\nouter_diameter_m = 1.5"),
    ("mass_kg = 280", "mass_kg = \"280 kg\""),
    ("mass_kg = 280", "mass_kg = 1979-05-27"),
    ("[tire]\nmass_kg = 280\n", ""),
    ("[tire]", "[tyre]"),
    ("[tire]", "[[tire]]"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6,2\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"hemp\""),
    ("rope = \"GOST 2688-80 6.2\"", "axial_stiffness_kn = 1519"),
    ("rope = \"GOST 2688-80 6.2\"", "breaking_force_kn = 20"),
    ("rope = \"GOST 2688-80 6.2\"", ""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\nbreaking_force_kn = 20"),
    ("rope = \"GOST 2688-80 6.2\"", "axial_stiffness_kn = -1\nbreaking_force_kn = 0"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\ntermination = \"glue\""),
    (
        "rope = \"GOST 2688-80 6.2\"",
        "rope = \"GOST 2688-80 6.2\"\ntermination = \"clips\"\ntermination_percent = 80",
    ),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\ntermination = \"swaged socket\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\ntermination = \"knot\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"EN 818-2 6\"\ntermination = \"clips\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"Polyester 12\"\ntermination = \"mechanical sleeve\""),
    ("[ground]", "termination = \"clips\"\n[size]\nropes = \"EN 818-2\"\n[ground]"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\ntermination_percent = 101"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\nslack_percent = -2"),
    ("friction = 0.5", "friction = -0.1"),
    ("friction = 0.5", "friction = +nan"),
    ("friction = 0.5", "friction = true"),
    ("friction = 0.5", "friction = 0.5\nfriction = 0.6"),
    ("friction = 0.5", "friction 0.5"),
    ("friction = 0.5", "friction = "),
    ("under_row = 1\n", "under_row = 4\n"),
    ("under_row = 1\n", "under_row = 1.5\n"),
    ("under_row = 1\n", "under_row = 0\n"),
    ("under_row = 1\n", ""),
    ("under_row = 1\n", "under_tires = [1]\n"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = []"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 1, y_m = nan, launch_m_s = 6 }]"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 1, y_m = 2 }, 7]"),
    ("under_row = 1\n", "under_row = 1\nholes = [{ x_m = 1, y_m = 1, launch_m_s = 6 }]\n"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = -6.0\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 1e9\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 0\n[[blast_row]]"),
    (
        "under_row = 1\nlaunch_m_s = 6.0",
        "tilt_deg = 10\nfree_flight_height_m = 1.8\nholes = [{ x_m = 1, y_m = 1, launch_m_s = 6 }]",
    ),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 503221, y_m = 6112233, launch_m_s = 6 }]"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = -1.6, y_m = 1, launch_m_s = 6 }]"),
    ("friction = 0.5", "friction = 0.2\nslope_percent = 25"),
    ("friction = 0.5", "friction = 0.5\nslope_percent = 45\n[uncertainty]\nfriction = [0.4, 0.6]"),
    ("mass_kg = 280", "mass_kg = 280\nrestitution = 0.3\n[simulation]\nmethod = \"newmark\""),
    ("mass_kg = 280", "mass_kg = 280\nrestitution = 1"),
    ("[[blast_row]]", "[simulation]\nmethod = \"newmark\"\n[[blast_row]]\npush_ms = 20"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 1.5\npush_ms = 150\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "free_flight_height_m = 1.8\npush_ms = 20\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "free_flight_height_m = 1.8\ntilt_deg = 20\n[[blast_row]]"),
    ("[cable]", "[simulation]\nmethod = \"newmark\"\n[cable]\ndamping_percent = 5"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 6.0\npush_ms = 500\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 6\nfree_flight_height_m = 1.8\n[[blast_row]]"),
    ("name = \"2\"", "name = \"1\""),
    ("name = \"2\"", "name = 2"),
    ("name = \"2\"\n", ""),
    ("[[blast_row]]\nname = \"2\"\nunder_row = 2\nlaunch_m_s = 6.0\n", "blast_row = 3\n"),
    ("flight_height_m = 1.5", "flight_height_m = 0"),
    ("flight_height_m = 1.5", "flight_heigth_m = 1.5"),
    ("cable_safety_factor = 2.0", "cable_safety_factor = -2.0"),
    ("[limits]\nflight_height_m = 1.5\ncable_safety_factor = 2.0\n", ""),
    ("[[delay]]\nname = \"20 ms\"\ninterval_ms = 20\n", ""),
    ("interval_ms = 20", "interval_ms = -20"),
    ("interval_ms = 20", "interval_s = 0.02"),
    ("interval_ms = 20", "interval_ms = 20\norder = [\"2\"]"),
    ("interval_ms = 20", "interval_ms = 20\norder = [\"2\", \"2\"]"),
    ("interval_ms = 20", "interval_ms = 20\norder = [\"2\", \"3\"]"),
    ("interval_ms = 20", "order = [\"2\", \"1\"]"),
    ("interval_ms = 20", "at_ms = [0]"),
    ("interval_ms = 20", "at_ms = [0, -5]"),
    ("interval_ms = 20", "at_ms = [0, inf]"),
    ("interval_ms = 20", "at_ms = [0, 20]\ninterval_ms = 20"),
    ("interval_ms = 20", "at_ms = 20"),
    ("interval_ms = 20", "interval_ms = 20\n[[delay]]\nname = \"20 ms\"\ninterval_ms = 25"),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\naccuracy = \"fine\""),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\nmethod = \"euler\""),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\nduration_s = 0"),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\ngravity = 9.81"),
    ("interval_ms = 20", "interval_ms = 20\n[weather]\nrain = true"),
    ("title = \"T\"", "title = 5"),
    ("title = \"T\"", "title = \"T"),
    ("title = \"T\"", "title = \"T\"\ntitle = \"U\""),
    ("title = \"T\"", "titel = \"T\""),
    ("title = \"T\"", "title = \"\\q\""),
    ("title = \"T\"", "title = T"),
    ("title = \"T\"", "title = [\"T\"]"),
    ("title = \"T\"", "\u{0}title = \"T\""),
    ("[shelter]", "[shelter"),
    ("[shelter]", "[Shelter]"),
    ("[shelter]", "[shelter]\n[shelter]"),
    ("[shelter]", "shelter = 5\n[roof]"),
    ("rows = 3", "rows = 1_0_"),
    ("rows = 3", "rows = 0x"),
    ("rows = 3", "rows = true"),
    ("rows = 3", "rows = []"),
    ("rows = 3", "rows = 3\nborder_rows = -1"),
    ("rows = 3", "rows = 3\nborder_rows = 1e3"),
    ("rows = 3", "rows = 3\nborder_rows = 5000"),
    ("columns = 4", "columns = 0"),
    ("columns = 4", "columns = 4\ncolumns_m = 4"),
    ("spacing_m = 1.5", "spacing_m = \"1.5\""),
    ("spacing_m = 1.5", "spacing_m = { row = 0, column = 1.5 }"),
    ("spacing_m = 1.5", "spacing_m = { row = nan, column = 1.5 }"),
    ("spacing_m = 1.5", "spacing_m = {}"),
    ("spacing_m = 1.5", "spacing_m = 1.5\nlinks = [1]"),
    ("mass_kg = 280", "mass_kg = nan"),
    ("mass_kg = 280", "mass_kg = 1e300"),
    ("mass_kg = 280", "mass_kg = 280\nouter_diameter_m = -1"),
    ("mass_kg = 280", "mass_kg = 280\nouter_diameter_m = nan"),
    ("mass_kg = 280", "mass_kg = 280\ncolour = \"black\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = 6.2"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"\""),
    ("rope = \"GOST 2688-80 6.2\"", "axial_stiffness_kn = nan\nbreaking_force_kn = 20"),
    ("rope = \"GOST 2688-80 6.2\"", "axial_stiffness_kn = 1e300\nbreaking_force_kn = 20"),
    ("rope = \"GOST 2688-80 6.2\"", "axial_stiffness_kn = 1519\nbreaking_force_kn = inf"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\non_overload = \"snap\""),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\nslack_percent = 1e9"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\nslack = 2"),
    ("rope = \"GOST 2688-80 6.2\"", "rope = \"GOST 2688-80 6.2\"\ntermination_percent = 0"),
    ("friction = 0.5", "friction = inf"),
    ("friction = 0.5", "mu = 0.5"),
    ("name = \"1\"", "name = \"1\\u001b[31m\""),
    ("friction = 0.5", "friction = 0,5"),
    ("under_row = 1\n", "under_row = -1\n"),
    ("under_row = 1\n", "under_row = \"1\"\n"),
    ("under_row = 1\n", "under_tires = []\n"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 1 }]"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 1, y_m = 1, launch_m_s = -6 }]"),
    ("under_row = 1\nlaunch_m_s = 6.0", "holes = [{ x_m = 1, y_m = 1, launch_m_s = 6, depth_m = 3 }]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = nan\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_kmh = 20\n[[blast_row]]"),
    ("launch_m_s = 6.0\n[[blast_row]]", "free_flight_height_m = -1\n[[blast_row]]"),
    ("flight_height_m = 1.5", "flight_height_m = nan"),
    ("flight_height_m = 1.5", "flight_height_m = 1.5\ndrift_m = 0"),
    ("flight_height_m = 1.5", "flight_height_m = 1.5\ndrift_m = -1"),
    ("cable_safety_factor = 2.0", "cable_safety_factor = 0"),
    ("cable_safety_factor = 2.0", "cable_safety_factor = \"2\""),
    ("cable_safety_factor = 2.0\n", ""),
    ("interval_ms = 20", "interval_ms = nan"),
    ("interval_ms = 20", "interval_ms = 1e12"),
    ("interval_ms = 20", "interval_ms = \"20 ms\""),
    ("interval_ms = 20", ""),
    ("interval_ms = 20", "interval_ms = 20\norder = \"2, 1\""),
    ("interval_ms = 20", "interval_ms = 20\norder = [2, 1]"),
    ("interval_ms = 20", "at_ms = [0, 5, 10]"),
    ("interval_ms = 20", "at_ms = []"),
    ("interval_ms = 20", "at_ms = [0, \"5\"]"),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\nduration_s = inf"),
    ("interval_ms = 20", "interval_ms = 20\n[simulation]\nduration_s = 1e9"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\ndetonator = \"fuse\""),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nlaunch_cv_percent = -5"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nfriction = [0.5, 0.3]"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nfriction = 0.5"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nfriction = [-0.1, 0.5]"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nslack_percent = [0, 1, 2]"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\naxial_stiffness_percent = [-100, 0]"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nlaunch_tilt_deg = 60\ntire_mass_cv_percent = 101"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\ndetonator = \"electronic\"\ndelay_sd_ms = 1"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nmass_cv_percent = 10"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nlaunch_between_shots_percent = -5"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nlaunch_mass_exponent = [1, 0]"),
    ("interval_ms = 20", "interval_ms = 20\n[uncertainty]\nlaunch_mass_exponent = [0, 2]"),
    ("interval_ms = 20", "interval_ms = 20\n[scatter]\ndetonator = \"electronic\""),
    ("cable_safety_factor = 2.0", "cable_safety_factor = 2.0\naccepted_risk_percent = 0"),
    ("cable_safety_factor = 2.0", "cable_safety_factor = 2.0\naccepted_risk_percent = 51"),
    (
        "launch_m_s = 6.0\n[[blast_row]]",
        "launch_m_s = 6.0\ntilt_deg = 90\ntilt_toward_deg = 400\n[[blast_row]]",
    ),
    ("launch_m_s = 6.0\n[[blast_row]]", "launch_m_s = 6.0\ntilt_toward_deg = 45\n[[blast_row]]"),
    ("interval_ms = 20", "interval_ms = 20\n[size]\nropes = \"GOST 1\""),
    ("interval_ms = 20", "interval_ms = 20\n[size]\ntire_mass_kg = [280, -1]"),
];

#[test]
fn every_mistake_has_its_place_and_remedy() {
    let mut all = String::new();
    for (good, bad) in BAD {
        assert!(GOOD.contains(good), "{good:?} is in the good plan");
        let text = GOOD.replacen(good, bad, 1);
        let mistakes = Plan::parse("plan.toml", &text).expect_err(bad);
        let _ = writeln!(all, "## {}", bad.replace('\n', " / "));
        for (line, column, message, remedy) in mistakes.iter() {
            let _ = writeln!(all, "{line}:{column} {message}\n    {remedy}");
        }
    }
    insta::assert_snapshot!(all);
}

const LIST: &str = r#"[shelter]
layout = "list"
[[shelter.tire]]
x_m = 0
y_m = 0
[[shelter.tire]]
x_m = -0.0
y_m = 0
[[shelter.tire]]
x_m = 2
y_m = 0
colour = "black"
[[shelter.cable]]
from = 1
to = 1
[[shelter.cable]]
from = 1
to = 9
[[shelter.cable]]
from = 1
to = 3
[[shelter.cable]]
from = 3
to = 1
[tire]
mass_kg = 280
outer_diameter_m = 2.0
[cable]
rope = "EN 818-2 6"
[ground]
friction = 0.5
[[blast_row]]
name = "1"
under_row = 1
launch_m_s = 6
[[blast_row]]
name = "2"
under_tires = [1, 9, 1]
launch_m_s = 6
[limits]
flight_height_m = 1
cable_safety_factor = 2
[[delay]]
name = "a"
interval_ms = 20
"#;

#[test]
fn all_mistakes_of_a_plan_are_told_at_once() {
    let mistakes = Plan::parse("list.toml", LIST).expect_err("full of mistakes");
    insta::assert_snapshot!(mistakes.render(false));
}

/// Names that nobody can tell apart are refused with both and their lines; what nobody sees around a name does not count.
#[test]
fn names_that_look_alike_are_refused() {
    let other = |name: &str| format!("{GOOD}[[delay]]\nname = \"{name}\"\ninterval_ms = 25\n");
    for same in ["20 ms ", " 20 ms", "20 ms\u{a0}", "20 ms\u{200b}", "\u{feff}20 ms\u{2003}"] {
        let told = mistakes_of(&other(same));
        assert!(
            told.contains("two delay options are named \"20 ms\", this one and that of line 25"),
            "{told}"
        );
        assert!(told.contains("plan.toml:28:8"), "{told}");
    }
    for (alike, letter) in [
        ("20 m\u{455}", "\"\u{455}\" is U+0455 here"),
        ("2O ms", "\"O\" is U+004F here"),
        ("20\u{a0}ms", "is U+00A0 here"),
        ("20\u{200b} ms", "is U+200B here"),
        ("20  ms", "takes for the other"),
    ] {
        let told = mistakes_of(&other(alike));
        let message = "\" looks like \"20 ms\" of line 25";
        assert!(told.contains(message) && told.contains("plan.toml:28:8"), "{told}");
        assert!(told.contains(letter), "{told}");
    }
    let rows = GOOD.edited("name = \"2\"", "name = \"l\"");
    let told = mistakes_of(&rows);
    assert!(told.contains("the blast row \"l\" looks like \"1\" of line 14"), "{told}");
    assert!(told.contains("plan.toml:18:8"), "{told}");
    let empty = GOOD.edited("\"20 ms\"", "\"\u{200b}\u{a0}\"");
    assert!(mistakes_of(&empty).contains("`name` is empty"));
}

fn mistakes_of(text: &str) -> String {
    Plan::parse("plan.toml", text).map(|_| ()).expect_err("a mistake").render(false)
}

/// A name is what people see of it: in the plan, in an order, on the command line and in a file of observations.
#[test]
fn names_are_read_as_people_see_them() {
    let text = GOOD
        .edited("name = \"20 ms\"", "order = [\"2\", \"1\\u00A0\"]\nname = \" 20\u{a0}ms\u{200b} \"")
        .edited("name = \"1\"", "name = \"1 \"");
    let plan = Plan::parse("plan.toml", &text).expect("a plan");
    assert_eq!(plan.blast_rows[0].name, "1");
    assert_eq!(plan.delays[0].name, "20\u{a0}ms");
    assert_eq!(plan.delays[0].timing.fire_at(), [20.0, 0.0].map(Time::from_ms));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let more = "[[delay]]\nname = \"42 ms\"\ninterval_ms = 42\n";
    std::fs::write(&path, format!("{text}{more}")).expect("written");
    let path = path.to_str().expect("UTF-8");
    let flown = |option: &str| shelter(&["trace", path, "--accuracy", "draft", "--option", option]);
    let first = flown("20\u{a0}ms");
    assert!(first.status.success());
    for typed in ["20 ms", " 20 ms ", "20 ms\u{200b}", "20ms", "20"] {
        assert_eq!(flown(typed).stdout, first.stdout, "{typed:?}");
    }
    assert_ne!(flown("42 ms").stdout, first.stdout);
    assert_eq!(flown("21 ms").status.code(), Some(2));
    let known = ObservableNames {
        options: vec![plan.delays[0].name.clone(), "42 ms".to_owned()],
        tires: vec![vec![1.0, 1.0]],
        cables: Vec::new(),
        holes: Vec::new(),
    };
    let table = "option,tire,quantity,value,sd\n20 ms,1:1,flight_height_m,1,0.1\n";
    let seen = Observations::parse("seen.csv", table, &known).expect("observations");
    assert_eq!(seen.list[0].option, 0);
}

#[test]
fn of_thousands_of_mistakes_the_first_are_shown() {
    let page = "<p>no plan</p>\n".repeat(1000);
    let shown = Plan::parse("page.html", &page).expect_err("no plan").render(false);
    assert!(shown.lines().count() < 200, "{}", shown.lines().count());
    assert!(shown.contains("more mistakes in page.html"));
}

#[test]
fn what_is_no_plan_at_all_says_so() {
    let first = |text: &str| {
        let mistakes = Plan::parse("plan.toml", text).expect_err("no plan");
        let (line, column, message, _) = mistakes.iter().next().expect("has a mistake");
        format!("{line}:{column} {message}")
    };
    let deep = "a = ".to_owned() + &"[".repeat(500);
    let texts = ["", "\u{feff}", "\0", "%PDF-1.4", "{\"rows\": 5}", "= = =", deep.as_str()];
    insta::assert_snapshot!(texts.map(first).join("\n"));
}

/// Command lines that are wrong, in a folder with a good plan and a list of holes.
const COMMANDS: &[&[&str]] = &[
    &["chek", "plan.toml"],
    &["check"],
    &["check", "none.toml"],
    &["check", "plan.toml", "none.toml"],
    &["check", "."],
    &["check", "plan.toml", "--format", "xml"],
    &["check", "plan.toml", "--accuracy", "fine"],
    &["check", "plan.toml", "--method", "euler"],
    &["check", "plan.toml", "--dt", "0"],
    &["check", "plan.toml", "--dt", "-1e-3"],
    &["check", "plan.toml", "--dt", "nan"],
    &["check", "plan.toml", "--dt", "inf"],
    &["check", "plan.toml", "--dt", "1ms"],
    &["check", "plan.toml", "--threads", "0"],
    &["check", "plan.toml", "--threads", "100000"],
    &["check", "plan.toml", "--treads", "2"],
    &["check", "plan.toml", "--color", "blue"],
    &["trace", "plan.toml", "--option", "none"],
    &["accuracy", "plan.toml", "--option", "none"],
    &["sweep", "plan.toml", "--interval", "0..500"],
    &["sweep", "plan.toml", "--interval", "500..0:5"],
    &["sweep", "plan.toml", "--interval", "0..500:0"],
    &["sweep", "plan.toml", "--interval", "0..1e6:1e-6"],
    &["sweep", "plan.toml", "--interval", "-5..10:1"],
    &["size", "plan.toml", "--any-order", "--interval", "-5..10:1"],
    &["orders", "plan.toml", "--shard", "3/2"],
    &["orders", "plan.toml", "--shard", "0/2"],
    &["orders", "plan.toml", "--shard", "half"],
    &["risk", "plan.toml", "--samples", "many"],
    &["risk", "plan.toml", "--seed", "-1"],
    &["report", "plan.toml"],
    &["report", "plan.toml", "-o", "none/page.html"],
    &["merge"],
    &["report", "plan.toml", "-o", "plan.toml"],
    &["size", "plan.toml", "--nominal", "--samples", "10"],
    &["size", "plan.toml", "--option", "none"],
    &["effects", "plan.toml", "--option", "none"],
    &["merge", "none.jsonl"],
    &["merge", "plan.toml"],
    &["init", "plan.toml"],
    &["init", "new.toml", "--from", "none.csv"],
    &["init", "new.toml", "--from", "plan.toml"],
    &["init", "new.toml", "--directions"],
    &["ropes", "plan.toml"],
    &["completions", "tcsh"],
    &["plan.toml", "extra.toml", "third.toml"],
];

/// Each ends with 2, says what is wrong on standard error, and writes nothing.
#[test]
fn every_wrong_command_line_is_explained() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("plan.toml"), GOOD).expect("written");
    let mut all = String::new();
    for arguments in COMMANDS {
        let mut command = std::process::Command::new(PROGRAM);
        let output = output(command.args(*arguments).current_dir(folder.path()));
        let told = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        let _ = writeln!(all, "## shelter {}\n{}\n", arguments.join(" "), told.trim_end());
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1, "nothing is written");
    insta::assert_snapshot!(all);
}

/// A plan may be piped, named, or come with line ends and marks of other systems.
#[test]
fn odd_files_are_read_or_refused_with_a_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let load = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("written");
        Plan::load(&path)
    };
    assert!(load(GOOD.replace('\n', "\r\n").as_bytes()).is_ok(), "CRLF");
    assert!(load(format!("\u{feff}{GOOD}").as_bytes()).is_ok(), "a byte order mark");
    let large = format!("{GOOD}\n#{}", "x".repeat(100 << 20));
    let told = load(large.as_bytes()).expect_err("100 MB").render(false);
    assert!(told.contains("MB") || told.contains("large"), "{told}");
}

#[test]
fn files_that_cannot_be_read_name_the_path_and_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let told = |path: &std::path::Path| Plan::load(path).expect_err("unreadable").render(false);
    assert!(told(&path).contains("cannot read the file"), "missing");
    assert!(told(&path).contains("shelter init"), "missing: the remedy");
    assert!(told(folder.path()).contains("it is a folder"), "a folder");
    std::fs::write(&path, b"title = \"\xff\"").expect("written");
    assert!(told(&path).contains("not UTF-8"), "not UTF-8");
}
