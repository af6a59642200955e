//! Control of a study: its progress, its earlier results, and the two ways to end it early.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::Journal;
use super::progress::{Progress, StudyParts};
use crate::simulation::RunError;
use crate::study::NoResult;

/// Progress and end of a study, shared between the threads that compute and the view that shows it.
#[derive(Debug, Default)]
pub struct StudyControl {
    stopped: AtomicBool,
    out_of_time: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
    parts: StudyParts,
    journal: Journal,
}

impl StudyControl {
    /// The control of a study that keeps its results in a journal.
    pub fn with_journal(journal: Journal) -> Self {
        Self { journal, ..Self::default() }
    }

    /// The journal with the results computed before.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }

    /// The journal, once the study has ended.
    pub fn into_journal(self) -> Journal {
        self.journal
    }

    /// Ends the study within a step, without a result.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the study was stopped, without a result.
    pub fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Ends the study within a step. What it found so far becomes its result.
    pub fn expire(&self) {
        self.out_of_time.store(true, Ordering::Relaxed);
    }

    /// Whether the time is up.
    pub fn expired(&self) -> bool {
        self.out_of_time.load(Ordering::Relaxed)
    }

    /// Pieces of work done, and pieces expected as far as known. A piece is a check of a shot, a sample, a launch margin, or a
    /// minimum of a fit.
    pub fn counts(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    /// Progress of the study.
    pub fn progress(&self) -> Progress {
        self.parts.progress(self.counts())
    }

    /// Share of the pieces done that were computed, not recalled.
    pub fn computed_share(&self) -> f64 {
        let (done, _) = self.counts();
        done.saturating_sub(self.journal.recalled()) as f64 / done.max(1) as f64
    }

    /// Sets the number of steps of the study: its outermost [parts](Self::part).
    pub fn has_steps(&self, steps: usize) {
        self.parts.has_steps(steps);
    }

    /// Begins a part of the study. It takes this share of the rest of the part around it, and ends when it is dropped.
    #[must_use]
    pub fn part(&self, share_of_rest: f64) -> Part<'_> {
        Part(self.parts.begin(share_of_rest, self.counts()).then_some(self))
    }

    /// Begins a batch, which ends when it is dropped. Jobs of a batch have no parts.
    pub(in crate::study) fn batch(&self) -> Batch<'_> {
        self.parts.begin_batch();
        Batch(self)
    }

    /// Notes the name of what is being judged. No verdict on it is known yet.
    pub(in crate::study) fn note_trying(&self, name: String) {
        self.parts.note_trying(name);
    }

    /// Notes a trial: its place, and the greatest utilization of its shots.
    pub(in crate::study) fn note_tried(&self, place: f64, share: f64) {
        self.parts.note_tried(place, share);
    }

    /// Notes the sampled shots at a place: their greatest utilization, with the accepted share at the top left out.
    pub(in crate::study) fn note_sampled(&self, place: f64, share: f64) {
        self.parts.note_sampled(place, share);
    }

    /// Notes a result by its score and name. The result with the least score so far is the best.
    pub(in crate::study) fn note_found(&self, score: f64, name: impl FnOnce() -> String) {
        self.parts.note_found(score, name);
    }

    /// Announces `more` pieces of work.
    pub(in crate::study) fn announce(&self, more: usize) {
        self.total.fetch_add(more, Ordering::Relaxed);
    }

    /// Counts one piece of work as done.
    pub(in crate::study) fn advance(&self) {
        self.advance_by(1);
    }

    /// Counts pieces of work as done, or as not needed.
    pub(in crate::study) fn advance_by(&self, pieces: usize) {
        self.done.fetch_add(pieces, Ordering::Relaxed);
    }

    /// Whether a run goes on. Every run of a study asks this at each step, and passes its failure to [`Self::no_result`].
    pub fn keep_going(&self) -> ControlFlow<()> {
        if self.stopped() || self.expired() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Why a run of this study has no result. A run that was ended has no failure of its own.
    pub fn no_result(&self, failure: RunError) -> NoResult {
        match failure {
            RunError::Stopped { .. } if self.stopped() => NoResult::Stopped,
            RunError::Stopped { .. } => NoResult::OutOfTime,
            failure => NoResult::Failed(failure),
        }
    }
}

