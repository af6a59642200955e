//! Why an option or a study has no result, in words, with the remedy in words of the plan.

use crate::report::language::{phrase, say};
use crate::simulation::RunError;
use crate::study::NoResult;

/// Remedy for a run that failed at its step.
pub const REMEDY_IN_PLAN_WORDS: &str = "choose a finer accuracy or a smaller step";

/// Reason of a missing result, followed by the remedy if there is one.
pub fn message(no_result: &NoResult) -> String {
    let reason = reason(no_result);
    match remedy(no_result) {
        Some(remedy) => format!("{reason}: {}", phrase(remedy)),
        None => reason,
    }
}

/// What went wrong. A reason that no page can show stays in English.
fn reason(no_result: &NoResult) -> String {
    match no_result {
        NoResult::Failed(RunError::Step { step, limit, method }) => say!(
            "the step of {step} s is outside what {method} can follow here, 0 to {limit} s",
            step,
            method,
            format!("{limit:.3e}")
        ),
        NoResult::Failed(RunError::Effect { effect, method }) => {
            say!("{method} has no {effect}", method, phrase(effect))
        }
        NoResult::Failed(RunError::Diverged { time }) => {
            say!("the motion is no longer finite at {time} s", time)
        }
        NoResult::Failed(RunError::NotConverged { what, time }) => {
            say!("the {what} does not settle at {time} s", phrase(&what.to_string()), time)
        }
        NoResult::Failed(RunError::Stopped { time }) => say!("stopped at {time} s before the end", time),
        NoResult::OutOfTime => say!("not computed: ended early"),
        NoResult::Panicked(text) => say!("internal error: {text}", text),
        NoResult::NoThreads(text) => say!("no threads to compute on: {text}", text),
        other => other.to_string(),
    }
}

/// Remedy for a run that needs a finer step, and for a method that lacks an effect of the plan.
fn remedy(no_result: &NoResult) -> Option<&'static str> {
    match no_result {
        NoResult::Failed(failure) if failure.needs_finer_step() => Some(REMEDY_IN_PLAN_WORDS),
        NoResult::Failed(RunError::Effect { .. }) => Some("choose method \"verlet\", or leave it out"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Method;

    #[test]
    fn only_a_run_that_failed_by_itself_has_a_remedy() {
        let diverged = message(&NoResult::Failed(RunError::Diverged { time: 0.3 }));
        assert_eq!(
            diverged,
            "the motion is no longer finite at 0.3 s: choose a finer accuracy or a smaller step"
        );
        let lacking =
            message(&NoResult::Failed(RunError::Effect { effect: "push", method: Method::Newmark }));
        assert_eq!(lacking, "newmark has no push: choose method \"verlet\", or leave it out");
        assert_eq!(
            message(&NoResult::Failed(RunError::Stopped { time: 0.3 })),
            "stopped at 0.3 s before the end"
        );
    }
}
