//! What is drawn where. Every part is a function of the app and an area; none changes anything.
//!
//! ```text
//! title · plan                                  header
//! limits · method · accuracy
//! option  verdict  height  force  factor  …     table
//! ──────────────────────────────────────────
//! selected option: facts, two charts            detail
//! keys                                          footer
//! ```

mod chart;
mod detail;
mod help;
mod plan;
mod studies;
mod table;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Paragraph, Wrap};

use super::app::{App, Row, Screen};
use super::keymap::KEYS;
use crate::report::check::method_name;
use crate::report::table::accuracy_name;
use crate::units::{self, Unit};
use crate::verdict::Verdict;

/// Smallest screen that holds everything.
pub const LEAST: (u16, u16) = (60, 18);

/// Draws the whole screen.
pub fn draw(app: &App, frame: &mut Frame) {
    let area = frame.area();
    frame.render_widget(Block::new().style(app.theme.base()), area);
    if area.width < LEAST.0 || area.height < LEAST.1 {
        let text = format!("shelter needs {}x{}, has {}x{}", LEAST.0, LEAST.1, area.width, area.height);
        return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), area);
    }
    let [header, body, footer] =
        Layout::vertical([Constraint::Length(2), Constraint::Min(0), Constraint::Length(1)]).areas(area);
    draw_header(app, frame, header);
    match app.screen {
        Screen::Compare => draw_options(app, frame, body),
        Screen::Studies => studies::draw(app, frame, body),
        Screen::Plan => plan::draw(app, frame, body),
    }
    draw_footer(app, frame, footer);
    if app.help {
        help::draw(app, frame, area);
    }
}

/// The table of options and the selected one below it, or that alone.
fn draw_options(app: &App, frame: &mut Frame, area: Rect) {
    let rows = app.rows.len() as u16 + 1;
    let table = if app.zoom { 0 } else { rows.min(area.height / 2) };
    let [list, rest] = Layout::vertical([Constraint::Length(table), Constraint::Min(0)]).areas(area);
    if !app.zoom {
        table::draw(app, frame, list);
    }
    detail::draw(app, frame, rest);
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
    let level = match app.effort.step {
        Some(step) => format!("step {}", units::milliseconds(step)),
        None => accuracy_name(app.effort.accuracy).to_owned(),
    };
    about += &format!(" · {}, {level}", method_name(app.effort.method));
    about += &format!(" · {} tires, {} cables", case.scene().mass.len(), case.scene().cables.len());
    let title = Line::from(vec![
        Span::styled(case.plan.title.as_str(), theme.title()),
        Span::styled(format!("  {}", case.plan.path), theme.quiet()),
    ]);
    let state = Line::from(summary(app)).right_aligned().style(theme.title());
    let [first, second] = Layout::vertical([Constraint::Length(1); 2]).areas(area);
    let [left, right] =
        Layout::horizontal([Constraint::Min(0), Constraint::Length(state.width() as u16 + 1)]).areas(first);
    frame.render_widget(title, left);
    frame.render_widget(state, right);
    let line = match &app.notice {
        Some(notice) => Line::styled(notice.as_str(), theme.limit()),
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

fn draw_footer(app: &App, frame: &mut Frame, area: Rect) {
    let mut spans = Vec::new();
    let mut add = |label: &str, short: &'static str| {
        spans.push(Span::styled(format!(" {label} "), app.theme.title()));
        spans.push(Span::styled(format!("{short} "), app.theme.quiet()));
    };
    let keys: &[(&str, &'static str)] = match app.screen {
        Screen::Compare => &[],
        Screen::Studies => &[("Left Right", "study"), ("Enter", "start"), ("x", "cancel")],
        Screen::Plan => &[("Enter", "edit"), ("Left Right", "step"), ("u", "undo"), ("s", "save")],
    };
    [("1", "compare"), ("2", "studies"), ("3", "plan")]
        .into_iter()
        .for_each(|(label, short)| add(label, short));
    keys.iter().for_each(|(label, short)| add(label, short));
    if app.screen == Screen::Compare {
        for binding in KEYS.iter().filter(|binding| !binding.short.is_empty()) {
            add(binding.label.split(' ').next().unwrap_or_default(), binding.short);
        }
    }
    [("?", "help"), ("q", "quit")].into_iter().for_each(|(label, short)| add(label, short));
    frame.render_widget(Line::from(spans), area);
}
