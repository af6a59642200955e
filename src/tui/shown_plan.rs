//! Replaces the plan on the screen: by an edit here, by another program, or by the edits kept from the last session.

use std::path::Path;
use std::sync::Arc;

use super::app::{App, Request};
use super::compare::OptionState;
use super::editor::EditOutcome;
use super::keymap::Action;
use super::pace::Pace;
use crate::kept::Recovered;
use crate::plan::{Plan, PlanSource};
use crate::scene::Shot;
use crate::study::judge::Judgement;
use crate::study::judge::batch::Depth;
use crate::study::question::StudyKind;
use crate::study::{Case, ComputeSettings, FileState};

impl App {
    /// Drops the results of all options before all options are judged again.
    pub(super) fn forget_verdicts(&mut self) {
        self.options = vec![OptionState::Waiting; self.case.plan.delays.len()];
        self.assumptions = vec![None; self.options.len()];
        self.bands = vec![None; self.options.len()];
        self.answer = None;
        self.pace = Pace::default();
        self.page_warned = None;
        self.leave_estimates();
        self.player.recorded = None;
    }

    /// How far the options are judged. If the plan ever had several options, each needs fresh draws, also the last one left.
    pub fn depth(&self) -> Depth {
        if self.had_several { Depth::Chosen } else { Depth::Full }
    }

    /// The judgement on each option as far as known (`n_options`).
    pub fn known(&self) -> Vec<Option<Judgement>> {
        (0..self.options.len()).map(|option| self.judgement(option).cloned()).collect()
    }

    /// States of the options of the new plan `case` before it is judged (`n_options`). If the plans differ only in options, an option whose
    /// shot was judged before keeps everything that does not depend on other options.
    fn kept_of(&self, case: &Case, compute: ComputeSettings) -> Vec<OptionState> {
        let others = |plan: &Plan| Plan { delays: Vec::new(), ..plan.clone() };
        let is_alike = compute == self.compute && others(&case.plan) == others(&self.case.plan);
        let kept = |shot: &Shot| {
            let mut same = self.case.shots.iter().zip(&self.options).filter(|(before, _)| *before == shot);
            // The margin is computed after the samples, so an option with a margin has all its samples.
            let has_samples = |state: &OptionState, judged: &Judgement| {
                !state.is_sampling() || judged.launch_margin.is_some()
            };
            let judged =
                same.find_map(|(_, state)| state.judgement().filter(|judged| has_samples(state, judged)))?;
            let judgement = Box::new(self.depth().begin_again(case, judged.clone()));
            let grounds = judgement.grounds();
            let more_samples = grounds.awaits_one_dud() || grounds.awaits_confirmation();
            Some(OptionState::Judged { judgement, more_samples })
        };
        let state = |shot| kept(shot).filter(|_| is_alike).unwrap_or(OptionState::Waiting);
        case.shots.iter().map(state).collect()
    }

    /// Shows another plan and marks the studies as studies of the old plan.
    fn replace_plan(&mut self, case: Case) -> Request {
        let mut compute = self.compute;
        compute.adopt_changed_defaults(&self.case.plan, &case.plan);
        self.had_several |= case.shots.len() > 1;
        let options = self.kept_of(&case, compute);
        // The rows on the screen belong to options of the old plan.
        self.areas.clear();
        let moved = |option: usize| {
            let name = &self.case.plan.delays.get(option)?.name;
            case.plan.delays.iter().position(|delay| delay.name == *name)
        };
        self.fired = self.fired.and_then(moved);
        self.selected = moved(self.selected).unwrap_or(self.selected);
        (self.case, self.compute) = (Arc::new(case), compute);
        self.forget_verdicts();
        self.options = options;
        self.find_answer();
        self.selected = self.selected.min(self.options.len().saturating_sub(1));
        self.listing.baseline = None;
        self.studies.mark_as_of_plan_before(&self.case.source.text);
        self.find_differences();
        Request::JudgeNewPlan
    }

