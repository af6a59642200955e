//! A chart as data: series over two axes. The face that draws a chart chooses its width.

use crate::units::Unit;

/// Series over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title: `flight height against the interval`.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Series in the order in which they are drawn.
    pub series: Vec<Series>,
    /// Limit of the quantity on the vertical axis [SI].
    pub limit: Option<f64>,
    /// Marked ranges of the horizontal axis [SI].
    pub windows: Vec<[f64; 2]>,
    /// Meaning of the marked ranges, for the key. No pass of a marked range is proven.
    pub windows_are: &'static str,
    /// Firing times, on the horizontal axis [s].
    pub firings: Vec<f64>,
}

/// An axis. Its numbers are SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Quantity.
    pub name: &'static str,
    /// Unit in which people read it.
    pub unit: Unit,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Both ends. On a logarithmic scale both are powers of ten.
    pub range: [f64; 2],
}

/// How numbers lie on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances for equal differences.
    Linear,
    /// Equal distances for equal ratios.
    Logarithmic,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: &'static str,
    /// Meaning of the points.
    pub kind: SeriesKind,
    /// Points: value on the horizontal axis, value on the vertical axis [SI].
    pub points: Vec<(f64, f64)>,
}

/// Meaning of the points of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// The quantity of the chart: a line.
    Curve,
    /// A comparison for the curve: a line.
    Comparison,
    /// The planned shot, drawn behind the deciding shot: a line.
    Planned,
    /// Lower end of the band that holds nine of ten shots: a line.
    Low,
    /// Upper end of that band: a line.
    High,
    /// Single results: points.
    Points,
}
