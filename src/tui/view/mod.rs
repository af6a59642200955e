//! Draws the screens. Every part is a function of the app and an area, and changes nothing. Drawing returns the areas that
//! take clicks.
//!
//! ```text
//! 1 Plan  2 Compare  3 Flight  4 Studies  5 Accuracy  ? Help    tabs
//! title · plan                                    state         header
//! limits · method · accuracy
//! contents of the screen                                        body
//! keys, or the line being typed                                 footer
//! ```

mod accuracy;
mod chart;
mod command_palette;
mod compare;
mod detail;
mod fields;
mod flight;
mod gauges;
mod help;
mod map_numbers;
mod plan;
pub(super) mod report;
mod studies;
mod widgets;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use self::widgets::draw_row;
use super::app::{App, Areas, ClickTarget};
use super::compare::OptionState;
use super::keymap::{Action, BINDINGS, Binding};
use super::prompt::{Prompt, Purpose};
use super::screen::Screen;
use crate::report::words::limits::limits_in_short;
use crate::report::words::option_sentences::compute_label;
use crate::report::words::warnings;
use crate::study::judgement::Judgement;
use crate::units;
use crate::verdict::Verdict;

/// Least width and height of a screen that holds everything.
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
    let [tabs, header, body, footer] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(2),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(area);
    draw_tabs(app, frame, tabs, &mut areas);
    draw_header(app, frame, header);
    match app.screen {
        Screen::Plan => plan::draw(app, frame, body, &mut areas),
        Screen::Compare => draw_options(app, frame, body, &mut areas),
        Screen::Flight => flight::draw(app, frame, body, &mut areas),
        Screen::Studies => studies::draw(app, frame, body, &mut areas),
        Screen::Accuracy => accuracy::draw(app, frame, body),
    }
    match &app.prompt {
        Some(prompt) => draw_prompt(app, prompt, frame, footer),
        None => draw_footer(app, frame, footer, &mut areas),
    }
    draw_long_notice(app, frame, header.union(body));
    if app.help {
        help::draw(app, frame, area, &mut areas);
    }
    areas
}

/// Draws the table of options with the selected option below, or the selected option alone.
fn draw_options(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let rows = app.listed().len().max(1) as u16 + 1;
    let table = if app.zoom { 0 } else { rows.min(area.height / 2) };
    let [list, rest] = Layout::vertical([Constraint::Length(table), Constraint::Min(0)]).areas(area);
    if !app.zoom {
        compare::draw(app, frame, list, areas);
    }
    detail::draw(app, frame, rest);
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
}

fn draw_header(app: &App, frame: &mut Frame, area: Rect) {
    let (case, theme) = (&app.case, app.theme);
    let mut about = format!("limits: {}", limits_in_short(case));
    about += &format!(", risk {} %", units::short(case.plan.limits.accepted_risk_percent));
    if case.plan.uncertainty.assumed {
        about += " · inputs assumed";
    }
    about += &format!(" · {}", compute_label(&app.compute));
    let size = format!(" · {} tires, {} cables", case.scene().tire_count(), case.scene().cables.len());
    if Span::raw(&about).width() + Span::raw(&size).width() <= usize::from(area.width) {
        about += &size;
    }
    let unsaved = if app.editor.unsaved() { " *not saved*" } else { "" };
    let title = Line::from(vec![
        Span::styled(case.title(), theme.title()),
        Span::styled(unsaved, theme.limit()),
        Span::styled(format!("  {}", case.source.path), theme.muted()),
    ]);
    let state = Line::from(summary(app)).right_aligned().style(theme.title());
    let [first, second] = Layout::vertical([Constraint::Length(1); 2]).areas(area);
    let [left, right] =
        Layout::horizontal([Constraint::Min(0), Constraint::Length(state.width() as u16 + 1)]).areas(first);
    frame.render_widget(title, left);
    frame.render_widget(state, right);
    let filter = if app.screen == Screen::Studies { &app.studies.filter } else { &app.listing.filter };
    let line = match &app.notice {
        Some(notice) => Line::styled(notice.as_str(), theme.limit()),
        None if !filter.is_empty() => {
            let what = if app.screen == Screen::Studies { "lines" } else { "options" };
            Line::styled(format!("only {what} with '{filter}' are shown; Esc shows all"), theme.limit())
        }
        None => {
            let warnings = warnings::of_plan(case);
            let warning = match (warnings.as_slice(), app.screen) {
                ([], _) => String::new(),
                // The Plan screen lists them.
                (all, Screen::Plan) if all.len() > 1 => format!("! {} warnings, below · ", all.len()),
                ([only], _) => format!("! {only} · "),
                (all, _) => format!("! {} warnings: see Plan · ", all.len()),
            };
            // What was seen of earlier shots speaks against every verdict of the plan.
            let contradiction = if app.contradiction().is_empty() {
                ""
            } else if !app.is_compared_with_seen() {
                "! what was seen is not compared with this plan · "
            } else {
                "! what was seen contradicts this plan: see Compare · "
            };
            let answer = answer(app).filter(|_| app.screen == Screen::Compare);
            let mut spans = vec![
                Span::styled(contradiction, theme.limit()),
                Span::styled(warning, theme.limit()),
                Span::styled(about, theme.muted()),
            ];
            spans.splice(0..0, answer);
            Line::from(spans)
        }
    };
    frame.render_widget(line, second);
}

