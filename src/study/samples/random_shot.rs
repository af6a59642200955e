//! Draws the shots that `[uncertainty]` describes.
//!
//! A sample is a variant of the scene and a shot. Every draw follows from the seed, the number of the sample, and what it is for:
//! an input of the whole shot, a gap between blast rows, a blast row, a tire, or a cable. So a sample does not depend on threads,
//! shards, accuracy or the order of options, and the options of a plan are compared on the same draws.
//!
//! Factors on launch velocities, masses and breaking forces are lognormal with mean 1. A hole's launch velocity belongs to a
//! tire of the plan's mass: a tire of another mass leaves with the same momentum. Each gap between blast rows scatters by itself
//! and shifts all later rows; so does each gap between the holes of a row, which shifts the later
//! holes of its side.
//!
//! Functions such as the exponential come from `libm`, not from the system, whose last digits differ from another's.

use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::plan::Uncertainty;
use crate::plan::keys::{Key, uncertainty};
use crate::scene::{Firing, Scene, Shot};
use crate::study::Case;

/// An input that is the same in the whole shot, and not known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Factor on all launch velocities.
    LaunchCommon,
    /// Coefficient of friction.
    Friction,
    /// Slack of all cables [%].
    Slack,
    /// Factor on the axial stiffness of all cables.
    AxialStiffness,
}

impl Input {
    /// Every input, in the order of the values of [`DrawnShot::inputs`].
    pub const ALL: [Input; 4] = [Input::LaunchCommon, Input::Friction, Input::Slack, Input::AxialStiffness];

    /// The key of a plan that says how well the input is known.
    pub fn key(self) -> &'static Key {
        match self {
            Input::LaunchCommon => &uncertainty::LAUNCH_COMMON_PERCENT,
            Input::Friction => &uncertainty::FRICTION,
            Input::Slack => &uncertainty::SLACK_PERCENT,
            Input::AxialStiffness => &uncertainty::AXIAL_STIFFNESS_PERCENT,
        }
    }
}

/// What was drawn for one sample: its shelter and its shot.
#[derive(Clone, Debug)]
pub struct DrawnShot {
    /// The shelter with the numbers of the sample.
    pub scene: Scene,
    /// The shot with the numbers of the sample.
    pub shot: Shot,
    /// Values of the inputs in [`Input::ALL`].
    pub inputs: [f64; Input::ALL.len()],
    /// How much later than drawn all holes fire, so that none fires before time 0 [s].
    pub later: f64,
}

/// The random numbers of one sample, kept apart by what they are for.
struct Random(ChaCha8Rng);

/// What draws within a sample are for.
#[derive(Clone, Copy)]
enum Draws {
    WholeShot,
    Gaps,
    BlastRow(usize),
    Tire(usize),
    Cable(usize),
}

impl Random {
    fn new(seed: u64, number: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(number as u64);
        Self(random)
    }

    /// Moves to the random numbers of these draws. A tire has room for a hundred thousand holes.
    fn at(&mut self, draws: Draws) -> &mut ChaCha8Rng {
        let word = match draws {
            Draws::WholeShot => 0,
            Draws::Gaps => 1 << 32,
            Draws::BlastRow(row) => (1 << 40) + ((row as u128) << 20),
            Draws::Tire(tire) => (1 << 44) + ((tire as u128) << 20),
            Draws::Cable(cable) => (1 << 60) + ((cable as u128) << 6),
        };
        self.0.set_word_pos(word);
        &mut self.0
    }
}

