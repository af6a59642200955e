//! What a user can ask, and what is found: one list of questions for the command line, the terminal, `--save`, shards and `merge`.
//!
//! A question is the settings of one study. Its answer is plain data. A report puts the answer into words.

use serde::{Deserialize, Serialize};

use super::samples::sample_count::Sampling;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, ComputeSettings, Computed, Context, NoResult, Shard, StudyControl};

/// Gives the list of all questions to a macro: the name of each, its settings, and the functions in its file in `report` that put
/// its answer into words: in full, and, if it is [listed](super::study_trait::Listed), in one line.
macro_rules! with_questions {
    ($callback:ident) => {
        $callback! {
            /// Pass or fail of every option.
            Check(check::Question, {report}),
            /// Height, force and risk over the interval.
            Sweep(sweep::Question, {report, in_brief}),
            /// Every order: the worst, and the best.
            Orders(orders::Question, {report, in_brief}),
            /// Samples of every option.
            Risk(risk::Question, {report, in_brief}),
            /// The schedules with the least risk.
            Search(search::Question, {report, in_brief}),
            /// The lightest shelter that holds.
            Size(size::Question, {report, in_brief}),
            /// Which effects the scene requires.
            Effects(effects::Question, {report, in_brief}),
            /// Launch velocities and other unknowns from observations of earlier shots.
            Fit(fit::Question, {report, in_brief}),
            /// What the pass of one option stands on.
            Assumptions(assumptions::Question, {report_of_one, in_brief}),
            /// What the passing options stand on.
            AssumptionsOfPassing(assumptions::OfPassing, {report}),
            /// The motion of one option.
            Flight(flight::Question, {report}),
            /// The cost of accuracy, measured on one option.
            Accuracy(accuracy::Question, {report}),
            /// The changes of the plan with which one option would pass.
            Remedies(remedies::Question, {report}),
        }
    };
}
pub(crate) use with_questions;

macro_rules! declare_questions {
    ($( $(#[$about:meta])* $Name:ident($study:ident::$Question:ident, {$report:ident $(, $brief:ident)?}), )+) => {
        /// What a user can ask.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(tag = "study", rename_all = "snake_case")]
        pub enum Question {
            $( $(#[$about])* $Name(super::$study::$Question), )+
        }

        /// What was found.
        #[derive(Clone, Debug)]
        pub enum Found {
            $( $(#[$about])* $Name(Box<Computed<<super::$study::$Question as Study>::Found>>), )+
        }

        /// Kind of a question.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum StudyKind {
            $( $(#[$about])* $Name, )+
        }

        impl StudyKind {
            /// Every kind, in the order of declaration.
            pub const ALL: [StudyKind; [$(StudyKind::$Name),+].len()] = [$(StudyKind::$Name),+];

            /// Its entry in the list of questions; `None` if another screen asks it.
            pub fn listed(self) -> Option<Listed> {
                match self { $( Self::$Name => <super::$study::$Question as Study>::LISTED, )+ }
            }

            /// Expected number of runs of the usual question.
            pub fn expected_runs(self, case: &Case) -> Option<usize> {
                match self { $( Self::$Name => <super::$study::$Question as Study>::expected_runs(case), )+ }
            }
        }

        impl Asked {
            /// The question of a kind with the usual settings.
            pub fn usual(kind: StudyKind, case: &Case, about: Subject, compute: ComputeSettings) -> Self {
                let (question, sampling) = match kind {
                    $( StudyKind::$Name => (
                        Question::$Name(Study::usual(case, about)),
                        <super::$study::$Question as Study>::SAMPLING,
                    ), )+
                };
                Self { question, sampling: Some(sampling), compute }
            }
        }

        impl Question {
            /// Whether several machines can compute a shard each.
            pub fn is_shared(&self) -> bool {
                match self { $( Self::$Name(_) => <super::$study::$Question as Study>::IS_SHARED, )+ }
            }

            fn answer(&self, context: &Context<'_>) -> Result<Found, NoResult> {
                Ok(match self {
                    $( Self::$Name(question) => Found::$Name(Box::new(question.answer(context)?)), )+
                })
            }

            fn answer_shard(&self, context: &Context<'_>, shard: Shard) -> ComputeResult<()> {
                match self { $( Self::$Name(question) => question.answer_shard(context, shard), )+ }
            }
        }

        impl Found {
            /// Whether the time was up before everything was computed.
            pub fn is_partial(&self) -> bool {
                match self { $( Self::$Name(found) => found.partial, )+ }
            }
        }
    };
}
with_questions!(declare_questions);

impl StudyKind {
    /// The kinds in the list of questions, in the order of the list.
    pub fn tabs() -> Vec<Self> {
        Self::ALL.into_iter().filter(|kind| kind.listed().is_some()).collect()
    }
}

/// A question with the settings of its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// The question.
    pub question: Question,
    /// Samples behind a verdict; `None` if only the planned shots were requested.
    pub sampling: Option<Sampling>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
}

impl Asked {
    /// The context for its answer.
    pub fn context<'a>(&self, case: &'a Case, control: &'a StudyControl) -> Context<'a> {
        Context::new(case, self.compute, control).with_sampling(self.sampling)
    }

    /// Whether the user fixed the step of sampled shots. A pass at such a step is no permission to fire.
    pub fn is_step_fixed(&self) -> bool {
        self.sampling.is_some() && self.compute.step.is_some()
    }

    /// Answers the question.
    pub fn answer(&self, case: &Case, control: &StudyControl) -> Result<Found, NoResult> {
        self.question.answer(&self.context(case, control))
    }

    /// Computes one machine's shard of the answer, for the journal.
    pub fn answer_shard(&self, case: &Case, control: &StudyControl, shard: Shard) -> ComputeResult<()> {
        self.question.answer_shard(&self.context(case, control), shard)
    }
}
