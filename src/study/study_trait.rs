//! What all questions of a user have in common: settings that lead to an answer.

use super::samples::sample_count::Sampling;
use super::trace::DrawnSample;
use super::{Case, ComputeResult, Context, NoResult, Shard};
use crate::plan::HoleTiming;
use crate::plan::observations::Observations;

/// Entry of a question in the list of all questions.
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    /// Name of the study.
    pub name: &'static str,
    /// The question.
    pub question: &'static str,
    /// The question, and what is computed.
    pub about: &'static str,
    /// What its answer says, in few words.
    pub tells: &'static str,
}

/// The settings of a question, which lead to its answer.
pub trait Study: Sized {
    /// What is found.
    type Found;
    /// Whether several machines can compute a shard each.
    const IS_SHARED: bool = false;
    /// Samples unless the user asks for others.
    const SAMPLING: Sampling = Sampling::OF_VERDICT;

    /// Its entry in the list of questions; `None` if another screen asks it.
    const LISTED: Option<Listed> = None;

    /// Expected number of runs of the usual question; `None` if nobody needs that number, or there is no answer.
    fn expected_runs(_case: &Case) -> Option<usize> {
        None
    }

    /// The question about a subject, with the usual settings.
    fn usual(case: &Case, about: Subject) -> Self;

    /// Answers the question.
    fn answer(&self, context: &Context<'_>) -> ComputeResult<Self::Found>;

    /// Computes one machine's shard for the journal, if the question [is shared](Self::IS_SHARED).
    fn answer_shard(&self, _context: &Context<'_>, _shard: Shard) -> ComputeResult<()> {
        Err(NoResult::NotShared("this question has no shards".to_owned()))
    }
}

/// Subject of a question, besides the plan.
#[derive(Clone, Debug, Default)]
pub struct Subject {
    /// Index of the option, for a question of one option.
    pub option: usize,
    /// The sample to show; `None` for the planned shot.
    pub sample: Option<DrawnSample>,
    /// Observations of earlier shots.
    pub observed: Vec<Observations>,
}

impl Subject {
    /// The planned shot of an option.
    pub fn option(option: usize) -> Self {
        Self { option, ..Self::default() }
    }

    /// How the holes of a row fire if order or interval vary: as in all options, or, if the options differ, as in the option of
    /// this subject.
    pub(in crate::study) fn holes_of(&self, case: &Case) -> Option<HoleTiming> {
        case.plan.shared_hole_timing().or_else(|| case.plan.hole_timing_of(Some(self.option)))
    }
}
