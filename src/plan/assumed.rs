//! Finds the values that the comments of a plan call assumed.

use super::keys::Key;

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
/// section are; so are they if a comment directly above or below the header says so. Any other comment on a line of its own that says
/// assumed counts as one value, with its text: nobody can tell how many values it is about.
pub fn assumed_values(text: &str) -> impl Iterator<Item = AssumedValue<'_>> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_header = |n: Option<usize>| n.and_then(|n| lines.get(n)).is_some_and(|line| line.starts_with('['));
    let says_alone = |n: Option<usize>| {
        let comment = n.and_then(|n| lines.get(n)?.strip_prefix('#'));
        comment.is_some_and(says_assumed)
    };
    let (mut section, mut is_whole) = ("", false);
    let mut found = Vec::new();
    for (n, &whole) in lines.iter().enumerate() {
        let [above, below] = [n.checked_sub(1), Some(n + 1)];
        let (line, comment) = split_at_comment(whole).unwrap_or((whole, ""));
        let (line, is_marked) = (line.trim(), says_assumed(comment));
        if line.starts_with('[') {
            (section, is_whole) = (line, is_marked || says_alone(above) || says_alone(below));
            continue;
        }
        let value = AssumedValue { section, line };
        if line.is_empty() {
            let is_own = is_marked && !is_header(above) && !is_header(below);
            found.extend(is_own.then_some(AssumedValue { section, line: whole }));
        } else if is_marked || is_whole && value.has_name() {
            found.push(value);
        }
    }
    found.into_iter()
}

/// Whether the text of a plan calls a value of this key assumed.
pub fn is_assumed(text: &str, key: &Key) -> bool {
    assumed_values(text).any(|value| value.key() == Some(key.name))
}

/// Whether a comment says that nobody has determined a value yet.
pub fn says_assumed(comment: &str) -> bool {
    // A word processor types spaces of its own, and hyphens that nobody sees.
    let plain = |sign: char| if sign.is_whitespace() { ' ' } else { sign };
    let is_seen = |sign: &char| !INVISIBLE.contains(sign);
    let comment: String = comment.to_lowercase().chars().filter(is_seen).map(plain).collect();
    PARTS.iter().any(|part| comment.contains(part)) || {
        let mut words = comment.split(|sign: char| !sign.is_alphanumeric());
        words.any(|word| WORDS.contains(&word))
    }
}

/// Signs without width within words: the soft hyphen, and joiners.
const INVISIBLE: [char; 7] =
    ['\u{ad}', '\u{200b}', '\u{200c}', '\u{200d}', '\u{200e}', '\u{2060}', '\u{feff}'];
/// Parts of a comment that call a value assumed, in the languages of people who write plans, in small letters.
#[rustfmt::skip]
const PARTS: &[&str] = &[
    "assum", "invented", "guess", "estim", "approx", "roughly", "not measured", "unmeasured", "not checked", "to be measured", "not weighed", "not filmed",
    "to be filmed", "until filmed", "no film", "nobody observed", "nobody weighed", "nobody filmed it", "nobody filmed yet", "not sure", "from memory", "rule of thumb", "by eye", "placeholder", "copied",
    "tutorial", "last year", "check!", "?", "~",
    "предполож", "не измер", "приблизит", "примерно", "на глаз", "принято", "уточнит", "оценка", "предварительн", "выдуман", "из примера",
    "проверить", "schätz", "angenommen", "annahme", "ungefähr", "supuest", "aproxim", "supposé",
];
/// Words that call a value assumed, each as a whole word.
const WORDS: &[&str] = &["todo", "tbd", "fixme", "unknown", "default", "circa", "ca"];

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
        let text = "title = \"# assumed\" # a site\n[cable]\nslack_percent = 2 # assumed\n# a rope of ours\nrope = '#6' # invented\n";
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

    /// Comments on lines of their own, above a value, a section or the whole plan, were overlooked: a plan of guesses got a clean page.
    #[test]
    fn a_comment_on_a_line_of_its_own_counts() {
        let text = "# All of this is guessed.\ntitle = \"a\"\n\n# TODO\n[tire]\nmass_kg = 280\nouter_diameter_m = 1.6\n[cable]\n\
                    # nobody filmed it\nslack_percent = 2\n\n# assumed\n\nrope = \"a\"\n";
        let found: Vec<&str> = assumed_values(text).map(|value| value.line).collect();
        let all = [
            "# All of this is guessed.",
            "mass_kg = 280",
            "outer_diameter_m = 1.6",
            "slack_percent = 2",
            "# assumed",
            "rope = \"a\"",
        ];
        assert_eq!(found, all);
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
            "nobody observed it: no option passes before a shot is filmed",
            "50?",
            "~5 m/s",
            "примерно",
            "estimado",
            "not\u{a0}measured",
            "не\u{202f}измерено",
            "not mea\u{ad}sured",
        ] {
            assert!(says_assumed(comment), "{comment}");
        }
        for comment in ["measured 2026-05-04", "a fit, see methodology", "rocky soil", "unknownst", ""] {
            assert!(!says_assumed(comment), "{comment}");
        }
    }
}
