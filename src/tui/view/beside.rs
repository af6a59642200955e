//! The moving view beside the charts of the selected option on a wide screen: first each sampled shot as a dot, later the flight.
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
use super::from_the_side;
use super::widgets::color;
use super::widgets::titled_block;
use crate::study::judge::Judgement;
use crate::study::samples::sample::Sample;
use crate::tui::app::App;
use crate::units;
use crate::verdict::Verdict;

/// Greatest share of a limit on the axes. A greater share is drawn at the edge.
const MOST: f64 = 1.25;

/// Draws the recorded flight of the selected option; if it is not recorded or something computes, the sampled shots.
pub fn draw(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) {
    let Some((flight, time)) = app.flight_below() else {
        return draw_shots(app, judged, frame, area);
    };
    let title = in_flight(app, time);
    from_the_side::draw(app, flight, time, &flight.forces(time), Some(title), frame, area);
}

/// The title: flight, playback speed and time [s].
pub fn in_flight(app: &App, time: f64) -> String {
    format!("in flight, x{} · {}", app.player.speed(), units::seconds(time))
}

/// Draws a dot for each sampled shot: its share of the force limit across, its share of the height limit up.
fn draw_shots(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) {
    let samples = judged.sampled.known().map_or(&[][..], |sampled| &sampled.samples);
    let (theme, limits) = (app.theme, app.case.limits);
    let share = |sample: &Sample| {
        let run = sample.finest();
        (run.force / limits.force, run.height / limits.height)
    };
    let is_drawn = |sample: &&Sample| {
        let (across, up) = share(sample);
        across.is_finite() && up.is_finite()
    };
    // A shot within both limits may fail for another reason: a slide, a broken cable, or a hole under no tire.
    let (kept, past): (Vec<&Sample>, Vec<&Sample>) =
        samples.iter().filter(is_drawn).partition(|sample| sample.finest().verdict == Verdict::Pass);
    let dots = |samples: &[&Sample]| {
        let shares = samples.iter().map(|sample| share(sample));
        shares.map(|(across, up)| (across.min(MOST), up.min(MOST))).collect::<Vec<_>>()
    };
    let (kept, past) = (dots(&kept), dots(&past));
    let title = match kept.len() + past.len() {
        all if all == samples.len() => format!("{all} shots tried, a dot each"),
        drawn => format!("{} shots tried, a dot each of {drawn}", samples.len()),
    };
    let stroke = |(x1, y1), (x2, y2), color| Stroke { x1, y1, x2, y2, color };
    let [calm, limit] = [color(curve(app, app.selected)), color(theme.limit_line())];
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
            context.draw(&Points { coords: &past, color: color(theme.limit()) });
            context.print(0.0, 1.0 + 0.5 * (MOST - 1.0), Span::styled("height limit", theme.limit_line()));
            context.print(0.7, 0.0, Span::styled("force limit", theme.limit_line()));
        });
    frame.render_widget(canvas, area);
}
