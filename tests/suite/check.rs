//! `shelter check`, `trace`, `init`, `ropes` as scripts use them: exit status, streams, JSON, CSV.

use std::io::{BufRead, BufReader};
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;

use shelter::plan::starter::RIGID_ENDS;

use super::support::{
    Edited, PROGRAM, ended, json, shelter, small_plan, small_plan_in, small_plan_of, tested_plan, text,
    within,
};

/// `check --any` on a plan of two options, of which one passes, as text.
static ONE_PASSES: LazyLock<Output> = LazyLock::new(|| {
    let text =
        small_plan_of(&["20 ms"]).edited("14 1960", "15 1960").edited("height_m = 2.35", "height_m = 2.7");
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), text).expect("written");
    shelter(&["check", file.path().to_str().expect("UTF-8"), "--any"])
});

/// A command on [`small_plan`].
fn on_small(arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().expect("a folder");
    shelter(&[&arguments[..1], &[&small_plan_in(folder.path())], &arguments[1..]].concat())
}

fn on(name: &str, arguments: &[&str]) -> Output {
    let path = tested_plan(name);
    let mut all = vec![arguments[0], &path];
    all.extend(&arguments[1..]);
    shelter(&all)
}

#[test]
fn the_exit_status_tells_the_verdict() {
    assert_eq!(on("paper-5-tire.toml", &["check"]).status.code(), Some(0));
    assert_eq!(on("amur-three-rows.toml", &["check", "--nominal"]).status.code(), Some(1));
    assert_eq!(ONE_PASSES.status.code(), Some(0));
    assert_eq!(shelter(&["check", "no-such-plan.toml"]).status.code(), Some(2));
    assert_eq!(on("paper-5-tire.toml", &["check", "--dt", "-1"]).status.code(), Some(2));
    assert_eq!(on("paper-5-tire.toml", &["check", "--accurracy", "field"]).status.code(), Some(2));
}

/// A run that ends before all has happened passes nothing, though it may fail.
#[test]
fn a_run_that_ends_early_is_no_pass() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let text = std::fs::read_to_string(tested_plan("paper-5-tire.toml")).expect("a plan");
    let (head, _) = text.split_once("[simulation]").unwrap_or((&text, ""));
    let check = |delay: &str, duration: &str| {
        let text = format!("{head}\n{delay}\n[simulation]\nduration_s = {duration}\n");
        std::fs::write(&path, text).expect("written");
        let output = shelter(&["check", "--nominal", path.to_str().expect("UTF-8"), "--format", "json"]);
        let document = json(&output);
        let last = document["options"].as_array().expect("options").last().expect("one").clone();
        (last["verdict"].clone(), last["reasons"].to_string())
    };
    let late = "[[delay]]\nname = \"late\"\nat_ms = [700]\n";
    // The tire rises until 0.31 s and the hole of the second option fires at 0.7 s.
    for (delay, duration, reason) in
        [("", "0.1", "tires in the air"), (late, "0.6", "before the last hole fires at 0.700 s")]
    {
        let (verdict, reasons) = check(delay, duration);
        assert_eq!(verdict, "undecided", "{reasons}");
        assert!(reasons.contains(reason), "{reasons}");
    }
    assert_eq!(check("", "1.0").0, "pass");
    assert_eq!(check(late, "1.7").0, "pass");
}

/// Without friction the shelter never comes to rest, and its cables may pull harder than they did so far.
#[test]
fn tires_that_still_move_are_no_pass() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let text = std::fs::read_to_string(tested_plan("paper-5-tire.toml")).expect("a plan");
    for (friction, duration, open) in [("0", "", true), ("0.5", "", false), ("0", "duration_s = 2.0", true)] {
        let text = text.edited("friction = 0.5", &format!("friction = {friction}"));
        let text = text.edited("breaking_force_kn = 20.4", "breaking_force_kn = 1e6");
        std::fs::write(&path, text.edited("duration_s = 1.0", duration)).expect("written");
        let output = shelter(&["check", "--nominal", path.to_str().expect("UTF-8"), "--format", "json"]);
        for option in json(&output)["options"].as_array().expect("options") {
            let reasons = option["reasons"].to_string();
            assert_eq!(option["verdict"], if open { "undecided" } else { "pass" }, "{reasons}");
            assert_eq!(reasons.contains("tires still move"), open, "{reasons}");
        }
    }
}

