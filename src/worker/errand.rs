//! Long studies in the background: each kind at most once, cancelled within a step, its result handed over whole.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

use crate::plan::ScatterSpec;
use crate::study::accuracy;
use crate::study::flight::{Flight, record};
use crate::study::orders::{Orders, orders};
use crate::study::scatter::{Draw, Sample, scatter};
use crate::study::size::{Demand, Sizing, size};
use crate::study::sweep::{Sweep, sweep};
use crate::study::{Case, ComputeSettings, Intervals, NoResult, Progress, Shard, guarded};

/// A long study, with what a screen asks it for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Intervals from 0 to 500 ms, rows in the order listed.
    Sweep,
    /// All orders at the intervals of the delay options.
    Orders,
    /// A thousand samples of every option.
    Scatter,
    /// The lightest shelter with which every option passes.
    Size,
    /// The motion of one option.
    Flight,
    /// What accuracy costs, by one option.
    Accuracy,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 6] =
        [Kind::Sweep, Kind::Orders, Kind::Scatter, Kind::Size, Kind::Flight, Kind::Accuracy];
    /// Those that answer a question about the whole plan.
    pub const STUDIES: [Kind; 4] = [Kind::Sweep, Kind::Orders, Kind::Scatter, Kind::Size];
}

/// What a study found.
#[derive(Clone, Debug)]
pub enum Found {
    /// Of [`Kind::Sweep`].
    Sweep(Sweep),
    /// Of [`Kind::Orders`].
    Orders(Orders),
    /// Of [`Kind::Scatter`].
    Scatter(Draw, Vec<Sample>),
    /// Of [`Kind::Size`].
    Size(Sizing),
    /// Of [`Kind::Flight`].
    Flight(Flight),
    /// Of [`Kind::Accuracy`].
    Accuracy(accuracy::Study),
}

/// Samples of every option.
const DRAW: Draw = Draw { samples: 1000, seed: 1, certain_at: None };
/// Intervals swept [s].
const INTERVALS: Intervals = Intervals { from: 0.0, to: 0.5, step: 5e-3 };
/// Longest run that [`Kind::Accuracy`] makes.
const PATIENCE: Duration = Duration::from_secs(1);

type Result = std::result::Result<Found, NoResult>;

/// Long studies under way.
pub struct Errands {
    threads: usize,
    under_way: [Option<Arc<Progress>>; Kind::ALL.len()],
    sender: Sender<(Kind, Arc<Progress>, Result)>,
    results: Receiver<(Kind, Arc<Progress>, Result)>,
}

impl Errands {
    /// None under way; each will use so many threads, 0: one per core.
    pub fn new(threads: usize) -> Self {
        let (sender, results) = channel();
        Self { threads, under_way: Default::default(), sender, results }
    }

    /// Begins a study; one of its kind that was under way ends without a result.
    ///
    /// `option` is that of a study of a single one.
    pub fn start(&mut self, kind: Kind, case: &Arc<Case>, option: usize, compute: ComputeSettings) {
        self.cancel(kind);
        let progress = Arc::new(Progress::default());
        self.under_way[kind as usize] = Some(Arc::clone(&progress));
        let (case, sender, threads) = (Arc::clone(case), self.sender.clone(), self.threads);
        thread::spawn(move || {
            let study = || guarded(|| study(kind, &case, option, &compute, &progress));
            let result = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
                Ok(pool) => pool.install(study),
                Err(error) => Err(NoResult::NoThreads(error.to_string())),
            };
            // A receiver that is gone has quit: nobody is left to tell.
            let _ = sender.send((kind, progress, result));
        });
    }

    /// Ends a study without a result.
    pub fn cancel(&mut self, kind: Kind) {
        if let Some(progress) = self.under_way[kind as usize].take() {
            progress.stop();
        }
    }

    /// Shots judged and expected, of a study under way.
    pub fn counts(&self, kind: Kind) -> Option<(usize, usize)> {
        self.under_way[kind as usize].as_ref().map(|progress| progress.counts())
    }

    /// Results since the last call; those of cancelled studies are dropped.
    pub fn results(&mut self) -> Vec<(Kind, Result)> {
        let mut new = Vec::new();
        while let Ok((kind, progress, result)) = self.results.try_recv() {
            let place = &mut self.under_way[kind as usize];
            if place.as_ref().is_some_and(|current| Arc::ptr_eq(current, &progress)) {
                *place = None;
                new.push((kind, result));
            }
        }
        new
    }
}

impl Drop for Errands {
    fn drop(&mut self) {
        Kind::ALL.into_iter().for_each(|kind| self.cancel(kind));
    }
}

fn study(kind: Kind, case: &Case, option: usize, compute: &ComputeSettings, progress: &Progress) -> Result {
    match kind {
        Kind::Sweep => {
            let order: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
            sweep(case, &order, &INTERVALS, compute, progress).map(Found::Sweep)
        }
        Kind::Orders => {
            let intervals = case.intervals();
            let tried = orders(case, &intervals, Shard::WHOLE, compute, progress)?;
            Ok(Found::Orders(Orders::new(case, tried, intervals.len())))
        }
        Kind::Scatter => {
            let spec: ScatterSpec = case.plan.scatter.ok_or(NoResult::NoScatter)?;
            let samples = scatter(case, &spec, &DRAW, Shard::WHOLE, compute, progress)?;
            Ok(Found::Scatter(DRAW, samples))
        }
        Kind::Size => size(&case.plan, &Demand::Options, compute, progress).map(Found::Size),
        Kind::Flight => record(case, option, compute, progress).map(Found::Flight),
        Kind::Accuracy => accuracy::measure(case, option, PATIENCE, progress).map(Found::Accuracy),
    }
}
