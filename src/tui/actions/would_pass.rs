//! The list of changes with which an option would pass: asked for, walked, and one of them made.

use crate::jobs::StudyKind;
use crate::report::would_pass::words;
use crate::study::would_pass::WouldPass;
use crate::tui::app::{App, Request};
use crate::tui::compare::OptionState;
use crate::tui::keymap::Action;
use crate::tui::studies::ChangeList;
use crate::verdict::Verdict;

impl App {
    /// The changes with which the selected option would pass, and the line selected, where the list is open and computed.
    pub fn open_changes(&self) -> Option<(&WouldPass, usize)> {
        let list = self.studies.changes.filter(|list| list.option == self.selected)?;
        let would_pass = self.studies.would_pass(self.selected, &self.compute)?;
        Some((would_pass, list.selected.min(would_pass.passing().count().saturating_sub(1))))
    }

    /// Opens the list of the selected option, and asks for the study behind it where that has not run; closes an open list.
    pub(super) fn ask_for_changes(&mut self) -> Request {
        let option = self.selected;
        let list = ChangeList { option, selected: 0 };
        if self.studies.changes.is_some_and(|open| open.option == option) {
            self.studies.changes = None;
            return self.cancel_study(StudyKind::WouldPass);
        }
        let state = &self.options[option];
        let refusal = match (state, state.verdict()) {
            (OptionState::Waiting | OptionState::Running { .. }, _) => "the option is not judged yet",
            (OptionState::Failed(_), _) => "the option has no result",
            (_, Verdict::Pass) => "the option passes",
            (_, Verdict::Undecided) if state.is_sampling() => {
                "the option is not judged yet: more samples come"
            }
            _ => "",
        };
        if !refusal.is_empty() {
            self.notice = Some(refusal.to_owned());
            return Request::None;
        }
        self.studies.changes = Some(list);
        if self.studies.would_pass(option, &self.compute).is_some() {
            return Request::None;
        }
        self.begin_study(StudyKind::WouldPass)
    }

    /// Does an action on the open list; `None` where the action is not for the list.
    pub(super) fn act_on_changes(&mut self, action: Action) -> Option<Request> {
        let (would_pass, selected) = self.open_changes()?;
        let last = would_pass.passing().count().checked_sub(1)?;
        let selected = match action {
            Action::Up => selected.saturating_sub(1),
            Action::Down => (selected + 1).min(last),
            Action::First => 0,
            Action::Last => last,
            Action::Open => {
                let change = would_pass.passing().nth(selected)?.change;
                let words = words(&self.case, &change);
                let edit = self.editor.take(change.apply(&self.editor.text));
                let request = self.edited(edit);
                let undo = self.keymap.hint(Action::Undo);
                self.notice = Some(match &self.editor.problem {
                    Some(problem) => problem.clone(),
                    None => format!("{words}; {undo} takes it back"),
                });
                return Some(request);
            }
            _ => return None,
        };
        self.studies.changes = Some(ChangeList { option: self.selected, selected });
        Some(Request::None)
    }
}
