//! The errors of the numbers: from computing and from the inputs. Also the cost of finer steps on this plan and this machine.
//!
//! ```text
//! Your inputs decide: height ±23 % in 9 of 10 shots; computing 0.1 %: finer tells no more
//! how far off    0.01 %   0.1 %    1 %      10 %   100 %  ● computing ○ inputs
//! ▸109 ms                   ●────────────────────○                 0.1 %   ±23 %
//! ```

use std::ops::Range;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph};
use unicode_width::UnicodeWidthStr;

use super::columns::name_of;
use super::compare::{curve, turning};
use super::fitting::option_name;
use super::widgets::{after_margin, bar, highlight};
use super::{certainty, chart, gauges, histogram, so_far};
use crate::choice::Method;
use crate::outcome::EndReason;
use crate::report::accuracy::enough;
use crate::report::charts::work_and_error;
use crate::report::effects;
use crate::report::words::no_result;
use crate::report::words::option_sentences::{compute_label, peaks};
use crate::report::words::progress_words::describe;
use crate::study::accuracy::{AccuracyTable, LevelStep, Measured};
use crate::study::as_planned::check::CheckedShot;
use crate::study::judge::Judgement;
use crate::study::question::{Found, StudyKind};
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::SampledShot;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;
use crate::tui::studies::{ShownStudy, StudyState};
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// Least rows of options beside the lines about the selected option.
const LEAST_OPTIONS: usize = 3;

/// Draws the screen: whether the computation is exact enough, the errors of each option, the details of the selected option, and its
/// sampled shots.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let name = app.case.plan.delays.get(app.selected).map_or("", |delay| &delay.name);
    let how = compute_label(&app.compute);
    let fit = app.keymap.first_key(Action::Show(Screen::Studies));
    let titles = [
        format!(" {name} · how far off its numbers are, if the model holds (film: {fit} Fit) · {how} "),
        format!(" {name} · how far off, if the model holds: film ({fit} Fit) · {how} "),
        format!(" {name} · how far off, if the model holds · {how} "),
        format!(" {name} · {how} "),
    ];
    let [.., shortest] = &titles;
    let title = titles.iter().find(|title| title.width() <= area.width.into()).unwrap_or(shortest).clone();
    let rule = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.muted())
        .title(Line::styled(title, app.theme.title()));
    let inside = after_margin(rule.inner(area));
    frame.render_widget(rule, area);
    // The answer, the scale and the least rows of options take the other lines.
    let room = usize::from(inside.height).saturating_sub(2 + LEAST_OPTIONS);
    let mut lines = of_selected(app, inside.width.into());
    lines.truncate(room);
    let (count, told) = (app.listed_options().len(), lines.len() as u16);
    let most = inside.height.saturating_sub(told + 2);
    // With fewer rows the list only counts hidden options, and charts without rows are of little use.
    let beside_charts = most.checked_sub(LEAST_CHARTS).filter(|rows| usize::from(*rows) >= LEAST_OPTIONS);
    let options = (count as u16).min(beside_charts.unwrap_or(most));
    let mut free = inside.height.saturating_sub(told + options + 2);
    let mut how = how_computed(app, inside.width.into());
    how.retain(|_| free > TALL);
    free = free.saturating_sub(how.len() as u16);
    let [head, table, _, text, charts, below] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(options + 1),
        // A blank row between table and text, unless low charts need the row more.
        Constraint::Length(u16::from(free > 0 && !LOW_CHARTS.contains(&free))),
        Constraint::Length(told),
        Constraint::Min(0),
        Constraint::Length(how.len() as u16),
    ])
    .areas(inside);
    if let Some(judged) = app.judgement(app.selected) {
        let answer = answer(app, judged, head.width);
        frame.render_widget(answer.unwrap_or_else(|| still_tried(app, app.selected)), head);
    }
    draw_errors(app, frame, table, areas);
    frame.render_widget(Paragraph::new(lines), text);
    draw_charts(app, frame, charts);
    frame.render_widget(Paragraph::new(how), below);
}

