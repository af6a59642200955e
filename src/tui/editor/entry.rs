//! How the selected value is entered: by typing, by putting blast rows in order, or by choosing a name.

use crossterm::event::{KeyCode, KeyEvent};

use super::name_list::NameList;
use super::order_editor::OrderEditor;
use super::{EditOutcome, Editor, is_timing};
use crate::plan::Plan;
use crate::plan::edit::fields;
use crate::plan::keys::Kind;
use crate::tui::keymap::Action;
use crate::tui::typed_line::TypedLine;

/// How a value is being entered.
#[derive(Clone, Debug)]
pub enum Entry {
    /// It is typed; `copy_of` is the option of which a copy waits for its times.
    Typed { line: TypedLine, copy_of: Option<usize> },
    /// Blast rows are put in order.
    Order(OrderEditor),
    /// A name of the catalogue is chosen.
    Name(NameList),
}

impl Editor {
    /// The line being typed in place of the selected value.
    pub fn typed(&self) -> Option<&TypedLine> {
        self.entry
            .as_ref()
            .and_then(|entry| if let Entry::Typed { line, .. } = entry { Some(line) } else { None })
    }

    /// The option of which a copy waits for its times.
    pub fn copied(&self) -> Option<usize> {
        self.entry
            .as_ref()
            .and_then(|entry| if let Entry::Typed { copy_of, .. } = entry { *copy_of } else { None })
    }

    /// Begins to edit the selected value: by typing, by moving rows where the value is a firing order, or by choosing a name of the
    /// catalogue.
    pub fn begin(&mut self) {
        self.problem = None;
        let Some(field) = self.field() else { return };
        self.entry = match field.path.key.kind {
            Kind::RowNames => {
                let names = fields::order(&self.text, &field.path);
                (!names.is_empty()).then_some(Entry::Order(OrderEditor { names, selected: 0 }))
            }
            Kind::Catalogue(names) => Some(Entry::Name(NameList::new(names(), &unquoted(&field.value)))),
            // In a list people change one number.
            _ if field.value.starts_with('[') => Some(typed(TypedLine::keeping(&field.value))),
            _ => Some(typed(TypedLine::offering(&unquoted(&field.value)))),
        };
    }

    /// Begins to type the firing time of the blast row `row` of a delay option, the cursor behind it in the list; or the interval
    /// that all times follow from.
    pub fn begin_time(&mut self, option: usize, row: usize) {
        let Some(field) = self.times_of(option) else { return };
        self.selected = field;
        self.begin();
        let Some(Entry::Typed { line, .. }) = &mut self.entry else { return };
        // The times of a list stand between its commas.
        let ends = line.value().char_indices().filter(|(_, letter)| matches!(letter, ',' | ']'));
        let end = ends.map(|(at, _)| line.value()[..at].chars().count()).nth(row);
        line.input = end.map_or(line.input.clone(), |end| line.input.clone().with_cursor(end));
    }

    /// Handles a key while the user types; checks the value after every key.
    pub fn type_key(&mut self, key: &KeyEvent) -> EditOutcome {
        match key.code {
            KeyCode::Esc => {
                let copied = self.copied();
                self.end_typing();
                return copied.map_or(EditOutcome::None, |option| self.drop_copy(option));
            }
            KeyCode::Enter => return self.commit(),
            _ => {}
        }
        match &mut self.entry {
            Some(Entry::Name(names)) => {
                names.type_key(key);
                self.problem = None;
            }
            Some(Entry::Typed { line, .. }) => {
                if line.key(key) {
                    self.problem = self.candidate().err();
                }
            }
            Some(Entry::Order(_)) | None => {}
        }
        EditOutcome::None
    }

    /// Puts a pasted text into the value being typed, or among the letters of a name; returns a note where not all was taken.
    pub fn paste(&mut self, text: &str) -> Option<String> {
        match self.entry.as_mut()? {
            Entry::Name(names) => {
                names.selected = 0;
                names.letters.paste(text)
            }
            Entry::Typed { line, .. } => {
                let note = line.paste(text);
                self.problem = self.candidate().err();
                note
            }
            Entry::Order(_) => None,
        }
    }

    /// Does an action while blast rows are put in order.
    pub fn act_on_order(&mut self, action: Action) -> EditOutcome {
        let Some(Entry::Order(order)) = &mut self.entry else { return EditOutcome::None };
        match action {
            Action::Up => order.select(false),
            Action::Down => order.select(true),
            Action::Left => order.shift(false),
            Action::Right => order.shift(true),
            Action::Open => return self.commit(),
            _ => {}
        }
        EditOutcome::None
    }

    pub(super) fn end_typing(&mut self) {
        self.entry = None;
        self.problem = None;
    }

    /// Takes the copy of an option away again, as if it had not been made.
    fn drop_copy(&mut self, option: usize) -> EditOutcome {
        let outcome = self.undo();
        self.undone.pop();
        self.select_option(option);
        outcome
    }

    /// Text and plan with the typed value.
    fn candidate(&self) -> Result<(String, Plan), String> {
        let Some(field) = self.field() else { return Err("no value is selected".to_owned()) };
        let typed = match &self.entry {
            Some(Entry::Order(order)) => order.text(),
            Some(Entry::Name(names)) => names.name().ok_or("no name has these letters")?.to_owned(),
            Some(Entry::Typed { line, .. }) => line.value().to_owned(),
            None => return Err("nothing is typed".to_owned()),
        };
        self.with_value(&field.path, &typed)
    }

    fn commit(&mut self) -> EditOutcome {
        let (candidate, is_copy) = (self.candidate(), self.copied().is_some());
        if candidate.is_ok() {
            self.end_typing();
        }
        // One number typed for the times of an option makes them another field.
        let option = self.field().filter(|field| is_timing(field)).and_then(|field| field.path.index);
        let outcome = self.adopt_if_valid(candidate);
        if is_copy && matches!(outcome, EditOutcome::Changed(_)) {
            // Copy and times are one edit: undo leaves no option behind that nobody asked for.
            self.forget_edit_before();
        }
        self.selected = option.and_then(|option| self.times_of(option)).unwrap_or(self.selected);
        outcome
    }
}

fn typed(line: TypedLine) -> Entry {
    Entry::Typed { line, copy_of: None }
}

/// The text of a value as people type it: without the quotation marks and escapes of TOML.
fn unquoted(value: &str) -> String {
    let text = value.parse::<toml_edit::Value>().ok().and_then(|value| value.as_str().map(str::to_owned));
    text.unwrap_or_else(|| value.to_owned())
}
