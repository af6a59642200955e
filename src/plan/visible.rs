//! Shows characters that nobody sees: a file name may hold characters that move the cursor, or turn the text around them.

use std::borrow::Cow;

/// Whether a character changes the direction of the text around it. A reader would then read another text than is written.
pub fn turns_text(letter: char) -> bool {
    matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Whether a character has no width, and does not change the look of its neighbours.
fn is_empty(letter: char) -> bool {
    matches!(letter, '\u{ad}' | '\u{180e}' | '\u{200b}' | '\u{2060}'..='\u{2064}' | '\u{feff}')
}

/// The text with hidden characters escaped as Rust and TOML write them: `\n`, `\u{202e}`. Hidden are control characters, characters without
/// width, and characters that turn text round.
pub fn visible(text: &str) -> Cow<'_, str> {
    let is_hidden = |letter: char| letter.is_control() || turns_text(letter) || is_empty(letter);
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let shown = |letter: char| match is_hidden(letter) {
        // Only control characters have short forms such as `\n`.
        true if !letter.is_control() => letter.escape_unicode().to_string(),
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
        assert!(
            "\u{200f}\u{2066}\u{9b}\u{200b}\u{feff}"
                .chars()
                .all(|letter| visible(&letter.to_string()).is_ascii())
        );
    }
}
