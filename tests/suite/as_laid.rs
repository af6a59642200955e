//! A shelter as it is laid and a shot as it is fired: holes beside their tires, ropes as tied, rows, tilts and duds, each against its
//! closed form or limit.

use std::ops::ControlFlow;

use nalgebra::Vector2;
use shelter::plan::{Layout, ListedTire, Plan};
use shelter::scene::{ASSUMED_PUSH_DEPTH, Wiring};
use shelter::study::as_planned::check::check_as_planned;
use shelter::study::samples::random_shot::{DrawnShot, draw_shot};
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::study::{Case, ComputeSettings, StudyControl};
use shelter::verdict::Verdict;

use super::support::scenes::GRAVITY;
use super::support::{AS_DRAWN, Edited, json, shelter, text};

/// `rows` × `columns` tires 1.5 m apart with these holes; `unknown` takes the place of exact laying and firing.
fn case(rows: usize, columns: usize, holes: &str, unknown: &[(&str, &str)]) -> Case {
    let plan = Plan::parse("plan.toml", &plan_text(rows, columns, holes, unknown));
    Case::new(plan.unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

fn plan_text(rows: usize, columns: usize, holes: &str, unknown: &[(&str, &str)]) -> String {
    let known = "delay_sd_ms = 0\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\ntire_mass_cv_percent = 0\n\
                 launch_between_shots_percent = 0\nfriction = [0.5, 0.5]\nslack_percent = [2, 2]\naxial_stiffness_percent = [0, 0]\nlaunch_mass_exponent = [1, 1]\n";
    let mut exact = format!("{known}{AS_DRAWN}");
    for (key, value) in unknown {
        let line =
            exact.lines().find(|line| line.starts_with(&format!("{key} = "))).expect("a key").to_owned();
        exact = exact.replace(&line, &format!("{key} = {value}"));
    }
    format!(
        r#"
shelter = {{ layout = "grid", rows = {rows}, columns = {columns}, spacing_m = 1.5 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 1000, slack_percent = 2 }}
ground = {{ friction = 0.5 }}
limits = {{ flight_height_m = 50, cable_safety_factor = 1 }}
delay = [{{ name = "20 ms", interval_ms = 20 }}]
{holes}
[uncertainty]
{exact}
"#
    )
}

fn hole(x: f64, y: f64, more: &str) -> String {
    format!("[[blast_row]]\nname = \"{x} {y}\"\nholes = [{{ x_m = {x}, y_m = {y}, launch_m_s = 6{more} }}]\n")
}

fn drawn(case: &Case, number: usize) -> DrawnShot {
    draw_shot(case, &case.shots[0], 7, number)
}

/// How far a lone tire comes that leaves with 6 m/s at slope `slope`: V² sin 2θ/g in flight, (V sin θ − μ V cos θ)²/(2 μ g) sliding.
fn range(slope: f64) -> f64 {
    let (speed, friction, angle) = (6.0_f64, 0.5, slope.atan());
    let slide = (speed * angle.sin() - friction * speed * angle.cos()).max(0.0);
    speed.powi(2) * (2.0 * angle).sin() / GRAVITY + slide.powi(2) / (2.0 * friction * GRAVITY)
}

/// A hole 0.3 m beside a lone tire, pushed from 0.8 m below: it comes as far as its direction says, to within the error of the
/// computation. Where the plan gives no depth, the planned push is straight up, and samples take 0.8 m.
#[test]
fn a_tire_beside_its_hole_comes_as_far_as_the_line_of_its_push_says() {
    for (depth, slope) in [(0.8, 0.3 / 0.8), (0.4, 0.75)] {
        let case = case(1, 1, &hole(-0.3, 0.0, &format!(", push_depth_m = {depth}")), &[]);
        let compute = ComputeSettings::of(&case.plan);
        let checked =
            check_as_planned(&case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a result");
        let away = (checked.estimates.drift.value - range(slope)).abs();
        assert!(
            away <= checked.estimates.drift.error + 1e-6,
            "{} is not {}",
            checked.estimates.drift.value,
            range(slope)
        );
    }
    let case = case(1, 1, &hole(-0.3, 0.0, ""), &[]);
    assert_eq!(case.shots[0].firings[0].launch.xy(), Vector2::zeros());
    let slope = drawn(&case, 0).shot.firings[0].launch;
    assert!((slope.x / slope.z - 0.3 / ASSUMED_PUSH_DEPTH).abs() < 1e-12 && slope.y == 0.0);
    assert!((slope.norm() - 6.0).abs() < 1e-12, "the speed is that of the plan");
}

/// A hole midway between two tires belongs to either in half of the samples: of 4,000 draws within four standard errors (3.2 %).
#[test]
fn a_hole_midway_between_two_tires_belongs_to_either() {
    let case = case(1, 2, &hole(0.75, 0.0, ""), &[("hole_position_m", "0.05")]);
    let first = (0..4000).filter(|&number| drawn(&case, number).shot.firings[0].tire == 0).count();
    assert!((first as f64 / 4000.0 - 0.5).abs() < 0.032, "{first}");
}

/// A hole midway between a tire of 560 kg and one of 280 kg: the planned launch belongs to the heavy one, over which the plan has it.
/// The light one leaves with twice of it at n = 1, and with all of it at n = 0.
#[test]
fn a_hole_that_launches_a_tire_of_another_mass_keeps_to_the_mass_law() {
    for (exponent, factor) in [(1, 2.0), (0, 1.0)] {
        let unknown = [("hole_position_m", "0.05")];
        let mut plan = case(1, 2, &hole(0.75, 0.0, ""), &unknown).plan;
        plan.uncertainty.launch_mass_exponent = [f64::from(exponent); 2];
        let tire = |x_m, mass_kg| ListedTire { x_m, y_m: 0.0, mass_kg };
        plan.layout =
            Layout::List { tires: vec![tire(0.0, Some(560.0)), tire(1.5, None)], cables: vec![(0, 1)] };
        let case = Case::new(plan);
        assert_eq!(case.shots[0].firings[0].tire, 0);
        for number in 0..100 {
            let firing = drawn(&case, number).shot.firings[0];
            let expected = if firing.tire == 1 { 6.0 * factor } else { 6.0 };
            assert!((firing.launch.norm() - expected).abs() < 1e-12, "{firing:?}");
        }
    }
}

/// The whole pattern moves as one: every hole has the tire nearest to where it then lies, and a push toward it.
#[test]
fn an_offset_moves_all_holes_alike() {
    let holes = [hole(1.5, 1.5, ""), hole(3.0, 1.5, ""), hole(4.5, 3.0, "")].concat();
    let case = case(5, 6, &holes, &[("pattern_offset_m", "0.8")]);
    let mut other_tires = 0;
    for number in 0..200 {
        let sample = drawn(&case, number);
        let [x, y] = [8, 9].map(|input| sample.inputs[input]);
        for firing in &case.shots[0].firings {
            let planned = case.scene().position[firing.tire].xy();
            let place = planned - Vector2::new(x, y);
            let away = |tire: usize| (case.scene().position[tire].xy() - place).norm();
            let nearest = (0..30).min_by(|&a, &b| away(a).total_cmp(&away(b))).expect("tires");
            let launched = sample.shot.firings.iter().find(|other| other.row == firing.row).expect("fired");
            assert_eq!(launched.tire, nearest);
            let slope = launched.launch.xy() / launched.launch.z;
            let expected = (case.scene().position[nearest].xy() - place) / ASSUMED_PUSH_DEPTH;
            assert!((slope - expected).norm() < 1e-9);
            other_tires += usize::from(nearest != firing.tire);
        }
    }
    assert!(other_tires > 100, "a test that can fail: {other_tires}");
}

/// Of five holes that each fail with 20 %, the number that fails is binomial: 0.3277, 0.4096, 0.2048 for none, one and two, within four
/// standard errors of 4,000 draws (3 %).
#[test]
fn duds_are_binomial() {
    let row = "[[blast_row]]\nname = \"1\"\nunder_row = 1\nlaunch_m_s = 6\n";
    let case = case(1, 5, row, &[("hole_fails_percent", "20")]);
    let mut counts = [0; 6];
    (0..4000).for_each(|number| counts[5 - drawn(&case, number).shot.firings.len()] += 1);
    for (count, exact) in counts.into_iter().zip([0.3277, 0.4096, 0.2048]) {
        assert!((f64::from(count) / 4000.0 - exact).abs() < 0.03, "{counts:?}");
    }
}

/// Where every hole fails nothing flies, and nothing is past a limit.
#[test]
fn where_all_holes_fail_nothing_flies() {
    let row = "[[blast_row]]\nname = \"1\"\nunder_row = 1\nlaunch_m_s = 6\n";
    let case = case(1, 5, row, &[("hole_fails_percent", "100")]);
    let target =
        ShotToSample::new(&case, &case.shots[0], ComputeSettings::of(&case.plan), Sampling::exactly(20, 1));
    let sampled = sample_shots(&[target], &StudyControl::default()).expect("samples").value.remove(0);
    for sample in &sampled.samples {
        assert_eq!((sample.run.verdict, sample.run.height, sample.run.force), (Verdict::Pass, 0.0, 0.0));
    }
}

/// A cable is as long as tied: its length has the stated deviation, never less than its span, and stiffness EA over its length. With a
/// deviation far above the slack half of the cables are just taut.
#[test]
fn cables_are_as_long_as_tied() {
    let row = "[[blast_row]]\nname = \"1\"\nunder_row = 1\nlaunch_m_s = 6\n";
    for (deviation, taut) in [(0.005, 0.0), (10.0, 0.5)] {
        let case = case(4, 5, row, &[("cable_length_m", &deviation.to_string())]);
        let planned = &case.scene().cables;
        let (mut just_taut, mut squares, mut count) = (0, 0.0, 0);
        for number in 0..100 {
            let scene = drawn(&case, number).scene;
            assert!(scene.mirrors.is_empty(), "no cable is like its image");
            for (cable, planned) in scene.cables.iter().zip(planned) {
                assert!(cable.rest_length >= cable.span.norm());
                assert!((cable.stiffness * cable.rest_length / 1.4e6 - 1.0).abs() < 1e-12);
                just_taut += usize::from(cable.rest_length == cable.span.norm());
                squares += (cable.rest_length - planned.rest_length).powi(2);
                count += 1;
            }
        }
        assert!((just_taut as f64 / f64::from(count) - taut).abs() < 0.03, "{just_taut} of {count}");
        if taut == 0.0 {
            // Four standard errors of a standard deviation of 5,500 draws are 4 %.
            assert!(((squares / f64::from(count)).sqrt() / deviation - 1.0).abs() < 0.04);
        }
    }
}

/// Launches vary row by row about a mean of 1, alike within a row; and all tilt by one slope.
#[test]
fn rows_and_the_whole_shot_vary_as_one() {
    let rows: String = (1..=2)
        .map(|n| format!("[[blast_row]]\nname = \"{n}\"\nunder_row = {n}\nlaunch_m_s = 6\n"))
        .collect();
    let unknown = [("launch_row_cv_percent", "20"), ("launch_tilt_common_deg", "10")];
    let case = case(2, 4, &rows, &unknown);
    let (mut factors, mut slopes) = (Vec::new(), Vec::new());
    for number in 0..4000 {
        let sample = drawn(&case, number);
        let speed = |row: usize| {
            let of_row: Vec<f64> =
                sample.shot.firings.iter().filter(|f| f.row == row).map(|f| f.launch.norm()).collect();
            assert!(of_row.iter().all(|speed| (speed / of_row[0] - 1.0).abs() < 1e-12));
            of_row[0] / 6.0
        };
        let [first, second] = [0, 1].map(speed);
        assert_ne!(first, second);
        factors.extend([first, second]);
        let slope = sample.shot.firings[0].launch.xy() / sample.shot.firings[0].launch.z;
        for firing in &sample.shot.firings {
            assert!((firing.launch.xy() / firing.launch.z - slope).norm() < 1e-12);
        }
        slopes.extend([slope.x, slope.y]);
    }
    let moments = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (mean, (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt())
    };
    // Four standard errors of 8,000 draws: 0.9 % of the mean, 4 % of a deviation.
    let (mean, deviation) = moments(&factors);
    assert!((mean - 1.0).abs() < 0.009 && (deviation / 0.2 - 1.0).abs() < 0.05, "{mean} {deviation}");
    let (mean, deviation) = moments(&slopes);
    let expected = 10_f64.to_radians().tan();
    assert!(mean.abs() < 0.008 && (deviation / expected - 1.0).abs() < 0.04, "{mean} {deviation}");
}

/// Extremes: results are finite and the energy balance closes to 1 %, or the sample is undecided.
#[test]
fn extremes_of_laying_and_firing_are_finite_or_undecided() {
    let rows: String = (1..=2)
        .map(|n| format!("[[blast_row]]\nname = \"{n}\"\nunder_row = {n}\nlaunch_m_s = 6\n"))
        .collect();
    let masses = ("tire_mass_cv_percent", "100");
    for unknown in [
        &[("cable_length_m", "5")][..],
        &[("hole_fails_percent", "100")],
        &[("hole_position_m", "1.5")],
        &[("pattern_offset_m", "1.5")],
        &[("launch_tilt_deg", "40")],
        &[("launch_tilt_common_deg", "40")],
        &[("launch_row_cv_percent", "100")],
        &[masses, ("launch_mass_exponent", "[0, 0]")],
        &[masses, ("launch_mass_exponent", "[1, 1]")],
    ] {
        let case = case(3, 4, &rows, unknown);
        let compute = ComputeSettings::of(&case.plan);
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::exactly(40, 1));
        let sampled = sample_shots(&[target], &StudyControl::default()).expect("samples").value.remove(0);
        for sample in &sampled.samples {
            let run = sample.finest();
            let is_finite = run.height.is_finite() && run.force.is_finite() && run.drift.is_finite();
            assert!(is_finite || run.verdict == Verdict::Undecided, "{unknown:?}: {run:?}");
        }
        // A hole that ends up under no tire leaves its sample open by rule.
        let undecided = sampled.bounds.undecided - sampled.uncovered();
        assert!(undecided <= 2, "{unknown:?}: {undecided} of 40 undecided");
    }
}

/// A hole in the middle of four tires lies under none: however tame its shot is, it stays open and says why, and its page is no page to
/// fire by. With a tire over the hole the same shot passes.
#[test]
fn a_shot_with_a_hole_under_no_tire_is_never_to_be_fired() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let [plan, page] = [path("plan.toml"), path("page.html")];
    // The tire rises to 0.61 m: what passes under this limit ends soon, with whatever else is assumed.
    for (x, y, limit, passes) in [(0.75, 0.75, "50", false), (1.5, 1.5, "0.64", true)] {
        // A launch known better would permit nothing.
        let limited = plan_text(3, 3, &hole(x, y, ""), &[("launch_common_percent", "0.5")])
            .edited("flight_height_m = 50", &format!("flight_height_m = {limit}"));
        std::fs::write(&plan, limited).expect("written");
        let checked = shelter(&["check", &plan, "--format", "json"]);
        assert_eq!(checked.status.code(), Some(i32::from(!passes)), "{}", text(&checked.stderr));
        let option = &json(&checked)["options"][0];
        assert_eq!(option["verdict"] == "pass", passes, "{option}");
        assert_eq!(option["reasons"].to_string().contains("1 hole lies under no tire"), !passes, "{option}");
        let fired = shelter(&["report", &plan, "--option", "20 ms", "-o", &page]);
        assert_eq!(fired.status.code(), Some(i32::from(!passes)), "{}", text(&fired.stderr));
        let written = std::fs::read_to_string(&page).expect("a page");
        assert_eq!(written.contains("\">To be fired"), passes);
        let head = written.split("The shelter from above").next().expect("a head");
        assert_eq!(head.contains("1 hole lies under no tire, and nothing holds what comes out"), !passes);
        std::fs::remove_file(&page).expect("removed");
    }
}

/// A hole 1 cm inside the rim of its tire lies under it as planned, and beside it in some 45 % of shots: N(0, 5 cm) on each axis and as
/// much again for the whole pattern move it by 7 cm along the line to the rim. The samples may not pass where nothing holds the rock.
#[test]
fn a_hole_at_the_rim_of_its_tire_passes_as_planned_and_not_as_laid() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let path = path.to_str().expect("UTF-8");
    // Without a diameter half the distance to the next tire counts for the radius: 0.75 m.
    let place = 1.5 - 0.74 / 2.0_f64.sqrt();
    let scatter = [("hole_position_m", "0.05"), ("pattern_offset_m", "0.05")];
    std::fs::write(path, plan_text(3, 3, &hole(place, place, ""), &scatter)).expect("written");
    let planned = json(&shelter(&["check", path, "--nominal", "--format", "json"]));
    assert!(!planned["options"][0]["reasons"].to_string().contains("no tire"), "{planned}");
    let sampled = json(&shelter(&["check", path, "--format", "json"]));
    let option = &sampled["options"][0];
    assert_eq!(option["verdict"], "undecided", "{option}");
    let reasons = option["reasons"].to_string();
    assert!(reasons.contains("a hole fires under no tire"), "{reasons}");
    let [open, all] =
        ["undecided", "samples"].map(|key| option["failure_probability"][key].as_f64().expect("a count"));
    assert!((0.35..0.55).contains(&(open / all)), "{open} of {all}");
}

