//! Comment lines `# key: value` in a file of observations, which describe the shot: day, charge, stemming, cover, and the holes that
//! failed.
//!
//! Every other comment is kept as a remark, and no computation uses it. A charge or stemming that is no number, or has another name, is a
//! mistake: a person who scales a launch by the charge must not believe that it is missing.

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use crate::plan::diagnostic::Mistake;

/// Description of an observed shot, besides its observations. `None`: the file does not state the value.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShotHead {
    /// The day, as written.
    pub date: Option<String>,
    /// Charge of each hole [kg].
    pub charge_kg: Option<f64>,
    /// Stemming of the holes [m].
    pub stemming_m: Option<f64>,
    /// The cover, as written.
    pub cover: Option<String>,
    /// Which holes did not fire, as written.
    #[serde(default)]
    pub dud: Option<String>,
    /// Every other comment, as written. No computation uses it.
    #[serde(default)]
    pub remarks: Vec<String>,
}

impl ShotHead {
    /// Whether the file says nothing about its shot.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Keeps a comment, unless it only says that nothing failed, or comes from the template. A comment with `camera` or `film` stays: a
    /// report of what the tires did may follow these words.
    fn remark(&mut self, comment: &str) {
        let words = small_words(comment);
        let is_known = |word: &String| {
            let denies =
                [NONE, DUD, BROKE_OR_FLEW, FILLING].iter().any(|words| words.contains(&word.as_str()));
            denies || word.starts_with(|sign: char| sign.is_ascii_digit())
        };
        let is_denial = words.iter().all(is_known) && names(comment, &[DUD, BROKE_OR_FLEW].concat());
        if !words.is_empty() && !is_denial && !TEMPLATE_COMMENTS.contains(&comment) {
            self.remarks.push(comment.to_owned());
        }
    }

    /// Reads the comment lines of a text.
    pub(super) fn read(source: &str, mistakes: &mut Vec<Mistake>) -> Self {
        let mut head = Self::default();
        let mut at = 0;
        // The reader of the table also ends a line at a lone carriage return.
        for line in source.split_inclusive(['\n', '\r']) {
            let span = at..at + line.trim_end().len();
            at += line.len();
            // A spreadsheet puts a line that holds a separator into quotes, and adds separators behind the line.
            let plain = line.trim().trim_start_matches('"').trim_end_matches([',', ';', '\t', '"']);
            let Some(comment) = plain.strip_prefix('#').map(str::trim) else { continue };
            if let Some(dud) = dud_of(comment) {
                let duds = [head.dud.take(), Some(dud.to_owned())].into_iter().flatten();
                head.dud = Some(duds.collect::<Vec<_>>().join("; "));
                continue;
            }
            if says_it_broke_or_flew(comment) {
                mistakes.push(Mistake {
                    span,
                    message: format!("no prediction can be compared with `{comment}`"),
                    remedy: "fire nothing by this plan before you know why it came about; where nothing broke or flew, write `# flyrock: none`, or \
                             other words"
                        .to_owned(),
                });
                continue;
            }
            let Some((key, value)) = comment.split_once(':') else {
                head.remark(comment);
                mistakes.extend(without_colon(comment).map(|meant| Mistake {
                    span: span.clone(),
                    message: format!("`{comment}` has no colon"),
                    remedy: format!("write `# {meant}`, or begin the comment with another word"),
                }));
                continue;
            };
            let (name, value) = (key.trim().to_lowercase(), value.trim());
            if value.is_empty() {
                continue;
            }
            let mut number = |unit: &str| {
                let found = amount(value, unit);
                if found.is_none() {
                    mistakes.push(Mistake {
                        span: span.clone(),
                        message: format!("`{value}` is no {}", key.trim().to_lowercase()),
                        remedy: format!("write a number in {unit}, such as `# {}: 12.5 {unit}`", key.trim()),
                    });
                }
                found
            };
            let is_first = match name.as_str() {
                "date" => {
                    mistakes.extend((!is_day(value)).then(|| Mistake {
                        span: span.clone(),
                        message: format!("`{value}` is no day"),
                        remedy: "write year, month and day as `# date: 2026-05-04`: by its day a shot counts once".to_owned(),
                    }));
                    fill(&mut head.date, || Some(value.to_owned()))
                }
                "cover" => fill(&mut head.cover, || Some(value.to_owned())),
                "charge" | "charge_kg" => fill(&mut head.charge_kg, || number("kg")),
                "stemming" | "stemming_m" => fill(&mut head.stemming_m, || number("m")),
                other => {
                    if let Some(meant) = meant_by(other, value) {
                        mistakes.push(Mistake {
                            span: span.clone(),
                            message: format!("`{other}` is no name of what a file says of its shot"),
                            remedy: format!("write `# {meant}`, or leave out the colon of a comment"),
                        });
                    }
                    head.remark(comment);
                    true
                }
            };
            if !is_first {
                mistakes.push(Mistake {
                    span,
                    message: format!("`{name}` is said twice"),
                    remedy: "say it once: one file tells of one shot; leave out the file's charge where rows differ".to_owned(),
                });
            }
        }
        head
    }
}

