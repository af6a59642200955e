//! The time left until all options are judged: the runs still expected, at the rate of the runs done.

use std::time::{Duration, Instant};

use crate::jobs::Runs;

/// Least time and least number of runs before a time left is shown.
const WATCHED: Duration = Duration::from_secs(1);
const LEAST_DONE: usize = 50;
/// Largest ratio of the time left to the least time left so far. Beyond it no time is shown. The screen allows for up to twice the
/// time left.
const GROWTH: f64 = 1.3;
/// Time between two marks. The runs since the mark before last show whether recent runs take longer than earlier runs.
const BETWEEN_MARKS: Duration = Duration::from_secs(4);

/// The rate of the job that judges the options.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    begun: Option<(Instant, usize)>,
    runs: Runs,
    /// Expected number of runs until the job is done.
    expected: usize,
    /// The least time left so far [s]. `holds` says whether it still holds.
    least: Option<f64>,
    holds: bool,
    /// Runs per second so far.
    rate: Option<f64>,
    /// Greatest done share of the expected runs so far.
    done: f64,
    /// The last two marks, newest first: the time, and the number of runs done.
    marks: [Option<(Instant, usize)>; 2],
    /// Runs at the last result that follows the verdicts, such as the assumptions of a pass.
    found: Option<Runs>,
}

impl Pace {
    /// Notes the runs done so far.
    pub fn note(&mut self, runs: Runs, at: Instant) {
        let (begun, before) = *self.begun.get_or_insert((at, runs.done));
        self.runs = runs;
        let expected = self.expected.max(runs.announced);
        self.done = self
            .done
            .max(runs.done.saturating_sub(before) as f64 / expected.saturating_sub(before).max(1) as f64);
        let (elapsed, done) = (at.saturating_duration_since(begun), runs.done.saturating_sub(before));
        if elapsed < WATCHED || done < LEAST_DONE {
            return;
        }
        // After the verdicts, the job counts pieces of work that need no run.
        if runs.done <= self.expected {
            self.rate = Some(done as f64 / elapsed.as_secs_f64());
        }
        // If the runs exceed the expected number, expect as many more as this excess.
        let beyond = runs.done.saturating_sub(self.expected);
        let to_come = expected.saturating_sub(runs.done).max(beyond);
        let left = to_come as f64 * self.time_of_run(elapsed.as_secs_f64() / done as f64, at);
        let least = self.least.map_or(left, |least| least.min(left));
        (self.least, self.holds) = (Some(least), left <= GROWTH * least.max(1.0));
    }

    /// Time of a run [s]: the average so far, or the average since the mark before last if that is longer.
    fn time_of_run(&mut self, until_now: f64, at: Instant) -> f64 {
        let [last, before] = self.marks;
        if last.is_none_or(|(last, _)| at.saturating_duration_since(last) >= BETWEEN_MARKS) {
            self.marks = [Some((at, self.runs.done)), last];
        }
        let lately = before.map_or(0.0, |(marked, done)| {
            at.saturating_duration_since(marked).as_secs_f64()
                / self.runs.done.saturating_sub(done).max(1) as f64
        });
        until_now.max(lately)
    }

    /// Done share of the expected runs, 0 to 1. It never falls.
    pub fn done(&self) -> f64 {
        self.done
    }

    /// Sets the number of runs still expected.
    pub fn expect(&mut self, runs: usize) {
        self.expected = self.runs.done + runs;
    }

    /// Notes a result that follows the verdicts. Pieces done from now on count for the next result.
    pub fn note_found(&mut self) {
        self.found = Some(self.runs);
    }

    /// Done share of the pieces announced for the next result after the verdicts, 0 to 1. The search may end sooner.
    pub fn done_of_next(&self) -> Option<f64> {
        let found = self.found?;
        let of_next = self.runs.announced.checked_sub(found.done).filter(|pieces| *pieces > 0)?;
        Some((self.runs.done.saturating_sub(found.done) as f64 / of_next as f64).min(1.0))
    }

