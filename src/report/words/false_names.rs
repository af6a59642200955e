//! Names of options that say what the option does not do. Whoever programs detonators by such a name fires a shot that nobody
//! judged.

use itertools::Itertools;

use super::option_sentences;
use crate::plan::{BlastRow, COMMON_DELAYS_MS, DelayOption, Plan, Time};
use crate::report::language::{phrase, say};
use crate::sorting::{sort, sorted_by_key};

/// Warnings about false names of all options.
pub fn warnings(plan: &Plan) -> impl Iterator<Item = String> {
    plan.delays.iter().flat_map(|delay| of_option(plan, delay))
}

fn of_option<'p>(plan: &'p Plan, delay: &'p DelayOption) -> impl Iterator<Item = String> + 'p {
    let rows = &plan.blast_rows;
    let of_numbers = false_intervals(delay, plan.delays.len()).or_else(|| false_number(delay));
    let of_order = false_order(delay, rows).or_else(|| false_first(delay, rows));
    let of_rows = [of_numbers, false_times(delay), of_order];
    of_rows.into_iter().flatten().chain(false_hole_timing(delay))
}

/// Line to confirm for an option whose name has words that nobody compares with the firing times, or whose blast rows are not numbered in
/// the order of the plan: a reader may take either for another order. `None` where a warning says what the name gets wrong.
pub fn own_words(plan: &Plan, option: usize) -> Option<String> {
    let (delay, rows) = (&plan.delays[option], &plan.blast_rows);
    let numbers: Option<Vec<u32>> = rows.iter().map(|row| row.name.parse().ok()).collect();
    let is_turned = numbers.is_some_and(|numbers| !numbers.is_sorted());
    let (name, times) = (&delay.name, option_sentences::firing_times_text(rows, delay));
    let is_false = of_option(plan, delay).next().is_some();
    (!is_false && (is_turned || !is_compared(delay, rows)))
        .then(|| say!("\"{name}\" fires rows {times}: is that what its name says?", name, times))
}

/// Whether the name of an option has nothing but intervals, firing times, the order of its rows and the timing of its holes: all of these
/// are compared with the plan.
fn is_compared(delay: &DelayOption, rows: &[BlastRow]) -> bool {
    let holes = delay.hole_timing.words();
    let parts = delay.name.split(',').map(str::trim).filter(|part| holes.as_deref() != Some(*part));
    let words: Vec<&str> = parts.flat_map(str::split_whitespace).collect();
    let is_number = |text: &str| text.chars().all(|sign| sign.is_ascii_digit() || "./+()".contains(sign));
    let is_unit = |text: &str| intervals_of(&format!("1{text}")).is_some();
    let is_row = |part: &str| part.is_empty() || rows.iter().any(|row| row.name == part);
    let is_known = |word: &str| {
        let (number, unit) = word.split_at(word.trim_end_matches(char::is_alphabetic).len());
        is_number(number) && (unit.is_empty() || is_unit(unit)) || word.split(['-', '>']).all(is_row)
    };
    // An order of some rows alone, and numbers side by side, may be meant as an order.
    let has_order = delay.name.contains(['-', '>']);
    let bare_numbers = words.iter().filter(|word| word.parse::<f64>().is_ok()).count();
    let is_order_compared = if has_order { named_order(delay, rows).is_some() } else { bare_numbers <= 1 };
    let at_once = delay.name == AT_ONCE && gaps(delay).iter().all(|gap| *gap == Time::default());
    at_once || is_order_compared && words.into_iter().all(is_known)
}

/// Name of an option whose rows all fire at once.
const AT_ONCE: &str = "all at once";