/// Factor with mean 1 and a coefficient of variation [%], lognormal.
fn factor(random: &mut ChaCha8Rng, cv_percent: f64) -> f64 {
    let variance = libm::log1p((cv_percent * 1e-2).powi(2));
    libm::exp(variance.sqrt() * normal(random) - 0.5 * variance)
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Draws sample `number` of the shots that the plan describes beside `planned`.
pub fn draw_shot(case: &Case, planned: &Shot, seed: u64, number: usize) -> DrawnShot {
    let uncertainty = &case.plan.uncertainty;
    let mut random = Random::new(seed, number);
    let whole = random.at(Draws::WholeShot);
    let launch_common = factor(whole, uncertainty.launch_common_percent);
    let mut between = |[low, high]: [f64; 2]| low + (high - low) * whole.random::<f64>();
    let friction = between(uncertainty.friction);
    let slack_percent = between(uncertainty.slack_percent);
    let stiffness = 1.0 + 1e-2 * between(uncertainty.axial_stiffness_percent);

    let mut firings = planned.firings.clone();
    scatter_gaps(&mut firings, uncertainty, &mut random);
    let mut scene = case.scene().clone();
    scatter_tires(&mut scene, &mut firings, uncertainty, launch_common, &mut random);
    scene.change_cables(&case.plan.cable, slack_percent, stiffness);
    if uncertainty.breaking_force_cv_percent > 0.0 {
        let strength = |cable| factor(random.at(Draws::Cable(cable)), uncertainty.breaking_force_cv_percent);
        scene.strength = (0..scene.cables.len()).map(strength).collect();
    }
    if uncertainty.tire_mass_cv_percent > 0.0 || uncertainty.breaking_force_cv_percent > 0.0 {
        scene.mirrors.clear();
    }
    // No firing may be before the start: all are shifted, and so is the end of the run.
    let later = -firings.iter().map(|firing| firing.time).fold(0.0, f64::min);
    firings.iter_mut().for_each(|firing| firing.time += later);
    let shot = Shot { friction: Some(friction), ..Shot::from_firings(firings) };
    DrawnShot { scene, shot, inputs: [launch_common, friction, slack_percent, stiffness], later }
}

/// Shifts the firings [s], which are in order of time, by the scatter of the gaps before them: of the gaps between the rows, and
/// of those between the holes of their row.
fn scatter_gaps(firings: &mut [Firing], uncertainty: &Uncertainty, random: &mut Random) {
    let rows = firings.iter().map(|firing| firing.row + 1).max().unwrap_or(0);
    let mut holes: Vec<Vec<usize>> = vec![Vec::new(); rows];
    firings.iter().enumerate().for_each(|(n, firing)| holes[firing.row].push(n));
    let mut by_start: Vec<&[usize]> = holes.iter().map(Vec::as_slice).filter(|row| !row.is_empty()).collect();
    by_start.sort_by(|a, b| firings[a[0]].time.total_cmp(&firings[b[0]].time));
    let starts: Vec<f64> = by_start.iter().map(|row| firings[row[0]].time).collect();
    let scattered_starts = scatter_chain(&starts, uncertainty, random.at(Draws::Gaps));
    for (row, start) in by_start.into_iter().zip(scattered_starts) {
        let first = firings[row[0]].time;
        let random = random.at(Draws::BlastRow(firings[row[0]].row));
        for side in split_by_side(row, firings) {
            let planned: Vec<f64> =
                [first].into_iter().chain(side.iter().map(|&n| firings[n].time)).collect();
            let scattered = scatter_chain(&planned, uncertainty, random);
            for (n, at) in side.into_iter().zip(&scattered[1..]) {
                firings[n].time = at - first + start;
            }
        }
    }
}

/// The chains in which the holes of a row fire one another, from its first hole on: of holes that are planned for one time, each
/// belongs to a chain of its own, such as the two sides of a row fired from its middle.
fn split_by_side(row: &[usize], firings: &[Firing]) -> Vec<Vec<usize>> {
    let mut sides: Vec<Vec<usize>> = Vec::new();
    for together in row.chunk_by(|&a, &b| firings[a].time == firings[b].time) {
        for (side, &hole) in together.iter().enumerate() {
            if side == sides.len() {
                sides.push(Vec::new());
            }
            sides[side].push(hole);
        }
    }
    sides
}

/// Firing times [s] of which each fires the next: every gap between `planned` times, which are in order, scatters and shifts all
/// that follow. A gap stays a delay: it is never negative.
fn scatter_chain(planned: &[f64], uncertainty: &Uncertainty, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut at = planned.to_vec();
    for n in 1..planned.len() {
        let gap = planned[n] - planned[n - 1];
        at[n] = match gap > 0.0 {
            true => at[n - 1] + (gap + uncertainty.delay.deviation(gap) * normal(random)).max(0.0),
            false => at[n - 1],
        };
    }
    at
}

/// A vector turned about an axis, by the length of the axis [rad] (Rodrigues).
fn rotated(vector: Vector3<f64>, axis: Vector3<f64>) -> Vector3<f64> {
    let angle = axis.norm();
    if angle == 0.0 {
        return vector;
    }
    let (axis, (sin, cos)) = (axis / angle, libm::sincos(angle));
    vector * cos + axis.cross(&vector) * sin + axis * (axis.dot(&vector) * (1.0 - cos))
}

/// Scatters masses tire by tire, and launches and in-hole delays hole by hole.
fn scatter_tires(
    scene: &mut Scene,
    firings: &mut [Firing],
    uncertainty: &Uncertainty,
    launch_common: f64,
    random: &mut Random,
) {
    let mut above: Vec<Vec<usize>> = vec![Vec::new(); scene.tire_count()];
    firings.iter().enumerate().for_each(|(n, firing)| above[firing.tire].push(n));
    let in_hole = uncertainty.in_hole_deviation();
    let tilt = uncertainty.launch_tilt_deg.to_radians();
    for (tire, mass) in scene.mass.iter_mut().enumerate() {
        let random = random.at(Draws::Tire(tire));
        let heavier = factor(random, uncertainty.tire_mass_cv_percent);
        *mass *= heavier;
        for &hole in &above[tire] {
            let firing = &mut firings[hole];
            let faster = launch_common * factor(random, uncertainty.launch_cv_percent) / heavier;
            let axis = Vector3::new(normal(random), normal(random), 0.0) * tilt;
            firing.launch = rotated(firing.launch, axis) * faster;
            firing.time += in_hole * normal(random);
        }
    }
}
