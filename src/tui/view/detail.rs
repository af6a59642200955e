//! The selected option: six short lines, the cables from above on a wide screen, and charts. If enlarged, also its sentences.
//!
//! ```text
//! ─ 42 ms ✓ PASS · rows fire at 0/42/84 ms ─ 2:1 is row 2, column 1 ─
//!  fails    0 of 500 shots tried; …   ┬ cables pulled hardest ─────────
//!  highest  …                         │
//!  height in time                     │  force in time
//!  height of the shots                │  force of the shots
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::compare::verdict_words;
use super::sentences::sentences;
use super::six_lines::{six_lines, why};
use super::widgets::{dim_if_held, draw_divider, wrapped};
use super::{beside, hardest_cables, limit_chart, signs};
use crate::plan;
use crate::report::charts;
use crate::report::remedies::{at_most_fail, sentence, thinly, without_pass, word_as_planned, words};
use crate::report::words::headline::unchecked;
use crate::report::words::no_result;
use crate::report::words::option_sentences::firing_times;
use crate::report::words::progress_words::describe;
use crate::study::judge::Judgement;
use crate::study::question::StudyKind;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::compare::OptionState;
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::tui::theme;
use crate::verdict::VerdictWord;

/// Least screen width that shows the cables from above beside the lines.
const WITH_CABLES: u16 = 119;
/// Least and greatest height of the cables from above.
const CABLES: [u16; 2] = [8, 18];
/// Least width and height for a flight beside the charts.
const WITH_FLIGHT: (u16, u16) = (149, 9);
/// Least, usual and greatest height of the lines above charts.
const LINES: [u16; 3] = [6, 6, 10];
/// Least height of the sentences of an enlarged option: more lines than a page key scrolls.
const SENTENCES: u16 = 6;
/// Lines above the list of changes: what fails, and what limits it.
const WHY: usize = 3;

/// Draws the detail of the selected option.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let inside = draw_rule(app, frame, area);
    let judged = match app.options.get(app.selected) {
        Some(OptionState::Judged { judgement, .. }) => judgement,
        Some(OptionState::Failed(failed)) => {
            let text = format!("No result: {}", no_result::message(failed));
            return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), inside);
        }
        Some(OptionState::Waiting | OptionState::Running { .. }) => {
            return frame.render_widget("Computing…", inside);
        }
        None => return,
    };
    if app.lists_remedies() {
        return draw_remedies(app, judged, frame, inside, areas);
    }
    let with_cables = area.width >= WITH_CABLES && inside.height >= CABLES[0];
    let with_flight = inside.width >= WITH_FLIGHT.0;
    // The parts beside text and beside charts have the same width.
    let right = inside.width * 9 / 20;
    let beside = if with_cables { right } else { 0 };
    let cables = if with_cables { (inside.height * 3 / 5).clamp(CABLES[0], CABLES[1]) } else { 0 };
    let rows = match () {
        () if with_cables => cables,
        () if app.zoom => inside.height.saturating_sub(limit_chart::LEAST_SIZE.1 + SENTENCES).max(LINES[0]),
        () => rows_above_charts(inside.height),
    };
    let between = u16::from(with_cables);
    let lines = six_lines(app, judged, inside.width - beside - between, usize::from(rows));
    let height = if app.zoom && !with_cables { lines.len() as u16 } else { rows };
    let [top, rest] = Layout::vertical([Constraint::Length(height), Constraint::Min(0)]).areas(inside);
    let columns = Layout::horizontal([Constraint::Min(0), Constraint::Length(beside)]).spacing(between);
    let [text, cables] = columns.areas(top);
    frame.render_widget(Paragraph::new(lines), text);
    if with_cables {
        hardest_cables::draw(app, judged, frame, cables);
        draw_divider(app, frame, text);
        dim_if_held(app, frame, cables);
    }
    let rest = if app.zoom { draw_sentences(app, judged, frame, rest, areas) } else { rest };
    if with_flight && rest.height >= WITH_FLIGHT.1 {
        draw_charts_and_flight(app, judged, frame, rest, right, areas);
    } else {
        draw_charts(app, cursor(app), frame, rest, areas);
    }
    dim_if_held(app, frame, rest);
}

