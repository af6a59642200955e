//! Fits the parts of a sentence into a number of cells. A part that does not fit is left out or gets its own line.

use std::iter::repeat;

use unicode_width::UnicodeWidthStr;

use super::report::wrapped;
use crate::report::text::cut_name;
use crate::tui::app::App;

/// Indent of the second and further lines of a part.
const INDENT: &str = "  ";

/// A part wider than `room`, split before its bracket (`… by 12 %`, `(assumed 3 %)`), otherwise between words.
fn broken(part: &str, room: usize) -> Vec<String> {
    let pieces = match part.split_once(" (").filter(|(before, _)| before.width() <= room) {
        Some((before, bracket)) => vec![before.to_owned(), format!("({bracket}")],
        None => wrapped(part, room.saturating_sub(INDENT.len())),
    };
    let indents = [""].into_iter().chain(repeat(INDENT));
    indents.zip(pieces).map(|(indent, piece)| format!("{indent}{piece}")).collect()
}

/// The whole words of a text that fit, with a cue for more. If not even the first word fits, its first letters.
pub fn cut_at_word(text: &str, room: usize) -> String {
    if text.width() <= room {
        return text.to_owned();
    }
    let words: Vec<&str> = text.split(' ').collect();
    let joined = |count: usize| format!("{} …", words[..count].join(" "));
    let fits = (1..words.len()).rev().map(joined).find(|text| text.width() <= room);
    fits.unwrap_or_else(|| text.chars().take(room.saturating_sub(1)).chain(['…']).collect())
}

/// The name of an option in `room` cells. The beginning, if no other name begins so and no number is cut; otherwise beginning and end.
pub fn option_name(app: &App, option: usize, room: usize) -> String {
    let delays = &app.case.plan.delays;
    let name = &delays[option].name;
    let cut_at = name.char_indices().nth(room.saturating_sub(1)).map_or(name.len(), |(at, _)| at);
    let (beginning, end) = name.split_at(cut_at);
    let is_alone = delays.iter().filter(|delay| delay.name.starts_with(beginning)).count() == 1;
    let cuts_number = end.contains(|letter: char| letter.is_ascii_digit())
        || beginning.trim_end().ends_with(|letter: char| letter.is_ascii_digit());
    match name.width() > room && is_alone && !cuts_number {
        true => format!("{}…", beginning.trim_end()),
        false => cut_name(name, room),
    }
}

/// As many of `parts` as fit in a line. The first part is always complete, in as many lines as it needs.
pub fn whole_first(parts: Vec<String>, between: &str, room: usize) -> Vec<String> {
    match parts.first().filter(|first| first.width() > room) {
        Some(first) => wrapped(first, room),
        None => vec![fitting(parts, between, room)],
    }
}

/// All parts, in as few lines as possible. A part that needs several lines shares none.
pub fn filled(parts: &[String], room: usize) -> Vec<String> {
    let (mut lines, mut is_open) = (Vec::<String>::new(), false);
    for part in parts {
        match lines.last_mut().filter(|line| is_open && line.width() + 2 + part.width() <= room) {
            Some(line) => *line += &format!(", {part}"),
            None => {
                is_open = part.width() <= room;
                lines.extend(if is_open { vec![part.clone()] } else { broken(part, room) });
            }
        }
    }
    lines
}

/// As many of `parts` as fit, in order. A part that does not fit is left out.
pub fn fitting(parts: Vec<String>, between: &str, room: usize) -> String {
    parts.into_iter().fold(String::new(), |line, part| {
        let longer = if line.is_empty() { part } else { format!("{line}{between}{part}") };
        if longer.width() <= room { longer } else { line }
    })
}