/// Cables of 0.1 mm between rims are so stiff that a long step loses energy; such a run passes nothing, and is refined where
/// the step is not fixed.
#[test]
fn a_run_that_loses_energy_is_no_pass() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let text = std::fs::read_to_string(tested_plan("paper-5-tire.toml")).expect("a plan");
    let text = text.edited("breaking_force_kn = 20.4", "breaking_force_kn = 1e6");
    std::fs::write(&path, text.edited("mass_kg = 280", "mass_kg = 280\nouter_diameter_m = 0.9999"))
        .expect("written");
    let mut gated = 0;
    for step in ["1e-4", "5e-5", "2e-5", "1e-5", "5e-6", "2e-6"] {
        let output =
            shelter(&["check", "--nominal", path.to_str().expect("UTF-8"), "--dt", step, "--format", "json"]);
        for option in json(&output)["options"].as_array().into_iter().flatten() {
            let residual = option["energy_residual"].as_f64().unwrap_or(0.0);
            if residual > 0.01 {
                gated += 1;
                assert_ne!(option["verdict"], "pass");
                assert!(option["reasons"].to_string().contains("energy balance"), "{}", option["reasons"]);
            }
        }
    }
    assert!(gated > 0, "no run lost energy");
}

/// Four tires thrown up four times: the greatest force is that of a peak at 1.9 s, which long steps make smaller than an
/// earlier one. An independent integrator finds 98,248 N; the limit is 96,370 N.
#[test]
fn a_later_peak_that_long_steps_make_too_small_is_not_passed() {
    let tires = [(0.315, -0.24, 273.8), (1.398, 0.198, 218.3), (0.164, 1.439, 318.8), (2.038, 2.066, 284.5)];
    let tire = tires.map(|(x, y, mass)| format!("{{ x_m = {x}, y_m = {y}, mass_kg = {mass} }}")).join(", ");
    let ties = [(1, 2), (1, 3), (1, 4), (2, 3), (2, 4), (3, 4)];
    let cable = ties.map(|(from, to)| format!("{{ from = {from}, to = {to} }}")).join(", ");
    let rows = [("[1, 3, 4]", "8.06"), ("[2, 3]", "3.63"), ("[2]", "6.28"), ("[2, 3, 4]", "7.8")];
    let rows = rows.map(|(under, launch)| {
        format!("{{ name = \"{under} {launch}\", under_tires = {under}, launch_m_s = {launch} }}")
    });
    let rows = rows.join(", ");
    let text = format!(
        "shelter = {{ layout = \"list\", tire = [{tire}], cable = [{cable}] }}
tire = {{ mass_kg = 280, outer_diameter_m = 0 }}
cable = {{ axial_stiffness_kn = 1019.0874835450848, breaking_force_kn = 96.3703, slack_percent = 2 }}
ground = {{ friction = 1.176 }}
blast_row = [{rows}]
limits = {{ flight_height_m = 1000, cable_safety_factor = 1 }}
delay = [{{ name = \"a\", at_ms = [0, 124.08630344008347, 248.17260688016694, 372.2589103202504] }}]
"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    std::fs::write(&path, text).expect("written");
    for level in ["draft", "field", "reference"] {
        let output = shelter(&[
            "check",
            "--nominal",
            path.to_str().expect("UTF-8"),
            "--accuracy",
            level,
            "--format",
            "json",
        ]);
        assert_eq!(json(&output)["verdict"], "fail", "{level}");
    }
}

const TWO_TIRES: &str = r#"
shelter = { layout = "list", tire = [{ x_m = 0, y_m = 0 }, { x_m = 5, y_m = 0 }, { x_m = 10, y_m = 0 }], cable = [{ from = 1, to = 2 }] }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1400, breaking_force_kn = 400 }
ground = { friction = 0.5 }
blast_row = [{ name = "low", under_tires = [1], launch_m_s = 5 }, { name = "high", under_tires = [3], launch_m_s = 8 }]
limits = { flight_height_m = 2, cable_safety_factor = 1 }
"#;

/// The second hole lifts its tire over the limit, but the run ends before that is seen.
#[test]
fn what_is_still_to_come_is_not_passed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let verdict = |late_ms: f64, duration: &str, method: &str| {
        let delay = format!("delay = [{{ name = \"a\", at_ms = [0, {late_ms}] }}]\n");
        std::fs::write(&path, format!("{TWO_TIRES}{delay}{duration}")).expect("written");
        let output = shelter(&[
            "check",
            "--nominal",
            path.to_str().expect("UTF-8"),
            "--method",
            method,
            "--format",
            "json",
        ]);
        json(&output)["verdict"].as_str().expect("a verdict").to_owned()
    };
    for method in ["verlet", "newmark"] {
        // Everything lies still before the second hole; the second tire rises below what the first has reached.
        assert_eq!(verdict(4000.0, "simulation = { duration_s = 3.5 }", method), "undecided");
        assert_eq!(verdict(400.0, "simulation = { duration_s = 0.55 }", method), "undecided");
        assert_eq!(verdict(400.0, "", method), "fail");
    }
}

/// A cable that breaks never pulled harder than it can, and no limit makes a pass of it.
#[test]
fn broken_cables_fail_at_their_breaking_force() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let text = std::fs::read_to_string(tested_plan("paper-5-tire.toml")).expect("a plan");
    for factor in ["1.0", "1.3", "5.0"] {
        let text = text
            .edited("[cable]\n", "[cable]\non_overload = \"break\"\n")
            .edited("breaking_force_kn = 20.4", "breaking_force_kn = 15")
            .edited("cable_safety_factor = 1.0", &format!("cable_safety_factor = {factor}"));
        std::fs::write(&path, &text).expect("written");
        for method in ["verlet", "newmark"] {
            let output = shelter(&[
                "check",
                "--nominal",
                path.to_str().expect("UTF-8"),
                "--method",
                method,
                "--format",
                "json",
            ]);
            let option = json(&output)["options"][0].clone();
            assert_eq!(option["verdict"], "fail", "{factor} {method}: {text}");
            assert_eq!(option["cable_force_n"]["value"], 15e3, "{factor} {method}");
            assert!(option["reasons"].to_string().contains("4 cables break"), "{}", option["reasons"]);
        }
    }
}

#[test]
fn an_error_leaves_standard_output_empty() {
    let output = shelter(&["check", "no-such-plan.toml", "--format", "json"]);
    assert!(output.stdout.is_empty());
    assert!(text(&output.stderr).contains("no-such-plan.toml"));
}

#[test]
fn json_has_the_fields_scripts_read() {
    let output = on("paper-5-tire.toml", &["check", "--nominal", "--format", "json", "--dt", "2e-4"]);
    let document = json(&output);
    let told = text(&output.stderr);
    assert!(told.starts_with("warning: the launch velocity is taken as known to 0 %"), "{told}");
    assert!(told.contains("cables run from centre to centre, as `outer_diameter_m` is 0"), "{told}");
    // Who lets a script release a shot must know what a human would have to tick; nobody can know that of the planned shot alone, either.
    let boxes = document["to_be_confirmed"].as_array().expect("what is to be confirmed");
    assert!(boxes.iter().any(|line| line == "cable_safety_factor = 1: usual are 1.2 to 20"), "{boxes:?}");
    assert!(document["options"][0]["turned_flight_height_m"].is_null(), "cables from centre to centre");
    let factor = "`cable_safety_factor = 1` of [limits] is unusual";
    assert!(told.contains(factor) && told.lines().count() == 3, "{told}");
    assert_eq!(document["schema"], "shelter.check/2");
    assert_eq!((&document["verdict"], &document["judged"]), (&"pass".into(), &"nominal".into()));
    assert_eq!(document["scene"]["tires"], 5);
    assert_eq!(document["scene"]["cables"], 8);
    let option = &document["options"][0];
    assert_eq!(option["name"], "single hole");
    assert_eq!(option["fire_at_s"][0], 0.0);
    assert_eq!(option["dt_s"], 2e-4);
    assert_eq!(option["method"], "verlet");
    assert_eq!(option["flight_height_m"]["tire"], serde_json::json!([1.5, 1.5]));
    // Of four mirror images, which holds the maximum is decided by rounding.
    assert_eq!(option["cable_force_n"]["cable"].as_array().map(Vec::len), Some(2));
    for field in ["value", "error", "at_s"] {
        assert!(option["flight_height_m"][field].is_f64() && option["cable_force_n"][field].is_f64());
    }
    for field in ["cable_safety_factor", "energy_residual", "wall_s", "total_wall_s"] {
        assert!(option[field].is_f64(), "{field}");
    }
    assert!(option["steps"].is_u64() && option["runs"].is_u64());
    assert_eq!(option["nominal_verdict"], "pass");
    for field in ["failure_probability", "any_cable_breaks", "launch_margin", "inputs"] {
        assert!(option[field].is_null(), "{field}");
    }
}

/// Beside the shot as planned: the probability of failure, bands, margin and shares. The paper's plan does not say what is
/// not known, the one of three rows does.
#[test]
fn json_tells_the_risk() {
    let arguments = ["check", "--format", "json", "--samples", "250", "--seed", "2"];
    let assumed = on("five-tires-assumed.toml", &arguments);
    for (output, judged) in [(assumed, "default"), (on_small(&arguments), "plan")] {
        let document = json(&output);
        assert_eq!(document["judged"], judged);
        for option in document["options"].as_array().expect("options") {
            let failures = &option["failure_probability"];
            let number = |value: &serde_json::Value| value.as_f64().expect("a number");
            assert!(number(&failures["low"]) < number(&failures["high"]), "{failures}");
            assert!((200..=250).contains(&failures["samples"].as_u64().expect("a count")));
            assert_eq!(failures["undecided"], 0);
            for quantity in ["flight_height_m", "cable_force_n"] {
                let [low, middle, high] = ["p05", "p50", "p95"].map(|key| number(&option[quantity][key]));
                assert!(low < middle && middle < high, "{quantity}");
            }
            assert!(option["drift_m"]["p50"].is_null(), "a drift without a limit has no band");
            assert!(number(&option["any_cable_breaks"]["high"]) <= 1.0);
            assert!(option["launch_margin"].is_number());
            let shares = option["inputs"].as_array().expect("shares");
            let shares: Vec<f64> = shares.iter().map(|input| number(&input["share"])).collect();
            assert_eq!(shares.len(), 9);
            assert!(shares.windows(2).all(|pair| pair[0] >= pair[1]), "largest first");
        }
    }
}

/// What the text says a verdict is about.
#[test]
fn the_text_says_what_was_judged() {
    let said = |plan: &str, arguments: &[&str]| text(&on(plan, arguments).stdout).to_owned();
    let nominal = said("amur-three-rows.toml", &["check", "--nominal"]);
    assert!(
        nominal.contains("options pass (the plan's own numbers only: no permission to fire)"),
        "{nominal}"
    );
    let usual = said("five-tires-assumed.toml", &["check"]);
    assert!(
        usual.contains("PASS, slide NOT checked: 1 of 1 options pass (inputs assumed: see `shelter assumptions`) · verlet"),
        "{usual}"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let assumed = folder.path().join("assumed.toml");
    let plan = super::hole_by_hole::plan(2, "", "", "interval_ms = 20");
    std::fs::write(&assumed, plan).expect("written");
    let assumed = assumed.to_str().expect("UTF-8");
    for (command, more) in [
        ("risk", ""),
        ("orders", "--interval=20..20:1"),
        ("sweep", "--interval=20..21:1"),
        ("size", "--option=a"),
    ] {
        let more = (!more.is_empty()).then_some(more);
        let output = shelter(
            &[&[command, assumed, "--samples", "40", "--accuracy", "draft"], more.as_slice()].concat(),
        );
        let last = text(&output.stdout).lines().last().unwrap_or_default().to_owned();
        assert!(
            last.contains("(inputs assumed: see `shelter assumptions`)"),
            "{command}: {last} {}",
            text(&output.stderr)
        );
    }
    let own = text(&ONE_PASSES.stdout);
    assert!(own.contains(" of 2 options pass (until when: see `shelter assumptions`) · "), "{own}");
    assert!(
        own.contains(
            "20 ms passes, slide NOT checked, the only one of 2: if your inputs hold (13 assumed), fewer than 1 in 100 shots"
        ),
        "{own}"
    );
}

#[test]
fn several_plans_are_one_document_and_one_verdict() {
    let folder = tempfile::tempdir().expect("a folder");
    let [first, second] = [tested_plan("paper-5-tire.toml"), small_plan_in(folder.path())];
    let output = shelter(&["check", &first, &second, "--format", "json", "--samples", "100"]);
    assert_eq!(json(&output).as_array().map(Vec::len), Some(2));
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn threads_change_nothing_but_the_time() {
    let values = |threads: &str| {
        let document = json(&on_small(&["check", "--format", "json", "--threads", threads]));
        let options = document["options"].as_array().expect("options").clone();
        options.iter().map(|o| (o["flight_height_m"].clone(), o["cable_force_n"].clone())).collect::<Vec<_>>()
    };
    assert_eq!(values("1"), values("2"));
}

#[test]
fn text_is_plain_without_a_terminal_and_ascii_on_request() {
    assert!(!text(&ONE_PASSES.stdout).contains('\x1b'));
    assert!(text(&ONE_PASSES.stdout).contains("20 ms passes, slide NOT checked, the only one of 2"));
    let output = on_small(&["check", "--ascii", "--samples", "100"]);
    assert!(text(&output.stdout).is_ascii());
    let output = on("paper-5-tire.toml", &["check", "--color", "always"]);
    assert!(text(&output.stdout).contains('\x1b'));
}

#[test]
fn csv_has_a_row_per_option() {
    let output = on_small(&["check", "--format", "csv", "--samples", "100"]);
    let lines: Vec<&str> = text(&output.stdout).lines().collect();
    assert_eq!(lines.len(), 8);
    assert!(
        lines[0].starts_with(
            "plan,option,verdict,judged,confirmed,nominal_verdict,low_95,high_95,flight_height_m,"
        )
    );
    assert!(lines[4].contains("\"25 ms, middle first\""));
}

#[test]
fn a_step_past_the_stability_limit_is_refused_by_name() {
    let output = on("paper-5-tire.toml", &["check", "--nominal", "--dt", "0.1"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).contains("a finer accuracy or a smaller step"));
    assert!(text(&output.stderr).contains("--dt"));
}

#[test]
fn a_plan_opened_without_a_terminal_is_checked() {
    let path = tested_plan("paper-5-tire.toml");
    let output = shelter(&[&path]);
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stdout).contains("PASS"));
}

/// Figures 5 and 6 of the source paper: the columns to draw them, and what they show.
#[test]
fn trace_gives_the_columns_of_the_paper_figures() {
    let arguments = ["trace", "--tire", "1.5,1.5", "--tire", "1,1", "--cable", "1,1-1.5,1.5", "--every", "1"];
    let output = on("paper-5-tire.toml", &arguments);
    let mut reader = csv::Reader::from_reader(output.stdout.as_slice());
    let header = reader.headers().expect("a header").clone();
    let expected = "t_s,x_m[1.5:1.5],y_m[1.5:1.5],height_m[1.5:1.5],friction_n[1.5:1.5],friction_limit_n[1.5:1.5],\
                    x_m[1:1],y_m[1:1],height_m[1:1],friction_n[1:1],friction_limit_n[1:1],force_n[1:1-1.5:1.5]";
    assert_eq!(header.iter().collect::<Vec<_>>().join(","), expected);
    let rows: Vec<Vec<f64>> = reader.deserialize().map(|row| row.expect("numbers")).collect();
    // At rest after 0.708 s.
    assert!((700..=720).contains(&rows.len()), "{}", rows.len());
    let greatest = |column: usize| rows.iter().map(|row| row[column]).fold(0.0, f64::max);
    assert!((greatest(3) - 0.7574).abs() < 1e-3);
    assert!((greatest(11) - 17_736.0).abs() < 20.0);
    assert!(rows.iter().all(|row| row[9] <= row[10] * (1.0 + 1e-9)), "friction is inside its cone");
    assert!(rows.iter().any(|row| row[10] > 0.0 && row[9] == row[10]), "the corner slides at times");
}

#[test]
fn trace_refuses_what_is_not_there() {
    for bad in [["--option", "x"], ["--tire", "9,9"], ["--tire", "a"], ["--cable", "1,1"], ["--every", "0"]] {
        let output = on("paper-5-tire.toml", &["trace", bad[0], bad[1]]);
        assert_eq!(output.status.code(), Some(2), "{bad:?}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_reader_that_goes_away_ends_trace_quietly() {
    let path = tested_plan("paper-5-tire.toml");
    let mut command = Command::new(PROGRAM);
    let mut child = command
        .args(["trace", &path])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let stdout = child.stdout.take().expect("a pipe");
    let line = within("the first line", move || {
        let mut line = String::new();
        BufReader::new(stdout).read_line(&mut line).map(|_| line).expect("a line")
    });
    assert!(line.starts_with("t_s,"), "{line}");
    let output = ended(child);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
}

#[test]
fn a_range_that_leaves_out_the_plans_own_value_is_warned_of() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let ranges =
        "[uncertainty]\nfriction = [0.55, 0.7]\nslack_percent = [0, 2]\naxial_stiffness_percent = [5, 20]\n";
    std::fs::write(&path, format!("{}{ranges}", super::bad_plans::GOOD)).expect("written");
    let output = shelter(&["check", "--nominal", path.to_str().expect("UTF-8"), "--accuracy", "draft"]);
    let told = text(&output.stderr);
    assert_eq!(told.matches("of [uncertainty] leaves out").count(), 2, "{told}");
    assert!(told.contains("[uncertainty] leaves out `detonator`, `launch_cv_percent`, "), "{told}");
    assert!(
        told.contains("`friction = [0.55, 0.7]` of [uncertainty] leaves out 0.5, the plan's own"),
        "{told}"
    );
    assert!(told.contains("`axial_stiffness_percent = [5, 20]` of [uncertainty] leaves out 0"), "{told}");
    // Readers of the results see it, too.
    assert_eq!(text(&output.stdout).matches("leaves out").count(), 3);
}

/// Pyrotechnic caps scatter in the holes, too; a plan that leaves out their delay is told so.
#[test]
fn pyrotechnic_caps_without_a_delay_in_the_hole_are_warned_of() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let warned = |detonator: &str| {
        let plan = format!("{}[uncertainty]\ndetonator = {detonator}\n", super::bad_plans::GOOD);
        std::fs::write(&path, plan).expect("written");
        let path = path.to_str().expect("UTF-8");
        text(&shelter(&["check", "--nominal", path, "--accuracy", "draft"]).stderr)
            .contains("`in_hole_delay_ms` is 0")
    };
    assert!(warned("\"pyrotechnic\"") && warned("\"pyrotechnic surface\""));
    assert!(!warned("\"pyrotechnic\"\nin_hole_delay_ms = 500") && !warned("\"electronic\""));
}

/// A plan that says something of its unknowns, and nothing of how well the launch velocity is known, is told what is assumed; and so is
/// a gravity of another planet.
#[test]
fn a_launch_taken_as_surer_than_any_film_is_warned_of() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let warned = |more: &str, warning: &str| {
        std::fs::write(&path, format!("{}{more}\n", super::bad_plans::GOOD)).expect("written");
        let path = path.to_str().expect("UTF-8");
        text(&shelter(&["check", "--nominal", path, "--accuracy", "draft"]).stderr).contains(warning)
    };
    assert!(warned("[uncertainty]\nlaunch_cv_percent = 5", "known to 1 %, surer than any film"));
    for exact in ["0", "0.1"] {
        let uncertainty = format!("[uncertainty]\nlaunch_common_percent = {exact}");
        assert!(warned(&uncertainty, &format!("known to {exact} %, surer than any film")));
    }
    let surer = "surer than any film";
    assert!(!warned("[uncertainty]\nlaunch_cv_percent = 5\nlaunch_common_percent = 10", surer));
    let gravity = "`gravity_m_s2 = 98.1` of [simulation] is unusual";
    assert!(warned("[simulation]\ngravity_m_s2 = 98.1", gravity));
    assert!(!warned("[simulation]\ngravity_m_s2 = 9.78", "gravity_m_s2"));
}

