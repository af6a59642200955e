//! Numbers of the rows and columns of tires beside a map of the shelter.

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::scene::{Scene, TireId};

/// Cells to the left of a map for the row numbers: two digits and a blank.
pub const LEFT: u16 = 3;
/// Least width and height of a map with numbers.
const LEAST_SIZE: (u16, u16) = (24, 6);

/// Whether the tires have rows and columns.
pub fn are_known(scene: &Scene) -> bool {
    !matches!(scene.tire_ids.first(), Some(TireId::Listed(_)))
}

/// The part of an area for the map, with `left` cells beside it for the row numbers. The whole area if the numbers do not fit or the tires
/// have none.
pub fn map_area(scene: &Scene, area: Rect, left: u16) -> Rect {
    if !are_known(scene) || area.width < LEAST_SIZE.0 + left || area.height < LEAST_SIZE.1 + 1 {
        return area;
    }
    Rect { x: area.x + left, y: area.y + 1, width: area.width - left, height: area.height - 1 }
}

/// Draws the numbers around `map`, the [`map_area`] of an area. `cell` gives the cell of a place [m].
pub fn draw(
    scene: &Scene,
    map: Rect,
    area: Rect,
    cell: impl Fn([f64; 2]) -> (u16, u16),
    style: Style,
    buffer: &mut Buffer,
) {
    if map == area {
        return;
    }
    let [rows, columns] = scene.rows_and_columns();
    let edges = |numbers: &BTreeMap<i64, f64>| numbers.values().next().copied().unwrap_or_default();
    let [bottom, left] = [edges(&rows), edges(&columns)];
    let mut last = None;
    for (row, y) in rows {
        let (_, y) = cell([left, y]);
        // Rows that share a line show only the number of the first row.
        if last != Some(y) {
            buffer.set_string(area.x, y, format!("{row:>2}"), style);
        }
        last = Some(y);
    }
    let mut free = area.x;
    for (column, x) in columns {
        let text = column.to_string();
        let (x, _) = cell([x, bottom]);
        // The last number ends with the area.
        let x = x.min(area.right().saturating_sub(text.len() as u16));
        if x >= free {
            buffer.set_string(x, area.y, &text, style);
            free = x + text.len() as u16 + 1;
        }
    }
}
