//! The one table of keys: dispatch, footer and help all read it.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Select the option above.
    Up,
    /// Select the option below.
    Down,
    /// Select an option a page up.
    PageUp,
    /// Select an option a page down.
    PageDown,
    /// Select the first option.
    First,
    /// Select the last option.
    Last,
    /// Show the study before.
    Left,
    /// Show the next study.
    Right,
    /// Compare the options.
    Compare,
    /// The long studies.
    Studies,
    /// End the study shown.
    Cancel,
    /// Change the plan.
    Plan,
    /// Take a change back.
    Undo,
    /// Make it again.
    Redo,
    /// Copy the selected option.
    Copy,
    /// Remove the selected option.
    Remove,
    /// Write the plan.
    Save,
    /// Show the selected option large, or all again; start the study shown.
    Zoom,
    /// Compute everything again.
    Rerun,
    /// Next finer accuracy.
    Finer,
    /// Next coarser accuracy.
    Coarser,
    /// Next theme.
    Theme,
    /// Show or hide the help.
    Help,
    /// Leave.
    Quit,
    /// Stop and give the shell back until resumed.
    Suspend,
}

/// Keys that ask for one action.
pub struct Binding {
    /// Any of these.
    pub keys: &'static [(KeyCode, KeyModifiers)],
    /// What they ask for.
    pub action: Action,
    /// The keys in words.
    pub label: &'static str,
    /// The action in words.
    pub text: &'static str,
    /// The action in one word for the footer; empty to leave it out.
    pub short: &'static str,
}

const NONE: KeyModifiers = KeyModifiers::NONE;
const CONTROL: KeyModifiers = KeyModifiers::CONTROL;

const fn key(letter: char) -> (KeyCode, KeyModifiers) {
    (KeyCode::Char(letter), NONE)
}

/// Every key there is.
pub const KEYS: &[Binding] = &[
    Binding {
        keys: &[key('1')],
        action: Action::Compare,
        label: "1",
        text: "compare the delay options",
        short: "",
    },
    Binding {
        keys: &[key('2')],
        action: Action::Studies,
        label: "2",
        text: "studies: sweep, orders, scatter, size",
        short: "",
    },
    Binding {
        keys: &[key('3')],
        action: Action::Plan,
        label: "3",
        text: "the plan: change values, add and remove options",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Right, NONE), key('l'), (KeyCode::Tab, NONE)],
        action: Action::Right,
        label: "Right l",
        text: "studies: the next one; plan: a step up",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Left, NONE), key('h'), (KeyCode::BackTab, NONE)],
        action: Action::Left,
        label: "Left h",
        text: "studies: the one before; plan: a step down",
        short: "",
    },
    Binding {
        keys: &[key('u')],
        action: Action::Undo,
        label: "u",
        text: "plan: take the last change back",
        short: "",
    },
    Binding {
        keys: &[key('U'), (KeyCode::Char('r'), CONTROL)],
        action: Action::Redo,
        label: "U Ctrl-r",
        text: "plan: make it again",
        short: "",
    },
    Binding {
        keys: &[key('a')],
        action: Action::Copy,
        label: "a",
        text: "plan: add a copy of the selected option",
        short: "",
    },
    Binding {
        keys: &[key('d')],
        action: Action::Remove,
        label: "d",
        text: "plan: remove the selected option",
        short: "",
    },
    Binding {
        keys: &[key('s'), (KeyCode::Char('s'), CONTROL)],
        action: Action::Save,
        label: "s Ctrl-s",
        text: "save the plan; comments and formatting stay",
        short: "",
    },
    Binding {
        keys: &[key('x')],
        action: Action::Cancel,
        label: "x",
        text: "studies: cancel the one shown",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Down, NONE), key('j')],
        action: Action::Down,
        label: "Down j",
        text: "select the next option",
        short: "select",
    },
    Binding {
        keys: &[(KeyCode::Up, NONE), key('k')],
        action: Action::Up,
        label: "Up k",
        text: "select the option before",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::PageDown, NONE)],
        action: Action::PageDown,
        label: "PgDn",
        text: "select ten options further",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::PageUp, NONE)],
        action: Action::PageUp,
        label: "PgUp",
        text: "select ten options back",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Home, NONE), key('g')],
        action: Action::First,
        label: "Home g",
        text: "select the first option",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::End, NONE), key('G')],
        action: Action::Last,
        label: "End G",
        text: "select the last option",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Enter, NONE)],
        action: Action::Zoom,
        label: "Enter",
        text: "show the option large, and back; start a study",
        short: "enlarge",
    },
    Binding {
        keys: &[key('r')],
        action: Action::Rerun,
        label: "r",
        text: "compute all options again",
        short: "run",
    },
    Binding {
        keys: &[key('+'), key('=')],
        action: Action::Finer,
        label: "+",
        text: "finer accuracy: draft, field, reference",
        short: "finer",
    },
    Binding {
        keys: &[key('-')],
        action: Action::Coarser,
        label: "-",
        text: "coarser accuracy",
        short: "coarser",
    },
    Binding {
        keys: &[key('t')],
        action: Action::Theme,
        label: "t",
        text: "next theme: dark, light, sunlight",
        short: "theme",
    },
    Binding {
        keys: &[key('?'), (KeyCode::F(1), NONE)],
        action: Action::Help,
        label: "? F1",
        text: "show or hide this help",
        short: "",
    },
    Binding {
        keys: &[(KeyCode::Char('z'), CONTROL)],
        action: Action::Suspend,
        label: "Ctrl-z",
        text: "back to the shell until `fg`",
        short: "",
    },
    Binding {
        keys: &[key('q'), (KeyCode::Esc, NONE), (KeyCode::Char('c'), CONTROL)],
        action: Action::Quit,
        label: "q Esc Ctrl-c",
        text: "leave (Esc closes what is open first)",
        short: "",
    },
];

/// The action a key asks for.
pub fn action(event: &KeyEvent) -> Option<Action> {
    // Shift is part of the letter itself; terminals differ in whether they report it as well.
    let modifiers = event.modifiers - KeyModifiers::SHIFT;
    let asked = |binding: &&Binding| binding.keys.contains(&(event.code, modifiers));
    KEYS.iter().find(asked).map(|binding| binding.action)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_asks_for_two_things_and_every_binding_is_described() {
        let mut seen = Vec::new();
        for binding in KEYS {
            assert!(!binding.keys.is_empty() && !binding.label.is_empty() && !binding.text.is_empty());
            for key in binding.keys {
                assert!(!seen.contains(key), "{key:?} is bound twice");
                seen.push(*key);
            }
        }
    }

    #[test]
    fn letters_with_a_reported_shift_are_found() {
        let event = KeyEvent::new(KeyCode::Char('G'), KeyModifiers::SHIFT);
        assert_eq!(action(&event), Some(Action::Last));
    }
}
