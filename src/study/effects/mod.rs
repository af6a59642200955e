//! Which effects a scene requires: each switched on, or taken away, by itself.
//!
//! 1. An effect of the plan is compared with the plan without it; one that the plan lacks is probed at a stated value. Directed
//!    effects are probed along x and y, both ways, and the hardest direction counts.
//! 2. Nominal differences alone are noise where a motion has several branches. So medians are compared, over the first samples of
//!    `[uncertainty]`, with the same draws on both sides.
//! 3. An effect is required where it changes on which side of the limits the shot as planned lies; where, of a quantity that has a
//!    limit, it changes the median or raises the 95th percentile by more than [`REQUIRED`], and by more than [`FLOOR`] of the
//!    limit; or where one of these is not known.

mod effect;

use std::borrow::Cow;
use std::cmp::Ordering;
use std::time::Instant;

pub use self::effect::Effect;
use super::as_planned::check_many::or_unknown;
use super::as_planned::quick_check::quick_check;
use super::samples::draw_until_sure::{ShotToSample, run_sample_once};
use super::samples::sample::Sample;
use super::samples::sample_count::Sampling;
use super::samples::sampled_shot::percentiles;
use super::work::batch::run_batch;
use super::{Case, ComputeResult, ComputeSettings, Computed, NoResult, Progress, ShotSummary, catch_panic};
use crate::plan::Plan;
use crate::scene::Shot;
use crate::verdict::{Limits, PerQuantity, Quantity, Verdict};

/// Number of samples behind a median, unless another is asked for.
pub const SAMPLES: usize = 49;
/// Change of a median from which an effect is required.
pub const REQUIRED: f64 = 0.05;
/// Change of a median over the limit below which the effect is not required: a few newtons more or less.
pub const FLOOR: f64 = 0.01;

/// What an effect does to one delay option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectOnOption {
    /// The effect.
    pub effect: Effect,
    /// Its value, in the unit of its key.
    pub value: f64,
    /// Whether the value is a probe, not the plan's own.
    pub assumed: bool,
    /// Change of each quantity.
    pub changes: PerQuantity<QuantityChange>,
    /// Whether a plan without the effect states too little, or may do so, in any direction of the effect.
    pub is_missed_on_the_unsafe_side: bool,
    /// On which side of the limits the shot as planned lies without the effect.
    pub verdict_without: Verdict,
    /// The same with the effect.
    pub verdict_with: Verdict,
    /// Time of a run with the effect over that of one without it.
    pub cost: f64,
}

