//! A line that the user types: a value, an answer, a command. Pasted text goes into the line. Without a line, a paste does nothing: as keys
//! it would be a series of commands.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use tui_input::Input;
use tui_input::backend::crossterm::EventHandler;

/// Most characters that a line takes.
const MOST_LETTERS: usize = 500;

/// A line being typed.
#[derive(Clone, Debug, Default)]
pub struct TypedLine {
    /// Text and cursor.
    pub input: Input,
    /// Whether the text is still the offered text. Typed or pasted text then replaces it.
    offered: bool,
}

impl TypedLine {
    /// A line that offers a text. Typed text replaces it; a key that moves the cursor keeps it.
    pub fn offering(text: &str) -> Self {
        Self { offered: true, ..Self::keeping(text) }
    }

    /// A line that holds a text, with the cursor at its end.
    pub fn keeping(text: &str) -> Self {
        Self { input: Input::new(text.to_owned()), offered: false }
    }

    /// The text.
    pub fn value(&self) -> &str {
        self.input.value()
    }

    /// Offers the text again, because the user comes back to the line.
    pub fn offer(&mut self) {
        self.offered = true;
    }

    /// Takes a key. Returns whether the text changed.
    pub fn key(&mut self, key: &KeyEvent) -> bool {
        if matches!(key.code, KeyCode::Char(_)) && !key.modifiers.contains(KeyModifiers::CONTROL) {
            self.clear_offered();
        }
        self.offered = false;
        self.input.handle_event(&Event::Key(*key)).is_some_and(|change| change.value)
    }

    /// Inserts the first line of a pasted text at the cursor. Returns a note if part of the text was dropped.
    pub fn paste(&mut self, pasted: &str) -> Option<String> {
        self.clear_offered();
        let pasted = pasted.trim_matches(['\r', '\n']);
        let letters: Vec<char> = self.value().chars().collect();
        let room = MOST_LETTERS.saturating_sub(letters.len());
        let taken: String = pasted.chars().take_while(|letter| !letter.is_control()).take(room).collect();
        let count = taken.chars().count();
        let (before, after) = letters.split_at(self.input.cursor());
        let text = before.iter().copied().chain(taken.chars()).chain(after.iter().copied()).collect();
        self.input = Input::new(text).with_cursor(before.len() + count);
        (taken.len() < pasted.len()).then(|| format!("pasted: the first {count} characters only"))
    }

    fn clear_offered(&mut self) {
        if std::mem::take(&mut self.offered) {
            self.input = Input::default();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_takes_one_line_as_text() {
        let mut line = TypedLine { input: Input::new("ab".to_owned()).with_cursor(1), offered: false };
        assert_eq!(line.paste("12\n"), None);
        assert_eq!((line.value(), line.input.cursor()), ("a12b", 3));
        assert!(line.paste("x\nq\x1b[A").is_some_and(|note| note.contains("first 1 characters")));
        assert_eq!(line.value(), "a12xb");
        assert!(line.paste(&"é".repeat(1 << 20)).is_some());
        assert_eq!(line.value().chars().count(), MOST_LETTERS);
    }

    /// `7` typed on 6.0 gives 7, not 6.07. After a key that moves the cursor, `7` is inserted at the cursor.
    #[test]
    fn what_is_typed_takes_the_place_of_what_is_offered() {
        let seven = KeyEvent::new(KeyCode::Char('7'), KeyModifiers::NONE);
        let mut line = TypedLine::offering("6.0");
        assert!(line.key(&seven));
        assert_eq!(line.value(), "7");
        let mut line = TypedLine::offering("6.0");
        assert!(!line.key(&KeyEvent::new(KeyCode::End, KeyModifiers::NONE)));
        assert!(line.key(&seven));
        assert_eq!(line.value(), "6.07");
        let mut line = TypedLine::offering("6.0");
        assert_eq!(line.paste("8.5"), None);
        assert_eq!(line.value(), "8.5");
    }
}
