//! The screens, drawn without a terminal.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use shelter::outcome::{End, History};
use shelter::plan::{Method, Plan};
use shelter::study::batch::Envelope;
use shelter::study::check::{Checked, Quantity, Reason};
use shelter::study::sweep::{Point, Sweep};
use shelter::study::{Case, Effort};
use shelter::tui::app::{App, Request, Row, Screen};
use shelter::tui::config::Config;
use shelter::tui::studies::Progress;
use shelter::tui::{theme, update, view};
use shelter::verdict::{Estimate, Verdict};
use shelter::worker::{Found, Kind};

fn app() -> App {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("plans/amur-three-rows.toml");
    let mut plan = Plan::load(&path).expect("a shipped plan");
    plan.path = "plans/amur-three-rows.toml".to_owned();
    let effort = Effort::of(&plan);
    App::new(Arc::new(Case::new(plan)), effort, &Config::default())
}

/// A result with round numbers, so that a snapshot changes with the screen and not with the physics.
fn checked(verdict: Verdict) -> Checked {
    let wave = |n: usize| (n as f64 * 0.05).sin().abs();
    let estimate = |value, error, at, place| Estimate { value, error, at, place };
    let force = estimate(61_234.0, 45.0, 0.123, 3);
    let limit = Reason { quantity: Quantity::Force, verdict, estimate: force, limit: 61_019.0 };
    Checked {
        broken: Vec::new(),
        verdict,
        reasons: if verdict == Verdict::Pass { Vec::new() } else { vec![limit] },
        height: estimate(1.2345, 0.0012, 0.456, 7),
        force,
        drift: estimate(0.321, 0.01, 1.3, 9),
        safety_factor: 1.49,
        history: History {
            width: 0.005,
            height: (0..200).map(wave).collect(),
            force: (0..200).map(|n| 61_234.0 * wave(3 * n)).collect(),
        },
        method: Method::Verlet,
        step: 5e-4,
        steps: 2000,
        energy_residual: 3e-5,
        end: 1.3,
        ended: End::AtRest,
        wall: Duration::from_millis(2),
        total_wall: Duration::from_millis(6),
        runs: 4,
        total_steps: 5000,
    }
}

fn finished() -> App {
    let mut app = app();
    let verdicts = [Verdict::Fail, Verdict::Pass, Verdict::Undecided];
    for (n, row) in app.rows.iter_mut().enumerate() {
        *row = Row::Done(Box::new(checked(verdicts[n % 3])));
    }
    app
}

fn draw(app: &App, width: u16, height: u16) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a test terminal");
    terminal.draw(|frame| drop(view::draw(app, frame))).expect("drawn");
    terminal.backend().buffer().clone()
}

fn text(buffer: &Buffer) -> String {
    let lines = buffer.content.chunks(usize::from(buffer.area.width));
    let line = |cells: &[ratatui::buffer::Cell]| {
        let line: String = cells.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    };
    lines.map(line).collect::<Vec<_>>().join("\n")
}

fn key(app: &mut App, code: KeyCode) -> Request {
    update(app, &Event::Key(KeyEvent::new(code, KeyModifiers::NONE)))
}

#[test]
fn compare_at_three_sizes() {
    for (width, height) in [(80, 24), (120, 36), (200, 60)] {
        insta::assert_snapshot!(format!("compare_{width}x{height}"), text(&draw(&finished(), width, height)));
    }
}

#[test]
fn computing_failed_and_enlarged() {
    let mut app = app();
    app.rows[0] = Row::Done(Box::new(checked(Verdict::Pass)));
    app.rows[1] = Row::Running { runs: 2, done: 0.45 };
    app.rows[2] = Row::Failed("the motion is no longer finite at 0.3 s: choose a smaller --dt".to_owned());
    app.selected = 1;
    insta::assert_snapshot!("computing", text(&draw(&app, 100, 30)));
    app.selected = 2;
    insta::assert_snapshot!("failed", text(&draw(&app, 100, 30)));
    app.selected = 0;
    key(&mut app, KeyCode::Enter);
    insta::assert_snapshot!("enlarged", text(&draw(&app, 100, 30)));
}

