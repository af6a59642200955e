//! Whatever is typed, clicked and resized, something is drawn.
#![no_main]

use std::sync::{Arc, OnceLock};
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use libfuzzer_sys::fuzz_target;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use shelter::plan::PlanSource;
use shelter::study::{Case, ComputeSettings};
use shelter::tui::app::App;
use shelter::tui::config::Config;
use shelter::tui::{dispatch, view};

fn case() -> Arc<Case> {
    static CASE: OnceLock<Arc<Case>> = OnceLock::new();
    let read = || {
        let text = include_str!("../../plans/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text });
        Arc::new(case.unwrap_or_else(|mistakes| panic!("{mistakes}")))
    };
    Arc::clone(CASE.get_or_init(read))
}

const CODES: [KeyCode; 14] = [
    KeyCode::Up,
    KeyCode::Down,
    KeyCode::Left,
    KeyCode::Right,
    KeyCode::Enter,
    KeyCode::Esc,
    KeyCode::PageUp,
    KeyCode::PageDown,
    KeyCode::Home,
    KeyCode::End,
    KeyCode::Tab,
    KeyCode::BackTab,
    KeyCode::Backspace,
    KeyCode::F(1),
];

/// Two bytes as an event: letters as they are, then special keys, control keys, clicks and the wheel.
fn event(first: u8, second: u8) -> Event {
    let key = |code, modifiers| Event::Key(KeyEvent::new(code, modifiers));
    let mouse = |kind| {
        let (column, row) = (u16::from(second), u16::from(second) / 3);
        Event::Mouse(MouseEvent { kind, column, row, modifiers: KeyModifiers::NONE })
    };
    match first {
        0x20..=0x7e => key(KeyCode::Char(char::from(first)), KeyModifiers::NONE),
        0..=0x1f => key(CODES[usize::from(first) % CODES.len()], KeyModifiers::NONE),
        0x7f..=0x8f => key(KeyCode::Char(char::from(b'a' + first % 26)), KeyModifiers::CONTROL),
        0x90..=0xcf => mouse(MouseEventKind::Down(MouseButton::Left)),
        0xd0..=0xe7 => mouse(MouseEventKind::ScrollDown),
        _ => mouse(MouseEventKind::ScrollUp),
    }
}

fuzz_target!(|bytes: &[u8]| {
    let case = case();
    let compute = ComputeSettings::of(&case.plan);
    let mut app = App::new(case, compute, &Config::default());
    for (n, pair) in bytes.chunks_exact(2).take(60).enumerate() {
        dispatch(&mut app, &event(pair[0], pair[1]));
        app.request_flight();
        app.advance(Duration::from_millis(16));
        if n % 6 == 5 {
            let (width, height) = (u16::from(pair[1]).max(1), u16::from(pair[1] / 4).max(1));
            let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap_or_else(|never| match never {});
            let mut areas = Vec::new();
            let drawn = terminal.draw(|frame| areas = view::draw(&app, frame));
            assert!(drawn.is_ok());
            app.areas = areas;
        }
    }
});
