//! Charts of a report, drawn with characters.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::{self, Block, Dataset, GraphType};

use crate::report::parts::{Axis, Chart, Scale, SeriesKind};
use crate::tui::app::App;
use crate::units::Unit;
use crate::verdict::Verdict;

/// Least width and height of a chart that can be read.
const LEAST_SIZE: (u16, u16) = (20, 4);
/// Least height of each chart if charts stand one above the other.
const TALL: u16 = 8;
/// Points per column from which points count as a curve.
const DENSE: usize = 4;
/// Height of the bar that marks passing stretches, as a share of the chart.
const BAR: f64 = 0.02;

/// Points with one style, in the coordinates of the axes.
struct Set {
    points: Vec<(f64, f64)>,
    style: Style,
    marker: Marker,
    kind: GraphType,
    /// Name in the legend; empty for none.
    name: &'static str,
}

/// Draws charts one above the other if each gets some height, else side by side. If not all fit, the last charts are drawn, at least the
/// very last: one tall chart shows more than two flat ones.
pub fn draw_all(app: &App, charts: &[&Chart], frame: &mut Frame, area: Rect) {
    let above = |count: u16| area.height >= TALL * count;
    let beside = |count: u16| 2 * area.width >= 3 * LEAST_SIZE.0 * count;
    let fits = |&count: &u16| count == 1 || above(count) || beside(count);
    let count = (1..=charts.len() as u16).rev().find(fits).unwrap_or(0);
    let charts = &charts[charts.len() - usize::from(count)..];
    let side_by_side = !above(count) && beside(count);
    let direction = if side_by_side { Layout::horizontal } else { Layout::vertical };
    let areas =
        direction(vec![Constraint::Fill(1); charts.len()]).spacing(u16::from(side_by_side)).split(area);
    for (chart, area) in charts.iter().zip(areas.iter()) {
        draw(app, chart, None, frame, *area);
    }
}

/// Draws a chart, with a mark at the point `chosen` [SI]. Draws nothing if the area is too small.
pub fn draw(app: &App, chart: &Chart, chosen: Option<(f64, f64)>, frame: &mut Frame, area: Rect) {
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return;
    }
    let theme = app.theme;
    let (across, up) = (chart.x.ends(), chart.y.ends());
    let place = |(x, y): (f64, f64)| (chart.x.coordinate(x), chart.y.coordinate(y));
    let height = |share: f64| up[0] + share * (up[1] - up[0]);
    let mut sets: Vec<Set> = Vec::new();
    let dots = [2.0 * f64::from(area.width), 4.0 * f64::from(area.height)];
    let dot = [(across[1] - across[0]) / dots[0], (up[1] - up[0]) / dots[1]];
    let dots_across = (0..dots[0] as usize).map(|n| across[0] + n as f64 * dot[0]);
    let mut dotted = |points, style, marker| {
        sets.push(Set { points, style, marker, kind: GraphType::Scatter, name: "" });
    };
    // A dot lies in a window only if its whole width does, so the bar hides no gap.
    let is_marked = |x: &f64| {
        let whole =
            |[from, to]: [f64; 2]| chart.x.coordinate(from) <= *x && x + dot[0] <= chart.x.coordinate(to);
        chart.windows.iter().copied().any(whole)
    };
    let bar = dots_across.clone().filter(is_marked).map(|x| (x, height(BAR)));
    dotted(bar.collect(), theme.curve(), Marker::Braille);
    let limit = chart.limit.map(|limit| chart.y.coordinate(limit));
    if let Some(limit) = limit {
        dotted(dots_across.step_by(3).map(|x| (x, limit)).collect(), theme.limit_line(), Marker::Braille);
    }
    let compared = chart.series.iter().any(|series| series.kind == SeriesKind::Comparison);
    for series in &chart.series {
        let (style, marker, kind) = match series.kind {
            SeriesKind::Curve => (theme.curve(), Marker::Braille, GraphType::Line),
            SeriesKind::Comparison => (theme.limit(), Marker::Braille, GraphType::Line),
            SeriesKind::Planned | SeriesKind::Low | SeriesKind::High => {
                (theme.muted(), Marker::Braille, GraphType::Line)
            }
            // Many points are drawn as a curve.
            SeriesKind::Points => {
                let is_dense = series.points.len() > DENSE * usize::from(area.width);
                let marker = if is_dense { Marker::Braille } else { Marker::Dot };
                (theme.curve(), marker, GraphType::Scatter)
            }
        };
        let points: Vec<(f64, f64)> = series.points.iter().map(|&point| place(point)).collect();
        let over = limit.map(|limit| match kind {
            GraphType::Line => part_over(&points, limit, dot),
            _ => points.iter().copied().filter(|(_, y)| *y > limit).collect(),
        });
        sets.push(Set { points, style, marker, kind, name: if compared { series.name } else { "" } });
        if let Some(points) = over {
            let (style, kind) = (theme.verdict(Verdict::Fail), GraphType::Scatter);
            sets.push(Set { points, style, marker, kind, name: "" });
        }
    }
    if let Some(point) = chosen {
        let (style, marker) = (theme.base(), Marker::Block);
        let (points, kind) = (vec![place(point)], GraphType::Scatter);
        sets.push(Set { points, style, marker, kind, name: "chosen" });
    }
    let sets = sets.iter().map(|set| {
        let drawn = Dataset::default().data(&set.points).style(set.style).marker(set.marker);
        let drawn = drawn.graph_type(set.kind);
        if set.name.is_empty() { drawn } else { drawn.name(set.name) }
    });
    let axis = |axis: &Axis, labels: Vec<f64>| {
        let [from, to] = axis.ends();
        widgets::Axis::default()
            .bounds([from, to.max(from + f64::MIN_POSITIVE.max(from.abs() * 1e-9))])
            .labels(labels.into_iter().map(|coordinate| label(axis, coordinate)))
            .style(theme.muted())
    };
    let decades = [area.width / LABEL_WIDTH, area.height / 2];
    let [x, y] = [(&chart.x, 3, decades[0]), (&chart.y, 2, decades[1])]
        .map(|(side, count, decades)| axis(side, labelled(side, count, decades.into())));
    let drawn = widgets::Chart::new(sets.collect())
        .block(Block::new().title(Line::styled(title(chart, area.width), theme.muted()).centered()))
        .style(theme.base())
        .x_axis(x)
        .y_axis(y)
        .hidden_legend_constraints((Constraint::Percentage(50), Constraint::Percentage(60)));
    frame.render_widget(drawn, area);
}