/// A tire of a list may be lighter than the one whose flight was filmed: its launch is taken as written, and that is told.
#[test]
fn a_light_tire_over_a_hole_is_warned_of() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let list = |mass: &str| {
        let good = super::bad_plans::GOOD;
        let grid = "layout = \"grid\"\nrows = 3\ncolumns = 4\nspacing_m = 1.5\n";
        let tires =
            "tire = [{ x_m = 0, y_m = 0 }, { x_m = 2, y_m = 0MASS }]\ncable = [{ from = 1, to = 2 }]\n";
        let plan = good.replace(grid, &format!("layout = \"list\"\n{}", tires.replace("MASS", mass)));
        plan.replace("under_row = 1", "under_tires = [1]").replace("under_row = 2", "under_tires = [2]")
    };
    let warned = |mass: &str| {
        std::fs::write(&path, list(mass)).expect("written");
        let output = shelter(&["check", "--nominal", path.to_str().expect("UTF-8"), "--accuracy", "draft"]);
        assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
        text(&output.stderr).contains("tire 2 over a hole has 140 kg, that of [tire] 280")
    };
    assert!(warned(", mass_kg = 140"));
    assert!(!warned(", mass_kg = 300"));
    assert!(!warned(""));
}

/// An option whose name says another interval would be fired at that; names that turn text round, or are none, are refused.
#[test]
fn names_that_mislead_are_told_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let run = |name: &str| {
        let plan = include_str!("../fixtures/amur-three-rows.toml");
        let text = plan.edited("name = \"42 ms\"", &format!("name = \"{name}\""));
        std::fs::write(&path, text).expect("written");
        shelter(&[
            "check",
            path.to_str().expect("UTF-8"),
            "--nominal",
            "--accuracy",
            "draft",
            "--format",
            "json",
        ])
    };
    let output = run("40 ms");
    let warning = "the option named \"40 ms\" fires its rows 42 ms apart, not 40 ms";
    assert!(text(&output.stderr).contains(warning), "{}", text(&output.stderr));
    let warnings = json(&output)["warnings"].to_string();
    assert!(
        warnings.contains("not 40 ms")
            && warnings.contains("not checked, is the ground clear? set `drift_m` to limit that")
            && warnings.contains("the planned shot moves a tire as far as"),
        "{warnings}"
    );
    for other in ["40 MS", "40 \u{43c}\u{441}", "40 \u{43c}s, ours"] {
        assert!(text(&run(other).stderr).contains("42 ms apart, not 40 ms"), "{other}");
    }
    assert!(!text(&run("42 ms, ours").stderr).contains("apart, not"));
    for name in ["x\u{202e}SSAP", "\u{2067}a", " ", ""] {
        assert_eq!(run(name).status.code(), Some(2), "{name:?}");
    }
}

