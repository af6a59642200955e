//! Key bindings: dispatch, footer, help, command palette and configuration read one table.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::screen::Screen;
use crate::plan::nearest;

/// An action that a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Show a screen.
    Show(Screen),
    /// Show the next screen.
    NextScreen,
    /// Show the screen before.
    PreviousScreen,
    /// Select the line above.
    Up,
    /// Select the line below.
    Down,
    /// Select the line a page up.
    PageUp,
    /// Select the line a page down.
    PageDown,
    /// Select the first.
    First,
    /// Select the last.
    Last,
    /// Go left, or a step down.
    Left,
    /// Go right, or a step up.
    Right,
    /// Open, edit or start the selected thing.
    Open,
    /// Compute everything again.
    Rerun,
    /// Next finer accuracy.
    Finer,
    /// Next coarser accuracy.
    Coarser,
    /// Sort by the next column.
    Sort,
    /// Reverse the order of the list.
    Reverse,
    /// Compare with the selected option.
    Baseline,
    /// Find what would make the selected option pass.
    Remedies,
    /// Play or pause.
    Play,
    /// Show the next firing or peak.
    NextEvent,
    /// Show the firing or peak before.
    PreviousEvent,
    /// Play faster.
    Faster,
    /// Play slower.
    Slower,
    /// Show the flight from the other side.
    Turn,
    /// End the study shown.
    Cancel,
    /// Copy the selected option.
    AddOption,
    /// Remove the selected option.
    RemoveOption,
    /// Take the last change back.
    Undo,
    /// Make the change again that was taken back last.
    Redo,
    /// Write the plan.
    Save,
    /// Write the plan under another name.
    SaveAs,
    /// Find.
    Find,
    /// Choose a command by name.
    Palette,
    /// Put the contents of the screen on the clipboard.
    Yank,
    /// Write the contents of the screen to a file.
    Export,
    /// Write the page of the selected option.
    Page,
    /// Switch to the next theme.
    Theme,
    /// Show or hide the help.
    Help,
    /// Stop and give the shell back until resumed.
    Suspend,
    /// Leave.
    Quit,
}

/// An action with its keys and texts.
pub struct Binding {
    /// The action.
    pub action: Action,
    /// Name of the action in the configuration and in the command palette.
    pub name: &'static str,
    /// The default keys; the configuration may replace them.
    pub keys: &'static [&'static str],
    /// Label in the footer; empty for an action that the footer leaves out.
    pub short: &'static str,
    /// Description in the help and in the command palette.
    pub text: &'static str,
    /// The screens that know the action; empty for all screens.
    pub on: &'static [Screen],
}

impl Binding {
    /// Label in the footer of a screen.
    pub fn short_on(&self, screen: Screen) -> &'static str {
        match (self.action, screen) {
            (Action::Open, Screen::Plan) => "edit",
            (Action::Open, Screen::Compare) => "enlarge",
            (Action::Open, Screen::Flight) => "back",
            (Action::Open, Screen::Studies) => "start, use",
            (Action::Open, Screen::Accuracy) => "start",
            (Action::Right, Screen::Flight) => "on",
            (Action::Right, Screen::Studies) => "next",
            _ => self.short,
        }
    }

    /// Whether a screen knows the action.
    pub fn is_on(&self, screen: Screen) -> bool {
        self.on.is_empty() || self.on.contains(&screen)
    }
}

const fn bind(
    action: Action,
    name: &'static str,
    keys: &'static [&'static str],
    short: &'static str,
    text: &'static str,
    on: &'static [Screen],
) -> Binding {
    Binding { action, name, keys, short, text, on }
}

const ALL: &[Screen] = &[];
const PLAN: &[Screen] = &[Screen::Plan];
const COMPARE: &[Screen] = &[Screen::Compare];
const FLIGHT: &[Screen] = &[Screen::Flight];
const SIDEWAYS: &[Screen] = &[Screen::Plan, Screen::Flight, Screen::Studies];
const ASKED: &[Screen] = &[Screen::Studies, Screen::Accuracy];

