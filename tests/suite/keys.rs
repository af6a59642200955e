//! What keys and clicks do, without a terminal.

use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use itertools::Itertools;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::layout::Position;
use shelter::choice::{Accuracy, Unknown};
use shelter::file::canonical;
use shelter::jobs::News;
use shelter::plan::edit::change::Change;
use shelter::plan::examples::EXAMPLES;
use shelter::plan::starter::{self, LAUNCH_IS_KNOWN, NOT_KNOWN, QUESTIONS, RIGID_ENDS};
use shelter::plan::{PlanSource, Time};
use shelter::report::words::objections::sentences;
use shelter::study::Case;
use shelter::study::as_planned::margin::LaunchMargin;
use shelter::study::assumptions::assumed::Assumed;
use shelter::study::assumptions::{Assumption, Assumptions};
use shelter::study::check::JudgedPlan;
use shelter::study::fit::ComparedWithObservations;
use shelter::study::fit::observation_bands::Prediction;
use shelter::study::fit::observed_shots::ObservedShots;
use shelter::study::fit::{self, FitResult};
use shelter::study::judge::batch::Depth;
use shelter::study::judge::grounds::Evidence;
use shelter::study::judge::one_dud::OneDud;
use shelter::study::judge::recommend::MustPass;
use shelter::study::judge::{Judgement, Part};
use shelter::study::question::{Found, StudyKind};
use shelter::study::study_trait::Study;
use shelter::study::{Computed, Context, FileState, NoResult, StudyControl};
use shelter::tui::app::{App, ClickTarget, Request};
use shelter::tui::compare::{OptionState, SortBy};
use shelter::tui::config::Config;
use shelter::tui::dispatch;
use shelter::tui::editor::EditOutcome;
use shelter::tui::editor::entry::Entry;
use shelter::tui::export;
use shelter::tui::fitted_plan::FittedPlan;
use shelter::tui::old_pages::permitting_wrongly;
use shelter::tui::prompt::Purpose;
use shelter::tui::screen::Screen;
use shelter::tui::start::{Next, Opened, Start, StartLine};
use shelter::tui::studies::StudyState;

use shelter::verdict::Verdict;

use super::support::Edited;
use super::support::stage::{
    checked, draw, draw_areas, finished, key, measured, nothing_seen, recommend, recorded, samples, save,
    spreads, study_ends, swept, text, withstood_dud,
};

fn press(app: &mut App, keys: &str) -> Request {
    keys.chars().fold(Request::None, |_, letter| key(app, KeyCode::Char(letter)))
}

/// Clicks on the first place where the screen shows `words`.
fn click(app: &mut App, words: &str) -> Request {
    let screen = text(&draw(app, 120, 36));
    app.areas = draw_areas(app, 120, 36);
    let (row, line) = screen.lines().enumerate().find(|(_, line)| line.contains(words)).expect(words);
    let column = line[..line.find(words).expect("in the line")].chars().count();
    let at = Position::new(column as u16, row as u16);
    let mouse = MouseEvent {
        kind: MouseEventKind::Down(MouseButton::Left),
        column: at.x,
        row: at.y,
        modifiers: KeyModifiers::NONE,
    };
    dispatch(app, &Event::Mouse(mouse))
}

/// Clicks on a cell of a screen of this size.
fn click_at(app: &mut App, (column, row): (u16, u16), (width, height): (u16, u16)) -> Request {
    app.areas = draw_areas(app, width, height);
    let kind = MouseEventKind::Down(MouseButton::Left);
    dispatch(app, &Event::Mouse(MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE }))
}

fn listed(app: &App) -> Vec<usize> {
    app.listed_options().into_iter().map(|at| at.option).collect()
}

fn names(app: &App) -> Vec<&str> {
    listed(app).iter().map(|&option| app.case.plan.delays[option].name.as_str()).collect()
}

/// As long as an option was not tried, another is ahead of nothing.
#[test]
fn none_is_ahead_before_all_were_tried() {
    let mut app = finished();
    assert!(app.ahead().is_some());
    app.options[1] = OptionState::Waiting;
    assert_eq!(app.ahead(), None);
}

/// Five hundred shots that are all the same show nothing that one does not.
#[test]
fn shots_that_vary_nothing_are_not_counted_for_sure() {
    let mut app = finished();
    app.selected = 4;
    let says =
        |app: &App| text(&draw(app, 80, 24)).contains("nothing is varied: all 500 computed shots are alike");
    assert!(!says(&app));
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("judged") };
    let Evidence::Known(sampled) = &mut judgement.sampled else { panic!("samples") };
    sampled.samples.iter_mut().for_each(|sample| (sample.run.height, sample.run.force) = (1.0, 2e4));
    assert!(says(&app), "{}", text(&draw(&app, 80, 24)));
}

/// What is still tried has not ended early.
#[test]
fn a_dud_that_is_still_tried_is_not_said_to_be_unknown() {
    let mut app = finished();
    app.selected = 4;
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("judged") };
    judgement.withstands_dud = Evidence::Awaited;
    app.zoom = true;
    let says = |app: &App| {
        text(&draw(app, 120, 36)).contains("whether it withstands one dud is not known: ended early")
    };
    assert!(says(&app), "{}", text(&draw(&app, 120, 36)));
    let OptionState::Judged { more_samples, .. } = &mut app.options[1] else { panic!("judged") };
    *more_samples = true;
    assert!(!says(&app), "{}", text(&draw(&app, 120, 36)));
}

#[test]
fn options_are_sorted_filtered_and_compared() {
    let mut app = finished();
    for (n, row) in app.options.iter_mut().enumerate() {
        let OptionState::Judged { judgement, .. } = row else { panic!("done") };
        // The planned shots stand in another order than those that decide.
        judgement.checked.estimates.height.value = 1.0 - 0.1 * n as f64;
        let Evidence::Known(sampled) = &mut judgement.sampled else { panic!("samples") };
        let height = [1.03, 1.01, 1.02, 1.05, 1.04, 1.07, 1.06][n];
        sampled.samples.iter_mut().for_each(|sample| sample.run.height = height);
    }
    app.options[1] = OptionState::Waiting;
    press(&mut app, "ooo");
    assert_eq!(app.listing.sort, SortBy::Risk);
    assert_eq!(
        listed(&app),
        [4, 3, 5, 0, 2, 6, 1],
        "500 samples without a failure, 200, and one failure in ten"
    );
    press(&mut app, "o");
    assert_eq!(app.listing.sort, SortBy::Height);
    assert_eq!(listed(&app), [2, 0, 4, 3, 6, 5, 1], "those without a result are last");
    press(&mut app, "O");
    assert_eq!(listed(&app), [5, 6, 3, 4, 0, 2, 1]);
    press(&mut app, "G");
    assert_eq!(app.selected, 1, "keys follow the list");
    press(&mut app, "/pass");
    assert_eq!(listed(&app), [4], "verdicts are found");
    assert_eq!(app.selected, 4);
    key(&mut app, KeyCode::Enter);
    assert!(app.prompt.is_none());
    key(&mut app, KeyCode::Esc);
    assert_eq!(listed(&app).len(), 7, "Esc shows all again");
    press(&mut app, "/open");
    let is_open = |&option: &usize| app.options[option].verdict() == Verdict::Undecided;
    assert!(!listed(&app).is_empty() && listed(&app).iter().all(is_open), "as the screen says it");
    key(&mut app, KeyCode::Esc);
    press(&mut app, "/MIDDLE");
    assert_eq!(names(&app), ["25 ms, middle first"]);
    key(&mut app, KeyCode::Esc);
    press(&mut app, "/nothing");
    assert!(text(&draw(&app, 120, 36)).contains("no option has 'nothing'"));
    key(&mut app, KeyCode::Esc);
    app.selected = 0;
    press(&mut app, "b");
    let screen = text(&draw(&app, 200, 36));
    assert!(screen.contains("=all at once") && screen.contains("+0.0"), "{screen}");
    press(&mut app, "b");
    assert!(app.baseline().is_none());
}

#[test]
fn commands_are_chosen_by_name() {
    let mut app = finished();
    press(&mut app, ":finer");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Judge);
    press(&mut app, ":zzz");
    assert!(text(&draw(&app, 100, 30)).contains("no command has these letters"));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
    press(&mut app, ":");
    key(&mut app, KeyCode::Esc);
    assert!(app.prompt.is_none());
}

#[test]
fn clicks_do_what_keys_do() {
    let mut app = finished();
    click(&mut app, "20 ms");
    assert_eq!(app.selected, 2);
    click(&mut app, "▸20 ms");
    assert!(app.zoom, "a second click opens");
    key(&mut app, KeyCode::Esc);
    click(&mut app, "force, limit");
    assert_eq!(app.listing.sort, SortBy::Force);
    click(&mut app, "4 Studies");
    assert_eq!(app.screen, Screen::Studies);
    click(&mut app, "Orders");
    assert_eq!(app.studies.shown, StudyKind::Orders);
    click(&mut app, "1 Plan");
    click(&mut app, "9 ms          ");
    assert_eq!(app.selected, 1);
    click(&mut app, "interval, ms");
    assert!(app.editor.typed().is_some());
    key(&mut app, KeyCode::Esc);
    click(&mut app, "? help");
    assert!(app.help);
    click(&mut app, "Everywhere");
    assert!(!app.help, "a click closes the help");
    let wheel =
        MouseEvent { kind: MouseEventKind::ScrollDown, column: 0, row: 9, modifiers: KeyModifiers::NONE };
    let before = app.editor.selected;
    dispatch(&mut app, &Event::Mouse(wheel));
    assert_eq!(app.editor.selected, before + 1);
    assert_eq!(click(&mut app, "q quit"), Request::Quit);
}

#[test]
fn a_flight_is_asked_for_once_and_played() {
    let mut app = finished();
    press(&mut app, "3");
    assert_eq!(app.request_flight(), Request::Study(StudyKind::Flight));
    assert_eq!(app.request_flight(), Request::None);
    assert!(text(&draw(&app, 100, 30)).contains("recording"));
    let flight = recorded(&app, 0);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    let worst = app.flight().expect("a flight").outcome.force.time;
    assert_eq!(app.player.time, worst, "it opens at the worst moment");
    let says = |app: &App, words: &str| text(&draw(app, 120, 36)).contains(words);
    assert!(says(&app, "MOST FORCE"), "{}", text(&draw(&app, 120, 36)));
    key(&mut app, KeyCode::Home);
    assert!(says(&app, "rows 1, 2, 3 fire 0.000 s"), "{}", text(&draw(&app, 120, 36)));
    press(&mut app, " ");
    assert!(app.playing());
    app.advance(std::time::Duration::from_secs(1));
    assert_eq!(app.player.time, 0.1, "a tenth of real time");
    press(&mut app, " h");
    assert!((app.player.time - 0.09).abs() < 1e-12);
    app.areas = draw_areas(&app, 120, 36);
    key(&mut app, KeyCode::End);
    click(&mut app, "▲");
    assert_eq!(app.player.time, 0.0, "the left end of the bar, where the rows fire");
    press(&mut app, "j");
    assert_eq!((app.selected, app.request_flight()), (1, Request::Study(StudyKind::Flight)));
}

/// On Compare and on Flight `m` draws the other shot, and both say which is drawn.
#[test]
fn m_switches_between_the_shot_that_decides_and_the_planned_one() {
    let mut app = finished();
    let row = |app: &App| -> [String; 2] {
        let screen = text(&draw(app, 80, 24));
        let starts = [" option", "▸all at once"];
        starts.map(|start| screen.lines().find(|line| line.starts_with(start)).expect(start).to_owned())
    };
    let [head, deciding] = row(&app);
    assert_eq!((head.matches("1 in 100").count(), head.matches("as planned").count()), (1, 0), "{head}");
    assert!(text(&draw(&app, 80, 24)).contains("m planned"), "{}", text(&draw(&app, 80, 24)));
    press(&mut app, "m");
    let [head, planned] = row(&app);
    // The bars are still those of the shot that decides.
    assert!(head.contains("⠒ as planned ▆ 1 in 100"), "{head}");
    assert_ne!(deciding, planned);
    assert!(!text(&draw(&app, 120, 36)).contains("█ 1 in 100"));
    assert!(text(&draw(&app, 120, 36)).contains("force in time ⠒ planned"));
    press(&mut app, "3");
    for (words, sample) in [("FAIL · drawn: as planned", None), ("FAIL · 1 in 100 above", Some(7))] {
        assert_eq!(app.request_flight(), Request::Study(StudyKind::Flight));
        let mut flight = recorded(&app, 0);
        if let Found::Flight(flight) = &mut flight {
            flight.value.outcome.force.value = 5e4;
        }
        study_ends(&mut app, StudyKind::Flight, Ok(flight));
        assert!(text(&draw(&app, 80, 24)).contains(words), "{}", text(&draw(&app, 80, 24)));
        let flight = app.flight().expect("a flight");
        assert_eq!(flight.sample.map(|sample| sample.number), sample);
        let outcome = &flight.outcome;
        // Which is nearer to its limit is no matter of units: of a force of 50 kN it is, unless the limit of height is low.
        let mut low = app.case.limits;
        low.height = 0.1 * outcome.height.value;
        assert_eq!(flight.worst_moment(&low), outcome.height.time);
        low.height = 1e3 * outcome.height.value;
        assert_eq!(flight.worst_moment(&low), outcome.force.time);
        assert_eq!(app.player.time, flight.worst_moment(&app.case.limits), "it opens at the worst moment");
        app.player.time = outcome.force.time;
        // The shot worst by height is not the one that pulls hardest, and its force alone would read as the most there is.
        for width in [60, 80, 120] {
            let screen = text(&draw(&app, width, 24));
            let tells = [
                "others 59.7 in 1:1-1:2",
                "in others 59.7 kN in 1:1-1:2",
                "other shots 1 in 100 pulls over 59.7 kN in 1:1-1:2",
            ];
            assert_eq!(tells.iter().any(|words| screen.contains(words)), sample.is_some(), "{screen}");
        }
        press(&mut app, "m");
    }
}

