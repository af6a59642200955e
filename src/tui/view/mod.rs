//! Draws the screens. Every part is a function of the app and an area, and changes nothing. Drawing returns the areas that take clicks.
//!
//! ```text
//! 1 Plan  2 Compare  3 Flight  4 Studies  5 Accuracy  ? Help    tabs
//! the answer, or title and plan                   state         header
//! badges: what a PASS leaves open
//! contents of the screen                                        body
//! a message, and what the line being typed is for
//! keys, or the line being typed                                 footer
//! ```

mod accuracy;
mod badges;
mod beside;
mod certainty;
mod chart;
mod choices;
mod columns;
mod compare;
mod detail;
mod differences;
mod fields;
mod firing_map;
mod fitting;
mod flight;
mod flight_legend;
mod from_above;
mod from_the_side;
mod gauges;
mod hardest_cables;
mod header;
mod help;
mod histogram;
mod holds_chart;
mod lattice;
mod launch;
mod limit_chart;
mod map_numbers;
mod message;
mod next_step;
mod now_line;
mod option_bars;
mod plan;
mod plan_verdict;
mod questions;
pub(super) mod report;
mod sentences;
mod signs;
mod six_lines;
mod so_far;
mod studies;
mod tried_chart;
mod widgets;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Paragraph, Wrap};
use tui_input::Input;

use self::widgets::draw_row;
use super::app::{App, Areas, ClickTarget};
use super::keymap::{Action, BINDINGS, Binding};
use super::player::ShownShot;
use super::prompt::{Prompt, Purpose};
use super::screen::Screen;
use crate::sorting::sorted_by_key;
use crate::study::question::StudyKind;
use crate::study::standing::Doubt;

/// Least width and height of a screen that can be drawn.
pub const LEAST_SIZE: (u16, u16) = (60, 18);

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame) -> Areas {
    let (area, mut areas) = (frame.area(), Areas::new());
    frame.render_widget(Block::new().style(app.theme.base()), area);
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        let text =
            format!("shelter needs {}x{}, has {}x{}", LEAST_SIZE.0, LEAST_SIZE.1, area.width, area.height);
        frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), area);
        return areas;
    }
    let message = message::lines(app, area.width);
    let [tabs, header, body, below, footer] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(2),
        Constraint::Min(0),
        Constraint::Length(message.len() as u16),
        Constraint::Length(1),
    ])
    .areas(area);
    draw_tabs(app, frame, tabs, &mut areas);
    header::draw(app, frame, header);
    let inner = within_margin(body);
    match app.screen {
        Screen::Plan => plan::draw(app, frame, inner, &mut areas),
        Screen::Compare => draw_options(app, frame, body, &mut areas),
        Screen::Flight => flight::draw(app, frame, inner, &mut areas),
        Screen::Studies => studies::draw(app, frame, inner, &mut areas),
        Screen::Accuracy => accuracy::draw(app, frame, inner, &mut areas),
    }
    frame.render_widget(Paragraph::new(message), below);
    match (&app.prompt, app.editor.typed()) {
        (Some(prompt), _) => draw_prompt(app, prompt, frame, below, footer),
        (None, Some(line)) if app.screen == Screen::Compare => {
            draw_typed(app, " ms: ", &line.input, frame, footer)
        }
        _ if app.asks_for_estimates() => {
            let keys = " y puts the estimates into the plan · Esc leaves it";
            frame.render_widget(Line::styled(keys, app.theme.title()), footer);
        }
        _ => draw_footer(app, frame, footer, &mut areas),
    }
    if app.help {
        help::draw(app, frame, area, &mut areas);
    } else if app.shows_differences {
        differences::draw(app, frame, area, &mut areas);
    }
    areas
}

/// Least height of the detail without charts: its rule and six lines.
const LINES: u16 = 7;
/// Number of options for which the table always has room.
const OPTIONS: u16 = 6;

