//! Contradictions between observations of earlier shots and the verdicts of a plan.

use crate::plan::observations::{MeasuredFiring, Observation};
use crate::study::fit::observation_bands::Prediction;

/// A contradiction between observations and the verdicts of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contradiction {
    /// A value exceeds its limit.
    OverLimit {
        /// The observation.
        seen: Observation,
        /// The limit [SI unit].
        limit: f64,
    },
    /// A value is so unsure that it can contradict no plan: its unit is wrong, or it is no observation.
    SaysNothing {
        /// The observation.
        seen: Observation,
    },
    /// A value that hardly any shot of the plan would show, given the number of values.
    FarOutside {
        /// The observation.
        seen: Observation,
        /// 5th and 95th percentile of predicted observations [SI unit]; NaN if hardly any shot has a value.
        band: [f64; 2],
    },
    /// More values lie outside their bands than chance explains.
    Unpredicted {
        /// Number of values outside.
        outside: usize,
        /// Number of values that have a band.
        of: usize,
    },
    /// All shots together lie to one side of the prediction, further than chance explains.
    ToOneSide {
        /// Number of shots.
        shots: usize,
        /// Whether they lie on the side of faster launches. Values that fall with faster launches then lie below.
        is_faster: bool,
    },
    /// The observations leave faster launches possible than the plan judges.
    LeavesFaster {
        /// How much faster than planned the fastest 1 in 100 launches is, as a fraction: first by the observations, then by the plan.
        faster: [f64; 2],
    },
    /// Shots differ by more than the plan says.
    Differ {
        /// Number of shots.
        shots: usize,
    },
    /// Holes fired at times that the plan and its `[uncertainty]` leave no room for.
    FiredOtherwise {
        /// Number of such holes.
        far: usize,
        /// Number of logged firing times.
        logged: usize,
        /// The firing time farthest from the plan.
        fired: MeasuredFiring,
        /// Planned firing time of that hole [s].
        planned: f64,
    },
}

/// How many observations lie in their bands, and how many have a band; `None` if none has one.
pub fn count_within(seen: &[(Observation, Prediction)]) -> Option<(usize, usize)> {
    let held = seen.iter().filter_map(|(seen, prediction)| prediction.contains(seen.value));
    let (within, of) = held.fold((0, 0), |(within, of), held| (within + usize::from(held), of + 1));
    (of > 0).then_some((within, of))
}
