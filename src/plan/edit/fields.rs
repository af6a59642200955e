//! Fields of the terminal's editor: lists the values in the text of a plan, and replaces one value at a time.

use itertools::Itertools;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

use super::{as_number, free_name, replace_keys, with_line_ends_of};
use crate::plan::assumed::says_assumed;
use crate::plan::keys::{DefaultValue, Key, Kind, Offered, delay, plan};
use crate::plan::names::look_alike;

/// One value of a plan's text.
#[derive(Clone, Debug)]
pub struct EditField {
    /// Heading of the group of fields: `option 20 ms`, `limits`.
    pub group: String,
    /// Label beside the value.
    pub label: &'static str,
    /// Position in the text.
    pub path: Path,
    /// The value as written; empty where the plan leaves the key out.
    pub value: String,
    /// Whether the comment behind the value says that it is assumed.
    pub is_assumed: bool,
}

impl EditField {
    /// Group and label: `option 20 ms: interval, ms`.
    pub fn title(&self) -> String {
        format!("{}: {}", self.group, self.label)
    }

    /// Text for a key that the plan leaves out: its default, or `not set`.
    pub fn unset(&self) -> String {
        match self.path.key.default {
            Some(DefaultValue::Number(default)) => format!("{default} (default)"),
            Some(DefaultValue::Name(default) | DefaultValue::Described(default)) => {
                format!("{default} (default)")
            }
            None => "not set".to_owned(),
        }
    }
}

/// Position of a value: a section, and a key in it.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Name of the section.
    pub section: &'static str,
    /// Index of the section among several of its name.
    pub index: Option<usize>,
    /// The key.
    pub key: &'static Key,
}

/// Sections in the order of the editor, each with its heading. Sections that people change most often come first.
const SECTIONS: [(&Key, &str); 9] = [
    (&plan::DELAY, "option"),
    (&plan::LIMITS, "limits"),
    (&plan::CABLE, "rope"),
    (&plan::BLAST_ROW, "row"),
    (&plan::TIRE, "tires"),
    (&plan::GROUND, "ground"),
    (&plan::SHELTER, "shelter"),
    (&plan::UNCERTAINTY, "not known"),
    (&plan::SIMULATION, "computing"),
];

/// The fields of a plan's text. Keys that the plan leaves out are included if the editor offers them.
pub fn fields(text: &str) -> Vec<EditField> {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let mut fields = Vec::new();
    for (section, heading) in SECTIONS {
        if matches!(section.kind, Kind::Sections(_)) {
            for (n, table) in tables(&document, section.name).enumerate() {
                let name = table.get("name").and_then(Item::as_str).unwrap_or_default();
                fields.extend(of_section(section, Some(n), Some(table), &format!("{heading} {name}")));
            }
        } else {
            let table = document.get(section.name).and_then(Item::as_table_like);
            fields.extend(of_section(section, None, table, heading));
        }
    }
    fields
}

/// The fields of one section.
fn of_section(
    section: &'static Key,
    index: Option<usize>,
    table: Option<&dyn TableLike>,
    group: &str,
) -> Vec<EditField> {
    let written = |name: &str| table.and_then(|table| table.get(name));
    let field = |key: &&'static Key| {
        let edit = key.edit?;
        let value = written(key.name).map(value_text).unwrap_or_default();
        let behind =
            written(key.name).and_then(Item::as_value).and_then(|value| value.decor().suffix()?.as_str());
        let offered = match edit.offered {
            Offered::Never => false,
            Offered::Always => true,
            Offered::Beside(other) => written(other).is_some(),
        };
        let path = Path { section: section.name, index, key };
        let (group, label, is_assumed) = (group.to_owned(), edit.label, behind.is_some_and(says_assumed));
        (offered || !value.is_empty()).then_some(EditField { group, label, path, value, is_assumed })
    };
    let keys = section.kind.section().map_or(&[][..], |section| section.keys);
    keys.iter().filter_map(field).collect()
}

fn tables<'d>(document: &'d DocumentMut, section: &str) -> Box<dyn Iterator<Item = &'d dyn TableLike> + 'd> {
    match document.get(section) {
        Some(Item::ArrayOfTables(tables)) => Box::new(tables.iter().map(|table| table as &dyn TableLike)),
        Some(Item::Value(Value::Array(list))) => Box::new(
            list.iter().filter_map(|value| value.as_inline_table()).map(|table| table as &dyn TableLike),
        ),
        _ => Box::new(std::iter::empty()),
    }
}

