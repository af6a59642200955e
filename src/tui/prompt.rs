//! The line that the user types at the foot of the screen: a text to find, a command, a file.

use crossterm::event::{KeyCode, KeyEvent};
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use super::keymap::{BINDINGS, Binding};
use super::typed_line::TypedLine;

use crate::sorting::sort_by_key;

/// Purpose of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A text to find.
    Find,
    /// A command to choose by name.
    Palette,
    /// The file for an export of the screen.
    Export,
    /// The option for the page: the recommended option, with the held index, or the selected option, which does not pass.
    PageOf(usize),
    /// The file for the page of the selected option.
    Page,
    /// The file for the plan.
    SaveAs,
    /// The delay option that was fired in an observed shot.
    Fired,
    /// An observation of an earlier shot of this option, or a file of observations.
    Observe(usize),
    /// Whether to withdraw the last observation.
    Forget,
}

/// A line being typed.
#[derive(Clone, Debug)]
pub struct Prompt {
    /// Purpose of the line.
    pub purpose: Purpose,
    /// Text and cursor of the line.
    pub line: TypedLine,
    /// Index of the selected command or option among the matches; `None` until one is chosen.
    pub selected: Option<usize>,
}

/// Effect of a key on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typed {
    /// The line is still being typed.
    Changed,
    /// The line is complete.
    Done,
    /// The user discarded the line.
    Cancelled,
}

impl Prompt {
    /// A line for a purpose.
    pub fn new(purpose: Purpose, line: TypedLine) -> Self {
        let mut prompt = Self { purpose, line, selected: None };
        prompt.select_first();
        prompt
    }

    /// Selects the first choice, for example after the typed letters have changed. Never guesses the fired option before any letter is
    /// typed: the observation would count for another shot. Never guesses the option of a page: it could be the wrong page.
    pub fn select_first(&mut self) {
        let is_guess = match self.purpose {
            Purpose::Fired => self.line.value().is_empty(),
            Purpose::PageOf(_) => true,
            _ => false,
        };
        self.selected = (!is_guess).then_some(0);
    }

    /// Takes a key. `choices` is the number of choices that the line offers.
    pub fn key(&mut self, key: &KeyEvent, choices: usize) -> Typed {
        match key.code {
            KeyCode::Enter => return Typed::Done,
            KeyCode::Esc => return Typed::Cancelled,
            KeyCode::Up => self.selected = Some(self.selected.map_or(0, |at| at.saturating_sub(1))),
            KeyCode::Down => {
                self.selected = Some(self.selected.map_or(0, |at| (at + 1).min(choices.saturating_sub(1))));
            }
            _ if self.line.key(key) => self.select_first(),
            _ => {}
        }
        Typed::Changed
    }

    /// Commands whose name or description matches the typed letters. Matches of the name come first, best match first.
    pub fn commands(&self) -> Vec<&'static Binding> {
        let found = best_matches(self.line.value(), BINDINGS, |binding| [binding.name, binding.text]);
        found.into_iter().map(|n| &BINDINGS[n]).collect()
    }
}

/// Indices of the items with `typed` letters in one of their two texts. Matches of the first text come first, best match first.
pub fn best_matches<'i, T>(typed: &str, items: &'i [T], texts: impl Fn(&'i T) -> [&'i str; 2]) -> Vec<usize> {
    let pattern = Pattern::parse(typed, CaseMatching::Ignore, Normalization::Smart);
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut letters = Vec::new();
    let mut score = |text| pattern.score(Utf32Str::new(text, &mut letters), &mut matcher);
    let scores: Vec<_> = items.iter().map(|item| texts(item).map(&mut score)).collect();
    let mut found: Vec<usize> = (0..items.len()).filter(|&n| scores[n] != [None, None]).collect();
    sort_by_key(&mut found, |&n| std::cmp::Reverse(scores[n]));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::keymap::Action;

    #[test]
    fn commands_are_found_by_a_few_letters() {
        let found = |text| Prompt::new(Purpose::Palette, TypedLine::keeping(text)).commands();
        assert_eq!(found("").len(), BINDINGS.len());
        assert_eq!(found("thm").first().map(|binding| binding.action), Some(Action::Theme));
        assert_eq!(found("save").first().map(|binding| binding.action), Some(Action::Save));
        assert!(found("zzzz").is_empty());
    }
}
