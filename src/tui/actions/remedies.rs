//! The list of changes with which an option would pass: opens the list, moves in the list, makes one change.

use crate::plan::edit::change::Change;
use crate::report::remedies::words;
use crate::report::words::assumption_words::holds;
use crate::study::question::StudyKind;
use crate::study::remedies::Remedies;
use crate::tui::app::{ASSUMPTIONS_STILL_SOUGHT, App, NOT_JUDGED_YET, Request, STILL_LOOKED_FOR};
use crate::tui::compare::OptionState;
use crate::tui::keymap::Action;
use crate::tui::studies::RemedyList;
use crate::verdict::Verdict;

impl App {
    /// The changes with which the selected option would pass and the selected line, once the list is open and computed.
    pub fn open_remedies(&self) -> Option<(&Remedies, Option<usize>)> {
        let list = self.studies.remedy_list.filter(|list| list.option == self.selected)?;
        let remedies = self.studies.remedies(self.selected, &self.compute)?;
        Some((remedies, list.selected.filter(|&n| n < remedies.passing().count())))
    }

    /// Whether the list has changes and none of them is selected yet.
    pub fn awaits_selection(&self) -> bool {
        self.open_remedies()
            .is_some_and(|(remedies, selected)| selected.is_none() && remedies.passing().next().is_some())
    }

    /// Whether the list of the selected option is open, computed or not.
    pub fn lists_remedies(&self) -> bool {
        self.studies.remedy_list.is_some_and(|list| list.option == self.selected)
    }

    /// Why the selected option, which passes, has no list of changes: says how far its pass holds.
    fn needs_no_remedy(&self) -> String {
        let name = &self.case.plan.delays[self.selected].name;
        match self.stands_on(self.selected) {
            _ if !self.is_pass_of_plan(self.selected) => {
                format!("{name}: its pass does not stand, and no change of the plan alone mends that")
            }
            Some(found) => format!("{name} {}", holds(found)),
            None => format!("{name} passes; {ASSUMPTIONS_STILL_SOUGHT}"),
        }
    }

    /// Opens the list of the selected option and begins its study if it has not run. Closes the list if it is open.
    pub(super) fn ask_for_remedies(&mut self) -> Request {
        let option = self.selected;
        let list = RemedyList { option, selected: None };
        if self.lists_remedies() {
            self.studies.remedy_list = None;
            return self.cancel_study(StudyKind::Remedies);
        }
        let state = &self.options[option];
        let refusal = match (state, state.verdict()) {
            (OptionState::Waiting | OptionState::Running { .. }, _) => Some(NOT_JUDGED_YET.to_owned()),
            (OptionState::Failed(_), _) => Some("the option has no result".to_owned()),
            (_, Verdict::Pass) => Some(self.needs_no_remedy()),
            (_, Verdict::Undecided) if state.is_sampling() => Some(NOT_JUDGED_YET.to_owned()),
            _ => None,
        };
        if refusal.is_some() {
            self.notice = refusal;
            return Request::None;
        }
        self.studies.remedy_list = Some(list);
        if self.studies.remedies(option, &self.compute).is_some() {
            return Request::None;
        }
        self.begin_study(StudyKind::Remedies)
    }

    /// Handles Enter while no change is selected: makes no change that the user has not seen. `None` if a change may be made.
    fn take_nothing_unseen(&mut self) -> Option<Request> {
        if !self.lists_remedies() {
            return None;
        }
        if self.awaits_selection() {
            let [up, down] = [Action::Up, Action::Down].map(|action| self.keymap.hint(action));
            self.notice = Some(format!("select a change with {up} {down} first"));
        } else if self.open_remedies().is_some() {
            return None;
        } else if self.studies.is_running(StudyKind::Remedies) {
            self.notice = Some(STILL_LOOKED_FOR.to_owned());
        } else {
            self.studies.remedy_list = None;
        }
        Some(Request::None)
    }

    /// Does an action on the open list. `None` if the action is not for the list.
    pub(super) fn act_on_remedies(&mut self, action: Action) -> Option<Request> {
        if matches!(action, Action::Open | Action::Try)
            && let Some(refused) = self.take_nothing_unseen()
        {
            return Some(refused);
        }
        let (remedies, selected) = self.open_remedies()?;
        let last = remedies.passing().count().checked_sub(1)?;
        let selected = match action {
            Action::Up => selected.map_or(last, |selected| selected.saturating_sub(1)),
            Action::Down => selected.map_or(0, |selected| (selected + 1).min(last)),
            Action::First | Action::PageUp => 0,
            Action::Last | Action::PageDown => last,
            Action::Open | Action::Try => {
                let change = remedies.passing().nth(selected?)?.change;
                if matches!(change, Change::Launch(_)) {
                    // Editing a number in the plan does not reduce the charge.
                    self.notice = Some(
                        "launches follow from the charge: film a shot of a smaller one, and type the observation"
                            .to_owned(),
                    );
                    return Some(Request::None);
                }
                let words = words(&self.case, &change);
                let edit = self.editor.adopt(change.apply(&self.editor.text));
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
        self.studies.remedy_list = Some(RemedyList { option: self.selected, selected: Some(selected) });
        Some(Request::None)
    }
}
