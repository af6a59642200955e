//! Every action with its default keys and texts.

use crate::tui::screen::Screen;

/// An action that a key triggers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Show a screen.
    Show(Screen),
    /// Show the next screen.
    NextScreen,
    /// Show the previous screen.
    PreviousScreen,
    /// Select the line above.
    Up,
    /// Select the line below.
    Down,
    /// Select the line a page up.
    PageUp,
    /// Select the line a page down.
    PageDown,
    /// Select the first line.
    First,
    /// Select the last line.
    Last,
    /// Go left, or make the value one step smaller.
    Left,
    /// Go right, or make the value one step larger.
    Right,
    /// Set the interval to the next smaller common delay time.
    CommonBelow,
    /// Set the interval to the next larger common delay time.
    CommonAbove,
    /// Open, edit or start the selected item.
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
    /// Compare the other options with the selected option.
    Baseline,
    /// List the differences between two plans.
    Differences,
    /// Find changes with which the selected option would pass.
    Why,
    /// Make the proposed change, or look for one.
    Try,
    /// Play or pause.
    Play,
    /// Show the next firing or peak.
    NextEvent,
    /// Show the previous firing or peak.
    PreviousEvent,
    /// Play faster.
    Faster,
    /// Play slower.
    Slower,
    /// Switch between the planned shot and the deciding shot.
    OtherShot,
    /// Switch the side view: along the rows, or across them.
    Turn,
    /// End the study shown.
    Cancel,
    /// Put the estimates of the fit into the plan.
    UseEstimates,
    /// Copy the selected option.
    AddOption,
    /// Remove the selected option.
    RemoveOption,
    /// Undo the last change.
    Undo,
    /// Redo the change that was undone last.
    Redo,
    /// Write the plan.
    Save,
    /// Write the plan under another name.
    SaveAs,
    /// Search the options, values or lines of the screen.
    Find,
    /// Choose a command by name.
    Commands,
    /// Put the contents of the screen on the clipboard.
    Copy,
    /// Write the contents of the screen to a file.
    Export,
    /// Write the page of the selected option.
    WritePage,
    /// Switch to the next theme.
    Theme,
    /// Show or hide the help.
    Help,
    /// Stop the program and give the shell back until the program is resumed.
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
    /// Label in the footer. If empty, the footer leaves the action out.
    pub short: &'static str,
    /// Description in the help and in the command palette.
    pub text: &'static str,
    /// Screens on which the action works. Empty: all screens.
    pub on: &'static [Screen],
}

