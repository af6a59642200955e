//! The state of the screen and how news changes it; what keys and clicks do to it is in `act`. No input or output happens
//! here.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use ratatui::layout::Rect;

use super::compare::{Compare, SortBy};
use super::config::Config;
use super::editor::Editor;
use super::keymap::{Action, Keymap};
use super::player::Player;
use super::prompt::Prompt;
use super::studies::{Progress, Studies};
use super::theme::Theme;
use crate::plan::{Plan, PlanSource};
use crate::study::check::Checked;
use crate::study::{Case, ComputeSettings, NoResult, error};
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
    Failed(NoResult),
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
    /// Lines that can be scrolled at most; no click.
    Lines(u16),
    /// Show a time, from the left end of the place to its right end [s].
    Time(f64),
}

/// Everything the screen shows.
#[derive(Clone, Debug)]
pub struct App {
    /// The plan.
    pub case: Arc<Case>,
    /// How finely it is computed.
    pub compute: ComputeSettings,
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
    /// Whether the file has changed and was not read again, because of changes here.
    pub behind: bool,
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
    pub(super) fn turned(self, places: usize) -> Self {
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

/// Simulated time after the last firing that a run is expected to last [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// Nothing computed yet.
    pub fn new(case: Arc<Case>, compute: ComputeSettings, config: &Config) -> Self {
        let rows = vec![Row::Waiting; case.plan.delays.len()];
        let editor = Editor::new(&case.source.text);
        Self {
            case,
            compute,
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
            behind: false,
            warned: false,
        }
    }

    /// A study that what is shown needs and nobody has begun.
    pub fn wanted(&mut self) -> Request {
        if self.screen != Screen::Flight || self.player.option == Some(self.selected) {
            return Request::None;
        }
        self.player.ask(self.selected);
        self.start(Kind::Flight)
    }

    /// Begins a study.
    pub(super) fn start(&mut self, kind: Kind) -> Request {
        self.studies.set(kind, Progress::Running { done: 0, total: 0 });
        Request::Start(kind)
    }

    /// The screen was drawn, and what it showed where.
    pub fn drawn(&mut self, places: Vec<(Rect, Target)>) {
        let scroll = if self.help { &mut self.help_scroll } else { &mut self.studies.scroll };
        for (_, target) in &places {
            if let Target::Lines(most) = target {
                *scroll = (*scroll).min(*most);
            }
        }
        self.places = places;
    }

    /// So much time has passed.
    pub fn pass(&mut self, time: Duration) {
        self.player.advance(time, self.flight_end());
    }

    /// When the flight shown ends [s]; 0 while there is none.
    pub(super) fn flight_end(&self) -> f64 {
        self.studies.flight(self.selected).map_or(0.0, |flight| flight.end())
    }

    /// Another plan takes the place of the one shown; long studies of the old one are dropped.
    fn take(&mut self, case: Case) -> Request {
        self.compute.follow(&self.case.plan, &case.plan);
        self.case = Arc::new(case);
        self.rows = vec![Row::Waiting; self.case.plan.delays.len()];
        self.selected = self.selected.min(self.rows.len().saturating_sub(1));
        self.compare.baseline = None;
        self.forget();
        Request::Replaced
    }

    /// The plan that the editor's text says takes the place of the one shown.
    pub(super) fn take_edited(&mut self, plan: Plan) -> Request {
        let source = PlanSource { path: self.case.source.path.clone(), text: self.editor.text.clone() };
        self.take(Case { source, ..Case::new(plan) })
    }

    /// Drops what the long studies found.
    fn forget(&mut self) {
        self.studies.forget();
        self.player.option = None;
    }

    /// The plan's file has changed: another plan, or what is wrong with it.
    pub fn reload(&mut self, read: Result<Case, String>) -> Request {
        match read {
            Ok(case) if case.source.text == self.editor.saved => {
                // As it was before it was gone or wrong.
                self.notice = None;
                Request::None
            }
            Ok(_) if self.is_changing() => {
                self.behind = true;
                self.notice = Some("the file has changed; your changes here are not saved".to_owned());
                Request::None
            }
            Ok(case) => {
                self.editor.reload(&case.source.text);
                self.notice = Some("the file has changed and was read again".to_owned());
                self.take(case)
            }
            Err(words) => {
                self.notice = Some(format!("{words}; the last good plan is shown"));
                Request::None
            }
        }
    }

    /// Whether the plan here is another than was saved, or about to be.
    pub fn is_changing(&self) -> bool {
        self.editor.unsaved() || self.editor.typing()
    }

    /// The plan was written to `path`, or why not.
    pub fn written(&mut self, result: Result<String, String>) {
        self.notice = Some(match result {
            Ok(path) => {
                self.editor.saved = self.editor.text.clone();
                self.behind = false;
                format!("saved {path}")
            }
            Err(words) => format!("not saved: {words}"),
        });
    }

    /// The plan stands in another file now.
    pub fn rename(&mut self, path: &Path) {
        Arc::make_mut(&mut self.case).source.path = path.display().to_string();
    }

    /// Whether something moves by itself.
    pub fn moving(&self) -> bool {
        self.screen == Screen::Flight && self.player.playing
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
            News::Failed(no_result) => Row::Failed(no_result),
        };
    }

    /// A long study has a result.
    pub fn learn(&mut self, kind: Kind, result: Result<Found, NoResult>) {
        let progress = match result {
            Ok(found) => Progress::Done(Arc::new(found)),
            Err(no_result) => Progress::Failed(no_result),
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
