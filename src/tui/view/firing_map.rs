//! The shelter from above with the firing times. When another order of firing comes into view, it is played in slow motion.
//!
//! ```text
//! ─ 109 ms · 1: 0 ms, 2: 109 ms, 3: 218 ms ─
//!  ✓ PASS · 0 of 500 shots fail
//!         1  2  3  4  5
//!  4      o  o  o  o  o
//!  3 218  ●  ●  ●  ●  ●     the time of a row whose holes fire at once stands beside it [ms], else that of each hole in its place
//!  2 109  ●  ●  ●  ●  ●
//!  fires 0────────109────────218 ms
//!  ● hole, its time at the left in ms · tire 2:4: row 2, column 4
//! ```

use std::collections::{BTreeMap, BTreeSet};

use itertools::Itertools;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{self, Canvas};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::lattice::{self, Strand};
use super::widgets::color;
use super::{map_numbers, plan_verdict};
use crate::plan::Layout;
use crate::report::words::option_sentences::{firing_times, firing_times_text};
use crate::scene::{Cable, Firing, Scene};
use crate::sorting::sort_by;
use crate::study::Case;
use crate::tui::app::App;
use crate::tui::player::JUST_FIRED;
use crate::units;

/// Lines around the map at any height: title, verdict, column numbers, and the line of firing times or the legend.
pub const AROUND: u16 = 4;

/// Draws the shelter with its verdict. Returns the cells that show the firing time of a hole, each with its blast row.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) -> Vec<(Rect, usize)> {
    let (case, theme) = (&app.case, app.theme);
    let Some(delay) = case.plan.delays.get(app.selected) else { return Vec::new() };
    let firings = case.shots.get(app.selected).map_or(&[][..], |shot| &shot.firings);
    let [rows, times] = [firing_times_text(&case.plan.blast_rows, delay), firing_times(delay)];
    let titles =
        [format!(" {} · {rows} ", delay.name), format!(" {} · {times} ", delay.name), format!(" {times} ")];
    // A time that is cut off would be a wrong time.
    let title = titles.into_iter().find(|title| title.width() <= usize::from(area.width)).unwrap_or_default();
    let title = Line::styled(title, theme.title());
    let block = Block::new().borders(Borders::TOP).border_style(theme.muted()).title(title);
    let inside = block.inner(area);
    frame.render_widget(block, area);
    frame.render_widget(plan_verdict::line(app, area.width), Rect { height: inside.height.min(1), ..inside });
    // Both lines below the map are shown if the map then still has a blank row between two rows of tires.
    let [shelter_rows, _] = case.scene().rows_and_columns();
    let map_rows = lines_of_rows(shelter_rows.len()).saturating_sub(1).max(LEAST_ROWS);
    // If rows of tires share lines anyway, a map with one line less is no worse.
    let left = usize::from(area.height.saturating_sub(AROUND));
    let share_lines = shelter_rows.len() > left && left > usize::from(LEAST_ROWS);
    let has_both = area.height > map_rows.saturating_add(AROUND) || share_lines;
    let below = 1 + u16::from(has_both);
    let around = Rect { y: inside.y + 1, height: inside.height.saturating_sub(1 + below), ..inside };
    let map = Map::fit(case, firings, around);
    let fired = |at: f64| app.firing_play.since(at, firings.last().map_or(0.0, |last| last.time));
    let style = |at: f64| match fired(at) {
        Some(since) if since < 0.0 => theme.muted(),
        Some(since) if since < JUST_FIRED => theme.title().add_modifier(Modifier::REVERSED),
        _ => theme.title(),
    };
    let cells = map.draw(app, firings, style, frame);
    let foot = |line: u16| Rect { y: area.bottom().saturating_sub(line), height: 1.min(area.height), ..area };
    draw_in_time(app, firings, style, frame, foot(below));
    if !has_both {
        return cells;
    }
    frame.render_widget(Line::styled(map.legend(case, area.width.into()), theme.muted()), foot(1));
    cells
}

/// Lines of a map for `rows` rows of tires: two for each row.
pub fn lines_of_rows(rows: usize) -> u16 {
    u16::try_from(rows).unwrap_or(u16::MAX).saturating_mul(2)
}

/// Least rows of a map with both lines below it.
const LEAST_ROWS: u16 = 5;

