//! Which effects a scene requires: each switched on, or taken away, by itself.
//!
//! 1. An effect of the plan is compared with the plan without it; one that the plan lacks is probed at a stated value. Directed
//!    effects are probed both ways across the blast rows, and the harder way counts.
//! 2. Nominal differences alone are noise where a motion has several branches. So medians are compared, over the first
//!    [`SAMPLES`] samples of `[uncertainty]`, with the same draws on both sides.
//! 3. An effect is required where it changes the verdict on the shot as planned, or a median by more than [`REQUIRED`].

use std::time::{Duration, Instant};

use super::batch::run_jobs;
use super::sampling::{Sampling, ShotToSample, run_sample};
use super::screen::{is_sure, screen};
use super::{Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress, guarded};
use crate::choice::Method;
use crate::plan::keys::{self, Key};
use crate::plan::{Layout, Plan};
use crate::verdict::{Quantity, Verdict};

/// Samples behind a median.
const SAMPLES: usize = 25;
/// Change of a median from which an effect is required.
pub const REQUIRED: f64 = 0.05;
/// Time after the last hole over which a shelter without friction is followed [s].
const WITHOUT_FRICTION: f64 = 3.0;

/// An effect of the model that a scene may have or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Launches tilted from the ground's normal.
    Tilt,
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
    pub const ALL: [Self; 8] = [
        Self::Tilt,
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
    fn of(self, plan: &Plan) -> Option<f64> {
        let some = |value: f64| Some(value).filter(|&value| value > 0.0);
        match self {
            Self::Tilt => some(plan.launches().map(|launch| launch.tilt_deg).fold(0.0, f64::max)),
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
    fn probe(self) -> Option<f64> {
        match self {
            Self::Tilt => Some(5.0),
            Self::Slope => Some(10.0),
            Self::Restitution => Some(0.3),
            Self::Ends => Some(2000.0),
            Self::Friction | Self::Slack | Self::Rims | Self::Ballast => None,
        }
    }

    /// Whether a method has the effect.
    fn is_in(self, method: Method) -> bool {
        self != Self::Restitution || method == Method::Verlet
    }

    /// Azimuths at which the effect is probed [°]: across the blast rows, which lie along x.
    fn directions(self) -> &'static [f64] {
        if matches!(self, Self::Tilt | Self::Slope) { &[90.0, 270.0] } else { &[0.0] }
    }

    /// The plan with the effect at `value`, toward an azimuth [°] where it has a direction; without it where `None`.
    fn set(self, plan: &Plan, value: Option<f64>, toward: f64) -> Plan {
        let mut plan = plan.clone();
        let value_or_zero = value.unwrap_or(0.0);
        match self {
            Self::Tilt => plan.launches_mut().for_each(|launch| {
                (launch.tilt_deg, launch.tilt_toward_deg) = (value_or_zero, toward);
            }),
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
    /// Median of the greatest height with the effect over that without it, less one.
    pub height_change: f64,
    /// The same of the greatest cable force.
    pub force_change: f64,
    /// Verdicts on the shot as planned, without the effect and with it.
    pub verdicts: [Verdict; 2],
    /// Time of a run with the effect over that of one without it.
    pub cost: f64,
    /// Whether height and force change by less than their computing errors.
    pub is_below_error: bool,
}

impl EffectOnOption {
    /// Whether the scene requires the effect for this option.
    pub fn is_required(&self) -> bool {
        // A change that is no number comes of a run that failed: nothing shows that the effect may be left out.
        let matters = |change: f64| change.is_nan() || change.abs() > REQUIRED;
        self.verdicts[0] != self.verdicts[1] || matters(self.height_change) || matters(self.force_change)
    }

    /// Whether a plan without the effect states too little height or force.
    pub fn is_missed_on_the_unsafe_side(&self) -> bool {
        self.height_change > 0.0 || self.force_change > 0.0
    }
}

/// Effects on every delay option, in the order of the plan (`n_options`); `None` where the time was up.
pub type EffectsOnOptions = Vec<Option<Vec<EffectOnOption>>>;

/// A plan with or without an effect, made ready.
struct Variant {
    effect: Effect,
    value: f64,
    assumed: bool,
    /// Without the effect, and with it toward each direction; `None`: the plan as it is.
    without: Option<Case>,
    with: Vec<Option<Case>>,
}

/// What is known of one option of a plan.
struct Known {
    envelope: Envelope,
    medians: [f64; 2],
    time: Duration,
}

/// Switches every effect on and off for every delay option.
pub fn effects(case: &Case, compute: &ComputeSettings, progress: &Progress) -> Finding<EffectsOnOptions> {
    let all = Effect::ALL.into_iter().filter(|effect| effect.is_in(compute.method));
    let variants: Vec<Variant> = all.filter_map(|effect| variant(case, effect)).collect();
    let options: Vec<usize> = (0..case.shots.len()).collect();
    let found = run_jobs(&options, progress, |&option| {
        guarded(|| {
            let own = know(case, option, compute, progress)?;
            variants.iter().map(|variant| compare(variant, &own, option, compute, progress)).collect()
        })
    })?;
    let partial = found.contains(&None);
    Ok(Found { value: found, partial })
}

fn variant(case: &Case, effect: Effect) -> Option<Variant> {
    let plan = &case.plan;
    let ready = |value, toward| Some(Case::new(effect.set(plan, value, toward)));
    match (effect.of(plan), effect.probe()) {
        (Some(value), _) => {
            Some(Variant { effect, value, assumed: false, without: ready(None, 0.0), with: vec![None] })
        }
        (None, Some(value)) => {
            let with = effect.directions().iter().map(|&toward| ready(Some(value), toward)).collect();
            Some(Variant { effect, value, assumed: true, without: None, with })
        }
        (None, None) => None,
    }
}

fn compare(
    variant: &Variant,
    own: &Known,
    option: usize,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<EffectOnOption, NoResult> {
    let of =
        |case: &Option<Case>| case.as_ref().map(|case| know(case, option, compute, progress)).transpose();
    let without = of(&variant.without)?;
    let without = without.as_ref().unwrap_or(own);
    let mut hardest: Option<EffectOnOption> = None;
    for case in &variant.with {
        let with = of(case)?;
        let with = with.as_ref().unwrap_or(own);
        let change = |n: usize| match [without.medians[n], with.medians[n]] {
            [before, after] if before == after => 0.0,
            [before, after] => after / before - 1.0,
        };
        let error = |quantity: Quantity| {
            let bounded = own.envelope.get(quantity);
            bounded.error / bounded.value
        };
        let here = EffectOnOption {
            effect: variant.effect,
            value: variant.value,
            assumed: variant.assumed,
            height_change: change(0),
            force_change: change(1),
            verdicts: [without.envelope.verdict, with.envelope.verdict],
            cost: with.time.as_secs_f64() / without.time.as_secs_f64(),
            is_below_error: change(0).abs() < error(Quantity::Height)
                && change(1).abs() < error(Quantity::Force),
        };
        let harm = |of: &EffectOnOption| of.height_change.max(of.force_change);
        if hardest.is_none_or(|hardest| harm(&here) > harm(&hardest)) {
            hardest = Some(here);
        }
    }
    hardest.ok_or(NoResult::OutOfTime)
}

/// Screens an option as planned, and takes the medians of its first samples.
fn know(
    case: &Case,
    option: usize,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Known, NoResult> {
    let shot = &case.shots[option];
    let envelope = match screen(case, shot, compute, progress, |envelope, runs| is_sure(case, envelope, runs))
    {
        Err(NoResult::Failed(_)) => Envelope::UNKNOWN,
        screened => screened?,
    };
    let sampling = Sampling::exactly(SAMPLES, Sampling::OF_VERDICT.seed);
    let target = ShotToSample { case, shot, planned: None, compute: *compute, sampling, precomputed: &[] };
    let begun = Instant::now();
    let mut values = [Vec::with_capacity(SAMPLES), Vec::with_capacity(SAMPLES)];
    for number in 0..SAMPLES {
        let sample = run_sample(&target, number, 1.0, progress)?;
        values[0].push(sample.run.height);
        values[1].push(sample.run.force);
    }
    let time = begun.elapsed();
    let medians = values.map(|mut values| {
        values.sort_by(f64::total_cmp);
        values[SAMPLES / 2]
    });
    Ok(Known { envelope, medians, time })
}
