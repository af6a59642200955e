//! What was seen of earlier shots that speaks against the verdicts of a plan.

use serde::{Deserialize, Serialize};

use super::Case;
use super::fit::contradiction::{Contradiction, find_contradictions};
use super::fit::observation_bands::Prediction;
use super::fit::{ComparedWithSeen, FitResult};
use super::launch::other_shots::{OtherShot, other_shots};
use crate::plan::observations::{MeasuredFiring, Observation, Observations};

/// What speaks against the verdicts of a plan, of what was seen of earlier shots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objection {
    /// Values or firing times that the plan leaves no room for.
    Contradiction(Contradiction),
    /// It was seen of a shot with another charge, stemming or mass of tires.
    OtherShot(OtherShot),
    /// It is not compared with the plan.
    NotCompared(NotCompared),
}

/// Why observations are not compared with a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotCompared {
    /// The time was up before.
    OutOfTime,
    /// No fit of the terminal has compared them with the plan on the screen.
    NotFitted,
    /// They were typed in the terminal, and a command knows no more of them.
    TypedInTerminal,
}

/// What counted as seen once, and was taken back.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Withdrawn {
    /// What it was.
    pub what: String,
    /// The day on which it was taken back.
    pub day: String,
}

/// What speaks against a plan: of what was `seen`, beside what could have been seen, of firing times that were `logged`, and of the
/// shots that the `files` are of.
pub fn find_objections(
    case: &Case,
    seen: Vec<(Observation, Prediction)>,
    logged: &[MeasuredFiring],
    files: &[Observations],
) -> Vec<Objection> {
    let against = find_contradictions(case, seen, logged).into_iter().map(Objection::Contradiction);
    let others = other_shots(case, files).into_iter().filter(OtherShot::differs);
    against.chain(others.map(Objection::OtherShot)).collect()
}

impl ComparedWithSeen {
    /// Whether all that was seen is compared with the plan.
    pub fn is_complete(&self) -> bool {
        !matches!(self.fitted, Some(FitResult::KnownExactly(_) | FitResult::NotInMethod(_)))
    }

    /// What speaks against the plan that it is compared with.
    pub fn objections(&self, case: &Case) -> Vec<Objection> {
        let not_compared = (!self.is_complete()).then_some(Objection::NotCompared(NotCompared::NotFitted));
        let seen = self.seen().map(|(seen, prediction)| (*seen, *prediction)).collect();
        not_compared.into_iter().chain(find_objections(case, seen, &self.logged(), &self.new)).collect()
    }
}
