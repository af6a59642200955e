//! Progress of a study: a fraction that never decreases, the present step, and what is being judged.
//!
//! A study consists of parts, one after the other, and a part consists of smaller parts. Each part takes a share of the rest of the
//! part around it. So even a loop with an unknown number of rounds has a fraction. Within a part the fraction is the share of the
//! pieces of work announced there that are done. A part that ends early jumps to its end.
//!
//! Parts follow one another on one thread. Work inside a batch has no parts: only its pieces count.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Progress of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    /// Share of the work done, from 0 to 1.
    pub fraction: f64,
    /// The present step, from 1; 0 if the study has no steps.
    pub step: usize,
    /// Number of steps.
    pub steps: usize,
    /// Name of what is being judged.
    pub trying: Option<String>,
    /// Name of the best result so far. Nothing about it is proven.
    pub best: Option<String>,
    /// Trials to draw: the place of each, in the unit of the study, and the greatest utilization of its shots.
    pub tried: Vec<(f64, f64)>,
    /// The same for sampled shots, if the study tells them apart: their greatest utilization at a place, with the accepted share at
    /// the top left out.
    pub sampled: Vec<(f64, f64)>,
}

impl Progress {
    /// Time left of the whole study, from the pace so far. `computed` is the share of the work done that was computed in the
    /// `elapsed` time. `None` while too little is done for an estimate.
    pub fn time_left(&self, elapsed: Duration, computed: f64) -> Option<Duration> {
        let known = elapsed > WATCHED && self.fraction * computed > LEAST_KNOWN;
        known.then(|| elapsed.mul_f64((1.0 - self.fraction) / (self.fraction * computed)))
    }
}

/// Least running time of a study, and least share done, before the time left is reported.
const WATCHED: Duration = Duration::from_millis(500);
const LEAST_KNOWN: f64 = 0.01;

/// Greatest number of trials to draw. More points could not be told apart.
const MOST_DRAWN: usize = 10_000;

/// Pieces of work done and announced since a study began.
pub type Counts = (usize, usize);

/// A part of a study: its first and last fraction, and the counts at which it began.
#[derive(Clone, Copy, Debug)]
struct Range {
    from: f64,
    to: f64,
    since: Counts,
}

#[derive(Debug)]
struct Parts {
    /// Parts, from the whole study down to the present part.
    nested: Vec<Range>,
    /// The greatest fraction shown. No lower fraction follows.
    shown: f64,
    step: usize,
    steps: usize,
    /// Number of batches in progress.
    batches: usize,
    trying: Option<String>,
    best: Option<(f64, String)>,
    tried: Vec<(f64, f64)>,
    sampled: Vec<(f64, f64)>,
}

/// The parts of a study in progress.
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

    /// Progress of the study at these counts.
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

    /// Sets the number of steps of the study: its outermost parts. A study inside another has no steps of its own.
    pub fn has_steps(&self, steps: usize) {
        let mut parts = self.lock();
        if parts.nested.len() == 1 && parts.steps == 0 {
            parts.steps = steps;
        }
    }

    /// Notes the name of what is being judged.
    pub fn note_trying(&self, name: String) {
        self.lock().trying = Some(name);
    }

    /// Notes a trial: its place, and the greatest utilization of its shots.
    pub fn note_tried(&self, place: f64, share: f64) {
        let mut parts = self.lock();
        if share.is_finite() && parts.tried.len() < MOST_DRAWN {
            parts.tried.push((place, share));
        }
    }

    /// Notes the sampled shots at a place: their greatest utilization, with the accepted share at the top left out. It is infinite
    /// if too many are undecided or break cables. This replaces the earlier note at the place.
    pub fn note_sampled(&self, place: f64, share: f64) {
        let mut parts = self.lock();
        parts.sampled.retain(|(known, _)| *known != place);
        parts.sampled.push((place, share));
    }

    /// Notes a result by its score and name. The result with the least score so far is the best.
    pub fn note_found(&self, score: f64, name: impl FnOnce() -> String) {
        let mut parts = self.lock();
        if score.is_finite() && parts.best.as_ref().is_none_or(|(least, _)| score < *least) {
            parts.best = Some((score, name()));
        }
    }

    /// Begins a part that takes this share of the rest. Returns false inside a batch, which has no parts.
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

    /// Ends the part that began last.
    pub fn end(&self, counts: Counts) {
        let mut parts = self.lock();
        let Some(ended) = parts.nested.pop() else { return };
        parts.shown = parts.shown.max(ended.to);
        if let Some(around) = parts.nested.last_mut() {
            (around.from, around.since) = (ended.to, counts);
        }
    }

    /// Begins a batch. No new parts begin until it ends.
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
