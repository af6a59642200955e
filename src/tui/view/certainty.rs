//! How sure the shots make of the risk of an option: between which bounds it surely lay after each shot. The band narrows while shots come,
//! until it lies on one side of the accepted risk.
//!
//! ```text
//!  risk as shots came, surely in ░ ┄ accepted ─
//! 100%▆▅▃▂▁
//!     ░░░░░▇▆▅▄▃▃▂▁
//!  1% ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄
//! none░░░░░░░░░░░░░░░░░░░░░░░░░░░░
//!    0────────────250──────────500
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::compare::{curve, verdict_words};
use super::gauges::{EIGHTHS, LEAST_RISK};
use super::histogram::LEAST_SIZE;
use crate::tui::app::App;
use crate::units;

/// Width of the labels at the left.
const LABELS: u16 = 5;
/// The axis reaches at least so many shots, and twice as many each time that they are past its end.
const LEAST_SHOTS: usize = 500;

/// Draws the bounds of an option; nothing where the area is too small, or no shot was tried.
pub fn draw(app: &App, option: usize, frame: &mut Frame, area: Rect) {
    let sampled = app.judgement(option).and_then(|judged| judged.sampled.known());
    let Some(sampled) = sampled.filter(|_| area.width >= LEAST_SIZE.0 && area.height >= LEAST_SIZE.1) else {
        return;
    };
    let (theme, accepted) = (app.theme, app.case.limits.accepted_risk);
    let [title, body, axis] =
        Layout::vertical([Constraint::Length(1), Constraint::Min(0), Constraint::Length(1)]).areas(area);
    let [labels, band] = Layout::horizontal([Constraint::Length(LABELS), Constraint::Min(0)]).areas(body);
    let rule = Block::new().borders(Borders::TOP).border_style(theme.muted());
    let of_band =
        if app.options[option].is_sampling() { curve(app, option) } else { verdict_words(app, option).1 };
    frame.render_widget(rule.title(titled(app, of_band, title.width.into())), title);
    let tried = sampled.samples.len();
    let mut end = LEAST_SHOTS;
    while end < tried {
        end *= 2;
    }
    let width = usize::from(band.width);
    // The last shot of each column that has one; each column stands for several.
    let begun = (tried * width).div_ceil(end);
    let counts: Vec<usize> = (1..=begun).map(|n| (n * end).div_ceil(width).min(tried)).collect();
    let bounds = sampled.bounds_after(&counts);
    let columns: Vec<Option<[f64; 2]>> = (0..width).map(|n| bounds.get(n).copied()).collect();
    let rows = f64::from(body.height);
    // Rows above the lower edge of the scale.
    let height = |risk: f64| rows * (1.0 - risk.max(LEAST_RISK).log10() / LEAST_RISK.log10());
    let row_of_accepted = (body.height - 1).saturating_sub(height(accepted) as u16);
    for row in 0..body.height {
        let from = f64::from(body.height - 1 - row);
        let cell = |interval: &Option<[f64; 2]>| {
            let full = EIGHTHS.len() - 1;
            let eighths = |risk: f64| ((height(risk) - from).clamp(0.0, 1.0) * full as f64).round() as usize;
            let [low, high] = interval.map_or([0; 2], |bounds| bounds.map(eighths));
            match () {
                () if row == row_of_accepted => Span::styled("┄", theme.limit()),
                () if 2 * low > full => Span::raw(" "),
                () if high == full => Span::styled("░", of_band),
                () => Span::styled(EIGHTHS[high], of_band),
            }
        };
        let y = body.y + row;
        frame.render_widget(Line::from_iter(columns.iter().map(cell)), Rect { y, height: 1, ..band });
        let label = match row {
            _ if row == row_of_accepted => {
                Span::styled(format!("{:>4}", format!("{}%", units::short(1e2 * accepted))), theme.limit())
            }
            0 => Span::styled("100%", theme.muted()),
            _ if row + 1 == body.height => Span::styled("none", theme.muted()),
            _ => continue,
        };
        frame.render_widget(label, Rect { y, height: 1, ..labels });
    }
    draw_axis(app, [tried, end], frame, Rect { x: band.x, width: band.width, ..axis });
}

/// The title, in as many words as have room.
fn titled<'l>(app: &App, band: Style, width: usize) -> Line<'l> {
    let texts = [
        ("risk as shots came, surely in ", " ┄ accepted "),
        ("risk, surely in ", " ┄ accepted "),
        ("risk, surely in ", " "),
    ];
    let fits = |(before, after): &(&str, &str)| 2 + before.width() + after.width() <= width;
    let (before, after) = texts.into_iter().find(fits).unwrap_or_default();
    Line::from(vec![
        Span::styled(format!(" {before}"), app.theme.muted()),
        Span::styled("░", band),
        Span::styled(after, app.theme.muted()),
    ])
}

/// The axis of shots: how many were tried, where they end.
fn draw_axis(app: &App, [tried, end]: [usize; 2], frame: &mut Frame, area: Rect) {
    let width = usize::from(area.width);
    let mut cells = vec![Span::styled("─", app.theme.muted()); width];
    let mut put = |at: usize, text: &str, style: Style| {
        let start = (at * width / end).saturating_sub(text.len() / 2).min(width.saturating_sub(text.len()));
        for (cell, letter) in cells.iter_mut().skip(start).zip(text.chars()) {
            *cell = Span::styled(letter.to_string(), style);
        }
    };
    put(0, "0", app.theme.muted());
    let last = format!(" {end} shots");
    put(end, &last, app.theme.muted());
    let count = tried.to_string();
    // Numbers that touch would be another number.
    if tried * width / end + count.len() + last.len() < width {
        put(tried, &count, app.theme.title());
    }
    frame.render_widget(Line::from(cells), area);
}
