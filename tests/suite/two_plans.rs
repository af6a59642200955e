//! Two plans side by side: one table, and screens that follow the plan of the selected option.

use std::sync::Arc;

use crossterm::event::KeyCode;
use shelter::jobs::News;
use shelter::plan::PlanSource;
use shelter::report::words::headline::Headline;
use shelter::study::judge::Part;
use shelter::study::question::{Found, StudyKind};
use shelter::study::{Case, Computed};
use shelter::tui::app::{App, Request};
use shelter::tui::compare::OptionState;
use shelter::tui::editor::Editor;
use shelter::tui::plan_side::{PlanOption, PlanSide};
use shelter::tui::screen::Screen;
use shelter::verdict::Verdict;

use super::support::stage::{begun, draw, finished, key, nothing_seen, recommend, samples, study_ends, text};

/// Seven options of a plan, and beside them those of the same plan with another limit and another interval.
fn two() -> App {
    let mut first = finished();
    first.screen = Screen::Compare;
    let mut second = finished();
    let source = second.case.source.clone();
    let text = source.text.replace("flight_height_m = 2.35", "flight_height_m = 2.0");
    let text = text.replacen("interval_ms = 42", "interval_ms = 50", 1);
    assert_ne!(text, source.text);
    let path = "plans/other.toml".to_owned();
    second.case = Arc::new(Case::parse(PlanSource { path: path.into(), text }).expect("a plan"));
    second.editor = Editor::new(&second.case.source.text);
    first.put_beside(second);
    first
}

fn press(app: &mut App, keys: &str) -> Request {
    keys.chars().fold(Request::None, |_, letter| key(app, KeyCode::Char(letter)))
}

#[test]
fn one_table_has_the_options_of_both_each_with_its_plan() {
    let app = two();
    assert_eq!(app.listed_options().len(), 14);
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 48));
        let rows = |letter: &str| {
            let begins = |line: &&str| line.trim_start_matches([' ', '▸']).starts_with(&format!("{letter} "));
            screen.lines().skip(5).filter(begins).filter(|line| line.matches('┃').count() == 2).count()
        };
        // The rule of the detail names the plan, too, but has no gauges.
        assert_eq!([rows("A"), rows("B")], [7, 7], "{width}:\n{screen}");
        assert!(
            ["height, own limit", "height of centres, own limit", "height own"]
                .iter()
                .any(|head| screen.contains(head)),
            "limits differ, {width}:\n{screen}"
        );
    }
}

/// The second plan is an example: that stands before its own answer.
#[test]
fn each_plan_says_itself_that_it_permits_nothing() {
    let mut app = two();
    recommend(&mut app, 4);
    let second = app.beside.as_deref_mut().expect("beside");
    recommend(second, 4);
    Arc::make_mut(&mut second.case).plan.title = Some("EXAMPLE".to_owned());
    let head = text(&draw(&app, 170, 36)).lines().nth(1).expect("a line").to_owned();
    let (first, second) = head.split_once('·').expect("two answers");
    assert!(!first.contains("DO NOT FIRE") && second.contains("DO NOT FIRE"), "{head}");
}

#[test]
fn the_screens_follow_the_plan_of_the_selected_option() {
    let mut app = two();
    key(&mut app, KeyCode::End);
    assert_eq!((app.side, app.selected), (PlanSide::B, 6));
    assert_eq!(app.case.source.name(), "plans/other.toml");
    press(&mut app, "1");
    let plan = text(&draw(&app, 120, 36));
    assert!(plan.contains("plans/other.toml") && plan.contains("height 2.0 m"), "{plan}");
    press(&mut app, "2");
    key(&mut app, KeyCode::Home);
    assert_eq!((app.side, app.selected, app.screen), (PlanSide::A, 0, Screen::Compare));
    let order = |app: &App| app.plans().iter().map(|plan| plan.side).collect::<Vec<_>>();
    assert_eq!(order(&app), [PlanSide::A, PlanSide::B], "rows stay where they are");
}

/// Two plans side by side are of one site: what was seen and stands beside one holds the other, too.
#[test]
fn what_was_seen_holds_both_plans() {
    let mut app = two();
    let passing = |app: &App| {
        let of_plan = |app: &&App| (0..7).filter(|&option| app.verdict(option) == Verdict::Pass).count();
        app.plans().iter().map(of_plan).collect::<Vec<_>>()
    };
    assert!(passing(&app).iter().all(|&count| count > 0));
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    press(&mut app, "o");
    assert_eq!(passing(&app), [0, 0]);
    key(&mut app, KeyCode::End);
    assert_eq!((app.side, passing(&app)), (PlanSide::B, vec![0, 0]));
    // Something else that agrees with the second plan says nothing of what was seen beside the first.
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 1.7 0.05"), Ok(()));
    study_ends(&mut app, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(nothing_seen())))));
    press(&mut app, "o");
    assert_eq!(passing(&app), [0, 0]);
}

