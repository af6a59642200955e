//! `shelter report`: one page for the blast file.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use super::arguments::{ComputeArguments, FormatArg, LangArg, LookArguments, VerdictArguments};
use super::fit::read_observations;
use super::judge_plans::{judge_plans, print_judged_plans};
use super::load_plans::open_option;
use super::print::{print_beside_verdict, print_warnings};
use super::run_study::run_study;
use super::status::{Status, failed, was_interrupted, wrong};
use super::sweep::swept_order;
use crate::file;
use crate::plan::observations::{MeasuredFiring, named_twice};
use crate::report::check;
use crate::report::html::{self, Page};
use crate::report::language::{say, speaking};
use crate::report::observed::{contradiction, fired_otherwise, observed_rows};
use crate::report::words::assumption_words::holds;
use crate::study::assumptions::{Extent, SAMPLES, find_assumptions};
use crate::study::check::Question;
use crate::study::fit::observation_bands::predict_observations;
use crate::study::fit::observed_shots::ObservedShots;
use crate::study::judge::recommend::MustPass;
use crate::study::samples::sample_count::Sampling;
use crate::study::sweep::{DEFAULT_INTERVALS, sweep};
use crate::study::{Computed, Context, NoResult, StudyControl};

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

/// Whether a file is there that this program did not write as a page.
fn is_of_another(path: &Path) -> bool {
    path.is_file() && !std::fs::read_to_string(path).is_ok_and(|text| text.is_empty() || html::is_page(&text))
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
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
    let order = match arguments.sweep.then(|| swept_order(&case, asked)).transpose() {
        Ok(order) => order.unwrap_or_default(),
        Err(message) => return wrong(&message),
    };
    let Some(files) = read_observations(&case, &arguments.observed, look) else { return Ok(Status::Wrong) };
    if let Some(message) = named_twice(&files) {
        return wrong(&message);
    }
    // A sweep needs one way to fire the holes of a row; without an option named, options that differ have none.
    let cases = [if asked.is_some() { case.with_hole_timing_defaulting_to(option) } else { case }];
    let sampling = arguments.verdict.sampling();
    let checked = match judge_plans(&cases, sampling, &arguments.compute, &Question::OF_VERDICT) {
        Ok(checked) => checked,
        Err(reason) => return failed(&reason),
    };
    let compute = arguments.compute.settings(&cases[0].plan);
    let swept = (arguments.sweep && !was_interrupted()).then(|| {
        run_study(&arguments.compute, |control| {
            sweep(
                &Context::new(&cases[0], compute, control).with_sampling(sampling),
                &order,
                &DEFAULT_INTERVALS,
            )
        })
    });
    let swept = match swept.transpose() {
        Ok(swept) => swept,
        Err(reason) => return failed(&reason),
    };
    let seen = ObservedShots::new(&files);
    let predict = |control: &StudyControl| {
        let value =
            predict_observations(&Context::new(&cases[0], compute, control).with_sampling(sampling), &seen)?;
        Ok(Computed::complete(value))
    };
    let is_asked = !files.is_empty() && !was_interrupted();
    let predictions = match is_asked.then(|| run_study(&arguments.compute, predict)) {
        None => Some(Vec::new()),
        Some(Ok(found)) => Some(found.value),
        Some(Err(NoResult::OutOfTime)) => None,
        Some(Err(reason)) => return failed(&reason),
    };
    let observed = observed_rows(&cases[0], &seen.list, predictions.as_deref().unwrap_or_default());
    let contradiction = || match predictions {
        None => {
            vec![say!("observations of earlier shots were not compared with the plan: the time was up")]
        }
        Some(_) => {
            let logged: Vec<MeasuredFiring> = seen.firings.concat();
            contradiction(&observed).into_iter().chain(fired_otherwise(&cases[0], &logged)).collect()
        }
    };
    // What a pass stands on is asked of an option that may be fired.
    let may_be_fired = html::may_be_fired(&checked.value[0].results, option, &contradiction());
    let is_asked = asked.is_some() && may_be_fired && !was_interrupted();
    let stands_on = sampling.filter(|_| is_asked).map(|Sampling { seed, .. }| {
        let sampling = Sampling::exactly(SAMPLES, seed);
        // The verdicts stand without it.
        run_study(&arguments.compute, |control| {
            find_assumptions(
                &Context::new(&cases[0], compute, control).with_sampling(sampling),
                option,
                Extent::Nearest,
            )
        })
        .ok()
    });
    // Who interrupts wants no page, and keeps the page that is there.
    if was_interrupted() {
        return failed(&NoResult::Stopped);
    }
    let page = speaking(arguments.lang.into(), || {
        html::page(&Page {
            case: &cases[0],
            results: &checked.value[0].results,
            to_be_fired: asked.map(|_| option),
            sampling: sampling.as_ref(),
            holds: stands_on.iter().flatten().next().map(|found| holds(&found.value)).as_deref(),
            sweep: swept.as_ref(),
            fitted_to_observed: files.iter().any(|file| file.was_fitted(&cases[0].plan.fitted_from)),
            observed: &observed,
            files: &files,
            contradiction: &contradiction(),
            partial: checked.partial
                || predictions.is_none()
                || stands_on.as_ref().is_some_and(|found| found.as_ref().is_none_or(|found| found.partial))
                || swept.as_ref().is_some_and(|swept| swept.partial),
            unsaved: false,
            date: &html::today(),
        })
    });
    let contradiction = contradiction();
    if output.as_os_str() == "-" {
        print_beside_verdict(&page)?;
    } else {
        // A page that nobody read is no verdict: a reader that leaves is an error here.
        file::save(output, &page).map_err(|error| io::Error::other(error.to_string()))?;
        tell!("wrote {}", output.display());
    }
    let status = match arguments.format {
        Some(format) => print_judged_plans(&cases, &checked, &contradiction, format, look)?,
        None => {
            let reports = [check::report(
                &cases[0],
                &checked.value[0].results,
                None,
                MustPass::Every,
                &[],
                checked.partial,
            )];
            print_warnings(&reports);
            Status::of(&reports)
        }
    };
    contradiction.iter().for_each(|sentence| tell!("warning: {sentence}"));
    let results = &checked.value[0].results;
    Ok(match asked {
        // The page says it in the same words.
        Some(_) if !html::may_be_fired(results, option, &contradiction) => Status::Fail,
        Some(_) => Status::Pass,
        None if contradiction.is_empty() => status,
        None => Status::Fail,
    })
}