/// Names of the blast rows in the firing order of a delay option. An option without an order has the order of the plan.
pub fn order(text: &str, path: &Path) -> Vec<String> {
    let Ok(document) = text.parse::<DocumentMut>() else { return Vec::new() };
    let written = path
        .index
        .and_then(|index| tables(&document, path.section).nth(index)?.get(delay::ORDER.name)?.as_array());
    let names = |list: &toml_edit::Array| list.iter().filter_map(Value::as_str).map(str::to_owned).collect();
    let all = || {
        let name = |row: &dyn TableLike| Some(row.get("name")?.as_str()?.to_owned());
        tables(&document, plan::BLAST_ROW.name).filter_map(name).collect()
    };
    written.map_or_else(all, names)
}

/// A value as written, without spaces and comments around it.
pub(super) fn value_text(item: &Item) -> String {
    let mut value = item.as_value().cloned();
    if let Some(value) = &mut value {
        value.decor_mut().clear();
    }
    value.map_or_else(String::new, |value| value.to_string())
}

/// The text of the plan with another value at `path`, or a message that says why `new` is no value.
///
/// An empty `new` removes the key. A section that the plan leaves out is added. A text needs no quotes, a list no brackets. One number in
/// place of the firing times of an option becomes the interval of the option. Comments and formatting stay.
pub fn set(text: &str, path: &Path, new: &str) -> Result<String, String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| error.message().to_owned())?;
    if path.index.is_none() && !document.contains_key(path.section) {
        if new.trim().is_empty() {
            return Ok(text.to_owned());
        }
        document.insert(path.section, Item::Table(Table::new()));
    }
    let names = names(&document, path.section);
    let table =
        table_mut(&mut document, path).ok_or_else(|| format!("the plan has no [{}]", path.section))?;
    if new.trim().is_empty() {
        table.remove(path.key.name);
        return Ok(with_line_ends_of(text, &document));
    }
    let textual = path.key.kind.is_text();
    let is_list = matches!(path.key.kind, Kind::List(_) | Kind::Range(_));
    if let Some((whole, decimals)) = new.trim().split_once(',').filter(|_| is_list)
        && [whole, decimals].iter().all(|digits| digits.bytes().all(|digit| digit.is_ascii_digit()))
    {
        // Many people write a comma before the decimals: `12,5` may be one number.
        return Err(format!(
            "'{whole},{decimals}' is read two ways: write {whole}.{decimals}, or {whole}, {decimals} with a space"
        ));
    }
    let typed = new.trim().parse::<Value>().or_else(|error| match path.key.kind {
        Kind::List(_) | Kind::RowNames | Kind::Range(_) => format!("[{}]", new.trim()).parse(),
        _ => Err(error),
    });
    let value = match typed {
        Ok(value) if !textual || value.is_str() => value,
        _ if textual => Value::from(new.trim()),
        _ => {
            // Many people write a comma before the decimals.
            let with_point = new.trim().replace(',', ".");
            let meant = if with_point.parse::<f64>().is_ok() { &with_point } else { path.key.example };
            return Err(format!("'{}' is no value here: write it as {meant}", new.trim()));
        }
    };
    let is_of_delay = |key: &Key| path.section == plan::DELAY.name && path.key.name == key.name;
    let replaces_times = is_of_delay(&delay::AT_MS) && as_number(&value).is_some();
    if is_of_delay(&delay::INTERVAL_MS) || replaces_times {
        rename_with_interval(table, &value, &names);
    } else if is_of_delay(&delay::AT_MS) {
        rename_copy_with_times(table, &value, &names);
    }
    match replaces_times {
        true => replace_keys(table, &[&delay::AT_MS], &delay::INTERVAL_MS, value),
        false => super::set(table, path.key.name, value),
    }
    Ok(with_line_ends_of(text, &document))
}

/// Names of all sections of one kind.
fn names(document: &DocumentMut, section: &str) -> Vec<String> {
    let name = |table: &dyn TableLike| table.get("name").and_then(Item::as_str).map(str::to_owned);
    tables(document, section).filter_map(name).collect()
}