/// A part of a study in progress.
#[derive(Debug)]
pub struct Part<'c>(Option<&'c StudyControl>);

impl Drop for Part<'_> {
    fn drop(&mut self) {
        if let Some(control) = self.0 {
            control.parts.end(control.counts());
        }
    }
}

/// A batch in progress.
#[derive(Debug)]
pub(in crate::study) struct Batch<'c>(&'c StudyControl);

impl Drop for Batch<'_> {
    fn drop(&mut self) {
        self.0.parts.end_batch();
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::study::Fingerprint;

    #[test]
    fn pieces_are_counted_and_a_part_ends_where_it_is_dropped() {
        let control = StudyControl::default();
        control.announce(8);
        control.advance();
        control.advance_by(2);
        assert_eq!((control.counts(), control.progress().fraction), ((3, 8), 0.375));
        drop(control.part(0.2));
        assert_eq!(control.progress().fraction, 0.5, "a fifth of what was left");
        let batch = control.batch();
        drop(control.part(1.0));
        assert_eq!(control.progress().fraction, 0.5, "a batch has no parts");
        drop(batch);
        control.announce(2);
        control.advance();
        assert_eq!(control.progress().fraction, 0.75, "half of the two new pieces");
        drop(control.part(1.0));
        assert_eq!(control.progress().fraction, 1.0);
        control.note_trying("20 ms".to_owned());
        assert_eq!(control.progress().trying.as_deref(), Some("20 ms"));
    }

    /// The progress reports what a study notes. Of equal scores the first is the best. No more points are kept than are drawn.
    #[test]
    fn what_a_study_says_is_told() {
        let control = StudyControl::default();
        control.has_steps(3);
        let _step = control.part(0.5);
        for (score, name) in [(0.9, "a"), (0.8, "b"), (0.8, "c"), (f64::NAN, "d")] {
            control.note_found(score, || name.to_owned());
        }
        (0..10_001).for_each(|place| control.note_tried(f64::from(place), 0.5));
        control.note_sampled(7.0, 0.25);
        let progress = control.progress();
        assert_eq!((progress.step, progress.steps, progress.best.as_deref()), (1, 3, Some("b")));
        assert_eq!((progress.tried.len(), progress.tried[7]), (10_000, (7.0, 0.5)));
        assert_eq!(progress.sampled, [(7.0, 0.25)]);
    }

    /// A run that was ended has no failure of its own: either the study was stopped, or its time was up. Any other failure stays.
    #[test]
    fn a_run_goes_on_until_its_study_ends() {
        let [runs, stopped, expired] = [(); 3].map(|()| StudyControl::default());
        stopped.stop();
        expired.expire();
        let goes_on = |control: &StudyControl| control.keep_going().is_continue();
        assert_eq!([&runs, &stopped, &expired].map(goes_on), [true, false, false]);
        assert_eq!((stopped.stopped(), expired.stopped()), (true, false));
        let cut = RunError::Stopped { time: 0.5 };
        assert_eq!(stopped.no_result(cut.clone()), NoResult::Stopped);
        assert_eq!(expired.no_result(cut), NoResult::OutOfTime);
    }

    /// Of four pieces done, one was known before.
    #[test]
    fn what_was_recalled_was_not_computed() {
        let known = HashMap::from([(Fingerprint::of(1), Box::from("7"))]);
        let control = StudyControl::with_journal(Journal::of_known(known));
        assert_eq!(control.computed_share(), 0.0);
        let results = [1, 2, 3, 4].map(|n| {
            control.advance();
            control.journal().recall_or(|| Fingerprint::of(n), || Ok(n))
        });
        assert_eq!(results, [Ok(7), Ok(2), Ok(3), Ok(4)]);
        assert_eq!((control.computed_share(), control.into_journal().recalled()), (0.75, 1));
    }
}
