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
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::compare::verdict_words;
use super::flight_legend::{self, count_seen};
use super::from_above::{FromAbove, ON_GROUND, cable_style, sign};
use super::from_the_side;
use super::hardest_cables::HARDEST;
use super::limit_chart;
use super::now_line::now_line;
use super::widgets::{block_under, draw_divider};
use crate::report::charts::DrawnShot;
use crate::report::words::drawn_shot::shot_words;
use crate::report::words::no_result;
use crate::sorting::sorted_by_key;
use crate::study::flight::{Flight, GROUND, Stop};
use crate::study::question::StudyKind;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::studies::StudyState;
use crate::units;

/// Time for which a hole is shown as firing [s].
const FLASH: f64 = 0.03;
/// Height of views that show five rows of tires two lines apart, with a title above and a legend below.
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
    // The views get room for a cable between two rows of tires if charts with a title still fit below.
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
    // Two cells wider than half, for the last tires.
    let halves = [Constraint::Length(area.width.div_ceil(2) + 2), Constraint::Fill(1)];
    let [above, side] = Layout::horizontal(halves).spacing(1).areas(views);
    let forces = flight.forces(app.player.time);
    draw_above(app, flight, &forces, frame, above);
    from_the_side::draw(app, flight, app.player.time, &forces, None, frame, side);
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

/// Draws the shelter from above: the pulling cables, colored by force, and a sign for each tire by height. Of tires that share a cell, the
/// highest is shown. A firing hole shows the direction of its launch. The hardest pulled cable and the highest tire of the whole flight are
/// marked.
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
    // The longest text that fits. The verdict is never cut.
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

/// The direction of a vector seen from above, x to the right and y up; a star for a zero vector.
fn arrow(along: Vector2<f64>) -> &'static str {
    if along.norm() == 0.0 {
        return "*";
    }
    let eighths = (along.y.atan2(along.x) / FRAC_PI_4).round().rem_euclid(8.0) as usize;
    ["→", "↗", "↑", "↖", "←", "↙", "↓", "↘"][eighths]
}

/// Draws the time as text and on a bar that takes clicks, with marks at the stops of the flight.
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
    // Marks of peaks lie over marks of firing rows.
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
