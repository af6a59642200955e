//! Keys by name: as the configuration writes them, and as screens show them.

use crossterm::event::{KeyCode, KeyModifiers};

/// The key that `written` names: a single character, or a name that any of `ctrl-`, `alt-`, `shift-`, `cmd-` precede.
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
    let code = key_code(name, modifiers.contains(KeyModifiers::SHIFT))?;
    Some((code, modifiers - KeyModifiers::SHIFT))
}

const MODIFIERS: &[(&str, KeyModifiers)] = &[
    ("ctrl-", KeyModifiers::CONTROL),
    ("alt-", KeyModifiers::ALT),
    ("shift-", KeyModifiers::SHIFT),
    ("cmd-", KeyModifiers::SUPER),
];

/// The key of a lower-case name; with Shift a letter is a capital.
fn key_code(name: &str, shift: bool) -> Option<KeyCode> {
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
            (_, &[letter]) => {
                KeyCode::Char(char::from(if shift { letter.to_ascii_uppercase() } else { letter }))
            }
            _ => return None,
        },
    };
    Some(code)
}

/// The label of a key as keyboards have it: `Enter`, `PgUp`, `Ctrl-s`.
pub(super) fn readable(written: &str) -> String {
    let mut letters = written.chars();
    match (written, letters.next()) {
        ("pageup", _) => "PgUp".to_owned(),
        ("pagedown", _) => "PgDn".to_owned(),
        ("backtab", _) => "Shift-Tab".to_owned(),
        (_, Some(first)) if written.chars().count() > 1 => first.to_uppercase().chain(letters).collect(),
        _ => written.to_owned(),
    }
}
