//! What is drawn where. Every part is a function of the app and an area; none changes anything. Drawing tells which
//! places a click means something at.
//!
//! ```text
//! 1 Plan  2 Compare  3 Flight  4 Studies  5 Accuracy  ? Help    tabs
//! title · plan                                    state         header
//! limits · method · accuracy
//! what the screen shows                                         body
//! keys, or what is being typed                                  footer
//! ```

mod accuracy;
mod chart;
mod detail;
mod flight;
mod help;
mod palette;
mod plan;
mod spread;
mod studies;
mod table;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Paragraph, Wrap};

use super::app::{App, Row, Screen, Target};
use super::keymap::{Action, BINDINGS};
use super::prompt::{Prompt, Purpose};
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// Smallest screen that holds everything.
pub const LEAST: (u16, u16) = (60, 18);

/// What a click means where; the last of several at a point counts.
pub type Places = Vec<(Rect, Target)>;

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame) -> Places {
    let (area, mut places) = (frame.area(), Places::new());
    frame.render_widget(Block::new().style(app.theme.base()), area);
    if area.width < LEAST.0 || area.height < LEAST.1 {
        let text = format!("shelter needs {}x{}, has {}x{}", LEAST.0, LEAST.1, area.width, area.height);
        frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), area);
        return places;
    }
    let [tabs, header, body, footer] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(2),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(area);
    draw_tabs(app, frame, tabs, &mut places);
    draw_header(app, frame, header);
    match app.screen {
        Screen::Plan => plan::draw(app, frame, body, &mut places),
        Screen::Compare => draw_options(app, frame, body, &mut places),
        Screen::Flight => flight::draw(app, frame, body, &mut places),
        Screen::Studies => studies::draw(app, frame, body, &mut places),
        Screen::Accuracy => accuracy::draw(app, frame, body),
    }
    match &app.prompt {
        Some(prompt) => draw_prompt(app, prompt, frame, footer),
        None => draw_footer(app, frame, footer, &mut places),
    }
    if app.help {
        help::draw(app, frame, area, &mut places);
    }
    places
}

/// The table of options and the selected one below it, or that alone.
fn draw_options(app: &App, frame: &mut Frame, area: Rect, places: &mut Places) {
    let rows = app.listed().len().max(1) as u16 + 1;
    let table = if app.zoom { 0 } else { rows.min(area.height / 2) };
    let [list, rest] = Layout::vertical([Constraint::Length(table), Constraint::Min(0)]).areas(area);
    if !app.zoom {
        table::draw(app, frame, list, places);
    }
    detail::draw(app, frame, rest);
}

/// Draws words one after another, each a place to click; stops where the next no longer fits.
fn draw_row<'w>(
    words: impl IntoIterator<Item = (Line<'w>, Target)>,
    frame: &mut Frame,
    area: Rect,
    places: &mut Places,
) {
    let mut x = area.x;
    for (word, target) in words {
        let width = word.width() as u16;
        if x + width > area.right() {
            return;
        }
        let place = Rect { x, width, ..area };
        frame.render_widget(word, place);
        places.push((place, target));
        x += width;
    }
}

fn draw_tabs(app: &App, frame: &mut Frame, area: Rect, places: &mut Places) {
    let word = |key: String, name: &'static str, shown: bool| {
        let style = if shown { app.theme.selected() } else { app.theme.quiet() };
        Line::from(vec![
            Span::styled(format!(" {key} "), if shown { style } else { app.theme.title() }),
            Span::styled(format!("{name} "), style),
        ])
    };
    let screens = Screen::ALL.into_iter().map(|screen| {
        let action = Action::Show(screen);
        (word(app.keymap.label(action, false), screen.name(), screen == app.screen), Target::Act(action))
    });
    let help = (word(app.keymap.label(Action::Help, false), "Help", app.help), Target::Act(Action::Help));
    draw_row(screens.chain([help]), frame, area, places);
}

