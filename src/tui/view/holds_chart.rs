//! The assumptions that the pass of an option stands on. Each has a bar: how far its value may grow before the pass ends.
//!
//! ```text
//! ─ the pass ends at so many times what is assumed ─
//!                       1      2        5     10
//! launch between shots  ━━━━━━━┃ 6 %      it holds until this value
//! tire masses           ━━━━━━━━━━━━━━━━━━━━━▶ 50 %   and at every value tried
//! friction, lowest      not tried further
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::compare::cut;
use crate::report::words::assumption_words::{name, value};
use crate::study::assumptions::Assumptions;
use crate::tui::app::App;

/// Least width and height of the chart. Names take at most 1 / `NAMES` of the width.
const LEAST_SIZE: (u16, u16) = (30, 4);
const NAMES: usize = 2;
/// Width of the value until which the pass holds.
const VALUE: usize = 9;
/// Text instead of a bar whose end is not known.
const NOT_TRIED: &str = "not tried further";
/// Greatest factor that is tried.
const MOST: f64 = 10.0;

/// Draws as many bars as fit, nearest end first.
pub fn draw(app: &App, found: &Assumptions, frame: &mut Frame, area: Rect) {
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return;
    }
    let theme = app.theme;
    let Some(option) = app.case.plan.delays.get(found.option).map(|delay| &delay.name) else { return };
    let titles = [
        format!(" {option}: the pass ends at so many times what is assumed, or so many times less "),
        " the pass ends at so many times what is assumed, or less ".to_owned(),
        " ends at times assumed, or less ".to_owned(),
    ];
    let title = titles.into_iter().find(|title| title.width() <= area.width.into()).unwrap_or_default();
    let rule = Block::new().borders(Borders::TOP).border_style(theme.muted());
    frame.render_widget(rule.title(Line::styled(title, theme.muted())), area);
    let names: Vec<String> = found.all.iter().map(|one| name(one.assumed)).collect();
    let widest = names.iter().map(|name| name.width()).max().unwrap_or(0);
    let widest = widest.min(usize::from(area.width) / NAMES);
    let width = usize::from(area.width).saturating_sub(widest + 3 + VALUE);
    let place = |factor: f64| ((factor.clamp(1.0, MOST).log10() * width as f64) as usize).min(width - 1);
    let scale = [1.0, 2.0, 5.0, MOST].into_iter().fold(String::new(), |scale, factor| {
        format!("{scale:0$}{factor}", place(factor).saturating_sub(usize::from(factor == MOST)))
    });
    let scale = Line::styled(format!(" {:widest$} {scale}", ""), theme.muted());
    frame.render_widget(scale, Rect { y: area.y + 1, height: 1, ..area });
    let rows = area.y + 2..area.bottom();
    for (y, (one, name)) in rows.zip(found.all.iter().zip(&names)) {
        let (cells, end) = match one.ratio.filter(|_| one.fails_from.is_some()) {
            Some(factor) => (place(factor), Span::styled("┃", theme.limit())),
            // No value was tried beyond this, so the end is unknown.
            None if !one.is_complete => (0, Span::styled(NOT_TRIED, theme.muted())),
            None => (width - 1, Span::styled("▶", theme.muted())),
        };
        let is_known = one.fails_from.is_some() || one.is_complete;
        let until = one.passes_until.filter(|_| is_known).map(|until| value(one.assumed, until));
        let until = until.filter(|until| until.width() < VALUE).map(|until| format!(" {until}"));
        let until = until.unwrap_or_default();
        let line = Line::from(vec![
            Span::styled(format!(" {:widest$} ", cut(name, widest)), theme.base()),
            Span::styled("━".repeat(cells), theme.curve()),
            end,
            Span::styled(until, theme.muted()),
        ]);
        frame.render_widget(line, Rect { y, height: 1, ..area });
    }
}
