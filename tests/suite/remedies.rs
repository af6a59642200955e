//! What would make an option pass: every change offered does, in the very text that it writes.

use crossterm::event::KeyCode;
use serde_json::Value;
use shelter::plan::edit::change::{Change, ChangeKind};
use shelter::plan::{Layout, Plan, PlanSource, Time, Timing};
use shelter::report::remedies::FromTo;
use shelter::ropes::catalogue;
use shelter::study::as_planned::margin::{LaunchMargin, launch_margin};
use shelter::study::judge::Judgement;
use shelter::study::question::{Found, StudyKind};
use shelter::study::remedies::{Question, Remedies, Remedy, find_all_remedies};
use shelter::study::samples::sample_count::Sampling;
use shelter::study::study_trait::Study;
use shelter::study::{Case, ComputeSettings, Computed, Context, NoResult, StudyControl};
use shelter::tui::app::{App, Request};
use shelter::tui::compare::OptionState;
use shelter::verdict::Verdict;

use super::support::stage::{draw, finished, key, study_ends, text};
use super::support::{self, Edited, json, shelter, shipped_plans, small_plan_of, tested_plan};

/// Three options under a small shelter: the first fails as planned, the second by its samples, and the third passes.
const SMALL: &str = r#"
[shelter] # three by four
layout = "grid"
rows = 3
columns = 4
spacing_m = 2.6

[tire]
mass_kg = 280
outer_diameter_m = 1.6

[cable]
rope = "GOST 2688-80 9.6" # at hand
termination = "clips"
slack_percent = 2

[ground]
friction = 0.5

[[blast_row]]
name = "1"
under_row = 1
launch_m_s = 5.0

[[blast_row]]
name = "2"
under_row = 2
launch_m_s = 5.0

[limits]
flight_height_m = 1.6
cable_safety_factor = 1.3

[[delay]]
name = "60 ms"
interval_ms = 60

[[delay]]
name = "long"
at_ms = [0, 500]

[[delay]]
name = "10 ms"
interval_ms = 10

[uncertainty]
slack_percent = [1.5, 2.5]
launch_row_cv_percent = 0
launch_tilt_deg = 0
launch_tilt_common_deg = 0
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
"#;