/// Draws the table of options with the selected option below it, or only the selected option.
fn draw_options(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let rows = app.listed_options().len().max(1) as u16 + compare::HEAD_LINES;
    let most = match area.height.saturating_sub(LINES) {
        // No option is hidden to make room for a chart.
        without_charts if rows <= without_charts => rows,
        _ => area.height.saturating_sub(LINES + limit_chart::LEAST_SIZE.1).max(OPTIONS + compare::HEAD_LINES),
    };
    let table = if app.zoom { 0 } else { rows.min(most) };
    let [list, rest] = Layout::vertical([Constraint::Length(table), Constraint::Min(0)]).areas(area);
    if !app.zoom {
        compare::draw(app, frame, list, areas);
    }
    detail::draw(app, frame, within_margin(rest), areas);
}

/// Least width of a screen with a free column at its right end, as at its left end. On a narrower screen sentences need this column.
const WITH_MARGIN: u16 = 80;

/// The area without the column at its right end, if there is room for a margin.
fn within_margin(area: Rect) -> Rect {
    Rect { width: area.width - u16::from(area.width >= WITH_MARGIN), ..area }
}

fn draw_tabs(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let tab = |key: String, name: &'static str, shown: bool| {
        let style = if shown { app.theme.selected() } else { app.theme.muted() };
        Line::from(vec![
            Span::styled(format!(" {key} "), if shown { style } else { app.theme.title() }),
            Span::styled(format!("{name} "), style),
        ])
    };
    let screens = Screen::ALL.into_iter().map(|screen| {
        let action = Action::Show(screen);
        (tab(app.keymap.first_key(action), screen.name(), screen == app.screen), ClickTarget::Act(action))
    });
    let help = (tab(app.keymap.first_key(Action::Help), "Help", app.help), ClickTarget::Act(Action::Help));
    draw_row(screens.chain([help]), frame, area, areas);
    if app.beside.is_none() {
        let taken = areas.last().map_or(area.x, |(last, _)| last.right());
        let free = Rect { x: taken, width: area.right().saturating_sub(taken), ..area };
        let name = header::title_and_file(app, usize::from(free.width).saturating_sub(2));
        let name = name.map(|name| Line::styled(format!("{name} "), app.theme.muted()).right_aligned());
        frame.render_widget(name, free);
    }
}

/// Draws as many keys and labels as fit. First the main keys of the screen, after a change Save and Undo, then other keys of the screen,
/// then keys of all screens. Help and quit are always shown.
fn draw_footer(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let label = |action: Action, short: &'static str| {
        let key = Span::styled(format!(" {} ", app.keymap.first_key(action)), app.theme.title());
        let line = Line::from(vec![key, Span::styled(format!("{short} "), app.theme.muted())]);
        (line, ClickTarget::Act(action))
    };
    let end = [label(Action::Help, "help"), label(Action::Quit, "quit")];
    let width: usize = end.iter().map(|(line, _)| line.width()).sum();
    let [keys, last] = Layout::horizontal([Constraint::Min(0), Constraint::Length(width as u16)]).areas(area);
    let is_shown = |binding: &&Binding| !binding.short_on(app.screen).is_empty() && binding.is_on(app.screen);
    let is_of_use = |binding: &&Binding| match binding.action {
        Action::Cancel => cancels(app),
        Action::UseEstimates => is_on_fit(app) && app.has_estimates(),
        Action::Undo => app.editor.has_undo(),
        Action::Save => app.editor.unsaved() || app.standing().has(Doubt::NoFile),
        Action::Open => !(is_on_list(app) && app.awaits_selection()),
        // Before the changes are known, this key only looks for them, like `why`. On the list of changes, Enter makes a change.
        Action::Try => !app.lists_remedies() && app.studies.remedies(app.selected, &app.compute).is_some(),
        _ => true,
    };
    let shown = BINDINGS.iter().filter(is_shown).filter(is_of_use);
    let rank = |binding: &&Binding| match binding.action {
        Action::WritePage | Action::UseEstimates => 0,
        Action::Open if is_on_list(app) => 0,
        Action::Undo | Action::Save if app.editor.unsaved() => 1,
        _ if !binding.on.is_empty() => 2,
        _ => 3,
    };
    let labels =
        sorted_by_key(shown, rank).into_iter().map(|binding| label(binding.action, short(app, binding)));
    draw_row(labels, frame, keys, areas);
    draw_row(end, frame, last, areas);
}

