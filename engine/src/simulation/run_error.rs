//! Failures of a run. A message says what is wrong; `report` adds the remedy.

use crate::choice::Method;

/// Reason why a run has no outcome.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The step is zero, negative, not finite, or too long for the method.
    #[error("the step of {step} s is outside what {method} can follow here, 0 to {limit:.3e} s")]
    Step {
        /// Step asked for [s].
        step: f64,
        /// Greatest stable step [s].
        limit: f64,
        /// Method asked for.
        method: Method,
    },
    /// The method lacks an effect that the scene has.
    #[error("{method} has no {effect}")]
    Effect {
        /// Name of the effect.
        effect: &'static str,
        /// Method asked for.
        method: Method,
    },
    /// The state is no longer finite.
    #[error("the motion is no longer finite at {time} s")]
    Diverged {
        /// Time of the step [s].
        time: f64,
    },
    /// An iteration did not converge within its bound.
    #[error("the {what} does not settle at {time} s")]
    NotConverged {
        /// The iteration.
        what: Iteration,
        /// Time of the step [s].
        time: f64,
    },
    /// The watcher stopped the run.
    #[error("stopped at {time} s before the end")]
    Stopped {
        /// Time of the step [s].
        time: f64,
    },
}

impl RunError {
    /// Whether a finer step may help.
    pub fn needs_finer_step(&self) -> bool {
        matches!(self, Self::Step { .. } | Self::Diverged { .. } | Self::NotConverged { .. })
    }
}

/// An iteration within a step of `newmark`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Iteration {
    /// Newton–Raphson for the balance of forces.
    Newton,
    /// Search for the contact region.
    ContactRegion,
}

impl std::fmt::Display for Iteration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Iteration::Newton => "Newton iteration",
            Iteration::ContactRegion => "contact region",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refused_step_names_the_method_as_it_is_spelled_and_no_flag() {
        let refused = |method| RunError::Step { step: 0.5, limit: 0.01, method }.to_string();
        let text = "the step of 0.5 s is outside what verlet can follow here, 0 to 1.000e-2 s";
        assert_eq!(refused(Method::Verlet), text);
        assert_eq!(refused(Method::Newmark), text.replace("verlet", "newmark"));
    }
}
