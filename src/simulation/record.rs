//! What is kept of a run as it goes: peaks between samples, the ledger, the history.

use nalgebra::Vector3;

use crate::outcome::{Broken, End, History, Ledger, Outcome, Peak};
use crate::scene::Shot;

/// Running record of one run.
#[derive(Clone, Debug)]
pub struct Record {
    /// Greatest height so far [m].
    pub height: Peak,
    /// Greatest cable force so far [N].
    pub force: Peak,
    /// Cables that broke so far.
    pub broken: Vec<Broken>,
    /// Where and when the first of them did.
    first_broken: Option<Peak>,
    /// Energies so far [J].
    pub ledger: Ledger,
    /// Height and force over time.
    pub history: History,
    step: f64,
}

impl Record {
    /// Nothing happened yet.
    pub fn new(step: f64) -> Self {
        Self {
            height: Peak::default(),
            force: Peak::default(),
            broken: Vec::new(),
            first_broken: None,
            ledger: Ledger::default(),
            history: History::new(step),
            step,
        }
    }

    /// A tire sampled higher than ever, with its vertical velocity and acceleration: notes the top of its parabola where
    /// that is nearer than half a step.
    pub fn higher(&mut self, sample: Peak, velocity: f64, acceleration: f64) {
        let until = -velocity / acceleration;
        let top = if acceleration < 0.0 && until.abs() <= 0.5 * self.step { until } else { 0.0 };
        self.height = Peak { value: sample.value + 0.5 * velocity * top, at: sample.at + top, ..sample };
    }

    /// The greatest force was sampled one step ago; `before` and `after` are that cable's k (L − L0) a step earlier and now:
    /// notes the top of the parabola through the three.
    pub fn vertex(&mut self, before: f64, after: f64) {
        let top = self.force.value;
        if before <= top && after <= top && before + after < 2.0 * top && after.is_finite() {
            let (rise, bend) = (after - before, 2.0 * top - before - after);
            self.force.value += rise * rise / (8.0 * bend);
            self.force.at += 0.5 * self.step * rise / bend;
        }
    }

    /// Checks the ledger with the energy now in the shelter [J] and what the half step dissipates.
    pub fn balance(&mut self, energy: f64, dissipating: f64) {
        let residual = energy + self.ledger.dissipated + dissipating - self.ledger.put_in;
        self.ledger.greatest_residual = self.ledger.greatest_residual.max(residual.abs());
    }

    /// A cable broke at `limit` [N]: no force was greater, and the first to break was first.
    pub fn cap(&mut self, limit: f64) {
        let first = *self.first_broken.get_or_insert(Peak { value: limit, ..self.force });
        self.force = first;
    }

    /// The finished run, from the tires at its end: index and displacement [m]; and when that was [s], after how many steps.
    pub fn finish(
        self,
        tires: impl Iterator<Item = (usize, Vector3<f64>)>,
        (at, steps): (f64, usize),
        end: End,
    ) -> Outcome {
        let (mut drift, mut aloft) = (Peak { at, ..Peak::default() }, false);
        for (place, displacement) in tires {
            let shift2 = displacement.xy().norm_squared();
            if shift2 > drift.value {
                (drift.value, drift.place) = (shift2, place);
            }
            aloft |= displacement.z > 0.0;
        }
        drift.value = drift.value.sqrt();
        let Self { height, force, broken, ledger, history, step, .. } = self;
        Outcome { height, force, drift, broken, ledger, history, step, steps, end, aloft }
    }
}

/// The clock of one run: steps counted from the last time all was at rest, never summed up.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Time of step 0 [s].
    pub base: f64,
    /// Steps since.
    pub n: usize,
    /// Steps of the whole run.
    pub steps: usize,
    /// Firings already done.
    pub fired: usize,
}

impl Clock {
    /// Starts at the first firing; before it all is at rest.
    pub fn new(shot: &Shot) -> Self {
        Self { base: shot.firings.first().map_or(0.0, |firing| firing.at), n: 0, steps: 0, fired: 0 }
    }

    /// Time since `base` [s].
    pub fn since(&self, step: f64) -> f64 {
        self.n as f64 * step
    }

    /// Now [s].
    pub fn now(&self, step: f64) -> f64 {
        self.base + self.since(step)
    }

    /// One step on.
    pub fn tick(&mut self) {
        self.n += 1;
        self.steps += 1;
    }

    /// Restarts at `time` [s].
    pub fn jump(&mut self, time: f64) {
        self.base = time;
        self.n = 0;
    }
}
