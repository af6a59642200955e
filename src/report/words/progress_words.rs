//! Progress of a study in words, the same in the terminal and on the command line.

use std::time::Duration;

use crate::study::work::progress::Progress;
use crate::units::rough_range;

/// Progress in words: `step 2 of 3, up to 10 s left, trying 42 ms`. Unknown parts are left out. The time left is known to a factor
/// of two; the text says the upper end.
pub fn describe(progress: &Progress, left: Option<Duration>) -> String {
    let step = (progress.steps > 1 && progress.step > 0)
        .then(|| format!("step {} of {}", progress.step, progress.steps));
    let left = left.map(|left| format!("up to {} left", at_most(left)));
    let trying = progress.trying.as_ref().map(|name| format!("trying {name}"));
    let parts: Vec<String> = step.into_iter().chain(left).chain(trying).collect();
    if parts.is_empty() { "computing".to_owned() } else { parts.join(", ") }
}

/// Upper end of the expected time `left`, in words.
pub fn at_most(left: Duration) -> String {
    let [_, most] = rough_range(left.as_secs_f64().max(1.0));
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_is_said() {
        let progress = Progress {
            fraction: 0.5,
            step: 2,
            steps: 3,
            trying: Some("42 ms".to_owned()),
            ..Progress::default()
        };
        let left = Some(Duration::from_secs(6));
        assert_eq!(describe(&progress, left), "step 2 of 3, up to 10 s left, trying 42 ms");
        assert_eq!(describe(&Progress::default(), None), "computing");
    }
}
