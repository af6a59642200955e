//! The cost of accuracy on this plan and this machine: the accuracy levels, and both methods from coarse to fine steps.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Margin, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::chart;
use super::compare::cut;
use super::gauges;
use super::widgets::{draw_message, draw_progress, wrapped};
use crate::choice::Method;
use crate::outcome::EndReason;
use crate::report::accuracy::enough;
use crate::report::charts::work_and_error;
use crate::report::effects;
use crate::report::words::no_result;
use crate::report::words::option_sentences::{compute_label, peaks};
use crate::study::accuracy::{AccuracyTable, LevelStep, Measured};
use crate::study::as_planned::check::CheckedShot;
use crate::study::judge::Judgement;
use crate::study::question::{Found, StudyKind};
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::SampledShot;
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict};

/// Lines of a question and of how to ask it.
const MESSAGE: u16 = 4;
const QUESTION: &str = "What does accuracy cost here? Both methods, coarse to fine, against a far finer run.";

/// Draws the screen.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let name = app.case.plan.delays.get(app.selected).map_or("", |delay| &delay.name);
    let rule = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.muted())
        .title(Line::styled(format!(" {name} "), app.theme.title()));
    let inside = rule.inner(area).inner(Margin::new(1, 0));
    frame.render_widget(rule, area);
    let lines = computed(app, inside.width);
    let height = wrapped(&lines, inside.width).min(inside.height * 2 / 3);
    let [how, inside] = Layout::vertical([Constraint::Length(height), Constraint::Min(0)]).areas(inside);
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), how);
    let question = Line::styled(QUESTION, app.theme.title());
    let start = app.keymap.hint(Action::Open);
    match app.studies.state(StudyKind::Accuracy) {
        StudyState::Idle => {
            let hint = format!("{start} measures the selected option; it takes seconds.");
            let [options, ask] =
                Layout::vertical([Constraint::Min(0), Constraint::Length(MESSAGE)]).areas(inside);
            draw_errors(app, frame, options);
            draw_message(app, frame, ask, question, &hint);
        }
        StudyState::Failed(failed) => {
            draw_message(app, frame, inside, question, &no_result::message(failed));
        }
        StudyState::Running(at) => draw_progress(app, frame, inside, question, at),
        StudyState::Done(finished) => {
            let Found::Accuracy(study) = &finished.found else { return };
            let study = &study.value;
            if study.option != app.selected {
                let other = app.case.plan.delays.get(study.option).map_or("", |delay| &delay.name);
                let message = format!("Measured for {other}. {start} measures this option instead.");
                draw_message(app, frame, inside, question, &message);
            } else {
                let lines = levels(app, study);
                let [table, plot] =
                    Layout::vertical([Constraint::Length(lines.len() as u16 + 1), Constraint::Min(0)])
                        .areas(inside);
                frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: false }), table);
                let start = study.levels.iter().find(|start| start.level == app.compute.accuracy);
                let chosen = start.and_then(|start| work_and_error(&measured(study, start.step)?));
                for chart in app.report_of(finished).charts() {
                    chart::draw(app, chart, chosen, frame, plot);
                }
            }
        }
    }
}

/// Whether computing is exact enough, the values of the selected option with their errors, and how they were computed; nothing as long as
/// it has none.
fn computed<'l>(app: &App, width: u16) -> Vec<Line<'l>> {
    let Some(Judgement { checked, sampled, .. }) = app.judgement(app.selected) else { return Vec::new() };
    let end = match checked.end.reason {
        EndReason::AtRest => "at rest after",
        EndReason::TimeLimit => "followed for",
    };
    let drawn = sampled.known().map_or_else(String::new, |sampled| {
        format!(" · {} shots drawn by seed {}", sampled.samples.len(), Sampling::OF_VERDICT.seed)
    });
    let how = format!(
        "{} · step {} · {} runs in {} · energy residual {} · {end} {}{drawn}",
        compute_label(&checked.compute),
        units::milliseconds(checked.step),
        checked.runs,
        units::milliseconds(checked.total_wall.as_secs_f64()),
        units::residual(checked.energy_residual),
        units::seconds(checked.end.time),
    );
    let values = format!("planned: {}", peaks(app.case.scene(), checked));
    let mut lines: Vec<Line<'_>> =
        sampled.known().and_then(|sampled| answer(app, checked, sampled, width)).into_iter().collect();
    lines.extend([Line::styled(values, app.theme.base()), Line::styled(how, app.theme.muted())]);
    lines
}

/// Draws how far off the numbers of each option may be: what computing leaves open, and what the inputs do.
fn draw_errors(app: &App, frame: &mut Frame, area: Rect) {
    let names = app.case.plan.delays.iter().map(|delay| delay.name.as_str());
    let name = names.clone().map(UnicodeWidthStr::width).max().unwrap_or(0).min(usize::from(area.width) / 4);
    let width = usize::from(area.width).saturating_sub(name + NUMBERS).min(WIDEST_SCALE);
    let muted = app.theme.muted();
    let [computing, inputs] = gauges::ERRORS;
    let legend = format!("how far off numbers may be: {computing} computing, {inputs} your inputs");
    let scale = format!("{:name$}  {}", "", gauges::error_scale(width));
    let mut lines = vec![Line::default(), Line::styled(legend, muted), Line::styled(scale, muted)];
    for (option, label) in names.enumerate() {
        let judged = app.judgement(option);
        let found = judged.and_then(|judged| errors(&judged.checked, judged.sampled.known()?));
        let style = if option == app.selected { app.theme.title() } else { app.theme.base() };
        let mut line = Line::styled(format!("{:name$}  ", cut(label, name)), style);
        if let Some(found) = found {
            let [computing, inputs] = found.map(|share| units::significant(share, Unit::Percent, 1));
            line.spans.extend(gauges::errors(found, width, [style, muted]));
            line.push_span(Span::styled(format!("  {computing} %, ±{inputs} %"), muted));
        }
        lines.push(line);
    }
    frame.render_widget(Paragraph::new(lines), area);
}

