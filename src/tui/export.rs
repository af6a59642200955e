//! Export of the screen to a file: tables as CSV, charts as SVG, the whole comparison as an HTML page.

use std::path::Path;

use super::app::App;
use super::compare::{results, results_so_far};
use super::screen::Screen;
use super::studies::ShownStudy;
use crate::file;
use crate::report::csv::Separators;
use crate::report::html::{self, Page};
use crate::report::{self, charts};
use crate::study::assumptions::Assumptions;
use crate::study::judge::recommend::MustPass;
use crate::study::question::{Found, StudyKind};
use crate::study::samples::sample_count::Sampling;
use crate::study::{Case, FileState};

/// Writes the contents of the screen to a new file. The file's extension sets the format. Returns the reason on failure.
pub fn write(app: &App, path: &Path) -> Result<(), String> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let text = match ending {
        "csv" => csv(app)?,
        "svg" => svg(app)?,
        "html" => {
            results(&app.options)?;
            page(app, None)?
        }
        _ => return Err("the name must end in .csv, .svg or .html".to_owned()),
    };
    file::create(path, &text).map_err(|error| error.to_string())
}

/// Writes the page of the selected option to a new file, or over a page that this session wrote. Returns the reason on failure.
pub fn write_page(app: &App, path: &Path) -> Result<(), String> {
    if path.extension().is_none_or(|ending| ending != "html") {
        return Err("the name must end in .html".to_owned());
    }
    let write = if app.pages.iter().any(|page| page == path) { file::save } else { file::create };
    write(path, &page(app, Some(app.selected))?).map_err(|error| error.to_string())
}

/// The page for the blast file. It begins with the option to be fired.
fn page(app: &App, to_be_fired: Option<usize>) -> Result<String, String> {
    let standing = app.standing_now();
    let stands_on: Vec<Option<&Assumptions>> =
        (0..app.options.len()).map(|option| app.stands_on(option)).collect();
    Ok(html::page(&Page {
        case: &app.case,
        results: &results_so_far(&app.options),
        to_be_fired,
        sampling: Some(&Sampling::OF_VERDICT),
        stands_on: &stands_on,
        sweep: app.studies.sweep(&app.compute),
        observed: &app.seen_rows(),
        files: &app.record.read(&app.case).unwrap_or_default(),
        withdrawn: &app.record.withdrawn(),
        standing: &standing,
        partial: results(&app.options).is_err(),
        date: &html::today(),
    }))
}

/// The tables of the screen as CSV.
pub fn csv(app: &App) -> Result<String, String> {
    let text = match app.screen {
        Screen::Plan | Screen::Compare => {
            let report = |app: &&App| {
                let (results, standing) = (results(&app.options)?, app.standing_now());
                let mut case = Case::clone(&app.case);
                if standing.file() != FileState::AsJudged {
                    // Whoever reads the table assumes that it belongs to the file.
                    case.source.path.as_mut_os_string().push(" (not saved)");
                }
                let files = app.record.read(&app.case).unwrap_or_default();
                let standing = (&standing, &files[..]);
                Ok(report::check::report_of_plan(&case, &results, None, MustPass::Every, standing, false))
            };
            let reports: Result<Vec<_>, String> = app.plans().iter().map(report).collect();
            report::csv::csv(&reports?, Separators::Comma)
        }
        _ => report::csv::csv(&[app.report_of(finished(app)?).into_owned()], Separators::Comma),
    };
    text.map_err(|error| error.to_string())
}

/// The charts of the screen as SVG.
fn svg(app: &App) -> Result<String, String> {
    let pictures = match app.screen {
        Screen::Plan => {
            let checked = app.judgement(app.selected).map(|judged| &judged.checked);
            vec![html::top_view(&app.case, Some(app.selected), checked)]
        }
        Screen::Compare => {
            let judged = app.judgement(app.selected);
            let (shown, planned) =
                app.courses(app.selected).ok_or("the selected option has no result yet")?;
            let history = charts::history(&app.case, shown, planned);
            let samples = judged
                .and_then(|judged| judged.sampled.known())
                .into_iter()
                .flat_map(|sampled| charts::samples(&app.case, sampled));
            history
                .iter()
                .filter_map(html::svg)
                .chain(samples.filter_map(|chart| html::svg(&chart)))
                .collect()
        }
        _ => app.report_of(finished(app)?).charts().filter_map(html::svg).collect(),
    };
    Ok(html::stack_charts(&pictures))
}

/// The finished study on the screen, or the reason why there is none.
fn finished(app: &App) -> Result<&ShownStudy, String> {
    let kind = match app.screen {
        Screen::Flight => StudyKind::Flight,
        Screen::Accuracy => StudyKind::Accuracy,
        _ => app.studies.shown,
    };
    let finished = app.studies.finished(kind).ok_or("nothing is shown yet")?;
    match &finished.found {
        Found::Flight(flight) if flight.value.option != app.selected => {
            Err("nothing is shown yet".to_owned())
        }
        Found::Accuracy(study) if study.value.option != app.selected => {
            Err("the selected option is not measured yet".to_owned())
        }
        _ => Ok(finished),
    }
}