/// Time of the repeating flight [s].
fn cursor(app: &App) -> Option<f64> {
    app.flight_below().map(|(_, time)| time)
}

/// Draws the charts, and `right` cells beside them the moving view: the flight, or the sampled shots.
fn draw_charts_and_flight(
    app: &App,
    judged: &Judgement,
    frame: &mut Frame,
    area: Rect,
    right: u16,
    areas: &mut Areas,
) {
    let [charts, right] =
        Layout::horizontal([Constraint::Min(0), Constraint::Length(right)]).spacing(1).areas(area);
    areas.push((right, ClickTarget::Flight));
    beside::draw(app, judged, frame, right);
    draw_charts(app, cursor(app), frame, charts, areas);
    draw_divider(app, frame, charts);
}

/// Rows of the lines above the charts. They depend only on the height, so the charts stay in place whatever becomes known of the option.
fn rows_above_charts(height: u16) -> u16 {
    let [least, usual, most] = LINES;
    match height.checked_sub(limit_chart::LEAST_SIZE.1).filter(|rows| *rows >= least) {
        Some(rows) => (height / 2).clamp(usual, most).min(rows),
        None => height,
    }
}

/// Draws the rule above the detail: the option's name, its firing times, and the meaning of its verdict or of a tire number, as far as they
/// fit. If enlarged, the meaning of the signs instead, because no table stands above. Returns the area left.
fn draw_rule(app: &App, frame: &mut Frame, area: Rect) -> Rect {
    let rule = Block::new().borders(Borders::TOP).border_style(app.theme.muted());
    let inside = rule.inner(area);
    let Some(delay) = app.case.plan.delays.get(app.selected) else { return inside };
    let name = Span::styled(format!(" {}{} ", app.letter(), delay.name), app.theme.title());
    let beside =
        app.verdict_beside().map_or_else(String::new, |[letter, verdict]| format!(", {letter} {verdict}"));
    let times = [format!("· rows fire at {} ", firing_times(delay)), String::new()];
    let (words, style) = verdict_words(app, app.selected);
    // A user who reads only this line must not take the pass for more than it is.
    let passes = [VerdictWord::Pass, VerdictWord::Thin].contains(&app.word(app.selected));
    let is_said = passes && app.stands_on_so_far(app.selected).is_some() && beside.is_empty();
    let others = name.width() + words.width() + 1 + times[0].width() + 2;
    let unchecked = unchecked(&app.case);
    let has_room = unchecked.width() < usize::from(area.width).saturating_sub(others);
    let unchecked = if is_said && has_room { unchecked } else { "" };
    // The words say what the sign of the proviso says.
    let words = if unchecked.is_empty() { words } else { words.trim_end_matches(theme::PROVISO) };
    let verdict = app
        .judgement(app.selected)
        .map_or(Span::default(), |_| Span::styled(format!("{words}{unchecked}{beside} "), style));
    let room = usize::from(area.width).saturating_sub(name.width() + verdict.width() + 2);
    let fits = |text: &&String| text.width() < room;
    let times = times.iter().find(fits).cloned().unwrap_or_default();
    let left = room.saturating_sub(times.width() + 2);
    let mut meaning = match app.zoom {
        true => signs::line(app, left.saturating_sub(2)),
        false => meaning(app).filter(|text| text.width() + 2 < left).map_or_else(Line::default, Line::from),
    };
    if meaning.width() > 0 {
        meaning.spans.insert(0, Span::raw(" "));
        meaning.push_span(" ");
    }
    let times = Span::styled(times, app.theme.muted());
    let rule = rule.title(Line::from(vec![name, verdict, times]));
    let rule = rule.title(meaning.style(app.theme.muted()).right_aligned());
    frame.render_widget(rule, area);
    inside
}

