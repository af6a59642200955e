//! The list of differences between two plans, over the screen: a line for each key, with both values.
//!
//! ```text
//! ┌ What the plans say differently: 2 ───────────────┐
//! │                          A rows.toml  B new.toml │
//! │ limits flight_height_m   2.35         2.1        │
//! │ 42 ms A PASS, B FAIL                             │
//! └──────────────────────────────────────────────────┘
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Flex, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Padding, Paragraph};
use unicode_width::UnicodeWidthStr;

use super::compare::cut;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;

/// Greatest width of the list.
const WIDEST: u16 = 120;

/// Draws the list. A click closes it.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let rows = app.differences.iter().map(|difference| {
        let [first, second] = difference.values.each_ref().map(String::as_str);
        let shown = |value: &str| if value.is_empty() { "—".to_owned() } else { value.to_owned() };
        [difference.key.clone(), shown(first), shown(second)]
    });
    let mut head = app.plans().iter().map(|app| app.file_of_letter()).collect::<Vec<_>>();
    head.insert(0, String::new());
    let rows: Vec<[String; 3]> = <[String; 3]>::try_from(head).into_iter().chain(rows).collect();
    let inside = usize::from(area.width.min(WIDEST).saturating_sub(4));
    let longest = |column: usize| rows.iter().map(|row| row[column].width()).max().unwrap_or(0);
    let key = longest(0).min(inside * 2 / 5);
    let value = inside.saturating_sub(key + 4) / 2;
    let widths = [key, longest(1).min(value), longest(2).min(value)];
    let line = |(n, row): (usize, &[String; 3])| {
        let cell = |column: usize| {
            let text = cut(&row[column], widths[column]);
            let blank = widths[column].saturating_sub(text.width()) + 2;
            let style = if n == 0 || column == 0 { app.theme.muted() } else { app.theme.base() };
            Span::styled(format!("{text}{:blank$}", ""), style)
        };
        Line::from_iter((0..row.len()).map(cell))
    };
    let mut lines: Vec<Line<'_>> = rows.iter().enumerate().map(line).collect();
    if app.differences.is_empty() {
        lines.push(Line::raw("The plans say the same."));
    }
    let verdicts = app.verdicts_that_differ().into_iter();
    lines.extend(verdicts.map(|verdict| Line::styled(cut(&verdict, inside), app.theme.limit())));
    let height = lines.len() as u16 + 2;
    let [column] = Layout::horizontal([Constraint::Max(WIDEST)]).flex(Flex::Center).areas(area);
    let [list] = Layout::vertical([Constraint::Max(height)]).flex(Flex::Center).areas(column);
    let [up, down] = [Action::Up, Action::Down].map(|action| app.keymap.hint(action));
    let more = if height > area.height { format!(", {up} {down} for more") } else { String::new() };
    let title = format!(" What the plans say differently: {}{more} ", app.differences.len());
    let block = Block::bordered().title(title).padding(Padding::horizontal(1)).style(app.theme.base());
    let text = block.inner(list);
    frame.render_widget(Clear, list);
    frame.render_widget(block, list);
    let over = height.saturating_sub(area.height);
    *areas = vec![(area, ClickTarget::Act(Action::Differences)), (Rect::ZERO, ClickTarget::Lines(over))];
    frame.render_widget(Paragraph::new(lines).scroll((app.help_scroll.min(over), 0)), text);
}