/// Draws the firings on a line of time.
fn draw_in_time(app: &App, firings: &[Firing], style: impl Fn(f64) -> Style, frame: &mut Frame, area: Rect) {
    let Some(last) = firings.last().map(|last| last.time) else { return };
    let muted = app.theme.muted();
    if last == 0.0 {
        let words = [(" fires ", muted), ("0", style(0.0)), (" ms, all at once", muted)];
        let words = words.map(|(words, style)| Span::styled(words, style));
        return frame.render_widget(Line::from_iter(words), area);
    }
    let before = " fires ";
    let mut times: Vec<f64> = firings.iter().map(|firing| firing.time).collect();
    times.dedup();
    let digits = |at: f64| without_unit(at);
    let cells_before = |after: &str| usize::from(area.width).saturating_sub(before.len() + after.len());
    let column = |at: f64, width: usize| (at / last * width.saturating_sub(1) as f64).round() as usize;
    let start = |at: f64, width: usize| {
        let long = digits(at).len();
        column(at, width).saturating_sub(long / 2).min(width.saturating_sub(long))
    };
    let after = " ms";
    let width = cells_before(after);
    // Two numbers that touch would read as another number.
    let touch = |pair: &[f64]| start(pair[0], width) + digits(pair[0]).len() >= start(pair[1], width);
    let has_digits = !times.windows(2).any(touch);
    // If only signs fit on the line, the last time stands behind the line in full.
    let after = if has_digits { after.to_owned() } else { format!(" {}{after}", digits(last)) };
    let width = cells_before(&after);
    let line = |n: usize| {
        // The played part is a thick line.
        let at = last * n as f64 / width.max(1) as f64;
        let is_played = app.firing_play.since(at, last).is_some_and(|since| since >= 0.0);
        if is_played { Span::styled("━", app.theme.title()) } else { Span::styled("─", muted) }
    };
    let mut cells: Vec<Span<'_>> = (0..width).map(line).collect();
    for &at in &times {
        let (start, signs) = match has_digits {
            true => (start(at, width), digits(at)),
            false => (column(at, width), "▲".to_owned()),
        };
        for (cell, letter) in cells.iter_mut().skip(start).zip(signs.chars()) {
            *cell = Span::styled(letter.to_string(), style(at));
        }
    }
    let [before, after] = [before.to_owned(), after].map(|words| Span::styled(words, muted));
    frame.render_widget(Line::from_iter([before].into_iter().chain(cells).chain([after])), area);
}

/// Where the firing times stand.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Times {
    /// One time beside each row.
    BesideRows,
    /// A time in place of each hole.
    AtHoles,
    /// The times do not fit. Signs show the order.
    Signs,
}

/// The shelter, fitted into an area.
struct Map<'s> {
    scene: &'s Scene,
    times: Times,
    /// Width of the longest time [cells].
    widest: usize,
    /// The area with the numbers of rows and columns. `inside`: the area of the tires.
    around: Rect,
    inside: Rect,
    /// The ends of the area of the tires along x and along y [m].
    reach: [[f64; 2]; 2],
    /// Lines of equal time, as pairs of points.
    lines: Vec<[MapPoint; 2]>,
}

impl<'s> Map<'s> {
    fn fit(case: &'s Case, firings: &[Firing], around: Rect) -> Self {
        let scene = case.scene();
        let widest = firings.iter().map(|firing| in_ms(firing).len()).max().unwrap_or(0);
        let inside = map_numbers::map_area(scene, around, map_numbers::LEFT);
        let mut by_row: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
        for firing in firings {
            by_row.entry(in_mm(scene.position[firing.tire].y)).or_default().push(firing.time);
        }
        let fires_at_once = by_row.values().all(|times| times.iter().all(|at| *at == times[0]));
        let [bottom, top] = bounds(case, 1, inside.height, true);
        let line_of = |y: i64| line_of(y as f64 / 1e3, [bottom, top], inside);
        // If another row shares the line, its number would stand beside the time.
        let tires_at: BTreeSet<i64> = scene.position.iter().map(|at| in_mm(at.y)).collect();
        let shared = tires_at.into_iter().counts_by(line_of);
        let has_own_lines = by_row.keys().all(|&y| shared.get(&line_of(y)) == Some(&1));
        let is_by_row = inside != around && fires_at_once && has_own_lines;
        let beside = if is_by_row { widest as u16 + 1 } else { 0 };
        let inside = Rect { x: inside.x + beside, width: inside.width.saturating_sub(beside), ..inside };
        let reach =
            [(0, inside.width), (1, inside.height)].map(|(axis, cells)| bounds(case, axis, cells, is_by_row));
        let lines = if is_by_row { Vec::new() } else { equal_time_lines(case, firings) };
        let mut map = Self { scene, times: Times::BesideRows, widest, around, inside, reach, lines };
        if !is_by_row {
            let mut along: Vec<f64> = firings.iter().map(|firing| scene.position[firing.tire].x).collect();
            along.sort_by(f64::total_cmp);
            along.dedup_by(|b, a| *b - *a < 1e-3);
            let starts: Vec<u16> = along.into_iter().map(|x| map.start([x, 0.0], widest).0).collect();
            let has_room = starts.windows(2).all(|pair| usize::from(pair[0]) + widest < pair[1].into());
            map.times = if has_room { Times::AtHoles } else { Times::Signs };
        }
        map
    }

