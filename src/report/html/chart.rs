//! Height and force over time, with limit and firing times, as SVG.

use plotters::prelude::*;

use crate::study::Case;
use crate::study::check::Checked;
use crate::units::Unit;

const SIZE: (u32, u32) = (420, 220);
const CURVE: RGBColor = RGBColor(0, 70, 154);
const LIMIT: RGBColor = RGBColor(160, 48, 0);
const FIRING: RGBColor = RGBColor(110, 110, 110);

/// The charts of one option; a chart that cannot be drawn is left out.
pub fn curves(case: &Case, checked: &Checked, fire_at_ms: &[f64]) -> Vec<String> {
    let (history, limits) = (&checked.history, &case.limits);
    let height = ("Flight height, m", Unit::Metre, &history.height, limits.height);
    let force = ("Cable force, kN", Unit::Kilonewton, &history.force, limits.force);
    [height, force]
        .into_iter()
        .filter_map(|(name, unit, values, limit)| {
            let values: Vec<f64> = values.iter().map(|value| value / unit.size()).collect();
            svg(name, &values, history.width, limit / unit.size(), fire_at_ms).ok()
        })
        .collect()
}

fn svg(
    name: &str,
    values: &[f64],
    width: f64,
    limit: f64,
    fire_at_ms: &[f64],
) -> Result<String, Box<dyn std::error::Error>> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        let end = (values.len() as f64 * width).max(width);
        let top = values.iter().copied().fold(limit, f64::max) * 1.08;
        let mut chart = ChartBuilder::on(&area)
            .caption(name, ("sans-serif", 14))
            .margin(6)
            .x_label_area_size(28)
            .y_label_area_size(42)
            .build_cartesian_2d(0.0..end, 0.0..top)?;
        chart.configure_mesh().disable_mesh().x_labels(6).y_labels(5).x_desc("s").draw()?;
        for ms in fire_at_ms {
            let at = ms * 1e-3;
            chart.draw_series(LineSeries::new([(at, 0.0), (at, 0.06 * top)], FIRING.stroke_width(2)))?;
        }
        chart.draw_series(DashedLineSeries::new(
            [(0.0, limit), (end, limit)],
            5,
            4,
            LIMIT.stroke_width(1),
        ))?;
        let points = values.iter().enumerate().map(|(n, &value)| ((n as f64 + 0.5) * width, value));
        chart.draw_series(LineSeries::new(points, CURVE.stroke_width(1)))?;
        area.present()?;
    }
    Ok(text)
}
