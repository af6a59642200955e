//! Key bindings. Dispatch, footer, help, command palette and configuration all read one table.

mod bindings;
mod key_names;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

pub use self::bindings::{Action, BINDINGS, Binding};
use self::key_names::{parse, readable};
use crate::plan::nearest;

/// Which key triggers which action.
#[derive(Clone, Debug)]
pub struct Keymap {
    /// Keys of each binding of [`BINDINGS`], as written in the configuration.
    labels: Vec<Vec<String>>,
    keys: Vec<((KeyCode, KeyModifiers), Action)>,
}

impl Default for Keymap {
    fn default() -> Self {
        let written = |binding: &Binding| binding.keys.iter().map(|key| (*key).to_owned()).collect();
        let keymap = Self::new(BINDINGS.iter().map(written).collect());
        keymap.unwrap_or_else(|mistake| unreachable!("the table is tested: {mistake}"))
    }
}

impl Keymap {
    /// The default keys with `changes`, or the mistake in `changes`. If another action has such a key by default and has further keys, this
    /// action loses the key.
    pub fn with(changes: impl IntoIterator<Item = (String, Vec<String>)>) -> Result<Self, String> {
        let mut labels = Self::default().labels;
        let mut named = Vec::new();
        for (name, keys) in changes {
            let Some(index) = BINDINGS.iter().position(|binding| binding.name == name) else {
                let near = nearest(&name, BINDINGS.iter().map(|binding| binding.name));
                let near = near.map_or_else(String::new, |near| format!("; did you mean '{near}'?"));
                return Err(format!("there is no command '{name}'{near}"));
            };
            labels[index] = keys;
            named.push(index);
        }
        let taken: Vec<String> = named.iter().flat_map(|&index| labels[index].clone()).collect();
        for (_, keys) in labels.iter_mut().enumerate().filter(|(index, _)| !named.contains(index)) {
            if keys.iter().any(|key| !taken.contains(key)) {
                keys.retain(|key| !taken.contains(key));
            }
        }
        Self::new(labels)
    }

    fn new(labels: Vec<Vec<String>>) -> Result<Self, String> {
        let mut keys: Vec<((KeyCode, KeyModifiers), Action)> = Vec::new();
        for (binding, written) in BINDINGS.iter().zip(&labels) {
            for key in written {
                let parsed = parse(key).ok_or_else(|| {
                    format!(
                        "'{key}' is no key; write one such as \"a\", \"A\", \"ctrl-a\", \"f5\" or \"pageup\""
                    )
                })?;
                if let Some((_, other)) = keys.iter().find(|(taken, _)| *taken == parsed) {
                    let other = BINDINGS.iter().find(|binding| binding.action == *other);
                    let other = other.map_or("", |binding| binding.name);
                    return Err(format!("the key '{key}' asks for both '{other}' and '{}'", binding.name));
                }
                keys.push((parsed, binding.action));
            }
        }
        Ok(Self { labels, keys })
    }

    /// The action that a key triggers.
    pub fn action(&self, event: &KeyEvent) -> Option<Action> {
        // A capital letter already contains Shift. Only some terminals report Shift as well.
        let action = |pressed| self.keys.iter().find(|(key, _)| *key == pressed).map(|(_, action)| *action);
        let without_shift = (event.code, event.modifiers - KeyModifiers::SHIFT);
        action((event.code, event.modifiers)).or_else(|| action(without_shift))
    }

    /// The first key of an action, for a sentence; its name in the command palette if it has no key.
    pub fn hint(&self, action: Action) -> String {
        let name = || BINDINGS.iter().find(|binding| binding.action == action).map_or("", |found| found.name);
        Some(self.first_key(action)).filter(|key| !key.is_empty()).unwrap_or_else(|| format!(":{}", name()))
    }

    /// The first key of an action; empty if it has no key.
    pub fn first_key(&self, action: Action) -> String {
        self.keys(action).first().map(|key| readable(key)).unwrap_or_default()
    }