#[test]
fn init_writes_a_plan_that_loads_and_overwrites_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("new.toml");
    let name = path.to_str().expect("UTF-8");
    assert_eq!(shelter(&["init", name]).status.code(), Some(0));
    assert!(shelter::plan::Plan::load(&path).is_ok());
    std::fs::write(&path, "mine").expect("written");
    assert_eq!(shelter(&["init", name]).status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&path).expect("read"), "mine");
}

#[test]
fn ropes_lists_the_catalogue_in_every_format() {
    let output = shelter(&["ropes"]);
    assert!(text(&output.stdout).contains("GOST 2688-80 6.2"));
    let document = json(&shelter(&["ropes", "--format", "json"]));
    assert!(document["ropes"].as_array().expect("ropes").len() > 60);
    assert!(text(&shelter(&["ropes", "--terminations"]).stdout).contains("clips"));
}

#[test]
fn packagers_get_completions_and_a_manual_page() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        assert!(text(&shelter(&["completions", shell]).stdout).contains("shelter"));
    }
    assert!(text(&shelter(&["man"]).stdout).contains(".TH"));
}

/// A method that lacks an effect of the plan is refused with the remedy that helps, and has no rows in a table of steps.
#[test]
fn what_a_method_lacks_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    let pushed = std::fs::read_to_string(tested_plan("paper-5-tire.toml")).expect("the plan");
    let pushed = pushed.replacen("launch_m_s", "push_ms = 20\nlaunch_m_s", 1);
    std::fs::write(&plan, pushed).expect("written");
    let plan = plan.to_str().expect("UTF-8");
    for command in ["check", "risk", "accuracy"] {
        let arguments: &[&str] =
            if command == "accuracy" { &[command, plan] } else { &[command, plan, "--method", "newmark"] };
        let output = shelter(arguments);
        let told = format!("{}{}", text(&output.stdout), text(&output.stderr));
        if command == "accuracy" {
            assert!(!told.lines().any(|line| line.starts_with("newmark")), "{told}");
        } else {
            assert!(told.contains("newmark has no push: choose method"), "{command}: {told}");
            assert!(!told.contains("finer"), "{command}: {told}");
        }
    }
}

