//! A quantity and its limit over time. At every size the deciding shot is filled and the planned shot is a line. A chart with few rows
//! shows no planned shot behind the deciding shot. The label at the line of the limit is the limit's value. The vertical axis begins at 0.
//!
//! ```text
//! ─ height in time ⠒ planned ░ 19 of 20 shots ─   which shot is filled stands above the charts already
//! 2.35 m ⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀█⣀⣀⣀⣀   what stands in this row or above goes beyond the limit
//! height     ▂▅█▅▂    ▂▅█▅▂     █ the shot that decides, the line is the upper edge of the planned one
//!          ▂⠤⠒⠒⠒⠤▂  ▂⠤⠒⠒⠤▂     ░ as far as 19 of 20 shots reach at that time, above both
//!      0 ▲───▲─────0.5 s────────1 s  ▲ a hole fires
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};

use super::compare::curve;
use super::gauges::{EIGHTHS, LINE};
use crate::report::charts::{DrawnShot, OF_SHOT_WORST_BY};
use crate::report::parts::{Chart, SeriesKind};
use crate::tui::app::App;
use crate::tui::theme::Theme;
use crate::units;

/// Least width and height of a chart that can be read.
pub const LEAST_SIZE: (u16, u16) = (25, 3);
/// Least height of a chart with a title of its own.
pub const TITLED: u16 = 6;
/// Least height of the bars that leaves room for the line of the planned shot and for rows above the limit.
const TWO_SHOTS: u16 = 5;
/// Width of the labels on the left.
const LABELS: u16 = 9;
/// The line of the limit, at the lower edge of its cell. The rows below end there.
const LIMIT: &str = "⣀";
/// Signs for a line that rises or falls through a cell: at its left and its right side.
const SIDES: [&str; 2] = ["⡇", "⢸"];

/// Place and scale of a drawn chart.
pub struct Drawn {
    /// The area of the bars and of the axis below them.
    pub area: Rect,
    /// Value of the horizontal axis at the right end of the area. The left end is 0.
    pub end: f64,
}

