//! A study that several machines computed, a shard each: joined, and completed by what only all shards together tell.

mod shard_file;

pub use self::shard_file::{Head, Question, ShardResults, write_shard};
use super::judge_options::{OptionResults, judge_from_samples};
use super::orders::{Orders, rank, refine};
use super::samples::sampling::Sampling;
use super::search::{Search, search_after};
use super::{Case, NoResult, Progress};
use crate::plan::PlanSource;

/// A study whose shards are joined.
#[derive(Clone, Debug)]
pub struct Merged {
    /// The plan that all shards hold.
    pub case: Case,
    /// What the study found.
    pub answer: Answer,
}

/// What a study that was shared found.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Of `orders`.
    Orders(Orders),
    /// Of `risk`, with its samples.
    Risk(Sampling, OptionResults),
    /// Of `search`.
    Search(Box<Search>),
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
pub fn merge(shards: &[(String, String)], progress: &Progress) -> Result<Merged, MergeFailure> {
    let (head, results) = shard_file::join(shards).map_err(MergeFailure::Shards)?;
    let source = PlanSource { path: head.plan.clone(), text: head.text.clone() };
    let case = Case::parse(source).map_err(|mistakes| MergeFailure::Shards(mistakes.to_string()))?;
    if !results.belong_to(&case) {
        let reason = "the shards hold results that do not belong to their plan: one shard is damaged";
        return Err(MergeFailure::Shards(reason.to_owned()));
    }
    let compute = &head.compute;
    let answer = match (head.question, results) {
        // Only all shards together tell which orders may be the worst.
        (Question::Orders { intervals_s, sampling }, ShardResults::Orders(tried)) => {
            let tried = refine(&case, tried, compute, progress)?;
            let ranked = rank(&case, tried, intervals_s.len(), sampling.as_ref(), compute, progress)?;
            Answer::Orders(ranked.value)
        }
        (Question::Risk { sampling }, ShardResults::Risk(samples)) => {
            let results = judge_from_samples(&case, compute, &sampling, &samples, progress)?;
            Answer::Risk(sampling, results)
        }
        (Question::Search { sampling }, ShardResults::Search(tried)) => {
            let found = search_after(&case, &tried, sampling.as_ref(), compute, progress)?;
            Answer::Search(Box::new(found.value))
        }
        _ => return Err(MergeFailure::Shards("the shards do not fit together".to_owned())),
    };
    Ok(Merged { case, answer })
}
