//! How likely each option fails, by its planned shot and its samples. Nothing is recommended, and nothing is confirmed.

use serde::{Deserialize, Serialize};

use super::judge::OptionResults;
use super::judge::one_dud::expected_dud_samples;
use super::samples::run_sample::ShotToSample;
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::run_shard;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, Shard};

/// Samples of every option.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {}

/// The risks of all options.
#[derive(Clone, Debug)]
pub struct Risks {
    /// Number of samples and seed.
    pub sampling: Sampling,
    /// The options with their samples.
    pub results: OptionResults,
}

impl Question {
    /// The sampling of a risk; [`Sampling::OF_RISK`] if none was requested.
    fn sampling(context: &Context<'_>) -> Sampling {
        context.sampling.unwrap_or(Sampling::OF_RISK)
    }
}

impl Study for Question {
    type Found = Risks;
    const IS_SHARED: bool = true;
    const SAMPLING: Sampling = Sampling::OF_RISK;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Risk",
        question: "How likely?",
        about: "How likely does each option fail when the unknowns vary? 2000 samples each.",
        tells: "how many shots fail, and which input decides it",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        let most = Sampling::OF_RISK.most;
        Some(case.shots.iter().map(|shot| most + expected_dud_samples(case, shot)).sum())
    }

    fn usual(_case: &Case, _about: Subject) -> Self {
        Self {}
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Risks> {
        let sampling = Self::sampling(context);
        let Computed { value: results, partial } = context.with_sampling(sampling).sample_options()?;
        Ok(Computed { value: Risks { sampling, results }, partial })
    }

    fn answer_shard(&self, context: &Context<'_>, shard: Shard) -> ComputeResult<()> {
        let &Context { case, compute, control, .. } = context;
        let target = |shot| ShotToSample::new(case, shot, compute, Self::sampling(context));
        let targets: Vec<_> = case.shots.iter().map(target).collect();
        let drawn = run_shard(&targets, shard, control)?;
        Ok(Computed { value: (), partial: drawn.iter().any(|(_, sample)| sample.is_none()) })
    }
}
