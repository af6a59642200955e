//! The shelter from the side: tires as bars, the paths of the highest tires, the pulling cables, the ground and the limit.

use std::collections::BTreeMap;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{Canvas, Line as Stroke, Points};
use unicode_width::UnicodeWidthStr;

use super::from_above::{draw_cable, sign};
use super::map_numbers;
use super::widgets::{color, titled_block};
use crate::sorting::sorted_by;
use crate::study::flight::{Flight, GROUND};
use crate::tui::app::App;
use crate::units::{self, Unit};

/// Number of tires whose path is drawn: the highest ones.
const TRAILS: usize = 10;

/// The title of the side view, at most `width` cells: the stretch of the heights, the number of taut cables, and of cables over the limit.
/// The number over the limit is never dropped.
fn side_title(from: &str, [taut, over]: [usize; 2], scale: &str, width: usize) -> String {
    let few = match taut {
        0 => "no cable pulls".to_owned(),
        1 => "1 cable taut".to_owned(),
        _ => format!("{taut} cables taut"),
    };
    let limit = if over > 0 { format!(", {over} over the limit") } else { String::new() };
    let sign = if over > 0 { " (double lines)" } else { "" };
    let titles = [
        format!("{from}, {few}, heights drawn {scale} times{limit}{sign}"),
        format!("{from}, heights drawn {scale} times{limit}{sign}"),
        format!("{from}, heights drawn {scale} times{limit}"),
        format!("{from}, {few}{limit}"),
        format!("{few}{limit}"),
    ];
    let fits = |title: &String| title.width() + 2 <= width;
    titles.into_iter().find(fits).unwrap_or_else(|| format!("{taut} taut{limit}"))
}

