//! Long studies: sweep, orders, scatter and size, one shown at a time.
//!
//! ```text
//!  Sweep   Orders   Scatter   Size
//! ──────────────────────────────────
//! what it found; for the sweep, charts against the interval
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Dataset, Gauge, Paragraph, Wrap};

use super::chart::{Scale, chart, line};
use super::{Places, spread};
use crate::report;
use crate::report::text::{Style as Plain, text as as_text};
use crate::study::sweep::{Point, Sweep};
use crate::tui::app::{App, Target};
use crate::tui::keymap::Action;
use crate::tui::studies::Progress;
use crate::units::{self, Unit};
use crate::verdict::Verdict;
use crate::worker::{Found, Kind};

/// What lines of sparklines contain.
const BARS: [char; 3] = ['▁', '▄', '▇'];

/// Name of a study, and what it answers.
fn about(kind: Kind) -> (&'static str, &'static str) {
    match kind {
        Kind::Sweep => {
            ("Sweep", "Which intervals between rows pass? From 0 to 500 ms, closer where the answer changes.")
        }
        Kind::Orders => (
            "Orders",
            "Which order of the rows is worst, which best? All orders at the intervals of the plan.",
        ),
        Kind::Scatter => (
            "Scatter",
            "How often does each option fail when detonators and launches scatter? 1000 samples each.",
        ),
        Kind::Size => ("Size", "What is the lightest rope, tire and border with which every option passes?"),
        // Have screens of their own.
        Kind::Flight | Kind::Accuracy => ("", ""),
    }
}

/// Draws the studies.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, places: &mut Places) {
    let [tabs, body] = Layout::vertical([Constraint::Length(1), Constraint::Min(0)]).areas(area);
    let word = |kind: Kind| {
        let style = if kind == app.studies.shown { app.theme.selected() } else { app.theme.base() };
        let name = Span::styled(format!(" {} ", about(kind).0), style);
        Line::from(vec![name, Span::styled(format!("{} ", app.studies.state(kind)), app.theme.quiet())])
    };
    let words = Kind::STUDIES.map(|kind| (word(kind), Target::Study(kind)));
    super::draw_row(words, frame, tabs, places);
    let rule = Block::new().borders(Borders::TOP).border_style(app.theme.quiet());
    let inside = rule.inner(body);
    frame.render_widget(rule, body);
    let kind = app.studies.shown;
    let question = Line::styled(about(kind).1, app.theme.title());
    match app.studies.progress(kind) {
        Progress::Idle => {
            let words = format!("{} starts it.", app.keymap.hint(Action::Open));
            message(app, frame, inside, question, &words);
        }
        Progress::Failed(reason) => {
            message(app, frame, inside, question, &report::no_result::message(reason));
        }
        Progress::Running { done, total } => {
            waiting(app, frame, inside, question, (*done, *total));
        }
        Progress::Done(found) => match found.as_ref() {
            Found::Sweep(sweep) => draw_sweep(app, sweep, frame, inside),
            found => {
                let text = text(app, found);
                // The words first; the picture takes what they leave.
                let words = (text.lines().count() as u16 + 1).clamp(inside.height / 2, inside.height);
                let [words, picture] =
                    Layout::vertical([Constraint::Length(words), Constraint::Min(0)]).areas(inside);
                scrolled(app, frame, words, &text, places);
                spread::draw(app, found, frame, picture);
            }
        },
    }
}

/// How far a study is.
pub fn waiting(app: &App, frame: &mut Frame, area: Rect, question: Line<'_>, (done, total): (usize, usize)) {
    let [text, bar] = Layout::vertical([Constraint::Length(2), Constraint::Length(1)]).areas(area);
    frame.render_widget(Paragraph::new(question), text);
    let part = if total > 0 { done as f64 / total as f64 } else { 0.0 };
    let label = format!("{done} of {total} shots · {} cancels", app.keymap.hint(Action::Cancel));
    let gauge = Gauge::default().ratio(part.clamp(0.0, 1.0)).label(label).gauge_style(app.theme.curve());
    frame.render_widget(gauge, bar);
}

/// A question without an answer, and why.
pub fn message(app: &App, frame: &mut Frame, area: Rect, question: Line<'_>, words: &str) {
    let mut lines = vec![question, Line::default()];
    lines.extend(words.lines().map(|line| Line::styled(line, app.theme.base())));
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}

/// The same text as the command prints, without its heading, which stands above already.
fn text(app: &App, found: &Found) -> String {
    let case = &app.case;
    let found = match found {
        Found::Sweep(sweep) => report::sweep::report(case, sweep, false),
        Found::Orders(orders) => report::orders::report(case, orders, false),
        Found::Scatter(draw, samples) => report::scatter::report(case, draw, samples, false),
        Found::Size(sizing) => report::size::report(case, sizing),
        Found::Flight(_) | Found::Accuracy(_) => return String::new(),
    };
    as_text(&report::model::Report { title: String::new(), facts: Vec::new(), ..found }, Plain::default())
}

