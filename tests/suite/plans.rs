//! Plans that are right: what they come to.

use std::path::Path;

use proptest::prelude::*;
use shelter::choice::Accuracy;
use shelter::plan::starter::{self, LAUNCH, QUESTIONS};
use shelter::plan::{DelayScatter, LaunchTargets, Layout, Plan, Timing, Uncertainty};
use shelter::scene::TireId;
use shelter::study::judge::recommend::{MustPass, verdict_on_plan};
use shelter::study::samples::sample_count::Sampling;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::verdict::Verdict;

use super::support::shipped_plans;

fn shipped(name: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("plans").join(name);
    Plan::load(&path).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn every_shipped_plan_loads() {
    let plans = shipped_plans();
    assert_eq!(plans.len(), 4);
    for path in plans {
        let case = Case::load(&path).expect("a plan");
        assert!(case.shots.iter().all(|shot| !shot.firings.is_empty()));
    }
}

#[test]
fn the_paper_plan_is_five_tires_with_a_metre_of_diagonal() {
    let case = Case::new(shipped("paper-5-tire.toml"));
    assert_eq!((case.scene().tire_count(), case.scene().cables.len()), (5, 8));
    let diagonals = case.scene().cables.iter().filter(|cable| (cable.rest_length - 1.0).abs() < 1e-12);
    assert_eq!(diagonals.count(), 4);
    assert_eq!(case.scene().tire_ids[case.shots[0].firings[0].tire], TireId::Cell { row: 1.5, column: 1.5 });
    assert!((case.limits.force - 20_400.0).abs() < 1e-9);
}

#[test]
fn cables_between_rims_are_a_diameter_shorter_and_slack_lengthens_them() {
    let case = Case::new(shipped("amur-three-rows.toml"));
    let lengths: Vec<f64> = case.scene().cables.iter().map(|cable| cable.rest_length).collect();
    let row = 1.02 * (2.6 - 1.6);
    let diagonal = 1.02 * (2.6 * std::f64::consts::SQRT_2 - 1.6);
    let near = |length: f64| lengths.iter().filter(|l| (**l - length).abs() < 1e-12).count();
    assert_eq!((near(row), near(diagonal)), (85, 72));
    let stiffness = case.scene().cables[0].stiffness * case.scene().cables[0].rest_length;
    assert!((stiffness - case.plan.cable.axial_stiffness_kn * 1e3).abs() < 1e-6);
}

const LIST: &str = r#"
[shelter]
layout = "list"
[[shelter.tire]]
x_m = 0
y_m = 0
[[shelter.tire]]
x_m = 2.0
y_m = 0
mass_kg = 100
[[shelter.cable]]
from = 1
to = 2
[tire]
mass_kg = 280
[cable]
axial_stiffness_kn = 1519
breaking_force_kn = 20
termination = "clips"
[ground]
friction = 0.5
[[blast_row]]
name = "a"
under_tires = [2]
free_flight_height_m = 1.834862385321101
[[blast_row]]
name = "b"
holes = [{ x_m = 0.4, y_m = -0.3, launch_m_s = 5 }]
[limits]
flight_height_m = 1
cable_safety_factor = 2
[[delay]]
name = "turned"
order = ["b", "a"]
interval_ms = 25
"#;

#[test]
fn a_list_layout_names_tires_by_number_and_holes_launch_the_nearest() {
    let plan = Plan::parse("list.toml", LIST).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert!(matches!(&plan.layout, Layout::List { tires, .. } if tires.len() == 2));
    let LaunchTargets::UnderTires { launch, .. } = plan.blast_rows[0].targets else {
        panic!("row a lists tires")
    };
    assert!((launch.speed_m_s - 6.0).abs() < 1e-12, "V0 = √(2 g h)");
    assert_eq!(plan.cable.breaking_force_kn, 16.0, "clips hold 80 %");
    assert!(matches!(&plan.delays[0].timing, Timing::Interval { order, .. } if order == &[1, 0]));
    let case = Case::new(plan);
    assert_eq!(case.scene().mass, [280.0, 100.0]);
    let fired: Vec<_> = case.shots[0].firings.iter().map(|f| (f.tire, f.time)).collect();
    assert_eq!(fired, [(0, 0.0), (1, 0.025)]);
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_are_welcome() {
    let windows = format!("\u{feff}{}", LIST.replace('\n', "\r\n"));
    assert!(Plan::parse("list.toml", &windows).is_ok());
}

proptest! {
    /// Whatever the text, reading ends with a plan or with mistakes that lie inside it.
    #[test]
    fn no_text_is_too_broken_to_read(text in ".{0,200}") {
        if let Err(mistakes) = Plan::parse("x", &text) {
            prop_assert!(!mistakes.is_empty());
            let _ = mistakes.render(true);
        }
    }

    /// A valid plan with one stretch replaced by another.
    #[test]
    fn no_damage_to_a_plan_is_too_much(start in 0..LIST.len(), length in 0..60_usize, put in "[ -~\n]{0,30}") {
        let end = (start + length).min(LIST.len());
        let text = format!("{}{put}{}", &LIST[..start], &LIST[end..]);
        match Plan::parse("x", &text) {
            Ok(plan) => drop(Case::new(plan)),
            Err(mistakes) => prop_assert!(!mistakes.render(false).is_empty()),
        }
    }
}

/// A section left out and a key left out mean the same: known to 1 %, cables and directions as planned.
#[test]
fn what_a_plan_does_not_say_is_known_to_one_percent() {
    let read = |more: &str| {
        let text = format!("{}{more}", super::bad_plans::GOOD);
        Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")).uncertainty
    };
    let assumed = read("");
    let expected = Uncertainty {
        incomplete: true,
        assumed: true,
        delay: DelayScatter { sd_ms: 0.1, cv_percent: 0.01 },
        in_hole_delay_ms: 0.0,
        launch_cv_percent: 1.0,
        launch_common_percent: 1.0,
        launch_between_shots_percent: 1.0,
        launch_mass_exponent: [0.0, 1.0],
        launch_row_cv_percent: 1.0,
        launch_tilt_deg: 1.0,
        launch_tilt_common_deg: 0.5,
        hole_position_m: 0.05,
        pattern_offset_m: 0.05,
        hole_fails_percent: 0.01,
        cable_length_m: 0.01,
        friction: [0.495, 0.505],
        slack_percent: [0.0, 0.1],
        axial_stiffness_percent: [-1.0, 1.0],
        tire_mass_cv_percent: 1.0,
        breaking_force_cv_percent: 0.0,
    };
    assert_eq!(assumed, expected);
    assert_eq!(read("[uncertainty]\n"), Uncertainty { assumed: false, ..expected });
    let some = read("[uncertainty]\ndelay_cv_percent = 2\nfriction = [0.4, 0.4]\nin_hole_delay_ms = 500\n");
    let delay = DelayScatter { sd_ms: 0.0, cv_percent: 2.0 };
    let friction = [0.4, 0.4];
    assert_eq!(some, Uncertainty { assumed: false, delay, friction, in_hole_delay_ms: 500.0, ..expected });
}

/// Who takes all that the questions offer, and filmed that launch, begins with a plan that works, not with a wall of FAIL. Who filmed
/// nothing has no PASS: the velocity offered is a guess.
#[test]
fn the_answers_offered_give_an_option_that_passes_once_the_launch_was_filmed() {
    let offered = QUESTIONS.map(|question| question.offered);
    let mut filmed = offered;
    filmed[LAUNCH] = "4 filmed";
    for (answers, passes) in [(filmed, true), (offered, false)] {
        let text = starter::plan(&answers).expect("answers");
        let case = Case::new(Plan::parse("new", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        // One that passes is enough, and the velocity is that of all.
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let case = case.with_options(&[option]);
        let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
        let judged = Context::new(&case, compute, &StudyControl::default())
            .with_sampling(Sampling::OF_VERDICT)
            .judge_options();
        let verdict = verdict_on_plan(&judged.expect("a result").value, MustPass::One);
        assert_eq!(verdict == Verdict::Pass, passes, "{verdict:?}");
    }
}
