//! The shelter from above: the cell of each place, and the cables by their force.

use ratatui::Frame;
use ratatui::buffer::Cell;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::Marker;
use ratatui::widgets::canvas::{Canvas, Context, Line as Stroke, Points};

use super::compare::curve;
use super::gauges::EIGHTHS;
use super::lattice::{self, Strand};
use super::map_numbers;
use super::widgets::color;
use crate::plan;
use crate::scene::{Cable, Scene, TireId};
use crate::study::flight::GROUND;
use crate::tui::app::App;
use crate::tui::theme::mark;
use crate::verdict::Verdict;

/// Share of the limit beyond which a force is near the limit.
pub const NEAR_LIMIT: f64 = 0.8;
/// Distance between the dots of a dotted line [finest dots].
const DOTTED: f64 = 4.0;

/// Cells left of the first tires, because a tire may be wider than one cell.
const HALF_TIRE: u16 = 1;

/// The shelter from above, fitted into an area of the screen.
pub struct FromAbove<'s> {
    scene: &'s Scene,
    /// The area with the numbers of rows and columns.
    around: Rect,
    /// The area of the tires.
    inside: Rect,
    /// Left and top end of the map [m].
    left: f64,
    top: f64,
    /// Width and height of a cell [m].
    width: f64,
    height: f64,
}

/// Height of a terminal cell relative to its width, roughly.
const CELL: f64 = 2.0;
/// Largest stretch of a small shelter relative to true scale, so that it fills its view.
const STRETCHED: f64 = 2.0;

impl<'s> FromAbove<'s> {
    /// Fits the shelter of the plan into an area; `None` if the area is too small.
    pub fn fit(app: &'s App, around: Rect) -> Option<Self> {
        let scene = app.case.scene();
        let inside = map_numbers::map_area(scene, around, map_numbers::LEFT + HALF_TIRE);
        let [[left, right], [bottom, top]] = [scene.extent(0), scene.extent(1)];
        let (columns, rows) = (f64::from(inside.width), f64::from(inside.height));
        if columns < 2.0 || rows < 1.0 {
            return None;
        }
        let [least_width, least_height] =
            [(right - left) / (columns - 1.0), (top - bottom) / (rows - 1.0).max(1.0)];
        let to_scale = least_width.max(least_height / CELL).max(1e-9);
        let width = least_width.max(to_scale / STRETCHED);
        let height = least_height.max(CELL * to_scale / STRETCHED);
        let [width, height] = even(&app.case.plan.layout, [width, height]);
        Some(Self { scene, around, inside, left, top, width, height })
    }

    /// The cell of a tire at rest.
    pub fn cell_of(&self, tire: usize) -> (u16, u16) {
        let position = self.scene.position[tire];
        self.cell([position.x, position.y])
    }

    /// Extra cells of a tire on each side of its own cell, to scale, as far as they fit; 0 if the tire would touch its neighbor.
    pub fn half_tire(&self, diameter_m: f64) -> u16 {
        let wide = (diameter_m / self.width).ceil() as u16;
        if wide <= 2 * HALF_TIRE {
            return 0;
        }
        let across = |cable: &Cable| {
            let [(one, _), (other, _)] = cable.ends.map(|end| self.cell_of(end));
            Some(one.abs_diff(other)).filter(|cells| *cells > 0)
        };
        let apart = self.scene.cables.iter().filter_map(across).min().unwrap_or(1);
        (wide.min(apart - 1).saturating_sub(1) / 2).min(HALF_TIRE)
    }

    /// The cells of a tire: its own cell and `half` cells on each side, as far as they lie in the view.
    pub fn cells_of_tire(&self, (x, y): (u16, u16), half: u16) -> impl Iterator<Item = (u16, u16)> {
        let (left, right) = (self.around.left(), self.around.right());
        (x.saturating_sub(half)..=x + half).filter(move |x| (left..right).contains(x)).map(move |x| (x, y))
    }

    /// The cell of a place (x, y) [m].
    fn cell(&self, [x, y]: [f64; 2]) -> (u16, u16) {
        let Self { inside, left, top, width, height, .. } = self;
        let x = ((x - left) / width).round().min(f64::from(inside.width) - 1.0) as u16;
        let y = ((top - y) / height).round().min(f64::from(inside.height) - 1.0) as u16;
        (inside.x + x, inside.y + y)
    }