/// Meaning of the selected option's verdict if it is not obvious, otherwise how tires are numbered.
fn meaning(app: &App) -> Option<&'static str> {
    let is_trying = app.options[app.selected].is_sampling();
    match app.judgement(app.selected).map(|_| app.word(app.selected)) {
        Some(VerdictWord::Open) if !is_trying => Some("OPEN: not proven, do not fire"),
        _ if matches!(app.case.plan.layout, plan::Layout::Grid(_)) => Some("2:1 is row 2, column 1"),
        _ => None,
    }
}

/// Draws the sentences of the option, scrollable if they do not fit. Returns the area left below.
fn draw_sentences(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect, areas: &mut Areas) -> Rect {
    // Aligned with the text above.
    let whole = area;
    let area = Rect { x: area.x + 1, width: area.width.saturating_sub(1), ..area };
    let lines = sentences(app, judged);
    let height = wrapped(&lines, area.width);
    let [text, rest] = Layout::vertical([Constraint::Length(height), Constraint::Min(0)]).areas(area);
    // The hint to scroll has a line of its own, so it covers no word.
    let cue = u16::from(height > text.height);
    let [text, below] = Layout::vertical([Constraint::Min(0), Constraint::Length(cue)]).areas(text);
    let over = height - text.height;
    let scroll = app.zoom_scroll.min(over);
    areas.push((Rect::ZERO, ClickTarget::Lines(over)));
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }).scroll((scroll, 0)), text);
    let page = |action| app.keymap.first_key(action);
    if scroll < over {
        mark_more(app, &format!(" … more: {} ", page(Action::PageDown)), frame, below);
    } else if over > 0 {
        mark_more(app, &format!(" back: {} ", page(Action::PageUp)), frame, below);
    }
    Rect { x: whole.x, width: whole.width, ..rest }
}

/// Draws a hint at the end of a text that more follows.
fn mark_more(app: &App, mark: &str, frame: &mut Frame, text: Rect) {
    let last = Rect { y: text.bottom().saturating_sub(1), height: text.height.min(1), ..text };
    let style = app.theme.title().add_modifier(Modifier::REVERSED);
    frame.render_widget(Line::styled(mark, style).right_aligned(), last);
}

/// Draws height and force over time, with a mark at the time `cursor` [s]. A click opens the flight.
pub(super) fn draw_charts(app: &App, cursor: Option<f64>, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let Some((shown, planned)) = app.courses(app.selected) else { return };
    let mut in_time = charts::history(&app.case, shown, planned);
    let band = app.bands.get(app.selected).and_then(Option::as_deref);
    band.into_iter().for_each(|band| charts::add_band(&mut in_time, band));
    let halves: [Rect; 2] = Layout::horizontal([Constraint::Fill(1); 2]).spacing(1).areas(area);
    for ((chart, name), half) in in_time.iter().zip(["height", "force"]).zip(halves) {
        let drawn = limit_chart::draw(app, chart, (name, shown[0].drawn), cursor, frame, half);
        areas.extend(drawn.map(|drawn| (drawn.area, ClickTarget::Time(drawn.end))));
    }
    if area.height >= limit_chart::TITLED {
        draw_divider(app, frame, halves[0]);
    }
}