/// Least height of charts.
const LEAST_CHARTS: u16 = histogram::LEAST_SIZE.1;
/// Heights at which one more row makes charts easier to read. `TALL`: least height for the bounds of the risk and for the costs of steps.
const LOW_CHARTS: Range<u16> = LEAST_CHARTS..8;
const TALL: u16 = 6;
/// Least width for all four charts. `COST`: width of the chart of run costs beside the others.
const WITH_ALL: u16 = 113;
const COST: u16 = 36;

/// Draws the sampled shots of the selected option, the bounds of its risk, and the cost of an exact run once it is measured.
fn draw_charts(app: &App, frame: &mut Frame, area: Rect) {
    let judged = app.judgement(app.selected);
    let samples = judged.and_then(|judged| judged.sampled.known()).map_or(&[][..], |known| &known.samples);
    let measured = measured_of_selected(app);
    let report = measured.map(|(finished, _)| app.report_of(finished));
    let chart = report.as_ref().and_then(|report| report.charts().next());
    // If rows are scarce, the shots come first.
    let chart = chart.filter(|_| samples.is_empty() || area.height >= TALL);
    // The shots take two parts: one chart for height, one for force.
    let has_certainty =
        area.height >= TALL && !samples.is_empty() && (chart.is_none() || area.width >= WITH_ALL);
    let parts = [
        (!samples.is_empty(), Constraint::Fill(2)),
        (has_certainty, Constraint::Fill(1)),
        (chart.is_some(), if has_certainty { Constraint::Length(COST) } else { Constraint::Fill(1) }),
    ];
    let parts = parts.into_iter().filter(|(is_drawn, _)| *is_drawn).map(|(_, part)| part);
    let places = Layout::horizontal(parts).spacing(1).split(area);
    let mut places = places.iter().copied();
    if !samples.is_empty() {
        so_far::draw_shots(app, app.selected, samples, frame, places.next().unwrap_or_default());
    }
    if has_certainty {
        certainty::draw(app, app.selected, frame, places.next().unwrap_or_default());
    }
    let cost = places.next().unwrap_or_default();
    if let (Some(chart), Some((_, study))) = (chart, measured) {
        let start = study.levels.iter().find(|start| start.level == app.compute.accuracy);
        let chosen = start.and_then(|start| work_and_error(&measured_at(study, start.step)?));
        chart::draw(app, chart, chosen, frame, cost);
    }
}

/// The finished accuracy study, if it is about the selected option.
fn measured_of_selected(app: &App) -> Option<(&ShownStudy, &AccuracyTable)> {
    let finished = app.studies.finished(StudyKind::Accuracy)?;
    let Found::Accuracy(study) = &finished.found else { return None };
    (study.value.option == app.selected).then_some((finished, &study.value))
}

/// The peaks of the selected option with their errors, and the cost of finer steps; empty if the option has no result.
fn of_selected<'l>(app: &App, width: usize) -> Vec<Line<'l>> {
    let Some(judged) = app.judgement(app.selected) else { return Vec::new() };
    let values = peaks(app.case.scene(), &judged.checked);
    let values = joined(values.split(" · ").map(str::to_owned), width);
    let values = values.into_iter().map(|line| Line::styled(line, app.theme.base()));
    values.chain(cost_of_steps(app, width)).collect()
}

/// Step, number and time of the runs, residual and end of the run of the selected option.
fn how_computed<'l>(app: &App, width: usize) -> Vec<Line<'l>> {
    let Some(Judgement { checked, sampled, .. }) = app.judgement(app.selected) else { return Vec::new() };
    let end = match checked.end.reason {
        EndReason::AtRest => "rest at",
        EndReason::TimeLimit => "followed for",
    };
    let how = [
        format!("step {}", units::milliseconds(checked.step)),
        format!("{} runs in {}", checked.runs, units::milliseconds(checked.total_wall.as_secs_f64())),
        format!("residual {}", units::residual(checked.energy_residual)),
        format!("{end} {}", units::seconds(checked.end.time)),
    ];
    let seed = sampled.known().map(|_| format!("seed {}", Sampling::OF_VERDICT.seed));
    let lines = joined(how.into_iter().chain(seed), width).into_iter();
    lines.map(|line| Line::styled(line, app.theme.muted())).collect()
}

