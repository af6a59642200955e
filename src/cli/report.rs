//! `shelter report`: one page for the blast file.

use std::io;
use std::path::{Path, PathBuf};
use std::slice;

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LangArg, LookArguments, VerdictArguments};
use super::fit::read_observations;
use super::judge_plans::{JudgedCase, print_judged_plans};
use super::load_plans::open_option;
use super::print::{print_text, print_warnings};
use super::run_study::run_study;
use super::standing::{observation_record, standing_now};
use super::status::{Status, failed, was_interrupted, wrong};
use super::sweep::swept_order;
use crate::file;
use crate::plan::observations::{files_of, named_twice, names_of_films_not_given};
use crate::report::check;
use crate::report::html::{self, Page};
use crate::report::language::speaking;
use crate::report::observed::observed_rows;
use crate::study::judge::recommend::MustPass;
use crate::study::observed::NotCompared;
use crate::study::page::Question;
use crate::study::sweep::{self, DEFAULT_INTERVALS};
use crate::study::{Computed, Context, NoResult};

#[derive(Args)]
pub struct Arguments {
    /// Plan to report; `-` reads standard input
    plan: PathBuf,
    /// Page to write; `-` writes it to standard output
    #[arg(short, long, value_name = "FILE.html")]
    output: PathBuf,
    /// Overwrite the file though it is no page that this program wrote
    #[arg(long)]
    force: bool,
    /// Name of the delay option to be fired: it heads the page
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    /// Also sweep the interval between rows, from 0 to 500 ms, in the order of the option to be fired
    #[arg(long)]
    sweep: bool,
    /// Compare observations of earlier shots with the plan; files as of `fit`, or a folder
    #[arg(long, value_name = "FILE.csv", num_args = 1..)]
    observed: Vec<PathBuf>,
    /// Language of the page; what is printed stays English
    #[arg(long, value_enum, default_value_t, value_name = "LANGUAGE")]
    lang: LangArg,
    /// Also print the results, as `check` does
    #[arg(long, value_enum)]
    format: Option<FormatArg>,
    #[command(flatten)]
    verdict: VerdictArguments,
    #[command(flatten)]
    compute: ComputeArguments,
}

/// Whether the path holds a file that is neither empty nor a page of this program.
fn is_of_another(path: &Path) -> bool {
    path.is_file() && !std::fs::read_to_string(path).is_ok_and(|text| text.is_empty() || html::is_page(&text))
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let mut is_written = false;
    let status = write_page(arguments, look, &mut is_written);
    let output = &arguments.output;
    let is_page = || std::fs::read_to_string(output).is_ok_and(|text| html::is_page(&text));
    // A user who takes an old page for the page of this command fires by another plan. A pipe is not read: without a partner it would
    // block.
    if !is_written && output.is_file() && is_page() {
        tell!("no page was written: {} is an earlier one, do not fire by it", output.display());
    }
    status
}

