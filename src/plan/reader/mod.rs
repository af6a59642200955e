//! Reads a section key by key, and collects every mistake instead of stopping at the first.
//!
//! Each reading function returns a usable value. If the plan has none, the function notes a mistake and makes a value up. A plan with
//! mistakes never leaves the reader. A key that no function asked for is unknown.

mod nested;
mod value;

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ops::{Range, RangeInclusive};
use std::str::FromStr;

use itertools::Itertools;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub use self::value::nearest;
use self::value::{article, as_number, as_whole, range_mistake};
use super::diagnostic::{MOST_KEPT, Mistake};
use super::keys::{CALLED, DefaultValue, Key, RENAMED, Section};
use super::names;
use super::visible::turns_text;
use crate::plan::Time;
use crate::sorting::sort;

/// Mistakes found so far.
#[derive(Debug)]
pub struct Mistakes<'s> {
    source: &'s str,
    found: RefCell<Vec<Mistake>>,
    count: Cell<usize>,
}

impl<'s> Mistakes<'s> {
    /// An empty list of mistakes in `source`.
    pub fn of(source: &'s str) -> Self {
        Self { source, found: RefCell::default(), count: Cell::new(0) }
    }

    /// Notes a mistake. Only the first `MOST_KEPT` are kept.
    pub fn add(&self, span: Range<usize>, message: impl Into<String>, remedy: impl Into<String>) {
        self.count.set(self.count.get() + 1);
        if self.count.get() <= MOST_KEPT {
            let (message, remedy) = (message.into(), remedy.into());
            self.found.borrow_mut().push(Mistake { span, message, remedy });
        }
    }

    /// Notes a mistake if a name looks like one of the `earlier` names. The map holds these by their look.
    pub fn check_name<'n>(&self, what: &str, name: &At<&'n str>, earlier: &mut HashMap<String, At<&'n str>>) {
        let Some(other) = earlier.insert(names::look(name.value), name.clone()) else { return };
        if name.value.is_empty() {
            return;
        }
        let line = self.source.get(..other.span.start).map_or(1, |before| before.matches('\n').count() + 1);
        if name.value == other.value {
            let message =
                format!("two {what}s are named \"{}\", this one and that of line {line}", name.value);
            return self.add(name.span.clone(), message, "give each its own name");
        }
        let message = format!("the {what} \"{}\" looks like \"{}\" of line {line}", name.value, other.value);
        let not_there = name.value.chars().filter(|letter| !other.value.contains(*letter)).unique();
        let letters = not_there.map(|letter| format!("; \"{letter}\" is U+{:04X} here", u32::from(letter)));
        let remedy =
            format!("give each a name that nobody takes for the other{}", letters.collect::<String>());
        self.add(name.span.clone(), message, remedy);
    }

    /// Number of mistakes so far.
    pub fn count(&self) -> usize {
        self.count.get()
    }

    /// The first mistakes.
    pub fn take(self) -> Vec<Mistake> {
        self.found.into_inner()
    }
}

/// A value with its bytes in the source.
#[derive(Clone, Debug)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Bytes of the source.
    pub span: Range<usize>,
}

/// One section being read.
pub struct SectionReader<'s> {
    section: &'static Section,
    /// Bytes of its header.
    pub span: Range<usize>,
    /// `None`: the plan leaves the section out.
    entries: Option<&'s DeTable<'s>>,
    asked: RefCell<Vec<&'static str>>,
    mistakes: &'s Mistakes<'s>,
}

impl<'s> SectionReader<'s> {
    /// A section found at `span`.
    pub fn new(
        section: &'static Section,
        span: Range<usize>,
        entries: &'s DeTable<'s>,
        mistakes: &'s Mistakes<'s>,
    ) -> Self {
        Self { section, span, entries: Some(entries), asked: RefCell::default(), mistakes }
    }

    /// Notes a mistake at the value of `key`, or at the section's header if the section lacks the key.
    pub fn wrong(&self, key: &Key, message: impl Into<String>, remedy: impl Into<String>) {
        self.mistakes.add(self.span_of(key), message, remedy);
    }

