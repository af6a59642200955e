//! What lives beside the charts of the selected option where the screen is wide: every shot tried while they come, then the flight.
//!
//! ```text
//! ─ 350 shots tried: one dot each ─────      ─ in flight, x0.1 · 0.412 s ─────────
//! height limit ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┆┄┄        limit ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄
//!            ⠂⠅⣂⡁⠌              ┆             ●   ●       ●
//!              ⠐⡈⠄              ┆              ⡇ ⢸  ● ●   ⡇
//! ────────────────────── force limit         ──────────────────────────────────
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Color;
use ratatui::symbols::Marker;
use ratatui::text::Span;
use ratatui::widgets::canvas::{Canvas, Line as Stroke, Points};

use super::compare::curve;
use super::flight::{draw_side, titled_block};
use super::widgets::color;
use crate::study::judge::Judgement;
use crate::study::samples::sample::Sample;
use crate::tui::app::App;
use crate::units;

/// Greatest share of a limit that is drawn: what uses more stands at the edge.
const MOST: f64 = 1.25;

/// Draws the flight of the selected option where it is recorded and nothing computes, else the shots that were tried. Returns the time of
/// the flight [s].
pub fn draw(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) -> Option<f64> {
    let Some(flight) = app.flight().filter(|_| !app.busy()) else {
        draw_shots(app, judged, frame, area);
        return None;
    };
    let time = app.player.time_beside.min(flight.end());
    let title = format!("in flight, x{} · {}", app.player.speed(), units::seconds(time));
    draw_side(app, flight, time, &flight.forces(time), Some(title), frame, area);
    Some(time)
}

/// Draws a dot for each shot that was tried: across the share of the limit of force that it uses, upward that of height.
fn draw_shots(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) {
    let samples = judged.sampled.known().map_or(&[][..], |sampled| &sampled.samples);
    let (theme, limits) = (app.theme, app.case.limits);
    let share = |sample: &Sample| {
        let run = sample.finest();
        (run.force / limits.force, run.height / limits.height)
    };
    let shares = samples.iter().map(share).filter(|(across, up)| across.is_finite() && up.is_finite());
    let drawn = shares.map(|(across, up)| (across.min(MOST), up.min(MOST)));
    let (kept, past): (Vec<_>, Vec<_>) = drawn.partition(|(across, up)| across.max(*up) <= 1.0);
    let title = format!("{} shots tried, a dot each", samples.len());
    let stroke = |(x1, y1), (x2, y2), color| Stroke { x1, y1, x2, y2, color };
    let [calm, limit] = [color(curve(app, app.selected)), color(theme.limit())];
    let canvas = Canvas::default()
        .block(titled_block(app, title))
        .background_color(theme.base().bg.unwrap_or(Color::Reset))
        .marker(Marker::Braille)
        .x_bounds([0.0, MOST])
        .y_bounds([0.0, MOST])
        .paint(|context| {
            context.draw(&stroke((0.0, 1.0), (1.0, 1.0), limit));
            context.draw(&stroke((1.0, 0.0), (1.0, 1.0), limit));
            context.layer();
            context.draw(&Points { coords: &kept, color: calm });
            context.layer();
            context.draw(&Points { coords: &past, color: limit });
            context.print(0.0, 1.0 + 0.5 * (MOST - 1.0), Span::styled("height limit", theme.limit()));
            context.print(0.7, 0.0, Span::styled("force limit", theme.limit()));
        });
    frame.render_widget(canvas, area);
}
