//! Map of the cables to strengthen: the shelter from above with the cables that are pulled hardest in a shot, by their force.
//!
//! ```text
//! ─ cables pulled hardest ───────
//! 4 o───o───o───o
//!   │   ║   │   │
//! 3 ●───●───◉───●
//! ◆ hardest ● hole ◉ highest ══ >80 % ✗ >limit ── never hardest
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Margin, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::beside::in_flight;
use super::from_above::{FromAbove, cable_style, sign};
use crate::report::words::drawn_shot::one_in_above;
use crate::scene::Firing;
use crate::study::flight::GROUND;
use crate::study::judge::Judgement;
use crate::study::samples::sampled_shot::SampledShot;
use crate::tui::app::App;
use crate::tui::keymap::Action;

/// Sign of the cable that is pulled hardest.
pub const HARDEST: &str = "◆";
/// Time for which a hole is shown as firing [s].
const FLASH: f64 = 0.03;

/// Draws the map of the selected option from its sampled shots; from the planned shot while there are too few samples. The share of shots
/// left out is already on the screen.
pub fn draw(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) {
    draw_titled(app, judged, " cables pulled hardest ", frame, area);
}

/// Draws the map of the selected option and states the share of shots left out, for screens without the table of options.
pub fn draw_alone(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect) {
    let above = one_in_above(&app.case.limits);
    let short = above.replace(" shots ", " ");
    let titles = [
        format!(" cables pulled hardest · {above} "),
        format!(" pulled hardest · {short} "),
        format!(" hardest · {short} "),
    ];
    let title = titles.iter().find(|title| title.width() <= area.width.into());
    draw_titled(app, judged, title.map_or("", String::as_str), frame, area);
}

fn draw_titled(app: &App, judged: &Judgement, of_shots: &str, frame: &mut Frame, area: Rect) {
    let (scene, theme, checked) = (app.case.scene(), app.theme, &judged.checked);
    let deciding = judged.sampled.known().and_then(SampledShot::deciding_cables);
    let title = match deciding {
        Some(_) => of_shots,
        None => " cable pulled hardest as planned ",
    };
    let planned = (checked.estimates.force.index, checked.estimates.force.value);
    // The lines beside the map name this cable.
    let (hardest, _) = deciding.as_ref().and_then(|cables| cables.first().copied()).unwrap_or(planned);
    let mut forces = vec![0.0; scene.cables.len()];
    for (cable, pulled) in deciding.unwrap_or_else(|| vec![planned]) {
        forces.get_mut(cable).into_iter().for_each(|force| *force = pulled);
    }
    let block = Block::new()
        .borders(Borders::TOP)
        .border_style(theme.muted())
        .title(Line::styled(title, theme.title()));
    let block = match in_flight_words(app, usize::from(area.width).saturating_sub(title.width())) {
        Some(words) => block.title(words.right_aligned()),
        None => block,
    };
    let inside = block.inner(area);
    frame.render_widget(block, area);
    let [view, legend] = Layout::vertical([Constraint::Min(0), Constraint::Length(1)]).areas(inside);
    let Some(map) = FromAbove::fit(app, view) else { return };
    let is_lattice = map.draw_lattice(app, &forces, hardest, frame);
    let firings = &app.case.shots[app.selected].firings;
    let holes = firings.iter().map(|firing| (firing.tire, "●", theme.title()));
    // The lines beside the map name the height of this tire.
    let highest = judged.highest_tire().map(|tire| (tire, "◉", theme.title()));
    let tires = (0..scene.tire_count()).map(|tire| (tire, "o", theme.muted()));
    let (aloft, fired) = in_motion(app, firings);
    let signs = tires.chain(holes).chain(aloft).chain(highest).chain(fired);
    for (tire, sign, style) in signs {
        let (x, y) = map.cell_of(tire);
        frame.buffer_mut().set_string(x, y, sign, style);
    }
    map.mark_past_limit(app, &forces, frame);
    let force = forces.get(hardest).copied().unwrap_or(0.0);
    if force > 0.0 {
        map.mark_cable(hardest, HARDEST, cable_style(app, force), frame);
    }
    let entries = [
        (HARDEST, theme.title(), " hardest "),
        ("●", theme.title(), " hole "),
        ("◉", theme.title(), " highest "),
        // Same signs as on the map, also where braille becomes ASCII.
        (if is_lattice { "══" } else { "⠦⠤⠦⠤" }, theme.caution(), " >80 % "),
        ("✗", theme.limit().add_modifier(Modifier::REVERSED), " >limit"),
        ("  ──", theme.mesh(), " never hardest"),
    ];
    // Aligned with the numbers of the rows.
    let legend = legend.inner(Margin::new(1, 0));
    let mut room = usize::from(legend.width);
    let fits = |(sign, _, words): &(&str, Style, &str)| {
        let width = sign.width() + words.width();
        let fits = width <= room;
        room = room.saturating_sub(width);
        fits
    };
    let shown = entries.len() - usize::from(!is_lattice);
    let entries = entries.into_iter().take(shown).take_while(fits);
    let entries = entries
        .flat_map(|(sign, style, words)| [Span::styled(sign, style), Span::styled(words, theme.muted())]);
    frame.render_widget(Line::from_iter(entries), legend);
}

/// Says that bars are tires in flight, with the key that stops the motion; `None` if it does not fit in `room` cells or nothing flies.
fn in_flight_words(app: &App, room: usize) -> Option<Line<'static>> {
    let (_, time) = app.flight_below()?;
    let (told, space) = (in_flight(app, time), app.keymap.first_key(Action::Play));
    let words = [format!(" {told} · {space} "), format!(" {told} ")].into_iter();
    let mut lines = words.map(|words| {
        Line::from(vec![Span::styled(" ▃▆", app.theme.shots()), Span::styled(words, app.theme.muted())])
    });
    lines.find(|line| line.width() <= room)
}

/// Index of a tire, its sign and the style of the sign.
type Sign = (usize, &'static str, Style);

/// Signs from the repeating flight in the charts below: tires in the air as bars by height, and flashes of firing holes. A hole stays
/// visible until it fires.
fn in_motion(app: &App, firings: &[Firing]) -> (Vec<Sign>, Vec<Sign>) {
    let Some((flight, now)) = app.flight_below() else { return Default::default() };
    let mut is_to_fire = vec![false; flight.scene.tire_count()];
    firings.iter().filter(|firing| now < firing.time).for_each(|firing| is_to_fire[firing.tire] = true);
    let is_aloft = |(tire, [.., height]): &(usize, &[f32; 3])| *height > GROUND && !is_to_fire[*tire];
    let bar = |(tire, &[.., height]): (usize, &[f32; 3])| {
        let (bar, style) = sign(app, height);
        (tire, bar, style)
    };
    let aloft = flight.at(now).iter().enumerate().filter(is_aloft).map(bar).collect();
    let flash = app.theme.limit().add_modifier(Modifier::REVERSED);
    let fired = firings.iter().filter(|firing| (firing.time..firing.time + FLASH).contains(&now));
    (aloft, fired.map(|firing| (firing.tire, "●", flash)).collect())
}