/// The cost of finer steps: the key that measures it, the progress, or the result.
fn cost_of_steps<'l>(app: &App, width: usize) -> Vec<Line<'l>> {
    let theme = app.theme;
    let [start, cancel] = [Action::Open, Action::Cancel].map(|action| app.keymap.hint(action));
    match app.studies.state(StudyKind::Accuracy) {
        StudyState::Running(at) => {
            let told = format!(" {} · {cancel} cancels", describe(&at.progress, at.left));
            let cells = BAR.min(width.saturating_sub(told.width()));
            let bar = Span::styled(bar(at.progress.fraction, cells), theme.curve());
            vec![Line::from(vec![bar, Span::styled(told, theme.base())])]
        }
        StudyState::Failed(failed) => {
            let lines = super::report::wrapped(&format!("! {}", no_result::message(failed)), width);
            lines.into_iter().map(|line| Line::styled(line, theme.limit())).collect()
        }
        StudyState::Idle | StudyState::Done(_) => match measured_of_selected(app) {
            Some((_, study)) => levels(app, study, width),
            None => vec![Line::styled(format!("{start} measures what a finer step costs"), theme.muted())],
        },
    }
}

/// Cells of a progress bar.
const BAR: usize = 24;

/// Joins parts into lines. Each line holds as many parts as fit.
fn joined(parts: impl IntoIterator<Item = String>, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        match lines.last_mut().filter(|line| line.width() + 3 + part.width() <= width) {
            Some(line) => *line += &format!(" · {part}"),
            None => lines.push(part),
        }
    }
    lines
}

/// Draws the errors of each option: from computing and from the inputs. Scrolls so that the selected option is always visible.
fn draw_errors(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let names = || app.case.plan.delays.iter().map(|delay| delay.name.as_str());
    let name = names().map(UnicodeWidthStr::width).max().unwrap_or(0).min(usize::from(area.width) * 2 / 9);
    let name = name.max(NAME);
    let counts = if usize::from(area.width) >= WITH_COUNTS { COUNT } else { 0 };
    let width = usize::from(area.width).saturating_sub(name + NUMBERS + counts);
    let (muted, [computing, inputs]) = (app.theme.muted(), gauges::ERRORS);
    let room = usize::from(area.height.saturating_sub(1));
    let listed = app.listed_options();
    let selected = listed.iter().position(|&at| at == app.selected_option()).unwrap_or(0);
    // A filter may leave no option.
    let first = (selected + 1).saturating_sub(room).min(listed.len());
    let hidden = [first, listed.len().saturating_sub(first + room)];
    let cue = match hidden {
        [0, 0] => "how far off".to_owned(),
        [above, below] => [(above, "↑"), (below, "↓")]
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, sign)| format!("{count} {sign}"))
            .collect::<Vec<_>>()
            .join(" "),
    };
    let shots = if counts > 0 { format!("{:>COUNT$}", "shots") } else { String::new() };
    let head = format!("{computing} computing {inputs} inputs{shots}");
    let scale = format!("{cue:name$}  {:width$} {head}", gauges::error_scale(width.saturating_sub(1)));
    frame.render_widget(Line::styled(scale, muted), area);
    for (y, &at) in (area.y + 1..area.bottom()).zip(listed.iter().skip(first)) {
        let Some(side) = app.of_side(at.side) else { continue };
        let is_selected = at == app.selected_option();
        let mut line = error_line(side, at.option, is_selected, [name, width]);
        let tried = side.judgement(at.option).and_then(|judged| judged.sampled.known());
        if let Some(sampled) = tried.filter(|_| counts > 0) {
            let room = usize::from(area.width).saturating_sub(COUNT + line.width());
            let count = format!("{:room$}{:>COUNT$}", "", sampled.samples.len());
            line.push_span(Span::styled(count, if is_selected { side.theme.title() } else { muted }));
        }
        let row = Rect { y, height: 1, ..area };
        frame.render_widget(line, row);
        if is_selected {
            highlight(app, row, frame);
        }
        areas.push((row, ClickTarget::Option(at)));
    }
}