/// Draws a chart of the quantity `name` of a shot, with a mark at `cursor` on the horizontal axis. `None` if the area is too small.
pub fn draw(
    app: &App,
    chart: &Chart,
    (name, drawn): (&str, DrawnShot),
    cursor: Option<f64>,
    frame: &mut Frame,
    area: Rect,
) -> Option<Drawn> {
    let limit = chart.limit?;
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return None;
    }
    let theme = app.theme;
    let [title, body, axis] = Layout::vertical([
        Constraint::Length(u16::from(area.height >= TITLED)),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(area);
    // One cell separates the chart from the divider behind it.
    let behind = u16::from(area.right() + 1 < frame.area().right());
    let [body, axis] = [body, axis].map(|part| Rect { width: part.width - behind, ..part });
    let [left, bars] = Layout::horizontal([Constraint::Length(LABELS), Constraint::Min(0)]).areas(body);
    let has_rows = bars.height >= TWO_SHOTS;
    let shares = shares(chart, limit, bars.width.into(), drawn, has_rows);
    let rule = Block::new().borders(Borders::TOP).border_style(theme.muted());
    frame.render_widget(rule.title(titled(app, chart, (name, drawn), has_rows, title.width)), title);
    let most = shares.iter().flat_map(|shares| [shares.filled, shares.line]).fold(1.0, f64::max);
    // Rows above and below the limit. The row of the limit lies between them.
    let rows = body.height - 1;
    let above = (f64::from(rows) * (1.0 - 1.0 / most)).ceil() as u16;
    // With few rows, only the row of the limit shows an excess.
    let above = if has_rows { above.min(rows / 2) } else { 0 };
    let below = rows - above;
    let calm = curve(app, app.selected);
    let unit = chart.y.unit;
    let limit_label = format!(" {} {}", units::significant(limit, unit, 3), unit.symbol());
    for row in 0..body.height {
        let y = body.y + row;
        let line = match row.checked_sub(above) {
            Some(0) => Line::from_iter(
                shares.iter().map(|shares| Span::styled(shares.at_limit(), shares.style_at_limit(theme))),
            ),
            None => {
                let from = 1.0 + f64::from(above - 1 - row) / f64::from(below);
                Line::from_iter(shares.iter().map(|shares| shares.cell(from, below, [theme.limit(); 2])))
            }
            Some(_) => {
                let from = f64::from(body.height - 1 - row) / f64::from(below);
                let to = from + 1.0 / f64::from(below);
                // A row nearer to the limit has a warmer color.
                let warm = theme.heat(calm, 0.5 * (from + to));
                let cell = |n: usize| match line_in(&shares, n, [from, to]) {
                    // Over a filled area the line is drawn as a gap. Its vertical sides are left out, because there would be too many.
                    Some(line) if 2.0 * shares[n].filled >= from + to => match LINE.contains(&line) {
                        true => Span::styled(line, warm.add_modifier(Modifier::REVERSED)),
                        false => shares[n].cell(from, below, [warm, theme.muted()]),
                    },
                    Some(line) => Span::styled(line, theme.title()),
                    None => shares[n].cell(from, below, [warm, theme.muted()]),
                };
                Line::from_iter((0..shares.len()).map(cell))
            }
        };
        frame.render_widget(line, Rect { y, height: 1, ..bars });
        let label = match row.checked_sub(above) {
            Some(0) => Line::styled(limit_label.as_str(), theme.limit_line()),
            Some(1) => Line::styled(format!(" {name}"), theme.muted()),
            Some(_) | None => continue,
        };
        frame.render_widget(label, Rect { y, height: 1, ..left });
    }
    draw_axis(app, chart, frame, Rect { x: bars.x, width: bars.width, ..axis });
    frame.render_widget(Line::styled("0 ", theme.muted()).right_aligned(), Rect { width: LABELS, ..axis });
    let drawn = Drawn { area: Rect { height: bars.height + axis.height, ..bars }, end: chart.x.range[1] };
    if let Some(cursor) = cursor {
        drawn.mark(app, cursor, frame);
    }
    Some(drawn)
}

/// The title of a chart with the meaning of its signs. The longest wording that fits.
fn titled<'l>(
    app: &App,
    chart: &'l Chart,
    (name, drawn): (&str, DrawnShot),
    has_rows: bool,
    width: u16,
) -> Line<'l> {
    let has = |kind: SeriesKind| has_rows && chart.series.iter().any(|series| series.kind == kind);
    let theme = app.theme;
    let is_planned = drawn == DrawnShot::Planned;
    let entries = [
        (is_planned || has(SeriesKind::Planned), LINE[2], theme.title(), ["planned", "planned", "plan"]),
        (has(SeriesKind::High), "░", theme.muted(), ["19 of 20 shots", "19 of 20", "19 of 20"]),
    ];
    let entries = entries.into_iter().filter(|(is_drawn, ..)| *is_drawn).collect::<Vec<_>>();
    let in_that_shot = format!("{name} in that shot");
    let titles = match chart.title.contains(OF_SHOT_WORST_BY) {
        true => [chart.title.as_str(), &in_that_shot, &in_that_shot],
        false => [&format!("{name} in time"), name, name],
    };
    // If even the shortest wording does not fit, the last signs are left out.
    let shorter = (1..entries.len()).rev().map(|count| (2, titles[2], count));
    let all = titles.iter().enumerate().map(|(n, title)| (n, *title, entries.len()));
    let mut lines = all.chain(shorter).map(|(n, title, count)| {
        let mut line = Line::styled(format!(" {title}"), theme.muted());
        for (_, sign, style, words) in &entries[..count] {
            line.push_span(Span::styled(format!(" {sign}"), *style));
            line.push_span(Span::styled(format!(" {}", words[n]), theme.muted()));
        }
        line.push_span(" ");
        line
    });
    lines.find(|line| line.width() <= width.into()).unwrap_or_default()
}

