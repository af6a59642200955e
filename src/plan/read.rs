//! Reads a section key by key, and collects every mistake instead of stopping at the first.
//!
//! Each reading function returns a usable value. Where the plan has none, the function notes a mistake and makes a value up;
//! a plan with mistakes is never handed on. A key that no function asked for is unknown.

use std::cell::RefCell;
use std::ops::{Range, RangeInclusive};
use std::str::FromStr;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::Mistake;
use super::keys::{DefaultValue, Key, Kind, Section};

/// Mistakes found so far.
#[derive(Debug, Default)]
pub struct Mistakes(RefCell<Vec<Mistake>>);

impl Mistakes {
    /// Notes a mistake.
    pub fn add(&self, span: Range<usize>, message: impl Into<String>, remedy: impl Into<String>) {
        let (message, remedy) = (message.into(), remedy.into());
        self.0.borrow_mut().push(Mistake { span, message, remedy });
    }

    /// Number of mistakes so far.
    pub fn count(&self) -> usize {
        self.0.borrow().len()
    }

    /// All mistakes.
    pub fn take(self) -> Vec<Mistake> {
        self.0.into_inner()
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
pub struct Table<'s> {
    section: &'static Section,
    /// Bytes of its header.
    pub span: Range<usize>,
    /// `None`: the plan leaves the section out.
    entries: Option<&'s DeTable<'s>>,
    asked: RefCell<Vec<&'static str>>,
    mistakes: &'s Mistakes,
}

impl<'s> Table<'s> {
    /// A section found at `span`.
    pub fn new(
        section: &'static Section,
        span: Range<usize>,
        entries: &'s DeTable<'s>,
        mistakes: &'s Mistakes,
    ) -> Self {
        Self { section, span, entries: Some(entries), asked: RefCell::default(), mistakes }
    }

    /// Notes a mistake about the value of `key`, or about the section where it has no such key.
    pub fn wrong(&self, key: &Key, message: impl Into<String>, remedy: impl Into<String>) {
        self.mistakes.add(self.span_of(key), message, remedy);
    }

    /// Whether the plan has the key.
    pub fn has(&self, key: &Key) -> bool {
        self.get(key).is_some()
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

    /// A number; its absence is a mistake where the key has no default.
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
        let Some(message) = out_of(range, number) else { return Some(number) };
        let (name, example) = (key.name, key.example);
        self.mistakes.add(
            value.span(),
            format!("`{name}` {message}"),
            format!("write a number from {} to {}, such as `{name} = {example}`", range.start(), range.end()),
        );
        None
    }

    /// A whole number; its absence is a mistake where the key has no default.
    pub fn whole(&self, key: &Key) -> usize {
        self.whole_within(key, key.kind.whole_range())
    }

    /// A whole number within a range narrower than that of its key.
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

    /// A text, if the plan has the key.
    pub fn text_if(&self, key: &Key) -> Option<At<&'s str>> {
        let value = self.get(key)?;
        let Some(text) = value.get_ref().as_str() else {
            self.mistyped(key, value, key.kind.wanted());
            return None;
        };
        if text.contains(char::is_control) {
            self.mistakes.add(
                value.span(),
                format!("`{}` has a line end or another control character", key.name),
                "write it in one line of letters, digits and signs",
            );
        }
        Some(At { value: text, span: value.span() })
    }

