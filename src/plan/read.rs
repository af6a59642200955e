//! Reading a TOML table key by key, collecting every mistake instead of stopping at the first.
//!
//! A reader always hands back a usable value; where it had to make one up it has noted a mistake, and a plan with mistakes
//! is never handed on. Whatever key was not asked for when the table is done is unknown.

use std::cell::RefCell;
use std::ops::{Range, RangeInclusive};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::Mistake;

/// Mistakes found so far.
#[derive(Debug, Default)]
pub struct Mistakes(RefCell<Vec<Mistake>>);

impl Mistakes {
    /// Notes one.
    pub fn add(&self, span: Range<usize>, message: impl Into<String>, remedy: impl Into<String>) {
        let (message, remedy) = (message.into(), remedy.into());
        self.0.borrow_mut().push(Mistake { span, message, remedy });
    }

    /// How many so far.
    pub fn count(&self) -> usize {
        self.0.borrow().len()
    }

    /// All of them.
    pub fn take(self) -> Vec<Mistake> {
        self.0.into_inner()
    }
}

/// A value with its place in the source.
#[derive(Clone, Debug)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Bytes of the source.
    pub span: Range<usize>,
}

/// One table being read.
pub struct Table<'s> {
    /// As the user writes it: `[shelter]`.
    pub name: String,
    /// Its header.
    pub span: Range<usize>,
    entries: &'s DeTable<'s>,
    asked: RefCell<Vec<&'static str>>,
    mistakes: &'s Mistakes,
}

impl<'s> Table<'s> {
    /// A table named `name` found at `span`.
    pub fn new(name: &str, span: Range<usize>, entries: &'s DeTable<'s>, mistakes: &'s Mistakes) -> Self {
        Self { name: name.to_owned(), span, entries, asked: RefCell::default(), mistakes }
    }

    /// Notes a mistake about the value of `key`, or the table where it has none.
    pub fn wrong(&self, key: &str, message: impl Into<String>, remedy: impl Into<String>) {
        self.mistakes.add(self.span_of(key), message, remedy);
    }

