//! `shelter search`: the firing schedules with the least risk.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments};
use super::ask::{Ask, needs_file, write_plan};
use super::save::SharedArguments;
use super::status::{Status, was_interrupted};
use crate::plan::{DelayOption, edit};
use crate::report::answer::why_held;
use crate::report::check::NOTHING_VARIED;
use crate::study::Case;
use crate::study::question::{Found, Question};
use crate::study::search::{self, Search};

#[derive(Args)]
pub struct Arguments {
    /// Plan to search; its section [search] says what may be chosen
    plan: PathBuf,
    /// Write the best schedules that pass into the plan, as delay options
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "1", conflicts_with = "shard", value_parser = clap::value_parser!(u8).range(1..=10))]
    write: Option<u8>,
    #[command(flatten)]
    saved: SharedArguments,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let ask = Ask::of_study(&arguments.plan, &arguments.study).shared(&arguments.saved);
    let question = |_: &Case| {
        if arguments.write.is_some() {
            needs_file(&arguments.plan)?;
        }
        Ok(Question::Search(search::Question {}))
    };
    ask.run_then(look, question, |answered, status| {
        let count = arguments.write.filter(|_| !was_interrupted());
        if let (Some(count), Found::Search(found)) = (count, &answered.found) {
            match answered.standing.against_passes() {
                Some(why) => tell!("nothing was written: {}", why_held(why)),
                None => write(arguments, &answered.case, &found.value, count.into())?,
            }
        }
        Ok(status)
    })
}

/// Adds the best schedules that pass to the plan, except schedules that an option of the plan fires already.
fn write(arguments: &Arguments, case: &Case, found: &Search, count: usize) -> io::Result<()> {
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
    write_plan(&arguments.plan, case, edit::add_delays(&case.source.text, &case.plan, &delays))?;
    let names: Vec<&str> = delays.iter().map(|delay| delay.name.as_str()).collect();
    let caveat = if found.sampled { "" } else { NOTHING_VARIED };
    tell!("written: {}: {}{caveat}", arguments.plan.display(), names.join("; "));
    Ok(())
}
