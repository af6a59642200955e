//! Passes each terminal event to the part of the app that handles it.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyEventKind, MouseButton, MouseEventKind};
use ratatui::layout::Position;

use crate::tui::app::{App, Request};
use crate::tui::keymap::{Action, ctrl_c_as_esc};

/// Passes a terminal event to the app, then copies the state of the screen to the plan beside.
pub fn dispatch(app: &mut App, event: &Event) -> Request {
    let screen = app.screen;
    let request = pass(app, event);
    if app.screen != screen {
        app.select_recommended();
    }
    app.share_screen();
    request
}

fn pass(app: &mut App, event: &Event) -> Request {
    match event {
        Event::Key(key) if key.kind == KeyEventKind::Release => Request::None,
        Event::Key(key) if app.prompt.is_some() => app.type_in_prompt(&ctrl_c_as_esc(key)),
        Event::Key(key) if app.editor.entry.is_some() => app.type_key(&ctrl_c_as_esc(key)),
        Event::Key(key) if app.asks_for_estimates() => app.answer_estimates(&ctrl_c_as_esc(key)),
        Event::Key(KeyEvent { code: KeyCode::Esc, .. }) => app.escape(),
        Event::Key(key) => app.keymap.action(key).map_or(Request::None, |action| app.act(action)),
        Event::Paste(text) => {
            app.paste(text);
            Request::None
        }
        Event::Mouse(_) if app.prompt.is_some() || app.editor.entry.is_some() || app.asks_for_estimates() => {
            Request::None
        }
        Event::Mouse(mouse) => match mouse.kind {
            MouseEventKind::Down(MouseButton::Left) => app.click(Position::new(mouse.column, mouse.row)),
            MouseEventKind::ScrollUp => app.act(Action::Up),
            MouseEventKind::ScrollDown => app.act(Action::Down),
            _ => Request::None,
        },
        _ => Request::None,
    }
}