    /// Runs per second; `None` until enough runs are done.
    pub fn rate(&self) -> Option<f64> {
        self.rate
    }

    /// The time left. It never grows: `None` if it would grow, or until enough runs are done.
    pub fn left(&self) -> Option<Duration> {
        self.least.filter(|_| self.holds).map(Duration::from_secs_f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At 100 runs a second, the time shown is the time of the runs left, and never grows.
    #[test]
    fn the_time_left_follows_the_pace_and_never_grows() {
        let (mut pace, begun) = (Pace::default(), Instant::now());
        pace.expect(1000);
        let mut note = |seconds: u64, announced: usize, more: Option<usize>| {
            more.into_iter().for_each(|more| pace.expect(more));
            let done = 100 * seconds as usize;
            let before = pace.done();
            pace.note(Runs { done, announced: done.max(announced) }, begun + Duration::from_secs(seconds));
            assert!((before..=1.0).contains(&pace.done()), "{before} to {}", pace.done());
            pace.left().map(|left| left.as_secs_f64())
        };
        assert_eq!(note(0, 50, None), None, "nothing is done");
        assert_eq!(note(2, 250, None), Some(8.0));
        assert_eq!(note(5, 550, None), Some(5.0));
        assert_eq!(note(6, 650, None), Some(4.0));
        assert_eq!(note(7, 750, Some(500)), Some(4.0), "100 more than expected");
        assert_eq!(note(8, 850, Some(900)), None, "8 s, but 4 s were told");
        assert_eq!(note(12, 1300, None), Some(4.0));
        assert_eq!(note(15, 1500, None), Some(1.0));
        assert_eq!(note(16, 1900, Some(0)), None, "300 are begun: more than was expected");
        assert_eq!(note(18, 1900, None), None, "3 s longer than expected, and as long again");
    }

    /// The assumptions of the options are tried after the verdicts, in pieces that need no run each: a thousand in a second.
    #[test]
    fn the_pace_is_that_of_the_verdicts() {
        let (mut pace, begun) = (Pace::default(), Instant::now());
        pace.expect(200);
        for (seconds, done) in [(0, 0), (2, 200), (3, 1200)] {
            pace.note(Runs { done, announced: done }, begun + Duration::from_secs(seconds));
        }
        assert_eq!(pace.rate(), Some(100.0));
    }

    /// The search for the assumptions of a pass announces all its pieces at its start: 300 of 1,000 are done, and none of the next search.
    #[test]
    fn what_follows_the_verdicts_has_a_share_of_its_own() {
        let mut pace = Pace::default();
        let mut note = |done, announced, is_found: bool| {
            pace.note(Runs { done, announced }, Instant::now());
            if is_found {
                pace.note_found();
            }
            pace.done_of_next()
        };
        assert_eq!(note(200, 200, false), None);
        assert_eq!(note(200, 200, true), None);
        assert_eq!(note(500, 1200, false), Some(0.3));
        assert_eq!(note(1200, 1200, true), None);
        assert_eq!(note(1200, 2200, false), Some(0.0));
    }

    /// The last runs may take longer: checks at fine steps, or holes that fire far apart.
    #[test]
    fn nothing_is_told_where_the_last_runs_take_much_longer() {
        let (mut pace, begun) = (Pace::default(), Instant::now());
        pace.expect(2000);
        let mut note = |seconds: u64, done: usize| {
            pace.note(Runs { done, announced: 2000 }, begun + Duration::from_secs(seconds));
            pace.left().map(|left| left.as_secs_f64())
        };
        note(0, 0);
        assert_eq!(note(10, 1000), Some(10.0));
        assert_eq!(note(15, 1500), Some(5.0));
        assert_eq!(note(19, 1900), Some(1.0));
        assert_eq!(note(30, 1902), None, "98 are left, and 402 took 15 s");
    }
}