/// A flight of the shot that decided goes on while more shots come; then it is that of the shot that decides, as its title says.
#[test]
fn a_flight_is_of_the_shot_that_decides_once_no_more_come() {
    let mut app = finished();
    press(&mut app, "3");
    assert_eq!(app.request_flight(), Request::Study(StudyKind::Flight));
    assert_eq!(app.request_flight(), Request::None);
    let OptionState::Judged { judgement, more_samples } = &mut app.options[0] else { panic!("judged") };
    judgement.deciding.as_mut().expect("shots").samples.of_any.number += 1;
    *more_samples = true;
    assert_eq!(app.request_flight(), Request::None);
    let OptionState::Judged { more_samples, .. } = &mut app.options[0] else { panic!("judged") };
    *more_samples = false;
    assert_eq!(app.request_flight(), Request::Study(StudyKind::Flight));
}

/// Without its own run among shots that decide, an option draws nothing: its planned shot would flatter it.
#[test]
fn no_planned_shot_stands_among_those_that_decide() {
    let mut app = finished();
    let OptionState::Judged { judgement, .. } = &mut app.options[1] else { panic!("judged") };
    judgement.deciding = None;
    let screen = text(&draw(&app, 80, 24));
    let row = screen.lines().find(|line| line.starts_with(" 9 ms")).expect("its row");
    assert_eq!(row.matches("not run").count(), 2, "{row}");
}

/// A click on a chart of Compare opens the flight at that time; one on a chart of Flight goes there.
#[test]
fn clicks_on_charts_show_their_time() {
    let mut app = finished();
    let charts = |app: &App| -> Vec<_> {
        let areas = draw_areas(app, 120, 36).into_iter();
        let time = |target| if let ClickTarget::Time(end) = target { Some(end) } else { None };
        areas.filter_map(|(area, target)| Some(area).zip(time(target))).collect()
    };
    let right_end = |app: &mut App, n: usize| {
        let (area, end) = charts(app)[n];
        app.areas = draw_areas(app, 120, 36);
        app.click(Position::new(area.right() - 1, area.y));
        end
    };
    assert_eq!(charts(&app).len(), 2);
    let end = right_end(&mut app, 1);
    assert_eq!((app.screen, app.request_flight()), (Screen::Flight, Request::Study(StudyKind::Flight)));
    let flight = recorded(&app, 0);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    assert_eq!(app.player.time, end.min(app.flight().expect("a flight").end()));
    key(&mut app, KeyCode::Home);
    assert_eq!(charts(&app).len(), 3, "the bar and two charts");
    right_end(&mut app, 2);
    assert_eq!(app.player.time, app.flight().expect("a flight").end());
}

/// Enter takes the next observation, whether or not there is a result; it is shown whole behind the line being typed.
#[test]
fn enter_on_fit_takes_the_next_observation() {
    let mut app = finished();
    press(&mut app, "4");
    app.studies.select(StudyKind::Fit);
    app.selected = 4;
    assert_eq!(app.record.add_line(&app.case, 4, "3:1 1.95 0.05"), Ok(()));
    let compared =
        ComparedWithObservations { fitted: Some(FitResult::KnownExactly(Unknown::Launch)), ..nothing_seen() };
    study_ends(&mut app, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(compared)))));
    assert!(!app.studies.open);
    key(&mut app, KeyCode::Enter);
    assert!(app.studies.open && app.prompt.as_ref().is_some_and(|line| line.purpose == Purpose::Fired));
    let asked = text(&draw(&app, 80, 24));
    assert!(asked.contains("Which delay was fired?") && asked.contains("0/42/84 ms"), "{asked}");
    assert!(asked.contains("Up Down or letters select, Enter takes it, Esc leaves"), "{asked}");
    // Which delay was fired is not guessed: Enter alone takes none.
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.prompt.as_ref().map(|line| (line.purpose, line.selected)), Some((Purpose::Fired, None)));
    // What is typed before the delay is chosen is no name.
    press(&mut app, "zz");
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.prompt.as_ref().map(|line| line.purpose), Some(Purpose::Fired));
    let asked = text(&draw(&app, 80, 24));
    assert!(asked.contains("no option has “zz” in its name: choose first which delay was fired"), "{asked}");
    // Nor is it guessed behind letters that were erased, or an empty paste.
    (0..2).for_each(|_| drop(key(&mut app, KeyCode::Backspace)));
    app.paste("\n");
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.prompt.as_ref().map(|line| (line.purpose, line.selected)), Some((Purpose::Fired, None)));
    (0..5).for_each(|_| drop(key(&mut app, KeyCode::Down)));
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.prompt.as_ref().map(|line| line.purpose), Some(Purpose::Observe(4)));
    let told = text(&draw(&app, 120, 36));
    assert!(told.contains("seen of “42 ms”"), "{told}");
}

/// What was filmed belongs to the shot that was fired, whichever option the cursor happens to be on.
#[test]
fn an_observation_belongs_to_the_delay_that_was_fired() {
    let mut app = finished();
    press(&mut app, "4");
    app.studies.select(StudyKind::Fit);
    app.selected = 1;
    key(&mut app, KeyCode::Enter);
    "42".chars().for_each(|letter| drop(key(&mut app, KeyCode::Char(letter))));
    key(&mut app, KeyCode::Enter);
    // Of which tire a height counts is not guessed either.
    press(&mut app, "1.6 0.05");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
    let asked = "type the tire, its height, and give or take";
    assert!(app.notice.as_deref().is_some_and(|told| told.starts_with(asked)), "{:?}", app.notice);
    app.prompt.as_mut().expect("a line").line.input.reset();
    press(&mut app, "2:3 1,6");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
    assert!(
        app.notice.as_deref().is_some_and(|told| told.starts_with("how sure is 1,6?")),
        "{:?}",
        app.notice
    );
    press(&mut app, " 5cm");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Study(StudyKind::Fit));
    assert_eq!(app.record.lines(&app.case.plan)[0], "42 ms 2:3 flight_height_m 1.6 0.05");
    key(&mut app, KeyCode::Enter);
    let next = app.prompt.as_ref().map(|line| (line.purpose, line.selected));
    assert_eq!(next, Some((Purpose::Fired, Some(4))), "the same shot once more, unless told otherwise");
}

/// `7` typed on a launch of 6.0 is 7, and the screen says what became of it and of the other rows.
#[test]
fn a_value_that_is_typed_replaces_the_old_one_and_says_so() {
    let mut app = finished();
    press(&mut app, "1");
    app.editor.find("row 1: launch", false);
    key(&mut app, KeyCode::Enter);
    press(&mut app, "7");
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("7  was 6.0"), "{screen}");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::JudgeNewPlan);
    let speeds: Vec<f64> = app.case.plan.launches().map(|launch| launch.speed_m_s).collect();
    assert_eq!(speeds, [7.0, 6.0, 6.0]);
    let told = app.notice.as_deref().unwrap_or_default();
    assert!(told.contains("6.0 → 7, row 2 stays 6.0, row 3 stays 6.0"), "{told}");
}

/// An arrow tells its change as typing does. No key but those of typing takes a limit away.
#[test]
fn an_arrow_says_what_it_changed_and_no_slip_removes_a_limit() {
    let mut app = finished();
    press(&mut app, "1");
    app.editor.find("row 1: launch", false);
    key(&mut app, KeyCode::Right);
    let told = app.notice.as_deref().unwrap_or_default();
    assert!(told.contains("6.0 → ") && told.contains("row 2 stays 6.0"), "{told}");
    let text_with_limits = app.editor.text.edited("flight_height_m", "drift_m = 3\nflight_height_m");
    let source = PlanSource { path: std::path::PathBuf::new(), text: text_with_limits };
    let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut app = App::new(Arc::new(case), app.compute, &Config::default());
    press(&mut app, "1");
    for limit in ["slide", "accepted risk", "launch by hole"] {
        app.editor.find(limit, false);
        let before = app.editor.text.clone();
        press(&mut app, "d");
        assert_eq!(app.editor.text, before, "{limit}");
        let screen = text(&draw(&app, 120, 36));
        assert!(screen.contains("this is taken away only by typing"), "{screen}");
    }
}

/// A command of another screen acts on the option that is shown, whatever was selected on that screen before.
#[test]
fn a_command_of_another_screen_acts_on_the_option_shown() {
    let mut app = finished();
    press(&mut app, "1");
    app.editor.find("friction", false);
    press(&mut app, "2");
    app.selected = 4;
    press(&mut app, "3:remove-option");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::JudgeNewPlan);
    assert_eq!(names(&app), ["all at once", "9 ms", "20 ms", "25 ms, middle first", "109 ms", "long period"]);
}

/// Where another program corrects the file while there are edits here, nothing on the screen is a verdict of that file. Rows drawn before a
/// file was read anew take no clicks: they may be of options that are gone.
#[test]
fn a_file_corrected_by_another_program_holds_the_edits_and_its_rows_take_no_clicks() {
    let mut app = finished();
    let _folder = save(&mut app);
    press(&mut app, "1");
    app.editor.find("friction", false);
    key(&mut app, KeyCode::Right);
    let path = app.case.source.path.clone();
    let corrected = app.editor.saved().replace("launch_m_s = 6.0", "launch_m_s = 7.0");
    std::fs::write(&path, &corrected).expect("written");
    let read = |path: &std::path::Path| Case::load(path).map_err(|mistakes| mistakes.to_string());
    app.reload(read(path.as_ref()));
    app.notice = None;
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("the plan's file says something else"), "{screen}");
    // Under another name the edits are a plan of their own; that the other one differs stays.
    let mut other = app.clone();
    other.rename(&path.with_file_name("plan-2.toml"));
    other.note_saved(Ok("plan-2.toml".to_owned()));
    other.notice = None;
    let screen = text(&draw(&other, 120, 36));
    assert!(
        other.file == FileState::AsJudged && screen.contains("plan.toml says something else"),
        "{screen}"
    );
    // Without edits it is read, and is the plan.
    press(&mut app, "u");
    press(&mut app, "2");
    app.areas = draw_areas(&app, 120, 36);
    app.reload(read(path.as_ref()));
    assert!(app.areas.is_empty() && app.file == FileState::AsJudged);
}

/// What was seen of a shot under other tires holds the verdicts of this plan: its launch was another.
#[test]
fn a_shot_under_other_tires_holds_the_verdicts() {
    let mut app = finished();
    assert!(app.standing().compared().agrees());
    let seen = "# cover: 560 kg tires\noption,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,1.7,0.05\n";
    assert_eq!(app.record.add_file(&app.case, "seen.csv", seen, "2026-11-26"), Ok(()));
    let compared = ComparedWithObservations {
        files: app.record.read(&app.case).expect("observations"),
        ..nothing_seen()
    };
    study_ends(&mut app, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(compared)))));
    let told = sentences(&app.case, app.standing().compared());
    assert!(
        told.iter().any(|told| told.starts_with("mass of a tire: 560 kg in an earlier shot")),
        "{told:?}"
    );
}

/// Where what was seen is not compared with the plan, nothing passes in the CSV of a study, either.
#[test]
fn where_nothing_was_compared_no_study_passes() {
    let mut app = finished();
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    app.screen = Screen::Studies;
    app.studies.show(StudyKind::Sweep);
    app.studies.open = true;
    let passes = |app: &App| {
        export::csv(app).expect("a table").split([',', '\n']).filter(|field| *field == "pass").count()
    };
    assert_ne!(passes(&app), 0);
    let shown = |app: &App| text(&draw(app, 170, 45));
    assert!(
        shown(&app).contains("bar below") && shown(&app).contains("points tried in them pass"),
        "{}",
        shown(&app)
    );
    let case = app.case.clone();
    assert_eq!(app.record.add_line(&case, 2, "3:1 1.7 0.05"), Ok(()));
    assert_eq!(passes(&app), 0);
    // Neither a chart nor a sentence of it recommends anything.
    let held = shown(&app);
    assert!(!held.contains("bar below") && !held.contains("points tried in them pass"), "{held}");
    assert!(!held.contains("that pass") && !held.contains("deepest") && held.contains("HOLD"), "{held}");
    // Nor does a key take what it offered.
    let before = app.editor.text.clone();
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.editor.text, before);
}

