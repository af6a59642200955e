//! The screens, drawn without a terminal.

use std::collections::BTreeSet;

use crossterm::event::KeyCode;
use ratatui::buffer::Buffer;
use ratatui::style::{Color, Style};
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

/// Every line as runs of named styles, then the colours that each name stands for.
fn styles(buffer: &Buffer) -> String {
    let mut legend = BTreeSet::new();
    let mut text = String::new();
    for line in buffer.content.chunks(usize::from(buffer.area.width)) {
        let named: Vec<String> = line.iter().map(|cell| style_name(cell.style())).collect();
        let runs = named.chunk_by(|a, b| a == b).map(|run| format!("{} {}", run.len(), run[0]));
        text += &(runs.collect::<Vec<_>>().join(", ") + "\n");
        legend.extend(line.iter().map(|cell| {
            let Style { fg, bg, add_modifier, .. } = cell.style();
            format!("\n{}: {fg:?} on {bg:?} {add_modifier:?}", style_name(cell.style()))
        }));
    }
    text.extend(legend);
    text
}

/// `bold orange`, `reversed`, `blue on blue`; `plain` for text as it is.
fn style_name(style: Style) -> String {
    let color = |color: Option<Color>| match color {
        Some(Color::Reset | Color::Rgb(0, 0, 0) | Color::Rgb(30, 30, 30)) => None,
        Some(Color::Rgb(255, 255, 255) | Color::Rgb(250, 250, 246)) => None,
        Some(Color::Gray | Color::Rgb(80, 80, 80)) => Some("gray".to_owned()),
        Some(Color::Rgb(86, 180, 233) | Color::Rgb(0, 70, 150)) => Some("blue".to_owned()),
        Some(Color::Rgb(240, 228, 66) | Color::Rgb(110, 80, 0)) => Some("yellow".to_owned()),
        Some(Color::Rgb(255, 140, 60) | Color::Rgb(170, 50, 0)) => Some("orange".to_owned()),
        other => Some(format!("{other:?}")),
    };
    let modifiers = style.add_modifier.iter_names().map(|(name, _)| name.to_lowercase());
    let words: Vec<String> =
        modifiers.chain(color(style.fg)).chain(color(style.bg).map(|name| format!("on {name}"))).collect();
    if words.is_empty() { "plain".to_owned() } else { words.join(" ") }
}