fn parse(text: &str) -> Case {
    let source = PlanSource { path: "plan.toml".into(), text: text.to_owned() };
    Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

fn changes(case: &Case, option: usize, sampling: Option<&Sampling>) -> Remedies {
    let compute = ComputeSettings::of(&case.plan);
    let control = StudyControl::default();
    let context = Context::new(case, compute, &control).with_sampling(sampling.copied());
    let found = Question { option }.answer(&context).expect("it computes");
    assert!(!found.partial);
    found.value
}

/// The judgement that `check` makes of an option of a plan with a change, written into its text; the other options are left out.
fn checked(case: &Case, option: usize, change: &Change, sampling: Option<&Sampling>) -> Judgement {
    let mut plan = parse(&change.apply(&case.source.text).expect("the text has a place for it")).plan;
    plan.delays = vec![plan.delays.remove(option)];
    let compute = ComputeSettings::of(&plan);
    let found = Context::new(&Case::new(plan), compute, &StudyControl::default())
        .with_sampling(sampling.copied())
        .judge_options()
        .expect("it computes");
    found.value[0].clone().expect("a result")
}

/// The change offered passes in `check`, on the same values and samples to the last bit, and fresh draws confirm it.
fn all_pass_when_made(case: &Case, option: usize, sampling: Option<&Sampling>) -> usize {
    let found = changes(case, option, sampling);
    for passing in found.passing() {
        let judged = checked(case, option, &passing.change, sampling);
        assert_eq!(judged.verdict(), Verdict::Pass, "{:?}", passing.change);
        let samples = |judgement: &Judgement| {
            judgement.sampled.known().map_or(Vec::new(), |sampled| sampled.samples.clone())
        };
        let [offered, of_check] = [&passing.judgement, &judged].map(samples);
        assert_eq!(offered, of_check, "{:?}", passing.change);
        assert_eq!(passing.judgement.is_confirmed(), sampling.map(|_| true), "{:?}", passing.change);
        assert_eq!(judged.checked.estimates.height, passing.judgement.checked.estimates.height);
        assert_eq!(judged.checked.estimates.force, passing.judgement.checked.estimates.force);
    }
    found.passing().count()
}

/// Of each kind the smallest change is offered whose pass bears 5 % faster launches as planned, else the smallest that passes.
#[test]
fn what_slightly_faster_launches_end_is_offered_last() {
    let (case, mut passed_over) = (parse(SMALL), 0);
    // Whether a change passes, and if so whether it is thin.
    let passes = |option: usize, change: &Change| {
        let verdict = checked(&case, option, change, None).verdict();
        let changed = parse(&change.apply(&case.source.text).expect("the text has a place for it"));
        let control = StudyControl::default();
        let context = Context::new(&changed, ComputeSettings::of(&changed.plan), &control);
        let margin = launch_margin(&context, &changed.shots[option], verdict).expect("it computes");
        (verdict == Verdict::Pass).then(|| margin.is_thin())
    };
    for option in 0..2 {
        for tried in changes(&case, option, None).kinds {
            let passes: Vec<Option<bool>> = tried.tried.iter().map(|change| passes(option, change)).collect();
            let thick = passes.iter().position(|is_thin| *is_thin == Some(false));
            let any = passes.iter().position(Option::is_some);
            let is_thin =
                |passing: &Remedy| passing.judgement.launch_margin.is_some_and(LaunchMargin::is_thin);
            let offered = tried.passing.map(|passing| (passing.change, is_thin(&passing)));
            let expected = thick.or(any).map(|n| (tried.tried[n], thick.is_none()));
            assert_eq!(offered, expected, "{:?}", tried.kind);
            passed_over += usize::from(thick > any);
        }
    }
    assert!(passed_over > 0, "no smaller change is thin: this proves nothing");
}

#[test]
fn every_change_offered_passes_when_made() {
    let small = parse(SMALL);
    for option in [0, 1] {
        for sampling in [None, Some(&Sampling::OF_VERDICT)] {
            assert!(all_pass_when_made(&small, option, sampling) > 0);
        }
    }
    let rows = parse(&small_plan_of(&["20 ms"]));
    // A change passes with 435 of which none fails.
    let few = Sampling::exactly(600, 1);
    assert!(all_pass_when_made(&rows, 0, Some(&few)) > 0);
    assert!(all_pass_when_made(&rows, 1, None) > 0);
}

/// The plan in memory with a change, made without the text.
fn expected(plan: &Plan, change: &Change) -> Plan {
    let mut plan = plan.clone();
    match *change {
        Change::Rope(rope) => {
            plan.cable.rope = Some(rope.name.clone());
            plan.cable.axial_stiffness_kn = rope.axial_stiffness_kn;
            plan.cable.breaking_force_kn = rope.breaking_force_kn * plan.cable.termination_percent * 1e-2;
        }
        Change::Termination(termination) => {
            let rope = plan.cable.breaking_force_kn / plan.cable.termination_percent;
            plan.cable.breaking_force_kn = rope * termination.efficiency_percent;
            plan.cable.termination = Some(termination.name.clone());
            plan.cable.termination_percent = termination.efficiency_percent;
        }
        Change::BorderRows(rows) => match &mut plan.layout {
            Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.border_rows = rows,
            Layout::List { .. } => panic!("a list has no border"),
        },
        Change::Slack(percent) => {
            let moved = percent - plan.cable.slack_percent;
            plan.cable.slack_percent = percent;
            let usual = plan.uncertainty.assumed.then_some([percent - 0.1, percent + 0.1]);
            let range = plan.uncertainty.slack_percent.map(|end| end + moved);
            plan.uncertainty.slack_percent = usual.unwrap_or(range).map(|end| end.max(0.0));
        }
        Change::Launch(factor) => plan.launches_mut().for_each(|launch| launch.speed_m_s *= factor),
        Change::Interval { option, interval: new } => {
            let Timing::Interval { interval, .. } = &mut plan.delays[option].timing else {
                panic!("no interval")
            };
            let named = format!("{interval} ms");
            *interval = new;
            // What fired at once is called by its interval, too.
            if plan.delays[option].name == named || named == "0 ms" {
                plan.delays[option].name = format!("{new} ms");
            }
        }
    }
    plan
}

/// Words of a plan with its numbers to nine digits: a number of the text has six.
fn words(plan: &Plan) -> String {
    let text = format!("{plan:?}");
    let words = text.split(' ').map(|word| {
        let bare = word.trim_matches(|c: char| !c.is_ascii_digit());
        let number = bare.parse::<f64>().ok().filter(|_| bare.contains('.'));
        number.map_or_else(|| word.to_owned(), |number| word.replace(bare, &format!("{number:.9}")))
    });
    words.collect::<Vec<_>>().join(" ")
}

#[test]
fn a_change_of_the_text_is_that_change_of_the_plan_and_no_other() {
    let rope = catalogue().find("GOST 2688-80 15").expect("in the catalogue");
    let spelter = catalogue().termination("spelter socket").expect("in the catalogue");
    for path in shipped_plans() {
        let name = path.file_name().and_then(|name| name.to_str()).expect("UTF-8");
        let case = Case::load(tested_plan(name).as_ref()).expect("a plan");
        let mut changes = vec![Change::BorderRows(2), Change::Launch(0.85)];
        changes.extend([0.5, 3.0].map(Change::Slack));
        if case.plan.cable.rope.is_some() {
            changes.extend([Change::Rope(rope), Change::Termination(spelter)]);
        }
        changes.push(Change::Interval { option: 0, interval: Time::from_ms(12.5) });
        for change in changes {
            for (text, ends) in
                [(case.source.text.clone(), "\n"), (case.source.text.replace('\n', "\r\n"), "\r\n")]
            {
                let new = change.apply(&text).expect("a place for it");
                let changed = parse(&new).plan;
                assert_eq!(words(&changed), words(&expected(&case.plan, &change)), "{path:?} {change:?}");
                assert_eq!(new.matches('\n').count(), new.matches(ends).count());
                let comments = |text: &str| text.matches('#').count();
                assert_eq!(comments(&new), comments(&text), "comments stay");
                let added = new.lines().filter(|line| !text.contains(line)).count();
                assert!(added <= case.plan.launches().count().max(2), "{path:?} {change:?}: {added} lines");
            }
        }
    }
}

#[test]
fn kinds_without_a_pass_are_told_and_a_passing_option_offers_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    std::fs::write(&path, SMALL).expect("written");
    let path = path.to_str().expect("UTF-8");
    let told = shelter(&["check", path, "--why"]);
    let told = support::text(&told.stdout);
    for line in [
        "60 ms would pass with any one of these changes:",
        "    rope GOST 2688-80 12 instead of GOST 2688-80 9.6 (at most ",
        "    termination spelter socket instead of clips (",
        "    interval 48 ms instead of 60 ms (",
        "    not even 3 border rows pass",
        "long would pass with this change:",
        "    a smaller charge, seen to launch 4.75 m/s instead of 5 m/s (5 % slower) (",
        "    no stronger rope of GOST 2688-80 passes; no stronger termination passes; not even 3 border rows pass; \
         no slack tried from 0 to 4 % passes",
    ] {
        assert!(told.lines().any(|found| found.starts_with(line)), "{line}\n{told}");
    }
    assert!(!told.contains("10 ms would"), "{told}");
    let few = shelter(&["check", path, "--why", "--samples", "100"]);
    assert!(support::text(&few.stdout).contains("so few samples prove no pass"));
}