/// Nothing on the screen is in the colour of a pass where passes do not stand: what was seen is not compared, or the file of the plan is
/// not what was judged. A file that is gone takes no pass back, but says so.
#[test]
fn nothing_has_the_colour_of_a_pass_where_passes_do_not_stand() {
    let mut app = finished();
    let _folder = save(&mut app);
    let pass = app.theme.verdict(Verdict::Pass).fg.expect("a colour");
    let coloured = |app: &App| draw(app, 120, 36).content.iter().filter(|cell| cell.fg == pass).count();
    let judged_again = |app: &mut App| {
        app.screen = Screen::Compare;
        app.selected = 4;
        recommend(app, 4);
        app.assumptions[4] = Some(Box::new(nothing_fails(4)));
    };
    judged_again(&mut app);
    assert_ne!(coloured(&app), 0);
    let path = app.case.source.path.clone();
    std::fs::write(&path, "[shelter]\nlayout = \"gr").expect("written");
    assert_eq!(app.reload(Err("line 2: a quote is missing".to_owned())), Request::None);
    app.notice = None;
    judged_again(&mut app);
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("! HOLD: the file of the plan is not what was judged"), "{screen}");
    assert!(screen.contains("the plan's file says something else") && !screen.contains("PASS"), "{screen}");
    assert_eq!(coloured(&app), 0, "{screen}");
    assert!(!export::csv(&app).expect("a table").contains(",pass,"));
    // An edit that is taken back does not mend the file.
    let options = app.options.clone();
    press(&mut app, "1");
    app.editor.find("friction", false);
    key(&mut app, KeyCode::Right);
    press(&mut app, "u");
    app.options = options;
    judged_again(&mut app);
    app.notice = None;
    let screen = text(&draw(&app, 120, 36));
    assert!(!app.editor.unsaved() && screen.contains("! HOLD: the file of the plan"), "{screen}");
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(app.reload(Err("the file is gone".to_owned())), Request::None);
    app.notice = None;
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("the plan's file is gone") && coloured(&app) > 0, "{screen}");
    assert!(export::csv(&app).expect("a table").contains("plan.toml (not saved)"));
    std::fs::write(&path, &app.case.source.text).expect("written");
    let again = Case::load(std::path::Path::new(&path)).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(app.reload(Ok(again)), Request::None);
    let screen = text(&draw(&app, 120, 36));
    assert!(!screen.contains("the plan's file") && coloured(&app) > 0, "{screen}");
    assert!(!export::csv(&app).expect("a table").contains("not saved"));
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    assert_eq!(coloured(&app), 0, "{}", text(&draw(&app, 120, 36)));
}

/// What was seen and speaks for the plan leaves its trace, too.
#[test]
fn what_was_seen_and_agrees_is_said_on_every_screen() {
    let mut app = finished();
    let case = app.case.clone();
    assert_eq!(app.record.add_line(&case, 4, "3:1 1.7 0.05"), Ok(()));
    let agrees = |app: &App| text(&draw(app, 120, 36)).contains("the one value seen agrees: it tells little");
    assert!(!agrees(&app));
    let files = app.record.read(&case).expect("observations");
    let compared = ComparedWithObservations { files: files.clone(), ..nothing_seen() };
    study_ends(&mut app, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(compared)))));
    for screen in "12345".chars() {
        press(&mut app, &screen.to_string());
        assert!(agrees(&app), "{}", text(&draw(&app, 120, 36)));
    }
    // Outside its band, and not so far that chance makes it in 1 of 20 cases only: it does not agree, nor does it hold the plan.
    let predictions =
        vec![Prediction { planned: 1.5, band: Some([1.4, 1.69]), middle: 1.55, ..Prediction::default() }];
    let outside =
        ComparedWithObservations { seen: ObservedShots::new(&files), files, predictions, ..nothing_seen() };
    study_ends(&mut app, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(outside)))));
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("the one value seen lies outside what is predicted: fit (4)"), "{screen}");
    assert!(!screen.contains("agrees") && !screen.contains("HOLD"), "{screen}");
    // What was taken back agrees with nothing.
    assert!(app.record.withdraw_last("2026-11-26").is_some());
    let screen = text(&draw(&app, 120, 36));
    assert!(!screen.contains("agrees"), "{screen}");
}

/// Nobody takes it for agreement that nothing was compared yet.
#[test]
fn what_is_not_compared_is_not_said_to_agree() {
    let mut app = finished();
    let case = app.case.clone();
    assert_eq!(app.record.add_line(&case, 2, "3:1 1.7 0.05"), Ok(()));
    press(&mut app, "4");
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("! observations are not compared with this plan"), "{screen}");
    assert!(!screen.contains("agrees"), "{screen}");
}

#[test]
fn what_was_seen_of_a_shot_is_typed_and_fitted() {
    let mut app = finished();
    press(&mut app, "4");
    app.studies.show(StudyKind::Fit);
    app.fired = Some(2);
    let mut typed = |line: &str| {
        [KeyCode::Enter; 2].into_iter().for_each(|code| drop(key(&mut app, code)));
        app.prompt.as_mut().expect("a line").line.input.reset();
        line.chars().for_each(|letter| drop(key(&mut app, KeyCode::Char(letter))));
        let request = key(&mut app, KeyCode::Enter);
        (
            request,
            app.record.lines(&app.case.plan).len(),
            app.prompt.take().map(|prompt| prompt.line.value().to_owned()),
        )
    };
    assert_eq!(typed("3:1 1.95 0.05"), (Request::Study(StudyKind::Fit), 1, None));
    assert_eq!(typed("9:9 1.95 0.05"), (Request::None, 1, Some("9:9 1.95 0.05".to_owned())), "to be mended");
    assert_eq!(typed("seen.csv"), (Request::ReadObserved("seen.csv".into()), 1, None));
    for line in ["2:3 1.1 ±0.1", "1:8 1.2 +- 0.1"] {
        assert!(matches!(typed(line).0, Request::Study(StudyKind::Fit)), "{line}");
    }
    let last = app.record.withdraw_last("2026-11-26");
    assert_eq!(last.as_deref(), Some("20 ms 1:8 flight_height_m 1.2 0.1"));
    app.record.withdraw_last("2026-11-26");
    let file = "option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,1.7,0.05\n";
    let request = app.take_observed_file("seen.csv".as_ref(), Ok(file.to_owned()));
    let told = app.record.lines(&app.case.plan);
    assert_eq!(
        (request, told.len()),
        (Request::Study(StudyKind::Fit), 4),
        "two count, two are taken back: {told:?}"
    );
    app.studies.set(StudyKind::Fit, StudyState::Idle);
    assert_eq!(key(&mut app, KeyCode::Char('x')), Request::None, "asked first");
    assert_eq!(press(&mut app, "y"), Request::Study(StudyKind::Fit));
    assert_eq!(app.record.lines(&app.case.plan)[..1], ["seen.csv"], "one at a time, and fitted anew");
    app.studies.set(StudyKind::Fit, StudyState::Idle);
    assert_eq!(press(&mut app, "xy"), Request::None);
    assert!(app.record.is_empty() && matches!(app.studies.state(StudyKind::Fit), StudyState::Idle));
}

#[test]
fn options_are_added_and_removed_where_they_are_compared() {
    let mut app = finished();
    press(&mut app, "a");
    assert!(text(&draw(&app, 80, 24)).contains("copy of “all at once”: interval between rows, ms"));
    press(&mut app, "33");
    key(&mut app, KeyCode::Enter);
    let name = |app: &App| app.case.plan.delays[app.selected].name.clone();
    assert_eq!((app.screen, name(&app), app.options.len()), (Screen::Compare, "33 ms".to_owned(), 8));
    press(&mut app, "d");
    assert_eq!(app.options.len(), 7);
    let added =
        |app: &App| app.case.plan.delays.iter().filter(|delay| delay.name.starts_with("33 ms")).count();
    press(&mut app, "u");
    assert_eq!((app.options.len(), added(&app)), (8, 1), "a removed option comes back");
    press(&mut app, "u");
    assert_eq!((app.options.len(), added(&app)), (7, 0), "one key takes the added option away");
    press(&mut app, "U");
    assert_eq!((app.options.len(), added(&app)), (8, 1));
    // The copy has the order of its original, and a number only beside another of its name.
    for new in ["33 ms, middle first", "33 ms, middle first (2)"] {
        app.selected =
            app.case.plan.delays.iter().position(|delay| delay.name.starts_with("25 ms")).expect("it");
        press(&mut app, "a33");
        // Until it is taken, nothing of it passes.
        let screen = text(&draw(&app, 80, 24));
        let row = screen.lines().find(|line| line.starts_with('▸')).expect("a row");
        assert!(row.contains("type ms") && !row.contains("PASS"), "{row}");
        key(&mut app, KeyCode::Enter);
        assert_eq!(name(&app), new);
    }
}

/// Rows that are made to fire apart are no longer called `all at once`: the page would say so above a signature.
#[test]
fn an_option_that_no_longer_fires_at_once_is_named_by_its_interval() {
    let mut app = finished();
    let change = Change::Interval { option: 0, interval: Time::from_ms(33.0) };
    let edit = app.editor.adopt(change.apply(&app.editor.text));
    let EditOutcome::Changed(plan) = edit else { panic!("{:?}", app.editor.problem) };
    assert_eq!(plan.delays[0].name, "33 ms");
}

/// A copy of an option with a time for each row takes an interval, too; one that is given up was never made.
#[test]
fn the_copy_of_a_list_of_times_takes_an_interval_or_goes_away() {
    let mut app = finished();
    app.selected = 6;
    press(&mut app, "a");
    assert!(text(&draw(&app, 80, 24)).contains("interval between rows, or the time of each row"));
    key(&mut app, KeyCode::Esc);
    assert_eq!((app.options.len(), app.selected, app.editor.unsaved()), (7, 6, false));
    press(&mut app, "U");
    assert_eq!(app.options.len(), 7, "nothing to make again");
    for (typed, name, times) in
        [("33", "33 ms", [0.0, 33.0, 66.0]), ("0, 40, 90", "0/40/90 ms", [0.0, 40.0, 90.0])]
    {
        app.selected = 6;
        press(&mut app, "a");
        press(&mut app, typed);
        key(&mut app, KeyCode::Enter);
        let delay = &app.case.plan.delays[app.selected];
        assert_eq!((delay.name.as_str(), delay.timing.fire_at()), (name, times.map(Time::from_ms).to_vec()));
    }
}

/// An added option leaves the verdicts of the others: only a pass awaits its fresh draws again. Another limit leaves none.
#[test]
fn an_added_option_leaves_the_others_judged() {
    let mut app = finished();
    // A pass has its launch margin once it has all its samples.
    app.take_news(News::Found { option: 4, part: Part::Margin(LaunchMargin::BeyondTried) });
    let before: Vec<Verdict> = app.options.iter().map(OptionState::verdict).collect();
    press(&mut app, "a33");
    key(&mut app, KeyCode::Enter);
    assert!(matches!(app.options[app.selected], OptionState::Waiting), "{:?}", app.options[app.selected]);
    let others = (0..app.options.len()).filter(|&option| option != app.selected);
    for (option, before) in others.zip(before) {
        let (now, sampling) = (app.options[option].verdict(), app.options[option].is_sampling());
        let is_pass = before == Verdict::Pass;
        let expected = if is_pass { Verdict::Undecided } else { before };
        assert_eq!((now, sampling), (expected, is_pass), "{option}");
    }
    assert!(app.answer.is_none(), "no answer before the added option is judged");
    let (mut app, delay) = (finished(), finished().case.plan.delays[1].name.clone());
    let sampled = Box::new(samples(&app.case, 200, false));
    app.take_news(News::Found { option: 1, part: Part::Samples { sampled, more: true } });
    press(&mut app, "a");
    let at = app.case.plan.delays.iter().position(|known| known.name == delay).expect("the option");
    assert!(app.judgement(at).is_none(), "more samples were to come");
    for (from, to, kept) in [
        ("flight_height_m = 2.35", "flight_height_m = 2.36", 0),
        ("friction = 0.5", "friction = 0.51", 0),
        ("\"9 ms\"", "\"nine\"", 7),
    ] {
        let (mut app, text) = (finished(), finished().case.source.text.replace(from, to));
        let other = Case::parse(PlanSource { path: std::path::PathBuf::new(), text });
        app.reload(Ok(other.unwrap_or_else(|mistakes| panic!("{mistakes}"))));
        assert_eq!((0..7).filter(|&option| app.judgement(option).is_some()).count(), kept, "{to}");
    }
}

