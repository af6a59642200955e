//! What was seen of earlier shots, beside what the plan on the screen says of it.

use super::app::App;
use crate::jobs::{ComparedWithSeen, StudyKind, StudyResult};
use crate::report::observed::{self, ObservedRow, observed_rows};
use crate::study::fit::FitResult;

/// What is said until a fit has compared what was seen with the plan on the screen.
const NOT_COMPARED: &str = "what was seen of earlier shots is not compared with this plan: see Studies, Fit";

impl App {
    /// The comparison on the screen, where it is one with this plan.
    pub fn compared_with_seen(&self) -> Option<&ComparedWithSeen> {
        match &*self.studies.finished(StudyKind::Fit)?.found {
            StudyResult::Fit(compared) => Some(compared),
            _ => None,
        }
    }

    /// What was seen, where it is compared with this plan: of shots that it is not fitted to yet, then of those that it is.
    pub fn seen_rows(&self) -> Vec<ObservedRow<'_>> {
        let Some(compared) = self.compared_with_seen() else { return Vec::new() };
        let new = match &compared.fitted {
            Some(FitResult::Fitted(fit)) => observed_rows(&self.case, &fit.observed, &fit.predictions),
            Some(FitResult::NotDetermined { observed, predictions, .. }) => {
                observed_rows(&self.case, observed, predictions)
            }
            Some(FitResult::KnownExactly(_) | FitResult::NotInMethod(_)) | None => Vec::new(),
        };
        let in_plan = observed_rows(&self.case, &compared.in_plan.list, &compared.predictions);
        new.into_iter().chain(in_plan).collect()
    }

    /// Whether all that was seen is compared with this plan.
    pub fn is_compared_with_seen(&self) -> bool {
        match self.compared_with_seen().map(|compared| &compared.fitted) {
            Some(Some(FitResult::KnownExactly(_) | FitResult::NotInMethod(_))) => false,
            Some(_) => true,
            None => self.observed.is_empty(),
        }
    }

    /// Why what was seen speaks against the verdicts on the screen: it contradicts them, or is not compared with this plan.
    pub fn contradiction(&self) -> Vec<String> {
        let not_compared = (!self.is_compared_with_seen()).then(|| NOT_COMPARED.to_owned());
        not_compared.into_iter().chain(observed::contradiction(&self.seen_rows())).collect()
    }
}
