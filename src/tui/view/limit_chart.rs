//! A quantity and its limit: the shot shown as a line, before it the shot as planned as bars; in few rows bars alone. The line of the limit
//! is labelled with it, the axis begins at 0.
//!
//! ```text
//!    height in time █ planned ⠒ worst of 100 ░ 19 of 20 shots
//! 2.35 m ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄▒┄┄┄┄   what stands in this row or above goes beyond the limit
//! height    ⢀⠤⠒⠒⠤⡀  ⣀⠒⠉⠒⣀   █ planned, the line is the upper edge of the shot that decides
//! worst    ⡇▂▅██▅▂⢸⡇▂▅█▅▂    ░ as far as 19 of 20 shots reach at that time, above both
//!      0 ▲───▲─────0.5 s────────1 s  ▲ a hole fires
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::compare::curve;
use crate::report::charts::OF_SHOT_WORST_BY;
use crate::report::parts::{Chart, SeriesKind};
use crate::tui::app::App;
use crate::units;

/// Least width and height of a chart that can be read.
pub const LEAST_SIZE: (u16, u16) = (24, 3);
/// Least height of a chart with a title of its own.
pub const TITLED: u16 = 6;
/// Least height of the bars with room for a line before the shot as planned, and for rows above the limit.
const TWO_SHOTS: u16 = 5;
/// Width of the labels at the left.
const LABELS: u16 = 8;
/// Parts of a cell, from empty to full.
const EIGHTHS: [&str; 9] = [" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"];
/// The line in a cell, from its lower edge to its upper one; and where it rises or falls through a cell, at its left and its right side.
const LINE: [&str; 4] = ["⣀", "⠤", "⠒", "⠉"];
const SIDES: [&str; 2] = ["⡇", "⢸"];

/// A chart where it is drawn.
pub struct Drawn {
    /// The area of the bars and of the axis below them.
    pub area: Rect,
    /// The value of the axis across at the right end of the area; 0 stands at the left end.
    pub end: f64,
}

