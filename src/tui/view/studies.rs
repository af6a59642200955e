//! The Studies screen: all questions ([`questions`]) with the selected study below, or the study on the full screen.
//!
//! ```text
//!  Sweep   Orders   Risk   Search   Size   Effects   Fit   Holds
//! ─ settings ─────────────────────────────────┬──────────────────────
//! conclusion, warnings, tables                │ charts; what was tried so far while it computes, and before what the options tell
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{self, Borders, Clear, Paragraph, Wrap};

use super::report::{ReportLines, lines};
use super::widgets::{after_margin, draw_divider, draw_message, draw_progress, draw_row};
use super::{chart, holds_chart, questions, so_far, tried_chart};
use crate::report::parts::{Block, Cell, Report};
use crate::report::words::no_result;
use crate::report::words::option_sentences::compute_label;
use crate::sorting::sort_by_key;
use crate::study::question::{Found, StudyKind};
use crate::study::work::progress::Progress;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;
use crate::tui::studies::{ShownStudy, StudyState};
use crate::verdict::{Verdict, VerdictWord};

/// Least heights of a body that keeps a chart below its text, whatever the length of the text: one chart below the questions; a third of
/// the height for charts.
const ROOM_FOR_CHARTS: [u16; 2] = [10, 15];
/// Rows of a chart below the text, below the questions.
const CHART: u16 = 7;
/// Least height of a text below the questions that keeps its blank lines.
const ROOM_FOR_BLANKS: u16 = 15;

/// Draws the screen.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    if !app.studies.open {
        let [list, rest] =
            Layout::vertical([Constraint::Length(questions::height(area.height)), Constraint::Min(0)])
                .areas(area);
        questions::draw(app, frame, list, area.height, areas);
        return draw_shown(app, frame, rest, areas);
    }
    let [tabs, body] = Layout::vertical([Constraint::Length(1), Constraint::Min(0)]).areas(area);
    let tab = |kind: StudyKind| {
        let style = if kind == app.studies.shown { app.theme.selected() } else { app.theme.base() };
        let name = Span::styled(format!(" {} ", kind.listed().map_or("", |listed| listed.name)), style);
        let state = match app.studies.of_plan_before(kind) {
            Some(_) => "before ".to_owned(),
            None => Some(app.studies.state(kind).to_string())
                .filter(|state| !state.is_empty())
                .map_or_else(String::new, |state| format!("{state} ")),
        };
        Line::from(vec![name, Span::styled(state, app.theme.muted())])
    };
    let kinds = StudyKind::tabs();
    let drawn: Vec<_> = kinds.iter().map(|&kind| (tab(kind), ClickTarget::Study(kind))).collect();
    // If not all tabs fit, leave out the first ones until the shown tab fits.
    let shown = kinds.iter().position(|kind| *kind == app.studies.shown).unwrap_or(0);
    let width = |from: usize| drawn[from..=shown].iter().map(|(tab, _)| tab.width()).sum::<usize>();
    let first = (0..=shown).find(|&from| width(from) <= usize::from(tabs.width)).unwrap_or(shown);
    draw_row(drawn.iter().skip(first).cloned(), frame, tabs, areas);
    draw_shown(app, frame, body, areas);
}

/// Draws the shown study below a rule. The rule states the settings of the result, or the question.
fn draw_shown(app: &App, frame: &mut Frame, body: Rect, areas: &mut Areas) {
    let kind = app.studies.shown;
    let before = app.studies.of_plan_before(kind);
    let question = kind.listed().map_or("", |listed| listed.about);
    let title = match (before, app.studies.finished(kind)) {
        (Some(_), _) => of_plan_before(app),
        (None, Some(finished)) => settings(app, finished),
        (None, None) => {
            // The bars below do not answer the question.
            let is_idle = matches!(app.studies.state(kind), StudyState::Idle) && kind != StudyKind::Fit;
            let below = if is_idle { NOT_ASKED } else { "" };
            let room = body.width.saturating_sub(Line::raw(below).width() as u16);
            Line::styled(asked(kind, room) + below, app.theme.title())
        }
    };
    let rule = widgets::Block::new().borders(Borders::TOP).border_style(app.theme.muted()).title(title);
    let inside = rule.inner(body);
    frame.render_widget(rule, body);
    match (app.studies.state(kind), before) {
        (StudyState::Idle, Some(before)) => draw_finished(app, before, frame, inside, areas),
        (StudyState::Idle, None) if kind == StudyKind::Fit => {
            let told = Paragraph::new(how_to_observe(app)).style(app.theme.base());
            frame.render_widget(told.wrap(Wrap { trim: true }), after_margin(inside));
        }
        (StudyState::Idle, None) => so_far::draw(app, &Progress::default(), frame, inside, areas),
        (StudyState::Failed(failed), _) => {
            let question = Line::styled(question, app.theme.title());
            draw_message(app, frame, inside, question, &no_result::message(failed));
        }
        (StudyState::Running(at), _) if app.studies.open => {
            let told = Rect { height: PROGRESS.min(inside.height), ..inside };
            draw_progress(app, frame, told, Line::styled(question, app.theme.title()), at);
            let rest = Rect { y: told.bottom(), height: inside.height - told.height, ..inside };
            so_far::draw(app, &at.progress, frame, rest, areas);
        }
        (StudyState::Running(at), _) => so_far::draw(app, &at.progress, frame, inside, areas),
        (StudyState::Done(finished), _) => draw_finished(app, finished, frame, inside, areas),
    }
}

