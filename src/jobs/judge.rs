//! Verdicts in the background: whatever becomes known of each option is news.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use super::{Job, News};
use crate::study::assumptions::{self, Extent, find_assumptions};
use crate::study::course_band::CourseBand;
use crate::study::judge::batch::{CaseOption, Depth, JudgeEvent, judge_rest};
use crate::study::judge::deciding_shot::{DecidingSamples, DecidingShots};
use crate::study::judge::recommend::recommended;
use crate::study::judge::{Judgement, OptionResults, Part};
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::SAMPLES_FOR_BANDS;
use crate::study::study_trait::Study;
use crate::study::{NoResult, catch_panic};
use crate::verdict::Verdict;

/// Least time between two pieces of news about an option that computes.
const CHECKING_EVERY: Duration = Duration::from_millis(50);
/// Least time between two pieces of news about the samples of an option.
const SAMPLED_EVERY: Duration = Duration::from_millis(100);

/// Times of the last news of an option, about its computation and about its samples, and the samples that decided then.
#[derive(Clone, Copy)]
struct LastSent {
    checking: Instant,
    sampled: Option<Instant>,
    deciding: Option<DecidingSamples>,
}

impl Job {
    /// Judges all options, as far as they are not `known` from before: the planned shot, then samples, then launch margins, then
    /// fresh draws. Then finds whether the options that pass are thin, the recommended option first, and the assumptions on which
    /// they stand.
    pub(super) fn judge(&self, known: &[Option<Judgement>], depth: Depth) {
        let contexts = [self.context().with_sampling(Sampling::OF_VERDICT)];
        let new = LastSent { checking: Instant::now(), sampled: None, deciding: None };
        let last_sent: Vec<Mutex<LastSent>> = self.case.shots.iter().map(|_| Mutex::new(new)).collect();
        let watch = |at: CaseOption, event: JudgeEvent<'_>| {
            let option = at.option;
            let Ok(mut last) = last_sent[option].lock() else { return };
            match event {
                JudgeEvent::Checking(progress) => {
                    if last.checking.elapsed() > CHECKING_EVERY {
                        last.checking = Instant::now();
                        self.send(News::Checking { option, runs: progress.runs, time: progress.time });
                    }
                }
                JudgeEvent::Checked(result) => {
                    self.send(News::Checked { option, result: result.clone().map(Box::new) });
                }
                JudgeEvent::Found(part @ Part::Samples { sampled, more }) => {
                    let is_enough = sampled.samples.len() >= SAMPLES_FOR_BANDS;
                    let deciding =
                        DecidingSamples::of(sampled, Sampling::OF_VERDICT.seed).filter(|_| is_enough);
                    let changes = deciding != last.deciding;
                    if !more || changes || last.sampled.is_none_or(|told| told.elapsed() >= SAMPLED_EVERY) {
                        last.sampled = Some(Instant::now());
                        self.send(News::Found { option, part: part.clone() });
                    }
                    // The judgement itself runs the last deciding samples.
                    if let Some(samples) = deciding.filter(|_| changes && *more) {
                        last.deciding = deciding;
                        self.begin_deciding(option, samples);
                    }
                }
                JudgeEvent::Found(part) => self.send(News::Found { option, part: part.clone() }),
            }
        };
        let judged = catch_panic(|| judge_rest(&contexts, depth, known, Some(&watch)));
        match judged {
            Err(none) => self.tell_no_result(&none),
            Ok(judged) => judged.value.iter().for_each(|results| {
                let passes = |option: &usize| {
                    results[*option].as_ref().is_ok_and(|judged| judged.verdict() == Verdict::Pass)
                };
                let best = recommended(&self.case, results);
                let others = (0..results.len()).filter(|option| Some(*option) != best).filter(passes);
                let passing: Vec<usize> = best.into_iter().chain(others).collect();
                // Everyone waits for the answer whether a verdict is final, so this comes first.
                passing.iter().for_each(|option| self.find_assumptions(*option, Extent::Thin));
                self.find_bands(results);
                passing.iter().for_each(|option| self.find_assumptions(*option, Extent::Nearest));
            }),
        }
    }

    /// Begins to run the samples that decide an option so far, while more samples come. The runs go between the samples, and nobody
    /// waits for them.
    fn begin_deciding(&self, option: usize, samples: DecidingSamples) {
        let (case, control, sender) = (self.case.clone(), self.control.clone(), self.sender.clone());
        let job = Self { case, control, sender, ..*self };
        rayon::spawn(move || {
            let run = || DecidingShots::run(&job.context(), option, samples);
            // The verdict stands without this run.
            if let Ok(run) = catch_panic(run) {
                job.send(News::Found { option, part: Part::Deciding(Box::new(run)) });
            }
        });
    }

    /// Finds the band over time in which the samples of each option lie.
    fn find_bands(&self, results: &OptionResults) {
        let sampled = results.iter().map(|judged| judged.as_ref().ok()?.sampled.known());
        for (option, sampled) in sampled.enumerate() {
            let Some(sampled) = sampled else { continue };
            let find = || CourseBand::find(&self.context(), option, sampled, Sampling::OF_VERDICT.seed);
            if let Ok(Some(band)) = catch_panic(find) {
                self.send(News::Band { option, band: Box::new(band) });
            }
        }
    }

    /// Finds the assumptions on which the pass of an option stands, or whether the pass is thin. The verdict stands without them.
    fn find_assumptions(&self, option: usize, extent: Extent) {
        let context = self.context().with_sampling(assumptions::Question::SAMPLING);
        let find = || find_assumptions(&context, option, extent);
        // A partial answer says nothing: a value that nobody tried would pass.
        if let Ok(found) = catch_panic(find)
            && !found.partial
        {
            self.send(News::Assumptions { option, found: Box::new(found.value) });
        }
    }

    /// Reports that no option has a result. Nobody reads the news of a stopped job.
    pub(super) fn tell_no_result(&self, none: &NoResult) {
        for option in 0..self.case.shots.len() {
            self.send(News::Checked { option, result: Err(none.clone()) });
        }
    }
}