    /// Whether the plan has the key.
    pub fn has(&self, key: &Key) -> bool {
        self.get(key).is_some()
    }

    /// Number of keys in the section.
    pub fn count_keys(&self) -> usize {
        self.entries.map_or(0, |entries| entries.len())
    }

    fn get(&self, key: &Key) -> Option<&'s Spanned<DeValue<'s>>> {
        self.asked.borrow_mut().push(key.name);
        self.entries?.get(key.name)
    }

    fn missing(&self, key: &Key) {
        self.mistakes.add(
            self.span.clone(),
            format!("{} has no `{}`", self.section.title, key.name),
            format!("add `{} = {}`", key.name, key.example),
        );
    }

    fn mistyped(&self, key: &Key, value: &Spanned<DeValue<'_>>, wanted: &str) {
        let found = value.get_ref().type_str();
        self.mistakes.add(
            value.span(),
            format!("`{}` is {} {found}, not {wanted}", key.name, article(found)),
            format!("write `{} = {}`", key.name, key.example),
        );
    }

    /// A number. If it is absent and the key has no default, that is a mistake.
    pub fn number(&self, key: &Key) -> f64 {
        let number = self.number_if(key);
        number.unwrap_or_else(|| match key.default {
            Some(DefaultValue::Number(default)) => default,
            _ => {
                self.missing(key);
                *key.kind.range().start()
            }
        })
    }

    /// A time. The unit of its key is milliseconds.
    pub fn time(&self, key: &Key) -> Time {
        Time::from_ms(self.number(key))
    }

    /// A number, if the plan has the key.
    pub fn number_if(&self, key: &Key) -> Option<f64> {
        let value = self.get(key)?;
        Some(self.bounded(key, value).unwrap_or(*key.kind.range().start()))
    }

    /// A number in the range of its key; anything else is a mistake.
    fn bounded(&self, key: &Key, value: &Spanned<DeValue<'_>>) -> Option<f64> {
        let Some(number) = as_number(value.get_ref()) else {
            self.mistyped(key, value, "a number");
            return None;
        };
        let range = key.kind.range();
        let Some(message) = range_mistake(range, number) else { return Some(number) };
        let (name, example) = (key.name, key.example);
        self.mistakes.add(
            value.span(),
            format!("`{name}` {message}"),
            format!("write a number from {} to {}, such as `{name} = {example}`", range.start(), range.end()),
        );
        None
    }

    /// A whole number. If it is absent and the key has no default, that is a mistake.
    pub fn whole(&self, key: &Key) -> usize {
        self.whole_within(key, key.kind.whole_range())
    }

    /// A whole number in a range narrower than the range of its key.
    pub fn whole_within(&self, key: &Key, range: RangeInclusive<usize>) -> usize {
        let (low, high) = (*range.start(), *range.end());
        let Some(value) = self.get(key) else {
            let Some(DefaultValue::Number(default)) = key.default else {
                self.missing(key);
                return low;
            };
            return default as usize;
        };
        match as_whole(value.get_ref()) {
            Some(number) if range.contains(&number) => return number,
            Some(_) => self.mistakes.add(
                value.span(),
                format!("`{}` must be from {low} to {high}", key.name),
                format!("write a whole number from {low} to {high}"),
            ),
            None => self.mistyped(key, value, key.kind.wanted()),
        }
        low
    }

    /// Yes or no; the default of the key if the plan leaves the key out.
    pub fn flag(&self, key: &Key) -> bool {
        let default = key.default == Some(DefaultValue::Name("true"));
        let Some(value) = self.get(key) else { return default };
        value.get_ref().as_bool().unwrap_or_else(|| {
            self.mistyped(key, value, key.kind.wanted());
            default
        })
    }