    /// Shows the plan of the editor's text.
    pub(super) fn take_edited(&mut self, plan: Plan) -> Request {
        let source = PlanSource { path: self.case.source.path.clone(), text: self.editor.text.clone() };
        self.replace_plan(Case::new(plan).with_source(source))
    }

    /// Restores unsaved observations and edits from the last session.
    pub fn restore_unsaved(&mut self, kept: Recovered) -> Request {
        let changed = !kept.are_of(self.editor.saved());
        let has_edits = kept.has_edits_of(&self.editor.text);
        let Recovered { text, record, time, .. } = kept;
        let undo = self.keymap.hint(Action::Undo);
        let mut news = Vec::new();
        let mut request = Request::None;
        self.record = record;
        if !self.record.is_empty() {
            request = self.begin_study(StudyKind::Fit);
            news.push(format!("observations of earlier shots, kept on {time}, are back"));
        }
        if has_edits && changed {
            // The new file is more recent than the edits, so it stays. Redo shows the edits.
            if self.editor.keep_older_edits(text) {
                let redo = self.keymap.hint(Action::Redo);
                news.push(format!(
                    "this is the file, which another program has changed since your edits of {time}; {redo} shows those"
                ));
            }
        } else if has_edits && let EditOutcome::Changed(plan) = self.editor.adopt(Ok(text)) {
            request = self.take_edited(*plan);
            news.push(format!("edits of {time} that were not saved are back; {undo} takes them away"));
        }
        if !news.is_empty() {
            self.notice = Some(news.join(" · "));
        }
        request
    }

    /// Takes the changed file: another plan, or the mistake in it.
    pub fn reload(&mut self, read: Result<Case, String>) -> Request {
        match read {
            Ok(case) if case.source.text == self.editor.saved() => {
                // The file was missing or wrong for a while, and is now as before.
                self.file = FileState::AsJudged;
                self.notice = None;
                Request::None
            }
            Ok(_) if self.is_changing() => {
                // Until the user has looked at both texts, no verdict here is a verdict on the file.
                self.file_is_newer = true;
                self.file = FileState::Changed;
                let why = match self.prompt {
                    // If the line vanished, the keys meant for it would act as commands.
                    Some(_) => "it is read once this line is done",
                    None => "your changes here are not saved",
                };
                self.notice = Some(format!("the file has changed; {why}"));
                Request::None
            }
            Ok(case) => {
                self.file = FileState::AsJudged;
                self.editor.reload(&case.source.text);
                self.notice = Some("the file has changed and was read again".to_owned());
                self.replace_plan(case)
            }
            Err(mistake) => {
                self.file = FileState::of(Path::new(&self.case.source.path), self.editor.saved());
                self.notice = Some(format!("{mistake}; the last good plan is shown"));
                Request::None
            }
        }
    }

    /// Whether the plan here differs from the saved plan, or the user is typing.
    pub fn is_changing(&self) -> bool {
        self.editor.unsaved() || self.editor.entry.is_some() || self.prompt.is_some()
    }

    /// Notes the path to which the plan was written, or the reason why it was not written.
    pub fn note_saved(&mut self, result: Result<String, String>) {
        self.notice = Some(match result {
            Ok(path) => {
                self.editor.set_saved(&self.editor.text.clone());
                self.file_is_newer = false;
                self.file = FileState::AsJudged;
                format!("saved {path}")
            }
            Err(reason) => format!("not saved: {reason}"),
        });
    }

    /// Whether another program has changed the file of the plan since the text here was read.
    pub fn leaves_a_changed_file(&self) -> bool {
        self.file == FileState::Changed || self.editor.is_older_than_file()
    }

    /// Notes that the plan now has another file.
    pub fn rename(&mut self, path: &Path) {
        if self.leaves_a_changed_file() && path != self.case.source.path {
            let old = Path::new(&self.case.source.path).file_name();
            self.left_file = old.map(|name| name.to_string_lossy().into_owned());
        }
        path.clone_into(&mut Arc::make_mut(&mut self.case).source.path);
    }
}