/// The comments of the template.
pub(super) const TEMPLATE_COMMENTS: [&str; 3] = [
    "of the shot, where you know it; charge in each hole in kg, stemming in m",
    "an example, replace it; tire and cable as ROW:COLUMN, or as in `shelter trace`; times since time 0 of the plan",
    "where firing times were logged: the hole under a tire",
];

/// Fills `place` if it is empty; returns `false` if it holds a value already.
fn fill<T>(place: &mut Option<T>, read: impl FnOnce() -> Option<T>) -> bool {
    let is_first = place.is_none();
    if is_first {
        *place = read();
    }
    is_first
}

/// Whether a text begins with a day as ISO 8601 writes it, `2026-05-04`. Words behind it keep two shots of one day apart.
fn is_day(text: &str) -> bool {
    let is_sign =
        |(n, sign): (usize, char)| if [4, 7].contains(&n) { sign == '-' } else { sign.is_ascii_digit() };
    let part = |range| text.get(range).and_then(|part: &str| part.parse().ok()).unwrap_or(0);
    text.chars().take(10).enumerate().all(is_sign)
        && !text[10.min(text.len())..].starts_with(|sign: char| sign.is_ascii_digit())
        && (1..=12).contains(&part(5..7))
        && (1..=31).contains(&part(8..10))
}

/// Words in small letters: for a hole that did not fire, and (below) for events that no prediction can be compared with.
#[rustfmt::skip]
const DUD: &[&str] = &[
    "dud", "duds", "misfire", "misfires", "misfired", "unfired", "отказ", "отказы", "отказа", "отказов", "versager", "fallido", "fallidos",
];
#[rustfmt::skip]
const BROKE_OR_FLEW: &[&str] = &[
    "broke", "broken", "snapped", "torn", "tore", "parted", "ruptured", "flyrock", "debris", "fragments", "порван", "порвался", "порвались", "порвало",
    "порвали", "оборван", "оборвался", "оборвались", "оборвало", "лопнул", "лопнула", "лопнули", "лопнуло", "разлет", "осколки",
    "gerissen", "steinflug",
];
/// Words for flying stones; then for ground and stemming, which do not fly; then for a failure, which counts if the comment names a rope.
#[rustfmt::skip]
const FLYING_STONES: &[&str] = &["stone", "stones", "rocks", "камень", "камни", "камней", "куски", "steine"];
const STEMMING_OR_GROUND: &[&str] =
    &["stemming", "ground", "rock", "geology", "забойка", "грунт", "порода", "породы", "besatz", "boden"];
const FAILING: &[&str] = &["failed", "cut", "burst", "riss", "обрыв", "обрыва", "разрыв", "разрыва"];
const ROPES: &[&str] = &[
    "cable",
    "cables",
    "rope",
    "ropes",
    "трос",
    "троса",
    "тросов",
    "тросы",
    "канат",
    "каната",
    "канаты",
    "seil",
    "seile",
];
/// Words that deny an event.
const NONE: &[&str] =
    &["none", "no", "0", "нет", "не", "без", "ninguno", "ninguna", "sin", "kein", "keine", "keiner"];

/// Words of `NONE` that are a whole answer.
const NOTHING_AT_ALL: &[&str] = &["none", "0", "нет", "ninguno", "ninguna", "keine"];

/// Words that add nothing to a denial.
const FILLING: &[&str] =
    &["seen", "cable", "cables", "hole", "holes", "any", "of", "was", "were", "скважин", "тросов"];

/// The words of a comment, in small letters.
fn small_words(comment: &str) -> Vec<String> {
    let small = comment
        .to_lowercase()
        .replace('ё', "е")
        .replace("fly rock", "flyrock")
        .replace("fly-rock", "flyrock");
    let said = small.split(|sign: char| !sign.is_alphanumeric()).filter(|word| !word.is_empty());
    said.map(str::to_owned).collect()
}

/// Whether a comment holds one of these `words`.
fn names(comment: &str, words: &[&str]) -> bool {
    small_words(comment).iter().any(|word| words.contains(&word.as_str()))
}