/// Warning that a name says other intervals than the rows have: `42 ms` at 109 ms, `42+67 ms` at 30 and 60 ms. A number alone is an
/// interval, too, unless it may be the number of one of `count` options.
fn false_intervals(delay: &DelayOption, count: usize) -> Option<String> {
    let name = &delay.name;
    let alone = || name.trim().parse::<f64>().ok().filter(|number| *number > count as f64);
    let named = intervals(name).map(|(_, named)| named).or_else(|| Some(vec![Time::from_ms(alone()?)]))?;
    let gaps = gaps(delay);
    let fired = match &named[..] {
        [named] => vec![*gaps.iter().find(|gap| *gap != named)?],
        _ => Some(gaps).filter(|gaps| *gaps != named)?,
    };
    let [fired, named] = [fired, named].map(|gaps| gaps.iter().map(Time::to_string).join("+"));
    Some(say!(
        "the option named \"{name}\" fires its rows {fired} ms apart, not {named} ms",
        name,
        fired,
        named
    ))
}

/// Warning that a name says a common delay time without a unit, and the option has that time nowhere: `delay 42` at 17 ms.
fn false_number(delay: &DelayOption) -> Option<String> {
    let DelayOption { name, timing, hole_timing } = delay;
    let words = name.split([' ', ',', ';', '_']);
    let mut numbers = words.filter_map(|word| word.parse().ok()).filter(|ms| COMMON_DELAYS_MS.contains(ms));
    let has = |time: Time| {
        gaps(delay).contains(&time) || timing.fire_at().contains(&time) || hole_timing.interval == time
    };
    let named = numbers.find(|ms| !has(Time::from_ms(*ms)))?;
    // Where a name has intervals with a unit, its other numbers promise no time.
    intervals(name)
        .is_none()
        .then(|| say!("the option named \"{name}\" fires nothing {named} ms apart", name, named))
}

/// Warning that a name says that a row fires first, last or before another row, and the row does not: `row 2 first`.
fn false_first(delay: &DelayOption, rows: &[BlastRow]) -> Option<String> {
    let DelayOption { name, timing, .. } = delay;
    let at = timing.fire_at();
    let small = name.to_lowercase();
    let words = small.split([' ', ',', ';']).filter(|word| !word.is_empty() && !ROW.contains(word));
    let words: Vec<&str> = words.collect();
    // Screens ask of every option at every repaint: most names have no such word.
    if !words.iter().any(|word| [FIRST, LAST, BEFORE].iter().any(|known| known.contains(word))) {
        return None;
    }
    // An ordinal number has an ending: `2.`, `2-й`, `2ª`.
    let number = |word: &str| word.trim_end_matches(['.', '-', 'й', 'ª', 'º']).to_owned();
    let row = |word: &str| {
        rows.iter().position(|row| [word.to_owned(), number(word)].contains(&row.name.to_lowercase()))
    };
    let is_otherwise = |pair: &[&str]| {
        row(pair[0]).is_some_and(|row| {
            FIRST.contains(&pair[1]) && at.iter().any(|other| *other < at[row])
                || LAST.contains(&pair[1]) && at.iter().any(|other| *other > at[row])
        })
    };
    let in_turn = sorted_by_key(0..rows.len(), |&row| at[row]);
    let fired = in_turn.into_iter().map(|row| rows[row].name.as_str()).join(", ");
    let is_turned = |words: &[&str]| {
        let pair = row(words[0]).zip(row(words[2])).filter(|_| BEFORE.contains(&words[1]));
        pair.is_some_and(|(one, other)| at[one] > at[other])
    };
    let is_told = words.windows(2).any(is_otherwise) || words.windows(3).any(is_turned);
    is_told.then(|| say!("the option named \"{name}\" fires its rows in the order {fired}", name, fired))
}

/// Words for a row, in small letters. They may stand between its name and the word of order: `2 ряд первым`.
const ROW: &[&str] = &["row", "ряд", "reihe", "fila", "rangée"];
/// Words that say that a row fires first, last, or before another row, in small letters.
#[rustfmt::skip]
const FIRST: &[&str] = &[
    "first", "первый", "первым", "первая", "вначале", "zuerst", "erste", "primero", "primera", "premier", "première",
];
#[rustfmt::skip]
const LAST: &[&str] =
    &["last", "последний", "последним", "zuletzt", "letzte", "último", "última", "ultimo", "dernier", "dernière"];
const BEFORE: &[&str] = &["before", "перед", "раньше", "vor", "antes", "avant"];

