//! Language of the printed page. The code holds each phrase in English, with names for its values: `{failures} of {samples} fail`.
//! `russian.toml` holds the same phrase in Russian, with the same names.
//!
//! Screens, commands and scripts use the same phrases and stay English. Only a page written inside of [`speaking`] has another
//! language.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

/// A language of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// The language of the code.
    #[default]
    English,
    /// The language of `russian.toml`.
    Russian,
}

impl Language {
    /// Code of the language by ISO 639, as HTML writes it.
    pub fn code(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::Russian => "ru",
        }
    }
}

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language::English) };
}

/// Language of the phrases in this thread.
pub fn spoken() -> Language {
    SPOKEN.get()
}

/// The result of `work`. While `work` runs, the phrases of this thread are in `language`.
pub fn speaking<T>(language: Language, work: impl FnOnce() -> T) -> T {
    /// Restores the language before, also after a panic.
    struct Before(Language);
    impl Drop for Before {
        fn drop(&mut self) {
            SPOKEN.set(self.0);
        }
    }
    let _before = Before(SPOKEN.replace(language));
    work()
}

/// Russian phrases by their English phrase.
static RUSSIAN: LazyLock<BTreeMap<String, String>> =
    LazyLock::new(|| toml::from_str(include_str!("russian.toml")).unwrap_or_default());

/// A phrase in the language of this thread. A phrase without a translation stays as it is: a name of the plan has none.
pub fn phrase(english: &str) -> &str {
    match spoken() {
        Language::English => english,
        Language::Russian => RUSSIAN.get(english).map_or(english, String::as_str),
    }
}

/// A phrase with its values filled in. Values stand in the order of the English names. Use `say!` instead.
pub fn fill(english: &str, values: &[&dyn Display]) -> String {
    let names: Vec<String> =
        parts(english).filter_map(|(_, name)| name).fold(Vec::new(), |mut names, name| {
            if !names.contains(&name) {
                names.push(name);
            }
            names
        });
    let value = |name: String| values.get(names.iter().position(|known| *known == name)?);
    let mut text = String::new();
    for (before, name) in parts(phrase(english)) {
        text += before;
        text.extend(name.and_then(value).map(ToString::to_string));
    }
    text
}

/// Pieces of a phrase: a text, and the name behind it. The last piece may have no name. A `{}` without a name gets its number as
/// name.
fn parts(phrase: &str) -> impl Iterator<Item = (&str, Option<String>)> {
    let mut without_name = 0..;
    phrase.split_inclusive('}').map(move |piece| match piece.split_once('{') {
        None => (piece, None),
        Some((before, name)) => {
            let name = name.trim_end_matches('}');
            let name = if name.is_empty() {
                without_name.next().map(|n: usize| n.to_string())
            } else {
                Some(name.to_owned())
            };
            (before, name)
        }
    })
}

/// Fills a phrase with its values: `say!("{failures} of {samples} fail", failures, samples)`. Values stand in the order of their
/// names. A name that occurs twice has one value.
macro_rules! say {
    ($phrase:literal $(, $value:expr)* $(,)?) => {
        $crate::report::language::fill($phrase, &[$(&$value),*])
    };
}
pub(crate) use say;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_follow_their_names_into_another_order() {
        let said = || say!("{} of {holes} holes lie {what}: {}", 1, 2, "there", 3);
        assert_eq!(said(), "1 of 2 holes lie there: 3");
        let parts: Vec<_> = parts("a {x} b {} c {}").collect();
        assert_eq!(parts.iter().filter_map(|(_, name)| name.as_deref()).collect::<Vec<_>>(), ["x", "0", "1"]);
        let twice = fill("{x}, {y}, {x}", &[&1, &2]);
        assert_eq!(twice, "1, 2, 1");
    }

    #[test]
    fn a_language_ends_with_its_work() {
        assert_eq!(speaking(Language::Russian, || phrase("PASS")), "ПРОХОДИТ");
        assert_eq!(phrase("PASS"), "PASS");
        let _ = std::panic::catch_unwind(|| speaking(Language::Russian, || panic!("as meant")));
        assert_eq!(spoken(), Language::English);
    }
}
