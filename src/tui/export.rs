//! What is on the screen as a file: tables as CSV, pictures as SVG, the whole comparison as a page.

use std::path::Path;

use super::app::{App, Row, Screen};
use super::studies::Progress;
use crate::file;
use crate::report;
use crate::scene::fire_at_s;
use crate::study::plans::Results;
use crate::worker::{Found, Kind};

/// Writes what is shown to a new file; its ending says how. Or why not, in words.
pub fn write(app: &App, path: &Path) -> Result<(), String> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let text = match ending {
        "csv" => csv(app)?,
        "svg" => svg(app)?,
        "html" => report::html::page(&app.case, &results(app)?, &report::html::today()),
        _ => return Err("the name must end in .csv, .svg or .html".to_owned()),
    };
    file::create(path, &text).map_err(|error| error.to_string())
}

/// The table on the screen.
pub fn csv(app: &App) -> Result<String, String> {
    match app.screen {
        Screen::Plan | Screen::Compare => Ok(report::csv(report::check::Row::of(&app.case, &results(app)?))),
        Screen::Flight => {
            let flight = app.studies.flight(app.selected).ok_or("nothing is shown yet")?;
            Ok(report::csv(report::trace::history(&flight.outcome.history)))
        }
        Screen::Studies => Ok(match found(app, app.studies.shown)? {
            Found::Sweep(sweep) => report::csv(sweep.points.iter().map(report::sweep::Row::new)),
            Found::Orders(orders) => {
                report::csv(orders.ranked.iter().map(|tried| report::orders::Line::new(&app.case, tried)))
            }
            Found::Scatter(_, samples) => report::csv(report::scatter::lines(&app.case, samples)),
            Found::Size(sizing) => report::csv(sizing.combinations.iter().map(report::size::Line::new)),
            Found::Flight(_) | Found::Accuracy(_) => String::new(),
        }),
        Screen::Accuracy => match found(app, Kind::Accuracy)? {
            Found::Accuracy(study) if study.option == app.selected => {
                Ok(report::csv(report::accuracy::rows(study)))
            }
            _ => Err("the selected option is not measured yet".to_owned()),
        },
    }
}

/// The picture on the screen.
fn svg(app: &App) -> Result<String, String> {
    let pictures = match app.screen {
        Screen::Plan => vec![report::html::top_view(&app.case, Some(app.selected))],
        Screen::Compare | Screen::Flight => {
            let history = match app.studies.flight(app.selected) {
                Some(flight) if app.screen == Screen::Flight => &flight.outcome.history,
                _ => &app.checked(app.selected).ok_or("the selected option has no result yet")?.history,
            };
            let delay = &app.case.plan.delays[app.selected];
            report::chart::history(&app.case, history, &fire_at_s(&delay.timing))
        }
        Screen::Studies => match found(app, app.studies.shown)? {
            Found::Sweep(sweep) => report::chart::sweep(&app.case, sweep),
            _ => return Err("this study has no picture; write a .csv file".to_owned()),
        },
        Screen::Accuracy => match found(app, Kind::Accuracy)? {
            Found::Accuracy(study) if study.option == app.selected => {
                report::chart::accuracy(study).into_iter().collect()
            }
            _ => return Err("the selected option is not measured yet".to_owned()),
        },
    };
    Ok(report::chart::stack(&pictures))
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
