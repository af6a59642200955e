//! Blanks to fill in by hand, and lines to sign: what a blast record asks for and the program cannot know.
//!
//! The list follows the records of 30 CFR 816.68 and similar state rules, the Swedish sprängjournal (AMA) and annex 10 of the
//! Russian order 494 of 2020. Other places ask for more or less.

use maud::{Markup, html};

use super::Page;
use super::chosen_option::{firing_instruction, only_planned, verdict_word};
use crate::plan::keys::{self, Key};
use crate::report::language::{Language, phrase, say, spoken};
use crate::report::words::option_sentences;
use crate::report::words::to_be_confirmed::ToConfirm;

/// Blanks of half the width of the page.
const HALF: &[&str] = &[
    "Site, and place of the shot on it",
    "Date and time of the shot",
    "Blaster in charge, number of the licence",
    "Crew",
    "Explosive: product, amount in each hole and in all",
    "Stemming: material and length",
    "Holes: diameter, depth, burden, spacing; rock",
    "Specific charge, kg/m³",
    "Initiation system: product, detonators",
    "Cover: layers, overlap, what lies under the tires",
    "Weather: sky, wind, lightning",
    "Guards posted: names and places",
];

/// Blanks of the whole width; a tall blank is marked `true`.
const WIDE: &[(&str, bool)] = &[
    ("Distance and direction to what is protected: nearest dwelling, road, line; scaled distance", false),
    ("Shelter as laid: what differs from the plan, who looked at ropes and terminations", false),
    (
        "After the shot: greatest height seen, broken cables, tires moved, misfires, flyrock and where it came down",
        true,
    ),
    ("To be kept until", false),
];

/// Lines for the signers.
const SIGNERS: [&str; 2] = ["Author: name, date, signature", "Blaster in charge: name, date, signature"];

/// Blanks to fill in by hand.
pub fn blanks() -> Markup {
    html! {
        section {
            h2 { (phrase("To be filled in by hand")) }
            p.quiet { (phrase("The program does not know these. The law of the place may ask for more.")) }
            div.blanks {
                @for name in HALF { div.blank { (phrase(name)) } }
                @for (name, tall) in WIDE { div.blank.wide.tall[*tall] { (phrase(name)) } }
            }
        }
    }
}

/// Lines to confirm before the shot, each with a box to tick.
pub fn to_be_confirmed(page: &Page<'_>) -> Markup {
    let all = page.to_be_confirmed();
    html! {
        @if page.to_be_fired.is_some() && !all.is_empty() {
            section.whole {
                h2 { (say!("To be confirmed before the shot: {}", all.len())) }
                ul.boxes {
                    @for ToConfirm { text, .. } in &all {
                        li { "☐ " @if let Some(key) = key_of(text) { code { (text) } @if let Some(words) = in_words(key) { " " (words) } } @else { (text) } }
                    }
                }
            }
        }
    }
}

/// The key of a plan with which a line begins; `None` where it begins with none.
fn key_of(line: &str) -> Option<&'static Key> {
    let (name, value) = line.split_once(" = ").or_else(|| line.split_once(": "))?;
    let sections = keys::plan::SECTION.keys.iter().filter_map(|key| key.kind.section());
    let mut named = sections.flat_map(|section| section.keys).filter(|key| key.name == name);
    // Friction and slack occur in two sections. The value in `[uncertainty]`, the last section, is a range.
    let key = if value.contains('[') { named.next_back() } else { named.next() };
    key.copied()
}

/// Words for a key, with the unit, from the editor of the terminal: the signer knows no keys. These words are English; `None` in
/// other languages.
fn in_words(key: &Key) -> Option<&'static str> {
    key.edit.as_ref().map(|edit| edit.label).filter(|_| spoken() == Language::English)
}

/// The lines to sign; none on a page without an option. A name on such a page would sign for an option that nobody looked at
/// further.
pub fn signatures(page: &Page<'_>) -> Markup {
    let Some(option) = page.to_be_fired else {
        return html! { p { strong { (phrase("No option may be fired by this page: it is about none.")) } } };
    };
    html! {
        div.signatures {
            div { p { (signed(page, option)) } div.signature { (phrase(SIGNERS[0])) } }
            div { p { (phrase("The limits, launch velocities and ranges of the plan are those of this site.")) @if let Some(confirmed) = confirmed(page) { (confirmed) } } div.signature { (phrase(SIGNERS[1])) } }
        }
    }
}

/// Sentence that the signer has confirmed the listed lines, so that nobody signs for numbers that nobody looked at.
fn confirmed(page: &Page<'_>) -> Option<String> {
    match page.to_be_confirmed().len() {
        0 => None,
        1 => Some(say!(" I have confirmed the one line that this page lists.")),
        count => Some(say!(" I have confirmed each of the {count} lines that this page lists.", count)),
    }
}

/// Text to sign: the option to be fired with its firing times and its verdict.
fn signed(page: &Page<'_>, option: usize) -> Markup {
    let delay = &page.case.plan.delays[option];
    let times = option_sentences::firing_times_text(&page.case.plan.blast_rows, delay);
    html! {
        (say!("{instruction}: option “{name}”, rows at {times}, ", firing_instruction(page, option), delay.name, times)) (verdict_word(page, option)) (only_planned(page))
        @if !page.standing.compared().agrees() {
            (phrase(match page.standing.compared().objections() {
                [] => " (observations of earlier shots are not compared with the plan)",
                _ => " (observations of earlier shots speak against the plan)",
            }))
        }
    }
}