#[test]
fn help_and_a_screen_that_is_too_small() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('?'));
    insta::assert_snapshot!("help", text(&draw(&app, 100, 36)));
    insta::assert_snapshot!("too_small", text(&draw(&app, 50, 10)));
}

#[test]
fn ascii_and_colourless_screens_say_the_same() {
    let mut buffer = draw(&finished(), 120, 36);
    theme::to_ascii(&mut buffer);
    theme::without_color(&mut buffer);
    let screen = text(&buffer);
    assert!(screen.is_ascii());
    assert!(buffer.content.iter().all(|cell| cell.fg == ratatui::style::Color::Reset));
    insta::assert_snapshot!("ascii", screen);
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
fn keys_move_and_escape_closes_before_it_quits() {
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
    assert_eq!(key(&mut app, KeyCode::Esc), Request::Quit);
    assert_eq!(key(&mut app, KeyCode::Char('q')), Request::Quit);
    assert_eq!(key(&mut app, KeyCode::Char('+')), Request::Run);
    assert!(app.rows.iter().all(|row| matches!(row, Row::Waiting)));
}

/// A sweep with round numbers.
fn swept() -> Found {
    let point = |n: usize| {
        let share = (n as f64 * 0.3).sin().abs();
        let verdict = if share < 0.8 { Verdict::Pass } else { Verdict::Fail };
        let [height, force] = [[2.0 * share, 0.01], [76_000.0 * share, 250.0]];
        Point { interval: n as f64 * 0.01, envelope: Envelope { verdict, height, force, drift: [0.0; 2] } }
    };
    Found::Sweep(Sweep { order: vec![0, 1, 2], points: (0..51).map(point).collect() })
}

#[test]
fn studies_wait_run_and_show_what_they_found() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    insta::assert_snapshot!("study_idle", text(&draw(&app, 80, 24)));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Start(Kind::Sweep));
    app.studies.set(Kind::Sweep, Progress::Running { done: 34, total: 101 });
    insta::assert_snapshot!("study_running", text(&draw(&app, 80, 24)));
    app.learn(Kind::Sweep, Ok(swept()));
    for (width, height) in [(80, 24), (120, 36)] {
        insta::assert_snapshot!(format!("sweep_{width}x{height}"), text(&draw(&app, width, height)));
    }
    key(&mut app, KeyCode::Char('2'));
    key(&mut app, KeyCode::Char('4'));
    assert!(matches!(app.studies.progress(Kind::Sweep), Progress::Done(_)), "a result is kept");
}

#[test]
fn the_plan_is_shown_with_its_values() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    for (width, height) in [(80, 24), (120, 36)] {
        insta::assert_snapshot!(format!("plan_{width}x{height}"), text(&draw(&app, width, height)));
    }
    key(&mut app, KeyCode::Enter);
    key(&mut app, KeyCode::Char('x'));
    insta::assert_snapshot!("plan_typing", text(&draw(&app, 100, 30)));
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
    assert_eq!(key(&mut app, KeyCode::Esc), Request::Quit);
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig { cases: 64, ..Default::default() })]

    /// Whatever is typed on whatever screen, something is drawn.
    #[test]
    fn no_keys_and_no_size_do_harm(
        keys in proptest::collection::vec((0..12_usize, proptest::char::range(' ', '~')), 0..60),
        (width, height) in (1..160_u16, 1..60_u16),
    ) {
        let mut app = finished();
        app.learn(Kind::Sweep, Ok(swept()));
        app.learn(Kind::Scatter, Err("the plan has no section [scatter]".to_owned()));
        for (n, letter) in keys {
            let codes = [
                KeyCode::Up, KeyCode::Down, KeyCode::Left, KeyCode::Right, KeyCode::Enter, KeyCode::Esc,
                KeyCode::PageUp, KeyCode::PageDown, KeyCode::Home, KeyCode::End, KeyCode::Tab,
            ];
            key(&mut app, codes.get(n).copied().unwrap_or(KeyCode::Char(letter)));
            draw(&app, width, height);
        }
    }
}
