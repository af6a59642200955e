//! Cables between tires at rest, drawn with line signs, if the tires stand far enough apart.
//!
//! ```text
//! o───o═══o
//! │ ╳ │ ╲ ║
//! o───o───o
//! ```

use ratatui::buffer::Buffer;
use ratatui::style::{Modifier, Style};

use crate::sorting::sort_by;

/// A cell of the terminal: column and line.
type At = (u16, u16);

/// A cable to draw.
pub struct Strand {
    /// The cells of its tires.
    pub ends: [At; 2],
    pub style: Style,
    /// Force as a share of the limit. Cables with a greater share are drawn over others.
    pub share: f64,
    /// Whether the cable is a double or bold line, so that color is not the only sign.
    pub is_double: bool,
}

impl Strand {
    /// The cells between the tires, each with its sign. A slanted cable between neighboring lines has none.
    fn cells(&self) -> impl Iterator<Item = (At, &'static str)> {
        let [(mut x1, mut y1), (mut x2, mut y2)] = self.ends;
        if (y1, x1) > (y2, x2) {
            ((x1, y1), (x2, y2)) = ((x2, y2), (x1, y1));
        }
        let [across, down] = [i32::from(x2) - i32::from(x1), i32::from(y2 - y1)];
        let sign = match (across, down, self.is_double) {
            (_, 0, false) => "─",
            (_, 0, true) => "═",
            (0, _, false) => "│",
            (0, _, true) => "║",
            (1.., ..) => "╲",
            _ => "╱",
        };
        let steps = if down == 0 { across } else { down };
        (1..steps).map(move |step| {
            // Rounded down, so that crossing cables share a cell.
            let part = |whole: i32| (whole * step).div_euclid(steps);
            let (x, y) = (i32::from(x1) + part(across), i32::from(y1) + part(down));
            ((x as u16, y as u16), sign)
        })
    }

    /// Whether the cable has at least one cell.
    fn has_room(&self) -> bool {
        self.cells().next().is_some()
    }
}

/// Draws the cables into empty cells. If one cable has no cell, draws none: a part of the cables would be another shelter. Returns whether
/// it drew.
pub fn draw(mut strands: Vec<Strand>, buffer: &mut Buffer) -> bool {
    if !strands.iter().all(Strand::has_room) {
        return false;
    }
    sort_by(&mut strands, |a, b| a.share.total_cmp(&b.share));
    for strand in &strands {
        for (at, sign) in strand.cells() {
            let Some(cell) = buffer.cell_mut(at) else { continue };
            let sign = match (cell.symbol(), sign) {
                ("╱" | "╳", "╲") | ("╲" | "╳", "╱") => "╳",
                (" " | "─" | "═" | "│" | "║" | "╱" | "╲", sign) => sign,
                _ => continue,
            };
            // There is no double sign for a slanted line.
            let weight = if strand.is_double { Modifier::BOLD } else { Modifier::empty() };
            cell.set_symbol(sign).set_style(strand.style.add_modifier(weight));
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;

    fn drawn(width: u16, strands: &[([At; 2], f64)]) -> Option<Vec<String>> {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, 3));
        let strand = |&(ends, share): &([At; 2], f64)| Strand {
            ends,
            style: Style::new(),
            share,
            is_double: share > 0.8,
        };
        let is_drawn = draw(strands.iter().map(strand).collect(), &mut buffer);
        let line = |y: u16| (0..width).map(|x| buffer[(x, y)].symbol()).collect();
        is_drawn.then(|| (0..3).map(line).collect())
    }

    #[test]
    fn cables_are_lines_that_cross_and_the_harder_pull_is_double() {
        let square = [
            ([(0, 0), (4, 0)], 0.9),
            ([(0, 2), (4, 2)], 0.1),
            ([(0, 0), (0, 2)], 0.0),
            ([(4, 2), (4, 0)], 0.9),
            ([(0, 0), (4, 2)], 0.5),
            ([(0, 2), (4, 0)], 0.0),
        ];
        assert_eq!(drawn(5, &square).expect("room"), [" ═══ ", "│ ╳ ║", " ─── "]);
        let narrow = [([(0, 0), (3, 2)], 0.0), ([(0, 2), (3, 0)], 0.0)];
        assert_eq!(drawn(4, &narrow).expect("room")[1], " ╳  ", "in one cell of two");
        assert_eq!(drawn(5, &square[4..5]).expect("room")[1], "  ╲  ");
        assert_eq!(drawn(5, &square[5..]).expect("room")[1], "  ╱  ");
    }

    #[test]
    fn no_cable_is_drawn_where_one_has_no_room() {
        assert_eq!(drawn(5, &[([(0, 0), (4, 0)], 0.0), ([(0, 0), (1, 0)], 0.0)]), None);
        assert_eq!(drawn(5, &[([(0, 0), (4, 0)], 0.0), ([(0, 0), (4, 1)], 0.0)]), None);
    }
}
