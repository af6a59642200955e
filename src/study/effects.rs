//! Which effects a scene requires: each switched on, or taken away, by itself.
//!
//! 1. An effect of the plan is compared with the plan without it; one that the plan lacks is probed at a stated value. Directed
//!    effects are probed along x and y, both ways, and the hardest direction counts.
//! 2. Nominal differences alone are noise where a motion has several branches. So medians are compared, over the first samples of
//!    `[uncertainty]`, with the same draws on both sides.
//! 3. An effect is required where it changes on which side of the limits the shot as planned lies; where it changes the median of a
//!    quantity that has a limit by more than [`REQUIRED`], and by more than [`FLOOR`] of the limit; or where one of these is not
//!    known.

use std::time::{Duration, Instant};

use super::batch::run_jobs;
use super::risk::percentiles;
use super::sample::Sample;
use super::sampling::{Sampling, ShotToSample, run_sample};
use super::screen::{is_sure, screen};
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, guarded};
use crate::choice::Method;
use crate::plan::keys::{self, Key};
use crate::plan::{Layout, Plan};
use crate::verdict::{Limits, Quantity, Verdict};

/// Samples behind a median where nobody asks for another number.
pub const SAMPLES: usize = 49;
/// Change of a median from which an effect is required.
pub const REQUIRED: f64 = 0.05;
/// Change of a median over the limit below which the effect is not required: a few newtons more or less.
pub const FLOOR: f64 = 0.01;
/// Time after the last hole over which a shelter without friction is followed [s].
const WITHOUT_FRICTION: f64 = 3.0;

/// An effect of the model that a scene may have or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Launches tilted from the ground's normal.
    Tilt,
    /// Launches that take time.
    Push,
    /// Sloping ground.
    Slope,
    /// Landings that rebound.
    Restitution,
    /// Ends of cables that yield.
    Ends,
    /// Friction on the ground.
    Friction,
    /// Slack of the cables.
    Slack,
    /// Cables from rim to rim.
    Rims,
    /// Rows of ballast.
    Ballast,
}

impl Effect {
    /// All effects.
    pub const ALL: [Self; 9] = [
        Self::Tilt,
        Self::Push,
        Self::Slope,
        Self::Restitution,
        Self::Ends,
        Self::Friction,
        Self::Slack,
        Self::Rims,
        Self::Ballast,
    ];

