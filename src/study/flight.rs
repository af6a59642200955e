//! Position of every tire over time, for playing one option back.

use nalgebra::Vector3;

use super::{Case, ComputeSettings, NoResult, StudyControl};
use crate::outcome::Outcome;
use crate::scene::{Cable, Scene};
use crate::simulation::Motion;

/// Motion of one option, sampled at even times.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Index of the delay option.
    pub option: usize,
    /// Outcome of the run.
    pub outcome: Outcome,
    tires: usize,
    /// Time of each frame [s] (`n_frames`).
    times: Vec<f64>,
    /// Displacement of each tire from its position at rest [m] (`n_frames` × `n_tires`).
    displacements: Vec<[f32; 3]>,
}

/// Greatest number of displacements kept, of all tires and frames: 60 MB.
const MOST_KEPT: usize = 5_000_000;
/// Least and greatest number of frames kept; even, because a full recording is halved.
const FRAMES: [usize; 2] = [16, 1024];

/// Runs one option once, at its first step, and records frames.
///
/// Memory is bounded for runs of any length: a full recording drops every second frame.
///
/// # Panics
///
/// Where the plan has no delay option with the index `option`.
pub fn record(
    case: &Case,
    option: usize,
    compute: &ComputeSettings,
    control: &StudyControl,
) -> Result<Flight, NoResult> {
    let settings = case.run_settings(compute.method, compute.first_step(case));
    let tires = case.scene().tire_count();
    let most = (MOST_KEPT / tires.max(1)).clamp(FRAMES[0], FRAMES[1]) / 2 * 2;
    let (mut times, mut displacements) = (Vec::new(), Vec::new());
    // The shelter at rest, before the first hole.
    times.push(0.0);
    displacements.resize(tires, [0.0; 3]);
    let mut every = settings.step;
    let (mut latest, mut now) = (vec![[0.0; 3]; tires], 0.0);
    let outcome = case.model.run(&case.shots[option], &settings, &mut |motion| {
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
    Ok(Flight { option, outcome, tires, times, displacements })
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
    /// Time of the greatest force [s], or of the greatest height where no cable pulls.
    pub fn worst_moment(&self) -> f64 {
        let Outcome { height, force, .. } = &self.outcome;
        if force.value > 0.0 { force.time } else { height.time }
    }

    /// End of the run [s].
    pub fn end(&self) -> f64 {
        self.outcome.end.time
    }

    /// Elastic force of each cable of the scene at `time` [N] (`n_cables`); 0 where it is slack or broken.
    pub fn forces(&self, scene: &Scene, time: f64) -> Vec<f64> {
        let frame = self.at(time);
        let displacement = |tire: usize| Vector3::from(frame[tire].map(f64::from));
        let force = |cable: &Cable| cable.force(cable.between(cable.ends.map(displacement)).norm()).max(0.0);
        let mut forces: Vec<f64> = scene.cables.iter().map(force).collect();
        for broken in self.outcome.broken.iter().filter(|broken| broken.time <= time) {
            forces[broken.cable] = 0.0;
        }
        forces
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.times.len()
    }

    /// Displacements x, y and height [m] of all tires (`n_tires`) in the last frame up to `time` [s].
    pub fn at(&self, time: f64) -> &[[f32; 3]] {
        let after = self.times.partition_point(|&taken| taken <= time + 1e-9);
        let frame = after.saturating_sub(1);
        &self.displacements[frame * self.tires..(frame + 1) * self.tires]
    }
}