/// The part of a line that exceeds a limit, as points at most one `dot` apart (width, height).
fn part_over(line: &[(f64, f64)], limit: f64, dot: [f64; 2]) -> Vec<(f64, f64)> {
    let points = |ends: &[(f64, f64)]| {
        let [(x1, y1), (x2, y2)] = [ends[0], ends[1]];
        let count = ((x2 - x1) / dot[0]).abs().max(((y2 - y1) / dot[1]).abs());
        let count = if count.is_finite() { count.ceil().min(MOST_DOTS) } else { 0.0 };
        let place = move |n: usize| n as f64 / count.max(1.0);
        (0..=count as usize).map(move |n| (x1 + place(n) * (x2 - x1), y1 + place(n) * (y2 - y1)))
    };
    line.windows(2).flat_map(points).filter(|(_, y)| *y > limit).collect()
}

/// Most points between two ends of a line.
const MOST_DOTS: f64 = 1e4;

/// Title with the key to the lines: as much of both as fits.
fn title(chart: &Chart, width: u16) -> String {
    let bar = format!("bar below: {}", chart.windows_are);
    let parts = [("dotted: limit", chart.limit.is_some()), (bar.as_str(), !chart.windows.is_empty())];
    let parts: Vec<&str> = parts.iter().filter(|(_, shown)| *shown).map(|(part, _)| *part).collect();
    let keyed = |title: &str, parts: &[&str]| format!("{title} ({})", parts.join("; "));
    let first = &parts[..parts.len().min(1)];
    let short = chart.title.split(" against ").next().unwrap_or(chart.y.name);
    let titles = [keyed(&chart.title, &parts), keyed(&chart.title, first), keyed(short, first)];
    let fits = |title: &String| !parts.is_empty() && title.chars().count() <= usize::from(width);
    titles.into_iter().find(fits).unwrap_or_else(|| chart.title.clone())
}

/// Least width of a label of a power of ten [cells].
const LABEL_WIDTH: u16 = 12;

/// Coordinates with a label: on a linear axis `count` at even distances, or both ends for a count; on a logarithmic axis at most `decades`
/// powers of ten.
fn labelled(axis: &Axis, count: usize, decades: usize) -> Vec<f64> {
    let [from, to] = axis.ends();
    match axis.scale {
        Scale::Linear if axis.unit == Unit::One => vec![from, to],
        Scale::Linear => (0..count).map(|n| from + (to - from) * n as f64 / (count - 1) as f64).collect(),
        Scale::Logarithmic => {
            let last = (to.round() - from.round()) as usize;
            // The chart places labels at even distances, and both ends need a label.
            let is_even = |step: &usize| last.is_multiple_of(*step) && last / step < decades.max(2);
            let step = (1..=last.max(1)).find(is_even).unwrap_or(last.max(1));
            (0..=last).step_by(step).map(|n| from.round() + n as f64).collect()
        }
    }
}

/// Label of a coordinate with the unit: four digits, or a power of ten.
fn label(axis: &Axis, coordinate: f64) -> String {
    let number = match axis.scale {
        Scale::Linear => {
            let decimals = (3 - coordinate.abs().max(1.0).log10().floor() as i32).max(0) as usize;
            let text = format!("{coordinate:.decimals$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        }
        Scale::Logarithmic => axis.mark(coordinate),
    };
    match axis.unit.symbol() {
        "" => number,
        symbol => format!("{number} {symbol}"),
    }
}
