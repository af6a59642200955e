//! The flight screen: the selected option in motion.
//!
//! ```text
//! MOST FORCE 0.160 s: cable 3:8-4:8 31.2 kN, 57 % of limit
//! from above: a bar per tire    │ from the side: tires and cables
//! ▶ 0.412 s of 1.630 s  x0.1    ▲━━▲━━◆━━●──────^─────────     rows that fire, greatest force, greatest height
//! flight height, m              │ cable force, kN          with a cursor at the time shown
//! ```

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;

use nalgebra::Vector2;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{Canvas, Line as Stroke, Points};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::compare::{curve, verdict_words};
use super::flight_legend::{self, count_seen};
use super::from_above::{FromAbove, cable_style, draw_cable};
use super::hardest_cables::HARDEST;
use super::limit_chart;
use super::now_line::now_line;
use super::widgets::{color, draw_divider};
use crate::report::charts::DrawnShot;
use crate::report::words::drawn_shot::shot_words;
use crate::report::words::no_result;
use crate::sorting::{sorted_by, sorted_by_key};
use crate::study::flight::{Flight, GROUND, Stop};
use crate::study::question::StudyKind;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::studies::StudyState;
use crate::units::{self, Unit};

/// Time for which a hole is shown firing [s].
const FLASH: f64 = 0.03;
/// Signs for heights of one to eight eighths of the limit.
/// The least ones are no lower than a letter: they would look like the ground.
const LEVELS: [&str; 8] = ["▃", "▃", "▃", "▄", "▅", "▆", "▇", "█"];

/// A tire on the ground: its rims, where it is as wide as three cells, about its middle.
const ON_GROUND: [&str; 3] = ["(", "o", ")"];

/// Height of views in which five rows of tires stand two lines apart, below a title and above a legend.
const VIEWS: u16 = 12;

/// Draws the screen.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let Some(delay) = app.case.plan.delays.get(app.selected) else { return };
    let Some(flight) = app.flight() else {
        let message = match app.studies.state(StudyKind::Flight) {
            StudyState::Failed(failed) => format!("{}: {}", delay.name, no_result::message(failed)),
            _ => format!("{}: recording the flight…", delay.name),
        };
        return frame.render_widget(Paragraph::new(message).wrap(Wrap { trim: true }), area);
    };
    // The views have room for a cable between two rows of tires where that leaves charts with a title below.
    let rest = area.height.saturating_sub(2);
    let most = rest.saturating_sub(limit_chart::TITLED);
    let views = (rest * 3 / 5).max(most.min(VIEWS));
    let [now, views, bar, below] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(views),
        Constraint::Length(1),
        Constraint::Min(0),
    ])
    .areas(area);
    // As wide as its last tires need.
    let halves = [Constraint::Length(area.width / 2 + 2), Constraint::Fill(1)];
    let [above, side] = Layout::horizontal(halves).spacing(1).areas(views);
    let forces = flight.forces(app.player.time);
    draw_above(app, flight, &forces, frame, above);
    draw_side(app, flight, app.player.time, &forces, None, frame, side);
    draw_divider(app, frame, above);
    frame.render_widget(now_line(app, flight, &forces, now.width), now);
    draw_bar(app, flight, frame, bar, areas);
    let areas_below = Layout::horizontal(halves).spacing(1).split(below);
    let report = app.studies.finished(StudyKind::Flight).map(|done| app.report_of(done));
    let charts = report.iter().flat_map(|report| report.charts());
    let drawn = if flight.sample.is_some() { DrawnShot::DecidingByAny } else { DrawnShot::Planned };
    for ((chart_area, chart), name) in areas_below.iter().zip(charts).zip(["height", "force"]) {
        let chart = limit_chart::draw(app, chart, (name, drawn), Some(app.player.time), frame, *chart_area);
        areas.extend(chart.map(|drawn| (drawn.area, ClickTarget::Time(drawn.end))));
    }
    if below.height >= limit_chart::TITLED {
        draw_divider(app, frame, areas_below[0]);
    }
}

/// A block under a rule with a title.
pub fn titled_block<'t>(app: &App, title: String) -> Block<'t> {
    block_under(app, vec![Span::raw(format!(" {title} "))])
}

/// The same, its parts in styles of their own.
fn block_under<'t>(app: &App, title: Vec<Span<'t>>) -> Block<'t> {
    let title = Line::from(title).style(app.theme.title());
    Block::new().borders(Borders::TOP).border_style(app.theme.muted()).title(title)
}

