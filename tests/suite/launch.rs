//! Where a launch velocity comes from: estimates are written as they are, and no verdict passes on a velocity that nobody observed.

use std::fs;

use serde_json::Value;
use shelter::plan::PlanSource;
use shelter::plan::observations::Observations;
use shelter::study::fit::between_shots::BetweenShotsSource;
use shelter::study::fit::{Fit, FitRequest, FitResult, fit, observable_names};
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::{Sampling, Verdict, choice::Unknown};

use crate::support::{Edited, json, shelter, text};

/// Two lone tires over holes of 6 m/s, in two blast rows. With these limits no sample fails, however fast it leaves.
const CALM: &str = "shelter = { layout = \"list\", tire = [{ x_m = 0, y_m = 0 }, { x_m = 9, y_m = 0 }], cable = [] }\n\
     tire = { mass_kg = 280 }\ncable = { rope = \"GOST 2688-80 6.2\" }\nground = { friction = 0.5 }\n\
     blast_row = [{ name = \"1\", under_tires = [1], launch_m_s = 6 }, { name = \"2\", under_tires = [2], launch_m_s = 6 }]\n\
     limits = { flight_height_m = 1000, cable_safety_factor = 2 }\n\
     delay = [{ name = \"a\", interval_ms = 20 }, { name = \"b\", interval_ms = 40 }]\n\
     search = { intervals_ms = [20, 40] }\nsize = { ropes = \"GOST 2688-80\" }\n\
     [uncertainty]\nlaunch_common_percent = 10\n";

fn estimated() -> String {
    CALM.edited("launch_common_percent = 10", "launch_common_percent = 50")
}

fn case_of(text: &str) -> Case {
    let source = PlanSource { path: "plan.toml".to_owned(), text: text.to_owned() };
    Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Every command that gives a verdict or recommends passes on the filmed launch, and is open on the estimated one; sampled and as
/// planned. Nothing fails, so the words are those of an estimate.
#[test]
fn nothing_passes_on_a_launch_that_nobody_observed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (filmed, guessed, page) = (path("filmed.toml"), path("estimated.toml"), path("page.html"));
    fs::write(&filmed, CALM).expect("a plan");
    fs::write(&guessed, estimated()).expect("a plan");
    let commands: [&[&str]; 12] = [
        &["check"],
        &["check", "--nominal"],
        &["check", "--any"],
        &["risk", "--samples", "600"],
        &["sweep", "--interval", "20..24:1"],
        &["sweep", "--nominal", "--interval", "20..24:1"],
        &["orders"],
        &["orders", "--nominal"],
        &["search"],
        &["search", "--nominal"],
        &["size"],
        &["size", "--nominal"],
    ];
    for command in commands {
        let status = |plan: &str| {
            let output = shelter(&[&command[..1], &[plan], &command[1..]].concat());
            (output.status.code(), text(&output.stdout).to_owned(), text(&output.stderr).to_owned())
        };
        let (code, out, err) = status(&filmed);
        assert_eq!(code, Some(0), "{command:?} of a filmed launch: {out}{err}");
        let (code, out, err) = status(&guessed);
        assert_eq!(code, Some(1), "{command:?} of an estimated launch: {out}{err}");
        assert!(out.contains("launch estimated"), "{command:?} does not say why: {out}{err}");
        let last = out.lines().last().unwrap_or_default();
        assert!(last.starts_with("OPEN") && !last.contains("PASS"), "{command:?}: {out}");
    }
    let report = |plan: &str| shelter(&["report", plan, "-o", &page, "--option", "a"]).status.code();
    assert_eq!(report(&filmed), Some(0));
    assert!(fs::read_to_string(&page).expect("a page").contains("To be fired"));
    assert_eq!(report(&guessed), Some(1));
    let page = fs::read_to_string(&page).expect("a page");
    assert!(page.contains("launch estimated") && !page.contains("To be fired"));
    let document = json(&shelter(&["check", &guessed, "--format", "json"]));
    assert_eq!(document["verdict"], Value::from("undecided"));
}

/// What fails on an estimated launch still fails.
#[test]
fn an_estimate_hides_no_failure() {
    let case = case_of(&estimated().edited("flight_height_m = 1000", "flight_height_m = 1"));
    let control = StudyControl::default();
    let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
    let judged = context.with_sampling(Sampling::OF_VERDICT).judge_options().expect("a result");
    assert!(judged.value.iter().flatten().all(|judged| judged.verdict() == Verdict::Fail));
}