/// Also once the plan is fitted to it: a plan with other launches may still not say what was seen.
#[test]
fn what_was_seen_stands_against_every_plan_that_does_not_say_it() {
    let mut app = finished();
    let says = |app: &App, words: &str| text(&draw(app, 120, 36)).contains(words);
    app.selected = 2;
    // The limit is 2.35 m.
    let is_plain = |app: &App| {
        let buffer = draw(app, 170, 45);
        let row = text(&buffer).lines().position(|line| line.contains("▸20 ms")).expect("its row") as u16;
        let faint = app.theme.faint().fg.expect("a colour");
        (35..170).all(|x| buffer[(x, row)].symbol() == " " || buffer[(x, row)].fg == faint)
    };
    assert!(!is_plain(&app));
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    assert!(is_plain(&app), "what is contradicted has no colour");
    let first = text(&draw(&app, 80, 24)).lines().nth(1).expect("a line").to_owned();
    assert!(app.answer.is_none() && first.contains(" HOLD "), "also before there is an answer: {first}");
    let twice = app.record.add_line(&app.case, 2, "3:1 2.55 0.05");
    assert!(twice.is_err_and(|why| why.contains("20 ms 3:1 flight_height_m 2.55 0.05 was typed already")));
    let Request::NamePage(page) = press(&mut app, "2P") else { panic!("a page is offered") };
    assert!(page.ends_with("-fails") && says(&app, "not compared with this plan"), "{page}");
    assert!(says(&app, "! HOLD") && !says(&app, "PASS") && says(&app, "0 of 7 pass, HOLD"));
    app.listing.filter = "pass".to_owned();
    assert!(listed(&app).is_empty(), "what is on HOLD is found as such");
    app.listing.filter = "hold".to_owned();
    assert!(!listed(&app).is_empty());
    app.listing.filter.clear();
    assert_eq!(press(&mut app, "4E"), Request::None);
    assert!(says(&app, "no estimate goes into the plan"), "a key that does nothing says why, on every tab");
    app.studies.show(StudyKind::Fit);
    assert_eq!(press(&mut app, "E"), Request::None);
    assert!(says(&app, "no estimate goes into the plan: nothing was fitted"), "nor before the fit has ended");

    let compare = |app: &App| {
        let seen = app.record.read(&app.case).expect("observations");
        let (compute, control) = (app.compute, StudyControl::default());
        let question = fit::Question { observed: seen, unknowns: vec![Unknown::Launch] };
        let compared = question.answer(&Context::new(&app.case, compute, &control)).expect("a fit").value;
        Found::Fit(Box::new(Computed::complete(compared)))
    };
    let offers = |app: &App, width| text(&draw(app, width, 24)).contains("E use estimates");
    assert!([60, 80, 120].iter().all(|&width| !offers(&app, width)), "there are none yet");
    let found = compare(&app);
    study_ends(&mut app, StudyKind::Fit, Ok(found));
    assert!([60, 80, 120].iter().all(|&width| offers(&app, width)));
    assert!(says(&app, "E puts the estimates into it") && says(&app, "over the limit of 2.350"));
    let before = app.editor.text.clone();
    assert_eq!(press(&mut app, "E"), Request::Study(StudyKind::Check));
    assert!(says(&app, "all options are judged with them"));
    let only_if = "a PASS stands only if observations then fit";
    let mut passing = app.clone();
    let judged = judged_as(&app, Verdict::Pass);
    study_ends(&mut passing, StudyKind::Check, Ok(judged));
    assert!(says(&passing, only_if), "{}", text(&draw(&passing, 120, 36)));
    let judged = judged_as(&app, Verdict::Fail);
    study_ends(&mut app, StudyKind::Check, Ok(judged));
    let screen = text(&draw(&app, 120, 36));
    assert!(!screen.contains(only_if));
    assert!(screen.contains("ONE observation is little") && screen.contains("42 ms HOLD → FAIL"), "{screen}");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None, "Enter may be meant for something else");
    assert_eq!(app.editor.text, before, "nothing goes into the plan before the answer");
    assert_eq!(press(&mut app, "y"), Request::JudgeNewPlan);
    // The checksum of the line, its mark, and the tires.
    assert_eq!((app.screen, app.case.plan.fitted_from.len()), (Screen::Compare, 3));
    let known = app.case.plan.uncertainty;
    // This fit took all but the launches for exact: it knows them to 1 %, and narrows nothing.
    assert_eq!((known.launch_common_percent, known.launch_between_shots_percent), (3.0, 0.0));
    key(&mut app, KeyCode::Esc);
    assert!(says(&app, "! observations are not compared with this plan"), "{}", text(&draw(&app, 120, 36)));
    let found = compare(&app);
    study_ends(&mut app, StudyKind::Fit, Ok(found));
    assert!(says(&app, "! observations contradict this plan"), "{}", text(&draw(&app, 120, 36)));
    press(&mut app, "4");
    assert!(
        says(&app, "the plan was fitted to this, and says of it now")
            && says(&app, "over the limit of 2.350")
    );
    assert_eq!(press(&mut app, "E"), Request::None, "once is enough");
    assert_eq!(
        app.record.clone().add_line(&app.case, 2, "3:2 1.5 0.05"),
        Ok(()),
        "the next lines are another shot"
    );
    let again = app.record.clone().add_line(&app.case, 2, "3:1 2.55 0.05");
    assert!(again.is_err_and(|why| why.contains("name each shot once")), "this one is known");

    assert_eq!(press(&mut app, "u"), Request::JudgeNewPlan);
    assert_eq!(app.editor.text, before);
    press(&mut app, "4x");
    assert!(says(&app, "take back “what was typed”") && !app.record.is_empty(), "not by one key alone");
    assert!(says(&app, " y takes it back · any other key leaves it"));
    // Nor by a key that was meant for something else.
    for meant_otherwise in [KeyCode::Esc, KeyCode::Enter, KeyCode::Char('n'), KeyCode::Char('2')] {
        key(&mut app, meant_otherwise);
        assert!(!app.record.is_empty() && app.prompt.is_none(), "{meant_otherwise}");
        assert!(app.screen == Screen::Studies && says(&app, "observations stay"), "{meant_otherwise}");
        press(&mut app, "x");
    }
    press(&mut app, "y");
    assert!(app.record.is_empty() && !says(&app, "! observations"));
}

#[test]
fn what_is_shown_is_offered_for_export() {
    let mut app = finished();
    let _folder = save(&mut app);
    let plan = app.case.source.name().strip_suffix(".toml").expect("a plan").to_owned();
    assert!(plan.contains('/'), "what is written lies beside the plan: {plan}");
    assert_eq!(
        press(&mut app, "e"),
        Request::NameExport(format!("{plan}-compare"), "csv"),
        "the event loop finds an unused name"
    );
    app.ask_for_file(Purpose::Export, "amur-three-rows-compare.csv");
    let prompt = app.prompt.as_ref().expect("a file is asked for");
    assert_eq!((prompt.purpose, prompt.line.value()), (Purpose::Export, "amur-three-rows-compare.csv"));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Export("amur-three-rows-compare.csv".into()));
    for (verdict, ending) in [(Verdict::Pass, "if-confirmed-to-be-fired"), (Verdict::Fail, "fails")] {
        let has = |&n: &usize| app.judgement(n).is_some_and(|judged| judged.verdict() == verdict);
        app.selected = (0..7).find(has).expect("such an option");
        app.assumptions[app.selected] = Some(Box::new(nothing_fails(app.selected)));
        let option = app.case.plan.delays[app.selected].name.replace(", ", "-").replace(' ', "-");
        assert_eq!(press(&mut app, "P"), Request::NamePage(format!("{plan}-{option}-{ending}")));
        // A name that was offered before the verdict changed does not stay.
        let name = "plan-42-ms-if-confirmed-to-be-fired-2.html";
        assert_eq!(app.misnames_page(name.as_ref()), verdict != Verdict::Pass);
        assert!(app.misnames_page("plan-42-ms-to-be-fired-2.html".as_ref()), "values are assumed");
        // Nor does a plan whose own name says what its page would.
        let named = "example-that-fails-on-hold-42-ms-if-confirmed-to-be-fired.html";
        assert_eq!(app.misnames_page(named.as_ref()), verdict != Verdict::Pass);
        assert!(!app.misnames_page("page.html".as_ref()));
        let mut silent = app.case.plan.clone();
        silent.uncertainty.assumed = true;
        let said = std::mem::replace(&mut std::sync::Arc::make_mut(&mut app.case).plan, silent);
        assert!(
            app.misnames_page("to-be-fired.html".as_ref()),
            "a plan that says nothing of what is not known"
        );
        std::sync::Arc::make_mut(&mut app.case).plan = said;
    }
    app.ask_for_file(Purpose::Page, "page.html");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Page("page.html".into()));
}

/// A name that is offered is replaced by what is typed or pasted, and kept by a key that moves or takes away in it.
#[test]
fn a_file_that_is_offered_gives_way_to_what_is_typed() {
    let mut app = finished();
    app.ask_for_file(Purpose::SaveAs, "plan-2.toml");
    "new.toml".chars().for_each(|letter| drop(key(&mut app, KeyCode::Char(letter))));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::SaveAs("new.toml".into()));
    app.ask_for_file(Purpose::SaveAs, "plan-2.toml");
    app.paste("other.toml");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::SaveAs("other.toml".into()));
    app.ask_for_file(Purpose::SaveAs, "plan-2.toml");
    (0..6).for_each(|_| drop(key(&mut app, KeyCode::Backspace)));
    "3.toml".chars().for_each(|letter| drop(key(&mut app, KeyCode::Char(letter))));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::SaveAs("plan-3.toml".into()));
}

#[test]
fn keys_of_a_configuration_count() {
    let config =
        Config::parse("theme = \"light\"\n[keys]\nquit = [\"ctrl-q\"]\nsort = [\"S\"]").expect("right");
    let mut app = App::new(finished().case, finished().compute, &config);
    assert_eq!(press(&mut app, "q"), Request::None);
    press(&mut app, "S");
    assert_eq!(app.listing.sort, SortBy::Name);
    assert!(text(&draw(&app, 100, 30)).contains("Ctrl-q quit"));
}

#[test]
fn the_start_screen_uses_the_keys_of_the_configuration() {
    let remapped = "[keys]\ndown = [\"n\"]\nopen = [\"ctrl-o\"]\nquit = [\"ctrl-q\"]";
    let config = Config::parse(remapped).expect("right");
    let folder = tempfile::tempdir().expect("a folder");
    let mut start = Start::new(folder.path(), Vec::new(), None);
    let mut press =
        |code, modifiers| start.update(&Event::Key(KeyEvent::new(code, modifiers)), &config.keymap);
    for letter in ['j', 'q'] {
        assert_eq!(press(KeyCode::Char(letter), KeyModifiers::NONE), Next::Wait, "{letter} has no action");
    }
    assert_eq!(press(KeyCode::Enter, KeyModifiers::NONE), Next::Wait);
    assert_eq!(press(KeyCode::Char('n'), KeyModifiers::NONE), Next::Wait);
    let (name, plan) = EXAMPLES[0];
    let opened = press(KeyCode::Char('o'), KeyModifiers::CONTROL);
    assert_eq!(opened, Next::Open(Opened::Example(name, plan)), "the second line");
    assert_eq!(press(KeyCode::Char('q'), KeyModifiers::CONTROL), Next::Quit);
    assert_eq!(press(KeyCode::Esc, KeyModifiers::NONE), Next::Quit);
    let mut terminal = Terminal::new(TestBackend::new(100, 30)).expect("a test terminal");
    terminal.draw(|frame| start.draw(&config, frame)).expect("drawn");
    assert!(text(terminal.backend().buffer()).contains("Ctrl-o opens · Ctrl-q leaves"));
}

#[test]
fn the_questions_end_with_what_is_assumed() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut start, config) = (Start::new(folder.path(), Vec::new(), None), Config::default());
    // The new plan, then each answer as offered.
    for _ in 0..=QUESTIONS.len() {
        let enter = Event::Key(KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE));
        assert_eq!(start.update(&enter, &config.keymap), Next::Wait);
    }
    let mut terminal = Terminal::new(TestBackend::new(120, 24)).expect("a test terminal");
    terminal.draw(|frame| start.draw(&config, frame)).expect("drawn");
    let screen = text(terminal.backend().buffer());
    let guessed = LAUNCH_IS_KNOWN[0];
    for what in NOT_KNOWN.map(|(what, _)| what).into_iter().chain([RIGID_ENDS, guessed]) {
        assert!(screen.contains(what), "{what}\n{screen}");
    }
    // What no question asks is said, with the key that changes it; all of it holds of the plan that Enter makes.
    let enter = Event::Key(KeyEvent::new(KeyCode::Enter, KeyModifiers::NONE));
    let Next::Open(Opened::New(plan)) = start.update(&enter, &config.keymap) else { panic!("a plan") };
    let assumed = starter::assumed(&QUESTIONS.map(|question| question.offered));
    for (what, keys) in &assumed {
        let line =
            screen.lines().find(|line| line.contains(what.as_str())).unwrap_or_else(|| panic!("{what}"));
        assert!(line.contains(keys[0]), "{line}");
        // All cables are tied where a plan does not name them.
        assert!(keys[0] == "links" || plan.contains(&format!("\n{} = ", keys[0])), "{}\n{plan}", keys[0]);
    }
    assert!(plan.contains("\ntermination_percent = 70") && plan.contains("\nwithstands_one_dud = true"));
}

