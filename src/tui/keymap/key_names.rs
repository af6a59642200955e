//! Names of keys: as written in the configuration, and as shown on screens.

use crossterm::event::{KeyCode, KeyModifiers};

/// The key named by `written`: a single character, or a name with any of the prefixes `ctrl-`, `alt-`, `shift-`, `cmd-`.
pub(super) fn parse(written: &str) -> Option<(KeyCode, KeyModifiers)> {
    let mut letters = written.chars();
    if let (Some(letter), None) = (letters.next(), letters.next()) {
        return (!letter.is_control()).then_some((KeyCode::Char(letter), KeyModifiers::NONE));
    }
    let written = written.to_ascii_lowercase();
    let (mut name, mut modifiers) = (written.as_str(), KeyModifiers::NONE);
    while let Some((rest, modifier)) =
        MODIFIERS.iter().find_map(|(prefix, modifier)| Some((name.strip_prefix(prefix)?, *modifier)))
    {
        (name, modifiers) = (rest, modifiers | modifier);
    }
    // Capitals and BackTab already contain Shift. Of the other keys, only the left and right arrow report Shift in every terminal.
    let code = match (key_code(name)?, modifiers.contains(KeyModifiers::SHIFT)) {
        (code, false) => code,
        (KeyCode::Char(letter), true) if letter.is_ascii_alphabetic() => {
            KeyCode::Char(letter.to_ascii_uppercase())
        }
        (KeyCode::Tab, true) => KeyCode::BackTab,
        (code @ (KeyCode::Left | KeyCode::Right), true) => return Some((code, modifiers)),
        (_, true) => return None,
    };
    Some((code, modifiers - KeyModifiers::SHIFT))
}

const MODIFIERS: &[(&str, KeyModifiers)] = &[
    ("ctrl-", KeyModifiers::CONTROL),
    ("alt-", KeyModifiers::ALT),
    ("shift-", KeyModifiers::SHIFT),
    ("cmd-", KeyModifiers::SUPER),
];

/// The key with a lower-case name.
fn key_code(name: &str) -> Option<KeyCode> {
    let code = match name {
        "esc" => KeyCode::Esc,
        "enter" => KeyCode::Enter,
        "left" => KeyCode::Left,
        "right" => KeyCode::Right,
        "up" => KeyCode::Up,
        "down" => KeyCode::Down,
        "home" => KeyCode::Home,
        "end" => KeyCode::End,
        "pageup" => KeyCode::PageUp,
        "pagedown" => KeyCode::PageDown,
        "backtab" => KeyCode::BackTab,
        "backspace" => KeyCode::Backspace,
        "del" | "delete" => KeyCode::Delete,
        "ins" | "insert" => KeyCode::Insert,
        "space" => KeyCode::Char(' '),
        "hyphen" | "minus" => KeyCode::Char('-'),
        "tab" => KeyCode::Tab,
        _ => match (name.strip_prefix('f').and_then(|number| number.parse().ok()), name.as_bytes()) {
            (Some(number @ 1..=24), _) => KeyCode::F(number),
            (_, &[letter]) => KeyCode::Char(char::from(letter)),
            _ => return None,
        },
    };
    Some(code)
}

/// The label of a key as printed on keyboards: `Enter`, `PgUp`, `Ctrl-s`.
pub(super) fn readable(written: &str) -> String {
    let mut letters = written.chars();
    match (written, letters.next()) {
        ("pageup", _) => "PgUp".to_owned(),
        ("pagedown", _) => "PgDn".to_owned(),
        ("backtab", _) => "Shift-Tab".to_owned(),
        ("shift-left", _) => "Shift-Left".to_owned(),
        ("shift-right", _) => "Shift-Right".to_owned(),
        (_, Some(first)) if written.chars().count() > 1 => first.to_uppercase().chain(letters).collect(),
        _ => written.to_owned(),
    }
}
