//! `shelter search`: the firing schedules with the least risk.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::load_plans::open;
use super::print_sharded::print_search;
use super::run_study::run_saved_study;
use super::save::SharedArguments;
use super::status::{Status, failed, saved, was_interrupted, wrong};
use crate::file;
use crate::plan::{DelayOption, edit};
use crate::study::Case;
use crate::study::Context;
use crate::study::results_file::Question;
use crate::study::search::{MOST_TRIED, Search, can_be_shared, search, try_schedules};

#[derive(Args)]
pub struct Arguments {
    /// Plan to search; its section [search] says what may be chosen
    plan: PathBuf,
    /// Write the best schedules that pass into the plan, as delay options
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "1", value_parser = clap::value_parser!(u8).range(1..=10))]
    write: Option<u8>,
    #[command(flatten)]
    saved: SharedArguments,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    if arguments.write.is_some() && !arguments.plan.is_file() {
        return wrong("--write has no file to write into: give the plan by its name");
    }
    let compute = arguments.study.compute.settings(&case.plan);
    let sampling = arguments.study.verdict.sampling();
    let journal = match arguments.saved.journal(&case, Question::Search { sampling }, compute) {
        Ok(journal) => journal,
        Err(message) => return wrong(&message),
    };
    if let Some(shard) = arguments.saved.shard {
        match can_be_shared(&case) {
            Err(reason) => return failed(&reason),
            Ok(false) => {
                return wrong(&format!(
                    "of more than {MOST_TRIED} schedules the best are searched, not shared: leave out --shard"
                ));
            }
            Ok(true) => {}
        }
        return saved(run_saved_study(&arguments.study.compute, journal, |control| {
            try_schedules(&Context::new(&case, compute, control).with_sampling(sampling), shard)
        }));
    }
    let searched = run_saved_study(&arguments.study.compute, journal, |control| {
        search(&Context::new(&case, compute, control).with_sampling(sampling))
    });
    match searched {
        Err(reason) => failed(&reason),
        Ok(found) => {
            let status = print_search(&case, &found, arguments.study.format, look)?;
            if let Some(count) = arguments.write.filter(|_| !was_interrupted()) {
                write(arguments, &case, &found.value, count.into())?;
            }
            Ok(status)
        }
    }
}

/// Adds the best schedules that pass to the plan, but for those that an option of the plan fires already.
fn write(arguments: &Arguments, case: &Case, found: &Search, count: usize) -> io::Result<()> {
    if std::fs::read_to_string(&arguments.plan)? != case.source.text {
        return Err(io::Error::other("the plan has changed meanwhile; nothing was written"));
    }
    let best: Vec<_> = found.passing().take(count).collect();
    if best.is_empty() {
        tell!("nothing was written: no schedule found passes");
        return Ok(());
    }
    let is_known = |delay: &&&DelayOption| case.plan.delays.iter().any(|planned| planned.fires_like(delay));
    let (known, delays): (Vec<&DelayOption>, Vec<&DelayOption>) = best.iter().partition(is_known);
    known.iter().for_each(|delay| tell!("in the plan already: {}", delay.name));
    if delays.is_empty() {
        return Ok(());
    }
    let text = edit::add_delays(&case.source.text, &case.plan, &delays).map_err(io::Error::other)?;
    file::save(&arguments.plan, &text)?;
    let names: Vec<&str> = delays.iter().map(|delay| delay.name.as_str()).collect();
    tell!("written: {}: {}", arguments.plan.display(), names.join("; "));
    Ok(())
}