impl EffectOnOption {
    fn new(variant: &Variant, without: &OptionFigures, with: &OptionFigures, limits: &Limits) -> Self {
        let changes = PerQuantity::from_fn(|quantity| QuantityChange {
            without: *without.spreads.get(quantity),
            with: *with.spreads.get(quantity),
            limit: limits.get(quantity),
        });
        Self {
            effect: variant.effect,
            value: variant.value,
            assumed: variant.assumed,
            is_missed_on_the_unsafe_side: with.verdict > without.verdict
                || changes.iter().any(QuantityChange::may_raise),
            changes,
            verdict_without: without.verdict,
            verdict_with: with.verdict,
            cost: with.time / without.time,
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

    /// Whether the effect brings the shot as planned to the other side of the limits.
    pub fn verdict_changes(&self) -> bool {
        self.verdict_without != self.verdict_with
    }

    /// How hard the effect is on the option, to be compared with that of another direction.
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

/// Median and 95th percentile of a quantity over the samples [SI]; infinite where a run failed.
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
    /// The median with the effect over that without it, less one; not a number where one is unknown.
    pub fn relative(&self) -> f64 {
        relative(self.without.median, self.with.median)
    }

    /// Whether the effect may not be left out, as far as this quantity says.
    fn is_required(&self) -> bool {
        let Some(limit) = self.limit else { return false };
        let matters = |without: f64, with: f64| {
            let relative = relative(without, with);
            relative.is_nan() || relative.abs() > REQUIRED && (with - without).abs() > FLOOR * limit
        };
        let rises = self.with.p95 > self.without.p95;
        matters(self.without.median, self.with.median) || rises && matters(self.without.p95, self.with.p95)
    }

    /// Whether the quantity has a limit and is greater with the effect, or may be.
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

/// A value over another, less one; not a number where one is unknown.
fn relative(without: f64, with: f64) -> f64 {
    match without.is_finite() && with.is_finite() {
        true if without == with => 0.0,
        true => with / without - 1.0,
        false => f64::NAN,
    }
}

/// Effects on every delay option, in the order of the plan (`n_options`); `None` where the time was up.
pub type EffectsOnOptions = Vec<Option<Vec<EffectOnOption>>>;

/// An effect to be tried; its plans are indices of cases.
struct Variant {
    effect: Effect,
    value: f64,
    assumed: bool,
    without: usize,
    /// Toward each direction.
    with: Vec<usize>,
}

/// What is known of one option of one plan.
struct OptionFigures {
    /// On which side of the limits the shot as planned lies.
    verdict: Verdict,
    /// Those of each quantity.
    spreads: PerQuantity<Spread>,
    /// Median time of a sample [s].
    time: f64,
}

/// Index of the plan as it is among the cases.
const AS_PLANNED: usize = 0;

/// Switches every effect on and off for every delay option. Without a `sampling` only the shots as planned count.
pub fn effects(
    case: &Case,
    sampling: Option<&Sampling>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> ComputeResult<EffectsOnOptions> {
    let mut cases = vec![case.clone()];
    let computed = Effect::ALL.into_iter().filter(|effect| effect.is_computed_by(compute.method));
    let variants: Vec<Variant> =
        computed.filter_map(|effect| variant(effect, &case.plan, &mut cases)).collect();
    let jobs: Vec<(usize, usize)> = itertools::iproduct!(0..case.shots.len(), 0..cases.len()).collect();
    let measured = run_batch(&jobs, progress, |&(option, n)| {
        catch_panic(|| measure_option(&cases[n], option, sampling, compute, progress))
    })?;
    let partial = measured.iter().any(Option::is_none);
    let on_option = |figures: &[Option<OptionFigures>]| -> Option<Vec<EffectOnOption>> {
        let figures: Vec<&OptionFigures> = figures.iter().map(Option::as_ref).collect::<Option<_>>()?;
        variants.iter().map(|variant| hardest(variant, &figures, &case.limits)).collect()
    };
    let effects = measured.chunks(cases.len()).map(on_option).collect();
    Ok(Computed { value: effects, partial })
}

/// The plans with and without an effect, added to `cases`; `None` where there is nothing to try.
fn variant(effect: Effect, plan: &Plan, cases: &mut Vec<Case>) -> Option<Variant> {
    let mut add = |value, toward| {
        cases.push(Case::new(effect.plan_with(plan, value, toward)));
        cases.len() - 1
    };
    match (effect.value_in(plan), effect.probe_value()) {
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

/// The effect in its hardest direction; `figures` are those of each case.
fn hardest(variant: &Variant, figures: &[&OptionFigures], limits: &Limits) -> Option<EffectOnOption> {
    let all = variant
        .with
        .iter()
        .map(|&n| EffectOnOption::new(variant, figures[variant.without], figures[n], limits));
    let is_missed_on_the_unsafe_side = all.clone().any(|row| row.is_missed_on_the_unsafe_side);
    let hardest = all.max_by(|a, b| a.severity().partial_cmp(&b.severity()).unwrap_or(Ordering::Equal));
    Some(EffectOnOption { is_missed_on_the_unsafe_side, ..hardest? })
}

/// Time after the last hole over which a shelter without friction is followed [s]: it never comes to rest.
const WITHOUT_FRICTION: f64 = 3.0;

/// The case, with an end of its runs where nothing comes to rest: what holds for an option depends on no other.
fn followed<'c>(case: &'c Case, shot: &Shot) -> Cow<'c, Case> {
    if case.plan.ground.friction > 0.0 || case.plan.simulation.duration_s.is_some() {
        return Cow::Borrowed(case);
    }
    let last = shot.firings.last().map_or(0.0, |firing| firing.time);
    Cow::Owned(case.with_duration(Some(last + WITHOUT_FRICTION)))
}

/// Screens an option as planned, and takes its first samples.
fn measure_option(
    case: &Case,
    option: usize,
    sampling: Option<&Sampling>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<OptionFigures, NoResult> {
    let shot = &case.shots[option];
    let case = &*followed(case, shot);
    let begun = Instant::now();
    let as_planned = or_unknown(quick_check(case, shot, compute, progress))?;
    let verdict = verdict_of_values(&as_planned, case);
    let Some(sampling) = sampling else {
        let spreads = PerQuantity::from_fn(|quantity| {
            let value = as_planned.get(quantity).value;
            Spread { median: value, p95: value }
        });
        return Ok(OptionFigures { verdict, spreads, time: begun.elapsed().as_secs_f64() });
    };
    let target = ShotToSample::new(case, shot, *compute, *sampling);
    let timed_sample = |number: usize| -> Result<(Sample, f64), NoResult> {
        let begun = Instant::now();
        Ok((run_sample_once(&target, number, progress)?, begun.elapsed().as_secs_f64()))
    };
    let samples = (0..sampling.most).map(timed_sample).collect::<Result<Vec<_>, _>>()?;
    let spread = |values: &mut dyn Iterator<Item = f64>| {
        let [median, p95] = percentiles(values, [0.5, 0.95]).unwrap_or([f64::INFINITY; 2]);
        Spread { median, p95 }
    };
    let spreads = PerQuantity::from_fn(|quantity| {
        spread(&mut samples.iter().map(|(sample, _)| sample.run.get(quantity)))
    });
    Ok(OptionFigures { verdict, spreads, time: spread(&mut samples.iter().map(|(_, time)| *time)).median })
}

/// On which side of the limits a shot lies. A run that ends early counts by its values: without friction none comes to rest.
fn verdict_of_values(judged: &ShotSummary, case: &Case) -> Verdict {
    let utilization = |errors: f64| judged.with_errors(errors).utilization(&case.limits);
    match (utilization(1.0) <= 1.0, utilization(-1.0) > 1.0) {
        _ if judged.verdict == Verdict::Fail => Verdict::Fail,
        (true, _) => Verdict::Pass,
        (_, true) => Verdict::Fail,
        _ => Verdict::Undecided,
    }
}