#[test]
fn scripts_read_each_change_with_its_key_and_its_judgement() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    std::fs::write(&path, SMALL).expect("written");
    let path = path.to_str().expect("UTF-8");
    let plain = json(&shelter(&["check", path, "--format", "json"]));
    for option in plain["options"].as_array().expect("options") {
        assert!(option["would_pass"].is_null() && option["would_not_pass"].is_null(), "nobody asked");
    }
    let found = json(&shelter(&["check", path, "--why", "--format", "json"]));
    assert_eq!(found["verdict"], plain["verdict"]);
    let of = |option: usize, key: &str| found["options"][option][key].as_array().expect(key).clone();
    let names = |all: &[Value]| -> Vec<String> {
        all.iter().map(|one| one["kind"].as_str().expect("a kind").to_owned()).collect()
    };
    assert_eq!(names(&of(0, "would_pass")), ["interval", "rope", "termination", "slack", "launch"]);
    assert_eq!(names(&of(0, "would_not_pass")), ["border_rows"]);
    assert_eq!(names(&of(1, "would_pass")), ["launch"]);
    assert_eq!((of(2, "would_pass").len(), of(2, "would_not_pass").len()), (0, 0), "it passes");
    for change in of(0, "would_pass") {
        assert_eq!(change["verdict"], "pass");
        assert!(change["failure_probability"]["high"].as_f64().is_some_and(|high| high < 0.01), "{change}");
        assert!(change["failure_probability"]["samples"].as_u64().is_some_and(|samples| samples >= 430));
        assert!(change["cable_force_n"].as_f64().is_some_and(|force| force > 1e3), "{change}");
        assert!(change["flight_height_m"].as_f64().is_some_and(|height| height < 1.6), "{change}");
    }
    let interval = of(0, "would_pass").remove(0);
    assert_eq!(interval["key"], "delay.interval_ms");
    assert_eq!((&interval["from"], &interval["to"]), (&"60 ms".into(), &"48 ms".into()));
    assert_eq!(interval["value"], 48.0);
    let csv = |more: &[&str]| {
        shelter(&[&["check", path, "--nominal", "--format", "csv"][..], more].concat()).stdout
    };
    assert_eq!(csv(&[]), csv(&["--why"]), "tables for scripts stay as they are");
    let nominal = json(&shelter(&["check", path, "--why", "--nominal", "--format", "json"]));
    assert!(nominal["options"][0]["would_pass"][0]["failure_probability"].is_null());
}

