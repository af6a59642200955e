//! How results are computed: method, accuracy, step.

use serde::{Deserialize, Serialize};

use crate::choice::{Accuracy, Method};
use crate::plan::Plan;
use crate::study::Case;

/// Method and accuracy of a computation: those of the plan, unless the user overrides them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComputeSettings {
    /// Time integration method.
    pub method: Method,
    /// Accuracy level; it sets the step at which refinement starts.
    pub accuracy: Accuracy,
    /// Fixed step [s]; `None`: the step follows from the accuracy and is refined.
    pub step: Option<f64>,
}

/// Factor on the step of a run by `method`: `newmark` errs more at the same step.
pub(in crate::study) fn step_factor(method: Method) -> f64 {
    match method {
        Method::Verlet => 1.0,
        Method::Newmark => 0.25,
    }
}

impl ComputeSettings {
    /// The settings that a plan asks for.
    pub fn of(plan: &Plan) -> Self {
        Self { method: plan.simulation.method, accuracy: plan.simulation.accuracy, step: None }
    }

    /// Follows a change of plan from `old` to `new`: a setting that the user has not overridden takes its value from `new`.
    pub fn adopt_changed_defaults(&mut self, old: &Plan, new: &Plan) {
        let (old, new) = (Self::of(old), Self::of(new));
        if self.method == old.method {
            self.method = new.method;
        }
        if self.accuracy == old.accuracy {
            self.accuracy = new.accuracy;
        }
    }

    /// Step of the first run of a case [s]: the fixed step, or the step at which refinement starts.
    ///
    /// Refinement starts at a fraction of the explicit stability limit, and at most at the step that resolves a landing.
    pub fn first_step(&self, case: &Case) -> f64 {
        if let Some(step) = self.step {
            return step;
        }
        let (fraction, longest): (f64, f64) = match self.accuracy {
            Accuracy::Draft => (0.2, 2e-3),
            Accuracy::Field => (0.1, 1e-3),
            Accuracy::Reference => (0.025, 2.5e-4),
        };
        step_factor(self.method) * longest.min(fraction * case.scene().critical_step())
    }
}