/// Draws the shelter from above: cables that pull, coloured by their force, and a sign per tire by height; of tires that share a
/// cell, the highest. A hole that fires shows the direction of its launch; the worst cable and the highest tire of the whole flight
/// are marked.
fn draw_above(app: &App, flight: &Flight, forces: &[f64], frame: &mut Frame, area: Rect) {
    let (scene, theme, time) = (&flight.scene, app.theme, app.player.time);
    let name = &app.case.plan.delays[app.selected].name;
    let ground = &app.case.plan.ground;
    let slope = match ground.slope_percent > 0.0 {
        true => {
            format!(", ground falls {} % {}", units::short(ground.slope_percent), arrow(scene.downhill))
        }
        false => String::new(),
    };
    let (verdict, style) = verdict_words(app, app.selected);
    let named = format!(" {name} {verdict}");
    let which = shot_words(&app.case.limits, flight.sample.is_some());
    // The longest that has room: at least the verdict is never cut.
    let short = which.replace(" shots ", " ");
    let more = [
        format!(" · drawn: {which}, top view{slope} "),
        format!(" · drawn: {which}, top view "),
        format!(" · drawn: {which} "),
        format!(" · drawn: {short} "),
        format!(" · {short} "),
    ];
    let fits = |more: &String| named.width() + more.width() <= usize::from(area.width);
    let more = more.into_iter().find(fits).unwrap_or_else(|| " ".to_owned());
    let block = block_under(app, vec![format!(" {name} ").into(), Span::styled(verdict, style), more.into()]);
    let around = block.inner(area);
    frame.render_widget(block, area);
    let [around, legend] = flight_legend::split(around);
    let Some(map) = FromAbove::fit(app, around) else { return };
    let taut: Vec<_> = scene.cables.iter().zip(forces).filter(|(_, force)| **force > 0.0).collect();
    let cables = taut.iter().map(|(cable, _)| cable.ends.map(|end| map.cell_of(end)));
    let seen = count_seen(cables, (0..scene.tire_count()).map(|tire| map.cell_of(tire)));
    flight_legend::draw(app, seen, taut.len(), frame, legend);
    map.draw_cables(app, forces, flight.outcome.force.index, frame);
    map.mark_past_limit(app, forces, frame);
    let mut firing = vec![None; scene.tire_count()];
    for fire in &flight.shot.firings {
        if (fire.time..fire.time + FLASH).contains(&time) {
            firing[fire.tire] = Some(arrow(fire.launch.xy()));
        }
    }
    let mut highest: BTreeMap<(u16, u16), (f32, Option<&str>)> = BTreeMap::new();
    for (tire, u) in flight.at(time).iter().enumerate() {
        let cell = highest.entry(map.cell_of(tire)).or_insert((f32::MIN, None));
        let is_top = tire == flight.outcome.height.index && u[2] > GROUND;
        *cell = (cell.0.max(u[2]), firing[tire].or(cell.1).or(is_top.then_some("^")));
    }
    let half = map.half_tire(app.case.plan.tire.outer_diameter_m);
    let buffer = frame.buffer_mut();
    for (own, (height, mark)) in highest {
        let (sign, style) = sign(app, height);
        let fire = theme.title().add_modifier(Modifier::REVERSED);
        for (x, y) in map.cells_of_tire(own, half) {
            match mark.filter(|_| (x, y) == own) {
                Some("^") if half > 0 => buffer.set_string(x, y, "^", theme.title()),
                Some("^") => buffer.set_string(x, y, "^", style.add_modifier(Modifier::REVERSED)),
                Some(direction) => buffer.set_string(x, y, direction, fire),
                None => {
                    let rims = if x < own.0 { ON_GROUND[0] } else { ON_GROUND[2] };
                    let is_rim = sign == ON_GROUND[1] && x != own.0;
                    buffer.set_string(x, y, if is_rim { rims } else { sign }, style)
                }
            };
        }
    }
    // The cable that is pulled hardest in the whole flight.
    let hardest = flight.outcome.force.index;
    let force = forces.get(hardest).copied().unwrap_or(0.0);
    if force > 0.0 {
        map.mark_cable(hardest, HARDEST, cable_style(app, force), frame);
    }
}

/// The direction of a vector seen from above, x to the right and y up; a star where it has none.
fn arrow(along: Vector2<f64>) -> &'static str {
    if along.norm() == 0.0 {
        return "*";
    }
    let eighths = (along.y.atan2(along.x) / FRAC_PI_4).round().rem_euclid(8.0) as usize;
    ["→", "↗", "↑", "↖", "←", "↙", "↓", "↘"][eighths]
}