/// Every action. Actions of few screens stand first, because the footer shows only as many as fit.
pub const BINDINGS: &[Binding] = &[
    bind(Action::Play, "play", &["space"], "play", "play or pause", FLIGHT),
    bind(Action::Faster, "faster", &[">", "."], "faster", "play faster", FLIGHT),
    bind(Action::Slower, "slower", &["<", ","], "slower", "play slower", FLIGHT),
    bind(Action::NextEvent, "next", &["n", "]"], "next", "to the next firing or peak", FLIGHT),
    bind(Action::PreviousEvent, "previous", &["p", "["], "", "to the firing or peak before", FLIGHT),
    bind(Action::Turn, "turn", &["v"], "turn", "side view along the rows, or across them", FLIGHT),
    bind(
        Action::Open,
        "open",
        &["enter"],
        "open",
        "edit the value, enlarge the option, start the study",
        ALL,
    ),
    bind(Action::Left, "left", &["left", "h"], "", "smaller value, study before, back in time", SIDEWAYS),
    bind(Action::Right, "right", &["right", "l"], "step", "larger value, next study, on in time", SIDEWAYS),
    bind(Action::Cancel, "cancel", &["x"], "cancel", "end what computes here", ASKED),
    bind(
        Action::AddOption,
        "add-option",
        &["a"],
        "add",
        "copy the selected delay option, and type its interval",
        PLAN,
    ),
    bind(
        Action::RemoveOption,
        "remove-option",
        &["d"],
        "remove",
        "remove the selected option, or value that may be left out",
        PLAN,
    ),
    bind(Action::Undo, "undo", &["u"], "undo", "take the last change of the plan back", ALL),
    bind(Action::Redo, "redo", &["U", "ctrl-r"], "", "make it again", ALL),
    bind(Action::Save, "save", &["s", "ctrl-s"], "save", "save the plan; comments and formatting stay", ALL),
    bind(Action::SaveAs, "save-as", &["W"], "", "save the plan under another name", ALL),
    bind(Action::Sort, "sort", &["o"], "sort", "sort by the next column", COMPARE),
    bind(Action::Reverse, "reverse", &["O"], "", "turn the sorting round", COMPARE),
    bind(
        Action::Baseline,
        "baseline",
        &["b"],
        "baseline",
        "show differences from the selected option",
        COMPARE,
    ),
    bind(
        Action::Remedies,
        "why",
        &["w"],
        "why",
        "what would make the option pass; Enter makes a change",
        COMPARE,
    ),
    bind(Action::Finer, "finer", &["+", "="], "finer", "finer accuracy: draft, field, reference", ALL),
    bind(Action::Coarser, "coarser", &["-"], "coarser", "coarser accuracy", ALL),
    bind(Action::Rerun, "rerun", &["r"], "", "compute again", ALL),
    bind(Action::Find, "search", &["/"], "find", "find: options by name or verdict, values, lines", ALL),
    bind(Action::Export, "export", &["e"], "export", "write what is shown to a CSV, SVG or HTML file", ALL),
    bind(Action::Page, "page", &["P"], "page", "write the page of the selected option, to sign", COMPARE),
    bind(Action::Yank, "copy", &["y"], "", "copy what is shown to the clipboard", ALL),
    bind(Action::Palette, "commands", &[":"], "", "choose a command by name", ALL),
    bind(Action::Theme, "theme", &["t"], "theme", "next theme: dark, light, sunlight", ALL),
    bind(Action::Show(Screen::Plan), "plan", &["1"], "", "the plan and its values", ALL),
    bind(Action::Show(Screen::Compare), "compare", &["2"], "", "the delay options side by side", ALL),
    bind(Action::Show(Screen::Flight), "flight", &["3"], "", "the selected option in motion", ALL),
    bind(
        Action::Show(Screen::Studies),
        "studies",
        &["4"],
        "",
        "sweep, orders, risk, search, size, effects",
        ALL,
    ),
    bind(Action::Show(Screen::Accuracy), "accuracy", &["5"], "", "what accuracy costs on this plan", ALL),
    bind(Action::NextScreen, "next-screen", &["tab"], "", "the next screen", ALL),
    bind(Action::PreviousScreen, "previous-screen", &["backtab"], "", "the screen before", ALL),
    bind(Action::Up, "up", &["up", "k"], "", "select what is above", ALL),
    bind(Action::Down, "down", &["down", "j"], "", "select what is below", ALL),
    bind(Action::PageUp, "page-up", &["pageup"], "", "a page up", ALL),
    bind(Action::PageDown, "page-down", &["pagedown"], "", "a page down", ALL),
    bind(Action::First, "first", &["home", "g"], "", "to the first", ALL),
    bind(Action::Last, "last", &["end", "G"], "", "to the last", ALL),
    bind(Action::Help, "help", &["?", "f1"], "", "show or hide the keys", ALL),
    bind(Action::Suspend, "suspend", &["ctrl-z"], "", "back to the shell until `fg`", ALL),
    bind(Action::Quit, "quit", &["q", "ctrl-c"], "", "leave; Esc only closes, cancels or goes back", ALL),
];

