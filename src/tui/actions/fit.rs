//! The tab that fits the plan to observations of earlier shots: typed line by line, or read from files.

use std::path::Path;
use std::sync::Arc;

use crate::plan::PlanSource;
use crate::plan::observations::Observations;
use crate::plan::write_fit;
use crate::report::html::today;
use crate::study::Case;
use crate::study::observed::ObservationRecord;
use crate::study::question::StudyKind;
use crate::tui::app::{App, Request};
use crate::tui::fitted_plan::FittedPlan;
use crate::tui::keymap::Action;
use crate::tui::observation_line::{EXAMPLE_TIRE, observation_words};
use crate::tui::prompt::{Prompt, Purpose, best_matches};
use crate::tui::screen::Screen;
use crate::tui::studies::StudyState;
use crate::tui::typed_line::TypedLine;

impl App {
    /// Does an action of this tab. `None` for an action that every tab has.
    pub(super) fn act_on_fit(&mut self, action: Action) -> Option<Request> {
        match action {
            Action::Open => self.ask_fired_option(),
            Action::Rerun if self.record.is_empty() => {
                self.notice = Some("nothing was observed yet".to_owned());
            }
            Action::Cancel if !self.studies.is_running(StudyKind::Fit) => match self.record.last() {
                Some(_) => self.prompt = Some(Prompt::new(Purpose::Forget, TypedLine::default())),
                None if self.record.has_unreadable() => {
                    self.notice = Some("mend the file that is named, or move it away".to_owned());
                }
                None => self.notice = Some("nothing was observed yet".to_owned()),
            },
            _ => return None,
        }
        Some(Request::None)
    }

    /// Begins an observation. If the plan has several options, the first question is which option was fired. The option that was named
    /// last is selected; otherwise none is.
    fn ask_fired_option(&mut self) {
        let count = self.options.len();
        self.prompt = Some(match count {
            0 | 1 => Prompt::new(Purpose::Observe(0), TypedLine::default()),
            _ => Prompt {
                selected: self.fired.filter(|fired| *fired < count),
                ..Prompt::new(Purpose::Fired, TypedLine::default())
            },
        });
    }

    /// Indices of the options whose names match the typed letters, in order.
    pub fn fired_options(&self, letters: &str) -> Vec<usize> {
        best_matches(letters, &self.case.plan.delays, |delay| [delay.name.as_str(), ""])
    }

    /// Judges all options with the estimates in the plan; the question whether the plan takes them follows. Or says why there are none.
    pub(super) fn use_estimates(&mut self) -> Request {
        let finished = self.studies.finished(StudyKind::Fit);
        let estimates = match finished {
            Some(finished) => finished.estimates(&self.case),
            None => Err("nothing was fitted to this plan yet".to_owned()),
        };
        let (fit, files) = match estimates {
            Ok(estimates) => estimates,
            Err(why) => {
                self.notice = Some(format!("no estimate goes into the plan: {why}"));
                return Request::None;
            }
        };
        let checksums: Vec<String> = files.iter().flat_map(Observations::kept_by_fit).collect();
        let (before, fitted) = (&self.case.plan, fit.to_write());
        let path = &self.case.source.path;
        let fitted = write_fit::write(&self.editor.text, before, &fitted, &checksums).and_then(|text| {
            let source = PlanSource { path: path.clone(), text };
            Case::parse(source).map_err(|mistakes| mistakes.first())
        });
        match fitted {
            Ok(case) => {
                let n_observations = files.iter().map(|file| file.list.len()).sum();
                self.fitted_plan = Some(FittedPlan { case: Arc::new(case), n_observations, verdicts: None });
                self.begin_study(StudyKind::Check)
            }
            Err(mistake) => {
                self.notice = Some(mistake);
                Request::None
            }
        }
    }

