//! What was seen of earlier shots that speaks against the verdicts of a plan.

use crate::plan::observations::{MeasuredFiring, Observation};
use crate::study::fit::observation_bands::Prediction;

/// What speaks against the verdicts of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contradiction {
    /// A value over its limit.
    OverLimit {
        /// What was seen.
        seen: Observation,
        /// The limit [SI unit].
        limit: f64,
    },
    /// A value that is so unsure that it can speak against no plan: a slip of its unit, or no observation.
    SaysNothing {
        /// What was seen.
        seen: Observation,
    },
    /// A value that hardly any shot of the plan would show, beside so many others.
    FarOutside {
        /// What was seen.
        seen: Observation,
        /// 5th and 95th percentile of what could have been seen [SI unit]; not numbers where hardly any shot has a value.
        band: [f64; 2],
    },
    /// More values lie outside their bands than chance explains.
    Unpredicted {
        /// Number of these.
        outside: usize,
        /// Number of values that have a band.
        of: usize,
    },
    /// Shots lie to one side of what the plan predicts, all together, further than chance explains.
    ToOneSide {
        /// Number of these.
        shots: usize,
        /// Whether as those of faster launches do; what falls with the launch lies below then.
        is_faster: bool,
    },
    /// What was seen leaves faster launches possible than those that the plan judges.
    LeavesFaster {
        /// By how much the fastest one of a hundred launches is faster than planned: as what was seen leaves it, and as the plan judges it.
        faster: [f64; 2],
    },
    /// Shots differ by more than the plan says.
    Differ {
        /// Number of these.
        shots: usize,
    },
    /// Holes fired at times that the plan and its `[uncertainty]` leave no room for.
    FiredOtherwise {
        /// Number of these.
        far: usize,
        /// Number of logged firing times.
        logged: usize,
        /// The farthest of them.
        fired: MeasuredFiring,
        /// When its hole was planned to fire [s].
        planned: f64,
    },
}

/// How many observations lie in their bands, and how many have one; `None` where none has.
pub fn count_within(seen: &[(Observation, Prediction)]) -> Option<(usize, usize)> {
    let held = seen.iter().filter_map(|(seen, prediction)| prediction.contains(seen.value));
    let (within, of) = held.fold((0, 0), |(within, of), held| (within + usize::from(held), of + 1));
    (of > 0).then_some((within, of))
}
