//! Keys of the Plan screen: values and options.

use crate::plan::edit::fields::EditField;
use crate::plan::keys::plan;
use crate::report::words::plan_notes::launches_of_mass;
use crate::tui::app::{App, Request};
use crate::tui::editor::EditOutcome;
use crate::tui::editor::entry::Entry;
use crate::tui::keymap::Action;
use crossterm::event::{KeyCode, KeyEvent};

impl App {
    pub(super) fn act_on_plan(&mut self, action: Action) -> Request {
        let before = self.editor.field().cloned();
        let edit = match action {
            Action::Up => return self.select_field(-1),
            Action::Down => return self.select_field(1),
            Action::PageUp => return self.select_group(-1),
            Action::PageDown => return self.select_group(1),
            Action::First => return self.select_field(isize::MIN),
            Action::Last => return self.select_field(isize::MAX),
            Action::Open => {
                self.editor.begin();
                return Request::None;
            }
            Action::Left => self.editor.step(false),
            Action::Right => self.editor.step(true),
            Action::CommonBelow => self.editor.step_to_common(false),
            Action::CommonAbove => self.editor.step_to_common(true),
            Action::AddOption => return self.add_option(),
            Action::RemoveOption => self.editor.remove(),
            other => return self.act_anywhere(other),
        };
        self.took_value(before, edit)
    }

    /// Copies the selected delay option, selects the copy, and begins to type its interval.
    pub(super) fn add_option(&mut self) -> Request {
        let edit = self.editor.copy_option(self.selected);
        let request = self.edited(edit);
        self.follow_field();
        request
    }

    /// Removes the selected delay option.
    pub(super) fn remove_option(&mut self) -> Request {
        self.editor.select_option(self.selected);
        let edit = self.editor.remove();
        let request = self.edited(edit);
        self.notice = self.editor.problem.clone();
        request
    }

    /// Takes an edit of a value. Reports the change of the field since `before`, and of the launches that follow the mass of the tires.
    fn took_value(&mut self, before: Option<EditField>, edit: EditOutcome) -> Request {
        if matches!(edit, EditOutcome::None) {
            return Request::None;
        }
        let mass = self.case.plan.tire.mass_kg;
        let request = self.edited(edit);
        let new = self.case.plan.tire.mass_kg;
        let of_mass = self.editor.plan_of_file().filter(|_| new != mass);
        let told = of_mass.and_then(|file| launches_of_mass(&file, new));
        let told = told.or_else(|| self.editor.change_since(&before?));
        let typed = new != mass && self.editor.has_typed_launch();
        let told = told.map(|told| told + if typed { "; a typed one gets no slower" } else { "" });
        if let Some(told) = told {
            self.notice = Some(format!("{told} · {} takes it back", self.keymap.hint(Action::Undo)));
        }
        request
    }

    /// Selects the field `lines` further down, and the option that the field belongs to.
    pub(super) fn select_field(&mut self, lines: isize) -> Request {
        self.editor.select(lines);
        self.follow_field();
        Request::None
    }

    /// Selects the group `groups` further down, and the option that the group belongs to.
    fn select_group(&mut self, groups: isize) -> Request {
        self.editor.select_group(groups);
        self.follow_field();
        Request::None
    }

    /// Selects the option that the selected field belongs to.
    pub(super) fn follow_field(&mut self) {
        if let Some(field) = self.editor.field().filter(|field| field.path.section == plan::DELAY.name) {
            self.has_selected = true;
            self.selected = field.path.index.unwrap_or(0).min(self.options.len().saturating_sub(1));
        }
    }

    /// Passes a key to the value being typed, or to the list of blast rows being reordered.
    pub fn type_key(&mut self, key: &KeyEvent) -> Request {
        self.quit_warned = false;
        let (before, is_copy) = (self.editor.field().cloned(), self.editor.copied().is_some());
        let edit = match (&self.editor.entry, self.keymap.action(key)) {
            (Some(Entry::Order(_)), Some(action)) if key.code != KeyCode::Esc => {
                self.editor.act_on_order(action)
            }
            _ => self.editor.type_key(key),
        };
        let is_added = is_copy && matches!(edit, EditOutcome::Changed(_));
        let request = self.took_value(before.filter(|_| !is_added), edit);
        if is_added && let Some(delay) = self.case.plan.delays.get(self.selected) {
            self.notice =
                Some(format!("{} is added · {} takes it back", delay.name, self.keymap.hint(Action::Undo)));
        }
        self.follow_field();
        request
    }

    pub(super) fn edited(&mut self, edit: EditOutcome) -> Request {
        match edit {
            EditOutcome::None => Request::None,
            EditOutcome::Changed(plan) => self.take_edited(*plan),
        }
    }
}
