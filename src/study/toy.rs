//! How many holes each option fires.

use serde::{Deserialize, Serialize};

use super::settings::{Study, Subject};
use super::{Case, ComputeResult, Computed, Context};

/// How many holes each option fires.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {}

impl Study for Question {
    type Found = Vec<usize>;

    fn usual(_case: &Case, _about: Subject) -> Self {
        Self {}
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Vec<usize>> {
        Ok(Computed::complete(context.case.shots.iter().map(|shot| shot.firings.len()).collect()))
    }
}
