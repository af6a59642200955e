//! What the samples of a shot tell, and the rule by which they and the shot as planned make one verdict.

use crate::verdict::Verdict;

/// What the samples of a shot tell, where they were asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampled<R> {
    /// Only the shot as planned was asked for.
    NotAsked,
    /// Samples were asked for, and none was drawn.
    NotDrawn,
    /// What the samples tell.
    Drawn(R),
}

impl<R> Sampled<R> {
    /// What the samples tell; `None` where none were asked for, or none was drawn.
    pub fn drawn(&self) -> Option<&R> {
        match self {
            Sampled::Drawn(told) => Some(told),
            Sampled::NotAsked | Sampled::NotDrawn => None,
        }
    }

    /// Whether samples were asked for.
    pub fn is_asked(&self) -> bool {
        !matches!(self, Sampled::NotAsked)
    }

    /// The same with `change` of what the samples tell.
    pub fn map<'r, T>(&'r self, change: impl FnOnce(&'r R) -> T) -> Sampled<T> {
        match self {
            Sampled::NotAsked => Sampled::NotAsked,
            Sampled::NotDrawn => Sampled::NotDrawn,
            Sampled::Drawn(told) => Sampled::Drawn(change(told)),
        }
    }
}

/// The verdict on a shot, from the verdicts on the shot as planned and on its samples: the worse of both. Where samples were asked
/// for and none was drawn, the verdict is no pass.
pub fn verdict_of_both(as_planned: Verdict, samples: Sampled<Verdict>) -> Verdict {
    match samples {
        Sampled::NotAsked => as_planned,
        Sampled::NotDrawn => as_planned.max(Verdict::Undecided),
        Sampled::Drawn(sampled) => as_planned.max(sampled),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_pass_of_all_that_was_asked_for_is_a_pass() {
        use Verdict::{Fail, Pass, Undecided};
        for as_planned in [Pass, Undecided, Fail] {
            assert_eq!(verdict_of_both(as_planned, Sampled::NotAsked), as_planned);
            assert_eq!(verdict_of_both(as_planned, Sampled::Drawn(Pass)), as_planned);
            assert_eq!(verdict_of_both(as_planned, Sampled::Drawn(Fail)), Fail);
        }
        for samples in [Sampled::NotDrawn, Sampled::Drawn(Undecided)] {
            assert_eq!(
                [Pass, Undecided, Fail].map(|planned| verdict_of_both(planned, samples)),
                [Undecided, Undecided, Fail]
            );
        }
    }
}