/// Draws tires from the side at a time [s], with the paths of the highest tires, the pulling cables, the ground and the limit. Without a
/// `title`, the title states the direction of view and the number of pulling cables.
pub fn draw(
    app: &App,
    flight: &Flight,
    time: f64,
    forces: &[f64],
    title: Option<String>,
    frame: &mut Frame,
    area: Rect,
) {
    let (scene, theme, axis) = (&flight.scene, app.theme, usize::from(app.player.along_rows));
    let [left, right] = scene.extent(axis);
    let margin = 0.03 * (right - left).max(1.0);
    let numbers = u16::from(area.height >= WITH_NUMBERS && map_numbers::are_known(scene));
    let [area, below] = Layout::vertical([Constraint::Min(0), Constraint::Length(numbers)]).areas(area);
    let limit = app.case.limits.height;
    let top = flight.outcome.height.value.max(limit) * 1.1;
    let frame_of = flight.at(time);
    let position = |tire: usize| {
        let u = frame_of[tire];
        (scene.position[tire][axis] + f64::from(u[axis]), f64::from(u[2]))
    };
    let aloft = |tire: usize| frame_of[tire][2] > GROUND;
    let tires: Vec<(f64, f64)> = (0..scene.tire_count()).map(position).collect();
    let (flying, lying): (Vec<usize>, Vec<usize>) = (0..scene.tire_count()).partition(|&tire| aloft(tire));
    let lying: Vec<(f64, f64)> = lying.into_iter().map(|tire| tires[tire]).collect();
    let highest = sorted_by(&flying, |&&a, &&b| tires[b].1.total_cmp(&tires[a].1)).into_iter().take(TRAILS);
    let way = |&tire: &usize| {
        let place = move |u: [f32; 3]| (scene.position[tire][axis] + f64::from(u[axis]), f64::from(u[2]));
        flight.path(tire, time).map(place)
    };
    let trails: Vec<(f64, f64)> = highest.flat_map(way).collect();
    let from = if axis == 0 { "across rows" } else { "along rows" };
    // A terminal cell is about twice as high as wide.
    let cells = [f64::from(area.width.max(1)), 2.0 * f64::from(area.height.saturating_sub(1).max(1))];
    let higher = (right - left + 2.0 * margin) / cells[0] / (1.03 * top / cells[1]);
    let dot = [(right - left + 2.0 * margin) / (2.0 * cells[0]), 1.03 * top / (2.0 * cells[1])];
    let scale = units::rounded(higher, if higher < 10.0 { 1 } else { 0 });
    let count = |least: f64| forces.iter().filter(|force| **force > least).count();
    let (taut, over) = (count(0.0), count(app.case.limits.force));
    let pulling: Vec<([usize; 2], f64)> = scene
        .cables
        .iter()
        .zip(forces)
        .map(|(cable, force)| (cable.ends, *force))
        .filter(|(ends, force)| *force > 0.0 && ends.iter().any(|&end| aloft(end)))
        .collect();
    let [x_bounds, y_bounds] = [[left - margin, right + margin], [-0.03 * top, top]];
    let title = title.unwrap_or_else(|| side_title(from, [taut, over], &scale, area.width.into()));
    let block = titled_block(app, title);
    let view = block.inner(area);
    let canvas = Canvas::default()
        .block(block)
        .background_color(theme.base().bg.unwrap_or(Color::Reset))
        .marker(Marker::Braille)
        .x_bounds(x_bounds)
        .y_bounds(y_bounds)
        .paint(|context| {
            let stroke = |(x1, y1), (x2, y2), color| Stroke { x1, y1, x2, y2, color };
            let (from, to) = (left - margin, right + margin);
            context.draw(&stroke((from, 0.0), (to, 0.0), color(theme.muted())));
            context.draw(&Points { coords: &trails, color: color(theme.muted()) });
            context.layer();
            for (ends, force) in &pulling {
                draw_cable(app, *force, ends.map(|end| tires[end]), dot, context);
            }
            context.layer();
            context.draw(&stroke((from, limit), (to, limit), color(theme.limit_line())));
            // Draw the label of the peak only if it does not collide with the limit or the ground.
            let peak = flight.outcome.height.value;
            if (peak - limit).abs() > 4.0 * dot[1] && peak > 4.0 * dot[1] {
                let label = format!("^ {} m", units::significant(peak, Unit::Metre, 3));
                let start = to - 2.0 * dot[0] * label.width() as f64;
                context.print(start, peak, Span::styled(label, theme.muted()));
            }
        });
    frame.render_widget(canvas, area);
    let flying = flying.into_iter().map(|tire| tires[tire]);
    let spacing = scene.cables.iter().map(|cable| {
        let [one, other] = cable.ends.map(|end| scene.position[end][axis]);
        (one - other).abs()
    });
    let spacing = spacing.filter(|apart| *apart > 1e-6).fold(right - left, f64::min);
    let view = SideView { view, bounds: [x_bounds, y_bounds] };
    let count = view.cells(app.case.plan.tire.outer_diameter_m).ceil().min(view.cells(spacing).floor() - 1.0);
    let wide = count.clamp(1.0, WIDEST);
    let resting = lying.into_iter().map(|(across, _)| (across, 0.0));
    view.draw_tires(resting, wide, |_| theme.curve(), frame);
    view.draw_tires(flying, wide, |height| sign(app, height as f32).1, frame);
    let [rows, columns] = scene.rows_and_columns();
    view.number(if axis == 0 { columns } else { rows }, theme.muted(), below, frame);
    let label = format!("limit {} m", units::significant(limit, Unit::Metre, 3));
    view.print(limit, &label, theme.limit_line(), frame);
}

/// Least height of a view with the numbers of columns or rows below it.
const WITH_NUMBERS: u16 = 9;
/// Most cells of a tire seen from the side.
const WIDEST: f64 = 5.0;

/// A view from the side: its cells, and the ends [m] across and up.
struct SideView {
    view: Rect,
    bounds: [[f64; 2]; 2],
}

impl SideView {
    /// A length across [m] in cells.
    fn cells(&self, length: f64) -> f64 {
        let [left, right] = self.bounds[0];
        length / (right - left) * f64::from(self.view.width)
    }