/// Which key asks for which action.
#[derive(Clone, Debug)]
pub struct Keymap {
    /// The keys of each binding of [`BINDINGS`], as written.
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
    /// The default keys, with other keys for the actions named; or the mistake in them. A key named for an action leaves another
    /// that has more keys by default.
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

    /// The action a key asks for.
    pub fn action(&self, event: &KeyEvent) -> Option<Action> {
        // A capital letter contains Shift already; only some terminals report Shift as well.
        let pressed = (event.code, event.modifiers - KeyModifiers::SHIFT);
        self.keys.iter().find(|(key, _)| *key == pressed).map(|(_, action)| *action)
    }

    /// The first key of an action, or its name in the command palette; for a sentence.
    pub fn hint(&self, action: Action) -> String {
        let name = || BINDINGS.iter().find(|binding| binding.action == action).map_or("", |found| found.name);
        Some(self.first_key(action)).filter(|key| !key.is_empty()).unwrap_or_else(|| format!(":{}", name()))
    }

    /// The first key of an action; empty where it has none.
    pub fn first_key(&self, action: Action) -> String {
        self.keys(action).first().map(|key| readable(key)).unwrap_or_default()
    }

    /// All keys of an action, with blanks between them.
    pub fn all_keys(&self, action: Action) -> String {
        self.keys(action).iter().map(|key| readable(key)).collect::<Vec<_>>().join(" ")
    }

    /// The keys of an action, as the configuration writes them.
    fn keys(&self, action: Action) -> &[String] {
        let index = BINDINGS.iter().position(|binding| binding.action == action);
        index.and_then(|index| self.labels.get(index)).map_or(&[], Vec::as_slice)
    }
}

/// The key that `written` names: a single character, or a name that any of `ctrl-`, `alt-`, `shift-`, `cmd-` precede.
fn parse(written: &str) -> Option<(KeyCode, KeyModifiers)> {
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

/// Takes Ctrl-C as Esc while a text is typed: both give the text up.
pub fn ctrl_c_as_esc(key: &KeyEvent) -> KeyEvent {
    let interrupt = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    if interrupt { KeyEvent::new(KeyCode::Esc, KeyModifiers::NONE) } else { *key }
}

/// The label of a key as keyboards have it: `Enter`, `PgUp`, `Ctrl-s`.
fn readable(written: &str) -> String {
    let mut letters = written.chars();
    match (written, letters.next()) {
        ("pageup", _) => "PgUp".to_owned(),
        ("pagedown", _) => "PgDn".to_owned(),
        ("backtab", _) => "Shift-Tab".to_owned(),
        (_, Some(first)) if written.chars().count() > 1 => first.to_uppercase().chain(letters).collect(),
        _ => written.to_owned(),
    }
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
            ("ctrl-Q", (KeyCode::Char('q'), KeyModifiers::CONTROL)),
            ("alt--", (KeyCode::Char('-'), KeyModifiers::ALT)),
            ("ctrl-alt-minus", (KeyCode::Char('-'), KeyModifiers::CONTROL | KeyModifiers::ALT)),
        ] {
            assert_eq!(parse(written), Some(key), "{written}");
        }
        for written in ["", "ctrl-", "f0", "f25", "a-b", "nokey"] {
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
