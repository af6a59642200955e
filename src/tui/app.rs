//! The state of the screen and how keys and news change it. No input or output happens here.

use std::sync::Arc;

use super::keymap::Action;
use super::studies::{Progress, Studies};
use super::theme::Theme;
use crate::plan::Accuracy;
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
    /// Begin a long study.
    Start(Kind),
    /// End a long study.
    Cancel(Kind),
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
}

/// What the screen shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Screen {
    /// The delay options side by side.
    #[default]
    Compare,
    /// Sweep, orders, scatter, size.
    Studies,
}

/// Options a page key moves.
const PAGE: usize = 10;
/// Simulated time after the last firing that a run is expected to last [s].
const USUAL_FLIGHT: f64 = 1.6;

impl App {
    /// Nothing computed yet.
    pub fn new(case: Arc<Case>, effort: Effort) -> Self {
        let rows = vec![Row::Waiting; case.plan.delays.len()];
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
        }
    }

    /// A key was pressed.
    pub fn act(&mut self, action: Action) -> Request {
        if self.screen == Screen::Studies {
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
            return Request::None;
        }
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
            Action::Theme => self.theme = self.theme.next(),
            Action::Help => self.help = !self.help,
            Action::Finer => return self.rerun(finer(self.effort.accuracy)),
            Action::Coarser => return self.rerun(coarser(self.effort.accuracy)),
            Action::Suspend => return Request::Suspend,
            Action::Quit => return Request::Quit,
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
        } else if self.zoom {
            self.zoom = false;
        } else {
            return Request::Quit;
        }
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