    /// The key of a plan that says how strong the effect is.
    pub fn key(self) -> &'static Key {
        match self {
            Self::Tilt => &keys::blast_row::TILT_DEG,
            Self::Push => &keys::blast_row::PUSH_MS,
            Self::Slope => &keys::ground::SLOPE_PERCENT,
            Self::Restitution => &keys::tire::RESTITUTION,
            Self::Ends => &keys::cable::END_STIFFNESS_KN_M,
            Self::Friction => &keys::ground::FRICTION,
            Self::Slack => &keys::cable::SLACK_PERCENT,
            Self::Rims => &keys::tire::OUTER_DIAMETER_M,
            Self::Ballast => &keys::shelter::BORDER_ROWS,
        }
    }

    /// The effect in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tilt => "launch direction",
            Self::Push => "push over a time",
            Self::Slope => "slope",
            Self::Restitution => "rebound of landings",
            Self::Ends => "yielding ends",
            Self::Friction => "friction",
            Self::Slack => "slack",
            Self::Rims => "cables from rim to rim",
            Self::Ballast => "ballast",
        }
    }

    /// The value of the plan, in the unit of the key; `None` where the plan lacks the effect.
    fn value_in(self, plan: &Plan) -> Option<f64> {
        let some = |value: f64| Some(value).filter(|&value| value > 0.0);
        match self {
            Self::Tilt => some(plan.launches().map(|launch| launch.tilt_deg).fold(0.0, f64::max)),
            Self::Push => some(plan.launches().map(|launch| launch.push_ms).fold(0.0, f64::max)),
            Self::Slope => some(plan.ground.slope_percent),
            Self::Restitution => some(plan.tire.restitution),
            Self::Ends => plan.cable.end_stiffness_kn_m,
            Self::Friction => some(plan.ground.friction),
            Self::Slack => some(plan.cable.slack_percent),
            Self::Rims => some(plan.tire.outer_diameter_m),
            Self::Ballast => match &plan.layout {
                Layout::Grid(mesh) | Layout::Quincunx(mesh) => some(mesh.border_rows as f64),
                Layout::List { .. } => None,
            },
        }
    }

    /// The value at which the effect is probed where a plan lacks it; `None` for choices that every plan makes.
    fn probe_value(self) -> Option<f64> {
        match self {
            Self::Tilt => Some(5.0),
            Self::Push => Some(20.0),
            Self::Slope => Some(10.0),
            Self::Restitution => Some(0.3),
            Self::Ends => Some(2000.0),
            Self::Friction | Self::Slack | Self::Rims | Self::Ballast => None,
        }
    }

    /// Whether a method has the effect.
    fn is_in(self, method: Method) -> bool {
        !matches!(self, Self::Push | Self::Restitution) || method == Method::Verlet
    }

    /// Azimuths at which the effect is probed [°].
    fn directions(self) -> &'static [f64] {
        if matches!(self, Self::Tilt | Self::Slope) { &[0.0, 90.0, 180.0, 270.0] } else { &[0.0] }
    }

    /// The plan with the effect at `value`, toward an azimuth [°] where it has a direction; without it where `None`.
    fn plan_with(self, plan: &Plan, value: Option<f64>, toward: f64) -> Plan {
        let mut plan = plan.clone();
        let value_or_zero = value.unwrap_or(0.0);
        match self {
            Self::Tilt => plan.launches_mut().for_each(|launch| {
                (launch.tilt_deg, launch.tilt_toward_deg) = (value_or_zero, toward);
            }),
            Self::Push => plan.launches_mut().for_each(|launch| launch.push_ms = value_or_zero),
            Self::Slope => {
                (plan.ground.slope_percent, plan.ground.slope_toward_deg) = (value_or_zero, toward)
            }
            Self::Restitution => plan.tire.restitution = value_or_zero,
            Self::Ends => plan.cable.end_stiffness_kn_m = value,
            Self::Friction => {
                plan.ground.friction = value_or_zero;
                plan.uncertainty.friction = [value_or_zero; 2];
                // Without friction the shelter never comes to rest.
                let times = plan.delays.iter().flat_map(|delay| delay.timing.fire_at_ms());
                let last = times.fold(0.0, f64::max) * 1e-3;
                plan.simulation.duration_s.get_or_insert(last + WITHOUT_FRICTION);
            }
            Self::Slack => {
                plan.cable.slack_percent = value_or_zero;
                plan.uncertainty.slack_percent = [value_or_zero; 2];
            }
            Self::Rims => plan.tire.outer_diameter_m = value_or_zero,
            Self::Ballast => {
                if let Layout::Grid(mesh) | Layout::Quincunx(mesh) = &mut plan.layout {
                    mesh.border_rows = 0;
                }
            }
        }
        plan
    }
}

/// What an effect does to one delay option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectOnOption {
    /// The effect.
    pub effect: Effect,
    /// Its value, in the unit of its key.
    pub value: f64,
    /// Whether the value is a probe, not the plan's own.
    pub assumed: bool,
    /// Change of the median of each of [`Quantity::ALL`].
    pub changes: [Change; Quantity::ALL.len()],
    /// On which side of the limits the shot as planned lies without the effect.
    pub verdict_without: Verdict,
    /// The same with the effect.
    pub verdict_with: Verdict,
    /// Time of a run with the effect over that of one without it.
    pub cost: f64,
}

impl EffectOnOption {
    fn new(variant: &Variant, without: &OptionFigures, with: &OptionFigures, limits: &Limits) -> Self {
        Self {
            effect: variant.effect,
            value: variant.value,
            assumed: variant.assumed,
            changes: Quantity::ALL.map(|of| Change {
                without: without.medians[of as usize],
                with: with.medians[of as usize],
                limit: limits.get(of),
            }),
            verdict_without: without.verdict,
            verdict_with: with.verdict,
            cost: with.time.as_secs_f64() / without.time.as_secs_f64(),
        }
    }

    /// Relative change of the median of a quantity.
    pub fn change(&self, of: Quantity) -> f64 {
        self.changes[of as usize].relative()
    }

    /// Whether the scene requires the effect for this option.
    pub fn is_required(&self) -> bool {
        self.verdict_changes() || self.changes.iter().any(Change::matters)
    }

    /// Whether the effect brings the shot as planned to the other side of the limits.
    pub fn verdict_changes(&self) -> bool {
        self.verdict_without != self.verdict_with
    }

    /// Whether a plan without the effect states too little, or may do so.
    pub fn is_missed_on_the_unsafe_side(&self) -> bool {
        let more = |change: &Change| {
            change.limit.is_some() && (change.relative().is_nan() || change.relative() > 0.0)
        };
        self.verdict_with > self.verdict_without || self.changes.iter().any(more)
    }

