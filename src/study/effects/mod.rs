//! Which effects a scene requires. Each effect is switched on or taken away by itself.
//!
//! 1. An effect of the plan is compared with the plan without it. An effect that the plan lacks is probed at a stated value. Directed
//!    effects are probed along x and y, both ways, and the hardest direction counts.
//! 2. If a motion has several branches, differences between planned shots alone are noise. So medians over the first samples of
//!    `[uncertainty]` are compared. Both sides have the same draws, except for ballast, which renumbers the tires. If the first
//!    [`FIRST_SAMPLES`] leave no doubt, no more are drawn.
//! 3. An effect is required if it moves the planned shot to another side of the limits. It is also required if it changes the median of a
//!    quantity with a limit, or raises the 95th percentile. That change must be more than [`LEAST_RELATIVE_CHANGE`], and more than
//!    [`LEAST_SHARE_OF_LIMIT`] of the limit. If one of these values is unknown, the effect is required, too.

mod effect;
mod runs;

use std::cmp::Ordering;
use std::collections::BTreeSet;

pub use self::effect::Effect;
use serde::{Deserialize, Serialize};

use self::runs::{OptionRuns, is_in_doubt, measure_option, time_sample};
use super::samples::sample_count::Sampling;
use super::study_trait::{Listed, Study, Subject};
use super::work::batch::run_batch;
use super::{Case, ComputeResult, Computed, Context, catch_panic};
use crate::plan::Plan;
use crate::verdict::{Limits, PerQuantity, Quantity, Verdict};

/// Number of samples for a median, unless another number is asked for.
pub const SAMPLES: usize = 49;
/// Number of samples after which it is known which effects are in doubt.
pub const FIRST_SAMPLES: usize = 17;
/// Relative change of a median above which an effect is required.
pub const LEAST_RELATIVE_CHANGE: f64 = 0.05;
/// Change of a median over the limit below which the effect is not required. A few newtons more or less do not matter.
pub const LEAST_SHARE_OF_LIMIT: f64 = 0.01;

/// The result of an effect for one delay option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectOnOption {
    /// The effect.
    pub effect: Effect,
    /// Value of the effect, in the unit of its key.
    pub value: f64,
    /// Whether the value is a probe and not the plan's own.
    pub assumed: bool,
    /// Number of samples for the changes; 1 if only the planned shots count.
    pub samples: usize,
    /// Change of each quantity.
    pub changes: PerQuantity<QuantityChange>,
    /// Whether a plan without the effect states too low a value, or may do so, in any direction of the effect.
    pub is_missed_on_the_unsafe_side: bool,
    /// Side of the limits on which the planned shot lies without the effect.
    pub verdict_without: Verdict,
    /// Side of the limits on which the planned shot lies with the effect.
    pub verdict_with: Verdict,
    /// Computing time of a run with the effect over that without it.
    pub cost: f64,
}

impl EffectOnOption {
    fn new(variant: &Variant, without: &OptionRuns, with: &OptionRuns, limits: &Limits) -> Self {
        let count = without.runs.len().min(with.runs.len());
        let changes = PerQuantity::from_fn(|quantity| QuantityChange {
            without: without.spread(quantity, count),
            with: with.spread(quantity, count),
            limit: limits.get(quantity),
        });
        Self {
            effect: variant.effect,
            value: variant.value,
            assumed: variant.assumed,
            samples: count,
            is_missed_on_the_unsafe_side: with.verdict > without.verdict
                || changes.iter().any(QuantityChange::may_raise),
            changes,
            verdict_without: without.verdict,
            verdict_with: with.verdict,
            cost: with.median_time(count) / without.median_time(count),
        }
    }

    /// Relative change of the median of a quantity.
    pub fn change(&self, quantity: Quantity) -> f64 {
        self.changes.get(quantity).relative()
    }

    /// Whether the scene requires the effect for this option.
    pub fn is_required(&self) -> bool {
        self.verdict_changes() || self.changes.iter().any(QuantityChange::is_required)
    }

    /// Whether the effect moves the planned shot to another side of the limits.
    pub fn verdict_changes(&self) -> bool {
        self.verdict_without != self.verdict_with
    }

