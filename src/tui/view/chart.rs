//! A quantity over time with its limit and the firing times.

use ratatui::Frame;
use ratatui::layout::{Alignment, Rect};
use ratatui::style::Style;
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::{Axis, Chart, Dataset, GraphType};

use crate::tui::app::App;
use crate::units::Unit;

/// What is drawn, SI.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    /// Name of the quantity.
    pub name: &'static str,
    /// Unit shown.
    pub unit: Unit,
    /// Greatest value per bucket.
    pub values: &'a [f64],
    /// Width of a bucket [s].
    pub width: f64,
    /// Limit.
    pub limit: f64,
    /// Firing times [s].
    pub fires: &'a [f64],
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
        let line = |data, style: Style, marker| {
            Dataset::default().data(data).graph_type(GraphType::Line).marker(marker).style(style)
        };
        let mut sets: Vec<Dataset> =
            marks.iter().map(|mark| line(mark, app.theme.firing(), Marker::Braille)).collect();
        sets.push(line(&limit, app.theme.limit(), Marker::Dot));
        sets.push(line(&curve, app.theme.curve(), Marker::Braille));
        let quiet = app.theme.quiet();
        let times = [0.0, 0.5 * end, end].map(|time| Line::from(format!("{time:.2} s")));
        let levels =
            [0.0, top].map(|level| Line::from(format!("{level:.4}").chars().take(5).collect::<String>()));
        let title = format!("{}, {} (dotted: limit)", self.name, self.unit.symbol());
        let chart = Chart::new(sets)
            .block(
                ratatui::widgets::Block::new().title(Line::styled(title, quiet).alignment(Alignment::Center)),
            )
            .style(app.theme.base())
            .x_axis(Axis::default().bounds([0.0, end]).labels(times).style(quiet))
            .y_axis(Axis::default().bounds([0.0, top]).labels(levels).style(quiet))
            .legend_position(None);
        frame.render_widget(chart, area);
    }
}