/// Renames a delay option after a change of its interval. Without that, the name `25 ms, middle first` or `2-1-3 25 ms` would be a lie
/// about 30 ms. A copy with any other name is named after its interval, because `all at once (2)` would be a lie, too. `names` holds the
/// names of all options.
fn rename_with_interval(table: &mut dyn TableLike, interval: &Value, names: &[String]) {
    let written = |value: &Value| as_number(value).map(|number| format!("{number} ms"));
    let old = table.get(delay::INTERVAL_MS.name).and_then(Item::as_value).and_then(written);
    let name = table.get(delay::NAME.name).and_then(Item::as_str);
    let (Some(new), Some(name)) = (written(interval), name) else { return };
    let (original, copied) = (without_number(name), copied_name(name, names));
    let (is_copy, told) = (copied.is_some(), copied.unwrap_or(name));
    let around = old.as_ref().and_then(|old| around_interval(told, old));
    let [before, after] = match around {
        // A name such as `20 ms (2)` loses its number: the number only distinguished two options of 20 ms.
        Some(_) if original == old.as_deref() => ["", ""],
        Some(around) => around,
        None if is_copy => ["", ""],
        // The name `all at once` would be a lie about rows that fire apart.
        None if old.as_deref() == Some("0 ms") && new != "0 ms" => ["", ""],
        None => return,
    };
    let is_taken = |new: &str| new != name && names.iter().any(|taken| look_alike(taken, new));
    let new = free_name(&format!("{before}{new}{after}"), is_taken);
    super::set(table, delay::NAME.name, new.into());
}

/// Names a copy after its firing times, `0/30/60 ms`: its old name is about the times of the original.
fn rename_copy_with_times(table: &mut dyn TableLike, times: &Value, names: &[String]) {
    let name = table.get(delay::NAME.name).and_then(Item::as_str).unwrap_or_default();
    let Some(times) = times.as_array().filter(|_| copied_name(name, names).is_some()) else { return };
    let times = times.iter().filter_map(as_number).join("/");
    let is_taken = |new: &str| new != name && names.iter().any(|taken| look_alike(taken, new));
    let new = free_name(&format!("{times} ms"), is_taken);
    super::set(table, delay::NAME.name, new.into());
}

/// Name of the original in the name of a copy, without the number that distinguishes the copy. The original is one of `names`. `None`:
/// `name` is no copy.
fn copied_name<'n>(name: &'n str, names: &[String]) -> Option<&'n str> {
    without_number(name).filter(|original| names.iter().any(|name| name == original))
}

/// Part of a name such as `42 ms (2)` before the number; `None` for a name without a number.
fn without_number(name: &str) -> Option<&str> {
    let (original, number) = name.strip_suffix(')')?.rsplit_once(" (")?;
    number.bytes().all(|letter| letter.is_ascii_digit()).then_some(original)
}

/// Parts of a name before and behind an interval between rows. `None` if the interval stands only inside other words, or is an interval
/// between holes.
fn around_interval<'n>(name: &'n str, interval: &str) -> Option<[&'n str; 2]> {
    let places = name.match_indices(interval).map(|(at, _)| [&name[..at], &name[at + interval.len()..]]);
    let is_word = |[before, after]: &[&str; 2]| {
        let begins = before.is_empty() || before.ends_with(' ') && !before.trim_end().ends_with("holes");
        begins && !after.starts_with(char::is_alphanumeric)
    };
    places.into_iter().find(is_word)
}

fn table_mut<'d>(document: &'d mut DocumentMut, path: &Path) -> Option<&'d mut dyn TableLike> {
    let item = document.get_mut(path.section)?;
    let Some(index) = path.index else { return item.as_table_like_mut() };
    match item {
        Item::ArrayOfTables(tables) => tables.get_mut(index).map(|table| table as &mut dyn TableLike),
        Item::Value(Value::Array(list)) => {
            list.get_mut(index)?.as_inline_table_mut().map(|table| table as &mut dyn TableLike)
        }
        _ => None,
    }
}

