//! Checks and studies in the background: requests come in, news goes out.
//!
//! At most one job of each kind runs: a new request ends the old job of its kind. A job ends within one step of a run. Jobs call
//! the same functions as the commands. Their results do not depend on the number of threads. A panic is the result
//! [`NoResult::Panicked`] of the option or study that panicked.

mod judge;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::study::assumptions::Assumptions;
use crate::study::course_band::CourseBand;
use crate::study::judge::batch::Depth;
use crate::study::judge::{Judgement, Part};
use crate::study::question::{Asked, Found, StudyKind};
use crate::study::study_trait::Subject;
use crate::study::work::progress::Progress;
use crate::study::{Case, ComputeSettings, Context, NoResult, StudyControl, catch_panic, thread_pool};

/// Progress of a study, and the time left for the whole study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StudyAt {
    /// Progress.
    pub progress: Progress,
    /// Time left for the whole study; `None` while it is unknown.
    pub left: Option<Duration>,
}

/// Pieces of work of a job, nearly all of them runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Runs {
    /// Pieces done.
    pub done: usize,
    /// Pieces announced so far, with the pieces done: as many as are surely needed.
    pub announced: usize,
}

/// News of a job.
#[derive(Debug)]
pub enum News {
    /// An option is being computed.
    Checking {
        /// Index of the option.
        option: usize,
        /// Runs finished.
        runs: usize,
        /// Time that the present run has reached [s].
        time: f64,
    },
    /// The planned shot of an option is checked, and the rest of its verdict is still to come. Or the option has no result.
    Checked {
        /// Index of the option.
        option: usize,
        /// Judgement of the planned shot, still without the rest.
        result: Result<Box<Judgement>, NoResult>,
    },
    /// A further part of the judgement on an option whose planned shot is checked.
    Found {
        /// Index of the option.
        option: usize,
        /// The part.
        part: Part,
    },
    /// Pieces of work of the job that judges the options.
    Judging(Runs),
    /// Band over time in which nine of ten sampled shots of an option lie.
    Band {
        /// Index of the option.
        option: usize,
        /// The band.
        band: Box<CourseBand>,
    },
    /// Assumptions on which the pass of an option stands.
    Assumptions {
        /// Index of the option.
        option: usize,
        /// The nearest assumptions.
        found: Box<Assumptions>,
    },
    /// A study is being computed.
    Studying {
        /// Kind of the study.
        kind: StudyKind,
        /// Progress of the study.
        at: StudyAt,
    },
    /// A study has ended by itself.
    Studied {
        /// Kind of the study.
        kind: StudyKind,
        /// Settings of the computation.
        compute: ComputeSettings,
        /// Result of the study.
        result: Result<Found, NoResult>,
    },
}

/// The jobs under way.
pub struct Jobs {
    threads: usize,
    judging: Option<Arc<StudyControl>>,
    /// Pieces of work of the judging job, as last reported.
    last_judged: Runs,
    studies: [Option<Arc<StudyControl>>; StudyKind::ALL.len()],
    /// Start of each study, and its progress as last reported.
    last_reported: [Option<(Instant, Progress)>; StudyKind::ALL.len()],
    sender: Sender<(Arc<StudyControl>, News)>,
    receiver: Receiver<(Arc<StudyControl>, News)>,
}

/// Case, settings, control and channel for the work of one job.
struct Job {
    case: Arc<Case>,
    compute: ComputeSettings,
    control: Arc<StudyControl>,
    sender: Sender<(Arc<StudyControl>, News)>,
}

impl Jobs {
    /// Runner without a job. Each job will use `threads` threads; 0: one per core.
    pub fn new(threads: usize) -> Self {
        let cores = || thread::available_parallelism().map_or(1, usize::from);
        let threads = if threads == 0 { cores() } else { threads };
        let (sender, receiver) = channel();
        let (studies, last_reported) = Default::default();
        Self {
            threads,
            judging: None,
            last_judged: Runs::default(),
            studies,
            last_reported,
            sender,
            receiver,
        }
    }

    /// Judges every option of `case` to a depth, as far as it is not `known` from before (`n_options`): first the planned shot,
    /// then samples, then the launch margin, then fresh draws. Once all verdicts are known, finds the assumptions on which the
    /// passes stand. Each result is news by itself.
    pub fn judge(
        &mut self,
        case: &Arc<Case>,
        compute: ComputeSettings,
        known: Vec<Option<Judgement>>,
        depth: Depth,
    ) {
        let job = self.job(case, compute);
        stop(self.judging.replace(Arc::clone(&job.control)));
        match thread_pool(self.threads) {
            Ok(pool) => pool.spawn(move || job.judge(&known, depth)),
            Err(none) => job.tell_no_result(&none),
        }
    }

    /// Number of threads of each job.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Starts a study of a kind about a subject.
    pub fn study(&mut self, kind: StudyKind, case: &Arc<Case>, subject: Subject, compute: ComputeSettings) {
        let (asked, job) = (Asked::usual(kind, case, subject, compute), self.job(case, compute));
        stop(self.studies[kind as usize].replace(Arc::clone(&job.control)));
        self.last_reported[kind as usize] = Some((Instant::now(), Progress::default()));
        let tell = move |job: &Job, result| job.send(News::Studied { kind, compute, result });
        let answer = move |job: &Job| asked.answer(&job.case, &job.control);
        match thread_pool(self.threads) {
            Ok(pool) => pool.spawn(move || tell(&job, catch_panic(|| answer(&job)))),
            Err(none) => tell(&job, Err(none)),
        }
    }

    /// Ends a study without a result.
    pub fn cancel(&mut self, kind: StudyKind) {
        stop(self.studies[kind as usize].take());
    }

    /// News since the last call. A job that was replaced or cancelled has none.
    pub fn news(&mut self) -> Vec<News> {
        let mut news = Vec::new();
        if let Some(control) = &self.judging {
            let (done, announced) = control.counts();
            let runs = Runs { done, announced };
            // The counts come first: the receiver expects the further pieces of each option beyond these counts.
            news.extend((runs != self.last_judged).then_some(News::Judging(runs)));
            self.last_judged = runs;
        }
        for (_, item) in self.receiver.try_iter().filter(|(job, _)| !job.stopped()) {
            if let News::Studied { kind, .. } = item {
                self.studies[kind as usize] = None;
            }
            news.push(item);
        }
        for kind in StudyKind::ALL {
            let Some(control) = &self.studies[kind as usize] else { continue };
            let Some((begun, last)) = &mut self.last_reported[kind as usize] else { continue };
            let progress = control.progress();
            if *last != progress {
                let left = progress.time_left(begun.elapsed(), control.computed_share());
                *last = progress.clone();
                news.push(News::Studying { kind, at: StudyAt { progress, left } });
            }
        }
        news
    }

    fn job(&self, case: &Arc<Case>, compute: ComputeSettings) -> Job {
        let (case, sender) = (Arc::clone(case), self.sender.clone());
        Job { case, compute, control: Arc::default(), sender }
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        stop(self.judging.take());
        StudyKind::ALL.into_iter().for_each(|kind| self.cancel(kind));
    }
}

fn stop(job: Option<Arc<StudyControl>>) {
    job.iter().for_each(|control| control.stop());
}

impl Job {
    fn context(&self) -> Context<'_> {
        Context::new(&self.case, self.compute, &self.control)
    }

    fn send(&self, news: News) {
        // No receiver: the program quits, and nobody waits for the news.
        let _ = self.sender.send((Arc::clone(&self.control), news));
    }
}

#[cfg(test)]
mod tests;