#[test]
fn terminations_offered_fit_and_plans_without_a_rope_have_none() {
    let kinds = |text: &str| -> Vec<ChangeKind> {
        changes(&parse(text), 0, None).kinds.iter().map(|tried| tried.kind).collect()
    };
    use ChangeKind::{BorderRows, Interval, Launch, Rope, Slack, Termination};
    assert_eq!(kinds(SMALL), [Interval, Rope, Termination, BorderRows, Slack, Launch]);
    let numbers = "axial_stiffness_kn = 3400\nbreaking_force_kn = 48.85";
    let without = SMALL.edited("rope = \"GOST 2688-80 9.6\" # at hand", numbers);
    assert_eq!(kinds(&without), [Interval, Termination, BorderRows, Slack, Launch]);
    let percent = without.edited("termination = \"clips\"", "termination_percent = 80");
    assert_eq!(kinds(&percent), [Interval, BorderRows, Slack, Launch], "nobody knows what fits");
    let found = changes(&parse(SMALL), 0, None);
    for tried in found.kinds.iter().flat_map(|tried| &tried.tried) {
        if let Change::Termination(termination) = tried {
            assert_ne!(termination.name, "swaged socket", "for steel cores only");
        }
    }
}

#[test]
fn the_time_or_the_user_ends_it() {
    let case = parse(SMALL);
    let compute = ComputeSettings::of(&case.plan);
    let find = |control: &StudyControl| {
        find_all_remedies(&Context::new(&case, compute, control).with_sampling(Sampling::OF_VERDICT), &[0, 1])
    };
    let control = StudyControl::default();
    control.expire();
    let found = find(&control).expect("what is known by then");
    assert!(found.partial);
    let open = found.value.iter().flat_map(|remedies| &remedies.kinds);
    assert!(
        open.clone().count() > 0 && open.clone().all(|tried| tried.out_of_time && tried.passing.is_none())
    );
    let control = StudyControl::default();
    control.stop();
    assert_eq!(find(&control).err(), Some(NoResult::Stopped));
}

fn screen(app: &App) -> String {
    text(&draw(app, 160, 40))
}