/// Sign and style of a height: a letter on the ground, which looks like no cable, in ASCII either; above it a taller bar the
/// higher, and another colour past the limit.
fn sign(app: &App, height: f32) -> (&'static str, Style) {
    let share = f64::from(height) / app.case.limits.height;
    if height < GROUND {
        return (ON_GROUND[1], app.theme.muted());
    }
    let sign = LEVELS[((share * 8.0) as usize).min(7)];
    (sign, app.theme.heat(curve(app, app.selected), share))
}

/// Tires whose way through the air is drawn: the highest ones.
const TRAILS: usize = 10;

/// The title of the view from the side, at most `width` cells: that heights are stretched, how many cables are taut, and over the limit.
/// Those over the limit stay longest.
fn side_title(from: &str, [taut, over]: [usize; 2], scale: &str, width: usize) -> String {
    let few = if taut == 0 { "no cable pulls".to_owned() } else { format!("{taut} cables taut") };
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

/// Draws tires from the side at a time [s], with the ways of the highest ones, the cables that pull, ground and limit. The title says from
/// where they are seen, and how many cables pull, where it says nothing else.
pub fn draw_side(
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
    // A cell of a terminal is about twice as high as wide.
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
            context.draw(&Points { coords: &lying, color: color(theme.curve()) });
            context.layer();
            context.draw(&stroke((from, limit), (to, limit), color(theme.limit_line())));
            // Where it has a line of its own.
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
    view.draw_tires(flying, count.clamp(1.0, WIDEST), |height| sign(app, height as f32).1, frame);
    // No tire stands over it.
    let label = format!("limit {} m", units::significant(limit, Unit::Metre, 3));
    view.print(limit, &label, theme.limit_line(), frame);
}

/// Most cells of a tire from the side.
const WIDEST: f64 = 5.0;

/// A view from the side: its cells, and the places [m] at their edges, across and up.
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

    /// Prints a text at the left, so far up [m], in the row in which a canvas would.
    fn print(&self, up: f64, text: &str, style: Style, frame: &mut Frame) {
        let Self { view, bounds: [_, [bottom, top]] } = *self;
        let row = ((top - up) / (top - bottom) * f64::from(view.height.saturating_sub(1))) as u16;
        let line = Rect { y: view.y + row, height: 1, ..view }.intersection(view);
        frame.render_widget(Line::styled(text, style), line);
    }

    /// Draws tires as bars, so many cells wide and half a cell high, at their places across and up; of two in one half of a cell the higher
    /// one.
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
                    // Without colours both halves are one cell.
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

/// Draws the time shown, as text and on a bar that takes clicks, with the moments at which the flight stops.
fn draw_bar(app: &App, flight: &Flight, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let player = &app.player;
    let state = if player.playing { "playing" } else { "paused " };
    let label = format!(
        " {state} {} of {}  x{} ",
        units::seconds(player.time),
        units::seconds(flight.end()),
        player.speed()
    );
    let width = label.chars().count() as u16;
    let [text, bar] = Layout::horizontal([Constraint::Length(width), Constraint::Min(0)]).areas(area);
    frame.render_widget(Line::styled(label, app.theme.title()), text);
    let cells = usize::from(bar.width);
    let cell = |at: f64| (cells.saturating_sub(1) as f64 * (at / flight.end()).min(1.0)).round() as u16;
    let shown = if flight.end() > 0.0 { cell(player.time) } else { 0 };
    let played = usize::from(shown).min(cells);
    let line = Line::from(vec![
        Span::styled("━".repeat(played), app.theme.curve()),
        Span::styled("●".repeat(cells.min(1)), app.theme.title()),
        Span::styled("─".repeat(cells.saturating_sub(played + 1)), app.theme.muted()),
    ]);
    frame.render_widget(line, bar);
    // The peaks lie over the rows that fire.
    let stops = flight.stops().into_iter().filter(|_| !bar.is_empty());
    let by_kind = |(_, stop): &(f64, Stop)| !matches!(stop, Stop::Row { .. });
    for (at, stop) in sorted_by_key(stops, by_kind) {
        let sign = match stop {
            Stop::Row { .. } => "▲",
            Stop::Force => HARDEST,
            Stop::Height => "^",
        };
        let style = app.theme.title();
        let style = if cell(at) == shown { style.add_modifier(Modifier::REVERSED) } else { style };
        frame.buffer_mut().set_string(bar.x + cell(at), bar.y, sign, style);
    }
    areas.push((bar, ClickTarget::Time(flight.end())));
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