    /// A text, if the plan has the key.
    pub fn text_if(&self, key: &Key) -> Option<At<&'s str>> {
        let value = self.get(key)?;
        let Some(text) = value.get_ref().as_str() else {
            self.mistyped(key, value, key.kind.wanted());
            return None;
        };
        if text.contains(|letter: char| letter.is_control() || turns_text(letter)) {
            self.mistakes.add(
                value.span(),
                format!(
                    "`{}` has a line end or another control character, or one that turns text round",
                    key.name
                ),
                "write it in one line of letters, digits and signs",
            );
        }
        Some(At { value: text, span: value.span() })
    }

    /// A text; its absence is a mistake.
    pub fn text(&self, key: &Key) -> At<&'s str> {
        let text = self.text_if(key).inspect(|text| {
            if names::trimmed(text.value).is_empty() {
                self.mistakes.add(
                    text.span.clone(),
                    format!("`{}` is empty", key.name),
                    "write a few letters",
                );
            }
        });
        text.unwrap_or_else(|| {
            if !self.has(key) {
                self.missing(key);
            }
            At { value: "", span: self.span.clone() }
        })
    }

    /// The name of a row or an option, without invisible characters around it. Its absence is a mistake.
    pub fn name(&self, key: &Key) -> At<&'s str> {
        let At { value, span } = self.text(key);
        At { value: names::trimmed(value), span }
    }

    /// One of the names that the key allows, if the plan has the key.
    pub fn name_if(&self, key: &Key) -> Option<At<&'s str>> {
        self.text_if(key).filter(|text| self.is_known(key, text))
    }

    /// Whether the key allows a name. A name that it does not allow is a mistake.
    fn is_known(&self, key: &Key, name: &At<&str>) -> bool {
        let names = key.kind.names();
        let known = names.contains(&name.value);
        if !known {
            let names: Vec<_> = names.iter().map(|name| format!("\"{name}\"")).collect();
            let message = format!("`{}` cannot be \"{}\"", key.name, name.value);
            self.mistakes.add(name.span.clone(), message, format!("write one of {}", names.join(", ")));
        }
        known
    }

    /// A choice, if the plan has the key.
    pub fn choice_if<T: FromStr>(&self, key: &Key) -> Option<T> {
        self.name_if(key)?.value.parse().ok()
    }

    /// A choice; `otherwise` if the plan has none. The absence of a required key is a mistake.
    pub fn choice<T: FromStr>(&self, key: &Key, otherwise: T) -> T {
        if key.required && !self.has(key) {
            self.missing(key);
        }
        self.choice_if(key).unwrap_or(otherwise)
    }

    /// Bytes of the value of `key`; bytes of the section's header if the section lacks the key.
    pub fn span_of(&self, key: &Key) -> Range<usize> {
        let value = self.entries.and_then(|entries| entries.get(key.name));
        value.map_or_else(|| self.span.clone(), Spanned::span)
    }

    /// Ends the reading. Every key that no function asked for is unknown, which is a mistake.
    pub fn finish(self) {
        let asked = self.asked.borrow();
        let mut known: Vec<_> = self.section.keys.iter().map(|key| key.name).collect();
        known.retain(|name| asked.contains(name));
        for (key, _) in self.entries.into_iter().flat_map(|entries| entries.iter()) {
            let name: &str = key.get_ref();
            if known.contains(&name) {
                continue;
            }
            let renamed = RENAMED.iter().find(|(old, new)| *old == name && known.contains(&new.name));
            let meant = CALLED.iter().find(|(other, key)| *other == name && known.contains(&key.name));
            let near = meant.map(|(_, key)| key.name).or_else(|| nearest(name, known.iter().copied()));
            let remedy = match (renamed, near) {
                (Some((_, new)), _) => format!("the section is now `[{}]`", new.name),
                (None, Some(near)) => format!("did you mean `{near}`?"),
                (None, None) => {
                    let mut known: Vec<_> = known.iter().map(|key| format!("`{key}`")).collect();
                    sort(&mut known);
                    format!("{} knows {}", self.section.title, known.join(", "))
                }
            };
            let message = format!("{} has no key `{name}`", self.section.title);
            self.mistakes.add(key.span(), message, remedy);
        }
    }
}
