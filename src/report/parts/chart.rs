//! A chart: series over two axes, before anybody knows how wide it is drawn.

use crate::units::Unit;

/// Series over two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What is drawn: `flight height against the interval`.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Drawn in this order.
    pub series: Vec<Series>,
    /// Limit of the quantity on the vertical axis.
    pub limit: Option<f64>,
    /// Ranges of the horizontal axis that are marked, and what they are.
    pub windows: Vec<[f64; 2]>,
    /// What the marked ranges are, for the key: no pass of them is proven.
    pub windows_are: &'static str,
    /// Firing times, on the horizontal axis.
    pub firings: Vec<f64>,
}

/// An axis; its numbers are SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Quantity.
    pub name: &'static str,
    /// Unit in which people read it.
    pub unit: Unit,
    /// Even distances or even ratios.
    pub scale: Scale,
    /// Both ends; powers of ten where the scale is logarithmic.
    pub range: [f64; 2],
}

/// How numbers lie on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// At even distances.
    Linear,
    /// At even ratios.
    Logarithmic,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in a legend.
    pub name: &'static str,
    /// What the points are.
    pub kind: SeriesKind,
    /// Values on the horizontal and on the vertical axis.
    pub points: Vec<(f64, f64)>,
}

/// What the points of a series are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// The quantity that the chart is about: a line.
    Curve,
    /// What the curve is compared with: a line.
    Comparison,
    /// The shot as planned behind the one that decides: a line.
    Planned,
    /// The lower end of the band of nine in ten shots: a line.
    Low,
    /// Its upper end: a line.
    High,
    /// Single results: points.
    Points,
}
