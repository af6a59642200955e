//! What accuracy costs on this plan and this machine: the accuracy levels, and both methods from coarse to fine.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Dataset, GraphType, Paragraph, Wrap};

use super::chart::{Scale, chart};
use super::studies::{message, waiting};
use crate::choice::Method;
use crate::report::charts::{work_and_error, work_precision};
use crate::report::no_result;
use crate::study::accuracy::{Measured, Study};
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::studies::Progress;
use crate::units;
use crate::worker::{Found, Kind};

const QUESTION: &str = "What does accuracy cost here? Both methods, coarse to fine, against a far finer run.";

/// Draws the screen.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let name = app.case.plan.delays.get(app.selected).map_or("", |delay| &delay.name);
    let rule = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.quiet())
        .title(Line::styled(format!(" {name} "), app.theme.title()));
    let inside = rule.inner(area);
    frame.render_widget(rule, area);
    let question = Line::styled(QUESTION, app.theme.title());
    let start = app.keymap.hint(Action::Open);
    match app.studies.progress(Kind::Accuracy) {
        Progress::Idle => {
            let words = format!("{start} measures the selected option; it takes seconds.");
            message(app, frame, inside, question, &words);
        }
        Progress::Failed(reason) => message(app, frame, inside, question, &no_result::message(reason)),
        Progress::Running { done, total } => waiting(app, frame, inside, question, (*done, *total)),
        Progress::Done(found) => {
            let Found::Accuracy(study) = found.as_ref() else { return };
            if study.option != app.selected {
                let other = app.case.plan.delays.get(study.option).map_or("", |delay| &delay.name);
                let words = format!("Measured for {other}. {start} measures this option instead.");
                message(app, frame, inside, question, &words);
            } else {
                let words = levels(app, study);
                let [table, plot] =
                    Layout::vertical([Constraint::Length(words.len() as u16 + 1), Constraint::Min(0)])
                        .areas(inside);
                frame.render_widget(Paragraph::new(words).wrap(Wrap { trim: false }), table);
                draw_plot(app, study, frame, plot);
            }
        }
    }
}

/// Each level with its step, its errors before refinement and its time; that chosen is marked.
fn levels<'l>(app: &App, study: &Study) -> Vec<Line<'l>> {
    let [finer, coarser] = [Action::Finer, Action::Coarser].map(|action| app.keymap.hint(action));
    let head = format!(
        "  {:10} {:>10} {:>11} {:>11} {:>11}  {finer} and {coarser} choose",
        "level", "first step", "height", "force", "one run"
    );
    let mut lines = vec![Line::styled(head, app.theme.quiet())];
    let base = measured(study, study.levels[0].1);
    for (level, step) in study.levels {
        let chosen = level == app.compute.accuracy && app.compute.step.is_none();
        let start = format!(
            "{} {:10} {:>10} ",
            if chosen { ">" } else { " " },
            level.name(),
            units::milliseconds(step)
        );
        let words = measured(study, step).map_or_else(|| "not stable".to_owned(), |m| costs(m, base));
        let style = if chosen { app.theme.selected() } else { app.theme.base() };
        lines.push(Line::from(Span::styled(start + &words, style)));
    }
    lines
}

/// The run of a level's step.
fn measured(study: &Study, step: f64) -> Option<Measured> {
    let mut rows = study.rows.iter().filter(|row| row.method == Method::Verlet && row.step == step);
    rows.find_map(|row| row.result)
}

fn costs(m: Measured, base: Option<Measured>) -> String {
    let percent = |error: f64| format!("{:.4} %", error * 100.0);
    let wall = m.wall.as_secs_f64();
    let times = base.map_or_else(String::new, |base| {
        format!("  {:.1} times draft", wall / base.wall.as_secs_f64().max(f64::MIN_POSITIVE))
    });
    format!(
        "{:>11} {:>11} {:>11}{times}",
        percent(m.height_error),
        percent(m.force_error),
        units::milliseconds(wall)
    )
}

/// The larger error of every run against its time, both axes logarithmic; the levels as large dots.
fn draw_plot(app: &App, study: &Study, frame: &mut Frame, area: Rect) {
    if area.height < 4 {
        return;
    }
    let Some(picture) = work_precision(study) else { return };
    let at = |(x, y): (f64, f64)| (picture.x.coordinate(x), picture.y.coordinate(y));
    let series: Vec<(&str, Vec<(f64, f64)>)> = picture
        .series
        .iter()
        .map(|series| (series.name, series.points.iter().copied().map(at).collect()))
        .collect();
    let dots = |data, style: Style, marker, name: &'static str| {
        Dataset::default().data(data).graph_type(GraphType::Line).marker(marker).style(style).name(name)
    };
    let chosen = study.levels.iter().find(|(level, _)| *level == app.compute.accuracy);
    let chosen: Vec<(f64, f64)> =
        chosen.and_then(|(_, step)| work_and_error(&measured(study, *step)?)).into_iter().map(at).collect();
    let points = |data, marker, name: &'static str| {
        let style = app.theme.firing();
        Dataset::default().data(data).graph_type(GraphType::Scatter).marker(marker).style(style).name(name)
    };
    let sets = vec![
        dots(&series[1].1, app.theme.limit(), Marker::Braille, picture.series[1].name),
        dots(&series[0].1, app.theme.curve(), Marker::Braille, picture.series[0].name),
        points(&series[2].1, Marker::Dot, "levels"),
        points(&chosen, Marker::Block, "chosen"),
    ];
    let decades = |axis: &crate::report::model::Axis| {
        let [from, to] = axis.ends();
        let exponents = from.round() as i32..=to.round() as i32;
        Scale::new([from, to], exponents.map(|exponent| axis.mark(f64::from(exponent))))
    };
    let title = "error, %, against the time of a run, ms".to_owned();
    let chart = chart(app, title, sets, decades(&picture.x), decades(&picture.y));
    frame.render_widget(chart, area);
}
