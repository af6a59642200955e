//! What keys and clicks do, without a terminal.

use crossterm::event::{Event, KeyCode, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Position;
use shelter::study::NoResult;
use shelter::tui::app::{App, Request, Row, Screen};
use shelter::tui::compare::SortBy;
use shelter::tui::config::Config;
use shelter::tui::prompt::Purpose;
use shelter::tui::update;
use shelter::worker::Kind;

use super::stage::{draw, draw_places, finished, key, recorded, swept, text};

fn press(app: &mut App, keys: &str) -> Request {
    keys.chars().fold(Request::None, |_, letter| key(app, KeyCode::Char(letter)))
}

/// Clicks on the first place where the screen shows `words`.
fn click(app: &mut App, words: &str) -> Request {
    let screen = text(&draw(app, 120, 36));
    app.places = draw_places(app, 120, 36);
    let (row, line) = screen.lines().enumerate().find(|(_, line)| line.contains(words)).expect(words);
    let column = line[..line.find(words).expect("in the line")].chars().count();
    let at = Position::new(column as u16, row as u16);
    let mouse = MouseEvent {
        kind: MouseEventKind::Down(MouseButton::Left),
        column: at.x,
        row: at.y,
        modifiers: KeyModifiers::NONE,
    };
    update(app, &Event::Mouse(mouse))
}

fn names(app: &App) -> Vec<&str> {
    app.listed().iter().map(|&option| app.case.plan.delays[option].name.as_str()).collect()
}

#[test]
fn options_are_sorted_filtered_and_compared() {
    let mut app = finished();
    for (n, row) in app.rows.iter_mut().enumerate() {
        let Row::Done(checked) = row else { panic!("done") };
        checked.height.value = [3.0, 1.0, 2.0, 5.0, 4.0, 7.0, 6.0][n];
    }
    app.rows[1] = Row::Waiting;
    press(&mut app, "ooo");
    assert_eq!(app.compare.sort, SortBy::Height);
    assert_eq!(app.listed(), [2, 0, 4, 3, 6, 5, 1], "those without a result are last");
    press(&mut app, "O");
    assert_eq!(app.listed(), [5, 6, 3, 4, 0, 2, 1]);
    press(&mut app, "G");
    assert_eq!(app.selected, 1, "keys follow the list");
    press(&mut app, "/pass");
    assert_eq!(app.listed(), [4], "verdicts are found");
    assert_eq!(app.selected, 4);
    key(&mut app, KeyCode::Enter);
    assert!(app.prompt.is_none());
    key(&mut app, KeyCode::Esc);
    assert_eq!(app.listed().len(), 7, "Esc shows all again");
    press(&mut app, "/MIDDLE");
    assert_eq!(names(&app), ["25 ms, middle first"]);
    key(&mut app, KeyCode::Esc);
    press(&mut app, "/nothing");
    assert!(text(&draw(&app, 120, 36)).contains("no option has 'nothing'"));
    key(&mut app, KeyCode::Esc);
    app.selected = 0;
    press(&mut app, "b");
    let screen = text(&draw(&app, 120, 36));
    assert!(screen.contains("=all at once") && screen.contains("-1.000 ± 0.003"), "{screen}");
    press(&mut app, "b");
    assert!(app.baseline().is_none());
}

#[test]
fn commands_are_chosen_by_name() {
    let mut app = finished();
    press(&mut app, ":finer");
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Run);
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
    click(&mut app, "20 ms");
    assert!(app.zoom, "a second click opens");
    key(&mut app, KeyCode::Esc);
    click(&mut app, "force, kN");
    assert_eq!(app.compare.sort, SortBy::Force);
    click(&mut app, "4 Studies");
    assert_eq!(app.screen, Screen::Studies);
    click(&mut app, "Orders");
    assert_eq!(app.studies.shown, Kind::Orders);
    click(&mut app, "1 Plan");
    click(&mut app, "friction");
    click(&mut app, "friction");
    assert!(app.editor.input.is_some());
    key(&mut app, KeyCode::Esc);
    click(&mut app, "? help");
    assert!(app.help);
    click(&mut app, "Everywhere");
    assert!(!app.help, "a click closes the help");
    let wheel =
        MouseEvent { kind: MouseEventKind::ScrollDown, column: 0, row: 9, modifiers: KeyModifiers::NONE };
    let before = app.editor.selected;
    update(&mut app, &Event::Mouse(wheel));
    assert_eq!(app.editor.selected, before + 1);
    assert_eq!(click(&mut app, "q quit"), Request::Quit);
}

