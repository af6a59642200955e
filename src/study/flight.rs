//! Position of every tire over time, to play one option back.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use serde::{Deserialize, Serialize};

use super::study_trait::{Study, Subject};
use super::trace::{DrawnSample, TracedShot};
use super::{Case, ComputeResult, Computed, Context, NoResult};
use crate::outcome::Outcome;
use crate::scene::{Cable, Scene, Shot};
use crate::simulation::Motion;
use crate::verdict::Limits;

/// Motion of one option, of its planned shot or of a sample, recorded at even times.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Index of the delay option.
    pub option: usize,
    /// The sample; `None` for the planned shot.
    pub sample: Option<DrawnSample>,
    /// The shelter, as planned or as in the sample.
    pub scene: Scene,
    /// What fires when.
    pub shot: Shot,
    /// Outcome of the run.
    pub outcome: Outcome,
    tires: usize,
    /// Time of each frame [s] (`n_frames`).
    times: Vec<f64>,
    /// Displacement of each tire from its position at rest [m] (`n_frames` × `n_tires`).
    displacements: Vec<[f32; 3]>,
}

/// Event at which the flight stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A blast row fires.
    Row {
        /// Index of the row.
        row: usize,
        /// Whether all its holes fire at once. If not, the first hole fires.
        at_once: bool,
    },
    /// The greatest force of all.
    Force,
    /// The greatest height of all.
    Height,
}

/// Greatest height of a tire that counts as on the ground [m].
pub const GROUND: f32 = 1e-4;

/// Difference of two times that are the same except for rounding [s].
pub const SAME_TIME: f64 = 1e-9;

/// Greatest number of displacements kept, of all tires and frames: 60 MB.
const MOST_KEPT: usize = 5_000_000;
/// Least and greatest number of frames kept. The numbers are even, because a full recording is halved.
const FRAMES: [usize; 2] = [16, 1024];

/// The question: how does one option move?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Index of the option.
    pub option: usize,
    /// The sample; `None` for the planned shot.
    pub sample: Option<DrawnSample>,
}

impl Study for Question {
    type Found = Flight;

    fn usual(_case: &Case, Subject { option, sample, .. }: Subject) -> Self {
        Self { option, sample }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Flight> {
        record(context, self.option, self.sample).map(Computed::complete)
    }
}

/// Runs one option once, its planned shot or a sample, and records frames.
///
/// Memory is bounded for runs of any length: a full recording drops every second frame.
///
/// # Panics
///
/// If the plan has no delay option with the index `option`.
pub fn record(context: &Context<'_>, option: usize, sample: Option<DrawnSample>) -> Result<Flight, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let traced = TracedShot::new(case, option, &compute, sample);
    let tires = case.scene().tire_count();
    let most = (MOST_KEPT / tires.max(1)).clamp(FRAMES[0], FRAMES[1]) / 2 * 2;
    let (mut times, mut displacements) = (Vec::new(), Vec::new());
    // The shelter at rest, before the first hole.
    times.push(0.0);
    displacements.resize(tires, [0.0; 3]);
    let mut every = traced.settings.step;
    let (mut latest, mut now) = (vec![[0.0; 3]; tires], 0.0);
    let outcome = traced.run(&mut |motion| {
        now = motion.time();
        latest.iter_mut().enumerate().for_each(|(tire, u)| *u = single(motion, tire));
        let last = times.last().copied().unwrap_or(0.0);
        if now >= last + every * (1.0 - 1e-9) {
            if times.len() == most {
                halve(&mut times, &mut displacements, tires);
                every *= 2.0;
            }
            times.push(now);
            displacements.extend_from_slice(&latest);
        }
        control.keep_going()
    });
    let outcome = outcome.map_err(|failure| control.no_result(failure))?;
    if times.last().is_some_and(|&last| last < now) {
        times.push(now);
        displacements.extend_from_slice(&latest);
    }
    let (scene, shot) = (traced.scene().clone(), traced.shot().clone());
    Ok(Flight { option, sample, scene, shot, outcome, tires, times, displacements })
}

fn single(motion: &dyn Motion, tire: usize) -> [f32; 3] {
    let u = motion.displacement(tire);
    [u.x as f32, u.y as f32, u.z as f32]
}

fn halve(times: &mut Vec<f64>, displacements: &mut Vec<[f32; 3]>, tires: usize) {
    let kept = times.len().div_ceil(2);
    for frame in 0..kept {
        times[frame] = times[2 * frame];
        displacements.copy_within(2 * frame * tires..(2 * frame + 1) * tires, frame * tires);
    }
    times.truncate(kept);
    displacements.truncate(kept * tires);
}

impl Flight {
    /// Stops of the flight with their times [s], in no order: each row, the greatest force and the greatest height.
    pub fn stops(&self) -> Vec<(f64, Stop)> {
        let Outcome { height, force, .. } = &self.outcome;
        let peaks = [(force, Stop::Force), (height, Stop::Height)];
        let peaks =
            peaks.into_iter().filter(|(peak, _)| peak.value > 0.0).map(|(peak, stop)| (peak.time, stop));
        // The firings are in order of time.
        let mut rows: BTreeMap<usize, (f64, bool)> = BTreeMap::new();
        for firing in &self.shot.firings {
            let (first, at_once) = rows.entry(firing.row).or_insert((firing.time, true));
            *at_once &= firing.time - *first < SAME_TIME;
        }
        let rows = rows.into_iter().map(|(row, (first, at_once))| (first, Stop::Row { row, at_once }));
        rows.chain(peaks).collect()
    }

    /// Time of the greatest force or height [s], whichever is nearer to its limit.
    pub fn worst_moment(&self, limits: &Limits) -> f64 {
        let Outcome { height, force, .. } = &self.outcome;
        if force.value / limits.force >= height.value / limits.height { force.time } else { height.time }
    }

    /// End of the run [s].
    pub fn end(&self) -> f64 {
        self.outcome.end.time
    }

    /// Elastic force of each cable at `time` [N] (`n_cables`); 0 if the cable is slack or broken. A cable with a strength of its
    /// own counts as in [`Outcome::force`].
    pub fn forces(&self, time: f64) -> Vec<f64> {
        let frame = self.at(time);
        let displacement = |tire: usize| Vector3::from(frame[tire].map(f64::from));
        let force = |cable: &Cable| cable.force(cable.between(cable.ends.map(displacement)).norm()).max(0.0);
        let over_strength = |(n, cable): (usize, &Cable)| force(cable) / self.scene.strength(n);
        let mut forces: Vec<f64> = self.scene.cables.iter().enumerate().map(over_strength).collect();
        for broken in self.outcome.broken.iter().filter(|broken| broken.time <= time) {
            forces[broken.cable] = 0.0;
        }
        forces
    }

    /// Displacements x, y and height [m] of one tire in the frames up to `time` [s].
    pub fn path(&self, tire: usize, time: f64) -> impl Iterator<Item = [f32; 3]> {
        let frames = self.times.iter().take_while(move |&&taken| taken <= time + SAME_TIME).count();
        (0..frames).map(move |frame| self.displacements[frame * self.tires + tire])
    }

    /// Displacements x, y and height [m] of all tires (`n_tires`) in the last frame up to `time` [s].
    pub fn at(&self, time: f64) -> &[[f32; 3]] {
        let after = self.times.partition_point(|&taken| taken <= time + SAME_TIME);
        let frame = after.saturating_sub(1);
        &self.displacements[frame * self.tires..(frame + 1) * self.tires]
    }
}