    /// Writes the numbers of columns or rows below their places across [m], as many as fit.
    fn number(&self, places: BTreeMap<i64, f64>, style: Style, below: Rect, frame: &mut Frame) {
        let mut free = below.x;
        for (number, across) in places {
            let text = number.to_string();
            let x = below.x + self.cells(across - self.bounds[0][0]) as u16;
            if below.height > 0 && x >= free && usize::from(x) + text.len() <= usize::from(below.right()) {
                free = x + text.len() as u16 + 1;
                frame.buffer_mut().set_string(x, below.y, text, style);
            }
        }
    }

    /// Prints a text at the left at height `up` [m], in the row that a canvas would use. Prints nothing if a tire is there, so that neither
    /// hides the other.
    fn print(&self, up: f64, text: &str, style: Style, frame: &mut Frame) {
        let Self { view, bounds: [_, [bottom, top]] } = *self;
        let row = ((top - up) / (top - bottom) * f64::from(view.height.saturating_sub(1))) as u16;
        let line =
            Rect { y: view.y + row, height: 1, width: text.width() as u16, x: view.x }.intersection(view);
        let is_tire =
            |at| frame.buffer_mut().cell(at).is_some_and(|cell| ["▀", "▄", "█"].contains(&cell.symbol()));
        if !line.positions().any(is_tire) {
            frame.render_widget(Line::styled(text, style), line);
        }
    }

    /// Draws tires as bars at their places across and up [m], `count` cells wide and half a cell high. If two tires share a half cell, the
    /// higher one is drawn.
    fn draw_tires(
        &self,
        tires: impl Iterator<Item = (f64, f64)>,
        count: f64,
        style: impl Fn(f64) -> Style,
        frame: &mut Frame,
    ) {
        let Self { view, bounds: [[left, _], [bottom, top]] } = *self;
        if view.is_empty() {
            return;
        }
        let halves = 2.0 * f64::from(view.height);
        let mut drawn: BTreeMap<(u16, u16), [Option<Style>; 2]> = BTreeMap::new();
        for (across, up) in sorted_by(tires, |(_, one), (_, other)| one.total_cmp(other)) {
            let first = (self.cells(across - left) - 0.5 * count).round();
            let half = ((top - up) / (top - bottom) * halves).floor().clamp(0.0, halves - 1.0) as u16;
            for x in (0..count as u16).map(|n| first + f64::from(n)) {
                if (0.0..f64::from(view.width)).contains(&x) {
                    let cell = drawn.entry((view.x + x as u16, view.y + half / 2)).or_default();
                    cell[usize::from(half % 2)] = Some(style(up));
                }
            }
        }
        for ((x, y), halves) in drawn {
            let (sign, style) = match halves {
                [Some(one), Some(other)] if one != other => {
                    // Without colors, both halves are one full cell.
                    other.fg.map_or(("█", one), |lower| ("▀", one.bg(lower)))
                }
                [Some(both), Some(_)] => ("█", both),
                [Some(upper), None] => ("▀", upper),
                [None, Some(lower)] => ("▄", lower),
                [None, None] => continue,
            };
            frame.buffer_mut().set_string(x, y, sign, style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cables_over_the_limit_are_told_at_every_width() {
        let title = |over, width| side_title("across rows", [37, over], "5.4", width);
        for width in 28..=120 {
            let told = title(2, width);
            assert!(told.ends_with(", 2 over the limit") || told.ends_with("limit (double lines)"), "{told}");
            assert!(told.width() + 2 <= width, "{width}: {told}");
        }
        assert_eq!(title(0, 60), "across rows, 37 cables taut, heights drawn 5.4 times");
        assert_eq!(title(0, 40), "across rows, heights drawn 5.4 times");
        assert_eq!(title(0, 32), "across rows, 37 cables taut");
        assert_eq!(title(0, 28), "37 cables taut");
        assert_eq!(side_title("along rows", [0; 2], "2", 30), "along rows, no cable pulls");
    }
}