/// The row with the errors of an option; before they are known, with the number of its sampled shots.
fn error_line<'l>(app: &App, option: usize, is_selected: bool, [name, width]: [usize; 2]) -> Line<'l> {
    let theme = app.theme;
    let label = option_name(app, option, name - 1);
    let (mark, style) = if is_selected { ("▸", theme.selected()) } else { (" ", theme.base()) };
    let mut line = Line::from(Span::styled(format!("{mark}{label:0$}", name - 1), style));
    line.push_span("  ");
    let found = app.judgement(option).and_then(|judged| errors(&judged.checked, judged.sampled.known()?));
    let Some((found, _)) = found else {
        line.spans.extend(still_tried(app, option).spans);
        return line;
    };
    let [computing, inputs] = found.map(|share| units::significant(share, Unit::Percent, 1));
    let signs = if is_selected { theme.title() } else { theme.base() };
    line.spans.extend(gauges::errors(found, width, [theme.title(), curve(app, option)]));
    let is_sampling = app.options[option].is_sampling();
    let turns = if is_sampling { turning(app.beat + option) } else { " " };
    line.push_span(Span::styled(format!("{turns}{computing:>7} %{:>9} %", format!("±{inputs}")), signs));
    line
}

/// Number of sampled shots of an option that still computes.
fn still_tried<'l>(app: &App, option: usize) -> Line<'l> {
    let tried = app.judgement(option).and_then(|judged| Some(judged.sampled.known()?.samples.len()));
    let words = match tried {
        Some(count) => format!("{count} shots tried"),
        None if app.busy() => "computing".to_owned(),
        None => "not computed".to_owned(),
    };
    let mark = if app.busy() { format!("{} ", turning(app.beat + option)) } else { String::new() };
    Line::styled(mark + &words, app.theme.muted())
}

/// Least cells of a name and its mark.
const NAME: usize = 12;
/// Cells beside the scale of errors: two numbers and a turning mark.
const NUMBERS: usize = 23;
/// Cells of the count of shots. `WITH_COUNTS`: least width that shows the count.
const COUNT: usize = 8;
const WITH_COUNTS: usize = 95;

/// Largest error of computing, as a share of the spread of the samples, that changes nothing.
const SMALL_ERROR: f64 = 0.1;

/// Half the spread of the samples, as a share of the middle value, beyond which the user should measure the inputs better.
const WIDE_INPUTS: f64 = 0.5;

/// Says whether the inputs or the computation cause most of the error, and whether a finer computation helps. Shorter on a narrow screen.
/// `None` until enough shots are sampled.
fn answer<'l>(app: &App, judged: &Judgement, width: u16) -> Option<Line<'l>> {
    let ([computing, inputs], quantity) = errors(&judged.checked, judged.sampled.known()?)?;
    let of = name_of(quantity);
    let [error, open] = [computing, inputs].map(|share| units::significant(share, Unit::Percent, 1));
    let finer = app.keymap.hint(Action::Finer);
    let inputs_decide =
        |shots: &str| format!("Your inputs decide: {of} ±{open} %{shots}; computing {error} %");
    let is_exact = computing <= SMALL_ERROR * inputs;
    let is_wide = inputs > WIDE_INPUTS;
    let text = |shots: &str| match is_exact {
        true if is_wide => format!("! {}", inputs_decide(shots)),
        true => inputs_decide(shots),
        false => format!("! Computing adds {error} % to the ±{open} % of {of} by your inputs"),
    };
    let (todo, style) = match is_exact {
        true if is_wide => ("measure these first".to_owned(), app.theme.limit()),
        // No verdict color: this sentence is no verdict on the shelter.
        true => ("finer tells no more".to_owned(), app.theme.title()),
        false => (format!("{finer} computes finer"), app.theme.limit()),
    };
    let texts = [format!("{}: {todo}", text(" in 9 of 10 shots")), format!("{}: {todo}", text(""))];
    let fits = |text: &String| text.width() <= usize::from(width);
    Some(Line::styled(texts.into_iter().find(fits).unwrap_or_else(|| text("")), style))
}