    /// All keys of an action, separated by blanks.
    pub fn all_keys(&self, action: Action) -> String {
        self.keys(action).iter().map(|key| readable(key)).collect::<Vec<_>>().join(" ")
    }

    /// The keys of an action, as written in the configuration.
    fn keys(&self, action: Action) -> &[String] {
        let index = BINDINGS.iter().position(|binding| binding.action == action);
        index.and_then(|index| self.labels.get(index)).map_or(&[], Vec::as_slice)
    }
}

/// Turns Ctrl-C into Esc while the user types a text: both discard the text.
pub fn ctrl_c_as_esc(key: &KeyEvent) -> KeyEvent {
    let interrupt = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    if interrupt { KeyEvent::new(KeyCode::Esc, KeyModifiers::NONE) } else { *key }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_default_key_is_one_and_asks_for_one_thing() {
        let keymap = Keymap::default();
        for binding in BINDINGS {
            assert!(!binding.text.is_empty());
            for key in binding.keys {
                let (code, modifiers) = parse(key).expect("a key");
                assert_eq!(keymap.action(&KeyEvent::new(code, modifiers)), Some(binding.action), "{key}");
            }
        }
    }

    #[test]
    fn keys_are_named_with_their_modifiers() {
        let none = KeyModifiers::NONE;
        for (written, key) in [
            ("G", (KeyCode::Char('G'), none)),
            ("-", (KeyCode::Char('-'), none)),
            ("PageUp", (KeyCode::PageUp, none)),
            ("F24", (KeyCode::F(24), none)),
            ("shift-q", (KeyCode::Char('Q'), none)),
            ("shift-tab", (KeyCode::BackTab, none)),
            ("shift-left", (KeyCode::Left, KeyModifiers::SHIFT)),
            ("ctrl-Q", (KeyCode::Char('q'), KeyModifiers::CONTROL)),
            ("alt--", (KeyCode::Char('-'), KeyModifiers::ALT)),
            ("ctrl-alt-minus", (KeyCode::Char('-'), KeyModifiers::CONTROL | KeyModifiers::ALT)),
        ] {
            assert_eq!(parse(written), Some(key), "{written}");
        }
        for written in ["", "ctrl-", "f0", "f25", "a-b", "nokey", "shift-up", "shift-1"] {
            assert_eq!(parse(written), None, "{written}");
        }
    }

    #[test]
    fn letters_with_a_reported_shift_are_found() {
        let event = KeyEvent::new(KeyCode::Char('G'), KeyModifiers::SHIFT);
        assert_eq!(Keymap::default().action(&event), Some(Action::Last));
    }

    #[test]
    fn other_keys_replace_those_of_the_table_and_mistakes_are_named() {
        let with = |name: &str, key: &str| Keymap::with([(name.to_owned(), vec![key.to_owned()])]);
        let keymap = with("quit", "ctrl-q").expect("a key");
        let pressed = |letter, modifiers| keymap.action(&KeyEvent::new(KeyCode::Char(letter), modifiers));
        assert_eq!(pressed('q', KeyModifiers::CONTROL), Some(Action::Quit));
        assert_eq!(pressed('q', KeyModifiers::NONE), None);
        assert_eq!(keymap.all_keys(Action::Quit), "Ctrl-q");
        assert_eq!(keymap.hint(Action::Quit), "Ctrl-q");
        let without = Keymap::with([("quit".to_owned(), Vec::new())]).expect("no key");
        assert_eq!(without.hint(Action::Quit), ":quit");
        assert!(with("qiut", "x").is_err_and(|mistake| mistake.contains("'quit'")));
        assert!(with("quit", "v").is_err_and(|mistake| mistake.contains("'turn'")), "its only key");
        let keymap = with("quit", "j").expect("down has another key");
        assert_eq!(keymap.all_keys(Action::Down), "Down");
        assert!(with("quit", "nokey").is_err_and(|mistake| mistake.contains("is no key")));
    }
}
