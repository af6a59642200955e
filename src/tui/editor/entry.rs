//! Ways to enter the selected value: type it, put blast rows in order, or choose a name.

use crossterm::event::{KeyCode, KeyEvent};

use super::name_list::NameList;
use super::order_editor::OrderEditor;
use super::{EditOutcome, Editor, is_timing};
use crate::plan::Plan;
use crate::plan::edit::fields;
use crate::plan::keys::Kind;
use crate::tui::keymap::Action;
use crate::tui::typed_line::TypedLine;

/// The way in which a value is being entered.
#[derive(Clone, Debug)]
pub enum Entry {
    /// The user types the value. `copy_of` is the index of a copied option, if the copy waits for its times.
    Typed { line: TypedLine, copy_of: Option<usize> },
    /// The user puts blast rows in order.
    Order(OrderEditor),
    /// The user chooses a name from the catalogue.
    Name(NameList),
}

impl Editor {
    /// The line being typed in place of the selected value.
    pub fn typed(&self) -> Option<&TypedLine> {
        self.entry
            .as_ref()
            .and_then(|entry| if let Entry::Typed { line, .. } = entry { Some(line) } else { None })
    }

    /// Index of the copied option whose copy waits for its times.
    pub fn copied(&self) -> Option<usize> {
        self.entry
            .as_ref()
            .and_then(|entry| if let Entry::Typed { copy_of, .. } = entry { *copy_of } else { None })
    }

    /// Begins to edit the selected value: the user types it, moves the rows of a firing order, or chooses a name from the catalogue.
    pub fn begin(&mut self) {
        self.problem = None;
        let Some(field) = self.field() else { return };
        self.entry = match field.path.key.kind {
            Kind::RowNames => {
                let names = fields::order(&self.text, &field.path);
                (!names.is_empty()).then_some(Entry::Order(OrderEditor { names, selected: 0 }))
            }
            Kind::Catalogue(names) => Some(Entry::Name(NameList::new(names(), &unquoted(&field.value)))),
            // In a list, people usually change one number.
            _ if field.value.starts_with('[') => Some(typed(TypedLine::keeping(&field.value))),
            _ => Some(typed(TypedLine::offering(&unquoted(&field.value)))),
        };
    }

    /// Begins to type the firing time of blast row `row` of a delay option. In a list of times, the cursor stands behind this time. If one
    /// interval sets all times, the user types the interval.
    pub fn begin_time(&mut self, option: usize, row: usize) {
        let Some(field) = self.times_of(option) else { return };
        self.selected = field;
        self.begin();
        let Some(Entry::Typed { line, .. }) = &mut self.entry else { return };
        // Commas separate the times of a list.
        let ends = line.value().char_indices().filter(|(_, letter)| matches!(letter, ',' | ']'));
        let end = ends.map(|(at, _)| line.value()[..at].chars().count()).nth(row);
        line.input = end.map_or(line.input.clone(), |end| line.input.clone().with_cursor(end));
    }

    /// Handles a key while the user types. Checks the value after every key.
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

    /// Puts a pasted text into the value being typed, or into the letters of a name. Returns a note if part of the text was dropped.
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

    /// Does an action while the user puts blast rows in order.
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

    /// Removes the copy of an option again, as if the option had never been copied.
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
        // If the user types one number for the times of an option, the times become another field.
        let option = self.field().filter(|field| is_timing(field)).and_then(|field| field.path.index);
        let outcome = self.adopt_if_valid(candidate);
        if is_copy && matches!(outcome, EditOutcome::Changed(_)) {
            // Copy and times are one edit: undo must not leave an option that nobody asked for.
            self.forget_edit_before();
        }
        self.selected = option.and_then(|option| self.times_of(option)).unwrap_or(self.selected);
        outcome
    }
}

fn typed(line: TypedLine) -> Entry {
    Entry::Typed { line, copy_of: None }
}

/// The text of a value without the quotation marks and escapes of TOML, as people type it.
fn unquoted(value: &str) -> String {
    let text = value.parse::<toml_edit::Value>().ok().and_then(|value| value.as_str().map(str::to_owned));
    text.unwrap_or_else(|| value.to_owned())
}