    /// How hard the effect is on the option, to be compared with that of another direction.
    fn harm(&self) -> (bool, Verdict, f64) {
        let used = |change: &Change| match change.relative().is_nan() {
            true => f64::INFINITY,
            false => change.limit.map_or(0.0, |limit| (change.with - change.without) / limit),
        };
        (
            self.is_required(),
            self.verdict_with,
            self.changes.iter().map(used).fold(f64::NEG_INFINITY, f64::max),
        )
    }
}

/// The median of a quantity without an effect and with it [SI].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Without the effect; infinite where a run failed.
    pub without: f64,
    /// With the effect; infinite where a run failed.
    pub with: f64,
    /// Limit of the quantity, if it has one.
    pub limit: Option<f64>,
}

impl Change {
    /// The median with the effect over that without it, less one; not a number where one is unknown.
    pub fn relative(&self) -> f64 {
        match self.without.is_finite() && self.with.is_finite() {
            true if self.without == self.with => 0.0,
            true => self.with / self.without - 1.0,
            false => f64::NAN,
        }
    }

    /// Whether the effect may not be left out, as far as this quantity says.
    fn matters(&self) -> bool {
        let relative = self.relative();
        self.limit.is_some_and(|limit| {
            relative.is_nan() || relative.abs() > REQUIRED && (self.with - self.without).abs() > FLOOR * limit
        })
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
    /// Median of each of [`Quantity::ALL`] [SI].
    medians: [f64; Quantity::ALL.len()],
    /// Time of all samples.
    time: Duration,
}

/// Index of the plan as it is among the cases.
const AS_PLANNED: usize = 0;

/// Switches every effect on and off for every delay option.
pub fn effects(
    case: &Case,
    sampling: &Sampling,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<EffectsOnOptions> {
    let mut cases = vec![case.clone()];
    let all = Effect::ALL.into_iter().filter(|effect| effect.is_in(compute.method));
    let variants: Vec<Variant> = all.filter_map(|effect| variant(effect, &case.plan, &mut cases)).collect();
    let jobs: Vec<(usize, usize)> = itertools::iproduct!(0..case.shots.len(), 0..cases.len()).collect();
    let measured = run_jobs(&jobs, progress, |&(option, n)| {
        guarded(|| measure_option(&cases[n], option, sampling, compute, progress))
    })?;
    let partial = measured.iter().any(Option::is_none);
    let on_option = |figures: &[Option<OptionFigures>]| -> Option<Vec<EffectOnOption>> {
        let figures: Vec<&OptionFigures> = figures.iter().map(Option::as_ref).collect::<Option<_>>()?;
        variants.iter().map(|variant| hardest(variant, &figures, &case.limits)).collect()
    };
    let found = measured.chunks(cases.len()).map(on_option).collect();
    Ok(Found { value: found, partial })
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
    all.max_by(|a, b| a.harm().partial_cmp(&b.harm()).unwrap_or(std::cmp::Ordering::Equal))
}

/// Screens an option as planned, and takes the medians of its first samples.
fn measure_option(
    case: &Case,
    option: usize,
    sampling: &Sampling,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<OptionFigures, NoResult> {
    let shot = &case.shots[option];
    let envelope = match screen(case, shot, compute, progress, |envelope, runs| is_sure(case, envelope, runs))
    {
        Err(NoResult::Failed(_)) => Envelope::UNKNOWN,
        screened => screened?,
    };
    let target =
        ShotToSample { case, shot, planned: None, compute: *compute, sampling: *sampling, precomputed: &[] };
    let begun = Instant::now();
    let samples: Vec<Sample> = (0..sampling.most)
        .map(|number| run_sample(&target, number, 1.0, progress))
        .collect::<Result<_, _>>()?;
    let time = begun.elapsed();
    let median = |quantity: Quantity| {
        let values = samples.iter().map(|sample| sample.run.get(quantity));
        percentiles(values, [0.5]).map_or(f64::INFINITY, |[median]| median)
    };
    Ok(OptionFigures { verdict: side(&envelope, case), medians: Quantity::ALL.map(median), time })
}

/// On which side of the limits a shot lies. A run that ends early counts by its values: without friction none comes to rest.
fn side(envelope: &Envelope, case: &Case) -> Verdict {
    let utilization = |errors: f64| envelope.with_errors(errors).utilization(&case.limits);
    match (utilization(1.0) <= 1.0, utilization(-1.0) > 1.0) {
        (true, _) => Verdict::Pass,
        (_, true) => Verdict::Fail,
        _ => Verdict::Undecided,
    }
}
