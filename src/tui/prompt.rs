//! A line to type in at the foot of the screen: what to find, a command's name, a file's name.

use crossterm::event::{Event, KeyCode, KeyEvent};
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};
use tui_input::Input;
use tui_input::backend::crossterm::EventHandler;

use super::keymap::{BINDINGS, Binding};

/// What is typed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// What to find.
    Search,
    /// A command's name.
    Palette,
    /// The file to write what is shown to.
    Export,
    /// The file to write the plan to.
    SaveAs,
}

/// The line.
#[derive(Clone, Debug)]
pub struct Prompt {
    /// What for.
    pub purpose: Purpose,
    /// What stands in it.
    pub input: Input,
    /// Index of the selected command.
    pub selected: usize,
}

/// What a key came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typed {
    /// The line is another.
    Changed,
    /// It is complete.
    Done,
    /// It is given up.
    Cancelled,
}

impl Prompt {
    /// With something in it already.
    pub fn new(purpose: Purpose, text: &str) -> Self {
        Self { purpose, input: Input::new(text.to_owned()), selected: 0 }
    }

    /// A key.
    pub fn key(&mut self, key: &KeyEvent) -> Typed {
        match key.code {
            KeyCode::Enter => return Typed::Done,
            KeyCode::Esc => return Typed::Cancelled,
            KeyCode::Up => self.selected = self.selected.saturating_sub(1),
            KeyCode::Down => self.selected = (self.selected + 1).min(self.commands().len().saturating_sub(1)),
            _ => {
                if self.input.handle_event(&Event::Key(*key)).is_some_and(|change| change.value) {
                    self.selected = 0;
                }
            }
        }
        Typed::Changed
    }

    /// Commands whose name or meaning contains what is typed, letter after letter: names first, best match first.
    pub fn commands(&self) -> Vec<&'static Binding> {
        let pattern = Pattern::parse(self.input.value(), CaseMatching::Ignore, Normalization::Smart);
        let mut matcher = Matcher::new(Config::DEFAULT);
        let mut letters = Vec::new();
        let mut score = |words| pattern.score(Utf32Str::new(words, &mut letters), &mut matcher);
        let scores: Vec<_> =
            BINDINGS.iter().map(|binding| (score(binding.name), score(binding.text))).collect();
        let mut found: Vec<usize> = (0..BINDINGS.len()).filter(|&n| scores[n] != (None, None)).collect();
        found.sort_by_key(|&n| std::cmp::Reverse(scores[n]));
        found.into_iter().map(|n| &BINDINGS[n]).collect()
    }
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
