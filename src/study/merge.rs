//! A study that several machines computed, a shard each: joined, and completed by what only all shards together tell.
//!
//! The study is computed as on one machine. What a shard holds is taken from there, the text of the plan, too: where the file of the
//! plan says something else by now, the case says so.

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
    /// What became of the file of the plan.
    pub file: FileState,
    /// The question.
    pub asked: Asked,
    /// What the study found.
    pub found: Found,
    /// The files of the plan that the shards name.
    pub paths: Vec<String>,
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
    // It may change while the rest is computed.
    let file = file_now(&paths, &case.source.text).0;
    Ok(Merged { case, file, asked, found, paths })
}

/// What became of the file of a plan with this text, of which the shards name these `paths`, those of several machines; the path of one
/// that says something else.
fn file_now(paths: &[String], text: &str) -> (FileState, Option<String>) {
    let states: Vec<_> = paths.iter().map(|path| FileState::of(Path::new(path), text)).collect();
    let mut found = [FileState::Changed, FileState::AsJudged, FileState::Pipe].into_iter();
    let found = found.find(|state| states.contains(state)).unwrap_or(FileState::Gone);
    let changed = states.iter().position(|state| *state == FileState::Changed);
    (found, changed.map(|n| paths[n].clone()))
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