#[test]
fn a_flight_is_asked_for_once_and_played() {
    let mut app = finished();
    press(&mut app, "3");
    assert_eq!(app.wanted(), Request::Start(Kind::Flight));
    assert_eq!(app.wanted(), Request::None);
    assert!(text(&draw(&app, 100, 30)).contains("recording"));
    let flight = recorded(&app, 0);
    app.learn(Kind::Flight, Ok(flight));
    press(&mut app, " ");
    assert!(app.moving());
    app.pass(std::time::Duration::from_secs(1));
    assert_eq!(app.player.time, 0.1, "a tenth of real time");
    press(&mut app, " h");
    assert!((app.player.time - 0.09).abs() < 1e-12);
    app.places = draw_places(&app, 120, 36);
    key(&mut app, KeyCode::End);
    click(&mut app, "━");
    assert_eq!(app.player.time, 0.0, "the left end of the bar");
    press(&mut app, "j");
    assert_eq!((app.selected, app.wanted()), (1, Request::Start(Kind::Flight)));
}

#[test]
fn what_is_shown_is_offered_for_export() {
    let mut app = finished();
    press(&mut app, "e");
    let prompt = app.prompt.as_ref().expect("a file is asked for");
    assert_eq!((prompt.purpose, prompt.input.value()), (Purpose::Export, "amur-three-rows-compare.csv"));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Export("amur-three-rows-compare.csv".into()));
}

#[test]
fn keys_of_a_configuration_count() {
    let config =
        Config::parse("theme = \"light\"\n[keys]\nquit = [\"ctrl-q\"]\nsort = [\"S\"]").expect("right");
    let mut app = App::new(finished().case, finished().compute, &config);
    assert_eq!(press(&mut app, "q"), Request::None);
    press(&mut app, "S");
    assert_eq!(app.compare.sort, SortBy::Name);
    assert!(text(&draw(&app, 100, 30)).contains("Ctrl-q quit"));
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
    assert_eq!(app.selected, app.rows.len() - 1);
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
    assert_eq!(key(&mut app, KeyCode::Char('+')), Request::Run);
    assert!(app.rows.iter().all(|row| matches!(row, Row::Waiting)));
}

#[test]
fn a_study_is_cancelled_by_x_or_escape_and_escape_then_goes_back() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    key(&mut app, KeyCode::Right);
    assert_eq!(app.studies.shown, Kind::Orders);
    assert_eq!(key(&mut app, KeyCode::Char('x')), Request::None, "nothing to cancel");
    for code in [KeyCode::Char('x'), KeyCode::Esc] {
        assert_eq!(key(&mut app, KeyCode::Enter), Request::Start(Kind::Orders));
        assert_eq!(key(&mut app, code), Request::Cancel(Kind::Orders));
    }
    assert_eq!(key(&mut app, KeyCode::Esc), Request::None);
    assert_eq!(app.screen, Screen::Compare);
}

/// The end of a list is as far as one gets: one key back leaves it.
#[test]
fn lists_are_scrolled_no_further_than_their_end() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('?'));
    (0..200).for_each(|_| drop(key(&mut app, KeyCode::Down)));
    let end = text(&draw(&app, 80, 24));
    app.drawn(draw_places(&app, 80, 24));
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
        app.learn(Kind::Sweep, Ok(swept()));
        let flight = recorded(&app, 0);
        app.learn(Kind::Flight, Ok(flight));
        app.learn(Kind::Scatter, Err(NoResult::NoScatter));
        for (n, letter) in keys {
            let codes = [
                KeyCode::Up, KeyCode::Down, KeyCode::Left, KeyCode::Right, KeyCode::Enter, KeyCode::Esc,
                KeyCode::PageUp, KeyCode::PageDown, KeyCode::Home, KeyCode::End, KeyCode::Tab,
            ];
            key(&mut app, codes.get(n).copied().unwrap_or(KeyCode::Char(letter)));
            app.places = draw_places(&app, width, height);
            app.click(Position::new(width / 3, height / 2));
            app.wanted();
        }
    }
}
