//! Schema `shelter.size/1`.

use serde::Serialize;

use super::Values;
use crate::report::check::judged_inputs;
use crate::report::size::nearest;
use crate::study::Case;
use crate::study::size::{Combination, Sizing, Untried, WorstShotRisk};
use crate::verdict::Verdict;

/// The document of all combinations.
#[derive(Serialize)]
pub struct SizeDocument {
    schema: &'static str,
    plan: String,
    title: String,
    verdict: &'static str,
    judged: &'static str,
    found: bool,
    #[serde(flatten)]
    lightest: Option<CombinationResult>,
    tried: usize,
    not_tried: usize,
    /// Combinations that hold as planned, but whose risk does not pass.
    fragile: usize,
    partial: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest: Option<CombinationResult>,
    frontier: Vec<CombinationResult>,
}

#[derive(Serialize)]
struct CombinationResult {
    rope: String,
    tire_mass_kg: f64,
    border_rows: usize,
    tires: usize,
    total_mass_kg: f64,
    /// Utilization; scripts know the key by this name.
    use_of_limits: Option<f64>,
    worst: Option<Values>,
    risk: Option<RiskResult>,
}

/// Samples of the hardest shots.
#[derive(Serialize)]
struct RiskResult {
    verdict: Verdict,
    samples: usize,
    failures: usize,
}

impl CombinationResult {
    fn of(combination: &Combination) -> Self {
        let Combination { rope, tire_mass, border_rows, tires, total_mass, trial } = combination;
        Self {
            rope: rope.name.clone(),
            tire_mass_kg: *tire_mass,
            border_rows: *border_rows,
            tires: *tires,
            total_mass_kg: *total_mass,
            use_of_limits: trial.ok().map(|trial| trial.utilization),
            worst: trial.ok().map(|trial| Values::of(trial.worst.verdict, &trial.worst)),
            risk: trial.ok().and_then(|trial| trial.risk).map(
                |WorstShotRisk { verdict, samples, failures, .. }| RiskResult { verdict, samples, failures },
            ),
        }
    }
}

impl SizeDocument {
    /// The document of all combinations.
    pub fn new(case: &Case, sizing: &Sizing) -> Self {
        let chosen = sizing.lightest_choice();
        let nearest = if chosen.is_none() { nearest(sizing) } else { None };
        Self {
            schema: "shelter.size/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            verdict: sizing.verdict().for_scripts(),
            judged: judged_inputs(case, sizing.is_sampled()),
            found: chosen.is_some(),
            lightest: chosen.map(CombinationResult::of),
            tried: sizing.count_tried(),
            not_tried: sizing.combinations.len() - sizing.count_tried(),
            fragile: sizing.count_with_risk(Verdict::Fail) + sizing.count_with_risk(Verdict::Undecided),
            partial: sizing.count_untried(Untried::OutOfTime) > 0,
            nearest: nearest.map(|(combination, _)| CombinationResult::of(combination)),
            frontier: sizing.choices().map(CombinationResult::of).collect(),
        }
    }
}
