//! Checks and studies in the background: requests come in, news goes out.
//!
//! At most one job of each kind runs: a new request ends the old job of its kind. A job ends within one step of a run.
//! The work is the same functions that the commands call; the results do not depend on the number of threads. A panic is
//! the result [`NoResult::Panicked`] of the option or study that panicked.

mod check;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

use crate::study::check::Checked;
use crate::study::check_all::{OptionResults, check_all};
use crate::study::effects::{EffectsOnOptions, SAMPLES, effects};
use crate::study::flight::{Flight, record};
use crate::study::margin::LaunchMargin;
use crate::study::orders::{Orders, orders, rank};
use crate::study::risk::Risk;
use crate::study::sampling::Sampling;
use crate::study::size::{Demand, Sizing, size};
use crate::study::sweep::{GAP, Sweep, sweep};
use crate::study::{
    Case, ComputeSettings, Intervals, NoResult, Progress, Shard, accuracy, guarded, thread_pool,
};

/// Declares the kinds of studies and the list of all of them, in one order.
macro_rules! study_kinds {
    ($( $(#[$about:meta])* $kind:ident, )+) => {
        /// A study that the terminal offers.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum StudyKind {
            $( $(#[$about])* $kind, )+
        }

        impl StudyKind {
            /// Every kind, in the order of declaration.
            pub const ALL: [StudyKind; [$(StudyKind::$kind),+].len()] = [$(StudyKind::$kind),+];
        }
    };
}

study_kinds! {
    /// Intervals from 0 to 500 ms, rows in the order listed.
    Sweep,
    /// All orders at the intervals of the delay options.
    Orders,
    /// Two thousand samples of every option.
    Risk,
    /// The lightest shelter under which every option passes.
    Size,
    /// Which effects the scene requires.
    Effects,
    /// The motion of one option.
    Flight,
    /// The cost of accuracy, measured on one option.
    Accuracy,
}

impl StudyKind {
    /// The kinds that answer a question about the whole plan, in the order of their tabs.
    pub const OF_PLAN: [StudyKind; 5] =
        [StudyKind::Sweep, StudyKind::Orders, StudyKind::Risk, StudyKind::Size, StudyKind::Effects];
}

/// Result of a study.
#[derive(Clone, Debug)]
pub enum StudyResult {
    /// Result of [`StudyKind::Sweep`].
    Sweep(Sweep),
    /// Result of [`StudyKind::Orders`].
    Orders(Orders),
    /// Result of [`StudyKind::Risk`].
    Risk(Sampling, OptionResults),
    /// Result of [`StudyKind::Size`].
    Size(Sizing),
    /// Result of [`StudyKind::Effects`].
    Effects(EffectsOnOptions),
    /// Result of [`StudyKind::Flight`].
    Flight(Flight),
    /// Result of [`StudyKind::Accuracy`].
    Accuracy(accuracy::AccuracyTable),
}

/// News of a job.
#[derive(Debug)]
pub enum News {
    /// An option computes.
    Checking {
        /// Index of the option.
        option: usize,
        /// Runs finished.
        runs: usize,
        /// Time that the present run has reached [s].
        time: f64,
    },
    /// An option is judged as planned, or has no result.
    Checked {
        /// Index of the option.
        option: usize,
        /// Its result.
        result: Result<Box<Checked>, NoResult>,
    },
    /// Samples of an option that is judged as planned.
    Sampled {
        /// Index of the option.
        option: usize,
        /// All its samples so far.
        result: Result<Box<Risk>, NoResult>,
        /// Whether more samples come.
        more: bool,
    },
    /// How much faster than planned the tires may leave.
    Margin {
        /// Index of the option.
        option: usize,
        /// The margin.
        margin: LaunchMargin,
    },
    /// A study computes.
    Studying {
        /// Which study.
        kind: StudyKind,
        /// Shots judged.
        done: usize,
        /// Shots expected, as far as is known.
        total: usize,
    },
    /// A study has ended by itself.
    Studied {
        /// Which study.
        kind: StudyKind,
        /// The settings it computed with.
        compute: ComputeSettings,
        /// Its result.
        result: Result<Box<StudyResult>, NoResult>,
    },
}

/// Samples of every option.
const SAMPLING: Sampling = Sampling::OF_RISK;
/// Samples of a study of effects.
const EFFECTS: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_RISK.seed);
/// Intervals swept [s].
const INTERVALS: Intervals = Intervals { from: 0.0, to: 0.5, step: GAP };
/// Longest run that [`StudyKind::Accuracy`] makes.
const LONGEST_RUN: Duration = Duration::from_secs(1);

/// The jobs under way.
pub struct Jobs {
    threads: usize,
    check: Option<Arc<Progress>>,
    studies: [Option<Arc<Progress>>; StudyKind::ALL.len()],
    /// Shots judged and expected of each study, as told last.
    told: [(usize, usize); StudyKind::ALL.len()],
    sender: Sender<(Arc<Progress>, News)>,
    receiver: Receiver<(Arc<Progress>, News)>,
}

/// What the work of one job needs.
struct Job {
    case: Arc<Case>,
    compute: ComputeSettings,
    progress: Arc<Progress>,
    sender: Sender<(Arc<Progress>, News)>,
}

impl Jobs {
    /// No job yet. Each job will use `threads` threads; 0: one per core.
    pub fn new(threads: usize) -> Self {
        let cores = || thread::available_parallelism().map_or(1, usize::from);
        let threads = if threads == 0 { cores() } else { threads };
        let (sender, receiver) = channel();
        let (studies, told) = Default::default();
        Self { threads, check: None, studies, told, sender, receiver }
    }

    /// Checks every option of `case`: first as planned, then by samples, then for its launch margin. Each result is news by
    /// itself.
    pub fn check(&mut self, case: &Arc<Case>, compute: ComputeSettings) {
        let job = self.job(case, compute);
        end(self.check.replace(Arc::clone(&job.progress)));
        let options = 0..case.shots.len();
        match thread_pool(self.threads) {
            Ok(pool) => pool.spawn(move || job.check_all(options)),
            Err(none) => options.for_each(|option| {
                job.tell(News::Checked { option, result: Err(none.clone()) });
            }),
        }
    }

    /// Begins a study; `option` is the option of a study of one option.
    pub fn study(&mut self, kind: StudyKind, case: &Arc<Case>, option: usize, compute: ComputeSettings) {
        let job = self.job(case, compute);
        end(self.studies[kind as usize].replace(Arc::clone(&job.progress)));
        self.told[kind as usize] = (0, 0);
        let tell = move |job: &Job, result| job.tell(News::Studied { kind, compute, result });
        match thread_pool(self.threads) {
            Ok(pool) => pool.spawn(move || tell(&job, guarded(|| job.study(kind, option).map(Box::new)))),
            Err(none) => tell(&job, Err(none)),
        }
    }

    /// Ends a study without a result.
    pub fn cancel(&mut self, kind: StudyKind) {
        end(self.studies[kind as usize].take());
    }

    /// News since the last call; a job that was replaced or cancelled has none.
    pub fn news(&mut self) -> Vec<News> {
        let mut news = Vec::new();
        for (_, told) in self.receiver.try_iter().filter(|(job, _)| !job.stopped()) {
            if let News::Studied { kind, .. } = told {
                self.studies[kind as usize] = None;
            }
            news.push(told);
        }
        for kind in StudyKind::ALL {
            let Some(progress) = &self.studies[kind as usize] else { continue };
            let (done, total) = progress.counts();
            if std::mem::replace(&mut self.told[kind as usize], (done, total)) != (done, total) {
                news.push(News::Studying { kind, done, total });
            }
        }
        news
    }

    fn job(&self, case: &Arc<Case>, compute: ComputeSettings) -> Job {
        Job { case: Arc::clone(case), compute, progress: Arc::default(), sender: self.sender.clone() }
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        end(self.check.take());
        StudyKind::ALL.into_iter().for_each(|kind| self.cancel(kind));
    }
}

fn end(job: Option<Arc<Progress>>) {
    job.iter().for_each(|progress| progress.stop());
}

impl Job {
    fn tell(&self, news: News) {
        // No receiver: the program quits, and nobody waits for the news.
        let _ = self.sender.send((Arc::clone(&self.progress), news));
    }

    fn study(&self, kind: StudyKind, option: usize) -> Result<StudyResult, NoResult> {
        let Self { case, compute, progress, .. } = self;
        match kind {
            StudyKind::Sweep => {
                let order: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
                Ok(StudyResult::Sweep(
                    sweep(case, &order, &INTERVALS, Some(&Sampling::OF_VERDICT), compute, progress)?.value,
                ))
            }
            StudyKind::Orders => {
                let intervals = case.intervals();
                let tried = orders(case, &intervals, Shard::WHOLE, compute, progress)?;
                let sampling = Some(&Sampling::OF_VERDICT);
                let ranked = rank(case, tried, intervals.len(), sampling, compute, progress)?;
                Ok(StudyResult::Orders(ranked.value))
            }
            StudyKind::Risk => {
                let mut results = check_all(&[(case, *compute)], Some(&SAMPLING), progress)?.value;
                Ok(StudyResult::Risk(SAMPLING, results.remove(0)))
            }
            StudyKind::Size => {
                let demand = Demand::Options((0..case.shots.len()).collect());
                Ok(StudyResult::Size(
                    size(&case.plan, &demand, Some(&Sampling::OF_VERDICT), compute, progress)?.value,
                ))
            }
            StudyKind::Effects => Ok(StudyResult::Effects(effects(case, &EFFECTS, compute, progress)?.value)),
            StudyKind::Flight => record(case, option, compute, progress).map(StudyResult::Flight),
            StudyKind::Accuracy => {
                Ok(StudyResult::Accuracy(accuracy::measure(case, option, LONGEST_RUN, progress)?.value))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;
    use crate::plan::PlanSource;

    const STUDY: StudyKind = StudyKind::Orders;

    fn case() -> Arc<Case> {
        let text = include_str!("../plans/amur-three-rows.toml").to_owned();
        let case = Case::parse(PlanSource { path: String::new(), text });
        Arc::new(case.unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    fn coarse(case: &Case) -> ComputeSettings {
        ComputeSettings { step: Some(1e-3), ..ComputeSettings::of(&case.plan) }
    }

    /// Settings that make a run last for minutes.
    fn endless(case: &Case) -> ComputeSettings {
        ComputeSettings { step: Some(1e-9), ..ComputeSettings::of(&case.plan) }
    }

    /// Calls `look` until there is a value.
    fn wait<T>(mut look: impl FnMut() -> Option<T>) -> T {
        let begun = Instant::now();
        loop {
            if let Some(found) = look() {
                return found;
            }
            assert!(begun.elapsed() < Duration::from_secs(60), "nothing came");
            thread::sleep(Duration::from_millis(5));
        }
    }

    /// Results of every option, by option.
    fn checked(jobs: &mut Jobs, options: usize) -> Vec<Result<Box<Checked>, NoResult>> {
        let mut results = Vec::new();
        wait(|| {
            for news in jobs.news() {
                if let News::Checked { option, result } = news {
                    results.push((option, result));
                }
            }
            (results.len() == options).then_some(())
        });
        results.sort_by_key(|(option, _)| *option);
        results.into_iter().map(|(_, result)| result).collect()
    }

    /// Samples and launch margins of every option, by option.
    fn sampled(jobs: &mut Jobs, options: usize) -> Vec<(Result<Box<Risk>, NoResult>, LaunchMargin)> {
        let (mut risks, mut margins) = (vec![None; options], vec![None; options]);
        wait(|| {
            for news in jobs.news() {
                match news {
                    News::Sampled { option, result, more: false } => risks[option] = Some(result),
                    News::Margin { option, margin } => margins[option] = Some(margin),
                    _ => {}
                }
            }
            margins.iter().all(Option::is_some).then_some(())
        });
        risks.into_iter().zip(margins).filter_map(|(risk, margin)| Some((risk?, margin?))).collect()
    }

    #[test]
    fn results_do_not_depend_on_the_number_of_threads() {
        let case = case();
        let options = case.shots.len();
        let values = |threads| {
            let mut jobs = Jobs::new(threads);
            jobs.check(&case, coarse(&case));
            let results = checked(&mut jobs, options);
            let values = results.into_iter().map(|result| result.map(|c| (c.height, c.force)));
            (values.collect::<Vec<_>>(), sampled(&mut jobs, options))
        };
        let (few, many) = (values(1), values(3));
        assert_eq!(few, many);
        assert!(few.1.iter().all(|(risk, _)| risk.as_ref().is_ok_and(|risk| risk.samples.len() >= 200)));
    }

    #[test]
    fn a_new_request_ends_sampling() {
        let (case, mut jobs) = (case(), Jobs::new(2));
        // Hundreds of samples of each option at this step would take minutes.
        jobs.check(&case, ComputeSettings { step: Some(5e-5), ..coarse(&case) });
        checked(&mut jobs, case.shots.len());
        let progress = jobs.check.clone().expect("under way");
        jobs.check(&case, coarse(&case));
        let begun = Instant::now();
        wait(|| {
            jobs.news();
            (Arc::strong_count(&progress) == 1).then_some(())
        });
        assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    }

    #[test]
    fn the_newest_request_of_a_kind_wins() {
        let (case, mut jobs) = (case(), Jobs::new(2));
        jobs.check(&case, endless(&case));
        jobs.study(STUDY, &case, 0, endless(&case));
        jobs.check(&case, coarse(&case));
        jobs.study(STUDY, &case, 0, coarse(&case));
        let (mut options, mut studies) = (Vec::new(), Vec::new());
        wait(|| {
            for news in jobs.news() {
                match news {
                    News::Checked { option, result } => {
                        options.push((option, result.expect("a result").compute))
                    }
                    News::Studied { compute, result, .. } => studies.push((compute, result.is_ok())),
                    News::Checking { .. }
                    | News::Sampled { .. }
                    | News::Margin { .. }
                    | News::Studying { .. } => {}
                }
            }
            (options.len() == case.shots.len() && !studies.is_empty()).then_some(())
        });
        assert!(options.iter().all(|(_, compute)| *compute == coarse(&case)));
        assert_eq!(studies, [(coarse(&case), true)]);
    }

    #[test]
    fn a_cancelled_study_ends_within_a_step_and_has_no_news() {
        let (case, mut jobs) = (case(), Jobs::new(1));
        jobs.study(STUDY, &case, 0, endless(&case));
        wait(|| {
            jobs.news().into_iter().find(|news| matches!(news, News::Studying { done: 0, total: 1.., .. }))
        });
        let progress = jobs.studies[STUDY as usize].clone().expect("under way");
        jobs.cancel(STUDY);
        // The work and its news hold the progress; once both are gone, the test alone does.
        wait(|| {
            assert!(jobs.news().is_empty());
            (Arc::strong_count(&progress) == 1).then_some(())
        });
    }

    #[test]
    fn a_panic_is_the_result_of_its_option_or_study_alone() {
        let (good, mut jobs) = (case(), Jobs::new(2));
        let mut bad = (*good).clone();
        bad.shots[1].firings[0].tire = usize::MAX;
        jobs.check(&Arc::new(bad), coarse(&good));
        let results = checked(&mut jobs, good.shots.len());
        for (option, result) in results.iter().enumerate() {
            assert_eq!(matches!(result, Err(NoResult::Panicked(_))), option == 1, "{option}");
        }
        jobs.study(StudyKind::Flight, &good, usize::MAX, coarse(&good));
        let told = wait(|| jobs.news().pop());
        assert!(matches!(told, News::Studied { result: Err(NoResult::Panicked(_)), .. }), "{told:?}");
    }

    #[test]
    fn dropping_the_runner_ends_every_job() {
        let (case, mut jobs) = (case(), Jobs::new(1));
        jobs.check(&case, endless(&case));
        StudyKind::ALL.into_iter().for_each(|kind| jobs.study(kind, &case, 0, endless(&case)));
        let all: Vec<_> = jobs.studies.iter().chain([&jobs.check]).flatten().cloned().collect();
        assert_eq!(all.len(), 1 + StudyKind::ALL.len());
        drop(jobs);
        wait(|| all.iter().all(|progress| Arc::strong_count(progress) == 1).then_some(()));
    }
}
