//! What the long studies have come to, as the screen shows it.

use std::fmt;
use std::sync::Arc;

use crate::study::NoResult;
use crate::study::flight::Flight;
use crate::worker::{Found, Kind};

/// One study.
#[derive(Clone, Debug, Default)]
pub enum Progress {
    /// Not begun, or cancelled.
    #[default]
    Idle,
    /// Under way.
    Running {
        /// Shots judged.
        done: usize,
        /// Expected so far.
        total: usize,
    },
    /// Its result, kept while one looks elsewhere.
    Done(Arc<Found>),
    /// Without a result.
    Failed(NoResult),
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Progress::Idle => Ok(()),
            Progress::Running { done, total } => write!(f, "{} %", 100 * done / (*total).max(1)),
            Progress::Done(_) => write!(f, "done"),
            Progress::Failed(_) => write!(f, "no result"),
        }
    }
}

/// All of them.
#[derive(Clone, Debug)]
pub struct Studies {
    /// Which is shown.
    pub shown: Kind,
    /// Lines scrolled.
    pub scroll: u16,
    /// Only lines that contain this.
    pub filter: String,
    progress: [Progress; Kind::ALL.len()],
}

impl Default for Studies {
    fn default() -> Self {
        Self { shown: Kind::Sweep, scroll: 0, filter: String::new(), progress: Default::default() }
    }
}

impl Studies {
    /// How a study stands.
    pub fn progress(&self, kind: Kind) -> &Progress {
        &self.progress[kind as usize]
    }

    /// Notes how a study stands.
    pub fn set(&mut self, kind: Kind, progress: Progress) {
        self.progress[kind as usize] = progress;
    }

    /// Notes how far a study is; whether that is news.
    pub fn advance(&mut self, kind: Kind, counts: (usize, usize)) -> bool {
        let known =
            matches!(self.progress(kind), Progress::Running { done, total } if (*done, *total) == counts);
        let (done, total) = counts;
        self.set(kind, Progress::Running { done, total });
        !known
    }

    /// Nothing found yet, the same study shown.
    pub fn forget(&mut self) {
        *self = Self { shown: self.shown, ..Self::default() };
    }

    /// How a study stands, in a word.
    pub fn state(&self, kind: Kind) -> String {
        self.progress(kind).to_string()
    }

    /// Shows the study so many places further.
    pub fn turn(&mut self, places: isize) {
        let count = Kind::STUDIES.len() as isize;
        self.show(Kind::STUDIES[(self.shown as isize + places).rem_euclid(count) as usize]);
    }

    /// Shows a study.
    pub fn show(&mut self, kind: Kind) {
        self.shown = kind;
        self.scroll = 0;
    }

    /// Scrolls so many lines.
    pub fn scroll(&mut self, lines: i16) {
        self.scroll = self.scroll.saturating_add_signed(lines);
    }

    /// The recorded motion of an option.
    pub fn flight(&self, option: usize) -> Option<&Flight> {
        match self.progress(Kind::Flight) {
            Progress::Done(found) => match found.as_ref() {
                Found::Flight(flight) if flight.option == option => Some(flight),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether any computes.
    pub fn busy(&self) -> bool {
        self.progress.iter().any(|progress| matches!(progress, Progress::Running { .. }))
    }
}