/// Whether this screen has something to cancel: a study that computes, or a typed observation.
fn cancels(app: &App) -> bool {
    app.cancellable().is_some() || is_on_fit(app) && app.record.has_typed()
}

fn is_on_fit(app: &App) -> bool {
    app.screen == Screen::Studies && app.studies.shown == StudyKind::Fit
}

/// Whether the keys act on the list of changes.
fn is_on_list(app: &App) -> bool {
    let has_changes = || app.open_remedies().is_some_and(|(found, _)| found.passing().next().is_some());
    app.screen == Screen::Compare && has_changes()
}

/// Label of a key in the footer. Some labels depend on the state, for example Enter on the list of changes.
fn short(app: &App, binding: &Binding) -> &'static str {
    if binding.action == Action::Open && is_on_list(app) {
        "make this change"
    } else if binding.action == Action::Open && app.screen == Screen::Compare && app.zoom {
        "back"
    } else if binding.action == Action::Play && app.player.playing {
        "pause"
    } else if binding.action == Action::Open && is_on_fit(app) {
        "type an observation"
    } else if binding.action == Action::Cancel && app.cancellable().is_none() {
        "take back"
    } else if binding.action == Action::OtherShot && app.shown_shot == ShownShot::AsPlanned {
        "deciding"
    } else {
        binding.short_on(app.screen)
    }
}

/// Draws the line being typed with its cursor, and its list of choices above the `message`.
fn draw_prompt(app: &App, prompt: &Prompt, frame: &mut Frame, message: Rect, area: Rect) {
    let head = match prompt.purpose {
        Purpose::Find if app.screen == Screen::Plan => " find (Down: next): ",
        Purpose::Find => " find: ",
        Purpose::Palette => " : ",
        Purpose::Export => " write to (.csv, .svg, .html): ",
        Purpose::PageOf(_) => " page of: ",
        Purpose::Page => " write the page to: ",
        Purpose::SaveAs => " save the plan as: ",
        Purpose::Fired => " fired: ",
        Purpose::Observe(_) => " seen: ",
        Purpose::Forget => {
            let keys = Line::styled(" y takes it back · any other key leaves it", app.theme.title());
            return frame.render_widget(keys, area);
        }
    };
    match prompt.purpose {
        Purpose::Palette => choices::draw_commands(app, prompt, frame, message),
        Purpose::Fired => choices::draw_options(app, prompt, frame, message),
        Purpose::PageOf(best) => choices::draw_pages(app, best, prompt, frame, message),
        _ => {}
    }
    draw_typed(app, head, &prompt.line.input, frame, area);
}

/// Draws a line being typed behind `head`, with its cursor.
fn draw_typed(app: &App, head: &str, input: &Input, frame: &mut Frame, area: Rect) {
    let wide = Span::raw(head).width();
    let room = usize::from(area.width).saturating_sub(wide + 1);
    let scroll = input.visual_scroll(room);
    let typed: String = input.value().chars().skip(scroll).collect();
    let line = Line::from(vec![Span::styled(head, app.theme.title()), Span::raw(typed)]);
    frame.render_widget(line, area);
    let column = wide + input.visual_cursor().saturating_sub(scroll);
    let x = area.x + (column as u16).min(area.width.saturating_sub(1));
    frame.set_cursor_position(Position::new(x, area.y));
}
