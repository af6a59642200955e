//! The question of `check`: does every option pass? For options that do not, it finds the changes with which they would pass.

use serde::{Deserialize, Serialize};

use super::judge::OptionResults;
use super::judge::batch::{Depth, judge};
use super::judge::recommend::MustPass;
use super::remedies::{Remedies, find_all_remedies, not_passing};
use super::study_trait::{Study, Subject};
use super::{Case, ComputeResult, Computed, Context};

/// The question: does every option pass?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Which options must pass.
    pub must_pass: MustPass,
    /// Whether to search the changes with which options would pass that do not pass now.
    pub why: bool,
}

/// The results of one plan.
#[derive(Clone, Debug)]
pub struct JudgedPlan {
    /// The results of its options.
    pub results: OptionResults,
    /// Which of them must pass.
    pub must_pass: MustPass,
    /// The changes that were tried for options that do not pass; `None` if they were not requested.
    pub remedies: Option<Vec<Remedies>>,
}

/// Share of the progress that the verdicts take if changes are searched, too.
const SHARE_OF_JUDGEMENT: f64 = 0.2;

impl Study for Question {
    type Found = JudgedPlan;

    fn usual(_case: &Case, _about: Subject) -> Self {
        Self::OF_VERDICT
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<JudgedPlan> {
        let Computed { mut value, partial } = self.answer_of_all(&[*context])?;
        Ok(Computed { value: value.remove(0), partial })
    }
}

impl Question {
    /// Every option must pass, and no changes are looked for.
    pub const OF_VERDICT: Self = Self { must_pass: MustPass::Every, why: false };

    /// Judges all options of several plans in parallel. The results are in the order of plans and options.
    pub fn answer_of_all(&self, contexts: &[Context<'_>]) -> ComputeResult<Vec<JudgedPlan>> {
        let Some(&Context { control, .. }) = contexts.first() else {
            return Ok(Computed::complete(Vec::new()));
        };
        if self.why {
            control.has_steps(2);
        }
        let judging = control.part(if self.why { SHARE_OF_JUDGEMENT } else { 1.0 });
        let Computed { value: results, mut partial } = judge(contexts, Depth::Full, None)?;
        drop(judging);
        let _finding = control.part(1.0);
        let mut judged = Vec::new();
        for (n, (results, context)) in results.into_iter().zip(contexts).enumerate() {
            let mut remedies = None;
            if self.why {
                let _plan = control.part(1.0 / (contexts.len() - n) as f64);
                let found = find_all_remedies(context, &not_passing(&results))?;
                partial |= found.partial;
                remedies = Some(found.value);
            }
            judged.push(JudgedPlan { results, must_pass: self.must_pass, remedies });
        }
        Ok(Computed { value: judged, partial })
    }
}