/// Cells beside the scale of errors: blanks and numbers.
const NUMBERS: usize = 22;
/// Most cells of the scale of errors.
const WIDEST_SCALE: usize = 80;

/// Share of the spread of the samples up to which the error of computing changes nothing.
const SMALL_ERROR: f64 = 0.1;

/// Spread of the samples to each side, as a share of the middle one, from which it is the inputs that are to be known better.
const WIDE_INPUTS: f64 = 0.5;

/// Whether a finer computation would tell more: the error of computing beside what the inputs leave open. In fewer words where the
/// screen is narrow; nothing as long as few shots were tried.
fn answer<'l>(app: &App, checked: &CheckedShot, sampled: &SampledShot, width: u16) -> Option<Line<'l>> {
    let [computing, inputs] = errors(checked, sampled)?;
    let [error, open] = [computing, inputs].map(|share| units::significant(share, Unit::Percent, 1));
    let finer = app.keymap.hint(Action::Finer);
    let (mark, todo, style) = match computing <= SMALL_ERROR * inputs {
        true if inputs > WIDE_INPUTS => ("!", "measure these first".to_owned(), app.theme.limit()),
        true => ("✓", "finer tells no more".to_owned(), app.theme.verdict(Verdict::Pass)),
        false => ("!", format!("{finer} computes finer"), app.theme.limit()),
    };
    let long = format!("{mark} Computing is exact to {error} %, your inputs to ±{open} %: {todo}.");
    let short = format!("{mark} Exact to {error} %, inputs to ±{open} %: {todo}.");
    let fits = Span::raw(&long).width() <= usize::from(width);
    Some(Line::styled(if fits { long } else { short }, style))
}

/// The greatest relative error of computing height and force, and how far the inputs spread them to each side; `None` for too few shots.
fn errors(checked: &CheckedShot, sampled: &SampledShot) -> Option<[f64; 2]> {
    let quantities = [Quantity::Height, Quantity::Force];
    let computing =
        quantities.into_iter().map(|quantity| checked.get(quantity)).filter(|peak| peak.value > 0.0);
    let computing = computing.map(|peak| peak.error / peak.value).fold(0.0, f64::max);
    let spread = |quantity| {
        let [low, middle, high, _] = sampled.band(quantity)?;
        Some(0.5 * (high - low) / middle)
    };
    let inputs =
        quantities.into_iter().filter_map(spread).filter(|share| share.is_finite()).reduce(f64::max)?;
    Some([computing, inputs])
}

/// A line per level: first step, errors of that step before refinement, time of a run. A mark shows the chosen level.
fn levels<'l>(app: &App, study: &AccuracyTable) -> Vec<Line<'l>> {
    let [finer, coarser] = [Action::Finer, Action::Coarser].map(|action| app.keymap.hint(action));
    let head = format!(
        "  {:9} {:>9} {:>10} {:>10} {:>10} {:>8} {finer} and {coarser} choose",
        "level", "1st step", "height err", "force err", "slide err", "one run"
    );
    let mut lines = vec![Line::styled(head, app.theme.muted())];
    let base = measured(study, study.levels[0].step);
    for LevelStep { level, step } in study.levels {
        let chosen = level == app.compute.accuracy && app.compute.step.is_none();
        let start = format!(
            "{} {:9} {:>9} ",
            if chosen { ">" } else { " " },
            level.name(),
            units::milliseconds(step)
        );
        let cost = measured(study, step).map_or_else(|| "not stable".to_owned(), |m| costs(m, base));
        let style = if chosen { app.theme.selected() } else { app.theme.base() };
        lines.push(Line::from(Span::styled(start + &cost, style)));
    }
    lines.push(Line::styled(enough(&app.case, study), app.theme.title()));
    lines.push(Line::styled(required(app), app.theme.base()));
    lines
}

/// What the scene requires of the model, as the study of effects found it.
fn required(app: &App) -> String {
    match app.studies.finished(StudyKind::Effects).map(|finished| &finished.found) {
        Some(Found::Effects(found)) => format!("effects: {}", effects::requirement(&found.value)),
        _ => "effects: which ones this scene requires, Studies → Effects computes".to_owned(),
    }
}

/// The run at a step [s].
fn measured(study: &AccuracyTable, step: f64) -> Option<Measured> {
    let mut rows = study.rows.iter().filter(|row| row.method == Method::Verlet && row.step == step);
    rows.find_map(|row| row.result)
}

fn costs(m: Measured, base: Option<Measured>) -> String {
    let percent = |error: f64| {
        if error > 0.0 && error < 5e-7 { "<0.0001 %".to_owned() } else { format!("{:.4} %", error * 100.0) }
    };
    let wall = m.wall.as_secs_f64();
    let times = base.map_or_else(String::new, |base| {
        format!(" {:.1} times draft", wall / base.wall.as_secs_f64().max(f64::MIN_POSITIVE))
    });
    format!(
        "{:>10} {:>10} {:>10} {:>8}{times}",
        percent(m.height_error),
        percent(m.force_error),
        percent(m.drift_error),
        units::milliseconds(wall)
    )
}