/// Windows itself writes `\\?\` before the path of a file.
#[test]
fn a_plan_opened_lately_is_listed_once_and_as_people_write_its_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("mine.toml");
    std::fs::write(&plan, include_str!("../../plans/paper-5-tire.toml")).expect("written");
    let start = Start::new(folder.path(), vec![canonical(&plan).expect("a path")], None);
    let path = |choice: &StartLine| match choice {
        StartLine::File(path) => Some(path.display().to_string()),
        _ => None,
    };
    let listed: Vec<_> = start.choices.iter().filter_map(path).collect();
    assert_eq!(listed.len(), 1, "{listed:?}");
    assert!(!listed[0].starts_with(r"\\?\"), "{listed:?}");
}

#[test]
fn the_order_editor_uses_the_keys_of_the_configuration() {
    let config = Config::parse("[keys]\ndown = [\"n\"]\nleft = [\"z\"]").expect("right");
    let mut app = App::new(finished().case, finished().compute, &config);
    press(&mut app, "1/20 ms: order");
    key(&mut app, KeyCode::Enter);
    key(&mut app, KeyCode::Enter);
    let names = |app: &App| match &app.editor.entry {
        Some(Entry::Order(order)) => order.names.clone(),
        entry => panic!("not in order: {entry:?}"),
    };
    assert!(text(&draw(&app, 100, 30)).contains("Firing order: z earlier, Right later"));
    press(&mut app, "jh");
    assert_eq!(names(&app), ["1", "2", "3"], "keys without an action do nothing");
    press(&mut app, "nz");
    assert_eq!(names(&app), ["2", "1", "3"]);
    assert_eq!(key(&mut app, KeyCode::Enter), Request::JudgeNewPlan);
    assert_eq!(app.case.plan.delays[2].timing.fire_at(), [20.0, 0.0, 40.0].map(Time::from_ms));
}

#[test]
fn every_size_draws() {
    let mut app = finished();
    for zoom in [false, true] {
        app.zoom = zoom;
        app.help = zoom;
        for width in (1..=200).step_by(7) {
            for height in (1..=60).step_by(3) {
                draw(&app, width, height);
            }
        }
    }
}

#[test]
fn keys_move_and_escape_closes_but_never_quits() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('j'));
    key(&mut app, KeyCode::Down);
    assert_eq!(app.selected, 2);
    key(&mut app, KeyCode::End);
    key(&mut app, KeyCode::Down);
    assert_eq!(app.selected, app.options.len() - 1);
    key(&mut app, KeyCode::Home);
    key(&mut app, KeyCode::Char('k'));
    assert_eq!(app.selected, 0);
    key(&mut app, KeyCode::Char('?'));
    assert_eq!(key(&mut app, KeyCode::Esc), Request::None);
    assert!(!app.help);
    for _ in 0..3 {
        assert_eq!(key(&mut app, KeyCode::Esc), Request::None);
    }
    assert_eq!(key(&mut app, KeyCode::Char('q')), Request::Quit);
    assert_eq!(key(&mut app, KeyCode::Char('+')), Request::Judge);
    assert!(app.options.iter().all(|row| matches!(row, OptionState::Waiting)));
}

#[test]
fn a_study_is_cancelled_by_x_or_escape_and_escape_then_goes_back() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    key(&mut app, KeyCode::Right);
    assert_eq!(app.studies.shown, StudyKind::Orders);
    assert_eq!(key(&mut app, KeyCode::Char('x')), Request::None, "nothing to cancel");
    for code in [KeyCode::Char('x'), KeyCode::Esc] {
        assert_eq!(key(&mut app, KeyCode::Enter), Request::Study(StudyKind::Orders));
        assert_eq!(key(&mut app, code), Request::Cancel(StudyKind::Orders));
    }
    assert_eq!(key(&mut app, KeyCode::Esc), Request::None);
    assert_eq!(app.screen, Screen::Compare);
}

/// Nobody acts on what the help covers: the first key takes it away.
#[test]
fn no_key_acts_behind_the_help() {
    let mut app = finished();
    for code in ['a', 'd', 'u', 's', '+', 'w', 'P', 'e', '/'] {
        key(&mut app, KeyCode::Char('?'));
        let before = app.editor.text.clone();
        assert_eq!(key(&mut app, KeyCode::Char(code)), Request::None, "{code}");
        assert!(!app.help && app.prompt.is_none() && app.editor.text == before, "{code}");
    }
    // Another screen is a way to look, too.
    key(&mut app, KeyCode::Char('?'));
    key(&mut app, KeyCode::Char('4'));
    assert_eq!(app.screen, Screen::Studies);
}

/// The end of a list is as far as one gets: one key back leaves it.
#[test]
fn lists_are_scrolled_no_further_than_their_end() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('?'));
    (0..200).for_each(|_| drop(key(&mut app, KeyCode::Down)));
    let end = text(&draw(&app, 80, 24));
    app.note_drawn(draw_areas(&app, 80, 24));
    key(&mut app, KeyCode::Up);
    assert_ne!(text(&draw(&app, 80, 24)), end);
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig { cases: 64, ..Default::default() })]

    /// Whatever is typed on whatever screen, something is drawn.
    #[test]
    fn no_keys_and_no_size_do_harm(
        keys in proptest::collection::vec((0..14_usize, proptest::char::range(' ', '~')), 0..60),
        (width, height) in (1..160_u16, 1..60_u16),
    ) {
        let mut app = finished();
        let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
        let flight = recorded(&app, 0);
        study_ends(&mut app, StudyKind::Flight, Ok(flight));
        study_ends(&mut app, StudyKind::Risk, Err(NoResult::NoInterval));
        for (n, letter) in keys {
            let codes = [
                KeyCode::Up, KeyCode::Down, KeyCode::Left, KeyCode::Right, KeyCode::Enter, KeyCode::Esc,
                KeyCode::PageUp, KeyCode::PageDown, KeyCode::Home, KeyCode::End, KeyCode::Tab,
            ];
            key(&mut app, codes.get(n).copied().unwrap_or(KeyCode::Char(letter)));
            app.areas = draw_areas(&app, width, height);
            app.click(Position::new(width / 3, height / 2));
            app.request_flight();
        }
    }
}

/// Enter on a row of a study adds its option, or uses its shelter; undo takes it back.
#[test]
fn rows_of_studies_change_the_plan() {
    let mut app = finished();
    let options = app.case.plan.delays.len();
    app.screen = Screen::Studies;
    app.studies.show(StudyKind::Sweep);
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    key(&mut app, KeyCode::Down);
    assert_eq!(app.studies.selected, 0, "the recommended interval, and no other");
    let asked = key(&mut app, KeyCode::Enter);
    assert!(matches!(asked, Request::JudgeNewPlan), "{asked:?}");
    assert_eq!(app.case.plan.delays.len(), options + 1);
    let added = &app.case.plan.delays[options];
    assert_eq!(
        (added.name.as_str(), added.timing.fire_at()),
        ("210 ms", [0.0, 210.0, 420.0].map(Time::from_ms).to_vec())
    );
    assert_eq!((app.screen, app.selected), (Screen::Compare, options));
    press(&mut app, "u");
    assert_eq!(app.case.plan.delays.len(), options);

    let [(orders, ranked), _, (size, sizes)] = spreads(&app);
    app.screen = Screen::Studies;
    app.studies.show(orders);
    study_ends(&mut app, orders, Ok(ranked));
    key(&mut app, KeyCode::End);
    assert_eq!(app.studies.selected, 5);
    key(&mut app, KeyCode::Enter);
    let added = &app.case.plan.delays[options];
    assert_eq!(
        (added.name.as_str(), added.timing.fire_at()),
        ("3-2-1 20 ms", [40.0, 20.0, 0.0].map(Time::from_ms).to_vec())
    );
    press(&mut app, "u");

    app.screen = Screen::Studies;
    app.studies.show(size);
    study_ends(&mut app, size, Ok(sizes));
    key(&mut app, KeyCode::Down);
    key(&mut app, KeyCode::Enter);
    let rope = app.case.plan.cable.rope.clone().expect("a rope");
    assert!(app.notice.as_ref().is_some_and(|notice| notice.contains(&rope)), "{:?}", app.notice);
    assert_ne!(rope, "GOST 2688-80 14 1960");
    press(&mut app, "u");
    assert_eq!(app.case.plan.cable.rope.as_deref(), Some("GOST 2688-80 14 1960"));
}

/// The selected row of a long ranking is always on the screen, and a click selects, then changes.
#[test]
fn the_selected_row_is_in_sight() {
    let mut app = finished();
    let [(orders, ranked), ..] = spreads(&app);
    app.screen = Screen::Studies;
    app.studies.show(orders);
    study_ends(&mut app, orders, Ok(ranked));
    for _ in 0..5 {
        key(&mut app, KeyCode::Down);
        let shown = text(&draw(&app, 80, 18));
        let row = ["1 2 3", "1 3 2", "2 1 3", "2 3 1", "3 1 2", "3 2 1"][app.studies.selected];
        assert!(shown.contains(row), "{row}:\n{shown}");
    }
    app.studies.selected = 0;
    click(&mut app, "2 3 1");
    assert_eq!(app.studies.selected, 3);
    click(&mut app, "2 3 1");
    assert_eq!(app.case.plan.delays.last().map(|delay| delay.name.as_str()), Some("2-3-1 20 ms"));
}

/// One option that is left of several was chosen among them: judged anew, too, it needs the fresh draws of a choice.
#[test]
fn who_deletes_the_other_options_is_asked_for_fresh_draws() {
    let mut app = finished();
    press(&mut app, "2");
    while app.case.plan.delays.len() > 1 {
        assert_eq!(press(&mut app, "d"), Request::JudgeNewPlan);
    }
    assert_eq!(press(&mut app, "-"), Request::Judge);
    assert_eq!(app.depth(), Depth::Chosen);
    let alone = Arc::new(app.case.with_options(&[0]));
    assert_eq!(App::new(alone, app.compute, &Config::default()).depth(), Depth::Full);
}

/// At the ends of the scale, and where the step is fixed, the keys of accuracy throw no result away.
#[test]
fn accuracy_that_does_not_change_computes_nothing_anew() {
    let mut app = finished();
    assert_eq!(app.compute.accuracy, Accuracy::Field);
    assert_eq!(press(&mut app, "+"), Request::Judge);
    app.options = finished().options;
    assert_eq!((press(&mut app, "+"), app.busy()), (Request::None, false), "the finest");
    assert_eq!((press(&mut app, "-"), press(&mut app, "-")), (Request::Judge, Request::Judge));
    app.options = finished().options;
    assert_eq!((press(&mut app, "-"), app.busy()), (Request::None, false), "the coarsest");
    app.compute.step = Some(1e-3);
    assert_eq!((press(&mut app, "+"), app.busy()), (Request::None, false));
    assert!(app.notice.as_deref().is_some_and(|told| told.contains("--dt")), "{:?}", app.notice);
}

#[test]
fn paging_changes_no_option_that_fills_the_screen() {
    let mut app = finished();
    key(&mut app, KeyCode::Enter);
    key(&mut app, KeyCode::PageDown);
    assert_eq!(app.selected, 0);
    key(&mut app, KeyCode::Enter);
    key(&mut app, KeyCode::PageDown);
    assert_eq!(app.selected, 6);
}

/// What has no room below the six lines comes by paging, down to its end.
#[test]
fn the_sentences_of_an_option_are_read_to_their_end() {
    let mut app = finished();
    let last = "breaks in 0.00 to";
    key(&mut app, KeyCode::Enter);
    let mut pages = Vec::new();
    for _ in 0..20 {
        app.note_drawn(draw_areas(&app, 60, 18));
        pages.push(text(&draw(&app, 60, 18)));
        key(&mut app, KeyCode::PageDown);
    }
    assert!(pages[0].contains("… more: PgDn") && !pages[0].contains(last), "{}", pages[0]);
    assert!(pages[19].contains(last) && pages[19].contains("back: PgUp"), "{}", pages[19]);
}

