//! The numbers that a fit estimates: their coordinates, plausible ranges, priors in the plan, and effect on a plan.
//!
//! Launch and stiffness act as factors, so their coordinate is the logarithm of the number. The scale is then even, and a standard
//! deviation of the coordinate is a relative standard deviation of the number.

use crate::choice::Unknown;
use crate::plan::write_fit::StatedKeys;
use crate::plan::{Launch, LaunchTargets, Plan};

/// One number to estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The unknown that the number belongs to.
    pub unknown: Unknown,
    /// Index of the blast row, for a launch by row.
    pub row: Option<usize>,
}

/// Knowledge of a coordinate before the observations: mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
}

impl Prior {
    /// The prior with the mean and standard deviation of a uniform distribution between two ends.
    fn between([low, high]: [f64; 2]) -> Self {
        Self { mean: 0.5 * (low + high), sd: (high - low) / 12.0_f64.sqrt() }
    }

    /// The prior of the logarithm of a lognormal factor with mean 1 and coefficient of variation `cv_percent` [%].
    pub fn lognormal(cv_percent: f64) -> Self {
        let variance = (cv_percent * 1e-2).powi(2).ln_1p();
        Self { mean: -0.5 * variance, sd: variance.sqrt() }
    }
}

impl Parameter {
    /// The numbers behind these unknowns: one per blast row for launches by row, else one per unknown.
    pub fn all(unknowns: &[Unknown], plan: &Plan) -> Vec<Self> {
        let of = |&unknown: &Unknown| -> Vec<Self> {
            match unknown {
                Unknown::LaunchByRow => {
                    (0..plan.blast_rows.len()).map(|row| Self { unknown, row: Some(row) }).collect()
                }
                _ => vec![Self { unknown, row: None }],
            }
        };
        unknowns.iter().flat_map(of).collect()
    }

    /// Inputs that `[uncertainty]` gives in common for a whole shot, and that the fit does not estimate.
    pub fn not_estimated(unknowns: &[Unknown]) -> Vec<Self> {
        let mut unknowns_left = vec![Unknown::Friction, Unknown::Slack, Unknown::AxialStiffness];
        if !unknowns.contains(&Unknown::LaunchByRow) {
            unknowns_left.push(Unknown::Launch);
        }
        unknowns_left.retain(|other| !unknowns.contains(other));
        unknowns_left.into_iter().map(|unknown| Self { unknown, row: None }).collect()
    }

    /// Name that scripts read: the unknown, then the row in brackets if there is one.
    pub fn name(&self, plan: &Plan) -> String {
        let row = self.row.map(|row| format!("[{}]", plan.blast_rows[row].name));
        format!("{}{}", self.unknown, row.unwrap_or_default())
    }