/// The answer, before all else on Compare: which option passes and is the safest, or HOLD where what was seen contradicts the plan.
fn answer(app: &App) -> Option<Span<'static>> {
    let (best, text) = app.answer.as_ref()?;
    let theme = app.theme;
    Some(match best {
        _ if !app.contradiction().is_empty() => Span::styled("HOLD · ", theme.limit()),
        Some(_) => Span::styled(format!("✓ {text} · "), theme.verdict(Verdict::Pass)),
        None => {
            let why = app.keymap.hint(Action::Why);
            Span::styled(
                format!("✗ {text}; {why}: what would make one pass · "),
                theme.verdict(Verdict::Fail),
            )
        }
    })
}

/// Lines that a notice may cover.
const NOTICE_LINES: u16 = 4;

/// Draws a notice that is wider than its line of the header over the lines below.
fn draw_long_notice(app: &App, frame: &mut Frame, area: Rect) {
    let Some(notice) = app.notice.as_ref().filter(|notice| notice.width() > usize::from(area.width)) else {
        return;
    };
    // Broken at words, a line is filled to four fifths at least.
    let lines = notice.width().div_ceil(usize::from(area.width) * 4 / 5) as u16;
    let place = Rect { y: area.y + 1, height: lines.min(NOTICE_LINES), ..area }.intersection(area);
    let style = app.theme.base().patch(app.theme.limit());
    frame.render_widget(Clear, place);
    frame.render_widget(Paragraph::new(notice.as_str()).style(style).wrap(Wrap { trim: true }), place);
}

/// State of the whole plan: options checked as planned, options that need more samples, or options that pass.
fn summary(app: &App) -> String {
    let count = |has: fn(&OptionState) -> bool| app.options.iter().filter(|state| has(state)).count();
    let all = app.options.len();
    if app.checking() {
        format!("computing {}/{all}", count(|state| !state.is_computing()))
    } else if app.sampling() {
        format!("sampling: {} of {all} open", count(|state| state.verdict() == Verdict::Undecided))
    } else {
        let against = if app.contradiction().is_empty() { "" } else { ", contradicted" };
        format!("{} of {all} pass{against}", count(|state| state.verdict() == Verdict::Pass))
    }
}

/// Draws keys and labels: first the keys of the screen, then the keys of all screens, as many as fit; help and quit always.
fn draw_footer(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let label = |action: Action, short: &'static str| {
        let key = Span::styled(format!(" {} ", app.keymap.first_key(action)), app.theme.title());
        let line = Line::from(vec![key, Span::styled(format!("{short} "), app.theme.muted())]);
        (line, ClickTarget::Act(action))
    };
    let end = [label(Action::Help, "help"), label(Action::Quit, "quit")];
    let width: usize = end.iter().map(|(line, _)| line.width()).sum();
    let [keys, last] = Layout::horizontal([Constraint::Min(0), Constraint::Length(width as u16)]).areas(area);
    let shown = BINDINGS.iter().filter(|binding| !binding.short.is_empty() && binding.is_on(app.screen));
    let (special, general): (Vec<_>, Vec<_>) = shown.partition(|binding| !binding.on.is_empty());
    let labels = special.into_iter().chain(general).map(|binding| label(binding.action, short(app, binding)));
    draw_row(labels, frame, keys, areas);
    draw_row(end, frame, last, areas);
}

/// Label of a key in the footer: Enter on the list of changes makes one.
fn short(app: &App, binding: &Binding) -> &'static str {
    let is_on_list = app.screen == Screen::Compare && app.studies.remedy_list.is_some();
    if binding.action == Action::Open && is_on_list {
        "change the plan"
    } else {
        binding.short_on(app.screen)
    }
}

/// Most characters of an option's name before a file that is typed.
const LONGEST_NAME: usize = 24;

/// Draws the line being typed, with the cursor.
fn draw_prompt(app: &App, prompt: &Prompt, frame: &mut Frame, area: Rect) {
    let option = app.case.plan.delays.get(app.selected).map_or("", |delay| delay.name.as_str());
    let verdict = app.judgement(app.selected).map_or(Verdict::Undecided, Judgement::verdict);
    let against = if app.contradiction().is_empty() { "" } else { ", contradicted" };
    let verdict = verdict.for_people();
    let page = format!(" page of “{}” ({verdict}{against}): ", compare::cut(option, LONGEST_NAME));
    let seen = format!(" seen of “{}” (TIRE VALUE SD, or a .csv file): ", compare::cut(option, LONGEST_NAME));
    let last = app.observed.last().unwrap_or_default();
    let forgotten = format!(" Enter takes back “{}”, Esc keeps it ", compare::cut(&last, LONGEST_NAME));
    let head = match prompt.purpose {
        Purpose::Find if app.screen == Screen::Plan => " find (Down: next): ",
        Purpose::Find => " find: ",
        Purpose::Palette => " : ",
        Purpose::Export => " write to (.csv, .svg, .html): ",
        Purpose::Page => &page,
        Purpose::SaveAs => " save the plan as: ",
        Purpose::Observe => &seen,
        Purpose::Forget => &forgotten,
    };
    if prompt.purpose == Purpose::Palette {
        command_palette::draw(app, prompt, frame, area);
    }
    let wide = Span::raw(head).width();
    let room = usize::from(area.width).saturating_sub(wide + 1);
    let scroll = prompt.input.visual_scroll(room);
    let typed: String = prompt.input.value().chars().skip(scroll).collect();
    let line = Line::from(vec![Span::styled(head, app.theme.title()), Span::raw(typed)]);
    frame.render_widget(line, area);
    let column = wide + prompt.input.visual_cursor().saturating_sub(scroll);
    let x = area.x + (column as u16).min(area.width.saturating_sub(1));
    frame.set_cursor_position(Position::new(x, area.y));
}
