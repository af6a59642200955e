//! Finds the values that the comments of a plan call assumed.

/// A value whose comment says that nobody has determined it yet.
#[derive(Clone, Copy, Debug)]
pub struct AssumedValue<'t> {
    /// Header of the value's section: `[uncertainty]`.
    pub section: &'t str,
    /// The line without its comment: `slack_percent = [1.5, 2.5]`.
    pub line: &'t str,
}

impl AssumedValue<'_> {
    /// The key of the value.
    pub fn key(&self) -> Option<&str> {
        Some(self.line.split_once('=')?.0.trim())
    }

    /// Whether the line names a value. Lines within a list do not.
    fn has_name(&self) -> bool {
        let is_of_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        self.key().is_some_and(|key| !key.is_empty() && key.chars().all(is_of_name))
    }
}

/// The assumed values in the text of a plan, from top to bottom. If the comment behind a section's header says assumed, all values of the
/// section are.
pub fn assumed_values(text: &str) -> impl Iterator<Item = AssumedValue<'_>> {
    let (mut section, mut is_whole) = ("", false);
    text.lines().filter_map(move |line| {
        let (line, comment) = split_at_comment(line).unwrap_or((line, ""));
        let (line, is_marked) = (line.trim(), says_assumed(comment));
        if line.starts_with('[') {
            (section, is_whole) = (line, is_marked);
            return None;
        }
        let value = AssumedValue { section, line };
        (!line.is_empty() && is_marked || is_whole && value.has_name()).then_some(value)
    })
}

/// Whether the comment behind a value says that nobody has determined the value yet.
pub fn says_assumed(comment: &str) -> bool {
    let comment = comment.to_lowercase();
    WORDS.iter().any(|word| comment.contains(word)) || {
        let mut words = comment.split(|sign: char| !sign.is_alphanumeric());
        words.any(|word| WHOLE_WORDS.contains(&word))
    }
}

/// Parts of words for an assumed value, in the languages of people who write plans; then words that must stand alone.
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

    /// Somebody must determine each of the values. A single box for the whole section would be ticked unread.
    #[test]
    fn a_section_that_is_invented_has_invented_values() {
        let text = "[tire]\nmass_kg = 280\n[uncertainty] # all invented\nfriction = [0.3, 0.5]\ncable_length_m = 0.01 # assumed\n[limits]\nheight_m = 2\n";
        let found: Vec<Option<&str>> =
            assumed_values(text).map(|value| value.line.split(' ').next()).collect();
        assert_eq!(found, [Some("friction"), Some("cable_length_m")]);
        assert_eq!(assumed_values("[[blast_row]] # guess\nholes = [\n{ x_m = 0 },\n]\n").count(), 1);
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
