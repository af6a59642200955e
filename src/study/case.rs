//! A plan made ready to run.

use std::path::Path;
use std::sync::OnceLock;

use super::work::{Fingerprint, NoResult};
use crate::choice::Method;
use crate::plan::names::look_alike;
use crate::plan::{DelayOption, Diagnostics, HoleTiming, Plan, PlanSource, Time, Timing, Uncertainty};
use crate::scene::{Scene, Shot};
use crate::simulation::{Model, RunSettings};
use crate::verdict::{Limits, Verdict};

/// What became of a plan's file since its text was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanFile {
    /// It holds that text.
    AsJudged,
    /// It says something else.
    Changed,
    /// It is not there: nobody can tell whether the plan is still that one.
    Gone,
}

/// A plan made ready to run.
#[derive(Clone, Debug)]
pub struct Case {
    /// File and text of the plan; empty where the program made the plan.
    pub source: PlanSource,
    /// Whether the file says by now what is judged: nothing is recommended where it says something else.
    pub file: PlanFile,
    /// Values of the plan.
    pub plan: Plan,
    /// The shelter, made ready for many runs.
    pub model: Model,
    /// Firing time and launch velocity of every hole, per delay option (`n_options`).
    pub shots: Vec<Shot>,
    /// Limits in SI units.
    pub limits: Limits,
    /// How the holes of each row fire in studies that vary order and interval: as in all options of the plan; `None` where the
    /// options differ, and such a study needs to be told.
    pub hole_timing: Option<HoleTiming>,
    /// Filled by [`Case::fingerprint`].
    pub(in crate::study) fingerprint: OnceLock<Fingerprint>,
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
        let scene = Scene::build(&plan);
        let shots = plan.delays.iter().map(|delay| Shot::new(&scene, &plan.blast_rows, delay)).collect();
        let hole_timing = plan.shared_hole_timing();
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
        let (source, fingerprint) = (PlanSource::default(), OnceLock::new());
        let model = Model::new(scene);
        Self { source, file: PlanFile::AsJudged, plan, model, shots, limits, hole_timing, fingerprint }
    }

    /// The same case, of a plan with this file and text.
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

    /// The case, followed for `duration_s` [s]; `None`: until all is at rest.
    pub(in crate::study) fn with_duration(&self, duration_s: Option<f64>) -> Self {
        let mut case = Self { fingerprint: OnceLock::new(), ..self.clone() };
        case.plan.simulation.duration_s = duration_s;
        case
    }

    /// The case, of which something else is known or not.
    pub(in crate::study) fn with_uncertainty(&self, uncertainty: Uncertainty) -> Self {
        let plan = Plan { uncertainty, ..self.plan.clone() };
        Self { plan, fingerprint: OnceLock::new(), ..self.clone() }
    }

    /// Fingerprint of all that the plan says.
    pub(in crate::study) fn fingerprint(&self) -> Fingerprint {
        *self.fingerprint.get_or_init(|| Fingerprint::of(&self.plan))
    }

    /// A verdict on everything asked for: no pass where the file of the plan has changed.
    pub fn verdict_on_file(&self, verdict: Verdict) -> Verdict {
        if self.file == PlanFile::Changed { verdict.max(Verdict::Undecided) } else { verdict }
    }

    /// Title of the plan; the path of its file where the plan has no title.
    pub fn title(&self) -> &str {
        self.plan.title.as_deref().unwrap_or(&self.source.path)
    }

    /// The shot of blast rows fired in `order`, `interval` apart, of a case that [`Case::require_hole_timing`] does not refuse.
    pub fn shot(&self, order: &[usize], interval: Time) -> Shot {
        let holes = self.shared_hole_timing();
        Shot::in_order(self.scene(), &self.plan.blast_rows, order, interval, &holes)
    }

    /// How the holes of each row fire in all options, of a case that [`Case::require_hole_timing`] does not refuse.
    pub(in crate::study) fn shared_hole_timing(&self) -> HoleTiming {
        debug_assert!(self.hole_timing.is_some(), "a study that varies the interval has to refuse this case");
        self.hole_timing.unwrap_or(HoleTiming::TOGETHER)
    }

    /// Refuses a study that varies order or interval, where the options differ in how the holes of a row fire.
    pub fn require_hole_timing(&self) -> Result<(), NoResult> {
        self.hole_timing.map(|_| ()).ok_or(NoResult::HolesDiffer)
    }

    /// The case with the holes of each row fired as in a delay option, where the options differ.
    pub fn with_hole_timing_defaulting_to(&self, option: usize) -> Self {
        Self { hole_timing: self.hole_timing.or(Some(self.plan.delays[option].hole_timing)), ..self.clone() }
    }

    /// The case with the holes of each row fired as in the delay option of this name, where there is one.
    pub fn with_hole_timing_of(&self, option: Option<&str>) -> Self {
        let alike = |name| self.plan.delays.iter().find(|delay| look_alike(&delay.name, name));
        let delay = option.and_then(alike);
        Self { hole_timing: delay.map(|delay| delay.hole_timing).or(self.hole_timing), ..self.clone() }
    }

    /// Intervals of the delay options whose holes fire as [`Case::hole_timing`] says, ascending, without repetitions.
    pub fn intervals(&self) -> Vec<Time> {
        let interval = |delay: &DelayOption| match delay.timing {
            Timing::Interval { interval, .. }
                if self.hole_timing.is_none_or(|holes| delay.hole_timing == holes) =>
            {
                Some(interval)
            }
            Timing::Interval { .. } | Timing::At(_) => None,
        };
        let mut all: Vec<Time> = self.plan.delays.iter().filter_map(interval).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The shelter.
    pub fn scene(&self) -> &Scene {
        self.model.scene()
    }

    /// Settings of a run by `method` at `step` [s], which ends where the plan says.
    pub fn run_settings(&self, method: Method, step: f64) -> RunSettings {
        RunSettings { method, step, duration: self.plan.simulation.duration_s }
    }

    /// Number of tires that `method` integrates: the greatest of all options. Mirror planes of shelter and shot make it
    /// smaller than the number of tires.
    pub fn modelled_tires(&self, method: Method) -> usize {
        self.shots.iter().map(|shot| self.model.modelled_tires(method, shot)).max().unwrap_or(0)
    }
}
