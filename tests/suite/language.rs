//! The page in Russian: every phrase is translated and used, nothing on it stays English, its numbers are those of the English page,
//! and nothing is cut on paper.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

use roxmltree::{Document, Node};

use super::page::{PLAN, report, xml};
use super::support::{Edited, tested_plan};

const RUSSIAN: &str = include_str!("../../src/report/language/russian.toml");

fn russian() -> BTreeMap<String, String> {
    toml::from_str(RUSSIAN).expect("phrases")
}

/// String literals of a Rust source without its tests, and what stands before each.
fn literals(source: &str) -> Vec<(String, String)> {
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let code: String = source
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .flat_map(|line| [line, "\n"])
        .collect();
    let (mut found, mut rest) = (Vec::new(), code.replace("'\"'", "' '"));
    while let Some((before, after)) = rest.split_once('"') {
        let (mut text, mut letters) = (String::new(), after.chars());
        loop {
            match letters.next() {
                None | Some('"') => break,
                Some('\\') => match letters.next() {
                    Some('n') => text.push('\n'),
                    Some('\n') => letters = letters.as_str().trim_start().chars(),
                    Some(letter) => text.push(letter),
                    None => break,
                },
                Some(letter) => text.push(letter),
            }
        }
        found.push((before.trim_end().to_owned(), text));
        rest = letters.as_str().to_owned();
    }
    found
}

/// Literals of all sources below a folder.
fn literals_below(folder: &Path) -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .flat_map(|path| match path.is_dir() {
            true => literals_below(&path),
            false if path.extension().is_some_and(|end| end == "rs") => {
                literals(&std::fs::read_to_string(&path).expect("a source"))
            }
            false => Vec::new(),
        })
        .collect()
}

/// Names of a phrase in their order; a place without a name has none.
fn names(phrase: &str) -> Vec<&str> {
    phrase.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect()
}

fn numbers(text: &str) -> Vec<&str> {
    let is_part = |letter: char| letter.is_ascii_digit() || letter == '.';
    let pieces = text.split(|letter| !is_part(letter)).map(|piece| piece.trim_matches('.'));
    pieces.filter(|piece| !piece.is_empty()).collect()
}

#[test]
fn every_phrase_is_translated_and_every_translation_is_used() {
    let russian = russian();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let literals: Vec<_> = ["src", "engine/src"].map(|source| literals_below(&root.join(source))).concat();
    let asked =
        literals.iter().filter(|(before, _)| before.ends_with("say!(") || before.ends_with("phrase("));
    let mut count = 0;
    for (_, english) in asked {
        assert!(russian.contains_key(english), "no Russian of '{english}'");
        count += 1;
    }
    assert!(count > 250, "phrases are found: {count}");
    let ropes = include_str!("../../src/ropes/ropes.toml");
    let known: BTreeSet<&str> = literals.iter().map(|(_, text)| text.as_str()).collect();
    for (english, translation) in &russian {
        let is_of_rope = ropes.contains(&format!("construction = \"{english}\""));
        assert!(known.contains(english.as_str()) || is_of_rope, "nothing says '{english}'");
        assert_eq!(names(english), names(translation), "{english}");
        assert_eq!(numbers(english), numbers(translation), "{english}");
        assert!(!translation.trim().is_empty(), "{english}");
        assert_eq!(
            [english.starts_with(' '), english.ends_with(' ')],
            [translation.starts_with(' '), translation.ends_with(' ')],
            "{english}"
        );
    }
}

/// The verdicts of the page are three words that nobody takes for one another, and none is the word for a dud.
#[test]
fn no_verdict_is_a_part_of_another_or_the_word_for_a_dud() {
    let russian = russian();
    let verdicts = ["PASS", "FAIL", "OPEN", "NOT to be fired"].map(|verdict| russian[verdict].to_uppercase());
    for (n, verdict) in verdicts.iter().enumerate() {
        assert!(!verdict.contains("ОТКАЗ"), "{verdict}");
        for other in verdicts.iter().skip(n + 1) {
            assert!(
                !verdict.contains(other.as_str()) && !other.contains(verdict.as_str()),
                "{verdict}, {other}"
            );
            assert!(
                n > 0 || verdict.chars().next() != other.chars().next(),
                "torn off, {other} is no {verdict}"
            );
        }
    }
    assert!(russian["NOT to be fired"].contains("ЗАПРЕЩАЕТСЯ"));
    for (english, translation) in &russian {
        // What forbids in English forbids in Russian, too.
        let low = english.to_lowercase();
        if english.contains("NOT ") || low.contains("not fire ") || low.contains("no permission") {
            let forbids =
                ["ЗАПРЕЩАЕТСЯ", "НЕ ", "не ", "нельзя"].iter().any(|word| translation.contains(word));
            assert!(forbids, "{english}: {translation}");
        }
    }
}