    /// Puts the estimates into the plan. From then on the plan holds the observations.
    pub(super) fn take_estimates(&mut self) -> Request {
        let finished = self.studies.finished(StudyKind::Fit);
        let (Some(Ok((_, files))), Some(fitted)) =
            (finished.map(|finished| finished.estimates(&self.case)), self.fitted_plan.take())
        else {
            return Request::None;
        };
        self.record.close_typed(files);
        let edit = self.editor.adopt(Ok(fitted.case.source.text.clone()));
        let request = self.edited(edit);
        self.screen = Screen::Compare;
        let undo = self.keymap.hint(Action::Undo);
        self.notice = Some(format!("the launches of the fit are in the plan · {undo} takes it back"));
        request
    }

    /// Withdraws the last observation and compares the rest.
    pub(super) fn forget_last(&mut self) -> Request {
        let last = self.record.withdraw_last(&today());
        let fitted = match self.record.is_fitted_to_withdrawn(&self.case.plan) {
            true => {
                "; the plan's launches were fitted to it: undo that, or write those that you know without it"
            }
            false => "",
        };
        self.notice = last.map(|last| format!("no longer counted as seen: {last}{fitted}"));
        if self.record.is_empty() {
            self.studies.set(StudyKind::Fit, StudyState::Idle);
            return Request::None;
        }
        self.begin_study(StudyKind::Fit)
    }

    /// Takes a typed observation of a shot of `option`, or the name of a file of observations, and begins the fit.
    pub(super) fn observe(&mut self, option: usize, line: &str) -> Request {
        if line.to_lowercase().ends_with(".csv") {
            return Request::ReadObserved(line.into());
        }
        let case = self.case.clone();
        // The user must type which tire a height belongs to; the program never guesses.
        let tire = self.highest_tire(option).unwrap_or_else(|| EXAMPLE_TIRE.to_owned());
        let before = self.record.typed_shot_count();
        let taken = observation_words(line, &tire)
            .and_then(|words| self.record.add_line(&case, option, &words.join(" ")));
        let request = self.fit_if_taken(option, line, taken);
        if before > 0 && self.record.typed_shot_count() > before {
            let cancel = self.keymap.hint(Action::Cancel);
            self.notice = Some(format!(
                "counts as ANOTHER shot, seen beside the first: was it a slip? Once compared, {cancel} takes it back"
            ));
        }
        request
    }

    /// Adds the observations from the record on disk to this record, and compares all of them.
    pub(in crate::tui) fn merge_record(&mut self, there: ObservationRecord) -> Request {
        let before = std::mem::take(&mut self.record);
        // Drop the files that could not be read before. If a file still cannot be read, the other record says so.
        let other_blasts = there.other_blasts().to_vec();
        self.record = before.readable();
        self.record.join(there);
        let is_as_before = self.record == before;
        self.record = std::mem::take(&mut self.record).with_other_blasts(other_blasts);
        if is_as_before {
            return Request::None;
        }
        self.notice = Some("observations typed elsewhere count here, too".to_owned());
        if self.record.is_empty() { Request::None } else { self.begin_study(StudyKind::Fit) }
    }

    /// ID of the tire that rises highest in the planned shot of an option.
    pub fn highest_tire(&self, option: usize) -> Option<String> {
        let height = self.judgement(option)?.checked.estimates.height;
        (height.value > 0.0).then(|| self.case.scene().tire_ids[height.index].to_string())
    }

    /// Takes the text of a file of observations, or the reason why it cannot be read, and begins the fit.
    pub fn take_observed_file(&mut self, path: &Path, text: Result<String, String>) -> Request {
        let (case, name) = (self.case.clone(), path.to_string_lossy());
        let taken = text.and_then(|text| self.record.add_file(&case, &name, &text, &today()));
        self.fit_if_taken(self.fired.unwrap_or(self.selected), &name, taken)
    }

    /// Begins the fit. If `line`, about a shot of `option`, is no valid observation, the user edits the line again.
    fn fit_if_taken(&mut self, option: usize, line: &str, taken: Result<(), String>) -> Request {
        match taken {
            Ok(()) => {
                self.notice = None;
                self.begin_study(StudyKind::Fit)
            }
            Err(mistake) => {
                self.notice = Some(mistake);
                self.prompt = Some(Prompt::new(Purpose::Observe(option), TypedLine::keeping(line)));
                Request::None
            }
        }
    }
}
