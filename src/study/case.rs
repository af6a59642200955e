//! A plan made ready to run.

use std::borrow::Cow;
use std::path::Path;
use std::sync::OnceLock;

use super::hole_places::TiresByPlace;
use super::work::Fingerprint;
use crate::choice::Method;
use crate::plan::{Diagnostics, HoleTiming, Plan, PlanSource, Time, Uncertainty};
use crate::scene::{Scene, Shot, build, shot_in_order, shot_of_option};
use crate::simulation::{Model, RunSettings};
use crate::verdict::Limits;

/// A plan made ready to run.
#[derive(Clone, Debug)]
pub struct Case {
    /// File and text of the plan; empty if the program made the plan.
    pub source: PlanSource,
    /// Values of the plan.
    pub plan: Plan,
    /// The shelter, made ready for many runs.
    pub model: Model,
    /// Firing time and launch velocity of every hole, per delay option (`n_options`).
    pub shots: Vec<Shot>,
    /// Limits in SI units.
    pub limits: Limits,
    /// Filled by [`Case::fingerprint`].
    pub(in crate::study) fingerprint: OnceLock<Fingerprint>,
    /// Filled if the tires have no diameter.
    pub(in crate::study) tires_by_place: OnceLock<TiresByPlace>,
}

impl Case {
    /// Reads, validates and builds a plan; `-` is standard input.
    pub fn load(path: &Path) -> Result<Self, Diagnostics> {
        Self::parse(PlanSource::read(path)?)
    }

    /// Validates and builds a plan from its text.
    pub fn parse(source: PlanSource) -> Result<Self, Diagnostics> {
        let plan = source.plan()?;
        Ok(Self::new(plan).with_source(source))
    }

    /// Builds scene, shots and limits of a plan that has no file.
    pub fn new(plan: Plan) -> Self {
        let scene = build(&plan);
        let shots = plan.delays.iter().map(|delay| shot_of_option(&scene, &plan.blast_rows, delay)).collect();
        let breaking_force = plan.cable.breaking_force_kn * 1e3;
        let limits = Limits {
            height: plan.limits.flight_height_m,
            force: breaking_force / plan.limits.cable_safety_factor,
            drift: plan.limits.drift_m,
            breaking_force,
            accepted_risk: plan.limits.accepted_risk_percent * 1e-2,
            holes_in_8_ms: plan.limits.holes_in_8_ms,
            charge_in_8_ms: plan.limits.charge_in_8_ms_kg,
        };
        let (source, fingerprint, tires_by_place) = (PlanSource::default(), OnceLock::new(), OnceLock::new());
        let model = Model::new(scene);
        Self { source, plan, model, shots, limits, fingerprint, tires_by_place }
    }

    /// The same case, with this file and text of its plan.
    pub fn with_source(self, source: PlanSource) -> Self {
        Self { source, ..self }
    }

    /// The case with only these of its delay options, in this order.
    pub fn with_options(&self, options: &[usize]) -> Self {
        let delays = options.iter().map(|&n| self.plan.delays[n].clone()).collect();
        let shots = options.iter().map(|&n| self.shots[n].clone()).collect();
        Self {
            plan: Plan { delays, ..self.plan.clone() },
            shots,
            fingerprint: OnceLock::new(),
            ..self.clone()
        }
    }

    /// The case with runs of `duration_s` [s]; `None` means until everything is at rest.
    pub(in crate::study) fn with_duration(&self, duration_s: Option<f64>) -> Self {
        let mut case = Self { fingerprint: OnceLock::new(), ..self.clone() };
        case.plan.simulation.duration_s = duration_s;
        case
    }

    /// The case with another uncertainty.
    pub(in crate::study) fn with_uncertainty(&self, uncertainty: Uncertainty) -> Self {
        let plan = Plan { uncertainty, ..self.plan.clone() };
        Self { plan, fingerprint: OnceLock::new(), ..self.clone() }
    }

    /// Fingerprint of everything that the plan says.
    pub(in crate::study) fn fingerprint(&self) -> Fingerprint {
        *self.fingerprint.get_or_init(|| Fingerprint::of(&self.plan))
    }

    /// Title of the plan; the path of its file if the plan has no title.
    pub fn title(&self) -> Cow<'_, str> {
        self.plan.title.as_deref().map_or_else(|| self.source.name().into(), Cow::Borrowed)
    }

    /// The shot of blast rows fired in `order`, `interval` apart. The holes of each row fire as `holes` says.
    pub fn shot(&self, order: &[usize], interval: Time, holes: &HoleTiming) -> Shot {
        shot_in_order(self.scene(), &self.plan.blast_rows, order, interval, holes)
    }

    /// The shelter.
    pub fn scene(&self) -> &Scene {
        self.model.scene()
    }

    /// Settings of a run by `method` at `step` [s]. The run ends where the plan says.
    pub fn run_settings(&self, method: Method, step: f64) -> RunSettings {
        RunSettings { method, step, duration: self.plan.simulation.duration_s }
    }

    /// Number of tires that `method` integrates: the greatest number of all options. Mirror planes of shelter and shot make it
    /// smaller than the number of tires.
    pub fn modelled_tires(&self, method: Method) -> usize {
        self.shots.iter().map(|shot| self.model.modelled_tires(method, shot)).max().unwrap_or(0)
    }
}