/// The page that is signed says what its pass stands on: one that would lack it is only written when asked for again.
#[test]
fn a_page_waits_for_what_the_pass_stands_on() {
    let mut app = finished();
    app.selected = 4;
    assert_eq!(press(&mut app, "P"), Request::None);
    let unsaved = press(&mut app, "P");
    assert!(matches!(&unsaved, Request::NamePage(name) if name.ends_with("not-saved")), "{unsaved:?}");
    let _folder = save(&mut app);
    app.page_warned = None;
    assert_eq!(press(&mut app, "P"), Request::None);
    assert!(text(&draw(&app, 80, 24)).contains("what this pass holds until, it is still being found"));
    // Once it is found nobody waits for it.
    let mut waited = app.clone();
    waited.take_news(News::Assumptions { option: 4, found: Box::new(nothing_fails(4)) });
    assert!(!text(&draw(&waited, 80, 24)).contains("still being found"));
    let asked = press(&mut app, "P");
    assert!(matches!(&asked, Request::NamePage(name) if name.ends_with("not-complete")), "{asked:?}");
    let folder = tempfile::tempdir().expect("a folder");
    let written = |app: &App, name: &str| {
        let path = folder.path().join(name);
        assert_eq!(export::write_page(app, &path), Ok(()));
        std::fs::read_to_string(path).expect("a page")
    };
    let early = written(&app, "early.html");
    assert!(early.contains("not known: the page was written before it was found"));
    assert_eq!(
        early.matches("NOT to be fired, this page is not complete").count(),
        3,
        "wherever it lies alone"
    );
    let case = app.case.clone();
    assert_eq!(app.record.add_line(&case, 4, "3:1 1.9 0.05"), Ok(()));
    app.record.withdraw_last("2026-11-26");
    let told = written(&app, "told.html");
    assert!(!early.contains("taken back") && told.contains("it was seen, and taken back on 2026-11-26"));
    app.page_warned = None;
    app.assumptions[4] = Some(Box::new(nothing_fails(4)));
    let asked = press(&mut app, "P");
    assert!(matches!(&asked, Request::NamePage(name) if name.ends_with("to-be-fired")), "{asked:?}");
    let late = written(&app, "late.html");
    assert!(!late.contains("NOT to be fired") && !late.contains("not known: the page"));
    assert!(late.contains("I have confirmed each of the"), "values marked as assumed are signed for");
    let options = app.options.clone();
    // Nobody takes another option from the page for better than it is.
    app.options[1] = app.options[4].clone();
    assert!(written(&app, "untried.html").contains("PASS, margin not tried"));
    app.assumptions[1] = Some(Box::new(nothing_fails(1)));
    assert!(!written(&app, "tried.html").contains("margin not tried"));
    let OptionState::Judged { judgement, .. } = &mut app.options[1] else { panic!("judged") };
    judgement.launch_margin = Some(LaunchMargin::UpTo { rise: 0.01, above: Verdict::Fail });
    let thin = written(&app, "thin.html");
    assert!(thin.contains(", 1 of them thinly") && thin.contains(">THIN<"), "{thin}");
    app.options[1] = options[1].clone();
    app.assumptions[1] = None;
    // Who signs sees when the holes fire, whatever the option is called.
    assert!(
        late.contains(
            "To be fired only if all that is to be confirmed is right, slide NOT checked: option “42 ms”, rows at 1: 0 ms, 2: 42 ms, 3: 84 ms, "
        )
    );
}

/// Where another option is recommended, the page of one that does not pass is asked for by name; neither says more than its verdict.
#[test]
fn the_page_of_the_recommended_option_is_offered_first() {
    let mut app = finished();
    let _folder = save(&mut app);
    app.assumptions[4] = Some(Box::new(nothing_fails(4)));
    let before = app.clone();
    recommend(&mut app, 4);
    let unanswered = app.clone();
    let page_of = |mut app: App, keys: &[KeyCode]| {
        assert_eq!(press(&mut app, "P"), Request::None, "it asks first");
        let asked = text(&draw(&app, 80, 24));
        for words in ["Page of which option?", "“all at once” does not pass, “42 ms” is the recommended one"]
        {
            assert!(asked.contains(words), "{words}:\n{asked}");
        }
        let request = keys.iter().fold(Request::None, |_, &code| key(&mut app, code));
        let Request::NamePage(name) = request else { panic!("{request:?}") };
        (app.selected, name)
    };
    // Whoever presses Enter twice has not chosen.
    let [first, second] = [vec![KeyCode::Enter, KeyCode::Down], vec![KeyCode::Down, KeyCode::Down]];
    let then_enter = |keys: Vec<KeyCode>| [keys, vec![KeyCode::Enter]].concat();
    let (selected, name) = page_of(unanswered.clone(), &then_enter(first));
    assert!(selected == 4 && name.ends_with("-42-ms-if-confirmed-to-be-fired"), "{name}");
    let (selected, name) = page_of(unanswered, &then_enter(second));
    assert!(selected == 0 && name.ends_with("-all-at-once-fails"), "{name}");
    key(&mut app, KeyCode::Char('P'));
    assert!(key(&mut app, KeyCode::Esc) == Request::None && app.prompt.is_none(), "nothing is written");
    // Nothing is offered instead of the recommended option, before there is one, or where no pass stands.
    app.selected = 4;
    assert!(matches!(press(&mut app, "P"), Request::NamePage(name) if name.ends_with("to-be-fired")));
    let mut early = before;
    assert!(matches!(press(&mut early, "P"), Request::NamePage(name) if name.ends_with("-fails")));
    app.selected = 0;
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    assert!(matches!(press(&mut app, "P"), Request::NamePage(name) if name.ends_with("-fails")));
    app.selected = 4;
    assert!(matches!(press(&mut app, "P"), Request::NamePage(name) if name.ends_with("-hold")));
}