    /// Unit of the number; empty for a factor.
    pub fn unit(&self) -> &'static str {
        match self.unknown {
            Unknown::Launch | Unknown::LaunchByRow | Unknown::Friction => "",
            Unknown::Slack | Unknown::Damping => "%",
            Unknown::AxialStiffness => "kN",
            Unknown::EndStiffness => "kN/m",
        }
    }

    fn is_logarithmic(&self) -> bool {
        !matches!(self.unknown, Unknown::Friction | Unknown::Slack | Unknown::Damping)
    }

    /// The number at a coordinate [unit of the number].
    pub fn value(&self, at: f64) -> f64 {
        if self.is_logarithmic() { at.exp() } else { at }
    }

    /// The coordinate of a number.
    pub fn coordinate(&self, value: f64) -> f64 {
        if self.is_logarithmic() { value.ln() } else { value }
    }

    /// Standard deviation of the number [unit of the number], from the standard deviation `sd` of its coordinate.
    pub fn sd_of_value(&self, at: f64, sd: f64) -> f64 {
        if self.is_logarithmic() { self.value(at) * sd } else { sd }
    }

    /// The number in the plan; `None` for ends that are stiff.
    pub fn planned(&self, plan: &Plan) -> Option<f64> {
        match self.unknown {
            Unknown::Launch | Unknown::LaunchByRow => Some(1.0),
            Unknown::Friction => Some(plan.ground.friction),
            Unknown::Slack => Some(plan.cable.slack_percent),
            Unknown::AxialStiffness => Some(plan.cable.axial_stiffness_kn),
            Unknown::EndStiffness => plan.cable.end_stiffness_kn_m,
            Unknown::Damping => Some(plan.cable.damping_percent),
        }
    }

    /// Plausible range of the coordinate. The range includes the number of the plan.
    pub fn range(&self, plan: &Plan) -> [f64; 2] {
        let planned = self.planned(plan);
        let [low, high] = match self.unknown {
            Unknown::Launch | Unknown::LaunchByRow => [1.0 / 3.0, 3.0],
            Unknown::Friction => [0.05, 1.5],
            Unknown::Slack => [0.0, 15.0],
            Unknown::AxialStiffness => {
                [plan.cable.axial_stiffness_kn / 3.0, plan.cable.axial_stiffness_kn * 3.0]
            }
            Unknown::EndStiffness => [50.0, 1e5],
            Unknown::Damping => [0.0, 50.0],
        };
        let held = planned
            .filter(|&planned| planned > 0.0)
            .map_or([low, high], |planned| [low.min(0.5 * planned), high.max(1.5 * planned)]);
        held.map(|end| self.coordinate(end))
    }

    /// The prior that `[uncertainty]` states for the coordinate; `None` if the plan does not state it.
    pub fn stated_prior(&self, plan: &Plan, stated: &StatedKeys) -> Option<Prior> {
        let is_stated = match self.unknown {
            Unknown::Launch | Unknown::LaunchByRow => stated.launch_common,
            Unknown::Friction => stated.friction,
            Unknown::Slack => stated.slack,
            Unknown::AxialStiffness => stated.axial_stiffness,
            Unknown::EndStiffness | Unknown::Damping => false,
        };
        if is_stated { self.prior(plan) } else { None }
    }

    /// The prior of the coordinate, stated in the plan or by default; `None` if the plan has no key for it.
    pub fn prior(&self, plan: &Plan) -> Option<Prior> {
        let uncertainty = &plan.uncertainty;
        match self.unknown {
            Unknown::Launch | Unknown::LaunchByRow => {
                Some(Prior::lognormal(uncertainty.launch_common_percent))
            }
            Unknown::Friction => Some(Prior::between(uncertainty.friction)),
            Unknown::Slack => Some(Prior::between(uncertainty.slack_percent)),
            Unknown::AxialStiffness => {
                let planned = plan.cable.axial_stiffness_kn;
                let end = |percent: f64| self.coordinate(planned * (1.0 + 1e-2 * percent));
                Some(Prior::between(uncertainty.axial_stiffness_percent.map(end)))
            }
            Unknown::EndStiffness | Unknown::Damping => None,
        }
    }

    /// Sets the number at a coordinate in a plan. A launch is a factor on the launches of the plan.
    pub fn set_in(&self, plan: &mut Plan, at: f64) {
        let value = self.value(at);
        match self.unknown {
            Unknown::Launch => plan.launches_mut().for_each(|launch| launch.speed_m_s *= value),
            Unknown::LaunchByRow => {
                let row = self.row.map(|row| &mut plan.blast_rows[row].targets);
                row.into_iter().flat_map(launches).for_each(|launch| launch.speed_m_s *= value);
            }
            Unknown::Friction => plan.ground.friction = value,
            Unknown::Slack => plan.cable.slack_percent = value,
            Unknown::AxialStiffness => plan.cable.axial_stiffness_kn = value,
            Unknown::EndStiffness => plan.cable.end_stiffness_kn_m = Some(value),
            Unknown::Damping => plan.cable.damping_percent = value,
        }
    }
}

/// Launches of the targets of one row.
fn launches(targets: &mut LaunchTargets) -> Vec<&mut Launch> {
    match targets {
        LaunchTargets::UnderRow { launch, .. } | LaunchTargets::UnderTires { launch, .. } => vec![launch],
        LaunchTargets::Holes(holes) => holes.iter_mut().map(|hole| &mut hole.launch).collect(),
    }
}
