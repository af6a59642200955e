//! How far a study is, what of it was computed before, and the two ways to end it early.

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
    /// The control of a study whose results are kept in a journal.
    pub fn with_journal(journal: Journal) -> Self {
        Self { journal, ..Self::default() }
    }

    /// The results computed before.
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

    /// Whether the study was told to end without a result.
    pub fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Ends the study within a step, with what was found so far as its result.
    pub fn expire(&self) {
        self.out_of_time.store(true, Ordering::Relaxed);
    }

    /// Whether the time was up.
    pub fn expired(&self) -> bool {
        self.out_of_time.load(Ordering::Relaxed)
    }

    /// Pieces of work done, and those expected as far as is known: a check of a shot, a sample, a launch margin, a minimum of a
    /// fit.
    pub fn counts(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    /// How far the study is.
    pub fn progress(&self) -> Progress {
        self.parts.progress(self.counts())
    }

    /// Share of the pieces done that were computed, not recalled.
    pub fn computed_share(&self) -> f64 {
        let (done, _) = self.counts();
        done.saturating_sub(self.journal.recalled()) as f64 / done.max(1) as f64
    }

    /// Says how many steps the study has: its outermost [parts](Self::part).
    pub fn has_steps(&self, steps: usize) {
        self.parts.has_steps(steps);
    }

    /// A part of the study, which ends when it is dropped; it takes this share of what is left of the part around it.
    #[must_use]
    pub fn part(&self, share_of_rest: f64) -> Part<'_> {
        Part(self.parts.begin(share_of_rest, self.counts()).then_some(self))
    }

    /// A batch, whose jobs have no parts, until it is dropped.
    pub(in crate::study) fn batch(&self) -> Batch<'_> {
        self.parts.begin_batch();
        Batch(self)
    }

    /// Says what is being judged, by name: no verdict on it is known yet.
    pub(in crate::study) fn note_trying(&self, name: String) {
        self.parts.note_trying(name);
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

    /// Whether a run goes on: every run of a study asks at each step, and hands its failure to [`Self::no_result`].
    pub fn keep_going(&self) -> ControlFlow<()> {
        if self.stopped() || self.expired() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Why a run of this study has no result: a run that was ended has no failure of its own.
    pub fn no_result(&self, failure: RunError) -> NoResult {
        match failure {
            RunError::Stopped { .. } if self.stopped() => NoResult::Stopped,
            RunError::Stopped { .. } => NoResult::OutOfTime,
            failure => NoResult::Failed(failure),
        }
    }
}

/// A part of a study under way.
#[derive(Debug)]
pub struct Part<'c>(Option<&'c StudyControl>);

impl Drop for Part<'_> {
    fn drop(&mut self) {
        if let Some(control) = self.0 {
            control.parts.end(control.counts());
        }
    }
}

/// A batch under way.
#[derive(Debug)]
pub(in crate::study) struct Batch<'c>(&'c StudyControl);

impl Drop for Batch<'_> {
    fn drop(&mut self) {
        self.0.parts.end_batch();
    }
}
