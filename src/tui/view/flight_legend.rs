//! The legend of the flight from above. Also counts how many of the pulling cables are visible: the signs of tires cover cables that are
//! short on the screen.

use std::collections::HashSet;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::Line;
use unicode_width::UnicodeWidthStr;

use super::map_numbers::LEFT;
use crate::tui::app::App;

/// Least height of a view with a line for its legend.
const LEGEND_FROM: u16 = 8;

/// A cell of the screen: column and row.
pub type ScreenCell = (u16, u16);

/// Number of cables, each given by the cells of its ends, with a cell that no tire covers. Cables that lie over one another count once.
pub fn count_seen(
    cables: impl IntoIterator<Item = [ScreenCell; 2]>,
    tires: impl IntoIterator<Item = ScreenCell>,
) -> usize {
    let in_order = |[a, b]: [ScreenCell; 2]| if a <= b { [a, b] } else { [b, a] };
    let cables: HashSet<[ScreenCell; 2]> = cables.into_iter().map(in_order).collect();
    let tires: HashSet<ScreenCell> = tires.into_iter().collect();
    cables.into_iter().filter(|&ends| cells_between(ends).any(|cell| !tires.contains(&cell))).count()
}

/// The cells of a straight line between its ends, without the ends.
fn cells_between([from, to]: [ScreenCell; 2]) -> impl Iterator<Item = ScreenCell> {
    let steps = from.0.abs_diff(to.0).max(from.1.abs_diff(to.1));
    let between = move |a: u16, b: u16, n: u16| {
        let part = f64::from(n) / f64::from(steps);
        (f64::from(a) + part * (f64::from(b) - f64::from(a))).round() as u16
    };
    (1..steps).map(move |n| (between(from.0, to.0, n), between(from.1, to.1, n)))
}

/// The areas of the view from above and of its legend. The legend has height 0 if the view needs the line.
pub fn split(area: Rect) -> [Rect; 2] {
    let legend = u16::from(area.height >= LEGEND_FROM);
    Layout::vertical([Constraint::Min(0), Constraint::Length(legend)]).areas(area)
}

/// Draws the legend of the view from above, as much as fits. If fewer cables are `seen` than `taut`, begins with both numbers.
pub fn draw(app: &App, seen: usize, taut: usize, frame: &mut Frame, area: Rect) {
    // Aligned with the tires, not with the numbers of their rows.
    let area = Rect { x: area.x + LEFT - 1, width: area.width.saturating_sub(LEFT - 1), ..area };
    let width = usize::from(area.width);
    let signs = ["▃ to █ limit", "^ highest"];
    let others = ["◆ hardest", "double ✗: over limit", "arrow or * fires"];
    let legend = |entries: &[&str]| format!(" {}", entries.join(" · "));
    let counts = match seen < taut {
        true => [
            format!("lines: {seen} of {taut} taut cables seen"),
            format!("{seen} of {taut} taut seen"),
            format!("{seen}/{taut} seen"),
        ],
        false => [const { String::new() }; 3],
    };
    let fits = |count: &&String| legend(&[count.as_str(), signs[0], signs[1]]).width() <= width;
    let count = counts.iter().find(fits).unwrap_or(&counts[2]);
    let entries: Vec<&str> = match seen < taut {
        true => [count.as_str()].into_iter().chain(signs).chain(["o ground"]).chain(others).collect(),
        false => ["o ground"].into_iter().chain(signs).chain(["lines: taut cables"]).chain(others).collect(),
    };
    // The limit also judges the damping force, which the lines leave out.
    let is_damped = app.case.plan.cable.damping_percent > 0.0;
    let entries: Vec<&str> =
        is_damped.then_some("lines: pull without damping").into_iter().chain(entries).collect();
    let fits = |&shown: &usize| legend(&entries[..shown]).width() <= width;
    let shown = (1..=entries.len()).rev().find(fits).unwrap_or(0);
    frame.render_widget(Line::styled(legend(&entries[..shown]), app.theme.muted()), area);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cable_is_seen_between_the_signs_of_its_tires() {
        let tires = [(0, 0), (2, 0), (4, 0), (0, 1), (2, 1)];
        let seen = |cables: &[[ScreenCell; 2]]| count_seen(cables.iter().copied(), tires);
        assert_eq!(seen(&[[(0, 0), (0, 1)]]), 0, "neighbours");
        assert_eq!(seen(&[[(0, 0), (2, 0)], [(0, 0), (2, 1)]]), 2);
        assert_eq!(seen(&[[(0, 0), (2, 0)], [(2, 0), (0, 0)]]), 1, "one over the other");
        assert_eq!(seen(&[[(2, 0), (2, 0)]]), 0, "seen from its end");
    }
}
