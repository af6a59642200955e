//! Joins a study that several machines computed, a shard each, and completes it with what only all shards together show.
//!
//! The study is computed as on one machine, but takes from the shards what they hold, also the text of the plan. If the file of the
//! plan has another text by now, `Merged::file` says so.

use std::path::Path;

use itertools::Itertools;

use super::question::{Asked, Found};
use super::results_file::{self, Contents, Head};
use super::{Case, FileState, Journal, NoResult, StudyControl};
use crate::plan::PlanSource;

/// A study whose shards are joined.
#[derive(Clone, Debug)]
pub struct Merged {
    /// The plan that all shards hold, as the question takes it.
    pub case: Case,
    /// State of the file of the plan.
    pub file: FileState,
    /// The question.
    pub asked: Asked,
    /// What the study found.
    pub found: Found,
    /// Paths of the plan that the shards name.
    pub paths: Vec<String>,
}

/// Why shards cannot be merged.
#[derive(Clone, Debug, PartialEq)]
pub enum MergeFailure {
    /// What is wrong with the shards.
    Shards(String),
    /// The rest of the study has no result.
    NoResult(NoResult),
}

impl From<NoResult> for MergeFailure {
    fn from(reason: NoResult) -> Self {
        Self::NoResult(reason)
    }
}

/// Joins shards, given as `(name, text)`, and completes their study.
pub fn merge(shards: &[(String, String)]) -> Result<Merged, MergeFailure> {
    let (Contents { head: Head { asked, plan, text, .. }, known, .. }, paths) =
        join(shards).map_err(MergeFailure::Shards)?;
    if !asked.question.is_shared() {
        let message = "only `orders`, `risk` and `search` have shards: run the command itself, with --save";
        return Err(MergeFailure::Shards(message.to_owned()));
    }
    let path = file_now(&paths, &text).1;
    let case = Case::parse(PlanSource { path: path.unwrap_or(plan).into(), text });
    let case = case.map_err(|mistakes| MergeFailure::Shards(mistakes.first()))?;
    let found = asked.answer(&case, &StudyControl::with_journal(Journal::of_known(known)))?;
    // The file may change while the rest is computed.
    let file = file_now(&paths, &case.source.text).0;
    Ok(Merged { case, file, asked, found, paths })
}

/// State of the file of a plan with this text, and the path of a file that has another text by now. `paths` are the paths that the
/// shards name, from several machines.
fn file_now(paths: &[String], text: &str) -> (FileState, Option<String>) {
    let states: Vec<_> = paths.iter().map(|path| FileState::of(Path::new(path), text)).collect();
    let mut found = [FileState::Changed, FileState::AsJudged, FileState::Pipe].into_iter();
    let found = found.find(|state| states.contains(state)).unwrap_or(FileState::Gone);
    let changed = states.iter().position(|state| *state == FileState::Changed);
    (found, changed.map(|n| paths[n].clone()))
}

/// Joins all shards, given as `(name, text)`. Returns their results and the paths of their plans, or what is wrong with the shards.
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