/// Whether a comment says that an event named by these `words` happened: no word before or behind denies the event.
fn says(comment: &str, words: &[&str]) -> bool {
    let said = small_words(comment);
    let said: Vec<&str> = said.iter().map(String::as_str).collect();
    let is_unfilled = comment.trim_end().ends_with([':', '=', '-']);
    let is_denied = |at: usize| {
        let is_none = |at: usize| said.get(at).is_some_and(|word| NONE.contains(word));
        // `no 2` is the number of a hole.
        let is_number =
            |at: usize| said.get(at).is_some_and(|word| word.starts_with(|c: char| c.is_ascii_digit()));
        let before = (at.saturating_sub(2)..at).any(|at| is_none(at) && !is_number(at + 1));
        // A word that follows may deny something else: `broke, no film`.
        let is_whole = |at: usize| said[at..].len() == 1 || NOTHING_AT_ALL.contains(&said[at]);
        before || is_none(at + 1) && is_whole(at + 1)
    };
    let mut at = said.iter().positions(|word| words.contains(word));
    !is_unfilled && at.any(|at| !is_denied(at))
}

/// Whether a comment says that something broke or flew. No prediction can be compared with such an event.
fn says_it_broke_or_flew(comment: &str) -> bool {
    let begins = small_words(comment).first().is_some_and(|word| STEMMING_OR_GROUND.contains(&word.as_str()));
    says(comment, BROKE_OR_FLEW)
        || !begins && says(comment, FLYING_STONES)
        || names(comment, ROPES) && says(comment, FAILING)
}

/// The hole that did not fire, in the words of the comment; `None` if the comment names none.
fn dud_of(comment: &str) -> Option<&str> {
    match says(comment, DUD) {
        true => Some(comment.split_once([':', '=']).map_or(comment, |(_, behind)| behind.trim())),
        false => comment.to_lowercase().contains("did not fire").then_some(comment),
    }
}

/// Example of the line to write, for a comment that lacks the colon: `charge 30 kg`, `stemming = 3 m`. `None` for any other comment.
fn without_colon(comment: &str) -> Option<&'static str> {
    let is_between = |sign: char| sign.is_whitespace() || "=-–—".contains(sign);
    let (key, value) = comment.split_once(is_between)?;
    let value = value.trim_start_matches(is_between);
    let key = key.to_lowercase();
    value.starts_with(|sign: char| sign.is_ascii_digit()).then(|| meant_by(&key, value)).flatten()
}

/// Example of the line to write, for a value under another name; `None` for any other comment.
fn meant_by(key: &str, value: &str) -> Option<&'static str> {
    let has =
        |words: &[&str]| key.split(|sign: char| !sign.is_alphabetic()).any(|word| words.contains(&word));
    let weighs = value.contains("kg") || value.contains("кг");
    match () {
        () if has(&["charge", "charges", "explosive", "заряд", "заряды"]) => {
            Some("charge: 12.5 kg")
        }
        () if has(&["stemming", "забойка"]) => Some("stemming: 3.2 m"),
        () if weighs && has(&["cover", "tire", "tires", "tyre", "tyres", "укрытие", "шина", "шины"]) => {
            Some("cover: 280 kg tires")
        }
        () => None,
    }
}