#[test]
fn effects_have_the_fields_scripts_read_and_a_sentence() {
    let document = json(&on("paper-5-tire.toml", &["effects", "--format", "json"]));
    assert_eq!(document["schema"], "shelter.effects/1");
    let effects = document["options"][0]["effects"].as_array().expect("effects");
    let tilt = effects.iter().find(|effect| effect["name"] == "tilt_deg").expect("a probe of tilt");
    assert_eq!(
        (&tilt["value"], &tilt["unit"], &tilt["source"]),
        (&5.0.into(), &"°".into(), &"assumed".into())
    );
    assert!(tilt["cable_force_change"].is_f64() && tilt["flight_height_change"].is_f64());
    assert!(tilt["required"].is_boolean() && tilt["cost"].is_f64() && tilt["verdict"].is_string());
    let friction = effects.iter().find(|effect| effect["name"] == "friction").expect("a choice of the plan");
    assert_eq!(friction["source"], "plan");
    let output = on("paper-5-tire.toml", &["effects"]);
    assert!(
        text(&output.stdout).contains("this scene requires: launch direction"),
        "{}",
        text(&output.stdout)
    );
    // What the plan has, such as friction, is not among what it lacks.
    let lacking = text(&output.stdout).lines().find(|line| line.contains("required and not in the plan"));
    assert!(lacking.is_some_and(|line| line.contains("launch direction") && !line.contains("friction")));
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stdout).contains(RIGID_ENDS), "{}", text(&output.stdout));
    let yielding =
        include_str!("../../plans/paper-5-tire.toml").replace("[cable]", "[cable]\nend_stiffness_kn_m = 433");
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    std::fs::write(&plan, yielding).expect("written");
    let output = shelter(&["effects", plan.to_str().expect("UTF-8"), "--samples", "5"]);
    assert!(text(&output.stdout).contains("yielding ends"), "{}", text(&output.stdout));
    assert!(!text(&output.stdout).contains(RIGID_ENDS), "{}", text(&output.stdout));
}

