//! Values that the comments of a plan call assumed.

/// A value whose comment says that nobody has found it yet.
#[derive(Clone, Copy, Debug)]
pub struct AssumedValue<'t> {
    /// Header of its section: `[uncertainty]`.
    pub section: &'t str,
    /// The line without its comment: `slack_percent = [1.5, 2.5]`.
    pub line: &'t str,
}

impl AssumedValue<'_> {
    /// The key of the value.
    pub fn key(&self) -> Option<&str> {
        Some(self.line.split_once('=')?.0.trim())
    }
}

/// The assumed values in the text of a plan, from top to bottom.
pub fn assumed_values(text: &str) -> impl Iterator<Item = AssumedValue<'_>> {
    let mut section = "";
    text.lines().filter_map(move |line| {
        let (line, comment) = split_at_comment(line).unwrap_or((line, ""));
        let line = line.trim();
        if line.starts_with('[') {
            section = line;
        }
        (!line.is_empty() && says_assumed(comment)).then_some(AssumedValue { section, line })
    })
}

/// Whether the comment behind a value says that nobody has found it yet.
pub fn says_assumed(comment: &str) -> bool {
    let comment = comment.to_lowercase();
    WORDS.iter().any(|word| comment.contains(word)) || {
        let mut words = comment.split(|sign: char| !sign.is_alphanumeric());
        words.any(|word| WHOLE_WORDS.contains(&word))
    }
}

/// What a comment calls a value that nobody has found, in the languages of those who write plans; and what is that as a word of its own alone.
const WORDS: [&str; 16] = [
    "assum",
    "invented",
    "guess",
    "estimat",
    "approximat",
    "not measured",
    "unmeasured",
    "to be measured",
    "from memory",
    "rule of thumb",
    "предполож",
    "не измерен",
    "приблизит",
    "на глаз",
    "geschätzt",
    "angenommen",
];
const WHOLE_WORDS: [&str; 4] = ["todo", "tbd", "fixme", "unknown"];

/// A line of a plan before and behind the sign of its comment. A `#` inside a text begins no comment.
fn split_at_comment(line: &str) -> Option<(&str, &str)> {
    let mut quote = None;
    let at = line.char_indices().find(|(_, sign)| {
        match quote {
            Some(open) if open == *sign => quote = None,
            None if "\"'".contains(*sign) => quote = Some(*sign),
            _ => {}
        }
        quote.is_none() && *sign == '#'
    });
    at.map(|(at, _)| (&line[..at], &line[at + 1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assumed_values_have_their_section_and_key() {
        let text = "title = \"# assumed\" # a site\n[cable]\nslack_percent = 2 # assumed\n# assumed\nrope = '#6' # invented\n";
        let found: Vec<AssumedValue<'_>> = assumed_values(text).collect();
        let [slack, rope] = &found[..] else { panic!("{found:?}") };
        assert_eq!([slack.section, rope.section], ["[cable]"; 2]);
        assert_eq!([slack.key(), rope.key()], [Some("slack_percent"), Some("rope")]);
        assert_eq!([slack.line, rope.line], ["slack_percent = 2", "rope = '#6'"]);
    }

    #[test]
    fn a_guess_is_assumed_whatever_it_is_called() {
        for comment in [
            "guess",
            "A guess of Ivan's",
            "TODO",
            "not measured",
            "estimated",
            "Предположительно",
            "geschätzt",
        ] {
            assert!(says_assumed(comment), "{comment}");
        }
        for comment in ["measured 2026-05-04", "a fit, see methodology", "rocky soil", "unknownst", ""] {
            assert!(!says_assumed(comment), "{comment}");
        }
    }
}