impl Binding {
    /// Label in the footer of a screen.
    pub fn short_on(&self, screen: Screen) -> &'static str {
        match (self.action, screen) {
            (Action::Open, Screen::Plan) => "edit",
            (Action::Open, Screen::Compare) => "enlarge",
            (Action::Open, Screen::Flight) => "back",
            (Action::Open, Screen::Studies) => "start, show",
            (Action::Open, Screen::Accuracy) => "start",
            (Action::Play, Screen::Plan | Screen::Compare | Screen::Studies | Screen::Accuracy) => "",
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

const COMPARE: &[Screen] = &[Screen::Compare];

const PLAN: &[Screen] = &[Screen::Plan];

const OPTIONS: &[Screen] = &[Screen::Plan, Screen::Compare];

const FLIGHT: &[Screen] = &[Screen::Flight];

/// Screens on which something moves while nothing computes.
const MOVING: &[Screen] = &Screen::ALL;

const DRAWN: &[Screen] = &[Screen::Compare, Screen::Flight];

const SIDEWAYS: &[Screen] = &[Screen::Plan, Screen::Flight, Screen::Studies];

const STUDIES: &[Screen] = &[Screen::Studies];

const ASKED: &[Screen] = &[Screen::Studies, Screen::Accuracy];

/// Every action. Actions of few screens come first, because the footer shows only as many actions as fit.
pub const BINDINGS: &[Binding] = &[
    bind(Action::Play, "play", &["space"], "play", "play or pause", MOVING),
    bind(Action::Faster, "faster", &[">", "."], "faster", "play faster", FLIGHT),
    bind(Action::Slower, "slower", &["<", ","], "slower", "play slower", FLIGHT),
    bind(Action::NextEvent, "next", &["n", "]"], "next", "to the next firing or peak", FLIGHT),
    bind(Action::PreviousEvent, "previous", &["p", "["], "", "to the firing or peak before", FLIGHT),
    bind(Action::Turn, "turn", &["v"], "turn", "side view along the rows, or across them", FLIGHT),
    bind(
        Action::OtherShot,
        "other-shot",
        &["m"],
        "planned",
        "draw the shot as planned, or the one that decides",
        DRAWN,
    ),
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
    bind(
        Action::CommonAbove,
        "common-above",
        &["shift-right"],
        "common ms",
        "interval: the next common delay time, as 17, 25, 42",
        PLAN,
    ),
    bind(
        Action::CommonBelow,
        "common-below",
        &["shift-left"],
        "",
        "interval: the common delay time before",
        PLAN,
    ),
    bind(Action::Cancel, "cancel", &["x"], "cancel", "end what computes here", ASKED),
    bind(
        Action::UseEstimates,
        "use-estimates",
        &["E"],
        "use estimates",
        "put the estimates of the fit into the plan",
        STUDIES,
    ),
    bind(
        Action::AddOption,
        "add-option",
        &["a"],
        "add",
        "copy the selected delay option, and type its interval",
        OPTIONS,
    ),
    bind(
        Action::RemoveOption,
        "remove-option",
        &["d"],
        "remove",
        "remove the selected option, or value that may be left out",
        OPTIONS,
    ),
    bind(Action::Try, "try", &["c"], "try", "make the change that is proposed, or look for one", COMPARE),
    bind(Action::Undo, "undo", &["u"], "undo", "take the last change of the plan back", ALL),
    bind(Action::Redo, "redo", &["U", "ctrl-r"], "", "make it again", ALL),
    bind(Action::Save, "save", &["s", "ctrl-s"], "save", "save the plan; comments and formatting stay", ALL),
    bind(Action::SaveAs, "save-as", &["W"], "", "save the plan under another name", ALL),
    bind(Action::Why, "why", &["w"], "why", "what would make the option pass; Enter makes a change", COMPARE),
    bind(Action::Sort, "sort", &["o"], "sort", "sort by the next column", COMPARE),
    bind(Action::Reverse, "reverse", &["O"], "", "turn the sorting round", COMPARE),
    bind(
        Action::Baseline,
        "baseline",
        &["b"],
        "versus",
        "show differences from the selected option",
        COMPARE,
    ),
    bind(Action::Differences, "differences", &["D"], "", "list what two plans say differently", OPTIONS),
    bind(Action::Finer, "finer", &["+", "="], "finer", "finer accuracy: draft, field, reference", ALL),
    bind(Action::Coarser, "coarser", &["-"], "coarser", "coarser accuracy", ALL),
    bind(Action::Rerun, "rerun", &["r"], "", "compute again", ALL),
    bind(Action::Find, "search", &["/"], "find", "find: options by name or verdict, values, lines", ALL),
    bind(Action::Export, "export", &["e"], "export", "write what is shown to a CSV, SVG or HTML file", ALL),
    bind(
        Action::WritePage,
        "page",
        &["P"],
        "page",
        "write the page of the selected option, to sign",
        COMPARE,
    ),
    bind(Action::Copy, "copy", &["y"], "", "copy what is shown to the clipboard", ALL),
    bind(Action::Commands, "commands", &[":"], "", "choose a command by name", ALL),
    bind(Action::Theme, "theme", &["t"], "theme", "next theme: dark, light, sunlight", ALL),
    bind(Action::Show(Screen::Plan), "plan", &["1"], "", "the plan and its values", ALL),
    bind(Action::Show(Screen::Compare), "compare", &["2"], "", "the delay options side by side", ALL),
    bind(Action::Show(Screen::Flight), "flight", &["3"], "", "the selected option in motion", ALL),
    bind(
        Action::Show(Screen::Studies),
        "studies",
        &["4"],
        "",
        "sweep, orders, risk, search, size, effects, fit",
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
