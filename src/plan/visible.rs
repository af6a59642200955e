//! Characters that nobody sees, shown: a file name may hold what moves the cursor, or turns the text around it.

use std::borrow::Cow;

/// Whether a character changes the direction of the text around it: what is read would not be what is written.
pub fn turns_text(letter: char) -> bool {
    matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The text with its control characters, and those that turn text round, as Rust and TOML write them: `\n`, `\u{202e}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    let is_hidden = |letter: char| letter.is_control() || turns_text(letter);
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let shown = |letter: char| match is_hidden(letter) {
        // Some of those that turn text count as printable.
        true if turns_text(letter) => letter.escape_unicode().to_string(),
        true => letter.escape_default().to_string(),
        false => letter.to_string(),
    };
    Cow::Owned(text.chars().map(shown).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_sees_is_shown() {
        assert_eq!(visible("Reihe 3, größte №"), "Reihe 3, größte №");
        assert_eq!(visible("a\u{1b}[2J\n\u{202e}b\u{7f}"), "a\\u{1b}[2J\\n\\u{202e}b\\u{7f}");
        assert!("\u{200f}\u{2066}\u{9b}".chars().all(|letter| visible(&letter.to_string()).is_ascii()));
    }
}