/// Texts that readers see, without what is quoted: code, the plan word for word.
fn texts<'a>(page: &'a Document<'_>) -> Vec<&'a str> {
    let is_quoted = |node: &Node<'_, '_>| {
        node.ancestors().any(|parent| ["code", "pre", "style"].iter().any(|name| parent.has_tag_name(*name)))
    };
    let texts = page.descendants().filter(|node| node.is_text() && !is_quoted(node));
    texts.filter_map(|node| node.text()).collect()
}

/// Text of a node and all below it.
fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|node| node.text()).collect()
}

/// Words of two Latin letters or more; a checksum is none.
fn latin(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|letter: char| !letter.is_ascii_alphanumeric());
    words.filter(|word| word.len() > 1 && word.chars().all(|letter| letter.is_ascii_alphabetic()))
}

/// What is the same in every language: units, the name of the program, abbreviations of the field.
const SAME: [&str; 14] = [
    "ms", "kN", "kg", "mm", "EA", "SHA", "shelter", "PASS", "FAIL", "OPEN", "THIN", "HOLD", "verlet",
    "newmark",
];

/// Pages of a plan in both languages with these arguments.
fn pages(plan: &str, more: &[&str]) -> [String; 2] {
    ["en", "ru"].map(|lang| {
        let (output, page) = report(plan, &[more, &["--lang", lang]].concat());
        xml(&page.unwrap_or_else(|| panic!("{}", String::from_utf8_lossy(&output.stderr))))
    })
}

/// What the pages of the tests hold: passing and failing options, warnings, a sweep, observations that contradict, ropes and layouts.
static PAGES: LazyLock<Vec<(String, [String; 2])>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = folder.path().join("seen.csv");
    let observed = "# shot = 2026-03-04\noption,tire,quantity,value,sd\n20 & 0,1:1,flight_height_m,1.9,0.05\n\
                    20 & 0,1:2,lift_s,0.9,0.02\n20 & 0,1:3,drift_m,0.9,0.05\n";
    std::fs::write(&seen, observed).expect("written");
    let seen = seen.display().to_string();
    let with_warnings = PLAN
        .edited("at_ms = [0, 42]", "at_ms = [0, 400]")
        .edited("under_row = 3", "under_row = 2")
        .edited("flight_height_m = 1.8", "flight_height_m = 0.5, drift_m = 0.1, holes_in_8_ms = 1")
        .edited("friction = 0.5", "friction = 0.5, slope_percent = 5, slope_toward_deg = 90");
    let of_six = PLAN.edited("rows = 4, columns = 3", "rows = 3, columns = 2");
    let estimated = PLAN.edited("launch_common_percent = 2", "launch_common_percent = 50");
    let amur = std::fs::read_to_string(tested_plan("amur-three-rows.toml")).expect("a plan");
    let few = |more: &[&'static str]| [more, &["--accuracy", "draft", "--samples", "100"]].concat();
    let cases: Vec<(String, Vec<&str>)> = vec![
        (PLAN.to_owned(), [few(&["--option", "<b>"]), vec!["--observed", seen.as_str()]].concat()),
        (PLAN.to_owned(), vec!["--nominal"]),
        (of_six, vec!["--option", "20 & 0", "--sweep", "--accuracy", "draft", "--samples", "12"]),
        (PLAN.to_owned(), vec!["--nominal", "--option", "<b>"]),
        (with_warnings.clone(), few(&["--option", "<b>"])),
        (with_warnings, vec!["--nominal"]),
        (estimated, few(&["--option", "20 & 0"])),
        (amur, vec!["--nominal", "--accuracy", "draft", "--option", "42 ms"]),
    ];
    cases.into_iter().map(|(plan, more)| (plan.clone(), pages(&plan, &more))).collect()
});