#[test]
fn w_lists_changes_and_enter_makes_one_that_undo_takes_back() {
    let mut app = finished();
    let before = app.editor.text.clone();
    assert_eq!(key(&mut app, KeyCode::Char('w')), Request::Study(StudyKind::Remedies));
    assert!(screen(&app).contains("what would make it pass? "));
    assert_eq!(key(&mut app, KeyCode::Esc), Request::Cancel(StudyKind::Remedies));
    key(&mut app, KeyCode::Esc);
    assert!(!screen(&app).contains("what would make it pass? "));
    assert_eq!(key(&mut app, KeyCode::Char('w')), Request::Study(StudyKind::Remedies));
    // Who asks for a change before there is one has not seen what it makes: neither that key nor the next makes it.
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
    assert!(screen(&app).contains("the changes are still being looked for"));
    let found = changes(&app.case, 0, None);
    let all: Vec<Change> = found.passing().map(|passing| passing.change).collect();
    assert!(all.len() >= 3, "its planned shots pass already: {all:?}");
    study_ends(&mut app, StudyKind::Remedies, Ok(Found::Remedies(Box::new(Computed::complete(found)))));
    assert!(screen(&app).contains("Up Down select one:") && screen(&app).contains(" interval "));
    assert!(!screen(&app).contains("still being looked for"), "the list is there");
    for code in [KeyCode::Enter, KeyCode::Char('c'), KeyCode::Enter] {
        assert_eq!(key(&mut app, code), Request::None);
        assert!(screen(&app).contains("select a change with Up Down first"));
        assert_eq!(app.editor.text, before);
    }
    key(&mut app, KeyCode::Down);
    let selects = |app: &App, kind: &str| {
        screen(app).lines().any(|line| line.contains(" > ") && line.contains(&format!(" {kind} ")))
    };
    assert!(screen(&app).contains("Enter makes the selected change") && selects(&app, "interval"));
    let narrow = text(&draw(&app, 80, 24));
    assert!(!narrow.contains("more below"), "{narrow}");
    assert!(
        text(&draw(&app, 80, 28)).contains("2.35 m  ⣀⣀"),
        "with its charts:\n{}",
        text(&draw(&app, 80, 28))
    );
    let to = |change: &Change| FromTo::new(&app.case, change).to;
    assert!(all.iter().all(|change| narrow.contains(&to(change))), "{narrow}");
    assert_eq!(key(&mut app, KeyCode::Char('w')), Request::None, "closed");
    assert!(!selects(&app, "interval"));
    assert_eq!(key(&mut app, KeyCode::Char('c')), Request::None, "and known when opened again");
    key(&mut app, KeyCode::End);
    assert!(matches!(all.last(), Some(Change::Launch(_))), "{all:?}");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None, "a number in the plan makes no charge smaller");
    assert!(screen(&app).contains("launches follow from the charge") && app.editor.text == before);
    key(&mut app, KeyCode::Home);
    key(&mut app, KeyCode::Down);
    assert_eq!(app.selected, 0, "arrows move in the list");
    assert!(selects(&app, "rope"), "{}", screen(&app));
    assert_eq!(key(&mut app, KeyCode::Char('c')), Request::JudgeNewPlan);
    assert_eq!(Ok(&app.editor.text), all[1].apply(&before).as_ref());
    assert_eq!(Some(&app.case.plan), Plan::parse("", &app.editor.text).ok().as_ref());
    assert!(screen(&app).contains("; u takes it back"), "{}", screen(&app));
    assert!(app.editor.unsaved() && app.open_remedies().is_none());
    assert_eq!(key(&mut app, KeyCode::Char('u')), Request::JudgeNewPlan);
    assert_eq!(app.editor.text, before);
}

/// Where no change passes there is none to select, and keys of other screens do not wait for one.
#[test]
fn a_list_without_a_change_leaves_enter_as_it_is() {
    let footer = |app: &App| screen(app).lines().last().expect("keys").to_owned();
    let mut app = finished();
    key(&mut app, KeyCode::Char('w'));
    let none = Remedies { option: 0, enough_samples: true, kinds: Vec::new() };
    study_ends(&mut app, StudyKind::Remedies, Ok(Found::Remedies(Box::new(Computed::complete(none)))));
    assert!(app.open_remedies().is_some() && footer(&app).contains("Enter enlarge"), "{}", footer(&app));
    key(&mut app, KeyCode::Enter);
    assert!(app.zoom && app.notice.is_none(), "{:?}", app.notice);
    let mut app = finished();
    key(&mut app, KeyCode::Char('w'));
    let found = changes(&app.case, 0, None);
    study_ends(&mut app, StudyKind::Remedies, Ok(Found::Remedies(Box::new(Computed::complete(found)))));
    assert!(!footer(&app).contains("Enter"), "no change is selected: {}", footer(&app));
    key(&mut app, KeyCode::Char('5'));
    assert!(footer(&app).contains("Enter start"), "{}", footer(&app));
}

#[test]
fn w_on_an_option_that_passes_or_is_not_judged_says_so() {
    let mut app = finished();
    app.selected = 4;
    assert_eq!(key(&mut app, KeyCode::Char('w')), Request::None);
    assert!(screen(&app).contains("42 ms passes; what it holds until is still being found"));
    app.options[4] = OptionState::Waiting;
    assert_eq!(key(&mut app, KeyCode::Char('w')), Request::None);
    assert!(screen(&app).contains("the option is not judged yet"));
    app.selected = 0;
    key(&mut app, KeyCode::Char('w'));
    key(&mut app, KeyCode::Down);
    assert_eq!(app.selected, 1, "without a list the arrows move among the options");
    study_ends(&mut app, StudyKind::Remedies, Err(NoResult::OutOfTime));
    app.selected = 0;
    assert!(screen(&app).contains("ended early"));
}
