//! Predictions of a plan for observed quantities, at given values of the parameters.

use std::ops::ControlFlow;

use super::observation_recorder::ObservationRecorder;
use super::observed_shots::ObservedShot;
use super::parameter::Parameter;
use crate::choice::ObservedQuantity;
use crate::outcome::EndReason;
use crate::plan::Plan;
use crate::plan::observations::ObservedPoint;
use crate::scene::{Scene, Shot};
use crate::simulation::{Motion, RunSettings};
use crate::study::{Case, ComputeSettings, NoResult, StudyControl};

/// Quantities watched in the shots of a plan, and the parameters that change them.
pub struct Predictor<'p> {
    /// The plan. Its parameters are replaced.
    pub plan: Plan,
    /// The parameters, in the order of their coordinates.
    pub parameters: Vec<Parameter>,
    /// The shots, and the points watched in each.
    pub shots: Vec<ObservedShot>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
    /// Progress of the study, and whether it goes on.
    pub control: &'p StudyControl,
}

impl Predictor<'_> {
    /// The plan with the parameters at these coordinates, ready to run.
    pub fn case(&self, at: &[f64]) -> Case {
        let mut plan = self.plan.clone();
        for (parameter, &coordinate) in self.parameters.iter().zip(at) {
            parameter.set_in(&mut plan, coordinate);
        }
        Case::new(plan)
    }

    /// The values of all watched points, shot by shot, at `coarser` times the usual step; `None` if a run fails.
    pub fn values(&self, at: &[f64], coarser: f64) -> Result<Option<Vec<f64>>, NoResult> {
        let case = self.case(at);
        let mut all = Vec::new();
        for ObservedShot { option, times, watched, .. } in &self.shots {
            let step = coarser * self.compute.first_step(&case);
            let settings = case.run_settings(self.compute.method, step);
            let shot = case.shots[*option].with_times(times);
            let run = observe_shot(&case, None, &shot, watched, &settings, self.control)?;
            let Some(values) = run else { return Ok(None) };
            all.extend(values);
        }
        Ok(Some(all))
    }
}

/// The values of the watched points in one shot, under the scene `variant` if there is one; `None` if the run fails.
pub fn observe_shot(
    case: &Case,
    variant: Option<&Scene>,
    shot: &Shot,
    watched: &[ObservedPoint],
    settings: &RunSettings,
    control: &StudyControl,
) -> Result<Option<Vec<f64>>, NoResult> {
    // A run begins at time 0. If a hole fires earlier, all times move later here, and back in the values.
    let early = shot.firings.first().map_or(0.0, |firing| -firing.time.min(0.0));
    let shot = &shot.later_by(early);
    let later = |watched: &ObservedPoint| ObservedPoint { time: watched.time + early, ..*watched };
    let moved: Vec<ObservedPoint> = watched.iter().map(later).collect();
    let mut watch = ObservationRecorder::new(&moved);
    let mut look = |motion: &dyn Motion| -> ControlFlow<()> {
        watch.observe(motion);
        control.keep_going()
    };
    let done = match variant {
        Some(variant) => case.model.run_variant(variant, shot, settings, &mut look),
        None => case.model.run(shot, settings, &mut look),
    };
    match done.map_err(|failure| control.no_result(failure)) {
        Ok(outcome) => {
            let mut values = watch.values(outcome.end.reason == EndReason::AtRest);
            for (value, watched) in values.iter_mut().zip(watched) {
                if matches!(watched.quantity, ObservedQuantity::Lift | ObservedQuantity::Landing) {
                    *value -= early;
                }
            }
            Ok(Some(values))
        }
        Err(NoResult::Failed(_)) => Ok(None),
        Err(ended) => Err(ended),
    }
}
