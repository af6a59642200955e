//! Checks in the background: a case comes in, small events go out, the newest request wins.
//!
//! Each request has a generation number; starting a new one, or dropping the worker, stops the old within some steps. A panic
//! while an option computes becomes that option's failure. The work itself is [`check`], the same that scripts run.

mod errand;

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

pub use errand::{Errands, Found, Kind};

use crate::simulation::Failure;
use crate::study::check::{Checked, check};
use crate::study::{Case, ComputeSettings, NoResult, guarded};

/// News of one option.
#[derive(Debug)]
pub struct Event {
    /// Index of the option.
    pub option: usize,
    /// What happened.
    pub news: News,
}

/// What happened to an option.
#[derive(Debug)]
pub enum News {
    /// It computes: runs finished, and the time the present one has reached [s].
    Progress {
        /// Runs finished.
        runs: usize,
        /// Simulated time [s].
        time: f64,
    },
    /// It is judged.
    Done(Box<Checked>),
    /// It has no result.
    Failed(NoResult),
}

/// Computes in the background.
pub struct Worker {
    threads: usize,
    generation: usize,
    stop: Arc<AtomicBool>,
    sender: Sender<(usize, Event)>,
    events: Receiver<(usize, Event)>,
}

/// Least time between two progress events of an option.
const PROGRESS_EVERY: Duration = Duration::from_millis(50);
/// Steps between two looks at the clock.
const STEPS_PER_LOOK: usize = 64;

impl Worker {
    /// An idle worker that will use so many threads; 0: one per core.
    pub fn new(threads: usize) -> Self {
        let cores = || thread::available_parallelism().map_or(1, usize::from);
        let (sender, events) = channel();
        Self {
            threads: if threads == 0 { cores() } else { threads },
            generation: 0,
            stop: Arc::default(),
            sender,
            events,
        }
    }

    /// Begins to check every option of `case`; whatever was computing stops.
    pub fn start(&mut self, case: &Arc<Case>, compute: ComputeSettings) {
        self.stop.store(true, Ordering::Relaxed);
        self.stop = Arc::default();
        self.generation += 1;
        let next = Arc::new(AtomicUsize::new(0));
        for _ in 0..self.threads.min(case.shots.len()) {
            let checker = Checker {
                case: Arc::clone(case),
                compute,
                generation: self.generation,
                stop: Arc::clone(&self.stop),
                next: Arc::clone(&next),
                sender: self.sender.clone(),
            };
            thread::spawn(move || checker.run());
        }
    }

    /// News of the newest request since the last call.
    pub fn news(&self) -> impl Iterator<Item = Event> {
        let newest = self.generation;
        self.events.try_iter().filter(move |(generation, _)| *generation == newest).map(|(_, event)| event)
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// What one thread of a request needs.
struct Checker {
    case: Arc<Case>,
    compute: ComputeSettings,
    generation: usize,
    stop: Arc<AtomicBool>,
    next: Arc<AtomicUsize>,
    sender: Sender<(usize, Event)>,
}

impl Checker {
    fn run(&self) {
        while !self.stopped() {
            let option = self.next.fetch_add(1, Ordering::Relaxed);
            if option >= self.case.shots.len() {
                return;
            }
            let judged = guarded(|| self.judge(option).map_err(NoResult::Failed));
            self.send(option, judged.map_or_else(News::Failed, |checked| News::Done(Box::new(checked))));
        }
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn send(&self, option: usize, news: News) {
        // A receiver that is gone has quit: nobody is left to tell.
        let _ = self.sender.send((self.generation, Event { option, news }));
    }

    fn judge(&self, option: usize) -> Result<Checked, Failure> {
        let (mut steps, mut told) = (0_usize, Instant::now());
        check(&self.case, option, &self.compute, &mut |progress| {
            steps += 1;
            if steps.is_multiple_of(STEPS_PER_LOOK) {
                if self.stopped() {
                    return ControlFlow::Break(());
                }
                if told.elapsed() > PROGRESS_EVERY {
                    told = Instant::now();
                    self.send(option, News::Progress { runs: progress.runs, time: progress.time });
                }
            }
            ControlFlow::Continue(())
        })
    }
}