    /// Whether the key is there.
    pub fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }

    fn get(&self, key: &'static str) -> Option<&'s Spanned<DeValue<'s>>> {
        self.asked.borrow_mut().push(key);
        self.entries.get(key)
    }

    fn missing(&self, key: &str, example: &str) {
        self.mistakes.add(
            self.span.clone(),
            format!("{} has no `{key}`", self.name),
            format!("add `{key} = {example}`"),
        );
    }

    fn mistyped(&self, key: &str, value: &Spanned<DeValue<'_>>, wanted: &str, example: &str) {
        let found = value.get_ref().type_str();
        self.mistakes.add(
            value.span(),
            format!("`{key}` is {} {found}, not {wanted}", article(found)),
            format!("write `{key} = {example}`"),
        );
    }

    /// A number within `range`; `default` when the key is absent, which is a mistake when there is none.
    pub fn number(
        &self,
        key: &'static str,
        default: Option<f64>,
        range: RangeInclusive<f64>,
        example: &str,
    ) -> f64 {
        let fallback = default.unwrap_or(*range.start());
        let Some(value) = self.get(key) else {
            if default.is_none() {
                self.missing(key, example);
            }
            return fallback;
        };
        match as_number(value.get_ref()) {
            None => self.mistyped(key, value, "a number", example),
            Some(number) => match bounded(number, &range) {
                None => return number,
                Some(message) => self.mistakes.add(
                    value.span(),
                    format!("`{key}` {message}"),
                    format!(
                        "write a number from {} to {}, such as `{key} = {example}`",
                        range.start(),
                        range.end()
                    ),
                ),
            },
        }
        fallback
    }

    /// A number within `range`, if the key is there.
    pub fn number_if(&self, key: &'static str, range: RangeInclusive<f64>, example: &str) -> Option<f64> {
        self.has(key).then(|| self.number(key, None, range, example))
    }

    /// A whole number within `range`.
    pub fn whole(&self, key: &'static str, range: RangeInclusive<usize>, example: &str) -> usize {
        let Some(value) = self.get(key) else {
            self.missing(key, example);
            return *range.start();
        };
        match as_whole(value.get_ref()) {
            Some(number) if range.contains(&number) => number,
            Some(_) => {
                let (low, high) = (range.start(), range.end());
                let message = format!("`{key}` must be from {low} to {high}");
                self.mistakes.add(
                    value.span(),
                    message,
                    format!("write a whole number from {low} to {high}"),
                );
                *range.start()
            }
            None => {
                self.mistyped(key, value, "a whole number of 0 or more", example);
                *range.start()
            }
        }
    }

    /// A text, if the key is there.
    pub fn text_if(&self, key: &'static str, example: &str) -> Option<At<&'s str>> {
        let value = self.get(key)?;
        let Some(text) = value.get_ref().as_str() else {
            self.mistyped(key, value, "a text in quotes", example);
            return None;
        };
        if text.contains(char::is_control) {
            self.mistakes.add(
                value.span(),
                format!("`{key}` has a line end or another control character"),
                "write it in one line of letters, digits and signs",
            );
        }
        Some(At { value: text, span: value.span() })
    }

    /// A text; its absence is a mistake.
    pub fn text(&self, key: &'static str, example: &str) -> At<&'s str> {
        self.text_if(key, example).unwrap_or_else(|| {
            if !self.entries.contains_key(key) {
                self.missing(key, example);
            }
            At { value: "", span: self.span.clone() }
        })
    }

    /// One of a few words; the first when the key is absent.
    pub fn word<T: Copy>(&self, key: &'static str, words: &[(&'static str, T)]) -> T {
        let example = format!("\"{}\"", words[0].0);
        let Some(text) = self.text_if(key, &example) else { return words[0].1 };
        if let Some(&(_, found)) = words.iter().find(|(word, _)| *word == text.value) {
            return found;
        }
        let all: Vec<_> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let message = format!("\"{}\" is no `{key}`", text.value);
        self.mistakes.add(text.span, message, format!("write one of {}", all.join(", ")));
        words[0].1
    }

    /// A list whose items `read` takes; items it refuses are mistakes.
    pub fn list<T>(
        &self,
        key: &'static str,
        example: &str,
        wanted: &str,
        read: impl Fn(&'s DeValue<'s>) -> Option<T>,
    ) -> Option<At<Vec<At<T>>>> {
        let value = self.get(key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.mistyped(key, value, "a list", example);
            return Some(At { value: Vec::new(), span: value.span() });
        };
        let mut list = Vec::new();
        for item in items.iter() {
            match read(item.get_ref()) {
                Some(value) => list.push(At { value, span: item.span() }),
                None => self.mistyped(key, item, wanted, example),
            }
        }
        Some(At { value: list, span: value.span() })
    }

    /// A table of its own, if it is there.
    pub fn table_if(&self, key: &'static str) -> Option<Table<'s>> {
        let value = self.get(key)?;
        let name = self.path_to(key);
        let Some(entries) = value.get_ref().as_table() else {
            self.mistakes.add(
                value.span(),
                format!("`{key}` must be one table"),
                format!("write one section [{name}]"),
            );
            return None;
        };
        Some(Table::new(&format!("[{name}]"), value.span(), entries, self.mistakes))
    }

    /// A table of its own; its absence is a mistake.
    pub fn table(&self, key: &'static str, example: &str) -> Option<Table<'s>> {
        let table = self.table_if(key);
        if table.is_none() && !self.entries.contains_key(key) {
            self.mistakes.add(
                self.span.clone(),
                format!("the plan has no [{key}]"),
                format!("add a section [{key}] with {example}"),
            );
        }
        table
    }

    /// A table where a plain value may stand as well, such as `spacing_m = { row = 1.5, column = 1.6 }`.
    pub fn inline_table(&self, key: &'static str) -> Option<Table<'s>> {
        self.get(key).filter(|value| value.get_ref().is_table()).and_then(|_| self.table_if(key))
    }

    /// Where the value of `key` stands, or the table where it has none.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.entries.get(key).map_or_else(|| self.span.clone(), Spanned::span)
    }

    /// A list of tables.
    pub fn tables(&self, key: &'static str) -> Vec<Table<'s>> {
        let Some(value) = self.get(key) else { return Vec::new() };
        let name = self.path_to(key);
        let Some(items) = value.get_ref().as_array() else {
            self.mistakes.add(
                value.span(),
                format!("`{key}` must be a list of tables"),
                format!("write a section [[{name}]] for each"),
            );
            return Vec::new();
        };
        let mut tables = Vec::new();
        for item in items.iter() {
            match item.get_ref().as_table() {
                Some(entries) => {
                    tables.push(Table::new(&format!("[[{name}]]"), item.span(), entries, self.mistakes));
                }
                None => self.mistyped(key, item, "a table", "[{ … }]"),
            }
        }
        tables
    }

    fn path_to(&self, key: &str) -> String {
        let own = self.name.trim_matches(['[', ']']);
        if self.name.starts_with('[') { format!("{own}.{key}") } else { key.to_owned() }
    }

    /// Ends the reading: every key nobody asked for is unknown.
    pub fn finish(self) {
        let asked = self.asked.borrow();
        for (key, _) in self.entries.iter() {
            let name: &str = key.get_ref();
            if asked.contains(&name) {
                continue;
            }
            let nearest = nearest(name, asked.iter().copied());
            let remedy = nearest.map_or_else(
                || {
                    let mut known: Vec<_> = asked.iter().map(|key| format!("`{key}`")).collect();
                    known.sort_unstable();
                    known.dedup();
                    format!("{} knows {}", self.name, known.join(", "))
                },
                |near| format!("did you mean `{near}`?"),
            );
            self.mistakes.add(key.span(), format!("{} has no key `{name}`", self.name), remedy);
        }
    }
}

/// The most alike of `known`, if any is alike.
pub fn nearest<'k>(name: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let alike = known.map(|word| (strsim::jaro_winkler(name, word), word));
    alike.filter(|(score, _)| *score > 0.8).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, word)| word)
}

/// What is wrong with a number, if anything.
pub fn bounded(number: f64, range: &RangeInclusive<f64>) -> Option<String> {
    let (low, high) = (range.start(), range.end());
    if number.is_nan() {
        Some("is not a number".to_owned())
    } else if number.is_infinite() {
        Some("is infinite".to_owned())
    } else if number < 0.0 && *low >= 0.0 {
        Some("is negative".to_owned())
    } else if number == 0.0 && *low > 0.0 {
        Some("is zero".to_owned())
    } else if number < *low {
        Some(format!("is below {low}"))
    } else if number > *high {
        Some(format!("is above {high}"))
    } else {
        None
    }
}

/// Any number, whole or not.
pub fn as_number(value: &DeValue<'_>) -> Option<f64> {
    if let Some(integer) = value.as_integer() {
        return i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64);
    }
    value.as_float()?.as_str().parse().ok()
}

/// A whole number of 0 or more.
pub fn as_whole(value: &DeValue<'_>) -> Option<usize> {
    let integer = value.as_integer()?;
    // What does not fit is past every limit, and the limit is what the user is told.
    let number = i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX);
    (number >= 0).then(|| usize::try_from(number).unwrap_or(usize::MAX))
}

fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