/// Text behind a question that was not asked, above the bars of the options.
const NOT_ASKED: &str = "· not asked, your options now ";

/// Lines of a question with its progress.
const PROGRESS: u16 = 4;

/// The question of a study. The longest wording that fits.
fn asked(kind: StudyKind, width: u16) -> String {
    let Some(listed) = kind.listed() else { return String::new() };
    let first = listed.about.find("? ").map_or(listed.about, |end| &listed.about[..=end]);
    let texts = [listed.about, first, listed.question].map(|text| format!(" {text} "));
    texts.into_iter().find(|text| Line::raw(text).width() <= width.into()).unwrap_or_default()
}

/// How to type observations, and the observations typed so far.
fn how_to_observe(app: &App) -> String {
    let [open, rerun, cancel] =
        [Action::Open, Action::Rerun, Action::Cancel].map(|action| app.keymap.hint(action));
    let typed = app.record.lines(&app.case.plan).join("\n");
    format!(
        "{open} asks which delay was fired, and takes an observation:\n\
         2:4 1.95 0.05           how high a tire rose: m, give or take\n\
         3:1-4:1 52kN 2kN        how hard a cable pulled, give or take\n\
         3:1 landing_s 1.12 0.02 or lift_s, drift_m; firing_s 0.042\n\
         seen.csv                a file as of `shelter fit`\n\
         {rerun} fits again, {cancel} takes back the last\n\n{typed}"
    )
}

/// The settings of a result; a warning if the current settings differ.
fn settings(app: &App, finished: &ShownStudy) -> Line<'static> {
    let label = compute_label(&finished.compute);
    if finished.compute != app.compute {
        let again = app.keymap.hint(Action::Rerun);
        return Line::styled(format!(" computed with {label}; {again} computes again "), app.theme.limit());
    }
    let [open, cancel] = [Action::Open, Action::Cancel].map(|action| app.keymap.hint(action));
    if app.studies.shown == StudyKind::Fit && app.has_estimates() {
        let use_ = app.keymap.hint(Action::UseEstimates);
        let text = format!(" Compare judges the plan as it is: {use_} puts the estimates into it ");
        return Line::styled(text, app.theme.limit());
    }
    if app.studies.shown == StudyKind::Fit && app.standing().against_passes().is_some() {
        let text =
            format!(" HOLD, and no estimate: {open} tells more of the shot, {cancel} takes a slip back ");
        return Line::styled(text, app.theme.limit());
    }
    let name = app.studies.shown.listed().map_or("", |listed| listed.name);
    let title = match app.studies.open {
        true => format!(" {label} "),
        false => format!(" {name} · {label} · {open} shows all "),
    };
    Line::styled(title, app.theme.title())
}

/// Says that a result belongs to the plan before the change.
fn of_plan_before(app: &App) -> Line<'static> {
    let [again, undo] = [Action::Rerun, Action::Undo].map(|action| app.keymap.hint(action));
    Line::styled(format!(" OF THE PLAN BEFORE; {again} computes again, {undo} undoes "), app.theme.limit())
}

/// Least width of a report with charts beside it. `TEXT`: share of the width for its text [%].
const WITH_CHARTS_BESIDE: u16 = 99;
const TEXT: u16 = 46;

/// The short form of a report below the questions: tables before sentences, no details below rows. The full screen shows the warnings.
fn in_short(app: &App, mut report: Report) -> Report {
    let open = app.keymap.hint(Action::Open);
    sort_by_key(&mut report.blocks, |block| matches!(block, Block::Text(_)));
    for block in &mut report.blocks {
        if let Block::Table(table) = block {
            table.rows.iter_mut().for_each(|row| row.details.clear());
        }
    }
    report.warnings = match report.warnings.len() {
        0 => Vec::new(),
        1 => vec![format!("1 warning: {open} shows it")],
        count => vec![format!("{count} warnings: {open} shows them")],
    };
    report
}

/// Replaces each pass of a study of risks by the word of Compare. The study computes no margin and no fresh draws, so its pass may be thin
/// or open on Compare.
fn word_passes_as_compare_does(app: &App, report: &mut Report) {
    for block in &mut report.blocks {
        let Block::Table(table) = block else { continue };
        // Only a table with a row for each option.
        if table.rows.len() != app.options.len() {
            continue;
        }
        for (option, row) in table.rows.iter_mut().enumerate() {
            for cell in &mut row.cells {
                if let Cell::Verdict(word) = cell
                    && word.verdict() == Verdict::Pass
                {
                    *word = app.word(option);
                }
            }
        }
    }
}