/// A number above 0, with or without its unit. `None` if three digits follow a comma: the comma may separate decimals or thousands.
fn amount(text: &str, unit: &str) -> Option<f64> {
    let number = text.strip_suffix(unit).unwrap_or(text).trim();
    let is_either = number.split_once(',').is_some_and(|(_, behind)| behind.len() == 3);
    let number: f64 = number.replace(',', ".").parse().ok().filter(|_| !is_either)?;
    (number > 0.0 && number.is_finite()).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comment_lines_tell_of_the_shot() {
        let text = "\u{feff}# date: 2026-05-04\n# charge: 12,5 kg\n\"# Stemming: 3.2 m\",,\n# cover: 280 kg tires, 140 kg/m2\n# seen from the side: yes\n# date:\n";
        let mut mistakes = Vec::new();
        let head = ShotHead::read(text.trim_start_matches('\u{feff}'), &mut mistakes);
        assert!(mistakes.is_empty());
        assert_eq!(head.date.as_deref(), Some("2026-05-04"));
        assert_eq!((head.charge_kg, head.stemming_m), (Some(12.5), Some(3.2)));
        assert_eq!(head.cover.as_deref(), Some("280 kg tires, 140 kg/m2"));
        for wrong in ["# charge: heavy", "# charge: 1,250 kg", "# stemming: -2", "# charge: inf"] {
            ShotHead::read(wrong, &mut mistakes);
        }
        assert_eq!(mistakes.len(), 4, "{mistakes:?}");
        for other in
            ["# charge per hole: 5", "# Stemming length: 6 m", "# mass_of_tires: 560 kg", "# Заряд: 60 кг"]
        {
            ShotHead::read(other, &mut mistakes);
        }
        assert_eq!(mistakes.len(), 8, "{mistakes:?}");
        for without_colon in ["# charge - 30 kg", "# stemming – 1.2 m"] {
            let mut mistakes = Vec::new();
            ShotHead::read(without_colon, &mut mistakes);
            assert_eq!(mistakes.len(), 1, "{without_colon}");
        }
        for day in ["04.05.2026", "4 May", "2026-13-04", "2026-05-045", "2026-05", "4мая2026год"] {
            let mut mistakes = Vec::new();
            ShotHead::read(&format!("# date: {day}"), &mut mistakes);
            assert_eq!(mistakes.len(), 1, "{day}");
        }
        for without_colon in ["# charge 30 kg", "# Stemming = 3 m", "# заряд 60 кг", "# tires 560 kg"]
        {
            ShotHead::read(without_colon, &mut mistakes);
        }
        assert_eq!(mistakes.len(), 12, "{mistakes:?}");
        // Of two charges nobody knows which one belongs to the shot.
        for twice in [
            "# charge: 60 kg\n# charge: 25 kg",
            "# date: 2026-05-04\r# charge_kg: 60\r# charge: 60 kg",
            "# cover: a\n# Cover: b",
        ] {
            ShotHead::read(twice, &mut mistakes);
        }
        assert_eq!(mistakes.len(), 15, "{mistakes:?}");
        mistakes.truncate(12);
        ShotHead::read("# charge as in the plan\n# stemming of gravel, 3 m\n# 3 tires 280 kg", &mut mistakes);
        assert_eq!(mistakes.len(), 12, "{mistakes:?}");
    }

    /// Every other comment is kept for the person who signs, except the words that nothing failed.
    #[test]
    fn every_other_comment_is_a_remark() {
        let remarks = |text: &str| ShotHead::read(text, &mut Vec::new()).remarks;
        for remark in
            ["tire 3:6 flew over the wall", "seen from the side: yes", "3:6 rose 2.6 m, not read exactly"]
        {
            assert_eq!(remarks(&format!("# {remark}\n")), [remark]);
        }
        for none in
            ["# date: 2026-05-04", "#", "# flyrock: none", "# no dud", "# dud: row 1, hole 2", "option,tire"]
        {
            assert_eq!(remarks(none), [""; 0], "{none}");
        }
    }

    /// A dud is kept with the file. A broken cable is refused: nothing can be compared with it.
    #[test]
    fn a_dud_is_kept_and_a_broken_cable_refused() {
        let read = |text: &str| {
            let mut mistakes = Vec::new();
            (ShotHead::read(text, &mut mistakes).dud, mistakes.len())
        };
        for (dud, words) in [
            ("# dud: row 1, hole 2", "row 1, hole 2"),
            ("# Misfire = 2", "2"),
            ("# отказ: скважина 4", "скважина 4"),
            ("# duds 2", "duds 2"),
            ("# dud: 1\n# dud: 2", "1; 2"),
            ("# hole 2 misfired", "hole 2 misfired"),
            ("# hole no. 2 misfired", "hole no. 2 misfired"),
            ("# misfire: no 4", "no 4"),
            ("# hole 2 of row 1 did not fire", "hole 2 of row 1 did not fire"),
        ] {
            assert_eq!(read(dud), (Some(words.to_owned()), 0), "{dud}");
        }
        for broken in [
            "# cable broke, no film of it",
            "# cable broke: 2:2-2:3",
            "# cable 2:2-2:3 broke",
            "# flyrock: 80 m",
            "# fly rock 80 m",
            "# stones landed on the road",
            "# разлёт: 80 м",
            "# трос лопнул",
            "# камни долетели до дороги",
            "# a stone hit the truck",
            "# rocks flew over the road",
            "# fragments 60 m",
            "# обрыв троса 2:2-2:3",
            "# rope burst at 3:1",
            "# куски породы на дороге",
        ] {
            assert_eq!(read(broken), (None, 1), "{broken}");
        }
        for same in [
            "# duds: none",
            "# duds: none seen",
            "# misfires: 0 of 30",
            "# misfires - none",
            "# misfires: no",
            "# dud:",
            "# flyrock: -",
            "# No flyrock; no cable broke",
            "# no stones, rock: granite",
            "# ground: stones and clay",
            "# film cut at 2 s",
            "# камней нет",
            "# rotation of the camera: 3 deg",
            "# date: 2026-05-04",
        ] {
            assert_eq!(read(same), (None, 0), "{same}");
        }
    }
}
