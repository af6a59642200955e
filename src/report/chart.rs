//! Charts as SVG: quantities over time or against the interval, with their limit; errors against time spent.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::choice::Method;
use crate::outcome::History;
use crate::study::Case;
use crate::study::accuracy::{Measured, Study};
use crate::study::sweep::{Point, Sweep};
use crate::units::Unit;

const SIZE: (u32, u32) = (420, 220);
const CURVE: RGBColor = RGBColor(0, 70, 154);
const LIMIT: RGBColor = RGBColor(160, 48, 0);
const FIRING: RGBColor = RGBColor(110, 110, 110);

type Drawn = Result<(), Box<dyn std::error::Error>>;

/// One quantity against one other.
struct Panel {
    name: &'static str,
    across: &'static str,
    range: [f64; 2],
    curve: Vec<(f64, f64)>,
    limit: f64,
    /// Firing times.
    marks: Vec<f64>,
    /// Stretches that pass.
    windows: Vec<[f64; 2]>,
}

/// Height and force over time, one chart each; a chart that cannot be drawn is left out.
pub fn history(case: &Case, history: &History, fire_at_s: &[f64]) -> Vec<String> {
    let panel = |name, unit: Unit, values: &[f64], limit: f64| Panel {
        name,
        across: "s",
        range: [0.0, (values.len() as f64 * history.width).max(history.width)],
        curve: values
            .iter()
            .enumerate()
            .map(|(n, value)| ((n as f64 + 0.5) * history.width, value / unit.size()))
            .collect(),
        limit: limit / unit.size(),
        marks: fire_at_s.to_vec(),
        windows: Vec::new(),
    };
    let height = panel(HEIGHT, Unit::Metre, &history.height, case.limits.height);
    let force = panel(FORCE, Unit::Kilonewton, &history.force, case.limits.force);
    [height, force].iter().filter_map(|panel| svg(&|area| panel.draw(area))).collect()
}

/// Height and force against the interval between rows, one chart each.
pub fn sweep(case: &Case, sweep: &Sweep) -> Vec<String> {
    let panel = |name, unit: Unit, of: fn(&Point) -> f64, limit: f64| Panel {
        name,
        across: "interval, ms",
        range: sweep.range().map(|interval| interval * 1e3),
        // A run that failed has no value.
        curve: sweep
            .points
            .iter()
            .filter(|point| of(point).is_finite())
            .map(|point| (point.interval * 1e3, of(point) / unit.size()))
            .collect(),
        limit: limit / unit.size(),
        marks: Vec::new(),
        windows: sweep.windows().iter().map(|window| window.map(|interval| interval * 1e3)).collect(),
    };
    let height = panel(HEIGHT, Unit::Metre, |point| point.envelope.height.value, case.limits.height);
    let force = panel(FORCE, Unit::Kilonewton, |point| point.envelope.force.value, case.limits.force);
    [height, force].iter().filter_map(|panel| svg(&|area| panel.draw(area))).collect()
}

const HEIGHT: &str = "Flight height, m";
const FORCE: &str = "Cable force, kN";

impl Panel {
    fn draw(&self, area: &DrawingArea<SVGBackend, Shift>) -> Drawn {
        let [from, to] = self.range;
        let end = to.max(from + f64::MIN_POSITIVE);
        let top = self.curve.iter().map(|(_, value)| *value).fold(self.limit, f64::max) * 1.08;
        let mut chart = ChartBuilder::on(area)
            .caption(self.name, ("sans-serif", 14))
            .margin(6)
            .x_label_area_size(28)
            .y_label_area_size(42)
            .build_cartesian_2d(from..end, 0.0..top)?;
        chart.configure_mesh().disable_mesh().x_labels(6).y_labels(5).x_desc(self.across).draw()?;
        for [from, to] in &self.windows {
            chart.draw_series([Rectangle::new([(*from, 0.0), (*to, top)], CURVE.mix(0.12).filled())])?;
        }
        for &at in &self.marks {
            chart.draw_series(LineSeries::new([(at, 0.0), (at, 0.06 * top)], FIRING.stroke_width(2)))?;
        }
        let limit = [(from, self.limit), (end, self.limit)];
        chart.draw_series(DashedLineSeries::new(limit, 5, 4, LIMIT.stroke_width(1)))?;
        chart.draw_series(LineSeries::new(self.curve.iter().copied(), CURVE.stroke_width(1)))?;
        Ok(())
    }
}

/// Work and precision: the larger of both errors against the time of a run, both on logarithmic scales.
pub fn accuracy(study: &Study) -> Option<String> {
    let WorkPrecision { series, time, error } = work_precision(study)?;
    svg(&|area| {
        let mut chart = ChartBuilder::on(area)
            .caption("Error, %, against time of a run, ms", ("sans-serif", 14))
            .margin(6)
            .x_label_area_size(28)
            .y_label_area_size(48)
            .build_cartesian_2d(time[0]..time[1], error[0]..error[1])?;
        let power = |exponent: &f64| power(*exponent);
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_labels(6)
            .y_labels(6)
            .x_label_formatter(&power)
            .y_label_formatter(&power)
            .draw()?;
        for ((method, points), color) in series.iter().zip([CURVE, LIMIT]) {
            let name = method.name();
            chart
                .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(1)).point_size(2))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 12, y)], color.stroke_width(2)));
        }
        chart.configure_series_labels().background_style(WHITE).draw()?;
        Ok(())
    })
}

/// Runs by method, coarse to fine: the logarithms to base 10 of their times [ms] and of their larger errors [%], and the
/// decades in which those lie.
pub struct WorkPrecision {
    /// By method.
    pub series: [(Method, Vec<(f64, f64)>); 2],
    /// From and to which power of ten.
    pub time: [f64; 2],
    /// See `time`.
    pub error: [f64; 2],
}

/// All runs of a study that have a time and an error; `None` where none has.
pub fn work_precision(study: &Study) -> Option<WorkPrecision> {
    let of = |method| {
        let runs = study.rows.iter().filter(|row| row.method == method).filter_map(|row| row.result);
        (method, runs.filter_map(|measured| logarithms(&measured)).collect::<Vec<_>>())
    };
    let series = [Method::Verlet, Method::Newmark].map(of);
    let decades = |of: fn(&(f64, f64)) -> f64| {
        let all = series.iter().flat_map(|(_, points)| points).map(of);
        let low = all.clone().reduce(f64::min)?.floor();
        Some([low, all.reduce(f64::max)?.ceil().max(low + 1.0)])
    };
    let (time, error) = (decades(|point| point.0)?, decades(|point| point.1)?);
    Some(WorkPrecision { series, time, error })
}

/// A power of ten, written out.
pub fn power(exponent: f64) -> String {
    format!("{}", 10_f64.powf(exponent) as f32)
}

/// The logarithms to base 10 of a run's time [ms] and of its larger error [%], where they have one.
pub fn logarithms(measured: &Measured) -> Option<(f64, f64)> {
    let wall = (measured.wall.as_secs_f64() * 1e3).log10();
    let error = (measured.height_error.max(measured.force_error) * 100.0).log10();
    (wall.is_finite() && error.is_finite()).then_some((wall, error))
}

fn svg(draw: &dyn Fn(&DrawingArea<SVGBackend, Shift>) -> Drawn) -> Option<String> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(&area).ok()?;
        area.present().ok()?;
    }
    Some(text)
}

/// Several charts below each other as one picture.
pub fn stack(charts: &[String]) -> String {
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