    /// Draws the pulling cables by their forces [N] (`n_cables`), always the cable `marked`, and the numbers of rows and columns.
    pub fn draw_cables(&self, app: &App, forces: &[f64], marked: usize, frame: &mut Frame) {
        let Self { scene, inside, left, top, width, height, .. } = self;
        let (columns, rows) = (f64::from(inside.width), f64::from(inside.height));
        let place = |tire: usize| (scene.position[tire].x, scene.position[tire].y);
        let ends = |cable: usize| scene.cables.get(cable).map(|cable| cable.ends.map(place));
        let dot = [0.5 * width; 2];
        let canvas = Canvas::default()
            .background_color(app.theme.base().bg.unwrap_or(Color::Reset))
            .marker(Marker::Braille)
            .x_bounds([left - 0.5 * width, left + (columns - 0.5) * width])
            .y_bounds([top - (rows - 0.5) * height, top + 0.5 * height])
            .paint(|context| {
                let pulled = forces.iter().copied().enumerate().filter(|(_, force)| *force > 0.0);
                for (cable, force) in [(marked, 0.0)].into_iter().chain(pulled) {
                    if let Some(ends) = ends(cable) {
                        draw_cable(app, force, ends, dot, context);
                    }
                }
            });
        frame.render_widget(canvas, *inside);
        self.draw_numbers(app, frame);
    }

    /// Draws all cables as a lattice by their forces [N] (`n_cables`), cables without force faintly, and the numbers of rows and columns.
    /// If the lattice does not fit, draws as [`Self::draw_cables`]. Returns whether the lattice fits.
    pub fn draw_lattice(&self, app: &App, forces: &[f64], marked: usize, frame: &mut Frame) -> bool {
        let strand = |(cable, &force): (&Cable, &f64)| {
            let style = if force > 0.0 { cable_style(app, force) } else { app.theme.mesh() };
            let share = force / app.case.limits.force;
            let ends = cable.ends.map(|end| self.cell_of(end));
            Strand { ends, style, share, is_double: share > NEAR_LIMIT }
        };
        let strands = self.scene.cables.iter().zip(forces).map(strand).collect();
        let has_room = lattice::draw(strands, frame.buffer_mut());
        match has_room {
            true => self.draw_numbers(app, frame),
            false => self.draw_cables(app, forces, marked, frame),
        }
        has_room
    }

    /// Draws the numbers of rows and columns.
    fn draw_numbers(&self, app: &App, frame: &mut Frame) {
        let Self { scene, around, inside, .. } = self;
        let cell = |at: [f64; 2]| self.cell(at);
        map_numbers::draw(scene, *inside, *around, cell, app.theme.muted(), frame.buffer_mut());
    }

    /// Marks a cable: a sign in its middle, if the middle is a cell of its own, and its tires. With such a sign, tires drawn as bars stay
    /// unmarked: a reversed bar would show a wrong height.
    pub fn mark_cable(&self, cable: usize, sign: &str, style: Style, frame: &mut Frame) {
        let Some(cable) = self.scene.cables.get(cable) else { return };
        // Rows that share a line show the number of only one row. Show the row of this cable.
        if self.around != self.inside {
            for end in cable.ends {
                let (TireId::Cell { row, .. } | TireId::Border { row, .. }) = self.scene.tire_ids[end] else {
                    continue;
                };
                if row.fract() == 0.0 {
                    let line = self.cell_of(end).1;
                    frame.buffer_mut().set_string(self.around.x, line, format!("{row:>2.0}"), style);
                }
            }
        }
        let ends = cable.ends.map(|end| self.cell_of(end));
        let middle = middle(ends);
        let buffer = frame.buffer_mut();
        let has_sign = !ends.contains(&middle);
        if has_sign {
            buffer.set_string(middle.0, middle.1, sign, style);
        }
        for end in ends {
            let is_height = |cell: &Cell| EIGHTHS.contains(&cell.symbol());
            let cell = buffer.cell_mut(end).filter(|cell| !has_sign || !is_height(cell));
            let Some(cell) = cell else { continue };
            // If the tires of the cable share a cell or are neighbors, the sign replaces the sign of a tire.
            if !has_sign && !is_height(cell) {
                cell.set_symbol(sign);
            }
            cell.modifier.insert(Modifier::REVERSED);
        }
    }

    /// Draws the sign of a fail in the middle of each cable whose force [N] exceeds the limit, if the middle is a cell of its own.
    pub fn mark_past_limit(&self, app: &App, forces: &[f64], frame: &mut Frame) {
        let past = forces.iter().enumerate().filter(|(_, force)| **force > app.case.limits.force);
        for cable in past.filter_map(|(cable, _)| self.scene.cables.get(cable)) {
            let ends = cable.ends.map(|end| self.cell_of(end));
            let middle = middle(ends);
            if !ends.contains(&middle) {
                let style = app.theme.limit().add_modifier(Modifier::REVERSED);
                frame.buffer_mut().set_string(middle.0, middle.1, mark(Verdict::Fail), style);
            }
        }
    }
}