impl Drawn {
    /// Marks a value of the horizontal axis by a thin line above the bar in its column. No bar looks like this line.
    fn mark(&self, app: &App, at: f64, frame: &mut Frame) {
        let Some(column) = column(at, self.end, self.area.width.into()) else { return };
        let (x, axis) = (self.area.x + column as u16, self.area.bottom().saturating_sub(1));
        for y in self.area.y..axis {
            let is_free =
                frame.buffer_mut().cell((x, y)).is_some_and(|cell| [" ", LIMIT].contains(&cell.symbol()));
            if is_free {
                frame.buffer_mut().set_string(x, y, "┆", app.theme.title());
            }
        }
        let Some(cell) = frame.buffer_mut().cell_mut((x, axis)) else { return };
        // A covered digit would leave another number.
        if ["─", "▲"].contains(&cell.symbol()) {
            cell.set_symbol("┃").set_style(app.theme.title());
        }
    }
}

/// Column of a value on an axis from 0 to `end`; `None` if the value is not on the axis.
fn column(at: f64, end: f64, width: usize) -> Option<usize> {
    let column = at / end * width as f64;
    (column >= 0.0 && column <= width as f64).then_some((column as usize).min(width.saturating_sub(1)))
}

/// Shares of the limit in one column.
#[derive(Clone, Copy)]
struct Shares {
    /// Of the deciding shot; 0 if it is not drawn.
    filled: f64,
    /// Of the planned shot; 0 if it is not drawn.
    line: f64,
    /// Greatest share of 19 of 20 shots; 0 if not known.
    most: f64,
}

impl Shares {
    /// The cell in the row of the limit: the line of the limit, or a sign that a shot exceeds it.
    fn at_limit(self) -> &'static str {
        match self {
            Shares { filled, .. } if filled > 1.0 => "█",
            Shares { line, .. } if line > 1.0 => LINE[2],
            _ => LIMIT,
        }
    }

    /// The style of the cell in the row of the limit.
    fn style_at_limit(self, theme: Theme) -> Style {
        if self.filled > 1.0 || self.line > 1.0 { theme.limit() } else { theme.limit_line() }
    }

    /// A cell whose lower edge is at the share `from` of the limit. `rows` rows make up the limit.
    fn cell(self, from: f64, rows: u16, [filled, behind]: [Style; 2]) -> Span<'static> {
        let full = (EIGHTHS.len() - 1) as f64;
        let eighths = |share: f64| {
            let eighths = ((share - from) * f64::from(rows) * full).clamp(0.0, full);
            // A value above 0 is always visible.
            if from == 0.0 && share > 0.0 { eighths.max(1.0) } else { eighths }
        };
        let [reached, most] = [self.filled, self.most].map(eighths);
        match () {
            () if reached == 0.0 && self.line <= from && most >= 0.5 * full => Span::styled("░", behind),
            () => Span::styled(EIGHTHS[reached as usize], filled),
        }
    }
}

/// The line of the planned shot in a cell of column `n` that covers the shares from `from` to `to` of the limit; `None` if the line is not
/// in the cell.
fn line_in(shares: &[Shares], n: usize, [from, to]: [f64; 2]) -> Option<&'static str> {
    let at = |n: Option<usize>| n.and_then(|n| shares.get(n)).map(|shares| shares.line);
    let here = at(Some(n)).filter(|share| *share > 0.0)?;
    let falls_below = |beside: Option<f64>| beside.is_some_and(|beside| beside < from);
    match () {
        () if (from..to).contains(&here) => {
            let quarter = (here - from) / (to - from) * LINE.len() as f64;
            LINE.get(quarter as usize).copied()
        }
        () if here < from => None,
        () if falls_below(at(n.checked_sub(1))) => Some(SIDES[0]),
        () if falls_below(at(Some(n + 1))) => Some(SIDES[1]),
        () => None,
    }
}

