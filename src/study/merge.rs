//! A study that several machines computed, a shard each: joined, and completed by what only all shards together tell.
//!
//! The study is computed as on one machine. What a shard holds is taken from there, the text of the plan, too: where the file of the
//! plan says something else by now, the case says so.

use std::path::Path;

use itertools::Itertools;

use super::judge_options::OptionResults;
use super::orders::{Orders, orders};
use super::results_file::{self, Contents, Question};
use super::samples::sample_count::Sampling;
use super::search::{Search, search};
use super::{Case, Computed, Context, Journal, NoResult, StudyControl};
use crate::plan::PlanSource;

/// A study whose shards are joined.
#[derive(Clone, Debug)]
pub struct Merged {
    /// The plan that all shards hold.
    pub case: Case,
    /// What the study found.
    pub answer: MergedResult,
}

/// What a study that was shared found.
#[derive(Clone, Debug)]
pub enum MergedResult {
    /// Of `orders`.
    Orders(Computed<Orders>),
    /// Of `risk`, with its samples.
    Risk(Sampling, Computed<OptionResults>),
    /// Of `search`.
    Search(Box<Computed<Search>>),
}

/// Why shards make no study.
#[derive(Clone, Debug, PartialEq)]
pub enum MergeFailure {
    /// What is wrong with the shards.
    Shards(String),
    /// What they leave to be computed has no result.
    NoResult(NoResult),
}

impl From<NoResult> for MergeFailure {
    fn from(reason: NoResult) -> Self {
        Self::NoResult(reason)
    }
}

/// Joins shards, given as `(name, text)`, and completes their study.
pub fn merge(shards: &[(String, String)]) -> Result<Merged, MergeFailure> {
    let (Contents { head, known, .. }, paths) = join(shards).map_err(MergeFailure::Shards)?;
    let control = &StudyControl::with_journal(Journal::of_known(known));
    let changed = paths.into_iter().find(|path| has_changed(path, &head.text));
    let file_has_changed = changed.is_some();
    let source = PlanSource { path: changed.unwrap_or(head.plan), text: head.text };
    let mut case = Case::parse(source).map_err(|mistakes| MergeFailure::Shards(mistakes.first()))?;
    case.file_has_changed = file_has_changed;
    let context = |case, sampling| Context::new(case, head.compute, control).with_sampling(sampling);
    let answer = match head.question {
        Question::Orders { intervals_s, option, sampling } => {
            case.set_hole_timing_of(option.as_deref());
            MergedResult::Orders(orders(&context(&case, sampling), &intervals_s)?)
        }
        Question::Risk { sampling } => {
            MergedResult::Risk(sampling, context(&case, Some(sampling)).sample_options()?)
        }
        Question::Search { sampling } => MergedResult::Search(Box::new(search(&context(&case, sampling))?)),
        Question::Sweep { .. } | Question::Size { .. } => {
            let message =
                "only `orders`, `risk` and `search` have shards: run the command itself, with --save";
            return Err(MergeFailure::Shards(message.to_owned()));
        }
    };
    Ok(Merged { case, answer })
}

/// Whether the file of this path is there and does not hold this text. A plan of standard input has no file.
fn has_changed(path: &str, text: &str) -> bool {
    let file = Path::new(path);
    path != "-" && file.is_file() && !PlanSource::read(file).is_ok_and(|now| now.text == text)
}

/// The results of all shards, given as `(name, text)`, and the paths of their plans; says what is wrong with them.
fn join(shards: &[(String, String)]) -> Result<(Contents, Vec<String>), String> {
    let mut contents_by_name = Vec::new();
    for (name, text) in shards {
        let contents = results_file::read(name, text)?;
        if !contents.is_complete {
            return Err(format!("{name} is not complete: run its command again, which goes on from there"));
        }
        contents_by_name.push((name, contents));
    }
    let (first_name, Contents { head: first, .. }) = contents_by_name.first().ok_or("no shard to merge")?;
    for (name, Contents { head, .. }) in &contents_by_name {
        if let Some(difference) = head.difference_of_study(first) {
            return Err(format!("{name}: a shard of another study than {first_name}: {difference}"));
        }
    }
    let count = first.shard.count;
    for index in 0..count {
        let which = format!("shard {}/{count}", index + 1);
        match contents_by_name.iter().filter(|(_, contents)| contents.head.shard.index == index).count() {
            0 => return Err(format!("{which} is missing")),
            1 => {}
            _ => return Err(format!("{which} is there twice")),
        }
    }
    let paths = contents_by_name.iter().map(|(_, contents)| contents.head.plan.clone()).unique().collect();
    let mut contents = contents_by_name.into_iter().map(|(_, contents)| contents);
    let first = contents.next().ok_or("no shard to merge")?;
    let joined = contents.fold(first, |mut joined, next| {
        joined.known.extend(next.known);
        joined
    });
    Ok((joined, paths))
}
