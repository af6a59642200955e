//! The state of the screen and how keys and news change it. No input or output happens here.

use std::sync::Arc;

use crossterm::event::KeyEvent;

use super::editor::{Edit, Editor};
use super::keymap::Action;
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// Give the terminal back for now.
    Suspend,
    /// Leave.
    Quit,
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
    /// Colours.
    pub theme: Theme,
    /// What is shown.
    pub screen: Screen,
    /// Long studies.
    pub studies: Studies,
    /// The plan's text.
    pub editor: Editor,
    /// News of the plan's file.
    pub notice: Option<String>,
    /// Whether leaving was refused once, because of changes that are not saved.
    pub warned: bool,
}

/// What the screen shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Screen {
    /// The delay options side by side.
    #[default]
    Compare,
    /// Sweep, orders, scatter, size.
    Studies,
    /// The plan, to be changed.
    Plan,
}

/// Options a page key moves.
const PAGE: usize = 10;
/// Simulated time after the last firing that a run is expected to last [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// Nothing computed yet.
    pub fn new(case: Arc<Case>, effort: Effort) -> Self {
        let rows = vec![Row::Waiting; case.plan.delays.len()];
        let editor = Editor::new(&case.plan);
        Self {
            case,
            effort,
            rows,
            selected: 0,
            zoom: false,
            help: false,
            theme: Theme::default(),
            screen: Screen::default(),
            studies: Studies::default(),
            editor,
            notice: None,
            warned: false,
        }
    }

    /// A key was pressed.
    pub fn act(&mut self, action: Action) -> Request {
        self.notice = None;
        if action != Action::Quit {
            self.warned = false;
        }
        match self.screen {
            Screen::Studies => self.act_on_studies(action),
            Screen::Plan => self.act_on_plan(action),
            Screen::Compare => self.act_on_options(action),
        }
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
            Action::Zoom => {
                self.editor.begin();
                return Request::None;
            }
            Action::Left => self.editor.step(false),
            Action::Right => self.editor.step(true),
            Action::Undo => self.editor.undo(),
            Action::Redo => self.editor.redo(),
            Action::Copy => self.editor.copy_option(),
            Action::Remove => self.editor.remove_option(),
            other => return self.act_anywhere(other),
        };
        self.edited(edit)
    }

    /// Selects a field, and with it the option it belongs to.
    fn select_field(&mut self, places: isize) -> Request {
        self.editor.select(places);
        if let Some(field) = self.editor.field().filter(|field| field.path.section == "delay") {
            self.selected = field.path.index.unwrap_or(0).min(self.rows.len().saturating_sub(1));
        }
        Request::None
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
        self.studies.forget();
        Request::Replaced
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

    /// The plan was written, or why not.
    pub fn written(&mut self, result: Result<(), String>) {
        self.notice = Some(match result {
            Ok(()) => {
                self.editor.saved = self.editor.text.clone();
                format!("saved {}", self.case.plan.path)
            }
            Err(words) => format!("not saved: {words}"),
        });
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
            Action::Zoom | Action::Rerun => {
                self.studies.set(kind, Progress::Running { done: 0, total: 0 });
                return Request::Start(kind);
            }
            Action::Cancel => return self.cancel(kind),
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    fn act_on_options(&mut self, action: Action) -> Request {
        let last = self.rows.len().saturating_sub(1);
        match action {
            Action::Up => self.selected = self.selected.saturating_sub(1),
            Action::Down => self.selected = (self.selected + 1).min(last),
            Action::PageUp => self.selected = self.selected.saturating_sub(PAGE),
            Action::PageDown => self.selected = (self.selected + PAGE).min(last),
            Action::First => self.selected = 0,
            Action::Last => self.selected = last,
            Action::Zoom => self.zoom = !self.zoom,
            Action::Rerun => return self.rerun(self.effort.accuracy),
            Action::Left | Action::Right | Action::Cancel => {}
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Keys that mean the same on every screen.
    fn act_anywhere(&mut self, action: Action) -> Request {
        match action {
            Action::Compare => self.screen = Screen::Compare,
            Action::Studies => self.screen = Screen::Studies,
            Action::Plan => self.screen = Screen::Plan,
            Action::Save => return Request::Save,
            Action::Theme => self.theme = self.theme.next(),
            Action::Help => self.help = !self.help,
            Action::Finer => return self.rerun(finer(self.effort.accuracy)),
            Action::Coarser => return self.rerun(coarser(self.effort.accuracy)),
            Action::Suspend => return Request::Suspend,
            Action::Quit => return self.quit(),
            _ => {}
        }
        Request::None
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
        } else if self.screen == Screen::Studies {
            let kind = self.studies.shown;
            match self.cancel(kind) {
                Request::None => self.screen = Screen::Compare,
                cancel => return cancel,
            }
        } else if self.screen == Screen::Plan {
            self.screen = Screen::Compare;
        } else if self.zoom {
            self.zoom = false;
        } else {
            return self.quit();
        }
        Request::None
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