/// A page that permitted to fire stays beside the plan after what was seen speaks against it: every screen says not to fire by it, and so
/// does the prompt of a new page.
#[test]
fn a_page_that_no_longer_permits_is_named() {
    let mut app = finished();
    let folder = save(&mut app);
    let plan = std::path::PathBuf::from(&app.case.source.path);
    for option in [4, 0] {
        app.selected = option;
        app.assumptions[option] = Some(Box::new(nothing_fails(option)));
        let path = folder.path().join(["fails.html", "old-to-be-fired.html"][usize::from(option == 4)]);
        assert_eq!(export::write_page(&app, &path), Ok(()));
    }
    app.selected = 4;
    let page = std::fs::read_to_string(folder.path().join("old-to-be-fired.html")).expect("a page");
    for (name, text) in [
        ("notes.html", page.replace("generator", "author")),
        ("of-another-plan.html", page.replace("plan.toml", "other.toml")),
        ("page.txt", page),
    ] {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    // What passes is no longer among those that may not be fired.
    let refused = app.refused();
    assert!(
        !refused.contains(&"42 ms".to_owned()) && refused.contains(&"all at once".to_owned()),
        "{refused:?}"
    );
    let permitting = |text: &str, refused: &[String]| permitting_wrongly(&plan, text, refused);
    let saved = app.editor.saved().to_owned();
    assert_eq!(permitting(&saved, &refused), Vec::<String>::new());
    assert_eq!(permitting(&(saved.clone() + "\n# a note"), &refused), ["old-to-be-fired.html"]);
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    assert_eq!(app.refused().len(), 7);
    app.old_pages = permitting(&saved, &app.refused());
    assert_eq!(app.old_pages, ["old-to-be-fired.html"]);
    for screen in Screen::ALL {
        app.screen = screen;
        let drawn = text(&draw(&app, 120, 36));
        assert!(drawn.contains("old-to-be-fired.html was written before: do not fire by it"), "{drawn}");
    }
    app.ask_for_file(Purpose::Page, "page.html");
    let drawn = text(&draw(&app, 80, 24)).replace("\n ", " ");
    assert!(
        drawn.contains("page of “42 ms” (HOLD, NOT to be fired) · old-to-be-fired.html was written before"),
        "{drawn}"
    );
}

/// While a page is being named, another program puts the options of the plan in another order: no key of the name becomes a command, the page
/// is none to fire by, and then the option in hand stays the same.
#[test]
fn options_in_another_order_take_no_page_of_one_for_that_of_another() {
    let mut app = finished();
    let _folder = save(&mut app);
    app.selected = 4;
    app.fired = Some(2);
    app.ask_for_file(Purpose::Page, "plan-42-ms-to-be-fired.html");
    let mut reversed = app.case.with_options(&[6, 5, 4, 3, 2, 1, 0]);
    reversed = reversed.with_options(&[1, 2, 3, 4, 5, 6]);
    reversed.source.text += "\n# another order";
    assert_eq!(app.reload(Ok(reversed.clone())), Request::None);
    assert!(text(&draw(&app, 120, 36)).contains("the file has changed; it is read once this line is done"));
    press(&mut app, "ad");
    let typed = app.prompt.as_ref().map(|prompt| prompt.line.input.value().to_owned());
    assert_eq!(typed.as_deref(), Some("ad"), "the first letter takes the place of the name that is offered");
    assert!(app.is_held() && app.misnames_page("plan-42-ms-to-be-fired.html".as_ref()));
    key(&mut app, KeyCode::Esc);
    assert!(app.file_is_newer && !app.is_changing(), "now it is read");
    app.reload(Ok(reversed));
    assert_eq!(app.case.plan.delays[app.selected].name, "42 ms");
    assert_eq!(app.fired.map(|fired| app.case.plan.delays[fired].name.clone()).as_deref(), Some("20 ms"));
}

/// What a pass stands on where no value that was tried fails.
fn nothing_fails(option: usize) -> Assumptions {
    Assumptions { option, samples: 200, accepted: 2, planned: Verdict::Pass, failing: 0, all: Vec::new() }
}

/// Whether a pass is thin is known before what it holds until: then it is told. It is final once that is found, too, for which the page waits.
#[test]
fn an_answer_is_told_once_it_is_known_whether_it_is_thin() {
    let mut app = finished();
    recommend(&mut app, 4);
    app.selected = 4;
    let _folder = save(&mut app);
    let launch = Assumption {
        assumed: Assumed::LaunchVelocity,
        stated: 1.0,
        passes_until: Some(1.05),
        fails_from: None,
        ratio: None,
        is_complete: false,
    };
    app.take_news(News::Assumptions {
        option: 4,
        found: Box::new(Assumptions { all: vec![launch], ..nothing_fails(4) }),
    });
    let screen = text(&draw(&app, 120, 36));
    let first = screen.lines().nth(1).unwrap_or_default();
    assert!(first.contains("NOT YET  42 ms passes") && screen.contains("✓ PASS"), "{screen}");
    assert!(!first.contains("final"), "{screen}");
    assert!(screen.contains("holds    still being found"), "{screen}");
    assert_eq!(press(&mut app, "P"), Request::None, "the page says what it holds until");
    let unfinished = press(&mut app, "P");
    assert!(
        matches!(&unfinished, Request::NamePage(name) if name.ends_with("not-complete")),
        "{unfinished:?}"
    );
    let fails = Assumption { passes_until: Some(1.0), fails_from: Some(1.01), ratio: Some(1.01), ..launch };
    app.take_news(News::Assumptions {
        option: 4,
        found: Box::new(Assumptions { all: vec![fails, launch], ..nothing_fails(4) }),
    });
    let screen = text(&draw(&app, 120, 36));
    assert!(
        screen.contains("△ 42 ms passes") && screen.contains("thinly") && !screen.contains("holds    "),
        "{screen}"
    );
}

/// A limit of 23.5 m for 2.35 m, and an accepted risk of 50 %, are seen beside the PASS that they make.
#[test]
fn a_slip_of_the_pen_and_a_great_risk_stand_above_the_table() {
    for (label, typed, told) in [
        ("limit of flight height", "23.5", "flight_height_m 23.5: a slip"),
        ("accepted risk", "50", "1 in 2 shots may fail by this plan"),
    ] {
        let mut app = finished();
        press(&mut app, "1");
        app.editor.find(label, false);
        key(&mut app, KeyCode::Enter);
        press(&mut app, typed);
        assert_eq!(key(&mut app, KeyCode::Enter), Request::JudgeNewPlan);
        press(&mut app, "2");
        let screen = text(&draw(&app, 80, 24));
        assert!(screen.contains(told), "{screen}");
    }
}

/// A pass that ends where tires leave little faster is said to be thin: in the headline where it is recommended, else by a badge.
#[test]
fn a_thin_pass_is_called_thin() {
    let mut app = finished();
    app.selected = 4;
    for (passes_until, fails_from, is_thin) in [(1.2, 1.3, false), (1.02, 1.03, true)] {
        let launch = Assumption {
            assumed: Assumed::LaunchVelocity,
            stated: 1.0,
            passes_until: Some(passes_until),
            fails_from: Some(fails_from),
            ratio: Some(fails_from),
            is_complete: true,
        };
        app.assumptions[4] = Some(Box::new(Assumptions { all: vec![launch], ..nothing_fails(4) }));
        let screen = text(&draw(&app, 120, 36));
        assert_eq!(screen.contains("42 ms THIN: only until tires leave 2 % faster"), is_thin, "{screen}");
        let mut app = app.clone();
        recommend(&mut app, 4);
        for selected in [4, 0] {
            app.selected = selected;
            let screen = draw(&app, 80, 24);
            let (head, all) = (text(&screen).lines().nth(1).expect("a line").to_owned(), text(&screen));
            let thin = "△ 42 ms passes, but thinly: only until tires leave 2 % faster";
            assert_eq!(head.contains(thin), is_thin, "{all}");
            assert!(!all.contains("THIN:"), "the headline says it: {all}");
            assert!(head.starts_with("  NOT YET  "), "{all}");
            assert_eq!(Some(screen[(1, 1)].fg), app.theme.caution().fg, "{all}");
        }
    }
    let mut narrow = app.clone();
    for name in ["42 ms, village side first", "42 ms, village side first, then the far rows"] {
        Arc::make_mut(&mut narrow.case).plan.delays[4].name = name.to_owned();
        recommend(&mut narrow, 4);
        for screen in [Screen::Compare, Screen::Flight, Screen::Studies, Screen::Accuracy] {
            narrow.screen = screen;
            let drawn = text(&draw(&narrow, 60, 20));
            let head = drawn.lines().nth(1).expect("a line");
            assert!(head.contains("△ 42 ms") && head.contains("thinly"), "no width takes its word: {drawn}");
        }
    }
    assert_eq!(press(&mut app, "r"), Request::Judge);
    assert!(app.assumptions.iter().all(Option::is_none), "of what is judged anew nothing old stands");
}

/// A pass of which other draws of the same plan fail is on HOLD: nothing on the screen looks like a pass.
#[test]
fn a_pass_that_other_draws_refuse_is_on_hold() {
    let mut app = finished();
    let _folder = save(&mut app);
    app.selected = 4;
    recommend(&mut app, 4);
    app.assumptions[4] = Some(Box::new(Assumptions { failing: 3, ..nothing_fails(4) }));
    let pass = app.theme.verdict(Verdict::Pass).fg.expect("a colour");
    for width in [60, 80, 120] {
        let screen = draw(&app, width, 36);
        let all = text(&screen);
        assert!(all.lines().nth(1).is_some_and(|line| line.starts_with(" ! HOLD")), "{all}");
        assert!(
            all.contains("42 ms ! HOLD") && !all.contains("PASS") && all.contains("0 of 7 pass"),
            "{all}"
        );
        assert!(all.contains("not with all as stated: 3 of 200 fail"), "{all}");
        assert!(screen.content.iter().all(|cell| cell.fg != pass), "{all}");
    }
    let asked = press(&mut app, "P");
    assert!(matches!(&asked, Request::NamePage(name) if name.ends_with("42-ms-hold")), "{asked:?}");
}

/// The slide is that of the shot that may be fired, not of the row that is looked at; and no badge moves before another.
#[test]
fn badges_speak_of_the_recommended_option_and_keep_their_order() {
    let mut app = finished();
    Arc::make_mut(&mut app.case).plan.uncertainty.incomplete = true;
    let drawn = |app: &App| text(&draw(app, 170, 36)).lines().nth(2).expect("the badges").to_owned();
    app.selected = 1;
    assert!(drawn(&app).contains("slide NOT checked: with 9 ms"), "{}", drawn(&app));
    recommend(&mut app, 4);
    for selected in 0..app.options.len() {
        app.selected = selected;
        let badges = drawn(&app);
        let places = ["slide NOT checked: with 42 ms", "some inputs are defaults", "on this option"];
        let places: Vec<usize> = places.iter().filter_map(|badge| badges.find(badge)).collect();
        assert!(places.len() >= 2 && places.is_sorted(), "{badges}");
    }
}

/// What one dud does is said of the option that is looked at, too, by name: on Compare in a line of its own, else by a badge.
#[test]
fn a_dud_of_the_selected_option_is_told_on_all_screens() {
    let mut app = finished();
    recommend(&mut app, 4);
    app.selected = 1;
    let Part::Dud { one_dud: Some(dud), .. } = withstood_dud() else { panic!("a dud") };
    let OptionState::Judged { judgement, .. } = &mut app.options[1] else { panic!("judged") };
    judgement.one_dud = Some(OneDud { not_passing: 3, failing: 2, ..*dud });
    for screen in [Screen::Flight, Screen::Studies, Screen::Accuracy, Screen::Plan] {
        app.screen = screen;
        let badges = |width: u16| text(&draw(&app, width, 36)).lines().nth(2).expect("badges").to_owned();
        assert!(badges(170).contains("9 ms: one dud exceeds a limit at 2 of 15 holes"), "{}", badges(170));
        for width in [60, 80] {
            let badges = badges(width);
            assert!(badges.contains("9 ms: ") || badges.contains("dud in this one"), "{badges}");
        }
    }
    app.screen = Screen::Compare;
    let drawn = text(&draw(&app, 60, 20));
    assert!(drawn.contains("one dud  exceeds a limit at 2 of 15 holes"), "{drawn}");
}

/// A lighter tire may leave faster, a heavier one as fast: the launches follow, and the screen says so.
#[test]
fn launches_follow_the_mass_of_the_tires_and_the_screen_says_so() {
    let mut app = finished();
    let speeds = |app: &App| app.case.plan.launches().map(|launch| launch.speed_m_s).collect::<Vec<_>>();
    press(&mut app, "1");
    app.editor.find("tire mass", false);
    assert_eq!(key(&mut app, KeyCode::Left), Request::JudgeNewPlan);
    let mass = app.case.plan.tire.mass_kg;
    assert!(mass < 280.0 && speeds(&app).iter().all(|speed| (speed / 6.0 - 280.0 / mass).abs() < 1e-5));
    let says = |app: &App, words: &str| text(&draw(app, 120, 36)).contains(words);
    assert!(says(&app, "launch_mass_exponent 1, the worse end"), "{}", text(&draw(&app, 120, 36)));
    key(&mut app, KeyCode::Right);
    assert_eq!((app.case.plan.tire.mass_kg, speeds(&app)), (280.0, vec![6.0; 3]));
    key(&mut app, KeyCode::Right);
    assert_eq!(speeds(&app), [6.0; 3]);
    assert!(says(&app, "launches stay (launch_mass_exponent 0"), "{}", text(&draw(&app, 120, 36)));
    press(&mut app, "uuu");
    assert!(!app.editor.unsaved());
}

/// A velocity that is typed is not as well known as the one that was filmed: a badge asks, until its key is changed, too, or the file
/// holds both. A velocity that follows the mass of the tires is that of the film.
#[test]
fn a_launch_velocity_that_is_typed_asks_how_well_it_is_known() {
    let mut app = finished();
    let asks =
        |app: &App| text(&draw(app, 170, 45)).contains("launch speed changed: is it known to 3 % as before?");
    press(&mut app, "1");
    app.editor.find("tire mass", false);
    key(&mut app, KeyCode::Left);
    assert!(!asks(&app));
    press(&mut app, "u");
    app.editor.find("launch, m/s", false);
    assert_eq!(key(&mut app, KeyCode::Left), Request::JudgeNewPlan);
    assert!(asks(&app), "{}", text(&draw(&app, 170, 45)));
    press(&mut app, "2");
    assert!(asks(&app), "{}", text(&draw(&app, 170, 45)));
    press(&mut app, "1u");
    assert!(!asks(&app));
}

/// An interval steps by whole milliseconds, and with Shift through the delay times that detonators have.
#[test]
fn intervals_step_by_milliseconds_and_through_common_times() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    app.editor.select_option(1);
    let interval = |app: &App| app.case.plan.delays[1].timing.fire_at()[1].ms();
    assert_eq!(interval(&app), 9.0);
    key(&mut app, KeyCode::Right);
    assert_eq!((interval(&app), app.case.plan.delays[1].name.as_str()), (10.0, "10 ms"));
    for (code, expected) in [(KeyCode::Right, 17.0), (KeyCode::Right, 25.0), (KeyCode::Left, 17.0)] {
        dispatch(&mut app, &Event::Key(KeyEvent::new(code, KeyModifiers::SHIFT)));
        assert_eq!(interval(&app), expected);
    }
}

/// What is typed wrongly says how it is written.
#[test]
fn a_wrong_value_says_how_to_write_it() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    app.editor.select_option(1);
    key(&mut app, KeyCode::Enter);
    for letter in "0-5".chars() {
        key(&mut app, KeyCode::Char(letter));
    }
    let problem = app.editor.problem.as_deref().expect("a problem");
    assert!(problem.ends_with("is no value here: write it as 20"), "{problem}");
}

/// All options and groups of values stand on one screen, a line each; a page key goes from one to the next.
#[test]
fn the_plan_has_a_line_for_each_option() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    let screen = text(&draw(&app, 80, 24));
    for (option, line) in [("42 ms", "… 0 42 84 ms 1-2-3"), ("long period", "✗ 0 500")] {
        let row = screen.lines().find(|row| row.trim_start().starts_with(option)).expect(option);
        assert!(row.contains(line), "{row}");
    }
    let narrow = text(&draw(&app, 60, 20));
    let row = narrow.lines().find(|row| row.trim_start().starts_with("109 ms")).expect("109 ms");
    assert!(row.contains("0 109 218 ms ") && !row.contains("218 ms  1"), "no order is cut: {row}");
    key(&mut app, KeyCode::PageDown);
    let field = app.editor.field().expect("a value");
    assert_eq!((field.path.index, field.path.key.name), (Some(1), "interval_ms"));
    assert_eq!(app.selected, 1);
}

/// A page is offered while other options compute; its name says that more is to come, and a plan in no file gives its title.
#[test]
fn a_page_does_not_wait_for_other_options() {
    let mut app = finished();
    app.options[6] = OptionState::Waiting;
    app.selected = 0;
    let Request::NamePage(name) = press(&mut app, "P") else { panic!("a page is offered") };
    assert!(name.ends_with("-all-at-once-fails"), "{name}");
    let mut case = (*app.case).clone();
    case.source.path = shelter::tui::NEW_PLAN.into();
    app.case = std::sync::Arc::new(case);
    app.selected = 2;
    app.options[2] = app.options[1].clone();
    let Request::NamePage(name) = press(&mut app, "P") else { panic!("a page is offered") };
    assert_eq!(name, "Three-rows-village-side-ballasted-20-ms-open-so-far");
    app.selected = 6;
    assert_eq!(press(&mut app, "P"), Request::None, "no result yet");
}

/// A click on the map types the time that stands there: that of the row in a list of times, else the interval of all rows.
#[test]
fn a_click_on_a_firing_time_of_the_map_types_it() {
    let mut app = finished();
    app.screen = Screen::Plan;
    let click_on_row = |app: &mut App, row: usize| {
        let areas = draw_areas(app, 120, 36);
        let of_row = areas.iter().rev().find(|(_, target)| *target == ClickTarget::FiringTime(row));
        let at = of_row.expect("a hole of the row").0.as_position();
        app.areas = areas;
        app.click(at)
    };
    app.selected = 6;
    assert_eq!(app.case.plan.delays[6].name, "long period");
    click_on_row(&mut app, 1);
    assert!(app.editor.entry.is_some());
    // Behind the 500 of the second row.
    key(&mut app, KeyCode::Backspace);
    press(&mut app, "5");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::JudgeNewPlan);
    let firings = &app.case.shots[6].firings;
    let time = |row: usize| firings.iter().find(|firing| firing.row == row).expect("a hole").time;
    assert_eq!([time(0), time(1), time(2)], [0.0, 0.505, 1.0]);
    app.selected = 2;
    click_on_row(&mut app, 2);
    let field = app.editor.field().expect("a field");
    assert_eq!((field.group.as_str(), field.label), ("option 20 ms", "interval, ms"));
    assert!(app.editor.entry.is_some());
}

/// A newer page of an option takes the place of the one written before, and of no other file.
#[test]
fn a_second_page_of_an_option_replaces_the_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut app, path) = (finished(), folder.path().join("page.html"));
    assert_eq!(export::write_page(&app, &path), Ok(()));
    assert!(export::write_page(&app, &path).is_err(), "a file of somebody else stays");
    app.pages.push(path.clone());
    assert_eq!(export::write_page(&app, &path), Ok(()));
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 1);
}

/// The answer of `check` where every option has this verdict.
fn judged_as(app: &App, verdict: Verdict) -> Found {
    let judged = || Ok(Judgement::of_planned_alone(checked(verdict)));
    let results = app.case.plan.delays.iter().map(|_| judged()).collect();
    let plan = JudgedPlan { results, must_pass: MustPass::Every, remedies: None };
    Found::Check(Box::new(Computed::complete(plan)))
}