fn seen(case: &Case, heights: [f64; 2], sd: f64) -> Observations {
    let [first, second] = heights;
    let lines = format!(
        "option,tire,quantity,value,sd\na,1,flight_height_m,{first},{sd}\na,2,flight_height_m,{second},{sd}\n"
    );
    Observations::parse("seen.csv", &lines, &observable_names(case))
        .unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn fit_of(case: &Case, files: &[Observations]) -> Fit {
    let request = FitRequest { files, unknowns: &[Unknown::Launch] };
    let control = StudyControl::default();
    let context = Context::new(case, ComputeSettings::of(&case.plan), &control);
    let found = fit(&context.with_sampling(Sampling::exactly(1, 1)), &request);
    match found.expect("a result").value {
        FitResult::Fitted(fit) => fit,
        other => panic!("{other:?}"),
    }
}

/// Height of a lone tire that leaves at 6 m/s times this factor.
fn height(factor: f64) -> f64 {
    (6.0 * factor).powi(2) / (2.0 * 9.81)
}

/// Shots 30 % apart contradict a plan that says 3 %: the fit takes their own scatter, and says so.
#[test]
fn shots_that_differ_by_more_than_stated_widen_what_is_written() {
    let text = CALM
        .edited("launch_common_percent = 10", "launch_common_percent = 10\nlaunch_between_shots_percent = 3");
    let case = case_of(&text);
    let apart = [0.85, 1.15].map(|factor| seen(&case, [height(factor); 2], 0.02));
    let fit = fit_of(&case, &apart);
    let between = fit.between_shots.expect("samples");
    assert_eq!(between.source, BetweenShotsSource::WiderThan(3.0));
    // Two shots 0.30 apart scatter by 0.30/√2.
    assert!((15.0..27.0).contains(&between.percent), "{between:?}");
    let report = shelter::report::fit::report(&case, &apart, &fit, true);
    assert!(
        report.warnings.iter().any(|told| told.contains("the shots differ from one another")),
        "{report:?}"
    );
    assert_eq!(fit.launches.map(|launches| launches.between_shots_percent), Some(between.percent));
    let alike = [0.98, 1.02].map(|factor| seen(&case, [height(factor); 2], 0.02));
    assert_eq!(
        fit_of(&case, &alike).between_shots.map(|between| between.source),
        Some(BetweenShotsSource::Stated)
    );
}

/// Five freakishly equal shots do not show that shots differ by less than each was read to: 0.1 m of 1.83 m is 2.7 % of the launch,
/// and two tires 1.9 %, beside what holes and rows differ by, 1 % each.
#[test]
fn freakishly_equal_shots_are_not_known_better_than_they_were_read() {
    let text = CALM
        .edited("launch_common_percent = 10", "launch_common_percent = 10\nlaunch_between_shots_percent = 5");
    let case = case_of(&text);
    let shot = |n: usize| seen(&case, [height(1.0) + 1e-4 * n as f64, height(1.0) - 1e-4 * n as f64], 0.1);
    let shots: Vec<Observations> = (0..5).map(shot).collect();
    let between = fit_of(&case, &shots).between_shots.expect("samples");
    assert_eq!(between.source, BetweenShotsSource::UpperBound);
    assert!((1.9..3.0).contains(&between.percent), "{between:?}");
    let read_well: Vec<Observations> =
        (0..5).map(|n| seen(&case, [height(1.0) + 1e-6 * f64::from(n), height(1.0)], 1e-5)).collect();
    // Holes and rows scatter by 1 % each: two tires tell a shot to 1 %.
    assert!(fit_of(&case, &read_well).between_shots.is_some_and(|between| between.percent >= 0.95));
}

/// A shot that was typed again, with other digits, is told; two shots that differ as shots do are not. The log of a firing time that
/// is not that of the plan stands in the report of the fit.
#[test]
fn a_shot_typed_again_and_a_log_against_the_plan_are_told() {
    let case = case_of(CALM);
    let told = |files: &[Observations]| {
        shelter::report::fit::report(&case, files, &fit_of(&case, files), true).warnings.join("\n")
    };
    let again = [seen(&case, [1.80, 1.95], 0.05), seen(&case, [1.8004, 1.9502], 0.06)];
    assert!(told(&again).contains("typed again"), "{}", told(&again));
    let two = [seen(&case, [1.80, 1.95], 0.05), seen(&case, [1.87, 1.90], 0.05)];
    assert!(!told(&two).contains("typed again"), "{}", told(&two));
    let logged = |at: f64| {
        let lines =
            format!("option,tire,quantity,value,sd\na,1,flight_height_m,1.8,0.05\na,2,firing_s,{at},\n");
        let read = Observations::parse("log.csv", &lines, &observable_names(&case));
        told(&[read.unwrap_or_else(|mistakes| panic!("{mistakes}"))])
    };
    assert!(logged(0.035).contains("logged firing times are not those of the plan"));
    assert!(!logged(0.0201).contains("logged firing times"));
}
