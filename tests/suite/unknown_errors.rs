//! What is not sure is not told as sure: a pass stands with three times its error, and a value that may still grow has none.

use shelter::plan::Plan;
use shelter::report::words::reasons;
use shelter::simulation::RunError;
use shelter::study::as_planned::check::{CheckedShot, check_shot};
use shelter::study::as_planned::quick_check::quick_check;
use shelter::study::as_planned::shot_reason::ShotReason;
use shelter::study::judge::Judgement;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::verdict::{Quantity, Verdict};

use super::support::{Edited, json, shelter, small_plan, text};

fn five_tires() -> Case {
    Case::new(Plan::parse("", include_str!("../../plans/paper-5-tire.toml")).expect("a shipped plan"))
}

fn check(case: &Case, step: Option<f64>) -> CheckedShot {
    let compute = ComputeSettings { step, ..ComputeSettings::of(&case.plan) };
    case.check_as_planned(0, &compute).expect("a result")
}

/// With the step fixed, and at the last of all steps that refinement may take: a limit at twice the error above the height is kept by
/// the error that is told, and not by three times that.
#[test]
fn a_pass_that_stands_only_at_once_its_error_is_open() {
    let mut case = five_tires();
    for step in [Some(2e-3), None] {
        case.limits.height = 2.0;
        let far = check(&case, step);
        assert_eq!(far.verdict, Verdict::Pass);
        // So near that the ladder goes down to its last step.
        case.limits.height = check(&case, Some(1e-5)).estimates.height.value;
        let last = check(&case, step);
        assert_eq!(last.verdict, Verdict::Undecided);
        for (errors, verdict) in [(2.0, Verdict::Undecided), (3.1, Verdict::Pass)] {
            case.limits.height = last.estimates.height.value + errors * last.estimates.height.error;
            let checked = check(&case, step);
            assert_eq!(checked.verdict, verdict, "{step:?}, {errors} errors: {:?}", checked.reasons);
            if verdict == Verdict::Undecided {
                assert!(matches!(
                    checked.reasons[..],
                    [ShotReason::NotSure { quantity: Quantity::Height, .. }]
                ));
                let words = reasons::sentences(&case, &Judgement::of_planned_alone(checked));
                assert!(words[0].contains("must also stand with three times its error"), "{words:?}");
            }
        }
    }
}

/// The same of a quick check that ends at its last step: its error is 2.5 times that of a check, and 1.8 times as far it must stand.
#[test]
fn a_quick_pass_stands_well_beyond_its_error() {
    let plan = Plan::parse("", &small_plan()).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut case = Case::new(plan);
    let compute = ComputeSettings::of(&case.plan);
    let quick = |case: &Case| {
        quick_check(&Context::new(case, compute, &StudyControl::default()), &case.shots[0]).expect("a result")
    };
    let exact =
        check_shot(&case, &case.shots[0], &ComputeSettings { step: Some(2e-5), ..compute }, &mut |_| {
            std::ops::ControlFlow::Continue(())
        });
    case.limits.height =
        exact.as_ref().map(|exact| exact.estimates.height.value).map_err(RunError::clone).expect("a result");
    let last = quick(&case);
    for (errors, verdict) in [(1.5, Verdict::Undecided), (1.9, Verdict::Pass)] {
        case.limits.height = last.values.height.value + errors * last.values.height.error;
        let judged = quick(&case);
        let differs = (judged.values.height.value / last.values.height.value - 1.0).abs();
        assert!(differs < 1e-12, "it goes to its last step");
        assert_eq!(judged.verdict, verdict, "{errors} errors");
    }
}

/// At a twentieth of a g a tire launched with 6 m/s rises for two minutes, to 36.7 m times ten; a run is given up after one. Its height
/// until then, 270 m, is no pass of 300 m, and more than 200 m whatever comes.
#[test]
fn the_height_of_a_tire_that_still_rises_is_not_known() {
    for (limit, verdict) in [(300.0, Verdict::Undecided), (200.0, Verdict::Fail)] {
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 1, columns = 1, spacing_m = 1.5 }}\n\
             tire = {{ mass_kg = 280 }}\ncable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\n\
             ground = {{ friction = 0.5 }}\n\
             blast_row = [{{ name = \"1\", under_row = 1, launch_m_s = 6 }}]\n\
             limits = {{ flight_height_m = {limit}, cable_safety_factor = 1 }}\n\
             delay = [{{ name = \"1\", interval_ms = 0 }}]\nsimulation = {{ gravity_m_s2 = 0.05 }}\n"
        );
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let checked = check(&case, None);
        assert!(
            (checked.estimates.height.value - (6.0 * 60.0 - 0.025 * 3600.0)).abs() < 1e-3,
            "{:?}",
            checked.estimates.height
        );
        assert_eq!((checked.verdict, checked.estimates.height.error), (verdict, f64::INFINITY));
        let words = reasons::sentences(&case, &Judgement::of_planned_alone(checked)).join(" ");
        assert_eq!(
            words.contains("270.000 ± unknown m is over the limit"),
            verdict == Verdict::Fail,
            "{words}"
        );
    }
}

/// The source paper's tire is in the air until 0.7 s. A run that is cut before has no error in any face; where all tires slide on,
/// none can rise, and the height has its error.
#[test]
fn values_that_may_grow_have_no_error_in_any_face() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let plan = include_str!("../../plans/paper-5-tire.toml");
    let (plan, _) = plan.split_once("\n[uncertainty]").expect("the section");
    let plan = plan.edited("breaking_force_kn = 20.4", "breaking_force_kn = 40");
    let path = path.to_str().expect("UTF-8");
    let told = |plan: &str, format: &str| {
        std::fs::write(path, plan).expect("written");
        shelter(&["check", "--nominal", path, "--format", format])
    };
    let cut = plan.edited("duration_s = 1.0", "duration_s = 0.1");
    let slides = plan.edited("friction = 0.5", "friction = 0").edited("duration_s = 1.0", "duration_s = 2.0");
    for (plan, height_is_known) in [(&cut, false), (&slides, true)] {
        let document = json(&told(plan, "json"));
        let option = &document["options"][0];
        assert_eq!(option["verdict"], "undecided");
        assert_eq!(option["flight_height_m"]["error"].is_f64(), height_is_known);
        for unknown in ["cable_force_n", "drift_m"] {
            assert!(option[unknown]["value"].is_f64() && option[unknown]["error"].is_null(), "{unknown}");
        }
        assert!(option["cable_safety_factor"].is_null());
        let csv = told(plan, "csv");
        let mut reader = csv::Reader::from_reader(csv.stdout.as_slice());
        let header = reader.headers().expect("a header").clone();
        let row = reader.records().next().expect("a row").expect("fields");
        let field = |name: &str| &row[header.iter().position(|key| key == name).expect(name)];
        assert_eq!(field("flight_height_error_m").is_empty(), !height_is_known);
        assert!(field("cable_force_error_n").is_empty() && !field("cable_force_n").is_empty());
        assert!(field("cable_safety_factor").is_empty());
        let words = told(plan, "text");
        assert!(text(&words.stdout).contains("± unknown"), "{}", text(&words.stdout));
    }
}
