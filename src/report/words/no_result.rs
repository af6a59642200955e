//! Why an option or a study has no result, in words, with the remedy in words of the plan.

use crate::simulation::RunError;
use crate::study::NoResult;

/// Remedy for a run that failed at its step.
pub const REMEDY_IN_PLAN_WORDS: &str = "choose a finer accuracy or a smaller step";

/// Reason of a missing result, followed by the remedy if there is one.
pub fn message(no_result: &NoResult) -> String {
    match remedy(no_result) {
        Some(remedy) => format!("{no_result}: {remedy}"),
        None => no_result.to_string(),
    }
}

/// Remedy for a run that failed by itself, and for a plan that lacks what the study needs.
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
