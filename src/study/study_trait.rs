//! What every question of a user has in common: its settings, which answer it.

use super::samples::sample_count::Sampling;
use super::trace::DrawnSample;
use super::{Case, ComputeResult, Context, NoResult, Shard};
use crate::plan::HoleTiming;
use crate::plan::observations::Observations;

/// How a question stands in the list of all that can be asked.
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    /// Name of the study.
    pub name: &'static str,
    /// The question.
    pub question: &'static str,
    /// The question, and what is computed.
    pub about: &'static str,
    /// What its answer tells, in few words.
    pub tells: &'static str,
}

/// The settings of a question, which answer it.
pub trait Study: Sized {
    /// What is found.
    type Found;
    /// Whether several machines can compute a shard each.
    const IS_SHARED: bool = false;
    /// Samples where nobody asks for others.
    const SAMPLING: Sampling = Sampling::OF_VERDICT;

    /// How it stands in the list of questions; `None` where another screen asks it.
    const LISTED: Option<Listed> = None;

    /// Runs that the usual question is expected to take; `None` where nobody asks for them, or there is no answer.
    fn expected_runs(_case: &Case) -> Option<usize> {
        None
    }

    /// The question where nobody asks for other settings, about a subject.
    fn usual(case: &Case, about: Subject) -> Self;

    /// Answers the question.
    fn answer(&self, context: &Context<'_>) -> ComputeResult<Self::Found>;

    /// Computes one machine's shard, for the journal, of a question that [is shared](Self::IS_SHARED).
    fn answer_shard(&self, _context: &Context<'_>, _shard: Shard) -> ComputeResult<()> {
        Err(NoResult::NotShared("this question has no shards".to_owned()))
    }
}

/// What a question is about, beside the plan.
#[derive(Clone, Debug, Default)]
pub struct Subject {
    /// Index of the option, for a question of one option.
    pub option: usize,
    /// The sample to be seen; `None` for the shot as planned.
    pub sample: Option<DrawnSample>,
    /// What was seen of earlier shots.
    pub observed: Vec<Observations>,
}

impl Subject {
    /// An option as planned.
    pub fn option(option: usize) -> Self {
        Self { option, ..Self::default() }
    }

    /// How the holes of a row fire where order or interval vary: as in all options, or where these differ as in the one that is meant.
    pub(in crate::study) fn holes_of(&self, case: &Case) -> Option<HoleTiming> {
        case.plan.shared_hole_timing().or_else(|| case.plan.hole_timing_of(Some(self.option)))
    }
}