/// Draws the report of a study. The text can be scrolled. The charts take the rest of the area.
fn draw_finished(app: &App, finished: &ShownStudy, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let mut report = app.report_of(finished).into_owned();
    // Parts drawn from the plan on the screen would mix both plans.
    let is_of_plan = app.studies.finished(app.studies.shown).is_some();
    if matches!(finished.found, Found::Risk(_)) && is_of_plan {
        word_passes_as_compare_does(app, &mut report);
    }
    if matches!(finished.found, Found::Risk(_) | Found::Orders(_))
        && let Some(conclusion) = report.conclusion.as_mut().filter(|it| it.word == VerdictWord::Fail)
    {
        // Below a headline that recommends an option, a FAIL of all options together would be misread.
        conclusion.label = Some("NOT ALL PASS");
    }
    let report = if app.studies.open { report } else { in_short(app, report) };
    let charts = report.charts();
    let charts: Vec<_> = match app.studies.shown {
        // One chart per option: the chart of the selected option.
        StudyKind::Risk => charts.skip(app.selected).take(1).collect(),
        _ => charts.collect(),
    };
    let is_drawn_here = is_of_plan && !app.studies.open;
    let has_bars = matches!(finished.found, Found::Assumptions(_)) && is_drawn_here;
    let tried = is_drawn_here.then(|| so_far::tried_in_all(app, &finished.found)).flatten();
    let has_charts = has_bars || !charts.is_empty();
    let is_beside = area.width >= WITH_CHARTS_BESIDE && has_charts && !app.studies.open;
    let (area, beside) = if is_beside {
        let columns = Layout::horizontal([Constraint::Percentage(TEXT), Constraint::Min(0)]).spacing(1);
        let [text, beside]: [Rect; 2] = columns.areas(area);
        draw_divider(app, frame, Rect { y: area.y.saturating_sub(1), height: area.height + 1, ..text });
        (text, Some(beside))
    } else {
        (area, None)
    };
    let area = after_margin(area);
    let ReportLines { lines: mut all, offers } = lines(&report, &app.studies.filter, app.theme, area);
    if !app.studies.open && area.height < ROOM_FOR_BLANKS {
        all.retain(|line| line.width() > 0);
    }
    // Only rows of the plan on the screen can be taken.
    let is_to_take = app.studies.open && is_of_plan;
    let offers = if is_to_take { offers } else { Vec::new() };
    let selected = offers.get(app.studies.selected).map(|(line, _)| *line);
    if let Some(line) = selected {
        all[line] = std::mem::take(&mut all[line]).patch_style(app.theme.selected());
    }
    let most = match () {
        () if !has_charts || is_beside || area.height < ROOM_FOR_CHARTS[0] => area.height,
        // Below the questions, a chart shows more than the last lines of text.
        () if !app.studies.open => area.height - CHART,
        () if area.height < ROOM_FOR_CHARTS[1] => area.height,
        () => area.height - area.height / 3,
    };
    let height = (all.len() as u16).min(most);
    let [text, pictures] = Layout::vertical([Constraint::Length(height), Constraint::Min(0)]).areas(area);
    let beyond = (all.len() as u16).saturating_sub(height);
    areas.push((text, ClickTarget::Lines(beyond)));
    // If there are several rows to choose from, the selected row stays in the middle if there is room above it.
    let scrolled = match selected.filter(|_| offers.len() > 1) {
        Some(line) => (line as u16).saturating_sub(height / 2).min(beyond),
        None => app.studies.scroll.min(beyond),
    };
    for (n, (line, _)) in offers.iter().enumerate() {
        let y = (*line as u16).checked_sub(scrolled).filter(|&y| y < height);
        let row = y.map(|y| Rect { y: text.y + y, height: 1, ..text });
        areas.extend(row.map(|row| (row, ClickTarget::Offer(n))));
    }
    frame.render_widget(Paragraph::new(all.split_off(usize::from(scrolled))), text);
    if scrolled < beyond {
        // The mark takes its own line, because half a line of numbers would be misread.
        let hidden = beyond - scrolled + 1;
        let key = if app.studies.open { Action::Down } else { Action::Open };
        let more = format!("{hidden} more lines: {}", app.keymap.hint(key));
        let last = Rect { y: text.bottom().saturating_sub(1), height: 1.min(text.height), ..text };
        frame.render_widget(Clear, last);
        frame.render_widget(
            Paragraph::new(more).style(app.theme.base().patch(app.theme.muted())).right_aligned(),
            last,
        );
    }
    let pictures = beside.unwrap_or(pictures);
    match &finished.found {
        Found::Risk(risks) if is_drawn_here => so_far::draw_risk(app, &risks.value, frame, pictures),
        Found::Assumptions(found) if has_bars => holds_chart::draw(app, &found.value, frame, pictures),
        _ => match tried {
            Some(tried) => tried_chart::draw(app, &tried, frame, pictures),
            None => chart::draw_all(app, &charts, frame, pictures),
        },
    }
}