/// What an effect does to an option depends on no other option; only its cost is measured anew.
#[test]
fn effects_of_one_option_are_those_among_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    std::fs::write(&plan, small_plan()).expect("written");
    let effects = |more: &[&str]| {
        let command =
            [&["effects", plan.to_str().expect("UTF-8"), "--samples", "5", "--format", "json"], more]
                .concat();
        let mut document = json(&shelter(&command));
        for effect in document["options"].as_array_mut().expect("options").iter_mut() {
            for effect in effect["effects"].as_array_mut().expect("effects") {
                effect.as_object_mut().expect("fields").remove("cost");
            }
        }
        document["options"].clone()
    };
    let (all, one) = (effects(&[]), effects(&["--option", "42 ms"]));
    let named = all.as_array().expect("options").iter().find(|option| option["name"] == "42 ms");
    assert_eq!(one.as_array().map(Vec::len), Some(1));
    assert_eq!(one.as_array().and_then(|one| one.first()), named);
}

#[test]
fn accuracy_has_the_fields_scripts_read_and_the_paper_table() {
    let document = json(&on("paper-5-tire.toml", &["accuracy", "--format", "json"]));
    let rows = document["rows"].as_array().expect("rows");
    for level in ["draft", "field", "reference"] {
        let step = &document["recommended"][level]["dt_s"];
        let row =
            rows.iter().find(|row| row["dt_s"] == *step && row["method"] == "verlet").expect("measured");
        let error = row["height_error"].as_f64().expect("a number");
        assert!(error < 1e-3, "{level}: {error}");
    }
    assert!(rows.iter().any(|row| row["method"] == "newmark" && row["stable"] == true));
    assert!(document["reference"]["dt_s"].is_f64());
    assert!(text(&on("paper-5-tire.toml", &["accuracy"]).stdout).contains("Table 1 of the source paper"));
}

