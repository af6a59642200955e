//! The effects that a scene may have, and plans with and without each.

use crate::choice::Method;
use crate::plan::keys::{self, Key};
use crate::plan::{Layout, Plan};

/// An effect of the model that a scene may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Launches tilted from the ground's normal.
    Tilt,
    /// Launches that take time.
    Push,
    /// Sloping ground.
    Slope,
    /// Landings that rebound.
    Restitution,
    /// Cables that are damped.
    Damping,
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
    /// Tires that turn toward their cables.
    Turn,
}

impl Effect {
    /// All effects.
    pub const ALL: [Self; 11] = [
        Self::Tilt,
        Self::Push,
        Self::Slope,
        Self::Restitution,
        Self::Damping,
        Self::Ends,
        Self::Friction,
        Self::Slack,
        Self::Rims,
        Self::Ballast,
        Self::Turn,
    ];

    /// Name for scripts: the key, or a name of its own for a probe that no plan can hold.
    pub fn script_name(self) -> &'static str {
        if self.is_of_plan() { self.key().name } else { "tires_turn" }
    }

    /// Whether a plan can have the effect.
    pub fn is_of_plan(self) -> bool {
        self != Self::Turn
    }

    /// The plan key for the strength of the effect.
    pub fn key(self) -> &'static Key {
        match self {
            Self::Tilt => &keys::blast_row::TILT_DEG,
            Self::Push => &keys::blast_row::PUSH_MS,
            Self::Slope => &keys::ground::SLOPE_PERCENT,
            Self::Restitution => &keys::tire::RESTITUTION,
            Self::Damping => &keys::cable::DAMPING_PERCENT,
            Self::Ends => &keys::cable::END_STIFFNESS_KN_M,
            Self::Friction => &keys::ground::FRICTION,
            Self::Slack => &keys::cable::SLACK_PERCENT,
            Self::Rims | Self::Turn => &keys::tire::OUTER_DIAMETER_M,
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
            Self::Damping => "damping of cables",
            Self::Ends => "yielding ends",
            Self::Friction => "friction",
            Self::Slack => "slack",
            Self::Rims => "cables from rim to rim",
            Self::Ballast => "ballast",
            Self::Turn => "tires that turn",
        }
    }

    /// The plan's value, in the unit of the key; `None` if the plan lacks the effect.
    pub(super) fn value_in(self, plan: &Plan) -> Option<f64> {
        let some = |value: f64| Some(value).filter(|&value| value > 0.0);
        match self {
            Self::Tilt => some(plan.launches().map(|launch| launch.tilt_deg).fold(0.0, f64::max)),
            Self::Push => some(plan.launches().map(|launch| launch.push_ms).fold(0.0, f64::max)),
            Self::Slope => some(plan.ground.slope_percent),
            Self::Restitution => some(plan.tire.restitution),
            Self::Damping => some(plan.cable.damping_percent),
            Self::Ends => plan.cable.end_stiffness_kn_m,
            Self::Friction => some(plan.ground.friction),
            Self::Slack => some(plan.cable.slack_percent),
            Self::Rims => some(plan.tire.outer_diameter_m),
            Self::Ballast => match &plan.layout {
                Layout::Grid(mesh) | Layout::Quincunx(mesh) => some(mesh.border_rows as f64),
                Layout::List { .. } => None,
            },
            Self::Turn => None,
        }
    }

    /// Probe value for a plan that lacks the effect; `None` for choices that every plan makes.
    pub(super) fn probe_value(self, plan: &Plan) -> Option<f64> {
        match self {
            Self::Tilt => Some(5.0),
            Self::Push => Some(20.0),
            Self::Slope => Some(10.0),
            Self::Restitution => Some(0.3),
            Self::Damping => Some(5.0),
            Self::Ends => Some(2000.0),
            Self::Friction | Self::Slack | Self::Rims | Self::Ballast => None,
            // Cables from centre to centre turn with their tires.
            Self::Turn => Self::Rims.value_in(plan),
        }
    }

    /// Whether a method computes the effect.
    pub(super) fn is_computed_by(self, method: Method) -> bool {
        !matches!(self, Self::Push | Self::Restitution | Self::Damping) || method == Method::Verlet
    }

    /// Azimuths at which the effect is probed [°].
    pub(super) fn directions(self) -> &'static [f64] {
        if matches!(self, Self::Tilt | Self::Slope) { &[0.0, 90.0, 180.0, 270.0] } else { &[0.0] }
    }

    /// The plan with the effect at `value`, toward an azimuth [°] if it has a direction. If `value` is `None`, the plan without the effect.
    pub(super) fn plan_with(self, plan: &Plan, value: Option<f64>, toward: f64) -> Plan {
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
            Self::Damping => plan.cable.damping_percent = value_or_zero,
            Self::Ends => plan.cable.end_stiffness_kn_m = value,
            Self::Friction => {
                plan.ground.friction = value_or_zero;
                plan.uncertainty.friction = [value_or_zero; 2];
            }
            Self::Slack => {
                plan.cable.slack_percent = value_or_zero;
                plan.uncertainty.slack_percent = [value_or_zero; 2];
            }
            Self::Rims => plan.tire.outer_diameter_m = value_or_zero,
            Self::Turn => plan.tire.turns = value.is_some(),
            Self::Ballast => {
                if let Layout::Grid(mesh) | Layout::Quincunx(mesh) = &mut plan.layout {
                    mesh.border_rows = value_or_zero as usize;
                }
            }
        }
        plan
    }
}
