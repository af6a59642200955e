//! Time of one run: the present step, the next firing, and the decision when the run ends.

use super::RunSettings;
use crate::outcome::{EndReason, RunEnd};
use crate::scene::{Firing, Shot};

/// Time after the last firing at which a run ends even if the shelter never comes to rest [s]. A tire launched at 30 m/s, the
/// greatest usual speed, is down again after 6 s. A shelter that still moves after ten times as long slides on without friction.
const SETTLING_LIMIT: f64 = 60.0;
/// Relative rounding of the time of a step. A step that exceeds the limit by less than this is still made.
const ROUNDING: f64 = 1e-12;

/// Clock of one run. Time is a number of steps since the last rest, so that no rounding adds up.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Time of step 0 [s].
    pub base: f64,
    /// Steps since `base`.
    n: usize,
    /// Steps of the whole run.
    pub steps: usize,
    /// Number of firings already done.
    pub fired: usize,
    /// Step [s].
    step: f64,
    /// Latest end of the run [s].
    limit: f64,
}

impl Clock {
    /// Clock that starts at the first firing of `shot`, because the shelter is at rest until then. If the shelter `slides`, the
    /// clock starts at 0.
    pub fn new(shot: &Shot, settings: &RunSettings, slides: bool) -> Self {
        let [first, last] = [shot.firings.first(), shot.firings.last()]
            .map(|firing| firing.map_or(0.0, |firing| firing.time));
        let limit = settings.duration.unwrap_or(last + SETTLING_LIMIT);
        Self { base: if slides { 0.0 } else { first }, n: 0, steps: 0, fired: 0, step: settings.step, limit }
    }

    /// Time since `base` [s].
    pub fn since_base(&self) -> f64 {
        self.n as f64 * self.step
    }

    /// Present time [s].
    pub fn now(&self) -> f64 {
        self.base + self.since_base()
    }

    /// Counts one step.
    pub fn tick(&mut self) {
        self.n += 1;
        self.steps += 1;
    }

    /// Jumps to the next firing if the shelter is at rest. Returns the reason if the run ends now; otherwise a step follows. A
    /// shelter at rest without further firings ends as [`EndReason::AtRest`], even if the last step exceeds the limit.
    pub fn skip_rest_or_end(&mut self, moving: bool, firings: &[Firing]) -> Option<EndReason> {
        if !moving {
            match firings.get(self.fired) {
                None => return Some(EndReason::AtRest),
                Some(next) if next.time <= self.limit => (self.base, self.n) = (next.time, 0),
                Some(_) => return Some(EndReason::TimeLimit),
            }
        }
        (self.now() > self.limit * (1.0 + ROUNDING)).then_some(EndReason::TimeLimit)
    }

    /// Time by which the last step exceeds the limit [s].
    pub fn overshoot(&self) -> f64 {
        (self.now() - self.limit).max(0.0)
    }

    /// End of the run for `reason`: now, or at the limit if the last step exceeds it.
    pub fn end(&self, reason: EndReason) -> RunEnd {
        RunEnd { time: self.now() - self.overshoot(), reason }
    }
}
