//! The line at the foot of the screen that the user types: a text to find, a command, a file.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};
use tui_input::Input;
use tui_input::backend::crossterm::EventHandler;

use super::keymap::{BINDINGS, Binding};

/// What the line is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A text to find.
    Find,
    /// A command to choose by name.
    Palette,
    /// The file to write the contents of the screen to.
    Export,
    /// The file to write the page of the selected option to.
    Page,
    /// The file to write the plan to.
    SaveAs,
    /// What was seen of an earlier shot, or a file of that.
    Observe,
    /// Whether what was told last is to be taken back.
    Forget,
}

/// A line being typed.
#[derive(Clone, Debug)]
pub struct Prompt {
    /// What the line is for.
    pub purpose: Purpose,
    /// Text and cursor.
    pub input: Input,
    /// Index of the selected command among the matches.
    pub selected: usize,
    /// Whether the text is still the one offered: what is typed or pasted takes its place.
    offered: bool,
}

/// Effect of a key on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typed {
    /// The line is still being typed.
    Changed,
    /// The line is complete.
    Done,
    /// The user gave the line up.
    Cancelled,
}

impl Prompt {
    /// A line that begins with a text.
    pub fn new(purpose: Purpose, text: &str) -> Self {
        Self { purpose, input: Input::new(text.to_owned()), selected: 0, offered: false }
    }

    /// A line that offers a text: what is typed takes its place, and a key that moves in it keeps it.
    pub fn offering(purpose: Purpose, text: &str) -> Self {
        Self { offered: true, ..Self::new(purpose, text) }
    }

    /// Takes the text offered away, where it is still there untouched.
    pub fn clear_offered(&mut self) {
        if std::mem::take(&mut self.offered) {
            self.input = Input::default();
        }
    }

    /// Takes a key.
    pub fn key(&mut self, key: &KeyEvent) -> Typed {
        match key.code {
            KeyCode::Enter => return Typed::Done,
            KeyCode::Esc => return Typed::Cancelled,
            KeyCode::Up => self.selected = self.selected.saturating_sub(1),
            KeyCode::Down => self.selected = (self.selected + 1).min(self.commands().len().saturating_sub(1)),
            _ => {
                if matches!(key.code, KeyCode::Char(_)) && !key.modifiers.contains(KeyModifiers::CONTROL) {
                    self.clear_offered();
                }
                self.offered = false;
                if self.input.handle_event(&Event::Key(*key)).is_some_and(|change| change.value) {
                    self.selected = 0;
                }
            }
        }
        Typed::Changed
    }

    /// Commands whose name or description contains the letters typed, in order. Matches of the name come first, the best first.
    pub fn commands(&self) -> Vec<&'static Binding> {
        let found = best_matches(self.input.value(), BINDINGS, |binding| [binding.name, binding.text]);
        found.into_iter().map(|n| &BINDINGS[n]).collect()
    }
}

/// Indices of the items that have the letters `typed` in one of their two texts, in order. Matches of the first text come first,
/// the best first.
pub fn best_matches<T>(typed: &str, items: &[T], texts: impl Fn(&T) -> [&'static str; 2]) -> Vec<usize> {
    let pattern = Pattern::parse(typed, CaseMatching::Ignore, Normalization::Smart);
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut letters = Vec::new();
    let mut score = |text| pattern.score(Utf32Str::new(text, &mut letters), &mut matcher);
    let scores: Vec<_> = items.iter().map(|item| texts(item).map(&mut score)).collect();
    let mut found: Vec<usize> = (0..items.len()).filter(|&n| scores[n] != [None, None]).collect();
    found.sort_by_key(|&n| std::cmp::Reverse(scores[n]));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::keymap::Action;

    #[test]
    fn commands_are_found_by_a_few_letters() {
        let found = |text| Prompt::new(Purpose::Palette, text).commands();
        assert_eq!(found("").len(), BINDINGS.len());
        assert_eq!(found("thm").first().map(|binding| binding.action), Some(Action::Theme));
        assert_eq!(found("save").first().map(|binding| binding.action), Some(Action::Save));
        assert!(found("zzzz").is_empty());
    }
}
