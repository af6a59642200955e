//! A quantity over time with its limit and the firing times.

use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::Style;
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::{Axis, Block, Chart, Dataset, GraphType};

use crate::outcome::History;
use crate::tui::app::App;
use crate::units::Unit;
use crate::verdict::Limits;

/// What is drawn, SI.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    name: &'static str,
    unit: Unit,
    /// Greatest value per bucket.
    values: &'a [f64],
    /// Width of a bucket [s].
    width: f64,
    limit: f64,
    /// Firing times [s].
    fires: &'a [f64],
    /// Time marked [s].
    cursor: Option<f64>,
}

/// Height and force over time.
pub fn curves<'a>(
    limits: &Limits,
    history: &'a History,
    fires: &'a [f64],
    cursor: Option<f64>,
) -> [Curve<'a>; 2] {
    let height = Curve {
        name: "flight height",
        unit: Unit::Metre,
        values: &history.height,
        width: history.width,
        limit: limits.height,
        fires,
        cursor,
    };
    let force = Curve {
        name: "cable force",
        unit: Unit::Kilonewton,
        values: &history.force,
        limit: limits.force,
        ..height
    };
    [height, force]
}

impl Curve<'_> {
    /// Draws the chart.
    pub fn draw(&self, app: &App, frame: &mut Frame, area: Rect) {
        if area.height < 3 || area.width < 20 {
            return;
        }
        let size = self.unit.size();
        let end = (self.values.len() as f64 * self.width).max(self.width);
        let top = self.values.iter().copied().fold(self.limit, f64::max) / size * 1.08;
        let curve: Vec<(f64, f64)> = self
            .values
            .iter()
            .enumerate()
            .map(|(n, value)| ((n as f64 + 0.5) * self.width, value / size))
            .collect();
        let limit = [(0.0, self.limit / size), (end, self.limit / size)];
        let marks: Vec<[(f64, f64); 2]> =
            self.fires.iter().map(|&at| [(at, 0.0), (at, top * 0.12)]).collect();
        let cursor: Vec<(f64, f64)> =
            self.cursor.iter().flat_map(|&at| [(at.min(end), 0.0), (at.min(end), top)]).collect();
        let mut sets: Vec<Dataset> =
            marks.iter().map(|mark| line(mark, app.theme.firing(), Marker::Braille)).collect();
        sets.push(line(&limit, app.theme.limit(), Marker::Dot));
        sets.push(line(&cursor, app.theme.base(), Marker::Braille));
        sets.push(line(&curve, app.theme.curve(), Marker::Braille));
        let key = if area.width < 50 { "dotted: limit" } else { "dotted: limit; ticks: firings" };
        let title = format!("{}, {} ({key})", self.name, self.unit.symbol());
        let times = [0.0, 0.5 * end, end].map(|time| format!("{time:.2} s"));
        let chart = chart(app, title, sets, Scale::new([0.0, end], times), Scale::up_to(top));
        frame.render_widget(chart, area);
    }
}

/// An axis.
pub struct Scale {
    bounds: [f64; 2],
    labels: Vec<String>,
}

impl Scale {
    /// From one bound to another, both labelled and perhaps more between; of some length even where they are equal.
    pub fn new([from, to]: [f64; 2], labels: impl IntoIterator<Item = String>) -> Self {
        let end = to.max(from + f64::MIN_POSITIVE.max(from.abs() * 1e-9));
        Self { bounds: [from, end], labels: labels.into_iter().collect() }
    }

    /// From 0.
    pub fn up_to(top: f64) -> Self {
        let level = |value: f64| format!("{value:.4}").chars().take(5).collect();
        Self::new([0.0, top], [level(0.0), level(top)])
    }
}

/// What is drawn between two axes under a title; a legend where it has names.
pub fn chart<'c>(app: &App, title: String, sets: Vec<Dataset<'c>>, across: Scale, up: Scale) -> Chart<'c> {
    let quiet = app.theme.quiet();
    let axis = |Scale { bounds, labels }| Axis::default().bounds(bounds).labels(labels).style(quiet);
    Chart::new(sets)
        .block(Block::new().title(Line::styled(title, quiet).centered()))
        .style(app.theme.base())
        .x_axis(axis(across))
        .y_axis(axis(up))
        .hidden_legend_constraints((Constraint::Percentage(50), Constraint::Percentage(60)))
}

/// A line through points.
pub fn line(data: &[(f64, f64)], style: Style, marker: Marker) -> Dataset<'_> {
    Dataset::default().data(data).graph_type(GraphType::Line).marker(marker).style(style)
}
