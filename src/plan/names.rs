//! Names as people see them: two names that nobody can distinguish are one, and invisible characters around a name do not count.

use itertools::Itertools;
use unicode_security::confusable_detection::skeleton;

/// The Braille pattern without dots, which Unicode counts as a sign.
const BLANK_BRAILLE: char = '\u{2800}';

/// The name without invisible characters at its ends: white space of any kind, and characters without width.
pub fn trimmed(name: &str) -> &str {
    let is_ignored = |letter: char| skeleton(letter.encode_utf8(&mut [0; 4])).next().is_none();
    name.trim_matches(|letter: char| letter.is_whitespace() || letter == BLANK_BRAILLE || is_ignored(letter))
}

/// The look of a name: the same for names that people take for each other, on paper or on the radio, such as `1O ms` and `10 ms`, or
/// `42 ms`, `42 MS` and `42`.
///
/// The look is the skeleton of Unicode's "Security Mechanisms" (UTS 39) in small letters. White space does not count, nor does the unit
/// behind a number.
pub fn look(name: &str) -> String {
    let words = folded(name);
    let mut look = words
        .split(|letter: char| letter.is_whitespace() || letter == BLANK_BRAILLE)
        .filter(|word| !word.is_empty())
        .join("");
    let number = MILLISECONDS.iter().find_map(|unit| look.strip_suffix(&folded(unit)));
    let number = number.filter(|number| number.ends_with(DIGIT_LOOKS)).map(str::len);
    look.truncate(number.unwrap_or(look.len()));
    look
}

/// Units that people leave out behind a number.
const MILLISECONDS: [&str; 2] = ["ms", "мс"];
/// The looks of digits: UTS 39 takes 0 for O and 1 for l.
const DIGIT_LOOKS: [char; 10] = ['o', 'l', '2', '3', '4', '5', '6', '7', '8', '9'];

/// The skeleton of a text in small letters. A letter that has no skeleton as a capital may have one as a small letter.
fn folded(text: &str) -> String {
    let skeleton_of = |text: &str| skeleton(text).collect::<String>().to_lowercase();
    skeleton_of(&skeleton_of(text))
}

/// Whether nobody can distinguish two names.
pub fn look_alike(one: &str, other: &str) -> bool {
    one == other || look(one) == look(other)
}

/// Index of the name that looks like `name`. No two of `known` look alike.
pub fn find<'k>(known: impl IntoIterator<Item = &'k str>, name: &str) -> Option<usize> {
    let wanted = look(name);
    known.into_iter().position(|known| look(known) == wanted)
}

/// Whether a reader sees a word in a text: in capital letters, in letters that look the same, or spaced out.
pub fn says(text: &str, word: &str) -> bool {
    let letters = |text: &str| {
        let letters: String = text.to_lowercase().chars().filter(|letter| letter.is_alphabetic()).collect();
        look(&letters)
    };
    letters(text).contains(&letters(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_said_in_any_letters() {
        for title in ["EXAMPLE, three rows", "An example", "E X A M P L E", "Ехаmple", "e-x-a-m-p-l-e"] {
            assert!(says(title, "example"), "{title}");
        }
        assert!(says("Пример: три ряда", "пример") && !says("Quarry, 12 exam. places", "example"));
    }

    #[test]
    fn what_nobody_sees_around_a_name_does_not_count() {
        for unseen in
            [" ", "\t", "\u{a0}", "\u{2007}", "\u{202f}", "\u{3000}", "\u{200b}", "\u{feff}", "\u{2060}"]
        {
            for name in
                [format!("42 ms{unseen}"), format!("{unseen} 42 ms"), format!("{unseen}42 ms {unseen}")]
            {
                assert_eq!(trimmed(&name), "42 ms", "{name:?}");
                assert!(look_alike(&name, "42 ms"), "{name:?}");
            }
            assert!(look_alike(&format!("42{unseen} ms"), "42 ms"), "{unseen:?} within");
        }
        for empty in ["", " ", "\u{200b}", "\u{ad}\u{3164}", "\u{2800}"] {
            assert_eq!(trimmed(empty), "", "{empty:?}");
        }
        assert_eq!(trimmed("größte №, Ряд 1, 3 行"), "größte №, Ряд 1, 3 行");
    }

    #[test]
    fn names_that_nobody_can_tell_apart_are_one() {
        // A Cyrillic ѕ, capital letters for digits, a fullwidth digit, ö in one character and in two, a mathematical m.
        // So are names that differ by capitals, spaces or the unit alone.
        for other in [
            "42 m\u{455}",
            "42\u{a0}ms",
            "42  ms",
            "\u{ff14}2 ms",
            "42 \u{1d5c6}s",
            "42 MS",
            "42ms",
            "42",
            "42 мс",
        ] {
            assert!(look_alike("42 ms", other), "{other:?}");
            assert_eq!(find(["20 ms", "42 ms"], other), Some(1));
        }
        assert!(look_alike("10 ms", "1O ms") && look_alike("10 ms", "l0 ms"));
        assert!(look_alike("größte", "gro\u{308}ßte"));
        for other in ["4.2 ms", "24 ms", "42 ms (2)", "42 s", "42 ms, middle first"] {
            assert!(!look_alike("42 ms", other), "{other:?}");
            assert_eq!(find(["42 ms"], other), None);
        }
    }
}