/// Intervals between the rows, in the order in which the rows fire.
fn gaps(delay: &DelayOption) -> Vec<Time> {
    let mut times = delay.timing.fire_at();
    sort(&mut times);
    times.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Warning that a name says other firing times than the rows have, written as this program writes them: `0/17 ms` at 0/42 ms. The
/// numbers may also be intervals.
fn false_times(delay: &DelayOption) -> Option<String> {
    let DelayOption { name, timing, .. } = delay;
    let at = timing.fire_at();
    let of_word = |word: &str| {
        let numbers = word.split('/').map(|number| Some(Time::from_ms(number.parse().ok()?)));
        numbers.collect::<Option<Vec<Time>>>().filter(|numbers| numbers.len() > 1)
    };
    let named = name.split([' ', ',', ';']).find_map(of_word)?;
    let gaps = gaps(delay);
    let joined = |times: &[Time]| times.iter().map(Time::to_string).join("/");
    let [fired, said] = [&at, &named].map(|times| joined(times));
    // Other numbers, such as a date, are no times of these rows.
    let is_of_rows = [at.len(), gaps.len()].contains(&named.len());
    (is_of_rows && named != at && named != gaps).then(|| {
        say!("the option named \"{name}\" fires its rows at {fired} ms, not {said}", name, fired, said)
    })
}

/// The rows in the order that a name gives: `3-2-1 20 ms`, `3 > 2 > 1, 20 ms`; `None` if it does not give every row once.
fn named_order(delay: &DelayOption, rows: &[BlastRow]) -> Option<Vec<usize>> {
    let name = &delay.name;
    let end = intervals(name).map_or(name.len(), |(start, _)| start);
    let before = name[..end].split(',').next().unwrap_or_default().trim();
    let named_in = |separator: &str| {
        let named = before.split(separator).map(str::trim);
        let named =
            named.map(|name| rows.iter().position(|row| row.name == name)).collect::<Option<Vec<_>>>()?;
        (named.len() == rows.len() && rows.len() > 1 && named.iter().all_unique()).then_some(named)
    };
    named_in("-").or_else(|| named_in(">"))
}

/// Warning that a name says another order of rows than the order in which they fire: `3-2-1 20 ms`, `3 > 2 > 1, 20 ms`.
fn false_order(delay: &DelayOption, rows: &[BlastRow]) -> Option<String> {
    let DelayOption { name, timing, .. } = delay;
    let named = named_order(delay, rows)?;
    let at = timing.fire_at();
    if named.windows(2).all(|pair| at[pair[0]] <= at[pair[1]]) {
        return None;
    }
    let in_turn = sorted_by_key(0..rows.len(), |&row| at[row]);
    let fired = in_turn.into_iter().map(|row| rows[row].name.as_str()).join(", ");
    Some(say!("the option named \"{name}\" fires its rows in the order {fired}", name, fired))
}

/// Warning that a name says another timing of the holes of a row than the option has: `holes 17 ms left`.
fn false_hole_timing(delay: &DelayOption) -> Option<String> {
    let DelayOption { name, hole_timing, .. } = delay;
    let named = name.split(',').map(str::trim).find(|part| part.starts_with(HOLES))?;
    // Other words about holes promise nothing.
    intervals_of(named.trim_start_matches(HOLES).trim())?;
    // A name need not say from which side.
    if hole_timing.words().is_some_and(|words| words == named || words.starts_with(&format!("{named} "))) {
        return None;
    }
    let at_once = || phrase("all holes of a row at once").to_owned();
    let fired = option_sentences::hole_timing(hole_timing).unwrap_or_else(at_once);
    Some(say!("the option named \"{name}\" fires otherwise: {fired}", name, fired))
}

/// Word before an interval between the holes of a row.
const HOLES: &str = "holes";

/// Byte at which the intervals between rows begin in a name, and these intervals; `None` where the name has none.
fn intervals(name: &str) -> Option<(usize, Vec<Time>)> {
    let starts =
        name.char_indices().filter(|(at, _)| name[..*at].chars().last().is_none_or(char::is_whitespace));
    let is_of_holes = |at: usize| name[..at].trim_end().ends_with(HOLES);
    let mut found = starts
        .filter(|(at, _)| !is_of_holes(*at))
        .filter_map(|(at, _)| Some((at, intervals_of(&name[at..])?)));
    found.next()
}

/// Intervals with which a text begins: `42+67 ms, …`. The unit is milliseconds or seconds, in any letters that people use for it,
/// capital or Cyrillic.
fn intervals_of(text: &str) -> Option<Vec<Time>> {
    let end = text.find(|letter: char| !letter.is_ascii_digit() && !['.', ',', '+'].contains(&letter))?;
    let (numbers, unit) = text.split_at(end);
    let unit: String = unit.trim_start().chars().take_while(|letter| letter.is_alphabetic()).collect();
    let unit = unit.to_lowercase().replace('ѕ', "s");
    let mut letters = unit.chars();
    let in_ms = match [letters.next(), letters.next()] {
        [Some('m' | 'м'), Some('s' | 'с')] => 1.0,
        _ if SECONDS.contains(&unit.as_str()) => 1e3,
        _ => return None,
    };
    let number = |number: &str| Some(Time::from_ms(in_ms * number.replace(',', ".").parse::<f64>().ok()?));
    numbers.split('+').map(number).collect()
}

/// Words for seconds.
const SECONDS: [&str; 9] = ["s", "sec", "secs", "second", "seconds", "с", "сек", "секунд", "секунды"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    const AS_IS: [&str; 2] = ["\"1\""; 2];

    /// A plan with an option that fires its rows so, and one edit of its text.
    fn plan(name: &str, timing: &str, edit: [&str; 2]) -> Plan {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let (before, after) = text.split_once("name = \"9 ms\"\ninterval_ms = 9\n").expect("an option");
        // No other option may have the name.
        let [before, after] =
            [before.replace("\"all at once\"", "\"another\""), after.replace("\"42 ms\"", "\"one more\"")];
        let text = format!("{before}name = \"{name}\"\n{timing}\n{after}").replace(edit[0], edit[1]);
        Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// The warnings of an option that fires the rows 1, 2, 3 so.
    fn told(name: &str, timing: &str) -> Vec<String> {
        warnings(&plan(name, timing, AS_IS)).collect()
    }

    #[test]
    fn a_name_that_says_what_is_not_so_is_told() {
        let at = |times: [u32; 3]| format!("at_ms = {times:?}");
        for (name, timing, warning) in [
            ("40 ms", at([0, 42, 84]), "fires its rows 42 ms apart, not 40 ms"),
            ("0.017 s between rows", at([0, 42, 84]), "fires its rows 42 ms apart, not 17 ms"),
            ("0,017 s", at([0, 42, 84]), "fires its rows 42 ms apart, not 17 ms"),
            ("0,1 сек", at([0, 42, 84]), "fires its rows 42 ms apart, not 100 ms"),
            ("0.1 sec", at([0, 42, 84]), "fires its rows 42 ms apart, not 100 ms"),
            ("3-2-1 20 ms", at([50, 25, 0]), "fires its rows 25 ms apart, not 20 ms"),
            ("ours, 20ms", at([0, 25, 50]), "fires its rows 25 ms apart, not 20 ms"),
            ("17", at([0, 42, 84]), "fires its rows 42 ms apart, not 17 ms"),
            ("0/17/34 ms", at([0, 42, 84]), "fires its rows at 0/42/84 ms, not 0/17/34"),
            // Times stand in the order of the rows. Whoever wires the first row at 0 fires the last row last.
            ("0/42/84", at([84, 42, 0]), "fires its rows at 84/42/0 ms, not 0/42/84"),
            ("ours, 17/42", at([0, 42, 84]), "fires its rows at 0/42/84 ms, not 17/42"),
            ("42+67 ms", at([0, 42, 84]), "fires its rows 42+42 ms apart, not 42+67 ms"),
            ("3-2-1 20 ms", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("delay 42", at([0, 17, 34]), "fires nothing 42 ms apart"),
            ("row 2 first", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("17, 2 before 1", at([0, 17, 34]), "fires its rows in the order 1, 2, 3"),
            ("ours, 1 last", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("2-й ряд первым", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("2. Reihe zuerst", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("fila 2 primero", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("3 > 1 > 2, 20 ms", at([0, 20, 40]), "fires its rows in the order 1, 2, 3"),
            ("20 ms, holes 17 ms left", at([0, 20, 40]), "fires otherwise: all holes of a row at once"),
            (
                "20 ms, holes 17 ms left",
                format!("{}\nhole_interval_ms = 9\nhole_order = \"left\"", at([0, 20, 40])),
                "fires otherwise: holes 9 ms left",
            ),
        ] {
            let told = told(name, &timing);
            assert_eq!(told, [format!("the option named \"{name}\" {warning}")]);
        }
    }

    /// Words of order and side are endless, in every language: who signs compares them.
    #[test]
    fn a_name_in_own_words_is_asked_about() {
        let asked = |name: &str, timing: &str, rows: [&str; 2]| {
            let plan = plan(name, timing, rows);
            let option =
                plan.delays.iter().position(|delay| delay.name == name).unwrap_or_else(|| panic!("{name}"));
            own_words(&plan, option)
        };
        let asked_of = |name: &str| asked(name, "at_ms = [0, 42, 84]", AS_IS).is_some();
        for name in [
            "reverse",
            "V-cut",
            "обратный",
            "42 ms from right",
            "42 ms Nonel",
            "all at once",
            "as listed",
            "north 2026",
            "3-1, 42 ms",
            "2 > 1",
            "2 1 3",
        ] {
            assert!(asked_of(name), "{name}");
        }
        for name in [
            "42 ms",
            "42",
            "42мс",
            "0.042 s",
            "0/42/84 ms",
            "1-2-3 42 ms",
            "1 > 2 > 3, 42 ms",
            "42+42 ms",
            "42 ms (2)",
        ] {
            assert!(!asked_of(name), "{name}");
        }
        assert_eq!(asked("all at once", "at_ms = [0, 0, 0]", AS_IS), None);
        let holes = "interval_ms = 42\nhole_interval_ms = 17\nhole_order = \"left\"";
        assert_eq!(asked("42 ms, holes 17 ms left", holes, AS_IS), None);
        let turned = asked("43 ms", "interval_ms = 43", ["\"1\"", "\"9\""]);
        assert_eq!(
            turned.as_deref(),
            Some("\"43 ms\" fires rows 9: 0 ms, 2: 43 ms, 3: 86 ms: is that what its name says?")
        );
    }

    #[test]
    fn a_name_that_says_what_is_so_or_nothing_is_not_told() {
        let at = |times: [u32; 3]| format!("at_ms = {times:?}");
        for (name, timing) in [
            ("42 ms, ours", at([0, 42, 84])),
            ("0.042 s", at([0, 42, 84])),
            ("42", at([0, 42, 84])),
            ("3", at([0, 42, 84])),
            ("0/42/84 ms", at([0, 42, 84])),
            ("84/42/0", at([84, 42, 0])),
            ("42/42", at([0, 42, 84])),
            ("5/2026/11/28", at([0, 42, 84])),
            ("3 skips", at([0, 42, 84])),
            ("2 series", at([0, 42, 84])),
            ("3 серии", at([0, 42, 84])),
            ("3-2-1 20 ms", at([40, 20, 0])),
            ("3-2-1 42+67 ms", at([109, 42, 0])),
            ("middle first", at([25, 0, 50])),
            ("holes as drilled", at([0, 20, 40])),
            ("row 3 ballasted", at([0, 20, 40])),
            ("row 2 first", at([20, 0, 40])),
            ("2 ряд первым", at([20, 0, 40])),
            ("1 first, 3 last", at([0, 20, 40])),
            ("delay 42", at([0, 42, 84])),
            ("north 2026", at([0, 42, 84])),
            ("3-2 swapped", at([0, 20, 40])),
            (
                "20 ms, holes 17 ms left",
                format!("{}\nhole_interval_ms = 17\nhole_order = \"left\"", at([0, 20, 40])),
            ),
        ] {
            assert!(told(name, &timing).is_empty(), "{name}: {:?}", told(name, &timing));
        }
    }
}
