//! The list of all questions that studies answer. Each line: the question, the study, its graphic, and the answer. The graphic is the cost
//! before the study, the progress during it, and a sparkline of the result after it.
//!
//! ```text
//!  question           study         takes answer
//! ▸Which interval?    Sweep  ▂▅✗✗▅▂▁▁▂▅✗✗ ✓ 53 ms; others of 30 to 80 ms not proven
//!  Safest schedule?   Search ━━━━━━━━━─── ⠙ step 2 of 3 · up to 10 s left · trying 42 ms
//!  How likely?        Risk       ~10-40 s ○ how many shots fail, and which input decides it
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use crate::jobs::StudyAt;
use crate::report::words::no_result;
use crate::report::words::progress_words::at_most;
use crate::study::question::StudyKind;
use crate::study::study_trait::Listed;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::tui::theme::mark;
use crate::tui::view::compare::turning;
use crate::tui::view::fitting::cut_at_word;
use crate::tui::view::gauges;
use crate::tui::view::six_lines::holds;
use crate::tui::view::widgets::highlight;
use crate::units::rough_range;
use crate::verdict::Verdict;

/// Width of the question. `NAME`: of the name. `GRAPHIC`: of the graphic on a narrow, a usual and a wide screen.
const QUESTION: usize = 19;
const NAME: usize = 8;
const GRAPHIC: [usize; 3] = [7, 11, 20];
/// Least width of a screen with names. `WIDE`: least width with the widest graphics.
const WITH_NAMES: u16 = 75;
const WIDE: u16 = 129;
/// Least height of a screen with heads above the columns.
const WITH_HEADS: u16 = 18;

/// Lines of all questions on a screen of the height `screen`, with heads.
pub fn height(screen: u16) -> u16 {
    StudyKind::tabs().len() as u16 + heads(screen)
}

/// Lines of heads above the questions.
fn heads(screen: u16) -> u16 {
    u16::from(screen >= WITH_HEADS)
}

/// Draws the questions on a screen of the height `screen`. Each question takes clicks.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, screen: u16, areas: &mut Areas) {
    let heads = heads(screen);
    if heads > 0 {
        let graphic = graphic_width(area.width);
        let name = if area.width >= WITH_NAMES { format!("{:NAME$}", "study") } else { String::new() };
        let is_idle = |kind: &StudyKind| matches!(app.studies.state(*kind), StudyState::Idle);
        let idle = if StudyKind::tabs().iter().any(is_idle) { " (○ not asked yet)" } else { "" };
        let head = format!(" {:QUESTION$}{name}{:>graphic$} answer{idle}", "question", "takes");
        frame.render_widget(Line::styled(head, app.theme.muted()), area);
    }
    for (y, kind) in (area.y + heads..area.bottom()).zip(StudyKind::tabs()) {
        let row = Rect { y, height: 1, ..area };
        frame.render_widget(line(app, kind, area.width), row);
        if kind == app.studies.shown {
            highlight(app, row, frame);
        }
        areas.push((row, ClickTarget::Study(kind)));
    }
}

fn graphic_width(width: u16) -> usize {
    GRAPHIC[usize::from(width >= WITH_NAMES) + usize::from(width >= WIDE)]
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
    let graphic = graphic(app, kind, graphic_width(width), width >= WITH_NAMES);
    let room = usize::from(width).saturating_sub(head.width() + graphic.width() + 1);
    let (state, style) = state(app, kind, is_selected, room);
    let head_style = if is_selected { app.theme.selected() } else { app.theme.base() };
    let mut line = Line::from(Span::styled(head, head_style));
    line.extend(graphic);
    line.extend([Span::raw(" "), Span::styled(state, style)]);
    line
}

/// The cost of a study, its progress, or its result as a sparkline.
fn graphic(app: &App, kind: StudyKind, width: usize, has_range: bool) -> Line<'static> {
    let theme = app.theme;
    match app.studies.state(kind) {
        StudyState::Running(at) => {
            let done = ((at.progress.fraction * width as f64) as usize).min(width);
            let [done, left] = [("━", done), ("─", width - done)].map(|(sign, cells)| sign.repeat(cells));
            Line::from(vec![Span::styled(done, theme.curve()), Span::styled(left, theme.faint())])
        }
        StudyState::Done(finished) if !finished.answer.shares.is_empty() => {
            let calm = if app.is_held() { theme.muted() } else { theme.curve() };
            gauges::over_time(theme, &finished.answer.shares, 1.0, width, calm, false)
        }
        StudyState::Idle => {
            let cost = match app.expected_time(kind).map(|time| rough_range(time.as_secs_f64().max(1.0))) {
                Some([range, _]) if has_range => format!("~{range}"),
                // If the whole range does not fit, show its upper end.
                Some([_, most]) => format!("~{most}"),
                None => String::new(),
            };
            Line::styled(format!("{cost:>width$}"), theme.muted())
        }
        StudyState::Done(_) | StudyState::Failed(_) => Line::raw(" ".repeat(width)),
    }
}

