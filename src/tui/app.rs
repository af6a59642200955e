//! The state of the screen and how keys, clicks and news change it. No input or output happens here.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent};
use ratatui::layout::{Position, Rect};

use super::compare::{Compare, SortBy};
use super::config::Config;
use super::editor::{Edit, Editor};
use super::keymap::{Action, BINDINGS, Keymap};
use super::player::Player;
use super::prompt::{Prompt, Purpose, Typed};
use super::studies::{Progress, Studies};
use super::theme::Theme;
use crate::plan::{Accuracy, Plan};
use crate::study::check::Checked;
use crate::study::{Case, Effort, error};
use crate::worker::{Event, Found, Kind, News};

/// What one delay option has come to.
#[derive(Clone, Debug)]
pub enum Row {
    /// Not begun.
    Waiting,
    /// Computing.
    Running {
        /// Runs finished.
        runs: usize,
        /// Part done of the least number of runs, 0 to 1.
        done: f64,
    },
    /// Judged.
    Done(Box<Checked>),
    /// Without a result.
    Failed(String),
}

/// What the event loop must do after an update.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// Nothing.
    None,
    /// Compute everything again.
    Run,
    /// Another plan is shown: compute it, and end what computes for the old one.
    Replaced,
    /// Begin a long study.
    Start(Kind),
    /// End a long study.
    Cancel(Kind),
    /// Write the plan.
    Save,
    /// Write the plan to a file of its own.
    SaveAs(PathBuf),
    /// Write what is shown to a file.
    Export(PathBuf),
    /// Put what is shown on the clipboard.
    Yank,
    /// Give the terminal back for now.
    Suspend,
    /// Leave.
    Quit,
}

/// What a click on a place of the screen means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The same as a key.
    Act(Action),
    /// Select an option; open it where it is selected already.
    Option(usize),
    /// Sort by a column.
    Sort(SortBy),
    /// Select a value of the plan; edit it where it is selected already.
    Field(usize),
    /// Show a study.
    Study(Kind),
    /// Show a time, from the left end of the place to its right end [s].
    Time(f64),
}

/// Everything the screen shows.
#[derive(Clone, Debug)]
pub struct App {
    /// The plan.
    pub case: Arc<Case>,
    /// How finely it is computed.
    pub effort: Effort,
    /// One per delay option.
    pub rows: Vec<Row>,
    /// Index of the selected option.
    pub selected: usize,
    /// Whether the selected option is shown large.
    pub zoom: bool,
    /// Whether the help is open.
    pub help: bool,
    /// Lines the help is scrolled.
    pub help_scroll: u16,
    /// Colours.
    pub theme: Theme,
    /// Which key asks for what.
    pub keymap: Keymap,
    /// What is shown.
    pub screen: Screen,
    /// How the options are listed.
    pub compare: Compare,
    /// The flight shown.
    pub player: Player,
    /// Long studies.
    pub studies: Studies,
    /// The plan's text.
    pub editor: Editor,
    /// What is being typed at the foot of the screen.
    pub prompt: Option<Prompt>,
    /// What was drawn where at last, for clicks; the last of several at a point counts.
    pub places: Vec<(Rect, Target)>,
    /// News of the plan's file.
    pub notice: Option<String>,
    /// Whether leaving was refused once, because of changes that are not saved.
    pub warned: bool,
}

/// What the screen shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Screen {
    /// The plan, to be changed.
    Plan,
    /// The delay options side by side.
    #[default]
    Compare,
    /// The selected option in motion.
    Flight,
    /// Sweep, orders, scatter, size.
    Studies,
    /// What accuracy costs.
    Accuracy,
}

impl Screen {
    /// All of them, in the order of their keys.
    pub const ALL: [Screen; 5] =
        [Screen::Plan, Screen::Compare, Screen::Flight, Screen::Studies, Screen::Accuracy];

    /// So many further, round and round.
    fn turned(self, places: usize) -> Self {
        Self::ALL[(self as usize + places) % Self::ALL.len()]
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Screen::Plan => "Plan",
            Screen::Compare => "Compare",
            Screen::Flight => "Flight",
            Screen::Studies => "Studies",
            Screen::Accuracy => "Accuracy",
        }
    }
}