    /// How hard the effect is on the option, for comparison with another direction.
    fn severity(&self) -> (bool, Verdict, f64) {
        let used = |change: &QuantityChange| match change.relative().is_nan() {
            true => f64::INFINITY,
            false => change.limit.map_or(0.0, |limit| (change.with.median - change.without.median) / limit),
        };
        (
            self.is_required(),
            self.verdict_with,
            self.changes.iter().map(used).fold(f64::NEG_INFINITY, f64::max),
        )
    }
}

/// Median and 95th percentile of a quantity over the samples [SI unit]; infinite if a run failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

/// A quantity without an effect and with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantityChange {
    /// Without the effect.
    pub without: Spread,
    /// With the effect.
    pub with: Spread,
    /// Limit of the quantity, if it has one.
    pub limit: Option<f64>,
}

impl QuantityChange {
    /// The median with the effect over that without it, less one; NaN if one is unknown.
    pub fn relative(&self) -> f64 {
        relative(self.without.median, self.with.median)
    }

    /// Whether this quantity requires the effect.
    fn is_required(&self) -> bool {
        let Some(limit) = self.limit else { return false };
        let matters = |without: f64, with: f64| {
            let relative = relative(without, with);
            relative.is_nan()
                || relative.abs() > LEAST_RELATIVE_CHANGE
                    && (with - without).abs() > LEAST_SHARE_OF_LIMIT * limit
        };
        let rises = self.with.p95 > self.without.p95;
        matters(self.without.median, self.with.median) || rises && matters(self.without.p95, self.with.p95)
    }

    /// Whether the quantity has a limit, and is greater with the effect or may be.
    fn may_raise(&self) -> bool {
        let may_raise = |without: f64, with: f64| {
            let relative = relative(without, with);
            relative.is_nan() || relative > 0.0
        };
        self.limit.is_some()
            && (may_raise(self.without.median, self.with.median)
                || may_raise(self.without.p95, self.with.p95))
    }
}

/// `with` over `without`, less one; NaN if one is unknown.
fn relative(without: f64, with: f64) -> f64 {
    match without.is_finite() && with.is_finite() {
        true if without == with => 0.0,
        true => with / without - 1.0,
        false => f64::NAN,
    }
}

/// Effects on the requested delay options.
#[derive(Clone, Debug)]
pub struct EffectsOnOptions {
    /// Indices of the options.
    pub options: Vec<usize>,
    /// Effects on each option (`n_options`); `None` if the time was up.
    pub effects: Vec<Option<Vec<EffectOnOption>>>,
}

impl EffectsOnOptions {
    /// All effects found.
    pub fn all(&self) -> impl Iterator<Item = &EffectOnOption> {
        self.effects.iter().flatten().flatten()
    }
}

/// An effect to try. Its plans are given as indices of cases.
struct Variant {
    effect: Effect,
    value: f64,
    assumed: bool,
    without: usize,
    /// One case for each direction.
    with: Vec<usize>,
}

/// Index of the unchanged plan among the cases.
const AS_PLANNED: usize = 0;

/// Share of the first samples in the work. Effects in doubt get more samples.
const SHARE_OF_FIRST_SAMPLES: f64 = 0.5;

/// The effects that the scene requires.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Indices of the delay options.
    pub options: Vec<usize>,
}

/// Number of plans from all effects. Some effects have several directions.
const EFFECT_PLANS: usize = 16;