/// The state or the answer of a study, at most `room` wide.
fn state(app: &App, kind: StudyKind, is_selected: bool, room: usize) -> (String, Style) {
    match app.studies.state(kind) {
        StudyState::Running(at) => (fitting(&running(at, app.beat), room), app.theme.curve()),
        StudyState::Failed(failed) => {
            (fitting(&[format!("! {}", no_result::message(failed))], room), app.theme.limit())
        }
        StudyState::Done(finished)
            if finished.answer.verdict.is_some_and(|word| word.verdict() == Verdict::Pass)
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
        StudyState::Idle if kind == StudyKind::Assumptions && is_known(app) => {
            // The verdicts have already found this for the selected option.
            let (word, name) = (app.word(app.selected), &app.case.plan.delays[app.selected].name);
            let known = holds(app).into_iter().next().unwrap_or_default();
            let brief = known.split(" (").next().unwrap_or_default();
            // A sentence that is cut off says something else.
            let unsaid = format!("{} tells until when", app.keymap.hint(Action::Open));
            let texts = [format!("{name} {known}"), format!("{name} {brief}"), brief.to_owned(), unsaid];
            let texts = texts.map(|text| format!("{} {text}", mark(word)));
            (fitting(&texts, room), app.theme.verdict(word))
        }
        StudyState::Idle => {
            let tells = kind.listed().map_or("", |listed| listed.tells);
            let open = app.keymap.hint(Action::Open);
            let asked = if is_selected { format!("○ {open}: ") } else { "○ ".to_owned() };
            let (first, _) = tells.split_once(", ").unwrap_or((tells, ""));
            (
                fitting(&[format!("{asked}{tells}"), format!("{asked}{first}"), format!("○ {first}")], room),
                if is_selected { app.theme.title() } else { app.theme.muted() },
            )
        }
    }
}

/// Whether it is known how far the pass of the selected option holds.
fn is_known(app: &App) -> bool {
    app.is_pass_of_plan(app.selected) && app.stands_on(app.selected).is_some()
}

/// Progress of a study in words, from the longest wording to the shortest. Its bar stands beside.
fn running(at: &StudyAt, beat: usize) -> Vec<String> {
    let (progress, mark) = (&at.progress, turning(beat));
    let [step, short_step] = match (progress.step, progress.steps) {
        (0, _) | (_, ..=1) => [String::new(), String::new()],
        (step, steps) => [format!("step {step} of {steps}"), format!("{step}/{steps}")],
    };
    let left = at.left.map(at_most);
    let long_left = left.as_ref().map_or_else(String::new, |left| format!("up to {left} left"));
    let short_left = left.map_or_else(String::new, |left| format!("~{left}"));
    let trying = progress.trying.as_ref().map_or_else(String::new, |name| format!("trying {name}"));
    // The option ahead need not become the answer.
    let ahead = progress.best.as_ref().map_or_else(String::new, |name| format!("ahead so far {name}"));
    let joined = |parts: &[&String]| {
        let parts: Vec<&str> =
            parts.iter().map(|part| part.as_str()).filter(|part| !part.is_empty()).collect();
        format!("{mark} {}", if parts.is_empty() { "computing".to_owned() } else { parts.join(" · ") })
    };
    vec![
        joined(&[&step, &long_left, &ahead, &trying]),
        joined(&[&step, &long_left, &trying]),
        joined(&[&short_step, &long_left, &trying]),
        joined(&[&short_step, &short_left, &trying]),
        joined(&[&short_step, &short_left, &ahead]),
        joined(&[&short_step, &short_left]),
        joined(&[&short_left]),
    ]
}

/// The first text that fits. If none fits, the whole words of the last text that fit: a sentence without its middle says something else.
fn fitting(texts: &[String], room: usize) -> String {
    let fits = texts.iter().find(|text| text.width() <= room);
    fits.cloned().unwrap_or_else(|| texts.last().map_or_else(String::new, |text| cut_at_word(text, room)))
}