/// The text with a copy of one delay option. The copy stands behind the option, and has a new name.
pub fn copy_delay(text: &str, index: usize) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    let names = names(&document, "delay");
    let new = free_name(names.get(index)?, |new| names.iter().any(|taken| look_alike(taken, new)));
    match document.get_mut("delay")? {
        Item::ArrayOfTables(tables) => {
            let mut all: Vec<Table> = tables.iter().cloned().collect();
            let mut copy = all.get(index)?.clone();
            super::set(&mut copy, "name", Value::from(new));
            copy.decor_mut().set_prefix("\n");
            all.insert(index + 1, copy);
            replace(tables, all);
        }
        Item::Value(Value::Array(list)) => {
            let mut copy = list.get(index)?.clone();
            copy.as_inline_table_mut()?.insert("name", Value::from(new));
            list.insert_formatted(index + 1, copy);
        }
        _ => return None,
    }
    Some(with_line_ends_of(text, &document))
}

/// The text without one delay option; `None` where the plan has no other option.
pub fn remove_delay(text: &str, index: usize) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    match document.get_mut("delay")? {
        Item::ArrayOfTables(tables) if tables.len() > 1 && index < tables.len() => {
            tables.remove(index);
        }
        Item::Value(Value::Array(list)) if list.len() > 1 && index < list.len() => {
            list.remove(index);
        }
        _ => return None,
    }
    Some(with_line_ends_of(text, &document))
}