/// Two rows fired a second apart: the first pulls the tires of the second 0.83 m off their holes, past their radius, and back again
/// before the end. No limit sees it, and the second row fires into the open. With 20 ms between them the tires still lie there.
#[test]
fn a_hole_that_fires_after_its_tire_was_moved_away_never_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let path = path.to_str().expect("UTF-8");
    let plan = r#"
shelter = { layout = "grid", rows = 2, columns = 4, spacing_m = 2.6 }
tire = { mass_kg = 280, outer_diameter_m = 1.6 }
cable = { rope = "Polyester 24", slack_percent = 2 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 6 }, { name = "2", under_row = 2, launch_m_s = 6 }]
limits = { flight_height_m = 2.35, cable_safety_factor = 1.3, drift_m = 3 }
delay = [{ name = "20 ms", interval_ms = 20 }, { name = "1 s", interval_ms = 1000 }]
"#;
    std::fs::write(path, plan).expect("written");
    let checked = json(&shelter(&["check", path, "--nominal", "--format", "json"]));
    let [early, late] = [0, 1].map(|n| &checked["options"][n]);
    assert_eq!((&early["verdict"], &late["verdict"]), (&"pass".into(), &"undecided".into()), "{checked}");
    assert!(late["reasons"].to_string().contains("4 holes fire where no tire lies any more"), "{late}");
    // At 400 ms the tires are 0.67 m aside as planned, and past their radius in a third of the shots.
    std::fs::write(path, plan.replace("1 s", "400 ms").replace("1000", "400")).expect("written");
    let sampled = &json(&shelter(&["check", path, "--format", "json"]))["options"][1];
    assert_eq!((&sampled["nominal_verdict"], &sampled["verdict"]), (&"pass".into(), &"undecided".into()));
    assert!(sampled["reasons"].to_string().contains("more a hole fires under no tire"), "{sampled}");
    std::fs::write(path, plan).expect("written");
    let swept = shelter(&["sweep", path, "--nominal", "--interval", "980..1000:20", "--format", "json"]);
    let points = &json(&swept)["points"];
    assert!(points.as_array().expect("points").iter().all(|point| point["verdict"] != "pass"), "{points}");
}

