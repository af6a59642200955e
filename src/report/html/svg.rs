//! Charts drawn as SVG.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::report::language::phrase;
use crate::report::palette::Role;
use crate::report::parts::{Axis, Chart, Scale, SeriesKind};
use crate::units;

/// Width and height [px].
const SIZE: (u32, u32) = (420, 220);

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// A chart as SVG; `None` where the chart cannot be drawn.
pub fn svg(chart: &Chart) -> Option<String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(chart, &area).ok()?;
        area.present().ok()?;
    }
    Some(text)
}

/// Colour of a role on paper.
pub fn color(role: Role) -> RGBColor {
    let [red, green, blue] = role.on_light();
    RGBColor(red, green, blue)
}

fn draw(chart: &Chart, area: &DrawingArea<SVGBackend, Shift>) -> Drawn {
    let ([left, right], [bottom, top]) = (chart.x.ends(), chart.y.ends());
    let right = right.max(left + f64::MIN_POSITIVE);
    let mut canvas = ChartBuilder::on(area)
        .caption(caption(chart), ("sans-serif", 14))
        .margin(6)
        .margin_right(12)
        .x_label_area_size(28)
        .y_label_area_size(48)
        .build_cartesian_2d(left..right, bottom..top)?;
    let mark = |axis: Axis| move |coordinate: &f64| label(axis, *coordinate);
    let [x_mark, y_mark] = [chart.x, chart.y].map(mark);
    let x_name = chart.x.label();
    canvas
        .configure_mesh()
        .disable_mesh()
        .x_labels(6)
        .y_labels(5)
        .x_desc(x_name.as_str())
        .x_label_formatter(&x_mark)
        .y_label_formatter(&y_mark)
        .draw()?;
    let [limit, firing] = [Role::Fail, Role::Thin].map(color);
    // The curve has the colour of no verdict, as on the screens.
    let curve = RGBColor(20, 20, 20);
    let planned = RGBColor(150, 150, 150);
    for [from, to] in &chart.windows {
        let corners = [(chart.x.coordinate(*from), bottom), (chart.x.coordinate(*to), top)];
        canvas.draw_series([Rectangle::new(corners, planned.mix(0.2).filled())])?;
    }
    for &at in &chart.firings {
        let (at, end) = (chart.x.coordinate(at), bottom + 0.06 * (top - bottom));
        canvas.draw_series(LineSeries::new([(at, bottom), (at, end)], firing.stroke_width(2)))?;
    }
    if let Some(value) = chart.limit.map(|limit| chart.y.coordinate(limit)) {
        let ends = [(left, value), (right, value)];
        canvas.draw_series(DashedLineSeries::new(ends, 5, 4, limit.stroke_width(1)))?;
    }
    let many = chart.series.iter().filter(|series| !series.points.is_empty()).count() > 1;
    let in_time = chart.series.iter().any(|series| series.kind == SeriesKind::Planned);
    for series in &chart.series {
        let points = || series.points.iter().map(|&(x, y)| (chart.x.coordinate(x), chart.y.coordinate(y)));
        let color = match series.kind {
            SeriesKind::Curve => curve,
            SeriesKind::Comparison => limit,
            SeriesKind::Planned | SeriesKind::Low | SeriesKind::High => planned,
            SeriesKind::Points => firing,
        };
        if series.kind == SeriesKind::Points {
            canvas.draw_series(points().map(|point| Circle::new(point, 3, color.filled())))?;
        } else {
            let line = LineSeries::new(points(), color.stroke_width(1));
            let drawn = canvas.draw_series(line.point_size(if many && !in_time { 2 } else { 0 }))?;
            if many {
                drawn
                    .label(phrase(series.name))
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 12, y)], color.stroke_width(2)));
            }
        }
        let beyond =
            |value: f64| series.kind == SeriesKind::Curve && chart.limit.is_some_and(|limit| value > limit);
        for run in series.points.chunk_by(|a, b| beyond(a.1) == beyond(b.1)).filter(|run| beyond(run[0].1)) {
            let run = run.iter().map(|&(x, y)| (chart.x.coordinate(x), chart.y.coordinate(y)));
            canvas.draw_series(LineSeries::new(run, limit.stroke_width(2)).point_size(1))?;
        }
    }
    if many {
        canvas.configure_series_labels().background_style(WHITE).draw()?;
    }
    Ok(())
}

/// Name of the vertical axis with its unit, with a capital letter.
fn caption(chart: &Chart) -> String {
    let name = chart.y.label();
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Text of a number at an axis.
fn label(axis: Axis, coordinate: f64) -> String {
    match axis.scale {
        Scale::Linear => units::short(coordinate),
        Scale::Logarithmic => axis.mark(coordinate),
    }
}

/// Several charts below each other, as one SVG.
pub fn stack_charts(charts: &[String]) -> String {
    if let [chart] = charts {
        return chart.clone();
    }
    let (width, height) = (SIZE.0, SIZE.1 * charts.len() as u32);
    let placed: String = charts
        .iter()
        .enumerate()
        .map(|(n, chart)| format!("<g transform=\"translate(0 {})\">{chart}</g>\n", SIZE.1 * n as u32))
        .collect();
    format!(
        "<svg width=\"{width}\" height=\"{height}\" xmlns=\"http://www.w3.org/2000/svg\">\n{placed}</svg>\n"
    )
}