/// Options a page key moves.
const PAGE: usize = 10;
/// How far one key scrubs [s].
const SCRUB: f64 = 0.01;
/// Simulated time after the last firing that a run is expected to last [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// Nothing computed yet.
    pub fn new(case: Arc<Case>, effort: Effort, config: &Config) -> Self {
        let rows = vec![Row::Waiting; case.plan.delays.len()];
        let editor = Editor::new(&case.plan);
        Self {
            case,
            effort,
            rows,
            selected: 0,
            zoom: false,
            help: false,
            help_scroll: 0,
            theme: config.theme,
            keymap: config.keymap.clone(),
            screen: Screen::default(),
            compare: Compare::default(),
            player: Player::default(),
            studies: Studies::default(),
            editor,
            prompt: None,
            places: Vec::new(),
            notice: None,
            warned: false,
        }
    }

    /// A key was pressed, or a command chosen.
    pub fn act(&mut self, action: Action) -> Request {
        self.notice = None;
        if action != Action::Quit {
            self.warned = false;
        }
        if self.help && self.scroll_help(action) {
            return Request::None;
        }
        match self.screen {
            Screen::Plan => self.act_on_plan(action),
            Screen::Compare => self.act_on_options(action),
            Screen::Flight => self.act_on_flight(action),
            Screen::Studies => self.act_on_studies(action),
            Screen::Accuracy => self.act_on_accuracy(action),
        }
    }

    /// Whether an open help took the key.
    fn scroll_help(&mut self, action: Action) -> bool {
        let lines = match action {
            Action::Up => -1,
            Action::Down => 1,
            Action::PageUp => -(PAGE as i16),
            Action::PageDown => PAGE as i16,
            _ => return false,
        };
        self.help_scroll = self.help_scroll.saturating_add_signed(lines).min(BINDINGS.len() as u16);
        true
    }

    /// A place of the screen was clicked, or the button held and moved over it.
    pub fn click(&mut self, at: Position) -> Request {
        let hit = self.places.iter().rev().find(|(place, _)| place.contains(at)).copied();
        let Some((place, target)) = hit else { return Request::None };
        match target {
            Target::Act(action) => return self.act(action),
            Target::Option(option) if option == self.selected => return self.act(Action::Open),
            Target::Option(option) => self.selected = option,
            Target::Sort(sort) => self.compare.sort_by(sort),
            Target::Field(field) if field == self.editor.selected => return self.act(Action::Open),
            Target::Field(field) => {
                return self.select_field(field as isize - self.editor.selected as isize);
            }
            Target::Study(kind) => self.studies.show(kind),
            Target::Time(end) => {
                let part = f64::from(at.x - place.x) / f64::from(place.width.saturating_sub(1).max(1));
                self.player.seek(part * end, end);
            }
        }
        Request::None
    }

    /// A key while something is typed at the foot of the screen.
    pub fn type_in_prompt(&mut self, key: &KeyEvent) -> Request {
        let Some(mut prompt) = self.prompt.take() else { return Request::None };
        let typed = prompt.key(key);
        let text = prompt.input.value().to_owned();
        match (prompt.purpose, typed) {
            (Purpose::Search, Typed::Left) => self.find("", false),
            (Purpose::Search, Typed::Changed) => self.find(&text, key.code == KeyCode::Down),
            (Purpose::Palette, Typed::Done) => {
                let chosen = prompt.commands().get(prompt.selected).map(|binding| binding.action);
                return chosen.map_or(Request::None, |action| self.act(action));
            }
            (Purpose::Export, Typed::Done) if !text.is_empty() => return Request::Export(text.into()),
            (Purpose::SaveAs, Typed::Done) if !text.is_empty() => return Request::SaveAs(text.into()),
            _ => {}
        }
        if typed == Typed::Changed {
            self.prompt = Some(prompt);
        }
        Request::None
    }

    /// Looks for something typed: options and lines that have it are kept, a value of the plan is selected.
    fn find(&mut self, text: &str, next: bool) {
        match self.screen {
            Screen::Plan => {
                self.editor.find(text, next);
                self.follow_field();
            }
            Screen::Studies => self.studies.filter = text.to_owned(),
            Screen::Compare | Screen::Flight | Screen::Accuracy => {
                self.compare.filter = text.to_owned();
                self.select_listed(0);
            }
        }
    }

    /// A study that what is shown needs and nobody has begun.
    pub fn wanted(&mut self) -> Request {
        if self.screen != Screen::Flight || self.player.option == Some(self.selected) {
            return Request::None;
        }
        self.player.ask(self.selected);
        self.studies.set(Kind::Flight, Progress::Running { done: 0, total: 0 });
        Request::Start(Kind::Flight)
    }

    /// So much time has passed.
    pub fn pass(&mut self, time: Duration) {
        self.player.advance(time, self.flight_end());
    }

    /// When the flight shown ends [s]; 0 while there is none.
    fn flight_end(&self) -> f64 {
        self.studies.flight(self.selected).map_or(0.0, |flight| flight.end())
    }

    fn act_on_flight(&mut self, action: Action) -> Request {
        let end = self.flight_end();
        let seek = |player: &mut Player, by: f64| player.seek(player.time + by, end);
        match action {
            Action::Play => self.player.toggle(end),
            Action::Faster => self.player.faster(),
            Action::Slower => self.player.slower(),
            Action::Turn => self.player.along_rows = !self.player.along_rows,
            Action::Left => seek(&mut self.player, -SCRUB),
            Action::Right => seek(&mut self.player, SCRUB),
            Action::PageUp => seek(&mut self.player, -SCRUB * PAGE as f64),
            Action::PageDown => seek(&mut self.player, SCRUB * PAGE as f64),
            Action::First => self.player.seek(0.0, end),
            Action::Last => self.player.seek(end, end),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            Action::Open => self.screen = Screen::Compare,
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_accuracy(&mut self, action: Action) -> Request {
        match action {
            Action::Open | Action::Rerun => {
                self.studies.set(Kind::Accuracy, Progress::Running { done: 0, total: 0 });
                return Request::Start(Kind::Accuracy);
            }
            Action::Cancel => return self.cancel(Kind::Accuracy),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_plan(&mut self, action: Action) -> Request {
        let page = PAGE as isize;
        let edit = match action {
            Action::Up => return self.select_field(-1),
            Action::Down => return self.select_field(1),
            Action::PageUp => return self.select_field(-page),
            Action::PageDown => return self.select_field(page),
            Action::First => return self.select_field(isize::MIN),
            Action::Last => return self.select_field(isize::MAX),
            Action::Open => {
                self.editor.begin();
                return Request::None;
            }
            Action::Left => self.editor.step(false),
            Action::Right => self.editor.step(true),
            Action::AddOption => self.editor.copy_option(),
            Action::RemoveOption => self.editor.remove_option(),
            other => return self.act_anywhere(other),
        };
        self.edited(edit)
    }

    /// Selects a field, and with it the option it belongs to.
    fn select_field(&mut self, places: isize) -> Request {
        self.editor.select(places);
        self.follow_field();
        Request::None
    }

    /// Selects the option that the selected field belongs to.
    fn follow_field(&mut self) {
        if let Some(field) = self.editor.field().filter(|field| field.path.section == "delay") {
            self.selected = field.path.index.unwrap_or(0).min(self.rows.len().saturating_sub(1));
        }
    }

    /// A key while a value is typed.
    pub fn type_key(&mut self, key: &KeyEvent) -> Request {
        let edit = self.editor.type_key(key);
        self.edited(edit)
    }

    fn edited(&mut self, edit: Edit) -> Request {
        match edit {
            Edit::None => Request::None,
            Edit::Changed(plan) => self.take(*plan),
        }
    }

    /// Another plan takes the place of the one shown; long studies of the old one are dropped.
    fn take(&mut self, plan: Plan) -> Request {
        self.case = Arc::new(Case::new(plan));
        self.rows = vec![Row::Waiting; self.case.plan.delays.len()];
        self.selected = self.selected.min(self.rows.len().saturating_sub(1));
        self.compare.baseline = None;
        self.forget();
        Request::Replaced
    }

    /// Drops what the long studies found.
    fn forget(&mut self) {
        self.studies.forget();
        self.player.option = None;
    }

    /// The plan's file has changed: another plan, or what is wrong with it.
    pub fn reload(&mut self, read: Result<Plan, String>) -> Request {
        match read {
            Ok(plan) if plan.text == self.editor.saved => Request::None,
            Ok(_) if self.editor.unsaved() => {
                self.notice = Some("the file has changed; your changes here are not saved".to_owned());
                Request::None
            }
            Ok(plan) => {
                let selected = self.editor.selected;
                self.editor = Editor::new(&plan);
                self.editor.select(selected as isize);
                self.notice = Some("the file has changed and was read again".to_owned());
                self.take(plan)
            }
            Err(words) => {
                self.notice = Some(format!("{words}; the last good plan is shown"));
                Request::None
            }
        }
    }

    /// The plan was written to `path`, or why not.
    pub fn written(&mut self, result: Result<String, String>) {
        self.notice = Some(match result {
            Ok(path) => {
                self.editor.saved = self.editor.text.clone();
                format!("saved {path}")
            }
            Err(words) => format!("not saved: {words}"),
        });
    }

    /// Whether something moves by itself.
    pub fn moving(&self) -> bool {
        self.screen == Screen::Flight && self.player.playing
    }

    fn act_on_studies(&mut self, action: Action) -> Request {
        let kind = self.studies.shown;
        match action {
            Action::Up => self.studies.scroll(-1),
            Action::Down => self.studies.scroll(1),
            Action::PageUp => self.studies.scroll(-(PAGE as i16)),
            Action::PageDown => self.studies.scroll(PAGE as i16),
            Action::First => self.studies.scroll = 0,
            Action::Last => self.studies.scroll = u16::MAX,
            Action::Left => self.studies.turn(-1),
            Action::Right => self.studies.turn(1),
            Action::Open | Action::Rerun => {
                self.studies.set(kind, Progress::Running { done: 0, total: 0 });
                return Request::Start(kind);
            }
            Action::Cancel => return self.cancel(kind),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_options(&mut self, action: Action) -> Request {
        let page = PAGE as isize;
        match action {
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            Action::PageUp => self.select_listed(-page),
            Action::PageDown => self.select_listed(page),
            Action::First => self.select_listed(isize::MIN),
            Action::Last => self.select_listed(isize::MAX),
            Action::Open => self.zoom = !self.zoom,
            Action::Sort => {
                self.compare.sort = self.compare.sort.next();
                self.compare.reversed = false;
            }
            Action::Reverse => self.compare.reversed = !self.compare.reversed,
            Action::Baseline => {
                let same = self.compare.baseline == Some(self.selected);
                self.compare.baseline = (!same).then_some(self.selected);
            }
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Keys that mean the same on every screen.
    fn act_anywhere(&mut self, action: Action) -> Request {
        match action {
            Action::Show(screen) => self.screen = screen,
            Action::NextScreen => self.screen = self.screen.turned(1),
            Action::PreviousScreen => self.screen = self.screen.turned(Screen::ALL.len() - 1),
            Action::Undo => {
                let edit = self.editor.undo();
                return self.edited(edit);
            }
            Action::Redo => {
                let edit = self.editor.redo();
                return self.edited(edit);
            }
            Action::Save => return Request::Save,
            Action::Search => self.prompt = Some(Prompt::new(Purpose::Search, "")),
            Action::Palette => self.prompt = Some(Prompt::new(Purpose::Palette, "")),
            Action::Export => self.prompt = Some(Prompt::new(Purpose::Export, &self.export_name())),
            Action::Yank => return Request::Yank,
            Action::Theme => self.theme = self.theme.next(),
            Action::Help => {
                self.help = !self.help;
                self.help_scroll = 0;
            }
            Action::Rerun => return self.rerun(self.effort.accuracy),
            Action::Finer => return self.rerun(finer(self.effort.accuracy)),
            Action::Coarser => return self.rerun(coarser(self.effort.accuracy)),
            Action::Suspend => return Request::Suspend,
            Action::Quit => return self.quit(),
            _ => {}
        }
        Request::None
    }

    /// The file offered for what is shown.
    fn export_name(&self) -> String {
        let plan = std::path::Path::new(&self.case.plan.path);
        let stem = plan.file_stem().and_then(|stem| stem.to_str()).unwrap_or("plan");
        format!("{stem}-{}.csv", self.screen.name().to_lowercase())
    }

    /// Asks for a file to write the plan to.
    pub fn ask_for_file(&mut self) {
        self.prompt = Some(Prompt::new(Purpose::SaveAs, "plan.toml"));
    }

    fn cancel(&mut self, kind: Kind) -> Request {
        if !matches!(self.studies.progress(kind), Progress::Running { .. }) {
            return Request::None;
        }
        self.studies.set(kind, Progress::Idle);
        Request::Cancel(kind)
    }

    /// Escape closes what is open before it leaves.
    pub fn escape(&mut self) -> Request {
        if self.help {
            self.help = false;
        } else if let Some(kind) = self.cancellable() {
            return self.cancel(kind);
        } else if !self.compare.filter.is_empty() || !self.studies.filter.is_empty() {
            self.compare.filter.clear();
            self.studies.filter.clear();
        } else if self.screen != Screen::Compare {
            self.screen = Screen::Compare;
        } else if self.zoom {
            self.zoom = false;
        } else {
            return self.quit();
        }
        Request::None
    }

    /// The study shown, while it computes.
    fn cancellable(&self) -> Option<Kind> {
        let kind = match self.screen {
            Screen::Studies => self.studies.shown,
            Screen::Accuracy => Kind::Accuracy,
            Screen::Plan | Screen::Compare | Screen::Flight => return None,
        };
        matches!(self.studies.progress(kind), Progress::Running { .. }).then_some(kind)
    }

    /// Leaves, but not at once with changes that are not saved.
    fn quit(&mut self) -> Request {
        if !self.editor.unsaved() || self.warned {
            return Request::Quit;
        }
        self.warned = true;
        self.notice = Some("changes are not saved: s saves, quit again leaves without".to_owned());
        Request::None
    }

    fn rerun(&mut self, accuracy: Accuracy) -> Request {
        self.effort.accuracy = accuracy;
        self.rows.fill(Row::Waiting);
        self.player.option = None;
        Request::Run
    }

    /// The worker has news.
    pub fn hear(&mut self, event: Event) {
        let done = match &event.news {
            News::Progress { runs, time } => self.part_done(event.option, *runs, *time),
            _ => 0.0,
        };
        let Some(row) = self.rows.get_mut(event.option) else { return };
        *row = match event.news {
            News::Progress { runs, .. } => Row::Running { runs, done },
            News::Done(checked) => Row::Done(checked),
            News::Failed(message) => Row::Failed(message),
        };
    }

    /// A long study has a result.
    pub fn learn(&mut self, kind: Kind, result: Result<Found, String>) {
        let progress = match result {
            Ok(found) => Progress::Done(Arc::new(found)),
            Err(words) => Progress::Failed(words),
        };
        self.studies.set(kind, progress);
    }

    /// Part of the first rungs that is done: each costs [`error::RATIO`] times the one before.
    fn part_done(&self, option: usize, runs: usize, time: f64) -> f64 {
        let firings = &self.case.shots[option].firings;
        let last = firings.last().map_or(0.0, |firing| firing.at);
        let end = self.case.plan.simulation.duration_s.unwrap_or(last + USUAL_FLIGHT);
        let cost = |runs: f64| error::RATIO.powf(runs) - 1.0;
        let whole = cost(1.0 + error::NEIGHBOURS as f64);
        let (before, after) = (cost(runs as f64), cost(runs as f64 + 1.0));
        ((before + (after - before) * (time / end).clamp(0.0, 1.0)) / whole).min(0.99)
    }

    /// Whether anything still computes.
    pub fn busy(&self) -> bool {
        self.computing() || self.studies.busy()
    }

    /// Whether an option still computes.
    pub fn computing(&self) -> bool {
        self.rows.iter().any(|row| matches!(row, Row::Waiting | Row::Running { .. }))
    }
}

fn finer(accuracy: Accuracy) -> Accuracy {
    match accuracy {
        Accuracy::Draft => Accuracy::Field,
        Accuracy::Field | Accuracy::Reference => Accuracy::Reference,
    }
}

fn coarser(accuracy: Accuracy) -> Accuracy {
    match accuracy {
        Accuracy::Reference => Accuracy::Field,
        Accuracy::Field | Accuracy::Draft => Accuracy::Draft,
    }
}