fn scrolled(app: &App, frame: &mut Frame, area: Rect, text: &str, places: &mut Places) {
    let kept = |line: &&str| line.to_lowercase().contains(&app.studies.filter.to_lowercase());
    // Sentences go on in the next line, rows of a table do not.
    let width = usize::from(area.width.max(1));
    let fitted: Vec<String> = text
        .lines()
        .filter(kept)
        .map(|line| if line.contains("  ") { line.chars().take(width).collect() } else { line.to_owned() })
        .collect();
    let high: usize = fitted.iter().map(|line| line.chars().count().div_ceil(width).max(1)).sum();
    let lines: Vec<Line> = fitted.iter().map(|line| with_verdicts(app, line)).collect();
    let most = (high as u16).saturating_sub(area.height);
    places.push((area, Target::Lines(most)));
    let text = Paragraph::new(lines).wrap(Wrap { trim: false });
    frame.render_widget(text.scroll((app.studies.scroll.min(most), 0)), area);
}

/// A line of a report with its first verdict in its colour.
fn with_verdicts<'l>(app: &App, line: &'l str) -> Line<'l> {
    let words = [("PASS", Verdict::Pass), ("FAIL", Verdict::Fail), ("OPEN", Verdict::Undecided)];
    for (word, verdict) in words {
        if let Some((before, after)) = line.split_once(word) {
            let word = Span::styled(word, app.theme.verdict(verdict));
            return Line::from(vec![Span::raw(before), word, Span::raw(after)]);
        }
    }
    Line::raw(line)
}

fn draw_sweep(app: &App, sweep: &Sweep, frame: &mut Frame, area: Rect) {
    let text = text(app, &Found::Sweep(sweep.clone()));
    // What the charts show need not stand there as bars.
    let facts: Vec<&str> = text.lines().filter(|line| !line.contains(BARS) && !line.is_empty()).collect();
    let lines: Vec<Line> = facts.iter().map(|line| with_verdicts(app, line)).collect();
    let [words, left, right] = Layout::vertical([
        Constraint::Length((lines.len() as u16 + 1).min(area.height / 2)),
        Constraint::Fill(1),
        Constraint::Fill(1),
    ])
    .areas(area);
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: false }), words);
    let limits = &app.case.limits;
    draw_curve(app, sweep, |point| point.envelope.height.value, limits.height, Unit::Metre, frame, left);
    draw_curve(app, sweep, |point| point.envelope.force.value, limits.force, Unit::Kilonewton, frame, right);
}

/// A quantity against the interval; stretches that pass lie under a line along the bottom.
fn draw_curve(
    app: &App,
    sweep: &Sweep,
    of: fn(&Point) -> f64,
    limit: f64,
    unit: Unit,
    frame: &mut Frame,
    area: Rect,
) {
    if area.height < 3 || area.width < 20 {
        return;
    }
    let (size, [from, to]) = (unit.size(), sweep.range().map(|interval| interval * 1e3));
    // A run that failed has no value.
    let known = || sweep.points.iter().filter(|point| of(point).is_finite());
    let curve: Vec<(f64, f64)> = known().map(|point| (point.interval * 1e3, of(point) / size)).collect();
    let top = known().map(of).fold(limit, f64::max) / size * 1.08;
    let limit = [(from, limit / size), (to, limit / size)];
    let windows: Vec<Vec<(f64, f64)>> = sweep
        .windows()
        .iter()
        .map(|[from, to]| {
            let columns = usize::from(area.width);
            let at = |n: usize| 1e3 * (from + (to - from) * n as f64 / columns as f64);
            (0..=columns).map(|n| (at(n), top * 0.02)).collect()
        })
        .collect();
    let pass = app.theme.verdict(Verdict::Pass);
    let mut sets: Vec<Dataset> = windows.iter().map(|window| line(window, pass, Marker::Block)).collect();
    sets.push(line(&limit, app.theme.limit(), Marker::Dot));
    sets.push(line(&curve, app.theme.curve(), Marker::Braille));
    let at = [from, 0.5 * (from + to), to].map(|ms| units::milliseconds(ms * 1e-3));
    let name = if unit == Unit::Metre { "flight height, m" } else { "cable force, kN" };
    let title = format!("{name} against the interval (dotted: limit; bar below: passes)");
    let chart = chart(app, title, sets, Scale::new([from, to], at), Scale::up_to(top));
    frame.render_widget(chart, area);
}
