//! What is on the screen as a file: tables as CSV, pictures as SVG, the whole comparison as a page.

use std::path::Path;

use super::app::{App, Row, Screen};
use super::studies::Progress;
use crate::file;
use crate::report::model::{Block, Chart, Report};
use crate::report::{self, charts, html};
use crate::scene::fire_at_s;
use crate::study::plans::Results;
use crate::worker::{Found, Kind};

/// Writes what is shown to a new file; its ending says how. Or why not, in words.
pub fn write(app: &App, path: &Path) -> Result<(), String> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let text = match ending {
        "csv" => csv(app)?,
        "svg" => svg(app)?,
        "html" => html::page(&app.case, &results(app)?, &html::today()),
        _ => return Err("the name must end in .csv, .svg or .html".to_owned()),
    };
    file::create(path, &text).map_err(|error| error.to_string())
}

/// The table on the screen.
pub fn csv(app: &App) -> Result<String, String> {
    Ok(report::csv::csv(&[report(app)?]))
}

/// The report on the screen.
fn report(app: &App) -> Result<Report, String> {
    let case = &app.case;
    match app.screen {
        Screen::Plan | Screen::Compare => Ok(report::check::report(case, &results(app)?, false)),
        Screen::Flight => {
            let flight = app.studies.flight(app.selected).ok_or("nothing is shown yet")?;
            Ok(report::trace::history(&flight.outcome.history))
        }
        Screen::Studies => Ok(match found(app, app.studies.shown)? {
            Found::Sweep(sweep) => report::sweep::report(case, sweep, false),
            Found::Orders(orders) => report::orders::report(case, orders, false),
            Found::Scatter(draw, samples) => report::scatter::report(case, draw, samples, false),
            Found::Size(sizing) => report::size::report(case, sizing),
            Found::Flight(_) | Found::Accuracy(_) => Report::default(),
        }),
        Screen::Accuracy => match found(app, Kind::Accuracy)? {
            Found::Accuracy(study) if study.option == app.selected => {
                Ok(report::accuracy::report(case, study, &[]))
            }
            _ => Err("the selected option is not measured yet".to_owned()),
        },
    }
}

/// The picture on the screen.
fn svg(app: &App) -> Result<String, String> {
    let charts: Vec<Chart> = match app.screen {
        Screen::Plan => return Ok(html::top_view(&app.case, Some(app.selected))),
        Screen::Compare | Screen::Flight => {
            let history = match app.studies.flight(app.selected) {
                Some(flight) if app.screen == Screen::Flight => &flight.outcome.history,
                _ => &app.checked(app.selected).ok_or("the selected option has no result yet")?.history,
            };
            let delay = &app.case.plan.delays[app.selected];
            charts::history(&app.case, history, &fire_at_s(&delay.timing)).into()
        }
        Screen::Studies | Screen::Accuracy => {
            let blocks = report(app)?.blocks.into_iter();
            let chart = |block| match block {
                Block::Chart(chart) | Block::Picture(chart) => Some(chart),
                Block::Text(_) | Block::Table(_) => None,
            };
            blocks.filter_map(chart).collect()
        }
    };
    Ok(html::stack(&charts.iter().filter_map(html::svg).collect::<Vec<_>>()))
}

fn found(app: &App, kind: Kind) -> Result<&Found, String> {
    match app.studies.progress(kind) {
        Progress::Done(found) => Ok(found),
        _ => Err("nothing is shown yet".to_owned()),
    }
}

/// Results of all options, once there are.
fn results(app: &App) -> Result<Results, String> {
    let result = |row: &Row| match row {
        Row::Done(checked) => Ok(Ok((**checked).clone())),
        Row::Failed(words) => Ok(Err(words.clone())),
        Row::Waiting | Row::Running { .. } => Err("not all options are computed yet".to_owned()),
    };
    app.rows.iter().map(result).collect()
}