/// Estimates of a fit that make a PASS of a FAIL are asked for first, with every verdict that would change; Esc leaves the plan alone.
/// What is asked follows the verdicts on the screen, and goes with the plan that it was asked of.
#[test]
fn estimates_go_into_the_plan_only_once_their_verdicts_were_told_and_taken() {
    let asked = || {
        let mut app = finished();
        app.screen = Screen::Compare;
        app.fitted_plan = Some(FittedPlan { case: app.case.clone(), n_observations: 1, verdicts: None });
        app
    };
    let screen = |app: &App, width| text(&draw(app, width, 24)).split_whitespace().join(" ");
    let mut app = asked();
    assert!(screen(&app, 60).contains("before the estimates go into the plan"));
    let better = judged_as(&app, Verdict::Pass);
    study_ends(&mut app, StudyKind::Check, Ok(better));
    for width in [60, 80, 120] {
        let screen = screen(&app, width);
        let is_told =
            screen.contains("9 ms OPEN → PASS or THIN") && screen.contains("ONE observation is little");
        assert!(is_told && screen.contains("y puts the estimates into the plan"), "{width}:\n{screen}");
        assert!(screen.contains("slide NOT checked"), "badges stay, {width}:\n{screen}");
    }
    for shown in Screen::ALL {
        app.screen = shown;
        assert!(text(&draw(&app, 60, 18)).contains("y puts the estimates into the plan"), "{shown:?}");
    }
    app.screen = Screen::Compare;
    let sampled = Box::new(samples(&app.case, 200, true));
    app.take_news(News::Found { option: 4, part: Part::Samples { sampled, more: false } });
    assert!(screen(&app, 120).contains("4 more"), "42 ms is one of them now: {}", screen(&app, 120));
    let before = app.editor.text.clone();
    // Any other key does nothing, and that is said beside the question.
    press(&mut app, "q");
    let told = screen(&app, 120);
    assert!(told.contains("first: y takes the estimates") && told.contains("with the estimates: "), "{told}");
    assert_eq!(key(&mut app, KeyCode::Esc), Request::None);
    assert!(app.fitted_plan.is_none() && app.editor.text == before && !screen(&app, 120).contains("→"));
    // Another plan, another accuracy, another fit: what was asked is asked no more.
    let changes: [fn(&mut App); 3] = [
        |app| drop(app.reload(Case::parse(edited(app)).map_err(|mistakes| mistakes.first()))),
        |app| drop(press(app, "r")),
        |app| drop(app.take_observed_file("seen.csv".as_ref(), Ok(SEEN.to_owned()))),
    ];
    for change in changes {
        let mut app = asked();
        change(&mut app);
        assert!(app.fitted_plan.is_none());
        let better = judged_as(&app, Verdict::Pass);
        study_ends(&mut app, StudyKind::Check, Ok(better));
        assert!(!app.asks_for_estimates(), "the answer comes too late");
    }
}

const SEEN: &str = "option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,1.7,0.05\n";

/// The plan of the app as another program may have changed it.
fn edited(app: &App) -> PlanSource {
    let PlanSource { path, text } = app.case.source.clone();
    PlanSource { path, text: format!("{text}\n# changed\n") }
}

/// A refusal that is no longer true goes, without a key.
#[test]
fn a_refusal_goes_once_the_option_is_judged() {
    let mut app = finished();
    (app.screen, app.selected, app.has_selected) = (Screen::Compare, 5, true);
    let first = samples(&app.case, 100, false);
    app.take_news(News::Found { option: 5, part: Part::Samples { sampled: Box::new(first), more: true } });
    press(&mut app, "w");
    assert!(text(&draw(&app, 80, 24)).contains("the option is not judged yet"));
    let all = samples(&app.case, 500, true);
    app.take_news(News::Found { option: 5, part: Part::Samples { sampled: Box::new(all), more: false } });
    assert!(!text(&draw(&app, 80, 24)).contains("the option is not judged yet"));
}

/// The page of an option, its changes: who asks for them has chosen it, and the recommended one does not take its place. Who only looks at
/// other screens has chosen none.
#[test]
fn the_selection_stays_where_the_user_has_put_it() {
    type Act = (&'static str, bool, fn(&mut App));
    let acts: [Act; 10] = [
        ("nothing", false, |_| ()),
        ("Down", true, |app| drop(key(app, KeyCode::Down))),
        ("Enter", true, |app| drop(key(app, KeyCode::Enter))),
        ("the page", true, |app| drop(press(app, "P"))),
        ("the flight", false, |app| drop(press(app, "3"))),
        ("the flight and back", false, |app| drop(press(app, "32"))),
        ("the studies", false, |app| drop(press(app, "4"))),
        ("a study begun", false, |app| drop((press(app, "4"), key(app, KeyCode::Enter)))),
        ("the plan and back", true, |app| drop((press(app, "1"), key(app, KeyCode::Down), press(app, "2")))),
        ("changes", true, |app| drop(press(app, "w"))),
    ];
    for (what, is_chosen, act) in acts {
        let mut app = finished();
        (app.screen, app.selected) = (Screen::Compare, 1);
        act(&mut app);
        let chosen = app.selected;
        answer_comes(&mut app);
        assert_eq!(app.selected, if is_chosen { chosen } else { 4 }, "{what}");
    }
}

/// The last option has its samples, and 42 ms is recommended.
fn answer_comes(app: &mut App) {
    let sampled = Box::new(samples(&app.case, 500, false));
    app.take_news(News::Found { option: 4, part: Part::Samples { sampled, more: false } });
    assert_eq!(app.recommended(), Some(4));
}

/// A flight that is watched goes on, and so does what was measured; the recommended option is selected behind it.
#[test]
fn what_is_shown_of_an_option_stays_until_another_screen() {
    for (keys, kind) in [("3", StudyKind::Flight), ("5", StudyKind::Accuracy)] {
        let mut app = finished();
        (app.screen, app.selected) = (Screen::Compare, 1);
        press(&mut app, keys);
        let found = match kind {
            StudyKind::Flight => {
                app.request_flight();
                recorded(&app, 1)
            }
            _ => {
                let Found::Accuracy(mut table) = measured() else { panic!("a table") };
                table.value.option = 1;
                Found::Accuracy(table)
            }
        };
        study_ends(&mut app, kind, Ok(found));
        answer_comes(&mut app);
        assert_eq!(app.selected, 1, "{keys}");
        press(&mut app, "2");
        assert_eq!(app.selected, 4, "{keys}");
    }
}

/// Enter after a `P` that came too early was meant for the name of the page: nothing else happens.
#[test]
fn enter_after_a_page_that_is_refused_does_nothing_else() {
    let mut app = finished();
    app.screen = Screen::Compare;
    for (option, told) in
        [(4, "what this pass holds until, it is still being found"), (1, "has no result yet")]
    {
        app.options[1] = OptionState::Waiting;
        app.selected = option;
        assert_eq!(press(&mut app, "P"), Request::None);
        assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
        assert!(!app.zoom && app.notice.as_deref().is_some_and(|notice| notice.contains(told)));
        key(&mut app, KeyCode::Enter);
        assert!(app.zoom, "a second one enlarges");
        app.zoom = false;
    }
}

/// The flight of the selected option goes round in the charts below the table, and beside them where there is room, until it is told to
/// rest. While anything computes, a dot stands there for each shot that was tried.
#[test]
fn a_flight_plays_below_the_table_once_nothing_computes() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Compare, 4);
    for (screen, asked) in
        [(Screen::Accuracy, Request::None), (Screen::Compare, Request::Study(StudyKind::Flight))]
    {
        app.screen = screen;
        app.areas = draw_areas(&app, 80, 24);
        assert_eq!(app.request_flight(), asked, "{screen:?}");
    }
    let screen = |app: &App, (width, height): (u16, u16)| text(&draw(app, width, height));
    let wide = (170, 45);
    assert!(screen(&app, wide).contains("500 shots tried, a dot each"), "{}", screen(&app, wide));
    let flight = recorded(&app, 4);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    let sizes = [(80, 24), (120, 36), wide];
    let before = sizes.map(|size| screen(&app, size));
    assert!(app.plays_below() && !app.playing());
    app.advance(Duration::from_secs(1));
    for (size, before) in sizes.into_iter().zip(before) {
        let moved = screen(&app, size);
        assert!(moved != before && moved.contains('┆'), "{moved}");
        assert_eq!(moved.contains("in flight, x0.1 · 0.100 s"), size.0 > 80, "{moved}");
    }
    key(&mut app, KeyCode::Char(' '));
    assert!(!app.plays_below() && screen(&app, wide).contains("0.100 s"), "it rests where it is");
    key(&mut app, KeyCode::Char(' '));
    let worst = app.flight().map(|flight| flight.worst_moment(&app.case.limits));
    click_at(&mut app, (160, 40), wide);
    assert_eq!((app.screen, Some(app.player.time)), (Screen::Flight, worst), "it opens at the worst moment");
    // Left alone it plays now and then; who steers it has it where he put it.
    for (seconds, is_playing) in [(3, false), (2, true), (60, false), (5, true)] {
        app.advance(Duration::from_secs(seconds));
        assert_eq!((app.plays_by_itself(), app.playing()), (true, is_playing), "{seconds} s");
    }
    key(&mut app, KeyCode::Char('n'));
    key(&mut app, KeyCode::Char(' '));
    app.advance(Duration::from_secs(60));
    assert!(!app.plays_by_itself() && !app.playing());
    app.screen = Screen::Compare;
    app.options[1] = OptionState::Waiting;
    assert!(!app.plays_below() && screen(&app, wide).contains("500 shots tried, a dot each"));
}

/// What ends a comparison is not among the keys that have no room.
#[test]
fn the_footer_has_the_page_at_every_width() {
    let footer =
        |app: &App, width, height| text(&draw(app, width, height)).lines().last().expect("keys").to_owned();
    for (width, height) in [(60, 20), (80, 24), (120, 36)] {
        let mut app = finished();
        let begun = footer(&app, width, height);
        assert!(
            begun.contains("P page") && !begun.contains("u undo") && !begun.contains("s save"),
            "{width}: {begun}"
        );
        press(&mut app, "d");
        let changed = footer(&app, width, height);
        assert!(changed.contains("P page") && changed.contains("s save"), "{width}: {changed}");
    }
}

/// Who looks at another option meanwhile ends nothing, neither by arrow keys nor by Esc.
#[test]
fn what_would_make_an_option_pass_goes_on_while_others_are_looked_at() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Compare, 0);
    assert_eq!(press(&mut app, "w"), Request::Study(StudyKind::Remedies));
    // Enter takes a change from the list: it is no other key as long as there is none.
    assert_eq!(key(&mut app, KeyCode::Enter), Request::None);
    assert!(!app.zoom && text(&draw(&app, 80, 24)).contains("the changes are still being looked for"));
    for code in [KeyCode::Down, KeyCode::Down, KeyCode::Esc, KeyCode::Up] {
        assert_eq!(key(&mut app, code), Request::None, "{code:?}");
        assert!(app.studies.is_running(StudyKind::Remedies), "{code:?}");
        assert!(!text(&draw(&app, 80, 24)).contains("what would make it pass? "), "{code:?}");
    }
    key(&mut app, KeyCode::Up);
    assert!(text(&draw(&app, 80, 24)).contains("what would make it pass? "));
    assert_eq!(key(&mut app, KeyCode::Esc), Request::Cancel(StudyKind::Remedies));
}

/// A page of an option of which more shots are tried is only made for who asks twice: it bears the name of the finished one.
#[test]
fn a_page_of_what_is_still_tried_is_asked_for_twice() {
    let mut app = finished();
    (app.screen, app.selected, app.has_selected) = (Screen::Compare, 5, true);
    let first = samples(&app.case, 100, false);
    app.take_news(News::Found { option: 5, part: Part::Samples { sampled: Box::new(first), more: true } });
    assert_eq!(press(&mut app, "P"), Request::None);
    let screen = text(&draw(&app, 80, 24));
    assert!(screen.contains("more shots of this option are tried: wait, or P again"), "{screen}");
    assert!(matches!(press(&mut app, "P"), Request::NamePage(_)));
}

/// On a pass the key says how far it holds.
#[test]
fn why_on_a_pass_says_what_it_holds_until() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Compare, 4);
    press(&mut app, "w");
    assert!(text(&draw(&app, 80, 24)).contains("42 ms passes; what it holds until is still being found"));
    app.assumptions[4] = Some(Box::new(nothing_fails(4)));
    press(&mut app, "w");
    assert!(text(&draw(&app, 80, 24)).contains("42 ms holds at every value tried"));
    assert_eq!(app.record.add_line(&app.case, 2, "3:1 2.55 0.05"), Ok(()));
    press(&mut app, "w");
    assert!(text(&draw(&app, 80, 24)).contains("42 ms: its pass does not stand"));
}

/// A warned wish to quit does not outlive what is done after it by mouse: the next one is asked about anew.
#[test]
fn a_click_takes_a_wish_to_quit_back() {
    let mut app = finished();
    press(&mut app, "d");
    assert_eq!(press(&mut app, "q"), Request::None, "changes are not saved");
    click(&mut app, "109 ms");
    assert_eq!(press(&mut app, "q"), Request::None, "asked anew");
    assert_eq!(press(&mut app, "q"), Request::Quit);
}