/// Greatest relative error of computing height and force; greatest half spread of either, relative to its middle value, by the inputs; and
/// the quantity with this spread. `None` if too few shots are sampled.
fn errors(checked: &CheckedShot, sampled: &SampledShot) -> Option<([f64; 2], Quantity)> {
    let quantities = [Quantity::Height, Quantity::Force];
    let computing =
        quantities.into_iter().map(|quantity| checked.get(quantity)).filter(|peak| peak.value > 0.0);
    let computing = computing.map(|peak| peak.error / peak.value).fold(0.0, f64::max);
    let spread = |quantity| {
        let [low, middle, high, _] = sampled.band(quantity)?;
        Some((0.5 * (high - low) / middle, quantity)).filter(|(share, _)| share.is_finite())
    };
    let wider = |one: (f64, Quantity), other: (f64, Quantity)| if other.0 > one.0 { other } else { one };
    let (inputs, quantity) = quantities.into_iter().filter_map(spread).reduce(wider)?;
    Some(([computing, inputs], quantity))
}

/// A line for each level: time of a run, errors of its first step before refinement, the step. A mark shows the chosen level. Parts that do
/// not fit are left out.
fn levels<'l>(app: &App, study: &AccuracyTable, width: usize) -> Vec<Line<'l>> {
    let [finer, coarser] = [Action::Finer, Action::Coarser].map(|action| app.keymap.hint(action));
    let fitting = |parts: [String; 3]| {
        let lengths = (1..=parts.len()).rev().map(|count| parts[..count].concat());
        lengths.into_iter().find(|line| line.width() <= width).unwrap_or_default()
    };
    let head = fitting([
        format!("  {:9} {:>8} {:>10} {:>10}", "level", "one run", "height err", "force err"),
        format!(" {:>10} {:>9}", "slide err", "1st step"),
        format!(" {finer} and {coarser} choose"),
    ]);
    let mut lines = vec![Line::styled(head, app.theme.muted())];
    let base = measured_at(study, study.levels[0].step);
    for LevelStep { level, step } in study.levels {
        let chosen = level == app.compute.accuracy && app.compute.step.is_none();
        let mark = if chosen { "▸" } else { " " };
        let [cost, rest, times] = match measured_at(study, step) {
            Some(measured) => costs(measured, base),
            None => ["not stable".to_owned(), String::new(), String::new()],
        };
        let step = units::milliseconds(step);
        let rest = if rest.is_empty() { rest } else { format!("{rest} {step:>9}") };
        let style = if chosen { app.theme.selected() } else { app.theme.base() };
        lines.push(Line::styled(fitting([format!("{mark} {:9}{cost}", level.name()), rest, times]), style));
    }
    let told = [enough(&app.case, study), required(app)];
    let told = told.iter().flat_map(|told| super::report::wrapped(told, width));
    lines.extend(told.map(|line| Line::styled(line, app.theme.base())));
    lines
}

/// The effects that the scene requires of the model, as found by the study of effects.
fn required(app: &App) -> String {
    match app.studies.finished(StudyKind::Effects).map(|finished| &finished.found) {
        Some(Found::Effects(found)) => format!("effects: {}", effects::requirement(&found.value)),
        _ => "effects: Studies, Effects finds those required here".to_owned(),
    }
}

/// The run at a step [s], if it has a result.
fn measured_at(study: &AccuracyTable, step: f64) -> Option<Measured> {
    let mut rows = study.rows.iter().filter(|row| row.method == Method::Verlet && row.step == step);
    rows.find_map(|row| row.result)
}

/// Three parts of a line: time of a run with its height and force errors; slide error; cost relative to a draft.
fn costs(m: Measured, base: Option<Measured>) -> [String; 3] {
    let percent = |error: f64| {
        if error > 0.0 && error < 5e-7 { "<0.0001 %".to_owned() } else { format!("{:.4} %", error * 100.0) }
    };
    let wall = m.wall.as_secs_f64();
    let times = base.map_or_else(String::new, |base| {
        format!(" {:.1} times draft", wall / base.wall.as_secs_f64().max(f64::MIN_POSITIVE))
    });
    let [time, height, force, slide] =
        [units::milliseconds(wall), percent(m.height_error), percent(m.force_error), percent(m.drift_error)];
    [format!(" {time:>8} {height:>10} {force:>10}"), format!(" {slide:>10}"), times]
}