/// One dud at row 2, hole 1 lets a force near its limit scatter past it in a quarter of the shots and more, though three other places are
/// nearer a limit as planned, by a height that hardly scatters: which places are sampled is told by samples. The plan without that hole,
/// judged at the risk accepted for a dud, says the same by a way of its own.
#[test]
fn the_places_of_a_dud_that_are_sampled_are_the_worst_of_all_that_scatters() {
    let holes = |row: usize, first: usize| {
        let hole = |column| {
            format!("{{ x_m = {}, y_m = {}, launch_m_s = 6.0 }}", 2.6 * column as f64, 2.6 * row as f64)
        };
        (first..10).map(hole).collect::<Vec<_>>().join(", ")
    };
    let plan = |of_row_2: usize, limits: &str| {
        let row = |row: usize| {
            let first = if row == 1 { of_row_2 } else { 0 };
            format!("[[blast_row]]\nname = \"{}\"\nholes = [{}]\n", row + 1, holes(row, first))
        };
        format!(
            r#"
shelter = {{ layout = "grid", rows = 5, columns = 10, spacing_m = 2.6 }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
cable = {{ rope = "GOST 2688-80 14 1960", termination = "mechanical sleeve", slack_percent = 2 }}
ground = {{ friction = 0.5 }}
limits = {{ flight_height_m = 1.87, cable_safety_factor = 1.149, {limits} }}
delay = [{{ name = "42 ms", interval_ms = 42 }}]
[uncertainty]
launch_common_percent = 1
launch_between_shots_percent = 0
launch_row_cv_percent = 0
launch_tilt_deg = 0.5
launch_tilt_common_deg = 0
friction = [0.49, 0.51]
slack_percent = [1, 4]
axial_stiffness_percent = [-5, 5]
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
{}"#,
            (0..3).map(row).collect::<String>()
        )
    };
    let option = |text: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("plan.toml");
        std::fs::write(&path, text).expect("written");
        let output = shelter(&["check", path.to_str().expect("UTF-8"), "--format", "json"]);
        json(&output)["options"][0].clone()
    };
    let without_it = option(&plan(1, "accepted_risk_percent = 10"));
    assert_eq!(without_it["verdict"], "fail", "{}", without_it["failure_probability"]);
    let asked = option(&plan(0, "withstands_one_dud = true"));
    assert_eq!(asked["verdict"], "fail", "{}", asked["reasons"]);
    assert!(
        asked["reasons"].to_string().contains("with everything varied, row 2, hole 1"),
        "{}",
        asked["reasons"]
    );
    assert_eq!(option(&plan(0, "accepted_risk_percent = 1"))["verdict"], "pass", "nobody asked for a dud");
}

