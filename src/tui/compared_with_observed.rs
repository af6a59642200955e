//! The plan on the screen beside the observations of earlier shots.

use std::borrow::Cow;
use std::path::PathBuf;

use super::app::App;
use super::studies::ShownStudy;
use crate::plan::observations::names_of_films_not_given;
use crate::report::fit::compared_rows;
use crate::report::observed::ObservedRow;
use crate::report::parts::Report;
use crate::report::words::headline::Headline;
use crate::report::words::to_be_confirmed::{ToConfirm, is_anything_to_be_confirmed, to_be_confirmed};
use crate::study::FileState;
use crate::study::fit::ComparedWithObservations;
use crate::study::judge::Judgement;
use crate::study::observed::{Comparison, NotCompared};
use crate::study::question::{Found, StudyKind};
use crate::study::standing::Standing;
use crate::study::standing::verdict_word::ThinPass;
use crate::verdict::{Verdict, VerdictWord};

impl App {
    /// The comparison of the plan on the screen with the observations, if a fit has finished.
    pub fn compared_with_observed(&self) -> Option<&ComparedWithObservations> {
        match &self.studies.finished(StudyKind::Fit)?.found {
            Found::Fit(compared) => Some(&compared.value),
            _ => None,
        }
    }

    /// Whether the fit on the screen found estimates that the plan may take.
    pub fn has_estimates(&self) -> bool {
        self.studies.finished(StudyKind::Fit).is_some_and(|fit| fit.estimates(&self.case).is_ok())
    }

