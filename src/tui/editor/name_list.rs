//! The list of names that a value may have, found by typing letters: ropes and terminations from the catalogue.

use crossterm::event::{KeyCode, KeyEvent};

use crate::tui::prompt::best_matches;
use crate::tui::typed_line::TypedLine;

/// An open list of names.
#[derive(Clone, Debug)]
pub struct NameList {
    /// Every name.
    pub names: Vec<&'static str>,
    /// Letters typed by the user.
    pub letters: TypedLine,
    /// Index of the selected name among the matches.
    pub selected: usize,
}

impl NameList {
    /// A list in which `name` is selected.
    pub fn new(names: Vec<&'static str>, name: &str) -> Self {
        let selected = names.iter().position(|known| *known == name).unwrap_or(0);
        Self { names, letters: TypedLine::default(), selected }
    }

    /// The names that match the typed letters, best match first. All names if nothing is typed.
    pub fn matches(&self) -> Vec<&'static str> {
        let found = best_matches(self.letters.value(), &self.names, |name| [*name, ""]);
        found.into_iter().map(|n| self.names[n]).collect()
    }

    /// Moves the selection, or adds a letter.
    pub fn type_key(&mut self, key: &KeyEvent) {
        let last = self.matches().len().saturating_sub(1);
        match key.code {
            KeyCode::Up => self.selected = self.selected.saturating_sub(1),
            KeyCode::Down => self.selected = (self.selected + 1).min(last),
            KeyCode::PageUp => self.selected = self.selected.saturating_sub(10),
            KeyCode::PageDown => self.selected = (self.selected + 10).min(last),
            KeyCode::Home => self.selected = 0,
            KeyCode::End => self.selected = last,
            _ if self.letters.key(key) => self.selected = 0,
            _ => {}
        }
    }

    /// The selected name; `None` if no name matches the typed letters.
    pub fn name(&self) -> Option<&'static str> {
        self.matches().get(self.selected).copied()
    }
}
