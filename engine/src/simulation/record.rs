//! Running record of one run: peaks between steps, broken cables, the ledger, the history.

use nalgebra::Vector3;

use super::clock::Clock;
use crate::outcome::{BrokenCable, EndReason, History, Ledger, Outcome, Peak};

/// Record of a run that is under way.
#[derive(Clone, Debug)]
pub struct Record {
    /// Greatest height so far [m].
    pub height: Peak,
    /// Greatest cable force over strength so far [N].
    pub force: Peak,
    /// Cables that broke so far, in order of time.
    pub broken: Vec<BrokenCable>,
    /// First break: breaking force [N], time and cable.
    first_break: Option<Peak>,
    /// Energies so far [J].
    pub ledger: Ledger,
    /// Height and force over time.
    pub history: History,
    /// Step [s].
    step: f64,
}

impl Record {
    /// Empty record of a run at `step` [s].
    pub fn new(step: f64) -> Self {
        Self {
            height: Peak::default(),
            force: Peak::default(),
            broken: Vec::new(),
            first_break: None,
            ledger: Ledger::default(),
            history: History::new(step),
            step,
        }
    }

    /// Notes a new greatest height, `peak` [m], with the vertical velocity [m/s] and acceleration [m/s²] of its tire.
    ///
    /// Between steps the tire follows a parabola. The top of the parabola replaces the height if the top is at most half a step
    /// away.
    pub fn note_height(&mut self, peak: Peak, velocity: f64, acceleration: f64) {
        let until_top = -velocity / acceleration;
        let near = acceleration < 0.0 && until_top.abs() <= 0.5 * self.step;
        let ahead = if near { until_top } else { 0.0 };
        self.height = Peak { value: peak.value + 0.5 * velocity * ahead, time: peak.time + ahead, ..peak };
    }

    /// Notes the top of a flight between two steps [m], if that top is the greatest height so far.
    pub fn note_top(&mut self, top: Peak) {
        if top.value > self.height.value {
            self.height = top;
        }
    }

    /// Moves the greatest force, found one step ago, to the top of the parabola through the forces of three steps.
    ///
    /// `before` and `after` are the forces of the same cable over its strength [N], one step before and one step after the greatest
    /// force. Without damping they are k (L − L0), also where the cable is slack.
    pub fn interpolate_force(&mut self, before: f64, after: f64) {
        let middle = self.force.value;
        if before <= middle && after <= middle && before + after < 2.0 * middle && after.is_finite() {
            let (rise, bend) = (after - before, 2.0 * middle - before - after);
            self.force.value += rise * rise / (8.0 * bend);
            self.force.time += 0.5 * self.step * rise / bend;
        }
    }

    /// Compares the energy of the shelter now [J] with the ledger. `half_kick` [J] is already dissipated but not booked yet.
    pub fn balance_energy(&mut self, energy: f64, half_kick: f64) {
        let residual = energy + self.ledger.dissipated + half_kick - self.ledger.put_in;
        self.ledger.greatest_residual = self.ledger.greatest_residual.max(residual.abs());
    }

    /// Notes that a cable breaks at `time` [s]. The greatest force of the run is then `breaking_force` [N], at the time and cable
    /// of the first break.
    pub fn note_break(&mut self, breaking_force: f64, time: f64, cable: usize) {
        let first = Peak { value: breaking_force, time, index: cable };
        self.force = *self.first_break.get_or_insert(first);
    }

    /// Puts the peaks into the history as they count. Peaks lie between steps, and the force of a weak cable counts over its
    /// strength. Without the peaks, a curve could stay below a limit that its run exceeds.
    fn keep_peaks(&mut self) {
        let Self { height, force, history, .. } = self;
        history.note(height.time, height.value, 0.0);
        history.note(force.time, 0.0, force.value);
    }

    /// Outcome of the run, from the index and the displacement [m] of each tire at the end.
    pub fn finish(
        mut self,
        tires: impl Iterator<Item = (usize, Vector3<f64>)>,
        clock: &Clock,
        reason: EndReason,
    ) -> Outcome {
        let end = clock.end(reason);
        let (mut drift, mut tires_in_air) = (Peak { time: end.time, ..Peak::default() }, false);
        for (index, displacement) in tires {
            let shift2 = displacement.xy().norm_squared();
            if shift2 > drift.value {
                (drift.value, drift.index) = (shift2, index);
            }
            tires_in_air |= displacement.z > 0.0;
        }
        drift.value = drift.value.sqrt();
        self.keep_peaks();
        let Self { height, force, broken, ledger, history, step, .. } = self;
        let steps = clock.steps;
        Outcome { height, force, drift, broken, ledger, history, step, steps, end, tires_in_air }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force that breaks nothing may peak between two steps above the force at which another cable breaks later.
    #[test]
    fn a_break_names_the_cable_that_broke() {
        let mut record = Record::new(1e-3);
        record.force = Peak { value: 101.0, time: 0.1, index: 3 };
        record.note_break(100.0, 0.2, 7);
        assert_eq!(record.force, Peak { value: 100.0, time: 0.2, index: 7 });
        record.force = Peak { value: 105.0, time: 0.3, index: 9 };
        record.note_break(100.0, 0.3, 9);
        assert_eq!(record.force.index, 7, "the first break counts");
    }

    /// A curve that stays below the peak of its run would look like a pass where the run exceeds a limit.
    #[test]
    fn the_history_holds_the_peaks_between_steps() {
        let mut record = Record::new(1e-3);
        (0..10).for_each(|n| record.history.note(f64::from(n) * 1e-3, 1.0, 5.0));
        record.height = Peak { value: 1.2, time: 4.4e-3, index: 0 };
        record.force = Peak { value: 5.6, time: 7.5e-3, index: 0 };
        record.keep_peaks();
        let History { height, force, .. } = record.history;
        assert_eq!((height[4], force[7]), (1.2, 5.6));
        assert_eq!((height.iter().sum::<f64>(), force.iter().sum::<f64>()), (9.0 + 1.2, 45.0 + 5.6));
    }
}
