//! Runs in the lanes: each takes a job, keeps its own clock and record, hands in its outcome and takes the next.

use super::{Due, Pass, Sample, Stepper};
use crate::outcome::{End, Peak};
use crate::plan::Method;
use crate::scene::Firing;
use crate::simulation::pack::{LANES, Pack};
use crate::simulation::record::{Clock, Record};
use crate::simulation::{Failure, time_limit};

/// One run in progress.
pub(super) struct Run {
    pub(super) job: usize,
    /// Sorted by time.
    pub(super) firings: Vec<Firing>,
    pub(super) step: f64,
    pub(super) time_limit: f64,
    pub(super) clock: Clock,
    pub(super) moving: bool,
    pub(super) record: Record,
    /// The cable of the greatest force, if sampled in the step before.
    pub(super) sampled: Option<Sample>,
}

impl<const W: usize> Stepper<'_, W> {
    /// Brings a lane to the start of a step: finishes its run, takes the next, jumps over time at rest.
    pub(super) fn ready(&mut self, lane: usize) {
        loop {
            if self.runs[lane].is_none() && !self.take_job(lane) {
                return;
            }
            let Some(run) = &mut self.runs[lane] else { return };
            if run.clock.now(run.step) > run.time_limit * (1.0 + 1e-12) {
                self.finish(lane, End::TimeLimit);
                continue;
            }
            if !run.moving {
                match run.firings.get(run.clock.fired) {
                    Some(next) if next.at <= run.time_limit => run.clock.jump(next.at),
                    _ => {
                        self.finish(lane, End::AtRest);
                        continue;
                    }
                }
            }
            self.collect_due(lane);
            return;
        }
    }

    /// Starts the next job in a lane; false when none is left.
    fn take_job(&mut self, lane: usize) -> bool {
        let limit = self.limit;
        while let Some(job) = self.jobs.get(self.next_job) {
            let (n, step) = (self.next_job, job.settings.step);
            self.next_job += 1;
            if !(step > 0.0 && step < limit) {
                self.results[n] = Err(Failure::Step { step, limit, method: Method::Verlet });
                continue;
            }
            for j in (lane..LANES).step_by(W) {
                self.lanes.step[j] = step;
                self.lanes.friction[j] = job.friction;
                self.best[0][j] = 0.0;
                self.best[1][j] = 0.0;
            }
            self.runs[lane] = Some(Run {
                job: n,
                firings: self.quotient.firings(job.shot),
                step,
                time_limit: time_limit(job.shot, &job.settings),
                clock: Clock::new(job.shot),
                moving: false,
                record: Record::new(step),
                sampled: None,
            });
            return true;
        }
        false
    }

    /// Hands in a lane's outcome and lays its tires back.
    fn finish(&mut self, lane: usize, end: End) {
        let Some(run) = self.runs[lane].take() else { return };
        let mut drift = Peak { at: run.clock.now(run.step), ..Peak::default() };
        for tire in 0..self.quotient.weight.len() {
            let element = tire * W + lane;
            let shift = self.u.part[0][element].hypot(self.u.part[1][element]);
            if shift > drift.value {
                (drift.value, drift.place) = (shift, self.quotient.tire(tire));
            }
        }
        self.results[run.job] = Ok(run.record.finish(drift, run.clock.steps, end));
        self.clear(lane);
    }

    fn fail(&mut self, lane: usize, failure: Failure) {
        if let Some(run) = self.runs[lane].take() {
            self.results[run.job] = Err(failure);
        }
        self.clear(lane);
    }

    fn clear(&mut self, lane: usize) {
        for field in [&mut self.u, &mut self.v] {
            for part in &mut field.part {
                part.iter_mut().skip(lane).step_by(W).for_each(|value| *value = 0.0);
            }
        }
        self.tension.slacken(lane, W);
        for energy in self.stored.iter_mut().chain([&mut self.asleep]) {
            energy.iter_mut().skip(lane).step_by(W).for_each(|value| *value = 0.0);
        }
    }

    pub(super) fn stop(&mut self) {
        for run in self.runs.iter().flatten() {
            self.results[run.job] = Err(Failure::Stopped { at: run.clock.now(run.step) });
        }
    }

    /// Gathers the holes that fire before the step ends and wakes their tires.
    fn collect_due(&mut self, lane: usize) {
        let Some(run) = &mut self.runs[lane] else { return };
        let start = run.clock.since(run.step);
        let end = start + run.step;
        while let Some(firing) = run.firings.get(run.clock.fired) {
            let at = firing.at - run.clock.base;
            if at >= end {
                break;
            }
            let element = firing.tire * W + lane;
            self.due.push(Due { element, after: (at - start).clamp(0.0, run.step), launch: firing.launch });
            self.wake.set_moving(element / LANES, true);
            run.clock.fired += 1;
        }
    }

    /// Closes a lane's books for the step and ticks its clock.
    pub(super) fn book(&mut self, lane: usize, pass: &Pass) {
        let Some(run) = &mut self.runs[lane] else { return };
        let now = run.clock.now(run.step);
        let mine = || (lane..LANES).step_by(W);
        let sum = |of: &Pack| mine().map(|j| of[j]).sum::<f64>();
        let top = |of: &Pack| mine().map(|j| of[j]).fold(0.0, f64::max);
        let (energy, dissipated) = (sum(&pass.energy), sum(&pass.dissipated));
        if !(energy + dissipated).is_finite() {
            return self.fail(lane, Failure::Diverged { at: now });
        }
        run.record.balance(energy, 0.5 * dissipated);
        run.record.ledger.dissipated += dissipated + sum(&pass.lost);
        run.record.ledger.put_in += sum(&pass.put_in);
        run.record.history.note(now, top(&pass.height), top(&pass.force));
        run.moving = top(&pass.motion) > 0.0;
        run.clock.tick();
    }
}
