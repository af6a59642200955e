//! Scenes of masses, ties, anchors and constant pulls, with which the problems of others are set up for the program.
//!
//! In a rig without gravity into the ground, the ground neither carries nor rubs, so that motion along it is motion in any plane, an
//! upright one as well: there weight is gravity down a slope ([`Rig::upright`]). Where a single mass is pulled with a constant force,
//! the force is a soft tie to an anchor [`FAR`] metres away, which a way of a metre slackens by two parts in 10⁸.

use std::ops::ControlFlow;

use nalgebra::{Vector2, Vector3};
use shelter::choice::Method;
use shelter::outcome::Outcome;
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};
use shelter::simulation::{Model, Motion, RunError, RunSettings};

/// Distance of the anchors that pull with constant force [m].
const FAR: f64 = 1e8;

/// Gravity [m/s²] where a problem does not name its own.
pub const GRAVITY: f64 = 9.81;

pub struct Rig {
    pub scene: Scene,
    launches: Vec<Firing>,
}

impl Rig {
    /// Empty rig on level ground, with gravity [m/s²] and a coefficient of friction.
    pub fn new(gravity: f64, friction: f64) -> Self {
        let scene = Scene {
            position: Vec::new(),
            mass: Vec::new(),
            tire_ids: Vec::new(),
            cables: Vec::new(),
            friction,
            gravity,
            downhill: Vector2::zeros(),
            restitution: 0.0,
            damping: 0.0,
            breaking_force: None,
            strength: Vec::new(),
            mirrors: Vec::new(),
        };
        Self { scene, launches: Vec::new() }
    }

    /// Empty rig in an upright plane: gravity [m/s²] points toward −y, and there is no ground.
    pub fn upright(gravity: f64) -> Self {
        let mut rig = Self::new(0.0, 0.0);
        rig.scene.downhill = -Vector2::y() * gravity;
        rig
    }

    /// Adds a mass [kg] at a place [m], launched at once with a velocity [m/s]; returns its index.
    pub fn mass(&mut self, mass: f64, place: Vector3<f64>, velocity: Vector3<f64>) -> usize {
        let tire = self.add(mass, place);
        // A launch of 0 wakes a tire that pulls set in motion.
        self.launches.push(Firing::at_once(0.0, tire, velocity));
        tire
    }

    /// Adds an anchor at a place [m]; returns its index.
    pub fn anchor(&mut self, place: Vector3<f64>) -> usize {
        self.add(f64::INFINITY, place)
    }

    fn add(&mut self, mass: f64, place: Vector3<f64>) -> usize {
        let tire = self.scene.mass.len();
        self.scene.position.push(place);
        self.scene.mass.push(mass);
        self.scene.tire_ids.push(TireId::Listed(tire + 1));
        tire
    }

    /// Ties two masses with a tie of a length [m] and a stiffness [N/m]; returns its index.
    pub fn tie(&mut self, ends: [usize; 2], length: f64, stiffness: f64) -> usize {
        let span = self.scene.position[ends[1]] - self.scene.position[ends[0]];
        self.scene.cables.push(Cable { ends, rest_length: length, stiffness, span });
        self.scene.cables.len() - 1
    }

    /// Pulls a mass with a constant force [N].
    pub fn pull(&mut self, tire: usize, force: Vector3<f64>) {
        let from = self.anchor(self.scene.position[tire] + force.normalize() * FAR);
        self.tie([tire, from], 0.5 * FAR, force.norm() / (0.5 * FAR));
    }

    /// Moves the rig until `end` [s]; `see` sees every step.
    pub fn run(
        self,
        method: Method,
        step: f64,
        end: f64,
        mut see: impl FnMut(&dyn Motion),
    ) -> Result<Outcome, RunError> {
        let settings = RunSettings { method, step, duration: Some(end) };
        Model::new(self.scene).run(&Shot::from_firings(self.launches), &settings, &mut |motion| {
            see(motion);
            ControlFlow::Continue(())
        })
    }
}

/// A quantity at the times of the steps: times [s] and values.
#[derive(Default)]
pub struct History(pub Vec<[f64; 2]>);

impl History {
    /// Turning points: times [s] and values, by the parabola through three steps.
    pub fn turning_points(&self) -> Vec<[f64; 2]> {
        let turns = |three: &[[f64; 2]]| {
            let [before, at, after] = [0, 1, 2].map(|n| three[n][1]);
            let (slope, bend) = (0.5 * (after - before), after - 2.0 * at + before);
            let turns = (at > before && at >= after) || (at < before && at <= after);
            let part = -slope / bend;
            let step = 0.5 * (three[2][0] - three[0][0]);
            turns.then(|| [three[1][0] + part * step, at + 0.5 * slope * part])
        };
        self.0.windows(3).filter_map(turns).collect()
    }

    /// Time [s] at which the quantity first rises above `value`, and its rate [1/s] there, by the parabola through three steps.
    pub fn passage(&self, value: f64) -> Option<[f64; 2]> {
        let over = self.0.iter().position(|[_, now]| *now > value)?.max(2);
        let [[_, y0], [t1, y1], [t2, y2]] = [0, 1, 2].map(|n| self.0[over - 2 + n]);
        let (step, slope, bend) = (t2 - t1, 0.5 * (y2 - y0), y2 - 2.0 * y1 + y0);
        let left = value - y1;
        let root = (slope * slope + 2.0 * bend * left).max(0.0).sqrt();
        Some([t1 + step * 2.0 * left / (slope + root), root / step])
    }
}
