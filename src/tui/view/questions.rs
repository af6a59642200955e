//! All questions that a study answers, a line each: the question, its name, what it costs, and what is known.
//!
//! ```text
//! ▸Which interval?       Sweep    20-80 s ✓ 53 ms; 30 to 80 ms worth a check
//!    the safest interval, and which are worth a check
//!  Safest schedule?      Search    8-30 s ⠙ step 2 of 3 █████░░░ up to 10 s left · trying 42 ms
//!  How likely to fail?   Risk    10-40 s ○ Enter starts it
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;
use unicode_width::UnicodeWidthStr;

use crate::jobs::StudyAt;
use crate::report::words::no_result;
use crate::report::words::progress_words::at_most;
use crate::study::question::StudyKind;
use crate::study::study_trait::Listed;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::tui::view::compare::{cut, turning};
use crate::tui::view::widgets::bar;
use crate::units::rough_range;
use crate::verdict::Verdict;

/// Widths of the columns: question, name, cost.
const QUESTION: usize = 21;
const NAME: usize = 8;
const COST: [usize; 2] = [8, 13];
/// Least width of a screen that has names.
const WITH_NAMES: u16 = 76;
/// Least lines of a question that says what is asked, and leaves a line free below it.
const WITH_ABOUT: u16 = 4;
/// Cells of a progress bar.
const BAR: usize = 7;

/// Draws the questions, so many lines each, an area to click: what the answer tells, and where there is room what is asked.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, lines: u16, areas: &mut Areas) {
    for (n, kind) in StudyKind::tabs().into_iter().enumerate() {
        let row = Rect { y: area.y + lines * n as u16, height: lines, ..area }.intersection(area);
        let below = |text: &str| Line::styled(format!("   {text}"), app.theme.muted());
        let [about, tells] = kind.listed().map_or(["", ""], |listed| [listed.about, listed.tells]).map(below);
        let about = Some(about).filter(|about| lines >= WITH_ABOUT && about.width() <= area.width.into());
        let text = [line(app, kind, area.width)].into_iter().chain(about).chain([tells]);
        frame.render_widget(Paragraph::new(text.collect::<Vec<_>>()), row);
        areas.push((row, ClickTarget::Study(kind)));
    }
}

fn line(app: &App, kind: StudyKind, width: u16) -> Line<'static> {
    let is_selected = kind == app.studies.shown;
    let mark = if is_selected { "▸" } else { " " };
    let mut head = mark.to_owned();
    if let Some(Listed { name, question, .. }) = kind.listed() {
        head += &format!("{question:QUESTION$}");
        if width >= WITH_NAMES {
            head += &format!("{name:NAME$}");
        }
    }
    // While it computes, its state tells the time that is left.
    let is_running = matches!(app.studies.state(kind), StudyState::Running(_));
    let expected = app.expected_time(kind).filter(|_| !is_running);
    let expected = expected.map(|time| rough_range(time.as_secs_f64().max(1.0)));
    let (cost, cells) = match expected {
        Some([range, _]) if width >= WITH_NAMES => (format!("~{range}"), COST[1]),
        // Where the whole range has no room: its upper end.
        Some([_, most]) => (format!("~{most}"), COST[0]),
        None => (String::new(), COST[usize::from(width >= WITH_NAMES)]),
    };
    let cost = format!("{cost:>0$} ", cells - 1);
    let room = usize::from(width).saturating_sub(head.width() + cost.width());
    let (state, style) = state(app, kind, is_selected, room);
    let head_style = if is_selected { app.theme.selected() } else { app.theme.base() };
    Line::from(vec![
        Span::styled(head, head_style),
        Span::styled(cost, app.theme.muted()),
        Span::styled(state, style),
    ])
}

/// What is known of a study, at most `room` wide.
fn state(app: &App, kind: StudyKind, is_selected: bool, room: usize) -> (String, Style) {
    let open = app.keymap.hint(Action::Open);
    match app.studies.state(kind) {
        StudyState::Running(at) => (fitting(&running(at, app.beat), room), app.theme.curve()),
        StudyState::Failed(failed) => {
            (fitting(&[format!("! {}", no_result::message(failed))], room), app.theme.limit())
        }
        StudyState::Done(finished)
            if finished.answer.verdict == Some(Verdict::Pass)
                && app.standing().against_passes().is_some() =>
        {
            ("! HOLD".to_owned(), app.theme.limit())
        }
        StudyState::Done(finished) => {
            let answer = &finished.answer;
            let style = answer.verdict.map_or(app.theme.base(), |verdict| app.theme.verdict(verdict));
            (fitting(&answer.texts, room), style)
        }
        StudyState::Idle if app.studies.of_plan_before(kind).is_some() => (
            fitting(&["! of the plan before the change".to_owned(), "! plan changed".to_owned()], room),
            app.theme.limit(),
        ),
        StudyState::Idle if is_selected => {
            let what = if kind == StudyKind::Fit { "gives it observations" } else { "starts it" };
            (fitting(&[format!("○ {open} {what}"), format!("○ {open}")], room), app.theme.title())
        }
        StudyState::Idle => ("○".to_owned(), app.theme.muted()),
    }
}

/// How far a study is, from the longest wording to the shortest.
fn running(at: &StudyAt, beat: usize) -> Vec<String> {
    let (progress, mark) = (&at.progress, turning(beat));
    let bar = bar(progress.fraction, BAR);
    let [step, short_step] = match (progress.step, progress.steps) {
        (0, _) | (_, ..=1) => [String::new(), String::new()],
        (step, steps) => [format!("step {step} of {steps} "), format!("{step}/{steps} ")],
    };
    let left = at.left.map_or_else(String::new, |left| format!(" up to {} left", at_most(left)));
    let trying = progress.trying.as_ref().map_or_else(String::new, |name| format!(" · trying {name}"));
    vec![
        format!("{mark} {step}{bar}{left}{trying}"),
        format!("{mark} {short_step}{bar}{left}{trying}"),
        format!("{mark} {bar}{left}{trying}"),
        format!("{mark} {step}{bar}{left}"),
        format!("{mark} {bar}{left}"),
        format!("{mark} {bar}"),
    ]
}

/// The first of the texts that fits; the last is cut where none does.
fn fitting(texts: &[String], room: usize) -> String {
    let fits = texts.iter().find(|text| text.width() <= room);
    fits.cloned().unwrap_or_else(|| texts.last().map_or_else(String::new, |text| cut(text, room)))
}
