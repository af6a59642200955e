//! Schema `shelter.effects/1`.

use serde::Serialize;

use crate::study::effects::{EffectOnOption, EffectsOnOptions};
use crate::study::{Case, Computed};
use crate::verdict::{Quantity, Verdict};

/// The document of all effects.
#[derive(Serialize)]
pub struct EffectsDocument {
    schema: &'static str,
    plan: String,
    title: String,
    /// What verdicts are about: the limits on the shot as planned.
    judged: &'static str,
    partial: bool,
    options: Vec<OptionEffects>,
}

#[derive(Serialize)]
struct OptionEffects {
    name: String,
    /// Null where the time was up.
    effects: Option<Vec<EffectResult>>,
}

/// Changes are relative; null where a run failed, or where there was nothing before. Verdicts are those of the limits on the shot
/// as planned.
#[derive(Serialize)]
struct EffectResult {
    name: &'static str,
    value: f64,
    unit: &'static str,
    flight_height_change: Option<f64>,
    cable_force_change: Option<f64>,
    drift_change: Option<f64>,
    verdict: Verdict,
    verdict_without: Verdict,
    required: bool,
    source: &'static str,
    cost: f64,
}

impl EffectResult {
    fn of(row: &EffectOnOption) -> Self {
        let finite = |change: f64| Some(change).filter(|change| change.is_finite());
        let key = row.effect.key();
        Self {
            name: key.name,
            value: row.value,
            unit: key.kind.unit(),
            flight_height_change: finite(row.change(Quantity::Height)),
            cable_force_change: finite(row.change(Quantity::Force)),
            drift_change: finite(row.change(Quantity::Drift)),
            verdict: row.verdict_with,
            verdict_without: row.verdict_without,
            required: row.is_required(),
            source: if row.assumed { "assumed" } else { "plan" },
            cost: row.cost,
        }
    }
}

impl EffectsDocument {
    /// The document of all effects, which is partial where the time was up.
    pub fn new(case: &Case, Computed { value: effects, partial }: &Computed<EffectsOnOptions>) -> Self {
        let options = case.plan.delays.iter().zip(effects).map(|(delay, all)| OptionEffects {
            name: delay.name.clone(),
            effects: all.as_ref().map(|all| all.iter().map(EffectResult::of).collect()),
        });
        Self {
            schema: "shelter.effects/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            judged: "nominal",
            partial: *partial,
            options: options.collect(),
        }
    }
}
