//! A failed run in words, with the remedy on the command line.

use crate::simulation::Failure;

/// What is wrong, and what the user can do about it.
pub fn message(failure: &Failure) -> String {
    match remedy(failure) {
        Some(remedy) => format!("{failure}: {remedy}"),
        None => failure.to_string(),
    }
}

/// Remedy for a failed run; `None` for a run that was stopped.
fn remedy(failure: &Failure) -> Option<&'static str> {
    match failure {
        Failure::Step { .. } | Failure::Diverged { .. } | Failure::Unsettled { .. } => {
            Some("choose a smaller --dt")
        }
        Failure::Stopped { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_run_that_failed_by_itself_has_a_remedy() {
        let diverged = message(&Failure::Diverged { at: 0.3 });
        assert_eq!(diverged, "the motion is no longer finite at 0.3 s: choose a smaller --dt");
        assert_eq!(message(&Failure::Stopped { at: 0.3 }), "stopped at 0.3 s before the end");
    }
}