#[test]
fn a_russian_page_says_all_in_russian_and_the_same_numbers() {
    for (plan, [english, russian]) in PAGES.iter() {
        // Names and other texts of the plan stand in quotes; its keys are no words of the page.
        let of_plan: BTreeSet<&str> = (plan.split('"').skip(1).step_by(2).flat_map(latin))
            .chain(latin(
                "script alert shot quotes style folder plan toml seen csv tmp flight height drift lift",
            ))
            .collect();
        let [english, russian] = [english, russian].map(|page| Document::parse(page).expect("XML"));
        let [said, translated] = [&english, &russian].map(texts);
        for text in &translated {
            // A command or a key in its quotes stays.
            let quoted: String = text.split('`').step_by(2).collect();
            for word in latin(&quoted) {
                // So begin the names of folders for a while.
                let is_named = of_plan.contains(word) || word.starts_with("tmp");
                assert!(SAME.contains(&word) || is_named, "'{word}' in '{text}'");
            }
        }
        let all =
            |texts: &[&str]| numbers(&texts.join(" ")).into_iter().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(all(&said), all(&translated));
        let language = |page: &Document<'_>| page.root_element().attribute("lang").map(str::to_owned);
        assert_eq!([&english, &russian].map(language), ["en", "ru"].map(|code| Some(code.to_owned())));
        let verdicts = |page: &Document<'_>| {
            let is = |node: &Node<'_, '_>| {
                ["pass", "fail", "undecided"].iter().any(|c| node.attribute("class") == Some(c))
            };
            page.descendants()
                .filter(is)
                .map(|node| node.attribute("class").map(str::to_owned))
                .collect::<Vec<_>>()
        };
        assert_eq!(verdicts(&english), verdicts(&russian));
    }
}

/// Width of a text in letters of this size: a letter of a usual font is some 0.6 of its height wide.
fn width(text: &str, size: f64) -> f64 {
    0.6 * size * text.trim().chars().count() as f64
}

/// Drawings keep their texts inside, and the widest table has room for its longest words on A4.
#[test]
fn nothing_is_cut_on_paper() {
    // Points in a millimetre; A4 without the margins of the page [mm]; letters and room of a cell as `style.rs` prints them.
    const POINTS: f64 = 2.835;
    const ROOM: f64 = 210.0 - 2.0 * 15.0;
    const LETTERS: f64 = 7.0;
    const PADDING: f64 = 1.6;
    for (_, [_, page]) in PAGES.iter() {
        assert!(page.contains("font-size: 7pt } .options td, .options th { padding: 0.6mm 0.8mm }"));
        let page = Document::parse(page).expect("XML");
        let number =
            |node: &Node<'_, '_>, name: &str| node.attribute(name).and_then(|text| text.parse::<f64>().ok());
        for drawing in page.descendants().filter(|node| node.tag_name().name() == "svg") {
            let right = number(&drawing, "width").expect("a width");
            for node in drawing.descendants().filter(|node| node.tag_name().name() == "text") {
                let text = words(node);
                let (x, size) =
                    (number(&node, "x").expect("a place"), number(&node, "font-size").expect("a size"));
                let wide = width(&text, size);
                let left = match node.attribute("text-anchor") {
                    Some("middle") => x - wide / 2.0,
                    Some("end") => x - wide,
                    _ => x,
                };
                let is_turned = node.attribute("transform").is_some();
                assert!(
                    is_turned || left >= 0.0 && left + wide <= right,
                    "'{text}' from {left} to {}",
                    left + wide
                );
            }
        }
        let is_options =
            |node: &Node<'_, '_>| node.attribute("class").is_some_and(|names| names.contains("options"));
        for table in page.descendants().filter(is_options) {
            let mut columns: Vec<f64> = Vec::new();
            for row in table.descendants().filter(|node| node.has_tag_name("tr")) {
                let cells: Vec<_> = row.children().filter(|node| node.is_element()).collect();
                if cells.iter().any(|cell| cell.attribute("colspan").is_some()) {
                    continue;
                }
                columns.resize(columns.len().max(cells.len()), 0.0);
                for (column, cell) in columns.iter_mut().zip(cells) {
                    let text = words(cell).replace("НЕ ДОКАЗАНО", "НЕ_ДОКАЗАНО");
                    // A line may also end behind the dots of a range.
                    let pieces = text.split(|letter: char| letter.is_whitespace() || letter == '…');
                    let longest = pieces.map(|word| width(word, LETTERS));
                    *column = longest.fold(*column, f64::max);
                }
            }
            let needed: f64 = columns.iter().map(|points| points / POINTS + PADDING).sum();
            assert!(needed <= ROOM, "the options need {needed} mm: {columns:?}");
        }
    }
}
