//! Records observed quantities in one run: the values that an observer would see.

use crate::choice::ObservedQuantity;
use crate::plan::observations::ObservedPoint;
use crate::simulation::Motion;

/// Height above which a tire has visibly left the ground [m].
const OFF_THE_GROUND: f64 = 1e-3;

/// Records quantities through one run.
pub struct ObservationRecorder<'w> {
    watched: &'w [ObservedPoint],
    tracks: Vec<Track>,
    time: f64,
}

/// State of one recorded quantity.
#[derive(Clone, Copy, Default)]
struct Track {
    /// The last two recorded values, as time [s] and value; the later one second.
    last: [(f64, f64); 2],
    /// The greatest value so far, also between steps.
    greatest: f64,
    /// Start of the present flight [s]; `None` on the ground, and until two values of the flight are recorded.
    left: Option<f64>,
    /// Start of the first flight that is visibly off the ground [s].
    lift: Option<f64>,
    /// Time at which that flight ends [s].
    landing: Option<f64>,
    /// The value at the requested time.
    at_time: Option<f64>,
}

impl<'w> ObservationRecorder<'w> {
    /// Records these quantities from time 0 on.
    pub fn new(watched: &'w [ObservedPoint]) -> Self {
        Self { watched, tracks: vec![Track::default(); watched.len()], time: 0.0 }
    }

    /// Records the motion after a step.
    pub fn observe(&mut self, motion: &dyn Motion) {
        let time = motion.time();
        if time <= self.time {
            return;
        }
        self.time = time;
        for (watched, track) in self.watched.iter().zip(&mut self.tracks) {
            let value = match watched.quantity {
                ObservedQuantity::Force => motion.force(watched.index),
                ObservedQuantity::Drift => motion.displacement(watched.index).xy().norm(),
                _ => motion.displacement(watched.index).z,
            };
            track.note(time, value, watched.time);
        }
    }

    /// The value of each quantity [its SI unit], in their order. NaN if the tire never lifts or never lands. Also NaN for a height
    /// after the end of a run that did not end `at_rest`.
    pub fn values(&self, at_rest: bool) -> Vec<f64> {
        let value = |(watched, track): (&ObservedPoint, &Track)| match watched.quantity {
            ObservedQuantity::FlightHeight | ObservedQuantity::Force => track.greatest,
            ObservedQuantity::Height => {
                track.at_time.unwrap_or(if at_rest { track.last[1].1 } else { f64::NAN })
            }
            ObservedQuantity::Lift => track.lift.unwrap_or(f64::NAN),
            ObservedQuantity::Landing => track.landing.unwrap_or(f64::NAN),
            ObservedQuantity::Drift => track.last[1].1,
        };
        self.watched.iter().zip(&self.tracks).map(value).collect()
    }
}

impl Track {
    /// Records a value at a time. `asked` is the requested time [s].
    fn note(&mut self, time: f64, value: f64, asked: f64) {
        let [before, (from, old)] = self.last;
        self.greatest = self.greatest.max(value).max(top(before, (from, old), (time, value)));
        if self.at_time.is_none() && time >= asked {
            let part = if time > from { ((asked - from) / (time - from)).clamp(0.0, 1.0) } else { 1.0 };
            self.at_time = Some(old + part * (value - old));
        }
        if value <= 0.0 {
            self.left = None;
        } else if self.left.is_none() && old > 0.0 {
            // The straight line through the first two values of the flight meets the ground within the step before them.
            let rise = (value - old) / (time - from);
            let ground = if rise > 0.0 { from - old / rise } else { before.0 };
            self.left = Some(ground.clamp(before.0, from));
        }
        if self.lift.is_none() && value.max(old) > OFF_THE_GROUND {
            self.lift = self.left;
        }
        if self.lift.is_some() && self.landing.is_none() && value <= 0.0 && old > 0.0 {
            let fall = (before.1 - old) / (from - before.0);
            let ground = if fall > 0.0 { from + old / fall } else { time };
            self.landing = Some(ground.clamp(from, time));
        }
        self.last = [(from, old), (time, value)];
    }
}

/// Top of the parabola through three values if the middle one is the greatest and all are above 0; else 0.
fn top(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    let (left, right) = (b.0 - a.0, c.0 - b.0);
    if !(a.1 > 0.0 && c.1 > 0.0 && b.1 > a.1 && b.1 >= c.1 && left > 0.0 && right > 0.0) {
        return 0.0;
    }
    let [rise, fall] = [(b.1 - a.1) / left, (c.1 - b.1) / right];
    let curvature = (fall - rise) / (left + right);
    // Slope at the middle value.
    let slope = (rise * right + fall * left) / (left + right);
    b.1 - slope * slope / (4.0 * curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Thrown up at 5 m/s at 12.3 ms, the tire rises 25/2g and lands 10/g later. The steps are 1 ms.
    #[test]
    fn a_throw_is_seen_between_the_steps() {
        let (fired, gravity) = (0.0123, 9.81);
        let height = |time: f64| {
            let t = time - fired;
            (t * (5.0 - 0.5 * gravity * t)).max(0.0) * f64::from(u8::from(t > 0.0))
        };
        let mut track = ObservationRecorder::new(&[ObservedPoint {
            quantity: ObservedQuantity::Height,
            index: 0,
            time: 0.4005,
        }])
        .tracks[0];
        (1..2000).map(|n| f64::from(n) * 1e-3).for_each(|time| track.note(time, height(time), 0.4005));
        // The parabola is exact up to rounding. A straight line errs by g h²/8 = 1.2 µm, and the lift by up to g h²/v = 2 µs.
        assert!((track.greatest - 25.0 / 2.0 / gravity).abs() < 1e-9, "{}", track.greatest);
        assert!((track.at_time.expect("seen") - height(0.4005)).abs() < 1.3e-6);
        assert!((track.lift.expect("lifts") - fired).abs() < 2e-6, "{:?}", track.lift);
        let landing = fired + 10.0 / gravity;
        assert!((track.landing.expect("lands") - landing).abs() < 3e-6, "{:?} {landing}", track.landing);
    }
}
