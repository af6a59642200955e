//! Input of every study: the plan made ready, how it is sampled and computed, and how it is stopped.

use super::samples::sample_count::Sampling;
use super::{Case, ComputeSettings, StudyControl};

/// Input of every study.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The plan made ready.
    pub case: &'a Case,
    /// Samples behind a verdict; `None` if only the planned shots count.
    pub sampling: Option<Sampling>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
    /// Progress, journal and end of the study.
    pub control: &'a StudyControl,
}

impl<'a> Context<'a> {
    /// The context of a study of planned shots alone.
    pub fn new(case: &'a Case, compute: ComputeSettings, control: &'a StudyControl) -> Self {
        Self { case, sampling: None, compute, control }
    }

    /// The same context, with these samples behind a verdict.
    pub fn with_sampling(self, sampling: impl Into<Option<Sampling>>) -> Self {
        Self { sampling: sampling.into(), ..self }
    }

    /// The same context for another case, whose plan the study has changed.
    pub fn with_case<'b>(&self, case: &'b Case) -> Context<'b>
    where
        'a: 'b,
    {
        Context { case, ..*self }
    }
}