/// Draws why the option does not pass, and the changes with which it would, above the charts. The selected change is always visible.
/// Changes that do not suffice are shown if they fit.
fn draw_remedies(app: &App, judged: &Judgement, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let RemedyLines { changes, refused, selected } = remedy_lines(app, area.width);
    // The charts are worth more than the line about the farther limit.
    let has_room = WHY + changes.len() + usize::from(limit_chart::LEAST_SIZE.1) <= area.height.into();
    let mut lines: Vec<Line<'_>> = why(app, judged, area.width, if has_room { WHY } else { WHY - 1 });
    let selected = lines.len() + selected;
    lines.extend(changes);
    let until_selected = wrapped(&lines[..(selected + 1).min(lines.len())], area.width);
    let height = wrapped(&lines, area.width) + wrapped(&refused, area.width);
    if app.open_remedies().is_none_or(|(found, _)| found.passing().next().is_none())
        || height + limit_chart::LEAST_SIZE.1 <= area.height
    {
        lines.extend(refused);
    }
    let height = wrapped(&lines, area.width);
    let [text, rest] = Layout::vertical([Constraint::Max(height), Constraint::Min(0)]).areas(area);
    let scroll = until_selected.saturating_sub(text.height);
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: false }).scroll((scroll, 0)), text);
    if height > text.height + scroll {
        mark_more(app, " … more below ", frame, text);
    }
    draw_charts(app, None, frame, rest, areas);
}

/// The list of changes that suffice, and lines about changes that do not.
struct RemedyLines<'a> {
    changes: Vec<Line<'a>>,
    refused: Vec<Line<'a>>,
    /// Index of the selected line in `changes`.
    selected: usize,
}

/// The changes with which the selected option would pass, the selected change marked; or the progress of their study.
fn remedy_lines<'a>(app: &App, width: u16) -> RemedyLines<'a> {
    let (case, theme) = (&app.case, app.theme);
    let Some((remedies, selected)) = app.open_remedies() else {
        let text = match app.studies.state(StudyKind::Remedies) {
            StudyState::Failed(failed) => no_result::message(failed),
            StudyState::Running(at) => {
                let at = describe(&at.progress, at.left);
                format!(" what would make it pass? {at} · Esc ends it")
            }
            StudyState::Idle | StudyState::Done(_) => " what would make it pass?".to_owned(),
        };
        return RemedyLines {
            changes: vec![Line::styled(text, theme.title())],
            refused: Vec::new(),
            selected: 0,
        };
    };
    let mut changes = Vec::new();
    if app.standing().against_passes().is_some() {
        let held = "HOLD: an observation, or the file of the plan, speaks against every pass, these too:";
        changes.push(Line::styled(held, theme.limit()));
    } else if remedies.passing().next().is_some() {
        let [up, down, key] = [Action::Up, Action::Down, Action::Open].map(|action| app.keymap.hint(action));
        let head = match selected {
            Some(_) => {
                format!(" these make it pass or THIN, firmest first; {key} makes the selected change:")
            }
            None => format!(" these make it pass or THIN, firmest first; {up} {down} select one:"),
        };
        changes.push(Line::styled(head, theme.title()));
    }
    let selected_line = changes.len() + selected.unwrap_or(0);
    changes.extend(remedies.passing().enumerate().map(|(n, passing)| {
        let (mark, style) =
            if Some(n) == selected { (" > ", theme.selected()) } else { (" · ", theme.base()) };
        let (change, thinly) = (words(case, &passing.change), thinly(passing));
        let short = change.split(" (").next().unwrap_or_default();
        let mark = format!("{mark}{} ", theme::mark(word_as_planned(passing)));
        let counted = |change: &str| {
            Some(format!("{change}: {}{thinly}", at_most_fail(passing.judgement.sampled.known()?)))
        };
        let texts = [
            Some(sentence(case, passing)),
            counted(&change),
            counted(short),
            Some(short.to_owned() + thinly),
        ];
        let mut texts = texts.into_iter().flatten();
        let last = texts.next_back().unwrap_or_default();
        let text = texts.find(|text| mark.width() + text.width() <= width.into()).unwrap_or(last);
        Line::styled(format!("{mark}{text}"), style)
    }));
    let refused =
        without_pass(case, remedies).into_iter().map(|line| Line::styled(format!(" {line}"), theme.muted()));
    RemedyLines { changes, refused: refused.collect(), selected: selected_line }
}
