//! Pasted text: it goes into the line being typed, as text. On a screen it would be a row of commands, so there it does nothing.

use tui_input::Input;

/// Most characters that a line takes.
const MOST_LETTERS: usize = 500;

/// Puts the first line of a pasted text into a line being typed, at its cursor. Returns a note where not all was taken.
pub fn paste(input: &mut Input, pasted: &str) -> Option<String> {
    let pasted = pasted.trim_matches(['\r', '\n']);
    let room = MOST_LETTERS.saturating_sub(input.value().chars().count());
    let taken: String = pasted.chars().take_while(|letter| !letter.is_control()).take(room).collect();
    let count = taken.chars().count();
    let note = (taken.len() < pasted.len()).then(|| format!("pasted: the first {count} characters only"));
    let (before, after): (String, String) = {
        let letters = || input.value().chars();
        (letters().take(input.cursor()).collect(), letters().skip(input.cursor()).collect())
    };
    let cursor = input.cursor() + count;
    *input = Input::new(before + &taken + &after).with_cursor(cursor);
    note
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_takes_one_line_as_text() {
        let mut input = Input::new("ab".to_owned()).with_cursor(1);
        assert_eq!(paste(&mut input, "12\n"), None);
        assert_eq!((input.value(), input.cursor()), ("a12b", 3));
        assert!(paste(&mut input, "x\nq\x1b[A").is_some_and(|note| note.contains("first 1 characters")));
        assert_eq!(input.value(), "a12xb");
        assert!(paste(&mut input, &"é".repeat(1 << 20)).is_some());
        assert_eq!(input.value().chars().count(), MOST_LETTERS);
    }
}
