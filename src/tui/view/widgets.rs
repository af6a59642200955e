//! Parts that several screens share.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use crate::jobs::StudyAt;
use crate::report::words::progress_words::describe;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;

/// Draws labels side by side; each takes clicks. Labels that do not fit are left out.
pub fn draw_row<'l>(
    labels: impl IntoIterator<Item = (Line<'l>, ClickTarget)>,
    frame: &mut Frame,
    area: Rect,
    areas: &mut Areas,
) {
    let mut x = area.x;
    for (label, target) in labels {
        let width = label.width() as u16;
        if x + width > area.right() {
            return;
        }
        let label_area = Rect { x, width, ..area };
        frame.render_widget(label, label_area);
        areas.push((label_area, target));
        x += width;
    }
}

/// Gives the selected row another background. Reversed cells stay as they are.
pub fn highlight(app: &App, row: Rect, frame: &mut Frame) {
    let buffer = frame.buffer_mut();
    for place in row.intersection(buffer.area).positions() {
        let cell = &mut buffer[place];
        if !cell.modifier.contains(Modifier::REVERSED) {
            cell.set_bg(app.theme.row());
        }
    }
}

/// Cells of a progress bar.
const BAR: usize = 24;

/// A bar of `cells` cells, filled up to the share `done`.
pub fn bar(done: f64, cells: usize) -> String {
    let full = ((done * cells as f64) as usize).min(cells);
    "█".repeat(full) + &"░".repeat(cells - full)
}

/// Draws the question of a study and its progress.
pub fn draw_progress(app: &App, frame: &mut Frame, area: Rect, question: Line<'_>, at: &StudyAt) {
    let told = format!("{} · {} cancels", describe(&at.progress, at.left), app.keymap.hint(Action::Cancel));
    let bar = Span::styled(format!("{} ", bar(at.progress.fraction, BAR)), app.theme.curve());
    let lines = vec![question, Line::default(), Line::from(vec![bar, Span::styled(told, app.theme.base())])];
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}

/// Draws the question of a study, and a message in place of its answer.
pub fn draw_message(app: &App, frame: &mut Frame, area: Rect, question: Line<'_>, message: &str) {
    let mut lines = vec![question, Line::default()];
    lines.extend(message.lines().map(|line| Line::styled(line, app.theme.base())));
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}

/// Draws a line down the free column to the right of an area. The line joins the rule above.
pub fn draw_divider(app: &App, frame: &mut Frame, left: Rect) {
    let (x, buffer) = (left.right(), frame.buffer_mut());
    for y in left.top()..left.bottom() {
        let is_rule = |x: u16| buffer.cell((x, y)).is_some_and(|cell| cell.symbol() == "─");
        let joins = y == left.top() && (is_rule(left.right().saturating_sub(1)) || is_rule(x + 1));
        let sign = if joins { "┬" } else { "│" };
        if let Some(cell) = buffer.cell_mut((x, y)) {
            cell.set_symbol(sign).set_style(app.theme.muted());
        }
    }
}

/// Removes the colors from a drawn area if the passes of the plan do not stand: the numbers there are refuted.
pub fn dim_if_held(app: &App, frame: &mut Frame, area: Rect) {
    if app.is_held() {
        let buffer = frame.buffer_mut();
        let area = area.intersection(buffer.area);
        buffer.set_style(area, app.theme.faint().remove_modifier(Modifier::BOLD));
    }
}

/// The area without its first column, which stays free beside sentences. The last column of the screen's body is already free.
pub fn after_margin(area: Rect) -> Rect {
    Rect { x: area.x + 1, width: area.width.saturating_sub(1), ..area }
}

/// Number of lines that `lines` take at a width.
pub fn wrapped(lines: &[Line<'_>], width: u16) -> u16 {
    let room = usize::from(width.max(1));
    let count = |line: &Line<'_>| {
        let text: String = line.spans.iter().map(|span| span.content.as_ref()).collect();
        // A word wider than the line is split, too.
        let (mut lines, mut used) = (1, 0);
        for word in text.split(' ').map(UnicodeWidthStr::width) {
            let joined = if used == 0 { word } else { used + 1 + word };
            if joined <= room {
                used = joined;
            } else {
                lines += usize::from(used > 0) + word.saturating_sub(1) / room;
                used = word - word.saturating_sub(1) / room * room;
            }
        }
        lines as u16
    };
    lines.iter().map(count).sum()
}

/// Foreground color of a style. Canvases take a color, not a style.
pub fn color(style: Style) -> Color {
    style.fg.unwrap_or(Color::Reset)
}

/// A block under a rule with a title.
pub fn titled_block<'t>(app: &App, title: String) -> Block<'t> {
    block_under(app, vec![Span::raw(format!(" {title} "))])
}

/// The same, with a title of styled parts.
pub fn block_under<'t>(app: &App, title: Vec<Span<'t>>) -> Block<'t> {
    let title = Line::from(title).style(app.theme.title());
    Block::new().borders(Borders::TOP).border_style(app.theme.muted()).title(title)
}