/// A loose tire of 1.6 m rises by V t − g t²/2 over a hole that fires later. From half its radius on, 0.4 m, the gap under its edge
/// is wider than the tire: at 4 m/s that is after 0.115 s.
#[test]
fn a_tire_thrown_high_covers_no_hole() {
    let verdict = |interval: usize| {
        let text = format!(
            r#"
shelter = {{ layout = "list", tire = [{{ x_m = 0, y_m = 0 }}] }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_tires = [1], launch_m_s = 4 }}, {{ name = "2", under_tires = [1], launch_m_s = 4 }}]
limits = {{ flight_height_m = 50, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = {interval} }}]
"#
        );
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let compute = ComputeSettings::of(&case.plan);
        let checked =
            check_as_planned(&case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a run");
        (checked.verdict, checked.cover.under_no_tire)
    };
    let height = |time: f64| 4.0 * time - 0.5 * GRAVITY * time * time;
    assert!(height(0.11) < 0.4 && height(0.12) > 0.4);
    assert_eq!(verdict(110), (Verdict::Pass, 0));
    assert_eq!(verdict(120), (Verdict::Undecided, 1));
}

/// A shot fired through from the middle of its row: a dud takes along its own side, told by where the holes lie. The same four tires in a
/// line, numbered otherwise, are the same shelter.
#[test]
fn a_dud_takes_its_own_side_along_however_tires_are_numbered() {
    let places_left = |numbered: [usize; 4]| {
        // Tire n lies at the place of its number; holes are listed from the left.
        let mut at = [0.0; 4];
        numbered.iter().enumerate().for_each(|(place, &tire)| at[tire - 1] = 2.6 * place as f64);
        let tires = at.map(|x| format!("{{ x_m = {x}, y_m = 0 }}")).join(", ");
        let holes =
            [0, 1, 2, 3].map(|n| format!("{{ x_m = {}, y_m = 0, launch_m_s = 6 }}", 2.6 * f64::from(n)));
        let text = format!(
            r#"
shelter = {{ layout = "list", tire = [{tires}], cable = [{{ from = 1, to = 2 }}] }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", holes = [{}] }}]
limits = {{ flight_height_m = 50, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0, hole_interval_ms = 100, hole_order = "centre", fired_through = true }}]
"#,
            holes.join(", ")
        );
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let shot = &case.shots[0];
        // The second hole from the left, beside the middle, takes the first one along, and none of the right side.
        let dud = shot.firings.iter().position(|firing| firing.number == 1).expect("a hole");
        let mut left: Vec<usize> =
            shot.with_dud(dud, Wiring::default()).firings.iter().map(|firing| firing.number).collect();
        left.sort_unstable();
        left
    };
    for numbered in [[1, 2, 3, 4], [1, 4, 2, 3], [4, 3, 2, 1], [2, 4, 1, 3]] {
        assert_eq!(places_left(numbered), [2, 3], "{numbered:?}");
    }
}

