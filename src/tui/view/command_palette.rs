//! The command palette: the commands that match the typed letters, above the line being typed.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, List, ListState};

use crate::tui::app::App;
use crate::tui::prompt::Prompt;

/// Most commands shown at once.
const MOST_LINES: u16 = 10;

/// Draws the list above `line`.
pub fn draw(app: &App, prompt: &Prompt, frame: &mut Frame, line: Rect) {
    let commands = prompt.commands();
    let height = (commands.len() as u16).clamp(1, MOST_LINES) + 2;
    let area = Rect { y: line.y.saturating_sub(height), height, width: line.width.min(100), ..line };
    let rows = commands.iter().enumerate().map(|(n, binding)| {
        let style = if n == prompt.selected { app.theme.selected() } else { app.theme.base() };
        Line::from(vec![
            Span::styled(format!(" {:16}", binding.name), style),
            Span::styled(format!(" {:9} ", app.keymap.first_key(binding.action)), app.theme.title()),
            Span::styled(binding.text, app.theme.muted()),
        ])
    });
    let block = Block::bordered().style(app.theme.base()).title(" Commands ");
    frame.render_widget(Clear, area);
    if commands.is_empty() {
        let none = Line::styled(" no command has these letters", app.theme.muted());
        let inside = block.inner(area);
        frame.render_widget(block, area);
        return frame.render_widget(none, inside);
    }
    let mut state = ListState::default().with_selected(Some(prompt.selected));
    frame.render_stateful_widget(List::new(rows).block(block), area, &mut state);
}
