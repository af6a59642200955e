//! How far a study is: a fraction that never decreases, the step it is at, and what is being judged.
//!
//! A study is made of parts, one after the other, and a part of smaller parts. Each part takes a share of what is left of the part
//! around it, so that a loop whose number of rounds nobody knows has a fraction, too. Within a part the fraction follows the pieces
//! of work done of those announced there. A part that ends early leaps to its end.
//!
//! Parts follow one another on one thread. Work inside a batch has no parts: there the pieces alone count.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How far a study is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// Share of the work done, from 0 to 1.
    pub fraction: f64,
    /// The step it is at, from 1; 0 where the study has no steps.
    pub step: usize,
    /// Number of its steps.
    pub steps: usize,
    /// What is being judged, by name.
    pub trying: Option<String>,
    /// The best found so far, by name: nothing is proven of it.
    pub best: Option<String>,
    /// What was tried, as far as it is drawn: its place, in the unit of the study, and the share of a limit that its shots use at most.
    pub tried: Vec<(f64, f64)>,
    /// The same of possible shots, where they are told apart: the share that all but the accepted share of those at a place use at most.
    pub sampled: Vec<(f64, f64)>,
}

impl Progress {
    /// Time left of the whole study, from the pace so far; `computed` is the share of what is done that was computed in the `elapsed`
    /// time. `None` while too little is done to tell.
    pub fn time_left(&self, elapsed: Duration, computed: f64) -> Option<Duration> {
        let known = elapsed > WATCHED && self.fraction * computed > LEAST_KNOWN;
        known.then(|| elapsed.mul_f64((1.0 - self.fraction) / (self.fraction * computed)))
    }
}

/// Time that a study runs, and share of it that is done, before the time left is told.
const WATCHED: Duration = Duration::from_millis(500);
const LEAST_KNOWN: f64 = 0.01;

/// Most points of what was tried: more would not be told apart.
const MOST_DRAWN: usize = 10_000;

/// Pieces of work done and announced since a study began.
pub type Counts = (usize, usize);

/// A part of a study: from which fraction to which, and the counts at which its pieces began.
#[derive(Clone, Copy, Debug)]
struct Range {
    from: f64,
    to: f64,
    since: Counts,
}

#[derive(Debug)]
struct Parts {
    /// From the whole study to the part that it is at.
    nested: Vec<Range>,
    /// The greatest fraction shown: none lower follows.
    shown: f64,
    step: usize,
    steps: usize,
    /// Batches under way.
    batches: usize,
    trying: Option<String>,
    best: Option<(f64, String)>,
    tried: Vec<(f64, f64)>,
    sampled: Vec<(f64, f64)>,
}

/// The parts of a study under way.
#[derive(Debug)]
pub struct StudyParts(Mutex<Parts>);

impl Default for StudyParts {
    fn default() -> Self {
        let nested = vec![Range { from: 0.0, to: 1.0, since: (0, 0) }];
        Self(Mutex::new(Parts {
            nested,
            shown: 0.0,
            step: 0,
            steps: 0,
            batches: 0,
            trying: None,
            best: None,
            tried: Vec::new(),
            sampled: Vec::new(),
        }))
    }
}

impl StudyParts {
    fn lock(&self) -> MutexGuard<'_, Parts> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How far the study is at these counts.
    pub fn progress(&self, counts: Counts) -> Progress {
        let mut parts = self.lock();
        let fraction = parts.fraction(counts);
        Progress {
            fraction,
            step: parts.step,
            steps: parts.steps,
            trying: parts.trying.clone(),
            best: parts.best.as_ref().map(|(_, name)| name.clone()),
            tried: parts.tried.clone(),
            sampled: parts.sampled.clone(),
        }
    }

    /// Says how many steps the study has: its outermost parts. A study inside another has none of its own.
    pub fn has_steps(&self, steps: usize) {
        let mut parts = self.lock();
        if parts.nested.len() == 1 && parts.steps == 0 {
            parts.steps = steps;
        }
    }

    /// Says what is being judged, by name.
    pub fn note_trying(&self, name: String) {
        self.lock().trying = Some(name);
    }

    /// Says what was tried: its place, and the share of a limit that its shots use at most.
    pub fn note_tried(&self, place: f64, share: f64) {
        let mut parts = self.lock();
        if share.is_finite() && parts.tried.len() < MOST_DRAWN {
            parts.tried.push((place, share));
        }
    }

    /// Says of the shots that were drawn at a place how much of a limit all but the accepted share of them use at most, infinite where
    /// too many are undecided, or break cables: what was said of it before no longer counts.
    pub fn note_sampled(&self, place: f64, share: f64) {
        let mut parts = self.lock();
        parts.sampled.retain(|(known, _)| *known != place);
        parts.sampled.push((place, share));
    }