/// A spreadsheet runs a cell that begins with one of these as a formula.
#[test]
fn names_in_csv_are_no_formulas() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    for name in ["=1+1", "+1", "-1", "@a"] {
        let plan = include_str!("../../plans/paper-5-tire.toml");
        let mut document: toml_edit::DocumentMut = plan.parse().expect("TOML");
        document["delay"][0]["name"] = toml_edit::value(name);
        std::fs::write(&path, document.to_string()).expect("written");
        let path = path.to_str().expect("UTF-8");
        let output = shelter(&["check", path, "--nominal", "--accuracy", "draft", "--format", "csv"]);
        let mut reader = csv::Reader::from_reader(output.stdout.as_slice());
        let row = reader.records().next().expect("a row").expect("CSV");
        assert!(row.iter().any(|cell| cell == format!("'{name}")), "{row:?}");
    }
}

/// A file that both streams go to has each warning once; standard error alone has them, too.
#[cfg(unix)]
#[test]
fn a_warning_stands_once_where_both_streams_go() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let stream = || file.reopen().expect("the file");
    let out = std::fs::OpenOptions::new().append(true).open(file.path()).expect("the file");
    let plan = super::support::tested_plan("amur-three-rows.toml");
    let arguments = ["check", &plan, "--nominal"];
    let mut both = Command::new(PROGRAM);
    both.args(arguments).stdout(out.try_clone().expect("the same file")).stderr(out);
    both.status().expect("it runs");
    let printed = std::io::read_to_string(stream()).expect("text");
    let warnings = |text: &str| {
        text.lines().filter(|line| line.starts_with("warning: ")).map(str::to_owned).collect::<Vec<_>>()
    };
    let once = warnings(&printed);
    assert!(!once.is_empty(), "{printed}");
    let apart = super::support::shelter(&arguments);
    assert_eq!(once, warnings(&String::from_utf8_lossy(&apart.stderr)));
    assert_eq!(once, warnings(&String::from_utf8_lossy(&apart.stdout)));
}