    /// The observations beside the predictions of this plan; empty if no comparison has finished.
    pub fn seen_rows(&self) -> Vec<ObservedRow<'_>> {
        self.compared_with_observed().map_or_else(Vec::new, |compared| compared_rows(&self.case, compared))
    }

    /// How the plan agrees with the observations, as found by the last fit; otherwise says that the comparison is missing.
    fn comparison(&self) -> Comparison {
        let fit = self.studies.finished(StudyKind::Fit).and_then(|fit| fit.compared.clone());
        // Two plans side by side are of one site, so the observations of one count against the other.
        let is_missing = fit.is_none() && !self.record.is_empty() || self.other_plan_has_more_observations;
        let taken_back = self.record.is_fitted_to_withdrawn(&self.case.plan);
        let compared = fit.unwrap_or_else(Comparison::nothing_seen);
        compared
            .with_other_blasts(self.record.other_blasts())
            .with_not_compared(taken_back.then_some(NotCompared::TakenBack))
            .with_not_compared(is_missing.then_some(NotCompared::NotYet))
    }

    /// The standing of the plan on the screen: what speaks against its passes.
    pub fn standing(&self) -> Standing {
        Standing::of(&self.case, self.file, self.comparison())
    }

    /// Whether the passes of the plan do not stand. Then no number of the plan stands.
    pub fn is_held(&self) -> bool {
        self.standing().against_passes().is_some()
    }

    /// The standing with the plan's file read at this moment. Use it for everything that leaves the screen.
    pub fn standing_now(&self) -> Standing {
        let given = self.record.read(&self.case).unwrap_or_default().into_iter().map(|file| file.path.into());
        let films = names_of_films_not_given(&self.case.source.path, &given.collect::<Vec<PathBuf>>());
        let compared = self.comparison().with_unread_films(films);
        Standing::of(&self.case, FileState::now(&self.case.source), compared)
    }

    /// The verdict on an option; a pass that does not stand counts as undecided.
    pub fn verdict(&self, option: usize) -> Verdict {
        self.word(option).verdict()
    }

    /// Whether an option passes and neither the observations nor the plan's file speak against it. Other draws may still fail.
    pub fn is_pass_of_plan(&self, option: usize) -> bool {
        self.standing().verdict(self.options[option].verdict()) == Verdict::Pass
    }

    /// The verdict on an option as people read it: THIN for a thin pass, HOLD for a pass that does not stand.
    pub fn word(&self, option: usize) -> VerdictWord {
        self.standing().word(self.judgement(option), self.stands_on_so_far(option))
    }

    /// What ends the pass of an option, if the pass stands and is thin.
    pub fn thin(&self, option: usize) -> Option<ThinPass> {
        let is_thin = self.word(option) == VerdictWord::Thin;
        self.judgement(option)
            .filter(|_| is_thin)
            .and_then(|judged| ThinPass::of(judged, self.stands_on_so_far(option)))
    }

    /// Index of the recommended option.
    pub fn recommended(&self) -> Option<usize> {
        self.answer.as_ref().and_then(Headline::option)
    }

    /// Index of the recommended option and what ends its pass, if the pass stands and is thin.
    pub fn thin_answer(&self) -> Option<(usize, ThinPass)> {
        let best = self.recommended()?;
        Some((best, self.thin(best)?))
    }

    /// Whether the first line names an option that passes although no page of this plan may permit firing.
    pub fn names_a_forbidden_pass(&self) -> bool {
        let standing = self.standing();
        let is_forbidden = standing.against_passes().is_none() && standing.against_plan().is_some();
        self.recommended().is_some() && is_forbidden
    }

    /// Whether the first line names an option that may be fired only after something is confirmed.
    pub fn names_a_pass_under_condition(&self) -> bool {
        let best = self.recommended().filter(|best| {
            [VerdictWord::Pass, VerdictWord::Thin].contains(&self.word(*best))
                && self.stands_on_so_far(*best).is_some()
        });
        let standing = self.standing();
        let is_permitted = standing.against_passes().is_none() && standing.against_plan().is_none();
        is_permitted && best.is_some_and(|best| self.is_under_condition(best))
    }

    /// Whether anything is to be confirmed before an option is fired.
    pub fn is_under_condition(&self, option: usize) -> bool {
        let files = || self.record.read(&self.case).unwrap_or_default();
        is_anything_to_be_confirmed(&self.case, self.with_judgement(option), files, &self.comparison())
    }

    /// An option with its judgement; `None` if it has none yet.
    pub(super) fn with_judgement(&self, option: usize) -> Option<(usize, &Judgement)> {
        Some((option, self.judgement(option)?))
    }

    /// What is to be confirmed before an option is fired.
    pub fn to_be_confirmed(&self, option: usize) -> Vec<ToConfirm> {
        let seen = self.record.read(&self.case).unwrap_or_default();
        to_be_confirmed(&self.case, self.with_judgement(option), &seen, &self.comparison())
    }

    /// Whether the first line is final: the assumptions of the recommended option are known. Without a recommended option: the assumptions
    /// of each option that passes.
    pub fn is_final(&self) -> bool {
        let is_found = |option: usize| self.stands_on(option).is_some();
        self.recommended().map_or_else(|| self.passing().all(is_found), is_found)
    }

    /// The report of a study as the screen shows it.
    pub fn report_of<'s>(&self, finished: &'s ShownStudy) -> Cow<'s, Report> {
        finished.report.under(&self.standing(), &finished.found)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::plan::PlanSource;
    use crate::plan::observations::Observations;
    use crate::study::as_planned::margin::LaunchMargin;
    use crate::study::fit::observation_bands::Prediction;
    use crate::study::fit::observed_shots::ObservedShots;
    use crate::study::fit::{Answer, Fit, FitResult, observable_names};
    use crate::study::judge::Judgement;
    use crate::study::standing::Hold;
    use crate::study::{Case, ComputeSettings, Computed};
    use crate::tui::compare::OptionState;
    use crate::tui::config::Config;
    use crate::tui::studies::StudyState;

    /// An app whose first option passes in the planned shot, with launches up to 3 % faster.
    fn app() -> App {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: "rows.toml".into(), text }).expect("a plan");
        let compute = ComputeSettings::of(&case.plan);
        let mut checked = case.check_as_planned(0, &compute).expect("a result");
        (checked.verdict, checked.reasons) = (Verdict::Pass, Vec::new());
        let launch_margin = Some(LaunchMargin::UpTo { rise: 0.03, above: Verdict::Fail });
        let judgement = Judgement { launch_margin, ..Judgement::of_planned_alone(checked) };
        let mut app = App::new(Arc::new(case), compute, &Config::default());
        app.options[0] = OptionState::Judged { judgement: Box::new(judgement), more_samples: false };
        app
    }

    /// Ends a fit that compares one value with a band from 1.6 to 1.8 m.
    fn compare(app: &mut App, value: f64, fitted: Option<FitResult>) {
        let text = format!("option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,{value},0.05\n");
        let files = vec![Observations::parse("film.csv", &text, &observable_names(&app.case)).expect("one")];
        let seen = ObservedShots::new(&files);
        let predictions =
            vec![Prediction { planned: 1.7, band: Some([1.6, 1.8]), middle: 1.7, ..Prediction::default() }];
        let new = Vec::new();
        let compared = ComparedWithObservations { fitted, new, files, seen, predictions, is_sampled: true };
        let found = Found::Fit(Box::new(Computed::complete(compared)));
        let shown = ShownStudy::new(&app.case, app.compute, found);
        app.studies.set(StudyKind::Fit, StudyState::Done(Arc::new(shown)));
    }

    /// Whether the passes are held. Asserts that all parts of the screen agree on that.
    fn is_held(app: &App) -> bool {
        let standing = app.standing();
        let held = [app.is_held(), !app.is_pass_of_plan(0), app.verdict(0) == Verdict::Undecided];
        let not_thin =
            [app.word(0) == VerdictWord::Hold, app.thin(0).is_none(), !standing.compared().agrees()];
        assert_eq!(held, not_thin);
        assert!(held == [held[0]; 3], "{held:?}");
        held[0]
    }

    #[test]
    fn a_pass_stands_once_a_fit_has_compared_all_that_was_seen_and_agrees() {
        let mut app = app();
        assert!(!is_held(&app), "nothing was seen");
        assert_eq!((app.thin(0), app.word(0)), (Some(ThinPass::PlannedAlone(0.03)), VerdictWord::Thin));
        let case = app.case.clone();
        assert_eq!(app.record.add_line(&case, 4, "3:1 1.7 0.05"), Ok(()));
        assert!(
            is_held(&app) && app.compared_with_observed().is_none() && app.seen_rows().is_empty(),
            "not yet"
        );
        compare(&mut app, 1.7, None);
        assert!(!is_held(&app) && app.compared_with_observed().is_some() && app.seen_rows().len() == 1);
        app.other_plan_has_more_observations = true;
        assert!(is_held(&app), "the plan beside has more that was seen");
        app.other_plan_has_more_observations = false;
        compare(&mut app, 2.2, None);
        assert!(is_held(&app), "it contradicts");
        app.record = Default::default();
        assert!(is_held(&app), "and does so whatever is told now");
    }

    /// Everything that leaves the screen checks the file again, whatever the screen shows.
    #[test]
    fn a_file_that_has_changed_holds_what_leaves_the_screen() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.toml");
        let mut app = app();
        std::fs::write(&path, &app.case.source.text).expect("written");
        Arc::make_mut(&mut app.case).source.path = path.clone();
        assert_eq!(app.standing_now().against_passes(), None);
        std::fs::write(&path, "another plan").expect("written");
        assert_eq!(app.standing_now().against_passes(), Some(Hold::FileChanged));
        assert_eq!(app.standing().against_passes(), None);
    }

    /// A page from the screen asks to confirm a film in the plan's folder of shots until the film is read, like a page of `report`.
    #[test]
    fn a_film_that_nobody_told_is_known_to_what_leaves_the_screen() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut app = app();
        Arc::make_mut(&mut app.case).source.path = folder.path().join("rows.toml");
        let film = folder.path().join("rows.shots/film.csv");
        std::fs::create_dir(film.parent().expect("a folder")).expect("made");
        let text = "option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,1.7,0.05\n";
        std::fs::write(&film, text).expect("written");
        let unread = |app: &App| app.standing_now().compared().unread_films().len();
        assert_eq!(unread(&app), 1);
        let case = app.case.clone();
        let name = film.to_str().expect("UTF-8");
        assert_eq!(app.record.add_file(&case, name, text, "2026-11-29"), Ok(()));
        assert_eq!(unread(&app), 0);
    }

    #[test]
    fn a_plan_may_take_what_a_fit_found_and_no_other() {
        let mut app = app();
        assert!(!app.has_estimates(), "no fit");
        compare(&mut app, 1.7, None);
        assert!(!app.has_estimates(), "a comparison alone");
        for is_converged in [true, false] {
            let answers = vec![Answer { is_converged, ..Answer::default() }];
            let fit = Fit { answers, ..Fit::default() };
            compare(&mut app, 1.7, Some(FitResult::Fitted(fit)));
            assert_eq!(app.has_estimates(), is_converged);
        }
    }
}
