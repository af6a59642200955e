//! What was seen of earlier shots that speaks against the verdicts of a plan.

use std::collections::BTreeMap;

use super::contradiction::find_contradictions;
use super::other_shot::{OtherShot, other_shots};
use super::{Comparison, NotCompared, Objection, Told};
use crate::plan::observations::{MeasuredFiring, Observation, Observations};
use crate::study::fit::ComparedWithSeen;
use crate::study::fit::observation_bands::{Prediction, predict_observations};
use crate::study::fit::observed_shots::ObservedShots;
use crate::study::{Case, Context, NoResult};

/// Everything that speaks against a plan: what was `seen` of each shot, beside its prediction, the firing times that were `logged`,
/// and what the heads of the `files` say of their shots.
pub fn find_objections(
    case: &Case,
    seen: &[Vec<(Observation, Prediction)>],
    logged: &[MeasuredFiring],
    files: &[Observations],
) -> Vec<Objection> {
    let against = find_contradictions(case, seen, logged).into_iter().map(Objection::Contradiction);
    let others = other_shots(case, files).into_iter().filter(OtherShot::differs);
    against.chain(others.map(Objection::OtherShot)).collect()
}

/// What speaks against a plan of what was `seen` in these files, beside the predictions of it (`n_observations`).
pub fn objections_of_files(
    case: &Case,
    files: &[Observations],
    seen: &ObservedShots,
    predictions: &[Prediction],
) -> Vec<Objection> {
    let is_fitted = |file: usize| files[file].is_mostly_fitted(&case.plan.fitted_from);
    let shot = |n: usize| if is_fitted(seen.file[n]) { None } else { Some(seen.file[n]) };
    find_objections(case, &by_shot(&seen.list, predictions, shot), &seen.firings.concat(), files)
}

/// Observations beside their predictions, a list for each shot: for an option and a file. Observations that the plan was fitted to
/// agree with it by construction. They form one more list together, whose file is `None`, so that they hide no other shot.
fn by_shot(
    seen: &[Observation],
    predictions: &[Prediction],
    file: impl Fn(usize) -> Option<usize>,
) -> Vec<Vec<(Observation, Prediction)>> {
    let mut shots = BTreeMap::<Option<(usize, usize)>, Vec<_>>::new();
    for (n, (seen, prediction)) in seen.iter().zip(predictions).enumerate() {
        let shot = file(n).map(|file| (seen.option, file));
        shots.entry(shot).or_default().push((*seen, *prediction));
    }
    shots.into_values().collect()
}

/// Compares a plan with all that was told of earlier shots in the terminal, by samples of the plan.
pub fn compare_told(context: &Context<'_>, told: &Told) -> Comparison {
    if told.is_empty() {
        return Comparison::nothing_seen();
    }
    if told.has_unreadable() {
        return Comparison::not_compared(NotCompared::Unreadable);
    }
    let Ok(files) = told.read(context.case) else {
        return Comparison::not_compared(NotCompared::ToldInTerminal);
    };
    let seen = ObservedShots::new(&files);
    match predict_observations(context, &seen) {
        Ok(found) => Comparison::compared(objections_of_files(context.case, &files, &seen, &found)),
        Err(NoResult::OutOfTime) => Comparison::not_compared(NotCompared::OutOfTime),
        Err(_) => Comparison::not_compared(NotCompared::RunsFailed),
    }
}

impl ComparedWithSeen {
    /// What speaks against the plan that it is compared with.
    pub fn objections(&self, case: &Case) -> Vec<Objection> {
        objections_of_files(case, &self.files, &self.seen, &self.predictions)
    }
}
