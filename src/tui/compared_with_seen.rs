//! What was seen of earlier shots, beside what the plan on the screen says of it.

use std::borrow::Cow;

use super::app::App;
use super::studies::ShownStudy;
use crate::report::answer::hold;
use crate::report::fit::compared_rows;
use crate::report::observed::ObservedRow;
use crate::report::parts::Report;
use crate::study::fit::ComparedWithSeen;
use crate::study::fit::FitResult;
use crate::study::question::{Found, StudyKind};
use crate::study::standing::{Doubt, Standing};
use crate::verdict::Verdict;

/// What is said until a fit has compared what was seen with the plan on the screen.
const NOT_COMPARED: &str = "observations of earlier shots are not compared with this plan: see Studies, Fit";

impl App {
    /// The comparison on the screen, where it is one with this plan.
    pub fn compared_with_seen(&self) -> Option<&ComparedWithSeen> {
        match &self.studies.finished(StudyKind::Fit)?.found {
            Found::Fit(compared) => Some(&compared.value),
            _ => None,
        }
    }

    /// What was seen, where it is compared with this plan.
    pub fn seen_rows(&self) -> Vec<ObservedRow<'_>> {
        self.compared_with_seen().map_or_else(Vec::new, |compared| compared_rows(&self.case, compared))
    }

    /// Whether all that was seen is compared with this plan.
    pub fn is_compared_with_seen(&self) -> bool {
        match self.compared_with_seen().map(|compared| &compared.fitted) {
            Some(Some(FitResult::KnownExactly(_) | FitResult::NotInMethod(_))) => false,
            Some(_) => true,
            // Two plans side by side are of one site: what was seen there stands against either.
            None => self.observed.is_empty() && !self.seen_beside,
        }
    }

    /// Why what was seen speaks against the verdicts on the screen: it contradicts them, or is not compared with this plan.
    pub fn contradiction(&self) -> Vec<String> {
        let not_compared = (!self.is_compared_with_seen()).then(|| NOT_COMPARED.to_owned());
        let found = self.studies.finished(StudyKind::Fit).map(|finished| &finished.contradiction);
        not_compared.into_iter().chain(found.into_iter().flatten().cloned()).collect()
    }

    /// Whether passes on the screen stand: not where what was seen speaks against the verdicts.
    pub fn standing(&self) -> Standing {
        Standing::of(&self.case, self.is_contradicted())
    }

    /// The verdict on an option, which is open where it is a pass that does not stand.
    pub fn verdict(&self, option: usize) -> Verdict {
        self.standing().verdict(self.options[option].verdict())
    }

    /// A verdict in a word: HOLD for a pass that does not stand.
    pub fn word(&self, verdict: Verdict) -> &'static str {
        if self.standing().verdict(verdict) == verdict { verdict.for_people() } else { "HOLD" }
    }

    /// Whether what was seen speaks against the verdicts on the screen, or is not compared with this plan.
    pub fn is_contradicted(&self) -> bool {
        let speaks_against = |finished: &ShownStudy| !finished.contradiction.is_empty();
        let found = self.studies.finished(StudyKind::Fit).is_some_and(speaks_against);
        found || !self.is_compared_with_seen()
    }

    /// The report of a study as it is shown: where passes do not stand, nothing passes in it, and what chooses among options recommends
    /// nothing.
    pub fn report_of<'s>(&self, finished: &'s ShownStudy) -> Cow<'s, Report> {
        let mut report = Cow::Borrowed(&finished.report);
        let why = match self.standing().against_passes() {
            None => return report,
            Some(Doubt::FileChanged) => "the plan is no longer the one that was judged",
            Some(_) => "HOLD: observations of earlier shots speak against this plan",
        };
        hold(report.to_mut(), &finished.found, why);
        report
    }
}