    /// The cell of a place (x, y) [m].
    fn cell(&self, [x, y]: [f64; 2]) -> (u16, u16) {
        let Self { inside, reach: [[left, right], up], .. } = self;
        let across = (x - left) / (right - left) * f64::from(inside.width.max(1) - 1);
        (inside.x + across.round() as u16, line_of(y, *up, *inside))
    }

    /// The first of `letters` cells for a hole. A number that is cut off would be another number, so the last one begins further left.
    fn start(&self, at: [f64; 2], letters: usize) -> (u16, u16) {
        let (x, y) = self.cell(at);
        (x.min(self.inside.right().saturating_sub(letters as u16)), y)
    }

    /// Draws tires, holes and times, each in the style of its time. Returns the cells of the times with their blast rows.
    fn draw(
        &self,
        app: &App,
        firings: &[Firing],
        style: impl Fn(f64) -> Style,
        frame: &mut Frame,
    ) -> Vec<(Rect, usize)> {
        let Self { scene, inside, around, reach: [across, up], .. } = self;
        let (theme, place) = (app.theme, |tire: usize| [scene.position[tire].x, scene.position[tire].y]);
        let canvas = Canvas::default()
            .background_color(theme.base().bg.unwrap_or(Color::Reset))
            .marker(Marker::Braille)
            .x_bounds(*across)
            .y_bounds(*up)
            .paint(|context| {
                for &[(x1, y1), (x2, y2)] in &self.lines {
                    context.draw(&canvas::Line { x1, y1, x2, y2, color: color(theme.title()) });
                }
            });
        frame.render_widget(canvas, *inside);
        let buffer = frame.buffer_mut();
        map_numbers::draw(scene, *inside, *around, |at| self.cell(at), theme.muted(), buffer);
        // Cables are drawn behind signs, but not behind numbers.
        if self.times == Times::BesideRows {
            let strand = |cable: &Cable| {
                let ends = cable.ends.map(|tire| self.cell(place(tire)));
                Strand { ends, style: theme.mesh(), share: 0.0, is_double: false }
            };
            lattice::draw(scene.cables.iter().map(strand).collect(), buffer);
        }
        for tire in 0..scene.tire_count() {
            let (x, y) = self.cell(place(tire));
            buffer.set_string(x, y, "o", theme.muted());
        }
        let mut turns: Vec<f64> = firings.iter().map(|firing| firing.time).collect();
        turns.dedup();
        let mut areas = Vec::new();
        for firing in firings {
            let label = match self.times {
                Times::BesideRows => "●".to_owned(),
                Times::AtHoles => in_ms(firing),
                Times::Signs => sign(turns.iter().position(|at| *at == firing.time).unwrap_or(0)),
            };
            let (x, y) = self.start(place(firing.tire), label.width());
            buffer.set_string(x, y, &label, style(firing.time));
            let width = label.width() as u16;
            areas.push((Rect { x, y, width, height: 1 }.intersection(*inside), firing.row));
            if self.times == Times::BesideRows {
                let width = self.widest as u16;
                let beside = Rect { x: inside.x.saturating_sub(width + 1), y, width, height: 1 };
                buffer.set_string(
                    beside.x,
                    y,
                    format!("{:>1$}", in_ms(firing), self.widest),
                    style(firing.time),
                );
                areas.push((beside, firing.row));
            }
        }
        areas
    }

    /// The longest legend that fits.
    fn legend(&self, case: &Case, width: usize) -> String {
        let [signs, short] = match self.times {
            Times::BesideRows => ["● hole, its time at the left in ms", "● hole, time in ms"],
            Times::AtHoles => ["numbers: fired at, ms", "fired at, ms"],
            Times::Signs => ["signs: 1 fires first, 2 next", "1 fires first"],
        };
        let lines = if self.lines.is_empty() { "" } else { " · lines: fire at once" };
        let [tire, cable, place] = match case.plan.layout {
            Layout::Grid(_) => [
                " · tire 2:4: row 2, column 4",
                " · cable 2:4-3:4: between two tires",
                " · 2:4: row 2, column 4",
            ],
            Layout::Quincunx(_) | Layout::List { .. } => [""; 3],
        };
        let legends = [
            format!(" {signs}{lines} · o no hole{tire}{cable}"),
            format!(" {signs}{lines}{tire}{cable}"),
            format!(" {signs}{lines}{tire}"),
            format!(" {short}{lines}{place}"),
            format!(" {signs}{lines}"),
            format!(" {signs}"),
            format!(" {short}"),
        ];
        legends.into_iter().find(|legend| legend.width() <= width).unwrap_or_default()
    }
}