#[test]
fn what_the_plans_say_differently_is_listed_with_both_values() {
    let mut app = two();
    let screen = text(&draw(&app, 80, 24));
    assert!(screen.contains("A amur-three-rows.toml, B other.toml: 2 values differ (D)"), "{screen}");
    let wide = text(&draw(&app, 120, 24));
    assert!(wide.contains("A amur-three-rows.toml, B other.toml: 2 values differ (D)"), "{wide}");
    press(&mut app, "D");
    let list = text(&draw(&app, 80, 24));
    let line = |key: &str| list.lines().find(|line| line.contains(key)).map(str::to_owned).expect(key);
    assert!(
        line("limits flight_height_m").contains("2.35") && line("limits flight_height_m").contains("2.0")
    );
    assert!(line("interval_ms").contains("42") && line("interval_ms").contains("50"), "{list}");
    key(&mut app, KeyCode::Esc);
    assert!(!app.shows_differences);
}

/// A verdict of the other plan is told without looking for it among the rows; a single value is one value.
#[test]
fn a_verdict_that_the_plans_do_not_share_is_named() {
    let mut app = two();
    let second = app.beside.as_deref_mut().expect("beside");
    let (case, sampled) = (second.case.clone(), samples(&second.case, 200, true));
    second.take_news(News::Found {
        option: 4,
        part: Part::Samples { sampled: Box::new(sampled), more: false },
    });
    let name = &case.plan.delays[4].name;
    assert_eq!(app.verdicts_that_differ(), [format!("{name} A PASS, B FAIL")]);
    let told = format!("{name} A PASS, B FAIL");
    app.selected = 4;
    for (width, words) in [(80, "verdicts differ"), (160, told.as_str())] {
        let screen = text(&draw(&app, width, 24));
        assert!(screen.contains(words), "{width}:\n{screen}");
        assert!(screen.contains("… wait, B FAIL"), "beside the selected option, {width}:\n{screen}");
    }
    press(&mut app, "D");
    assert!(text(&draw(&app, 80, 24)).contains(&told));
    key(&mut app, KeyCode::Esc);
    app.differences.truncate(1);
    assert!(text(&draw(&app, 140, 24)).contains("1 value differs (D)"));
}

/// An edit changes one plan, and the list of differences at once; leaving warns of edits of either plan.
#[test]
fn an_edit_is_one_of_the_plan_in_front() {
    let mut app = two();
    key(&mut app, KeyCode::End);
    let request = press(&mut app, "d");
    assert_eq!(request, Request::JudgeNewPlan);
    let counts = |app: &App| app.plans().iter().map(|plan| plan.options.len()).collect::<Vec<_>>();
    assert_eq!(counts(&app), [7, 6]);
    assert_eq!(app.differences.len(), 3, "{:?}", app.differences);
    key(&mut app, KeyCode::Home);
    assert!(!app.editor.unsaved());
    assert_ne!(press(&mut app, "q"), Request::Quit, "the plan beside is not saved");
    assert!(text(&draw(&app, 120, 36)).contains("not saved"));
    // Each round of the event loop brings either plan to the front.
    app.swap_plans();
    app.swap_plans();
    assert_eq!(press(&mut app, "q"), Request::Quit, "asked a second time");
}

/// Of a plan that is not saved that stands before its answer, also where the other plan is in front.
#[test]
fn an_answer_of_edits_says_that_they_are_not_saved() {
    let mut app = two();
    press(&mut app, "1");
    app.editor.find("friction", false);
    key(&mut app, KeyCode::Right);
    app.answer = Some(Headline::Nothing("none of 7 passes".to_owned()));
    key(&mut app, KeyCode::Esc);
    app.select_option(PlanOption { side: PlanSide::B, option: 0 });
    app.answer = Some(Headline::Nothing("none of 7 passes".to_owned()));
    let screen = text(&draw(&app, 170, 45));
    let first = screen.lines().nth(1).unwrap_or_default();
    let at = |words: &str| first.find(words).unwrap_or_else(|| panic!("{words}: {first}"));
    assert!(at("B none") < at("*not saved*") && at("*not saved*") < at("✗ A none"), "{first}");
}

/// News of the plan beside change its rows and nothing else.
#[test]
fn news_belong_to_their_plan() {
    let mut app = two();
    let second = app.beside.as_deref_mut().expect("beside");
    second.take_news(News::Checked { option: 0, result: begun(&second.case, Verdict::Fail) });
    assert!(matches!(app.options[0], OptionState::Judged { more_samples: false, .. }));
    assert!(app.busy(), "the plan beside computes");
}