/// The greatest shares of the limit in each of `width` columns. `has_rows`: also of the planned shot behind another shot, and of other
/// shots.
fn shares(chart: &Chart, limit: f64, width: usize, drawn: DrawnShot, has_rows: bool) -> Vec<Shares> {
    let of = |kind: SeriesKind| {
        let series = chart.series.iter().find(|series| series.kind == kind);
        series.map(|series| columns(&series.points, chart.x.range[1], width))
    };
    let [shown, behind, high] = [SeriesKind::Curve, SeriesKind::Planned, SeriesKind::High].map(of);
    let [behind, high] = [behind, high].map(|known| known.filter(|_| has_rows));
    let (filled, line) = if drawn == DrawnShot::Planned { (None, shown) } else { (shown, behind) };
    let share = |known: &Option<Vec<f64>>, n: usize| known.as_ref().map_or(0.0, |known| known[n] / limit);
    let column = |n| Shares { filled: share(&filled, n), line: share(&line, n), most: share(&high, n) };
    (0..width).map(column).collect()
}

/// The greatest value of the points in each of `width` columns. A column without a point repeats the column before it.
fn columns(points: &[(f64, f64)], end: f64, width: usize) -> Vec<f64> {
    let mut columns: Vec<Option<f64>> = vec![None; width];
    for &(x, value) in points {
        if let Some(greatest) = column(x, end, width).and_then(|column| columns.get_mut(column)) {
            *greatest = Some(f64::max(value, greatest.unwrap_or(value)));
        }
    }
    let last_known = |last: &mut f64, value: Option<f64>| {
        *last = value.unwrap_or(*last);
        Some(*last)
    };
    columns.into_iter().scan(0.0, last_known).collect()
}

/// Draws the horizontal axis with labels at its middle and its end, and the firings.
fn draw_axis(app: &App, chart: &Chart, frame: &mut Frame, area: Rect) {
    let width = usize::from(area.width);
    let mut cells: Vec<Span<'_>> = vec![Span::styled("─", app.theme.muted()); width];
    let end = chart.x.range[1];
    for &firing in &chart.firings {
        if let Some(cell) = column(firing, end, width).and_then(|column| cells.get_mut(column)) {
            *cell = Span::styled("▲", app.theme.title());
        }
    }
    frame.render_widget(Line::from(cells), area);
    let label = |at: f64| format!("{} {}", units::short(at / chart.x.unit.size()), chart.x.unit.symbol());
    let (middle, end) = (label(0.5 * end), label(end));
    let start = (width / 2).saturating_sub(middle.len() / 2) as u16;
    // Two numbers that touch read as one number. A covered firing sign would look like a row that does not fire.
    let fired = || chart.firings.iter().filter_map(|&firing| column(firing, chart.x.range[1], width));
    let covered = |from: usize, len: usize| fired().any(|column| (from..from + len).contains(&column));
    // A number in another place would label the wrong time.
    let last = width.saturating_sub(end.len());
    let has_end = !covered(last, end.len());
    let middle_ends = usize::from(start) + middle.len();
    let has_middle = (!has_end || middle_ends < last) && !covered(start.into(), middle.len());
    let last = has_end.then_some((last as u16, end));
    for (x, text) in has_middle.then_some((start, middle)).into_iter().chain(last) {
        let place = Rect { x: area.x + x, width: text.len() as u16, ..area }.intersection(area);
        frame.render_widget(Line::styled(text, app.theme.muted()), place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line steps up and down in rows of a quarter of the limit: edges at their heights, vertical sides between them.
    #[test]
    fn the_line_is_the_upper_edge_and_has_no_gap() {
        let shares = [0.1, 0.6, 0.6, 0.1, 0.0].map(|line| Shares { filled: 0.0, line, most: 0.0 });
        let row =
            |from: f64| (0..5).map(|n| line_in(&shares, n, [from, from + 0.25]).unwrap_or(" ")).collect();
        let rows: [String; 4] = [0.75, 0.5, 0.25, 0.0].map(row);
        assert_eq!(rows, ["     ", " ⠤⠤  ", " ⡇⢸  ", "⠤  ⠤ "]);
    }
}
