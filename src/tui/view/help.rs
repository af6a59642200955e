//! The help: every key there is, and what the words on the screen mean.

use ratatui::Frame;
use ratatui::layout::{Constraint, Flex, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Padding, Paragraph, Wrap};

use crate::tui::app::App;
use crate::tui::keymap::KEYS;

const WORDS: &[(&str, &str)] = &[
    ("✓ PASS", "height and force, with their errors, are within the limits"),
    ("✗ FAIL", "one of them is surely past its limit"),
    ("? OPEN", "too near a limit to tell at the finest step"),
    ("±", "estimated error of the computation, not of the plan's numbers"),
];

/// Draws the help over everything else.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let row = |left: &'static str, right: &'static str| {
        Line::from(vec![Span::styled(format!("{left:13} "), app.theme.title()), Span::raw(right)])
    };
    let mut lines: Vec<Line> = KEYS.iter().map(|binding| row(binding.label, binding.text)).collect();
    lines.extend(WORDS.iter().map(|(word, meaning)| row(word, meaning)));
    let height = lines.len() as u16 + 2;
    let [column] = Layout::horizontal([Constraint::Max(78)]).flex(Flex::Center).areas(area);
    let [place] = Layout::vertical([Constraint::Max(height)]).flex(Flex::Center).areas(column);
    let block = Block::bordered().title(" Help ").padding(Padding::horizontal(1)).style(app.theme.base());
    frame.render_widget(Clear, place);
    frame.render_widget(Paragraph::new(lines).block(block).wrap(Wrap { trim: false }), place);
}
