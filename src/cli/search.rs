//! `shelter search`: the firing schedules with the least risk.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, shard};
use super::load_plans::open;
use super::print::print_text;
use super::print_sharded::print_search;
use super::run_study::run_study;
use super::status::{Status, failed, wrong};
use crate::file;
use crate::plan::{DelayOption, edit};
use crate::study::merge::{Question, ShardResults, write_shard};
use crate::study::search::{MOST_JUDGED, Search, search, try_schedules};
use crate::study::{Case, Found, Shard};

#[derive(Args)]
pub struct Arguments {
    /// Plan to search; its section [search] says what may be chosen
    plan: PathBuf,
    /// Write the best schedules that pass into the plan, as delay options
    #[arg(long, value_name = "COUNT", num_args = 0..=1, default_missing_value = "1", value_parser = clap::value_parser!(u8).range(1..=10))]
    write: Option<u8>,
    /// This machine's shard; `shelter merge` joins the shards
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with_all = ["timeout", "format", "write"])]
    shard: Option<Shard>,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    if arguments.write.is_some() && case.source.path == "-" {
        return wrong("--write has no file to write into: give the plan by its name");
    }
    let compute = arguments.study.compute.settings(&case.plan);
    let sampling = arguments.study.verdict.sampling();
    if let Some(shard) = arguments.shard {
        let tried = run_study(&arguments.study.compute, |progress| {
            try_schedules(&case, sampling.as_ref(), &compute, shard, progress)
        });
        return match tried {
            Err(reason) => failed(&reason),
            Ok(Found { value: None, .. }) => wrong(&format!(
                "of more than {MOST_JUDGED} schedules the best are searched, not shared: leave out --shard"
            )),
            Ok(Found { value: Some(tried), .. }) => {
                let question = Question::Search { sampling };
                print_text(&write_shard(&case, question, compute, shard, &ShardResults::Search(tried))?)?;
                Ok(Status::Pass)
            }
        };
    }
    match run_study(&arguments.study.compute, |progress| search(&case, sampling.as_ref(), &compute, progress))
    {
        Err(reason) => failed(&reason),
        Ok(Found { value: found, partial }) => {
            let status = print_search(&case, &found, partial, arguments.study.format, look)?;
            if let Some(count) = arguments.write {
                write(arguments, &case, &found, count.into())?;
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
        eprintln!("nothing was written: no schedule found passes");
        return Ok(());
    }
    let is_known = |delay: &&&DelayOption| case.plan.delays.iter().any(|own| own.fires_like(delay));
    let (known, delays): (Vec<&DelayOption>, Vec<&DelayOption>) = best.iter().partition(is_known);
    known.iter().for_each(|delay| eprintln!("in the plan already: {}", delay.name));
    if delays.is_empty() {
        return Ok(());
    }
    let text = edit::add_delays(&case.source.text, &case.plan, &delays).map_err(io::Error::other)?;
    file::save(&arguments.plan, &text)?;
    let names: Vec<&str> = delays.iter().map(|delay| delay.name.as_str()).collect();
    eprintln!("written: {}: {}", arguments.plan.display(), names.join("; "));
    Ok(())
}
