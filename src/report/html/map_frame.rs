//! Surroundings of the top view of the shelter: row numbers and column numbers at the edges, a scale bar and a legend.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::report::language::phrase;
use crate::scene::Scene;
use crate::units;

/// Area in which a picture is drawn.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Result of drawing.
pub type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Width of a picture [px].
const WIDTH: f64 = 720.0;
/// Greatest height of the shelter in a picture [px].
const TALLEST: f64 = 430.0;
/// Room left of the shelter, for the row numbers, and right of it [px].
const BESIDE: f64 = 60.0;
/// Room above the shelter [px].
const ABOVE: f64 = 34.0;
/// Room below the shelter, for the column numbers, the scale bar and the legend [px].
const BELOW: f64 = 40.0;
/// Height of a line of the legend [px].
const LINE: i32 = 22;
/// Legend items per line.
const IN_LINE: usize = 2;
/// Least distance between two numbers at an edge [px].
const LEAST_DISTANCE: f64 = 22.0;
/// Greatest length of the scale bar, as a share of the width between both margins.
const LONGEST_BAR: f64 = 0.25;
const INK: RGBColor = RGBColor(60, 60, 60);

/// Maps the ground onto a picture.
pub struct Frame {
    /// Pixels per metre.
    pub scale: f64,
    /// Width and height [px].
    pub size: (u32, u32),
    /// Left edge of the shelter [m].
    left: f64,
    /// Upper edge of the shelter [m].
    top: f64,
    /// Lower edge of the shelter [px].
    bottom: i32,
    /// Left edge of the shelter [px].
    left_at: i32,
}

impl Frame {
    /// The frame of a shelter, of `holes`, which may lie beside the shelter [m], and of a legend with so many `items`.
    pub fn new(scene: &Scene, holes: impl Iterator<Item = Vector2<f64>> + Clone, items: usize) -> Self {
        let [[left, right], [bottom, top]] = [0, 1].map(|axis| {
            let [from, to] = scene.extent(axis);
            let along = || holes.clone().map(|hole| hole[axis]);
            [along().fold(from, f64::min), along().fold(to, f64::max)]
        });
        let (wide, high) = ((right - left).max(1.0), (top - bottom).max(1.0));
        let scale = ((WIDTH - 2.0 * BESIDE) / wide).min(TALLEST / high);
        let lower = ABOVE + (top - bottom) * scale;
        // The shelter stands in the middle of the picture, also a tall one.
        let left_at = (WIDTH - (right - left) * scale) / 2.0;
        let lines = 1 + items.div_ceil(IN_LINE);
        let height = lower + BELOW + f64::from(lines as i32 * LINE);
        let size = (WIDTH as u32, height as u32);
        Self { scale, size, left: left - left_at / scale, top, bottom: lower as i32, left_at: left_at as i32 }
    }

    /// Place of a point of the ground [m] in the picture [px].
    pub fn at(&self, x: f64, y: f64) -> (i32, i32) {
        (((x - self.left) * self.scale) as i32, (ABOVE + (self.top - y) * self.scale) as i32)
    }

    /// Draws row numbers at the left edge and column numbers at the lower edge. A list of tires has no numbers.
    pub fn draw_numbers(&self, area: &Area<'_>, scene: &Scene, radius: i32) -> Drawn {
        let [rows, columns] = scene.rows_and_columns();
        let rows: BTreeMap<i64, i32> = rows.into_iter().map(|(row, y)| (row, self.at(0.0, y).1)).collect();
        let columns: BTreeMap<i64, i32> =
            columns.into_iter().map(|(column, x)| (column, self.at(x, 0.0).0)).collect();
        if rows.is_empty() {
            return Ok(());
        }
        let beside = self.left_at - radius - 8;
        let below = self.bottom + radius + 6;
        let right = ink(13).pos(Pos::new(HPos::Right, VPos::Center));
        let middle = ink(13).pos(Pos::new(HPos::Center, VPos::Top));
        for (row, at) in thinned(&rows) {
            area.draw(&Text::new(row.to_string(), (beside, at), right.clone()))?;
        }
        for (column, at) in thinned(&columns) {
            area.draw(&Text::new(column.to_string(), (at, below), middle.clone()))?;
        }
        let highest = rows.values().copied().min().unwrap_or_default();
        area.draw(&Text::new(phrase("row"), (beside, highest - 18), right.clone()))?;
        area.draw(&Text::new(phrase("column"), (beside, below + 6), right))?;
        Ok(())
    }

    /// Draws a scale bar of a round length below the shelter.
    pub fn draw_scale_bar(&self, area: &Area<'_>) -> Drawn {
        let length = round_length(LONGEST_BAR * (WIDTH - 2.0 * BESIDE) / self.scale);
        let (x, y) = (BESIDE as i32, self.bottom + BELOW as i32 + LINE / 2);
        let end = x + (length * self.scale) as i32;
        area.draw(&PathElement::new([(x, y), (end, y)], INK.stroke_width(2)))?;
        for at in [x, end] {
            area.draw(&PathElement::new([(at, y - 5), (at, y + 5)], INK.stroke_width(2)))?;
        }
        let style = ink(14).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(format!("{} m", units::short(length)), (end + 8, y), style))?;
        Ok(())
    }

    /// Draws the text of item `n` of the legend; returns the place of its mark [px].
    pub fn draw_item(&self, area: &Area<'_>, n: usize, text: &str) -> Result<(i32, i32), DrawingError> {
        let across = (WIDTH - 2.0 * BESIDE) as i32 / IN_LINE as i32;
        let x = BESIDE as i32 + (n % IN_LINE) as i32 * across;
        let y = self.bottom + BELOW as i32 + (1 + n / IN_LINE) as i32 * LINE + LINE / 2;
        let style = ink(14).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(text, (x + 34, y), style))?;
        Ok((x + 14, y))
    }
}

/// Error of a drawing.
type DrawingError = Box<dyn std::error::Error>;

/// Style of dark letters of a size [px].
fn ink(size: u32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&INK)
}

/// Numbers with their places [px], thinned so that none touches the next. Number 1 always stands.
fn thinned(numbers: &BTreeMap<i64, i32>) -> impl Iterator<Item = (i64, i32)> {
    let ends = numbers.first_key_value().zip(numbers.last_key_value());
    let distance = ends
        .map_or(LEAST_DISTANCE, |((a, from), (b, to))| f64::from((to - from).abs()) / (b - a).max(1) as f64);
    let steps = [1, 2, 5, 10, 20, 50, 100, 200, 500];
    let every = steps.into_iter().find(|every| *every as f64 * distance >= LEAST_DISTANCE).unwrap_or(1000);
    numbers.iter().map(|(number, at)| (*number, *at)).filter(move |(n, _)| (n - 1).rem_euclid(every) == 0)
}

/// The longest of 1, 2, 5, 10, ... and their tenths that does not exceed `most` [m].
fn round_length(most: f64) -> f64 {
    let power = 10_f64.powf(most.log10().floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= most);
    factor.unwrap_or(1.0) * power
}