impl Study for Question {
    type Found = EffectsOnOptions;
    const SAMPLING: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_RISK.seed);
    const LISTED: Option<Listed> = Some(Listed {
        name: "Effects",
        question: "What else matters?",
        about: "Which effects does this scene require? Each switched on or taken away, by itself.",
        tells: "what the model may leave out, and what not",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        Some(case.shots.len() * EFFECT_PLANS * SAMPLES)
    }

    fn usual(case: &Case, _about: Subject) -> Self {
        Self { options: (0..case.shots.len()).collect() }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<EffectsOnOptions> {
        let chosen = context.case.with_options(&self.options);
        let Computed { value: effects, partial } = effects(&context.with_case(&chosen))?;
        Ok(Computed { value: EffectsOnOptions { options: self.options.clone(), effects }, partial })
    }
}

/// Switches every effect on and off for every delay option. Without a `sampling` only the planned shots count.
pub fn effects(context: &Context<'_>) -> ComputeResult<Vec<Option<Vec<EffectOnOption>>>> {
    let &Context { case, compute, control, sampling, .. } = context;
    let mut cases = vec![case.clone()];
    let computed = Effect::ALL.into_iter().filter(|effect| effect.is_computed_by(compute.method));
    let variants: Vec<Variant> =
        computed.filter_map(|effect| variant(effect, &case.plan, &mut cases)).collect();
    let jobs: Vec<(usize, usize)> = itertools::iproduct!(0..case.shots.len(), 0..cases.len()).collect();
    control.has_steps(if sampling.is_some() { 2 } else { 1 });
    let first = control.part(if sampling.is_some() { SHARE_OF_FIRST_SAMPLES } else { 1.0 });
    let mut measured = run_batch(&jobs, control, |&(option, n)| {
        catch_panic(|| measure_option(&context.with_case(&cases[n]), option))
    })?;
    drop(first);
    let _more = control.part(1.0);
    if let Some(sampling) = sampling {
        let in_doubt = jobs_in_doubt(&measured, &variants, cases.len(), &case.limits);
        let more: Vec<(usize, usize)> =
            itertools::iproduct!(in_doubt, FIRST_SAMPLES..sampling.most.max(FIRST_SAMPLES)).collect();
        let drawn = run_batch(&more, control, |&(job, number)| {
            let (option, n) = jobs[job];
            catch_panic(|| time_sample(&context.with_case(&cases[n]), option, number, &sampling))
        })?;
        for ((job, _), drawn) in more.into_iter().zip(drawn) {
            measured[job] = measured[job].take().zip(drawn).map(|(mut option, drawn)| {
                option.runs.push(drawn);
                option
            });
        }
    }
    let partial = measured.iter().any(Option::is_none);
    let on_option = |measured: &[Option<OptionRuns>]| -> Option<Vec<EffectOnOption>> {
        let runs: Vec<&OptionRuns> = measured.iter().map(Option::as_ref).collect::<Option<_>>()?;
        variants.iter().map(|variant| hardest(variant, &runs, &case.limits)).collect()
    };
    let effects = measured.chunks(cases.len()).map(on_option).collect();
    Ok(Computed { value: effects, partial })
}

/// Indices in `measured` (`n_options` × `n_cases`) of the plans with effects in doubt, ascending.
fn jobs_in_doubt(
    measured: &[Option<OptionRuns>],
    variants: &[Variant],
    n_cases: usize,
    limits: &Limits,
) -> Vec<usize> {
    let mut in_doubt = BTreeSet::new();
    for (first, variant) in itertools::iproduct!((0..measured.len()).step_by(n_cases), variants) {
        for &with in &variant.with {
            let pair = [first + variant.without, first + with];
            if let [Some(without), Some(with)] = pair.map(|job| measured[job].as_ref())
                && is_in_doubt(without, with, limits)
            {
                in_doubt.extend(pair);
            }
        }
    }
    in_doubt.into_iter().collect()
}

/// The plans with and without an effect, added to `cases`; `None` if there is nothing to try.
fn variant(effect: Effect, plan: &Plan, cases: &mut Vec<Case>) -> Option<Variant> {
    let mut add = |value, toward| {
        cases.push(Case::new(effect.plan_with(plan, value, toward)));
        cases.len() - 1
    };
    match (effect.value_in(plan), effect.probe_value(plan)) {
        (Some(value), _) => {
            let (without, with) = (add(None, 0.0), vec![AS_PLANNED]);
            Some(Variant { effect, value, assumed: false, without, with })
        }
        (None, Some(value)) => {
            let with = effect.directions().iter().map(|&toward| add(Some(value), toward)).collect();
            Some(Variant { effect, value, assumed: true, without: AS_PLANNED, with })
        }
        (None, None) => None,
    }
}

/// The effect in its hardest direction. `runs` are the runs of each case.
fn hardest(variant: &Variant, runs: &[&OptionRuns], limits: &Limits) -> Option<EffectOnOption> {
    let all =
        variant.with.iter().map(|&n| EffectOnOption::new(variant, runs[variant.without], runs[n], limits));
    let is_missed_on_the_unsafe_side = all.clone().any(|row| row.is_missed_on_the_unsafe_side);
    let hardest = all.max_by(|a, b| a.severity().partial_cmp(&b.severity()).unwrap_or(Ordering::Equal));
    Some(EffectOnOption { is_missed_on_the_unsafe_side, ..hardest? })
}
