//! Values that hold other values: lists, and sections within a section.

use std::cell::RefCell;
use std::str::FromStr;

use toml::Spanned;
use toml::de::DeValue;

use super::value::as_whole;
use super::{At, SectionReader};
use crate::plan::keys::{Key, Kind};

impl<'s> SectionReader<'s> {
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

    /// A list of whole numbers, if the plan has the key. The caller checks their range.
    pub fn whole_numbers(&self, key: &Key) -> Option<At<Vec<At<usize>>>> {
        self.list(key, |item| {
            let number = as_whole(item.get_ref());
            if number.is_none() {
                self.mistyped(key, item, "a whole number of 0 or more");
            }
            number
        })
    }

    /// Two numbers, the smaller first, if the plan has the key. A plan with 0 gets `exact` twice.
    pub fn range(&self, key: &Key, exact: f64) -> Option<[f64; 2]> {
        let zero = |value: &Spanned<DeValue<'_>>| {
            let number = value.get_ref();
            let digits = number.as_integer().map(|n| n.as_str()).or(number.as_float().map(|n| n.as_str()));
            digits.is_some_and(|digits| digits.parse::<f64>() == Ok(0.0))
        };
        if self.get(key).is_some_and(zero) {
            return Some([exact; 2]);
        }
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

    /// The items of a list that `read` accepts. `read` notes a mistake for every other item.
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

    /// A section within this one; `None` if the plan has none. A value that is no table is a mistake.
    pub fn section_if(&self, key: &Key) -> Option<SectionReader<'s>> {
        let (value, section) = (self.get(key)?, key.kind.section()?);
        let Some(entries) = value.get_ref().as_table() else {
            self.mistakes.add(
                value.span(),
                format!("`{}` must be {}", key.name, key.kind.wanted()),
                format!("write one section {}", section.title),
            );
            return None;
        };
        Some(SectionReader::new(section, value.span(), entries, self.mistakes))
    }

    /// A section within this one; its absence is a mistake.
    pub fn section(&self, key: &Key) -> Option<SectionReader<'s>> {
        if !self.has(key) {
            self.missing_section(key);
        }
        self.section_if(key)
    }

    /// A section within this one. If the plan has none, a section without keys.
    pub fn section_or_empty(&self, key: &Key) -> SectionReader<'s> {
        self.section_if(key).unwrap_or_else(|| SectionReader {
            section: key.kind.section().unwrap_or(self.section),
            span: self.span.clone(),
            entries: None,
            asked: RefCell::default(),
            mistakes: self.mistakes,
        })
    }

    /// The section of a key that may hold a plain value instead, such as `spacing_m = { row = 1.5, column = 1.6 }`.
    pub fn inline_section(&self, key: &Key) -> Option<SectionReader<'s>> {
        self.get(key).filter(|value| value.get_ref().is_table()).and_then(|_| self.section_if(key))
    }

    /// Sections of one kind. If the key is required, their absence is a mistake.
    pub fn sections(&self, key: &Key) -> Vec<SectionReader<'s>> {
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
        let mut sections = Vec::new();
        for item in items.iter() {
            match item.get_ref().as_table() {
                Some(entries) => {
                    sections.push(SectionReader::new(section, item.span(), entries, self.mistakes))
                }
                None => self.mistyped(key, item, "a table"),
            }
        }
        sections
    }

    fn missing_section(&self, key: &Key) {
        let title = key.kind.section().map_or(key.name, |section| section.title);
        let message = format!("{} has no {title}", self.section.title);
        self.mistakes.add(self.span.clone(), message, format!("add a section {title} with {}", key.example));
    }
}