/// A tire on the ground: left rim, middle, right rim. Rims are drawn if the tire is three cells wide.
pub const ON_GROUND: [&str; 3] = ["(", "o", ")"];
/// Signs for heights of one to eight eighths of the limit.
/// The smallest signs are as high as a letter; lower signs would look like the ground.
const LEVELS: [&str; 8] = ["▃", "▃", "▃", "▄", "▅", "▆", "▇", "█"];

/// Sign and style of a tire at `height` [m]. On the ground a letter, which does not look like a cable in ASCII either. Above, a bar that
/// grows with the height, in another color if it exceeds the limit.
pub fn sign(app: &App, height: f32) -> (&'static str, Style) {
    let share = f64::from(height) / app.case.limits.height;
    if height < GROUND {
        return (ON_GROUND[1], app.theme.muted());
    }
    let sign = LEVELS[((share * 8.0) as usize).min(7)];
    (sign, app.theme.heat(curve(app, app.selected), share))
}

/// The cell in the middle between two cells.
fn middle([(x1, y1), (x2, y2)]: [(u16, u16); 2]) -> (u16, u16) {
    (x1.min(x2) + x1.abs_diff(x2) / 2, y1.min(y2) + y1.abs_diff(y2) / 2)
}

/// Draws a cable. A slack cable is dotted, a cable near the limit has dots beside it, a cable over the limit is double. So color is not the
/// only sign. `dot`: width and height of the finest dot [m].
pub fn draw_cable(
    app: &App,
    force: f64,
    [(x1, y1), (x2, y2)]: [(f64, f64); 2],
    dot: [f64; 2],
    context: &mut Context<'_>,
) {
    if force == 0.0 {
        return draw_dots([(x1, y1), (x2, y2)], dot, color(app.theme.muted()), context);
    }
    let color = color(cable_style(app, force));
    context.draw(&Stroke { x1, y1, x2, y2, color });
    let is_steep = ((y2 - y1) / dot[1]).abs() > ((x2 - x1) / dot[0]).abs();
    let [right, up] = if is_steep { [dot[0], 0.0] } else { [0.0, dot[1]] };
    let [x1, y1, x2, y2] = [x1 + right, y1 + up, x2 + right, y2 + up];
    match force / app.case.limits.force {
        share if share > 1.0 => context.draw(&Stroke { x1, y1, x2, y2, color }),
        share if share > NEAR_LIMIT => draw_dots([(x1, y1), (x2, y2)], dot, color, context),
        _ => {}
    }
}

/// Draws a dotted line.
fn draw_dots([(x1, y1), (x2, y2)]: [(f64, f64); 2], dot: [f64; 2], color: Color, context: &mut Context<'_>) {
    let count = (((x2 - x1) / dot[0]).abs().max(((y2 - y1) / dot[1]).abs()) / DOTTED).ceil();
    let dot_place = |n: usize| (x1 + (x2 - x1) * n as f64 / count, y1 + (y2 - y1) * n as f64 / count);
    let coords: Vec<(f64, f64)> = (1..count as usize).map(dot_place).collect();
    context.draw(&Points { coords: &coords, color });
}

/// Style of a cable with `force` [N]: warmer nearer to the limit, the color of a fail over the limit. Never the color of a pass, because
/// one cable within its limit is no pass.
pub fn cable_style(app: &App, force: f64) -> Style {
    app.theme.heat(app.theme.shots(), force / app.case.limits.force)
}

/// Width and height of a cell [m], at least the given ones, with which the tires of a grid stand evenly: whole cells apart. Several columns
/// stand an even number of cells apart, so that a cable has a cell in its middle.
fn even(layout: &plan::Layout, [width, height]: [f64; 2]) -> [f64; 2] {
    let plan::Layout::Grid(mesh) = layout else { return [width, height] };
    let fitted = |least: f64, spacing: f64, multiple: f64| {
        let cells = (spacing / least).floor();
        let cells = if cells > multiple { multiple * (cells / multiple).floor() } else { cells };
        if cells >= 1.0 { spacing / cells } else { least }
    };
    [fitted(width, mesh.column_spacing_m, 2.0), fitted(height, mesh.row_spacing_m, 1.0)]
}