    /// Says what was found, by name: the least score so far is the best.
    pub fn note_found(&self, score: f64, name: impl FnOnce() -> String) {
        let mut parts = self.lock();
        if score.is_finite() && parts.best.as_ref().is_none_or(|(least, _)| score < *least) {
            parts.best = Some((score, name()));
        }
    }

    /// Begins a part that takes this share of what is left. Returns whether there is one: not inside a batch.
    pub fn begin(&self, share_of_rest: f64, counts: Counts) -> bool {
        let mut parts = self.lock();
        if parts.batches > 0 {
            return false;
        }
        let from = parts.fraction(counts);
        let end = parts.nested.last().map_or(1.0, |around| around.to);
        let to = from + share_of_rest.clamp(0.0, 1.0) * (end - from);
        if parts.nested.len() == 1 {
            parts.step = (parts.step + 1).min(parts.steps);
        }
        parts.nested.push(Range { from, to, since: counts });
        true
    }

    /// Ends the part begun last.
    pub fn end(&self, counts: Counts) {
        let mut parts = self.lock();
        let Some(ended) = parts.nested.pop() else { return };
        parts.shown = parts.shown.max(ended.to);
        if let Some(around) = parts.nested.last_mut() {
            (around.from, around.since) = (ended.to, counts);
        }
    }

    /// Begins a batch: until it ends there are no new parts.
    pub fn begin_batch(&self) {
        self.lock().batches += 1;
    }

    /// Ends a batch.
    pub fn end_batch(&self) {
        self.lock().batches -= 1;
    }
}

impl Parts {
    fn fraction(&mut self, (done, total): Counts) -> f64 {
        if let Some(part) = self.nested.last() {
            let [done, total] = [done.saturating_sub(part.since.0), total.saturating_sub(part.since.1)];
            let share = if total == 0 { 0.0 } else { (done as f64 / total as f64).min(1.0) };
            self.shown = self.shown.max(part.from + share * (part.to - part.from));
        }
        self.shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fraction(parts: &StudyParts, counts: Counts) -> f64 {
        (1e3 * parts.progress(counts).fraction).round() / 1e3
    }

    #[test]
    fn parts_share_what_is_left_and_never_go_back() {
        let parts = StudyParts::default();
        parts.has_steps(2);
        assert!(parts.begin(0.4, (0, 0)));
        parts.has_steps(9);
        assert_eq!(
            (parts.progress((0, 0)).step, parts.progress((0, 0)).steps),
            (1, 2),
            "a study inside another"
        );
        assert_eq!(fraction(&parts, (5, 10)), 0.2);
        assert_eq!(fraction(&parts, (5, 1000)), 0.2, "more work is announced");
        parts.end((5, 1000));
        assert_eq!(fraction(&parts, (5, 1000)), 0.4);
        assert!(parts.begin(1.0, (5, 1000)));
        for expected in [0.7, 0.85] {
            assert!(parts.begin(0.5, (5, 1000)));
            parts.end((5, 1000));
            assert_eq!(fraction(&parts, (5, 1000)), expected);
        }
        let progress = parts.progress((5, 1000));
        assert_eq!((progress.step, progress.steps), (2, 2), "rounds inside a step are no steps");
        parts.begin_batch();
        assert!(!parts.begin(1.0, (5, 1000)), "a batch has no parts");
        parts.end_batch();
        assert!(parts.begin(0.5, (5, 1000)), "the batch has ended");
        parts.end((5, 1000));
        parts.end((5, 1000));
        assert_eq!(fraction(&parts, (5, 1000)), 1.0);
        parts.has_steps(9);
        assert_eq!(parts.progress((5, 1000)).steps, 2, "the first that has steps");
        parts.note_trying("20 ms".to_owned());
        assert_eq!(parts.progress((5, 1000)).trying.as_deref(), Some("20 ms"));
        for (score, name) in [(0.7, "9 ms"), (0.4, "42 ms"), (0.5, "20 ms"), (f64::NAN, "25 ms")] {
            parts.note_tried(score, score);
            parts.note_found(score, || name.to_owned());
        }
        for share in [0.9, 0.8] {
            parts.note_sampled(0.042, share);
        }
        let progress = parts.progress((5, 1000));
        assert_eq!(progress.sampled, [(0.042, 0.8)], "more shots at a place");
        assert_eq!(
            (progress.best.as_deref(), progress.tried.len()),
            (Some("42 ms"), 3),
            "a run that failed is none"
        );
    }

    #[test]
    fn the_time_left_is_of_the_whole_study() {
        let progress = Progress { fraction: 0.25, ..Progress::default() };
        assert_eq!(progress.time_left(Duration::from_secs(3), 1.0), Some(Duration::from_secs(9)));
        assert_eq!(progress.time_left(Duration::from_secs(3), 0.5), Some(Duration::from_secs(18)));
        assert_eq!(progress.time_left(Duration::ZERO, 1.0), None);
        assert_eq!(progress.time_left(Duration::from_secs(3), 0.02), None, "0.5 % is too little to tell");
    }
}