/// The screen line of a place `y` [m] on a map from `bottom` to `top` [m].
fn line_of(y: f64, [bottom, top]: [f64; 2], map: Rect) -> u16 {
    let down = (top - y) / (top - bottom) * f64::from(map.height.max(1) - 1);
    map.y + down.round() as u16
}

/// A length [m] in whole millimeters.
fn in_mm(length: f64) -> i64 {
    (length * 1e3).round() as i64
}

/// The time of a firing [ms] as text.
fn in_ms(firing: &Firing) -> String {
    without_unit(firing.time)
}

/// A time [s] in milliseconds with all digits, as text without the unit.
fn without_unit(at: f64) -> String {
    units::exact_number_of_milliseconds(at).to_string()
}

/// Width and height of the map [m], with a margin around the tires.
pub fn size(scene: &Scene) -> [f64; 2] {
    let margin = margin(scene);
    [0, 1].map(|axis| {
        let [from, to] = scene.extent(axis);
        to - from + 2.0 * margin
    })
}

/// Margin around the tires [m].
fn margin(scene: &Scene) -> f64 {
    let [across, up] = [0, 1].map(|axis| scene.extent(axis)).map(|[from, to]| to - from);
    0.05 * across.max(up).max(1.0)
}

/// The ends of a map of `cells` cells along an axis [m], with a margin around the tires. The tires of a grid lie whole numbers of cells
/// apart. `is_by_row`: no time stands behind the last column.
fn bounds(case: &Case, axis: usize, cells: u16, is_by_row: bool) -> [f64; 2] {
    let (scene, last) = (case.scene(), f64::from(cells.max(2) - 1));
    let ([from, to], margin) = (scene.extent(axis), margin(scene));
    let around = [from - margin, to + margin];
    let Layout::Grid(mesh) = &case.plan.layout else { return around };
    let spacing = [mesh.column_spacing_m, mesh.row_spacing_m][axis];
    // Behind the last column its label needs room. Above the last row nothing does.
    let length = if axis == 0 && !is_by_row { around[1] - around[0] } else { to - from };
    let apart = (spacing * last / length + ROUNDING_NOISE).floor();
    if !apart.is_finite() || apart < 1.0 {
        return around;
    }
    let cell = spacing / apart;
    let start = from - (0.5 * (last - (to - from) / cell) + ROUNDING_NOISE).floor() * cell;
    [start, start + last * cell]
}

/// Rounding error of numbers of cells.
const ROUNDING_NOISE: f64 = 1e-6;

/// Number of lines of equal time between the first and the last hole.
const LINES: usize = 6;

/// A point of the map [m].
type MapPoint = (f64, f64);

/// Lines of equal firing time between neighboring blast rows, as pairs of points. Rows whose holes fire at once have none.
fn equal_time_lines(case: &Case, firings: &[Firing]) -> Vec<[MapPoint; 2]> {
    let mut rows: Vec<Vec<(MapPoint, f64)>> = vec![Vec::new(); case.plan.blast_rows.len()];
    for firing in firings {
        let hole = case.scene().position[firing.tire];
        rows[firing.row].push(((hole.x, hole.y), firing.time));
    }
    rows.retain(|row| !row.is_empty());
    rows.iter_mut()
        .for_each(|row| sort_by(row, |a, b| a.0.0.total_cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1))));
    sort_by(&mut rows, |a, b| a[0].0.1.total_cmp(&b[0].0.1));
    let last = firings.last().map_or(0.0, |firing| firing.time);
    let mut lines = Vec::new();
    for n in 1..=LINES {
        let level = last * n as f64 / (LINES + 1) as f64;
        let crossings: Vec<Vec<MapPoint>> = rows.iter().map(|row| points_at(row, level)).collect();
        for pair in crossings.windows(2).filter(|pair| pair[0].len() == pair[1].len()) {
            lines.extend(pair[0].iter().zip(&pair[1]).map(|(&a, &b)| [a, b]));
        }
    }
    lines
}

/// Points along a row at which the firing time is `level` [s], interpolated between its holes.
fn points_at(row: &[(MapPoint, f64)], level: f64) -> Vec<MapPoint> {
    let between = |pair: &[(MapPoint, f64)]| {
        let [(a, from), (b, to)] = [pair[0], pair[1]];
        let part = (level - from) / (to - from);
        let is_between = (from < level) != (to < level);
        is_between.then_some((a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1)))
    };
    row.windows(2).filter_map(between).collect()
}

/// Sign of a turn: 1 to 9, then letters, then `+`.
fn sign(turn: usize) -> String {
    char::from_digit(turn as u32 + 1, 36).unwrap_or('+').to_string()
}
