//! The screens, drawn without a terminal.

use crossterm::event::KeyCode;
use ratatui::buffer::Buffer;
use ratatui::style::Style;
use shelter::simulation::Failure;
use shelter::study::NoResult;
use shelter::tui::app::{Request, Row, Screen};
use shelter::tui::studies::Progress;
use shelter::tui::theme::{self, Theme};
use shelter::verdict::Verdict;
use shelter::worker::Kind;

use super::stage::{app, checked, draw, finished, key, measured, recorded, spreads, swept, text};

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
    app.rows[2] = Row::Failed(NoResult::Failed(Failure::Diverged { at: 0.3 }));
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
fn orders_samples_and_sizes_have_a_picture() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    for (kind, found) in spreads(&app) {
        app.learn(kind, Ok(found));
        app.studies.show(kind);
        let name = format!("{kind:?}").to_lowercase();
        insta::assert_snapshot!(format!("{name}_120x36"), text(&draw(&app, 120, 36)));
        for (width, height) in [(60, 18), (80, 24), (200, 60)] {
            draw(&app, width, height);
        }
    }
}

/// Every screen in plain characters, and where each theme shows which style.
#[test]
fn every_screen_in_every_theme() {
    for (width, height) in [(80, 24), (120, 36)] {
        for screen in Screen::ALL {
            let mut app = finished();
            app.screen = screen;
            app.selected = 4;
            app.learn(Kind::Sweep, Ok(swept()));
            app.learn(Kind::Accuracy, Ok(measured()));
            let flight = recorded(&app, 4);
            app.learn(Kind::Flight, Ok(flight));
            app.player.ask(4);
            // The second row fires; the first is in the air.
            app.player.time = 0.05;
            let mut plain = draw(&app, width, height);
            theme::to_ascii(&mut plain);
            let ascii = text(&plain);
            assert!(ascii.is_ascii(), "{ascii}");
            let mut shown = format!("{ascii}\n");
            for theme in [Theme::Dark, Theme::Light, Theme::Sunlight] {
                app.theme = theme;
                shown += &format!("\n{theme:?}\n{}\n", styles(&draw(&app, width, height)));
            }
            let name = screen.name().to_lowercase();
            insta::assert_snapshot!(format!("{name}_styles_{width}x{height}"), shown);
        }
    }
}

/// A letter per style, in the order they appear, and what each is.
fn styles(buffer: &Buffer) -> String {
    let mut known: Vec<Style> = Vec::new();
    let mut letter = |style: Style| {
        let at = known.iter().position(|other| *other == style).unwrap_or_else(|| {
            known.push(style);
            known.len() - 1
        });
        char::from(b'a' + at as u8)
    };
    let lines = buffer.content.chunks(usize::from(buffer.area.width));
    let lines: Vec<String> =
        lines.map(|line| line.iter().map(|cell| letter(cell.style())).collect()).collect();
    let mut text = lines.iter().map(|line| runs(line)).collect::<Vec<_>>().join("\n");
    for (n, style) in known.iter().enumerate() {
        let Style { fg, bg, add_modifier, .. } = style;
        text += &format!("\n{}: {fg:?} on {bg:?} {add_modifier:?}", char::from(b'a' + n as u8));
    }
    text
}

/// `aaab` as `3a 1b`.
fn runs(line: &str) -> String {
    let mut runs: Vec<(usize, char)> = Vec::new();
    for letter in line.chars() {
        match runs.last_mut() {
            Some((count, last)) if *last == letter => *count += 1,
            _ => runs.push((1, letter)),
        }
    }
    runs.iter().map(|(count, letter)| format!("{count}{letter}")).collect::<Vec<_>>().join(" ")
}