fn draw_header(app: &App, frame: &mut Frame, area: Rect) {
    let (case, theme) = (&app.case, app.theme);
    let mut about = format!(
        "limits: height {} m, force {} kN",
        units::value(case.limits.height, Unit::Metre),
        units::value(case.limits.force, Unit::Kilonewton),
    );
    if let Some(drift) = case.limits.drift {
        about += &format!(", drift {} m", units::value(drift, Unit::Metre));
    }
    let level = match app.compute.step {
        Some(step) => format!("step {}", units::milliseconds(step)),
        None => app.compute.accuracy.name().to_owned(),
    };
    about += &format!(" · {}, {level}", app.compute.method.name());
    about += &format!(" · {} tires, {} cables", case.scene().mass.len(), case.scene().cables.len());
    let unsaved = if app.editor.unsaved() { " *not saved*" } else { "" };
    let title = Line::from(vec![
        Span::styled(case.title(), theme.title()),
        Span::styled(format!("  {}", case.source.path), theme.quiet()),
        Span::styled(unsaved, theme.limit()),
    ]);
    let state = Line::from(summary(app)).right_aligned().style(theme.title());
    let [first, second] = Layout::vertical([Constraint::Length(1); 2]).areas(area);
    let [left, right] =
        Layout::horizontal([Constraint::Min(0), Constraint::Length(state.width() as u16 + 1)]).areas(first);
    frame.render_widget(title, left);
    frame.render_widget(state, right);
    let filter = if app.screen == Screen::Studies { &app.studies.filter } else { &app.compare.filter };
    let line = match &app.notice {
        Some(notice) => Line::styled(notice.as_str(), theme.limit()),
        None if !filter.is_empty() => {
            let what = if app.screen == Screen::Studies { "lines" } else { "options" };
            Line::styled(format!("only {what} with '{filter}' are shown; Esc shows all"), theme.limit())
        }
        None => Line::styled(about, theme.quiet()),
    };
    frame.render_widget(line, second);
}

/// How the whole plan stands.
fn summary(app: &App) -> String {
    let done = app.rows.iter().filter(|row| matches!(row, Row::Done(_) | Row::Failed(_))).count();
    let passed = |row: &&Row| matches!(row, Row::Done(checked) if checked.verdict == Verdict::Pass);
    let passed = app.rows.iter().filter(passed).count();
    if app.computing() {
        format!("computing {done}/{}", app.rows.len())
    } else {
        format!("{passed} of {} pass", app.rows.len())
    }
}

/// The keys of the screen first, then those of all, as many as fit beside the way out.
fn draw_footer(app: &App, frame: &mut Frame, area: Rect, places: &mut Places) {
    let word = |action: Action, short: &'static str| {
        let key = Span::styled(format!(" {} ", app.keymap.label(action, false)), app.theme.title());
        let line = Line::from(vec![key, Span::styled(format!("{short} "), app.theme.quiet())]);
        (line, Target::Act(action))
    };
    let end = [word(Action::Help, "help"), word(Action::Quit, "quit")];
    let width: usize = end.iter().map(|(line, _)| line.width()).sum();
    let [keys, last] = Layout::horizontal([Constraint::Min(0), Constraint::Length(width as u16)]).areas(area);
    let shown = BINDINGS.iter().filter(|binding| !binding.short.is_empty() && binding.is_on(app.screen));
    let (special, general): (Vec<_>, Vec<_>) = shown.partition(|binding| !binding.on.is_empty());
    let words =
        special.into_iter().chain(general).map(|binding| word(binding.action, binding.short_on(app.screen)));
    draw_row(words, frame, keys, places);
    draw_row(end, frame, last, places);
}

/// What is being typed, with the cursor in it.
fn draw_prompt(app: &App, prompt: &Prompt, frame: &mut Frame, area: Rect) {
    let head = match prompt.purpose {
        Purpose::Search if app.screen == Screen::Plan => " find (Down: next): ",
        Purpose::Search => " find: ",
        Purpose::Palette => " : ",
        Purpose::Export => " write to (.csv, .svg, .html): ",
        Purpose::SaveAs => " save the plan as: ",
    };
    if prompt.purpose == Purpose::Palette {
        palette::draw(app, prompt, frame, area);
    }
    let room = usize::from(area.width).saturating_sub(head.len() + 1);
    let scroll = prompt.input.visual_scroll(room);
    let typed: String = prompt.input.value().chars().skip(scroll).collect();
    let line = Line::from(vec![Span::styled(head, app.theme.title()), Span::raw(typed)]);
    frame.render_widget(line, area);
    let column = head.len() + prompt.input.visual_cursor().saturating_sub(scroll);
    let x = area.x + (column as u16).min(area.width.saturating_sub(1));
    frame.set_cursor_position(Position::new(x, area.y));
}

/// The colour of a style, for what takes no style.
fn color(style: Style) -> Color {
    style.fg.unwrap_or(Color::Reset)
}
