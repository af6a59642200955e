//! What was seen of earlier shots, beside what the plan on the screen says of it.

use std::borrow::Cow;

use super::app::App;
use super::studies::ShownStudy;
use crate::report::fit::compared_rows;
use crate::report::observed::ObservedRow;
use crate::report::parts::Report;
use crate::study::FileState;
use crate::study::fit::ComparedWithSeen;
use crate::study::question::{Found, StudyKind};
use crate::study::seen::{Comparison, NotCompared};
use crate::study::standing::Standing;
use crate::study::standing::verdict_word::ThinPass;
use crate::verdict::{Verdict, VerdictWord};

impl App {
    /// The comparison on the screen, where it is one with this plan.
    pub fn compared_with_seen(&self) -> Option<&ComparedWithSeen> {
        match &self.studies.finished(StudyKind::Fit)?.found {
            Found::Fit(compared) => Some(&compared.value),
            _ => None,
        }
    }

    /// Whether the fit on the screen found estimates that the plan may take.
    pub fn has_estimates(&self) -> bool {
        self.studies.finished(StudyKind::Fit).is_some_and(|fit| fit.estimates(&self.case).is_ok())
    }

    /// What was seen, where it is compared with this plan.
    pub fn seen_rows(&self) -> Vec<ObservedRow<'_>> {
        self.compared_with_seen().map_or_else(Vec::new, |compared| compared_rows(&self.case, compared))
    }

    /// How the plan on the screen stands beside what was seen, as the fit found that compared them; that none has.
    fn comparison(&self) -> Comparison {
        let fit = self.studies.finished(StudyKind::Fit).and_then(|fit| fit.compared.clone());
        // Two plans side by side are of one site: what was seen there stands against either.
        let is_missing = fit.is_none() && !self.told.is_empty() || self.seen_beside;
        fit.unwrap_or_else(Comparison::nothing_seen).except(is_missing.then_some(NotCompared::NotYet))
    }

    /// How the plan on the screen stands.
    pub fn standing(&self) -> Standing {
        Standing::of(&self.case, self.file, self.comparison())
    }

    /// Whether passes do not stand, so that no number of the plan does.
    pub fn is_held(&self) -> bool {
        self.standing().against_passes().is_some()
    }

    /// How the plan on the screen stands, with how its file is at this moment: for what leaves the screen.
    pub fn standing_now(&self) -> Standing {
        Standing::of(&self.case, FileState::now(&self.case.source), self.comparison())
    }

    /// The verdict on an option, which is open where it is a pass that does not stand.
    pub fn verdict(&self, option: usize) -> Verdict {
        self.word(option).verdict()
    }

    /// Whether an option passes, and neither what was seen nor the file of the plan speaks against that; other draws may.
    pub fn is_pass_of_plan(&self, option: usize) -> bool {
        self.standing().verdict(self.options[option].verdict()) == Verdict::Pass
    }

    /// The verdict on an option as people read it: whether its pass is thin, and HOLD where it does not stand.
    pub fn word(&self, option: usize) -> VerdictWord {
        self.standing().word(self.judgement(option), self.stands_on(option))
    }

    /// What ends the pass of an option that stands and is thin.
    pub fn thin(&self, option: usize) -> Option<ThinPass> {
        let is_thin = self.word(option) == VerdictWord::Thin;
        self.judgement(option)
            .filter(|_| is_thin)
            .and_then(|judged| ThinPass::of(judged, self.stands_on(option)))
    }

    /// The report of a study as it is shown.
    pub fn report_of<'s>(&self, finished: &'s ShownStudy) -> Cow<'s, Report> {
        finished.report.under(&self.standing(), &finished.found)
    }
}
