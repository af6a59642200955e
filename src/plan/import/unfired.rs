//! Finds holes of a list that do not fire, by words or columns. A tire over such a hole stays where it lies, and its cables catch its
//! neighbours.

use itertools::Itertools;

use super::table::{Line, Table};
use crate::plan::diagnostic::Mistake;

/// Beginning of a value for an entry that is no hole. It counts even in a name.
const DUMMY: &str = "dummy";
/// Whole remarks which say that a hole does not fire. As the beginning of a longer remark they may mean something else.
#[rustfmt::skip]
const UNFIRED_ALONE: &[&str] = &[
    "spare", "backfilled", "blocked", "collapsed", "plugged", "lost",
    "заброшена", "verlassen", "abandonado", "пустая", "отказ", "завалена", "обрушена", "запасная",
];
/// Beginnings of remarks which say that a hole does not fire, in small letters.
const UNFIRED: &[&str] = &[
    "empty",
    "misfire",
    "dud",
    "will not",
    "won't",
    "does not fire",
    "must not",
    "не будет",
    "relief",
    "reamer",
    "skip",
    "unused",
    "not used",
    "do not load",
    "do not fire",
    "inactive",
    "disabled",
    "omit",
    "no charge",
    "not charged",
    "not loaded",
    "uncharged",
    "unloaded",
    "not fired",
    "unfired",
    "deleted",
    "cancel",
    "abandoned",
    "not drilled",
    "без заряда",
    "пустая скв",
    "пустой",
    "компенсац",
    "разгрузоч",
    "пропуст",
    "брак",
    "не заряж",
    "незаряж",
    "не взрыв",
    "холост",
    "удален",
    "отменен",
    "vaci",
    "vací",
    "sin carga",
    "no cargad",
    "leer",
    "nicht geladen",
    "ungeladen",
    "blindloch",
];
/// Names of columns that separate holes that fire from others, without spaces and in small letters.
#[rustfmt::skip]
const TELLS_APART: &[&str] = &[
    "dummy", "isdummy", "charged", "ischarged", "loaded", "fired", "fires", "active", "isactive",
    "enabled", "isenabled", "disabled", "isdisabled", "inuse", "included", "excluded", "skip", "skipped",
    "заряжена", "заряжено", "заряжен", "взрывается", "инициируется", "cargado", "cargada", "geladen",
];
/// Beginnings of words in the names of columns for the charge of a hole (first list), and whole names (second list), in small letters.
#[rustfmt::skip]
const CHARGE: &[&str] = &[
    "charge", "explosive", "booster", "anfo", "emulsion", "заряд", "взрывч", "carga", "explosiv", "ladung", "ladegewicht", "lademenge",
    "sprengstoff",
];
const CHARGE_NAMES: &[&str] = &["product", "measuredmass", "вв", "ввкг"];
/// Values of such a column for an empty hole, in small letters.
#[rustfmt::skip]
const NOTHING: &[&str] = &[
    "", "-", "–", "—", "no", "none", "n", "n/a", "na", "null", "false", "nil", "нет", "без", "не", "nein", "keine", "ohne", "ninguno", "sin",
];

/// Whether a value says that its hole does not fire. `is_remark`: the value is no name; a name may hold such a word by chance.
pub fn says(value: &str, is_remark: bool) -> bool {
    let plain = value.trim().to_lowercase().replace(['_', '-'], " ").replace('ё', "е");
    let says =
        || UNFIRED_ALONE.contains(&plain.as_str()) || UNFIRED.iter().any(|word| plain.starts_with(word));
    plain.starts_with(DUMMY) || is_remark && says()
}

/// Whether a column of this name states which holes fire.
fn is_flag(name: &str) -> bool {
    let letters: String = name.to_lowercase().chars().filter(|letter| letter.is_alphabetic()).collect();
    TELLS_APART.contains(&letters.as_str())
}

/// Notes a mistake for a column that separates holes that fire from others.
pub fn tells_apart(table: &Table, mistakes: &mut Vec<Mistake>) {
    let Some((head, lines)) = table.lines.split_first().filter(|_| table.has_header) else { return };
    for (n, name) in head.values.iter().enumerate() {
        let value = |line: &Line| line.values.get(n).map(|value| value.trim().to_lowercase());
        let differs = || lines.windows(2).any(|pair| value(&pair[0]) != value(&pair[1]));
        if is_flag(name) && differs() {
            let message = format!("the column `{name}` tells holes apart: does each of them fire?");
            let remedy = "remove the lines of those that do not, and the column";
            mistakes.push(Mistake::new(head.span.clone(), message, remedy));
        }
    }
}

/// Notes a mistake for holes without any charge, if other holes have one.
pub fn without_charge(table: &Table, mistakes: &mut Vec<Mistake>) {
    let Some((head, lines)) = table.lines.split_first().filter(|_| table.has_header) else { return };
    let is_amount = |name: &str| {
        let small = name.to_lowercase();
        let begins = |word: &str| CHARGE.iter().any(|part| word.starts_with(part));
        let mut words = small.split(|sign: char| !sign.is_alphabetic());
        !is_flag(name) && words.any(|word| begins(word) || CHARGE_NAMES.contains(&word))
    };
    let amounts: Vec<usize> = (0..head.values.len()).filter(|&n| is_amount(&head.values[n])).collect();
    let is_nothing = |line: &Line, n: usize| {
        let value = line.values.get(n).map(|value| value.trim().to_lowercase()).unwrap_or_default();
        let first = value.split_whitespace().next().unwrap_or_default();
        NOTHING.contains(&first) || first.replace(',', ".").parse() == Ok(0.0)
    };
    let is_empty = |line: &&Line| amounts.iter().all(|&n| is_nothing(line, n));
    if amounts.is_empty() || lines.iter().all(|line| is_empty(&line)) {
        return;
    }
    let names = amounts.iter().map(|&n| format!("`{}`", head.values[n])).join(", ");
    mistakes.extend(lines.iter().filter(is_empty).map(|line| {
        let message = format!("by {names} nothing is in this hole, unlike others: does it fire?");
        let remedy = "remove the line if it does not, else correct the value or remove the column";
        Mistake::new(line.span.clone(), message, remedy)
    }));
}