/// Draws a chart, called by the words of `labels`, with a mark at `cursor` on the axis across; nothing where the area is too small.
pub fn draw(
    app: &App,
    chart: &Chart,
    labels: [&str; 2],
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
    let [left, bars] = Layout::horizontal([Constraint::Length(LABELS), Constraint::Min(0)]).areas(body);
    let has_line = bars.height >= TWO_SHOTS;
    let shares = shares(chart, limit, bars.width.into(), has_line);
    frame.render_widget(titled(app, chart, labels, has_line, title.width), title);
    let most = shares.iter().flat_map(|shares| [shares.filled, shares.shaded]).fold(1.0, f64::max);
    // Rows above the limit, and below it; its own row stands between.
    let rows = body.height - 1;
    let above = (f64::from(rows) * (1.0 - 1.0 / most)).ceil() as u16;
    // With few rows the row of the limit alone tells what goes beyond.
    let above = if has_line { above.min(rows / 2) } else { 0 };
    let below = rows - above;
    let curve = curve(app, app.selected);
    let unit = chart.y.unit;
    let limit_label = format!("{} {}", units::significant(limit, unit, 3), unit.symbol());
    for row in 0..body.height {
        let y = body.y + row;
        let line = match row.checked_sub(above) {
            Some(0) => {
                Line::from_iter(shares.iter().map(|shares| Span::styled(shares.at_limit(), theme.limit())))
            }
            None => {
                let from = 1.0 + f64::from(above - 1 - row) / f64::from(below);
                Line::from_iter(shares.iter().map(|shares| shares.cell(from, below, [theme.limit(); 2])))
            }
            Some(_) => {
                let from = f64::from(body.height - 1 - row) / f64::from(below);
                let to = from + 1.0 / f64::from(below);
                // The nearer a row is to the limit, the warmer it is.
                let warm = theme.heat(curve, 0.5 * (from + to));
                let cell = |n: usize| match line_in(&shares, n, [from, to]) {
                    Some(line) if has_line => Span::styled(line, warm),
                    // Under the line there is room for the shot as planned alone.
                    _ if has_line => {
                        let most = if shares[n].shaded > from { 0.0 } else { shares[n].most };
                        let behind = [theme.faded(warm), theme.faint()];
                        Shares { shaded: 0.0, most, ..shares[n] }.cell(from, below, behind)
                    }
                    _ => shares[n].cell(from, below, [warm, theme.base()]),
                };
                Line::from_iter((0..shares.len()).map(cell))
            }
        };
        frame.render_widget(line, Rect { y, height: 1, ..bars });
        let label = match row.checked_sub(above) {
            Some(0) => Line::styled(limit_label.as_str(), theme.limit()),
            Some(n) => {
                Line::styled(labels.get(usize::from(n) - 1).copied().unwrap_or_default(), theme.muted())
            }
            None => continue,
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

/// The title of a chart with what its signs mean, in as many words as have room.
fn titled<'l>(app: &App, chart: &'l Chart, labels: [&'l str; 2], has_line: bool, width: u16) -> Line<'l> {
    let has = |kind: SeriesKind| has_line && chart.series.iter().any(|series| series.kind == kind);
    let (theme, worst) = (app.theme, format!("worst of {}", units::one_in(app.case.limits.accepted_risk)));
    let is_of_other = chart.title.contains(OF_SHOT_WORST_BY);
    let words = if is_of_other { ["in that shot", "that shot"] } else { [worst.as_str(), "worst"] };
    let entries = [
        (SeriesKind::Planned, "█", theme.faded(curve(app, app.selected)), ["planned"; 2]),
        (SeriesKind::Planned, LINE[2], curve(app, app.selected), words),
        (SeriesKind::High, "░", theme.faint(), ["19 of 20 shots", "19 of 20"]),
    ];
    let entries = entries.into_iter().filter(|(kind, ..)| has(*kind)).collect::<Vec<_>>();
    let titles = match entries.is_empty() {
        true => [chart.title.clone(), labels.join(" ")],
        false => [format!("{} in time", labels[0]), labels[0].to_owned()],
    };
    let mut lines = titles.into_iter().enumerate().map(|(n, title)| {
        let mut line = Line::styled(title, theme.muted()).centered();
        for (_, sign, style, words) in &entries {
            line.push_span(Span::styled(format!(" {sign}"), *style));
            line.push_span(Span::styled(format!(" {}", words[n]), theme.muted()));
        }
        line
    });
    lines.find(|line| line.width() <= width.into()).unwrap_or_default()
}

impl Drawn {
    /// Marks a value of the axis across: a thin line above the bar in its column, which no bar looks like.
    fn mark(&self, app: &App, at: f64, frame: &mut Frame) {
        let Some(column) = column(at, self.end, self.area.width.into()) else { return };
        let (x, axis) = (self.area.x + column as u16, self.area.bottom().saturating_sub(1));
        for y in self.area.y..axis {
            let is_free =
                frame.buffer_mut().cell((x, y)).is_some_and(|cell| [" ", "┄"].contains(&cell.symbol()));
            if is_free {
                frame.buffer_mut().set_string(x, y, "│", app.theme.title());
            }
        }
        frame.buffer_mut().set_string(x, axis, "┃", app.theme.title());
    }
}

/// The column of a value on an axis from 0 to `end`; `None` beside it.
fn column(at: f64, end: f64, width: usize) -> Option<usize> {
    let column = at / end * width as f64;
    (column >= 0.0 && column <= width as f64).then_some((column as usize).min(width.saturating_sub(1)))
}

/// Shares of the limit in one column.
#[derive(Clone, Copy)]
struct Shares {
    /// Of the shot as planned behind a line; without a line of what the chart is about.
    filled: f64,
    /// Of what the chart is about, where it is a line.
    shaded: f64,
    /// Of what 19 of 20 shots reach at most; 0 where it is not known.
    most: f64,
}

impl Shares {
    /// The cell in the row of the limit: a dash, or what goes beyond.
    fn at_limit(self) -> &'static str {
        match self {
            Shares { filled, .. } if filled > 1.0 => "█",
            Shares { shaded, .. } if shaded > 1.0 => "▒",
            _ => "┄",
        }
    }

    /// A cell whose lower edge stands at the share `from` of the limit, of `rows` rows that make up the limit.
    fn cell(self, from: f64, rows: u16, [filled, shaded]: [Style; 2]) -> Span<'static> {
        let full = (EIGHTHS.len() - 1) as f64;
        let eighths = |share: f64| {
            let eighths = ((share - from) * f64::from(rows) * full).clamp(0.0, full);
            // What is not 0 is seen.
            if from == 0.0 && share > 0.0 { eighths.max(1.0) } else { eighths }
        };
        let [below, above, most] = [self.filled, self.shaded, self.most].map(eighths);
        match () {
            () if below.max(above) == 0.0 && most >= 0.5 * full => Span::styled("░", shaded),
            () if above <= below => Span::styled(EIGHTHS[below as usize], filled),
            // Before the shaded bar the filled one ends with a cell.
            () if below >= 0.5 * full => Span::styled(EIGHTHS[above as usize], filled),
            () if above == full => Span::styled("▒", shaded),
            () => Span::styled(EIGHTHS[above as usize], shaded),
        }
    }
}

/// The line of what the chart is about in a cell of column `n` that reaches from one share of the limit to another; `None` beside the line.
fn line_in(shares: &[Shares], n: usize, [from, to]: [f64; 2]) -> Option<&'static str> {
    let at = |n: Option<usize>| n.and_then(|n| shares.get(n)).map(|shares| shares.shaded);
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

/// The greatest shares of the limit in each of `width` columns; `has_line`: of the shot as planned and of other shots, too.
fn shares(chart: &Chart, limit: f64, width: usize, has_line: bool) -> Vec<Shares> {
    let of = |kind: SeriesKind| {
        let series = chart.series.iter().find(|series| series.kind == kind);
        series.map(|series| columns(&series.points, chart.x.range[1], width))
    };
    let shown = of(SeriesKind::Curve).unwrap_or_default();
    if !has_line {
        return shown.iter().map(|value| Shares { filled: value / limit, shaded: 0.0, most: 0.0 }).collect();
    }
    let [planned, high] = [SeriesKind::Planned, SeriesKind::High].map(of);
    let share = |known: &Option<Vec<f64>>, n: usize| known.as_ref().map_or(0.0, |known| known[n] / limit);
    let column = |(n, value): (usize, &f64)| Shares {
        filled: share(&planned, n),
        shaded: value / limit,
        most: share(&high, n),
    };
    shown.iter().enumerate().map(column).collect()
}

/// The greatest value of the points in each of `width` columns; a column without a point has that of the column before.
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

/// The horizontal axis with its middle and its end, and the firings.
fn draw_axis(app: &App, chart: &Chart, frame: &mut Frame, area: Rect) {
    let width = usize::from(area.width);
    let mut cells: Vec<Span<'_>> = vec![Span::styled("─", app.theme.muted()); width];
    let end = chart.x.range[1];
    for &firing in &chart.firings {
        if let Some(cell) = column(firing, end, width).and_then(|column| cells.get_mut(column)) {
            *cell = Span::styled("▲", app.theme.firing());
        }
    }
    frame.render_widget(Line::from(cells), area);
    let label = |at: f64| format!("{} {}", units::short(at / chart.x.unit.size()), chart.x.unit.symbol());
    let (middle, end) = (label(0.5 * end), label(end));
    let start = (width / 2).saturating_sub(middle.len() / 2) as u16;
    let places = [(start, middle), ((width.saturating_sub(end.len())) as u16, end)];
    for (x, text) in places {
        let place = Rect { x: area.x + x, width: text.len() as u16, ..area }.intersection(area);
        frame.render_widget(Line::styled(text, app.theme.muted()), place);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step up and down in rows of a quarter of the limit: edges at their height, and sides between them.
    #[test]
    fn the_line_is_the_upper_edge_and_has_no_gap() {
        let shares = [0.1, 0.6, 0.6, 0.1, 0.0].map(|shaded| Shares { filled: 0.0, shaded, most: 0.0 });
        let row =
            |from: f64| (0..5).map(|n| line_in(&shares, n, [from, from + 0.25]).unwrap_or(" ")).collect();
        let rows: [String; 4] = [0.75, 0.5, 0.25, 0.0].map(row);
        assert_eq!(rows, ["     ", " ⠤⠤  ", " ⡇⢸  ", "⠤  ⠤ "]);
    }
}