/// Replaces all tables. In the text they stand together, in the order of `all`.
fn replace(tables: &mut toml_edit::ArrayOfTables, all: Vec<Table>) {
    let first = tables.iter().filter_map(Table::position).min();
    tables.clear();
    for mut table in all {
        table.set_position(first);
        tables.push(table);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = include_str!("../../../tests/fixtures/amur-three-rows.toml");

    fn find(text: &str, section: &str, index: Option<usize>, key: &str) -> EditField {
        let mut all = fields(text).into_iter();
        all.find(|f| f.path.section == section && f.path.index == index && f.path.key.name == key)
            .expect("a field")
    }

    /// The name `9+25 ms (2)` would be a lie about a copy that fires at other times. An option that is no copy keeps its name.
    #[test]
    fn a_copy_is_named_after_its_own_firing_times() {
        let listed =
            PLAN.replace("\"9 ms\"", "\"9+25 ms\"").replace("interval_ms = 9\n", "at_ms = [0, 9, 34]\n");
        let copy = copy_delay(&listed, 1).expect("a copy");
        let names = |text: &str| names(&text.parse().expect("TOML"), "delay");
        assert_eq!(names(&copy)[2], "9+25 ms (2)");
        let set = |index: usize| {
            let field = find(&copy, "delay", Some(index), "at_ms");
            names(&set(&copy, &field.path, "0, 30, 60").expect("times"))
        };
        assert_eq!(set(2)[1..3], ["9+25 ms", "0/30/60 ms"]);
        assert_eq!(set(1)[1..3], ["9+25 ms", "9+25 ms (2)"], "told by a warning");
    }

    #[test]
    fn one_value_changes_and_nothing_else() {
        let field = find(PLAN, "delay", Some(1), "interval_ms");
        assert_eq!(field.value, "9");
        let new = set(PLAN, &field.path, "12.5").expect("a value");
        let renamed =
            PLAN.replace("\"9 ms\"", "\"12.5 ms\"").replace("interval_ms = 9", "interval_ms = 12.5");
        assert_eq!(new, renamed);
        let rope = find(PLAN, "cable", None, "rope");
        let new = set(PLAN, &rope.path, "GOST 2688-80 15").expect("a value");
        assert_eq!(new, PLAN.replace("\"GOST 2688-80 14 1960\"", "\"GOST 2688-80 15\""));
        assert!(set(PLAN, &field.path, "nine").is_err());
        let windows = PLAN.replace('\n', "\r\n");
        let new = set(&windows, &field.path, "12.5").expect("a value");
        assert_eq!(new, renamed.replace('\n', "\r\n"));
    }

    #[test]
    fn a_name_that_is_the_interval_follows_it() {
        let renamed = |name: &str, new: &str| {
            let text = format!(
                "[[delay]]\nname = \"{name}\"\ninterval_ms = 25\n[[delay]]\nname = \"42 ms\"\n[[delay]]\nname = \"25 ms, last first\"\n"
            );
            let field = find(&text, "delay", Some(0), "interval_ms");
            let text = set(&text, &field.path, new).expect("a value");
            find(&text, "delay", Some(0), "name").value
        };
        assert_eq!(renamed("25 ms, middle first", "30.5"), "\"30.5 ms, middle first\"");
        assert_eq!(renamed("25 ms", "42"), "\"42 ms (2)\"", "names differ");
        assert_eq!(renamed("25 ms", "25"), "\"25 ms\"");
        assert_eq!(renamed("25 ms (2)", "33"), "\"33 ms\"");
        assert_eq!(renamed("42 ms (2)", "33"), "\"33 ms\"", "a copy of an option with another name");
        assert_eq!(renamed("25 ms, last first (2)", "33"), "\"33 ms, last first\"", "a copy's number");
        assert_eq!(renamed("3-2-1 25 ms", "33"), "\"3-2-1 33 ms\"");
        assert_eq!(renamed("3-2-1 25 ms, holes 25 ms left", "33"), "\"3-2-1 33 ms, holes 25 ms left\"");
        for name in ["25 msec", "middle first", "middle first (2)", "125 ms", "9+25 ms", "holes 25 ms left"] {
            assert_eq!(renamed(name, "30"), format!("\"{name}\""));
        }
    }

    /// `12,5` may be one number or two, so it is refused. As two firing times, which nobody meant, it would make the second row fire first.
    #[test]
    fn a_comma_between_digits_is_asked_about() {
        let text = PLAN.replace("interval_ms = 9\n", "at_ms = [0, 9, 18]\n");
        let times = find(&text, "delay", Some(1), "at_ms");
        assert!(set(&text, &times.path, "12,5").is_err_and(|told| told.contains("12.5, or 12, 5")));
        let slack = find(PLAN, "uncertainty", None, "slack_percent");
        assert!(set(PLAN, &slack.path, "1,5").is_err());
        for two in ["1, 5", "0.4,0.6", "[1,5]"] {
            assert!(set(PLAN, &slack.path, two).is_ok(), "{two}");
        }
        assert!(set(&text, &times.path, "0,12,24").is_ok());
    }

    #[test]
    fn a_section_that_the_plan_leaves_out_is_added() {
        let (without, _) = PLAN.split_once("\n[uncertainty]").expect("a section");
        let field = find(without, "uncertainty", None, "friction");
        assert_eq!(field.value, "");
        let new = set(without, &field.path, "0.4, 0.6").expect("a value");
        assert_eq!(new, format!("{without}\n[uncertainty]\nfriction = [0.4, 0.6]\n"));
        let plan = crate::plan::Plan::parse("", &new).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert_eq!(plan.uncertainty.friction, [0.4, 0.6]);
        assert_eq!(set(without, &field.path, "").as_deref(), Ok(without));
    }

    #[test]
    fn options_are_copied_behind_themselves_and_removed() {
        let copied = copy_delay(PLAN, 1).expect("a copy");
        let plan =
            crate::plan::Plan::parse("", &copied).unwrap_or_else(|mistakes| panic!("{mistakes}\n{copied}"));
        let names: Vec<&str> = plan.delays.iter().map(|delay| delay.name.as_str()).collect();
        assert_eq!(&names[..4], ["all at once", "9 ms", "9 ms (2)", "20 ms"]);
        let removed = remove_delay(&copied, 2).expect("removed");
        assert_eq!(crate::plan::Plan::parse("", &removed).map(|plan| plan.delays.len()).ok(), Some(7));
        assert!(PLAN.lines().all(|line| removed.contains(line)), "comments stay:\n{removed}");
        assert_eq!(remove_delay("[[delay]]\nname = \"a\"\n", 0), None);
        let inline = "delay = [{ name = \"a\", at_ms = [0] }, { name = \"b\", at_ms = [1] }]\n";
        let copied = copy_delay(inline, 0).expect("a copy");
        let three = inline.replace(" }, ", " }, { name = \"a (2)\", at_ms = [0] }, ");
        assert_eq!(copied.replace(",{", ", {"), three);
        assert_eq!(remove_delay(&copied, 1).as_deref(), Some(inline));
        assert_eq!(remove_delay("delay = [{ name = \"a\" }]\n", 0), None);
    }
}