    /// A text; its absence is a mistake.
    pub fn text(&self, key: &Key) -> At<&'s str> {
        self.text_if(key).unwrap_or_else(|| {
            if !self.has(key) {
                self.missing(key);
            }
            At { value: "", span: self.span.clone() }
        })
    }

    /// One of the names that the key allows, if the plan has the key.
    pub fn name_if(&self, key: &Key) -> Option<At<&'s str>> {
        self.text_if(key).filter(|text| self.is_known(key, text))
    }

    /// Whether the key allows a name; if not, that is a mistake.
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

    /// A choice; its absence is a mistake where the key is required.
    pub fn choice<T: FromStr + std::default::Default>(&self, key: &Key) -> T {
        if key.required && !self.has(key) {
            self.missing(key);
        }
        self.choice_if(key).unwrap_or_default()
    }

    /// A list of choices, if the plan has the key.
    pub fn choices<T: FromStr>(&self, key: &Key) -> Option<Vec<T>> {
        let names = self.texts(key)?.value;
        let known = names.iter().filter(|name| self.is_known(key, name));
        Some(known.filter_map(|name| name.value.parse().ok()).collect())
    }

    /// A list of texts, if the plan has the key.
    pub fn texts(&self, key: &Key) -> Option<At<Vec<At<&'s str>>>> {
        self.list(key, |item| {
            let text = item.get_ref().as_str();
            if text.is_none() {
                self.mistyped(key, item, Kind::Text.wanted());
            }
            text
        })
    }

    /// A list of numbers, each in the range of the key, if the plan has the key.
    pub fn numbers(&self, key: &Key) -> Option<At<Vec<At<f64>>>> {
        self.list(key, |item| Some(self.bounded(key, item).unwrap_or(*key.kind.range().start())))
    }

    /// A list of whole numbers, if the plan has the key; the caller checks their range.
    pub fn wholes(&self, key: &Key) -> Option<At<Vec<At<usize>>>> {
        self.list(key, |item| {
            let number = as_whole(item.get_ref());
            if number.is_none() {
                self.mistyped(key, item, "a whole number of 0 or more");
            }
            number
        })
    }

    /// Two numbers, the smaller first, if the plan has the key.
    pub fn range(&self, key: &Key) -> Option<[f64; 2]> {
        let list = self.numbers(key)?;
        match list.value.as_slice() {
            [low, high] if low.value <= high.value => Some([low.value, high.value]),
            _ => {
                let message = format!("`{}` must be a range, the lower end first", key.name);
                self.mistakes.add(list.span, message, format!("write `{} = {}`", key.name, key.example));
                None
            }
        }
    }

    /// The items of a list that `read` takes; `read` notes a mistake where it takes none.
    fn list<T>(
        &self,
        key: &Key,
        read: impl Fn(&'s Spanned<DeValue<'s>>) -> Option<T>,
    ) -> Option<At<Vec<At<T>>>> {
        let value = self.get(key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.mistyped(key, value, "a list");
            return Some(At { value: Vec::new(), span: value.span() });
        };
        let read = |item| read(item).map(|value| At { value, span: item.span() });
        Some(At { value: items.iter().filter_map(read).collect(), span: value.span() })
    }

    /// A section within this one; `None` where the plan has none, or no table in its place.
    pub fn section_if(&self, key: &Key) -> Option<Table<'s>> {
        let (value, section) = (self.get(key)?, key.kind.section()?);
        let Some(entries) = value.get_ref().as_table() else {
            self.mistakes.add(
                value.span(),
                format!("`{}` must be {}", key.name, key.kind.wanted()),
                format!("write one section {}", section.title),
            );
            return None;
        };
        Some(Table::new(section, value.span(), entries, self.mistakes))
    }

    /// A section within this one; its absence is a mistake.
    pub fn section(&self, key: &Key) -> Option<Table<'s>> {
        if !self.has(key) {
            self.missing_section(key);
        }
        self.section_if(key)
    }

    /// A section within this one; where the plan has none, a section without a key.
    pub fn section_or_empty(&self, key: &Key) -> Table<'s> {
        self.section_if(key).unwrap_or_else(|| Table {
            section: key.kind.section().unwrap_or(self.section),
            span: self.span.clone(),
            entries: None,
            asked: RefCell::default(),
            mistakes: self.mistakes,
        })
    }

    /// A section where a plain value may stand as well, such as `spacing_m = { row = 1.5, column = 1.6 }`.
    pub fn inline_section(&self, key: &Key) -> Option<Table<'s>> {
        self.get(key).filter(|value| value.get_ref().is_table()).and_then(|_| self.section_if(key))
    }

    /// Sections of one kind; where the key is required, their absence is a mistake.
    pub fn sections(&self, key: &Key) -> Vec<Table<'s>> {
        let (Some(value), Some(section)) = (self.get(key), key.kind.section()) else {
            if key.required {
                self.missing_section(key);
            }
            return Vec::new();
        };
        let Some(items) = value.get_ref().as_array() else {
            let remedy = if section.title.starts_with("[[") {
                format!("write a section {} for each", section.title)
            } else {
                format!("write `{} = {}`", key.name, key.example)
            };
            self.mistakes.add(value.span(), format!("`{}` must be {}", key.name, key.kind.wanted()), remedy);
            return Vec::new();
        };
        if key.required && items.is_empty() {
            self.missing_section(key);
        }
        let mut tables = Vec::new();
        for item in items.iter() {
            match item.get_ref().as_table() {
                Some(entries) => tables.push(Table::new(section, item.span(), entries, self.mistakes)),
                None => self.mistyped(key, item, "a table"),
            }
        }
        tables
    }

    fn missing_section(&self, key: &Key) {
        let title = key.kind.section().map_or(key.name, |section| section.title);
        let message = format!("{} has no {title}", self.section.title);
        self.mistakes.add(self.span.clone(), message, format!("add a section {title} with {}", key.example));
    }

    /// Bytes of the value of `key`; those of the section's header where it has no such key.
    pub fn span_of(&self, key: &Key) -> Range<usize> {
        let value = self.entries.and_then(|entries| entries.get(key.name));
        value.map_or_else(|| self.span.clone(), Spanned::span)
    }

    /// Ends the reading: every key that was not asked for is unknown here.
    pub fn finish(self) {
        let asked = self.asked.borrow();
        let mut known: Vec<_> = self.section.keys.iter().map(|key| key.name).collect();
        known.retain(|name| asked.contains(name));
        for (key, _) in self.entries.into_iter().flat_map(|entries| entries.iter()) {
            let name: &str = key.get_ref();
            if known.contains(&name) {
                continue;
            }
            let remedy = nearest(name, known.iter().copied()).map_or_else(
                || {
                    let mut known: Vec<_> = known.iter().map(|key| format!("`{key}`")).collect();
                    known.sort_unstable();
                    format!("{} knows {}", self.section.title, known.join(", "))
                },
                |near| format!("did you mean `{near}`?"),
            );
            let message = format!("{} has no key `{name}`", self.section.title);
            self.mistakes.add(key.span(), message, remedy);
        }
    }
}

/// The name in `known` that is most like `name`, if one is alike.
pub fn nearest<'k>(name: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    let alike = known.map(|word| (strsim::jaro_winkler(name, word), word));
    alike.filter(|(score, _)| *score > 0.8).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, word)| word)
}

/// Why a number is not in a range; `None` where it is.
fn out_of(range: &RangeInclusive<f64>, number: f64) -> Option<String> {
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
fn as_number(value: &DeValue<'_>) -> Option<f64> {
    if let Some(integer) = value.as_integer() {
        return i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64);
    }
    value.as_float()?.as_str().parse().ok()
}

/// A whole number of 0 or more.
fn as_whole(value: &DeValue<'_>) -> Option<usize> {
    let integer = value.as_integer()?;
    // A number that does not fit is past every limit; the message names the limit.
    let number = i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX);
    (number >= 0).then(|| usize::try_from(number).unwrap_or(usize::MAX))
}

fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
