//! A quantity and its limit as bars: the line of the limit is labelled with it, the axis begins at 0.
//!
//! ```text
//! 2.35 m ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄█┄┄┄┄   █ beyond the limit
//! height     ▂▄▆██▆▄▂  ▂▄▆████
//!      0 ▲───▲─────0.5 s────────1 s  ▲ a hole fires
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::report::parts::Chart;
use crate::tui::app::App;
use crate::units;

/// Least width and height of a chart that can be read.
pub const LEAST_SIZE: (u16, u16) = (24, 3);
/// Least height of a chart with a title of its own.
pub const TITLED: u16 = 6;
/// Width of the labels at the left.
const LABELS: u16 = 8;
/// Parts of a cell, from empty to full.
const EIGHTHS: [&str; 9] = [" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"];

/// Draws a chart, called `name` where it has no room for its title; nothing where the area is too small.
pub fn draw(app: &App, chart: &Chart, name: &str, frame: &mut Frame, area: Rect) {
    let Some(limit) = chart.limit else { return };
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return;
    }
    let theme = app.theme;
    let [title, body, axis] = Layout::vertical([
        Constraint::Length(u16::from(area.height >= TITLED)),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(area);
    frame.render_widget(Line::styled(chart.title.as_str(), theme.muted()).centered(), title);
    let [labels, bars] = Layout::horizontal([Constraint::Length(LABELS), Constraint::Min(0)]).areas(body);
    let shares: Vec<f64> = columns(chart, bars.width.into()).into_iter().map(|value| value / limit).collect();
    let most = shares.iter().copied().fold(1.0, f64::max);
    // Rows above the limit, and below it; its own row stands between.
    let rows = body.height - 1;
    let above = (f64::from(rows) * (1.0 - 1.0 / most)).ceil() as u16;
    let above = above.min(rows / 2);
    let below = rows - above;
    let unit = chart.y.unit;
    let label = format!("{} {}", units::significant(limit, unit, 3), unit.symbol());
    for row in 0..body.height {
        let y = body.y + row;
        let (from, style) = if row < above {
            (1.0 + f64::from(above - 1 - row) / f64::from(below), theme.limit())
        } else {
            (f64::from(body.height - 1 - row) / f64::from(below), theme.curve())
        };
        let line = match row == above {
            true => limit_line(&shares, theme.limit()),
            false => bar_line(&shares, from, below, style),
        };
        frame.render_widget(line, Rect { y, height: 1, ..bars });
        let label = match row {
            _ if row == above => Line::styled(label.as_str(), theme.limit()),
            _ if row == above + 1 => Line::styled(name, theme.muted()),
            _ => continue,
        };
        frame.render_widget(label, Rect { y, height: 1, ..labels });
    }
    draw_axis(app, chart, frame, Rect { x: bars.x, width: bars.width, ..axis });
    frame.render_widget(Line::styled("0 ", theme.muted()).right_aligned(), Rect { width: LABELS, ..axis });
}

/// The greatest value of the chart in each of `width` columns; a column without a point has that of the column before.
fn columns(chart: &Chart, width: usize) -> Vec<f64> {
    let [from, to] = chart.x.range;
    let mut columns = vec![None; width];
    for &(x, value) in chart.series.iter().flat_map(|series| &series.points) {
        let column = ((x - from) / (to - from) * width as f64) as usize;
        if let Some(greatest) = columns.get_mut(column) {
            *greatest = Some(f64::max(value, greatest.unwrap_or(value)));
        }
    }
    let last_known = |last: &mut f64, value: Option<f64>| {
        *last = value.unwrap_or(*last);
        Some(*last)
    };
    columns.into_iter().scan(0.0, last_known).collect()
}

/// The row of the limit: dashes, and a full cell where a bar goes beyond.
fn limit_line(shares: &[f64], style: Style) -> Line<'static> {
    Line::styled(shares.iter().map(|share| if *share > 1.0 { '█' } else { '┄' }).collect::<String>(), style)
}

/// A row of bars; its lower edge stands at the share `from` of the limit, and `rows` rows make up the limit.
fn bar_line(shares: &[f64], from: f64, rows: u16, style: Style) -> Line<'static> {
    let full = (EIGHTHS.len() - 1) as f64;
    let cell = |share: &f64| {
        let eighths = ((share - from) * f64::from(rows) * full).clamp(0.0, full);
        // What is not 0 is seen.
        let eighths = if from == 0.0 && *share > 0.0 { eighths.max(1.0) } else { eighths };
        EIGHTHS[eighths as usize]
    };
    Line::styled(shares.iter().map(cell).collect::<String>(), style)
}

/// The horizontal axis with its middle and its end, and the firings.
fn draw_axis(app: &App, chart: &Chart, frame: &mut Frame, area: Rect) {
    let width = usize::from(area.width);
    let mut cells: Vec<Span<'_>> = vec![Span::styled("─", app.theme.muted()); width];
    let [from, to] = chart.x.range;
    for &firing in &chart.firings {
        let cell = ((firing - from) / (to - from) * width as f64) as usize;
        if let Some(cell) = cells.get_mut(cell) {
            *cell = Span::styled("▲", app.theme.firing());
        }
    }
    frame.render_widget(Line::from(cells), area);
    let label = |at: f64| format!("{} {}", units::short(at / chart.x.unit.size()), chart.x.unit.symbol());
    let (middle, end) = (label(0.5 * (from + to)), label(to));
    let start = (width / 2).saturating_sub(middle.len() / 2) as u16;
    let places = [(start, middle), ((width.saturating_sub(end.len())) as u16, end)];
    for (x, text) in places {
        let place = Rect { x: area.x + x, width: text.len() as u16, ..area }.intersection(area);
        frame.render_widget(Line::styled(text, app.theme.muted()), place);
    }
}