/// Writes the page, and sets `is_written` after that.
fn write_page(arguments: &Arguments, look: &LookArguments, is_written: &mut bool) -> io::Result<Status> {
    let asked = arguments.option.as_deref();
    let Some((case, option)) = open_option(&arguments.plan, asked, look) else { return Ok(Status::Wrong) };
    let Arguments { plan, output, .. } = arguments;
    let same = |a: &Path, b: &Path| a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
    if same(plan, output) {
        return wrong(&format!("{} is the plan itself: give the page another name", output.display()));
    }
    if !arguments.force && is_of_another(output) {
        return wrong(&format!(
            "{} is there and is no page of this program: give another name, or --force",
            output.display()
        ));
    }
    if output.as_os_str() == "-" && arguments.format.is_some() {
        return wrong("page and results cannot both go to standard output: write the page to a file");
    }
    // A sweep needs one timing of the holes of a row. If options differ, only a named option gives one.
    let holes = case.plan.shared_hole_timing().or_else(|| case.plan.hole_timing_of(asked.map(|_| option)));
    let swept = |order| sweep::Question { order, intervals: DEFAULT_INTERVALS, holes };
    let sweep = match arguments.sweep.then(|| swept_order(&case, asked).map(swept)).transpose() {
        Ok(sweep) => sweep,
        Err(message) => return wrong(&message),
    };
    let Some(mut observed) = read_observations(&case, &arguments.observed, look) else {
        return Ok(Status::Wrong);
    };
    // Observations in the record count, too, unless a named file holds them.
    let record_before = observation_record(&case);
    let (withdrawn, recorded) = (record_before.withdrawn(), record_before.read(&case));
    for file in recorded.iter().flatten() {
        let is_named = observed.iter().any(|named| named.holds_all_of(file));
        observed.extend((!is_named).then(|| file.clone()));
    }
    if let Some(message) = named_twice(&observed) {
        return wrong(&message);
    }
    let sampling = arguments.verdict.sampling();
    let question = Question { to_be_fired: asked.map(|_| option), sweep, observed };
    let compute = arguments.compute.settings(&case.plan);
    let answered = run_study(&arguments.compute, |control| {
        question.answer(&Context::new(&case, compute, control).with_sampling(sampling))
    });
    let Computed { value: found, partial } = match answered {
        Ok(answered) => answered,
        Err(reason) => return failed(&reason),
    };
    // A page is a permission to fire, so it needs the plan and the observations as they are now, not as they were when the work began.
    let is_unread = recorded.is_err() || observation_record(&case) != record_before;
    let unreadable = record_before.unreadable_file().map(|file| NotCompared::Unreadable(file.to_owned()));
    let why = unreadable.unwrap_or(NotCompared::InRecord);
    let unread = is_unread.then_some(why);
    let taken_back = record_before.is_fitted_to_withdrawn(&case.plan).then_some(NotCompared::TakenBack);
    let compared = found.compared(&case, &question.observed).with_other_blasts(record_before.other_blasts());
    let given = files_of(&arguments.observed).unwrap_or_default();
    let films = names_of_films_not_given(plan, &given);
    let compared = compared.with_not_compared(taken_back).with_not_compared(unread).with_unread_films(films);
    let standing = standing_now(&case, compared);
    let results = &found.judged.value.results;
    let rows = observed_rows(&case, &found.seen.list, found.predictions.as_deref().unwrap_or_default());
    // After an interrupt the program writes no page. An old page stays as it is.
    if was_interrupted() {
        return failed(&NoResult::Stopped);
    }
    let stands_on = |option| found.stands_on.as_ref().filter(|_| question.to_be_fired == Some(option));
    let stands_on: Vec<_> = (0..results.len()).map(stands_on).collect();
    let page = speaking(arguments.lang.into(), || {
        html::page(&Page {
            case: &case,
            results,
            to_be_fired: question.to_be_fired,
            sampling: sampling.as_ref(),
            stands_on: &stands_on,
            sweep: found.sweep.as_ref(),
            observed: &rows,
            files: &question.observed,
            withdrawn: &withdrawn,
            standing: &standing,
            partial,
            date: &html::today(),
        })
    });
    if output.as_os_str() == "-" {
        print_text(&page)?;
    } else {
        // The page may go to a pipe. If its reader leaves, nobody has read the page, so that is an error here.
        file::save(output, &page)?;
        *is_written = true;
        tell!("wrote {}", output.display());
    }
    let against_firing =
        asked.map(|_| standing.against_firing(results[option].as_ref().ok(), found.stands_on.as_ref()));
    let Computed { value: judged, partial } = found.judged;
    let status = match arguments.format {
        Some(format) => {
            let value = vec![JudgedCase { case, standing, files: question.observed, judged }];
            print_judged_plans(&Computed { value, partial }, format, look)?
        }
        None => {
            let must_pass = MustPass::Every;
            let report = check::report_of_plan(
                &case,
                &judged.results,
                None,
                must_pass,
                (&standing, &question.observed),
                partial,
            );
            print_warnings(slice::from_ref(&report));
            Status::of(slice::from_ref(&report))
        }
    };
    Ok(match against_firing {
        // The page gives the reason in words.
        Some(None) => Status::Pass,
        Some(Some(_)) => Status::Fail,
        None => status,
    })
}
