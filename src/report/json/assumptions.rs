//! Schema `shelter.assumptions/1`.

use serde::Serialize;

use crate::study::assumptions::{Assumption, OptionAssumptions};
use crate::study::judgement::Judgement;
use crate::study::{Case, Computed};
use crate::verdict::Verdict;

/// The document of all options asked for.
#[derive(Serialize)]
pub struct AssumptionsDocument {
    schema: &'static str,
    plan: String,
    title: String,
    partial: bool,
    options: Vec<OptionDocument>,
}

#[derive(Serialize)]
struct OptionDocument {
    name: String,
    verdict: Verdict,
    /// The nearest first; null where the option does not pass, or the time was up before.
    assumptions: Option<Vec<AssumptionResult>>,
}

#[derive(Serialize)]
struct AssumptionResult {
    name: String,
    value: f64,
    unit: &'static str,
    passes_until: Option<f64>,
    fails_from: Option<f64>,
    /// Samples of each value.
    samples: usize,
}

impl AssumptionResult {
    fn new(found: &Assumption, samples: usize) -> Self {
        let Assumption { assumed, stated, passes_until, fails_from, .. } = *found;
        Self { name: assumed.name(), value: stated, unit: assumed.unit(), passes_until, fails_from, samples }
    }
}

impl AssumptionsDocument {
    /// The document of the options asked for, which is partial where the time was up.
    pub fn new(case: &Case, Computed { value: all, partial }: &Computed<Vec<OptionAssumptions>>) -> Self {
        let option = |of_option: &OptionAssumptions| OptionDocument {
            name: case.plan.delays[of_option.option].name.clone(),
            verdict: of_option.judged.as_ref().map_or(Verdict::Undecided, Judgement::verdict),
            assumptions: of_option
                .assumptions
                .as_ref()
                .map(|found| found.all.iter().map(|one| AssumptionResult::new(one, found.samples)).collect()),
        };
        Self {
            schema: "shelter.assumptions/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            partial: *partial,
            options: all.iter().map(option).collect(),
        }
    }
}
