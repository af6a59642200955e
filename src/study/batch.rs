//! Many shots of one plan, spread over the cores: what all long studies share.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Deserializer, Serialize};

use super::check::{Checked, check_shot};
use super::{Case, Effort};
use crate::scene::Shot;
use crate::simulation::Failure;
use crate::verdict::{Estimate, Limits, Verdict};

/// A long study seen from outside: how far it is, and a way to stop it.
#[derive(Debug, Default)]
pub struct Progress {
    stop: AtomicBool,
    expired: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Progress {
    /// Ends the study within a step.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Whether it was told to end.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The time is up: what is judged by now is all there will be.
    pub fn expire(&self) {
        self.expired.store(true, Ordering::Relaxed);
    }

    /// Whether the time was up.
    pub fn expired(&self) -> bool {
        self.expired.load(Ordering::Relaxed)
    }

    /// Shots judged, and how many there will be as far as is known.
    pub fn counts(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    /// Announces so many more shots.
    pub(super) fn expect(&self, more: usize) {
        self.total.fetch_add(more, Ordering::Relaxed);
    }

    /// One shot is judged.
    pub(super) fn advance(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Continue, unless told to end: for watchers.
    pub fn flow(&self) -> ControlFlow<()> {
        if self.stopped() || self.expired() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// What is kept of a judged shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// Pass, fail or undecided.
    pub verdict: Verdict,
    /// Greatest flight height and its error [m].
    #[serde(deserialize_with = "or_infinite")]
    pub height: [f64; 2],
    /// Greatest cable force and its error [N].
    #[serde(deserialize_with = "or_infinite")]
    pub force: [f64; 2],
    /// Greatest drift and its error [m].
    #[serde(deserialize_with = "or_infinite")]
    pub drift: [f64; 2],
}

/// JSON has no infinity: it is written as null.
fn or_infinite<'d, D: Deserializer<'d>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Option<f64>; 2]>::deserialize(from).map(|pair| pair.map(|value| value.unwrap_or(f64::INFINITY)))
}

impl Envelope {
    /// Of a run that failed.
    pub const UNKNOWN: Self = Self {
        verdict: Verdict::Undecided,
        height: [f64::INFINITY; 2],
        force: [f64::INFINITY; 2],
        drift: [f64::INFINITY; 2],
    };

    /// Of a checked shot.
    pub fn of(checked: &Checked) -> Self {
        Self::new(checked.verdict, [checked.height, checked.force, checked.drift])
    }

    /// Of a verdict on height, force and drift.
    pub fn new(verdict: Verdict, estimates: [Estimate; 3]) -> Self {
        let [height, force, drift] = estimates.map(|estimate| [estimate.value, estimate.error]);
        Self { verdict, height, force, drift }
    }

    /// The greatest share of any limit: above 1 the shot fails.
    pub fn use_of_limits(&self, limits: &Limits) -> f64 {
        let drift = limits.drift.map_or(0.0, |limit| self.drift[0] / limit);
        (self.height[0] / limits.height).max(self.force[0] / limits.force).max(drift)
    }
}

/// Does `work` for every job, in parallel; results in the order of jobs, whatever the number of threads. Only jobs that the
/// time did not suffice for have none.
pub fn each<J: Sync, T: Send>(
    jobs: &[J],
    progress: &Progress,
    work: impl Fn(&J) -> Result<T, Failure> + Sync,
) -> Result<Vec<Option<T>>, Failure> {
    progress.expect(jobs.len());
    let one = |job: &J| {
        if progress.flow().is_break() {
            return if progress.stopped() { Err(Failure::Stopped { at: 0.0 }) } else { Ok(None) };
        }
        match work(job) {
            Err(Failure::Stopped { .. }) if !progress.stopped() => Ok(None),
            result => {
                progress.advance();
                result.map(Some)
            }
        }
    };
    let results: Vec<_> = jobs.par_iter().map(one).collect();
    results.into_iter().collect()
}

/// Does one piece of work; a panic in it is told in words, so that others go on.
pub fn guarded<T, E: ToString>(work: impl FnOnce() -> Result<T, E>) -> Result<T, String> {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(result) => result.map_err(|error| error.to_string()),
        Err(panic) => {
            let words = panic.downcast_ref::<String>().map(String::as_str);
            let words = words.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("unknown cause");
            Err(format!("internal error: {words}"))
        }
    }
}

/// Judges every shot, refined until sure; those that the time did not suffice for have no result.
pub fn judge(
    case: &Case,
    shots: &[Shot],
    effort: &Effort,
    progress: &Progress,
) -> Result<Vec<Option<Envelope>>, Failure> {
    envelopes(shots, progress, |shot| {
        check_shot(case, shot, effort, &mut |_| progress.flow()).map(|checked| Envelope::of(&checked))
    })
}

/// The envelope of every job, like [`each`]. A few runs that fail are no reason for the others to have no result: theirs is
/// open, its values unknown. Where every run fails, that is told instead.
pub fn envelopes<J: Sync>(
    jobs: &[J],
    progress: &Progress,
    work: impl Fn(&J) -> Result<Envelope, Failure> + Sync,
) -> Result<Vec<Option<Envelope>>, Failure> {
    let done = each(jobs, progress, |job| match work(job) {
        Err(stopped @ Failure::Stopped { .. }) => Err(stopped),
        result => Ok(result),
    })?;
    if done.iter().flatten().all(Result::is_err)
        && let Some(Err(failure)) = done.iter().flatten().next()
    {
        return Err(failure.clone());
    }
    Ok(done.into_iter().map(|result| result.map(|envelope| envelope.unwrap_or(Envelope::UNKNOWN))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_fails_is_open_unless_all_fail() {
        let failure = Failure::Diverged { at: 1.0 };
        let good = Envelope { verdict: Verdict::Pass, height: [1.0, 0.1], ..Envelope::UNKNOWN };
        let work = |&job: &i32| if job == 2 { Err(failure.clone()) } else { Ok(good) };
        let some = envelopes(&[1, 2], &Progress::default(), work).expect("one of them is good");
        assert_eq!(some, [Some(good), Some(Envelope::UNKNOWN)]);
        assert_eq!(envelopes(&[2, 2], &Progress::default(), work), Err(failure.clone()));
        let text = serde_json::to_string(&Envelope::UNKNOWN).expect("JSON");
        assert_eq!(serde_json::from_str::<Envelope>(&text).expect("read again"), Envelope::UNKNOWN);
    }

    #[test]
    fn a_panic_is_told_and_the_others_go_on() {
        let jobs = [1, 2, 3];
        let work = |&job: &i32| {
            Ok(guarded(|| if job == 2 { panic!("job {job}") } else { Ok::<_, Failure>(10 * job) }))
        };
        let results = each(&jobs, &Progress::default(), work).expect("nobody stopped it");
        assert_eq!(results, [Some(Ok(10)), Some(Err("internal error: job 2".to_owned())), Some(Ok(30))]);
    }
}