/// Twenty pairs of tires, far apart. A dud at the weaker hole of a pair lets the other tire tear at its cable: in 5 % of the shots of an
/// ordinary pair, in 16 % of the one that launches a little faster, by 4,000 samples each, where 10 % are accepted. Few samples of each of
/// forty places do not tell which it is: all that these do not clear are sampled on.
#[test]
fn a_place_among_forty_that_fails_too_often_is_found() {
    const FASTER: usize = 6;
    let place = |n: usize| (20.0 * (n % 5) as f64, 20.0 * (n / 5) as f64);
    let pairs = |words: &dyn Fn(usize, f64, f64) -> String| {
        (0..20).map(|n| words(n, place(n).0, place(n).1)).collect::<Vec<_>>().join(", ")
    };
    let tires = pairs(&|_, x, y| format!("{{ x_m = {x}, y_m = {y} }}, {{ x_m = {}, y_m = {y} }}", x + 2.6));
    let cables = pairs(&|n, _, _| format!("{{ from = {}, to = {} }}", 2 * n + 1, 2 * n + 2));
    let holes = pairs(&|n, x, y| {
        let launch = if n == FASTER { 5.13 } else { 5.0 };
        format!(
            "{{ x_m = {x}, y_m = {y}, launch_m_s = {launch} }}, {{ x_m = {}, y_m = {y}, launch_m_s = 4.6 }}",
            x + 2.6
        )
    });
    let text = format!(
        r#"
shelter = {{ layout = "list", tire = [{tires}], cable = [{cables}] }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
cable = {{ rope = "GOST 2688-80 14 1960", slack_percent = 10 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", holes = [{holes}] }}]
limits = {{ flight_height_m = 4, cable_safety_factor = 2.048611111111111, withstands_one_dud = true }}
delay = [{{ name = "x", interval_ms = 0 }}]
[uncertainty]
launch_cv_percent = 4
launch_row_cv_percent = 0
launch_common_percent = 0.5
launch_between_shots_percent = 0.5
launch_tilt_deg = 0
launch_tilt_common_deg = 0
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
tire_mass_cv_percent = 0
slack_percent = [10, 10]
"#
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    std::fs::write(&path, text).expect("written");
    let output = shelter(&["check", path.to_str().expect("UTF-8"), "--format", "json"]);
    let option = &json(&output)["options"][0];
    let dud = format!("row 1, hole {}", 2 * FASTER + 2);
    assert_eq!(option["verdict"], "fail", "{option}");
    assert!(option["reasons"].to_string().contains(&format!("with everything varied, {dud}")), "{option}");
}
