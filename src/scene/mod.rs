//! The shelter and the shot as flat arrays in SI units, made once per plan for the stepping loops.
//!
//! A [`Plan`](crate::plan::Plan) comes in; an immutable [`Scene`] (masses, cables, ground) and one [`Shot`] (what fires
//! when) per delay option go out. Nothing here knows how motion is computed or judged.

mod build;
mod mirror;
mod shot;

use nalgebra::Vector3;

pub use mirror::Mirror;
pub use shot::{Firing, Shot, fire_at_s};

/// What lies on the ground before anything fires.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Centres of the tires at rest [m] (`n_tires`).
    pub position: Vec<Vector3<f64>>,
    /// Masses [kg] (`n_tires`).
    pub mass: Vec<f64>,
    /// How the plan addresses each tire (`n_tires`).
    pub tire: Vec<TireId>,
    /// Cables (`n_cables`).
    pub cables: Vec<Cable>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// Force past which a cable is gone [N]; `None`: cables never break.
    pub breaking_force: Option<f64>,
    /// Planes in which the shelter is its own image; at most one across x and one across y.
    pub mirrors: Vec<Mirror>,
}

/// How a plan addresses a tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TireId {
    /// Row and column of a mesh, from 1; half numbers are centres of a quincunx.
    Cell {
        /// Along y.
        row: f64,
        /// Along x.
        column: f64,
    },
    /// Ballast around a mesh, numbered on from it: from 0 downwards, or from one past the last.
    Border {
        /// Along y.
        row: f64,
        /// Along x.
        column: f64,
    },
    /// Place in a list layout, from 1.
    Listed(usize),
}

impl TireId {
    /// The numbers of the address: row and column, or the place in the list.
    pub fn numbers(&self) -> Vec<f64> {
        match *self {
            TireId::Cell { row, column } | TireId::Border { row, column } => vec![row, column],
            TireId::Listed(n) => vec![n as f64],
        }
    }
}

impl std::fmt::Display for TireId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TireId::Cell { row, column } | TireId::Border { row, column } => write!(f, "{row}:{column}"),
            TireId::Listed(n) => write!(f, "{n}"),
        }
    }
}

/// A cable that only pulls: N = k (L − L0) when L > L0, else 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable {
    /// Indices of its two tires.
    pub ends: [usize; 2],
    /// Unstretched length L0 [m].
    pub rest_length: f64,
    /// k = EA / L0 [N/m].
    pub stiffness: f64,
    /// From its first to its second fastening at rest [m]: the centres' distance, less one diameter
    /// where cables run from rim to rim. Tires do not turn, so displacements simply add to it.
    pub span: Vector3<f64>,
}

impl Cable {
    /// The cable's span when its tires are displaced [m].
    pub fn displaced(&self, displacement: &[Vector3<f64>]) -> Vector3<f64> {
        self.between(self.ends.map(|end| displacement[end]))
    }

    /// The cable's span between tires displaced by `a` and `b` [m].
    pub fn between(&self, [a, b]: [Vector3<f64>; 2]) -> Vector3<f64> {
        self.span + (b - a)
    }

    /// k (L − L0) at a given length L [N]: the cable force of a taut cable, negative for a slack cable.
    pub fn stretch_force(&self, length: f64) -> f64 {
        self.stiffness * (length - self.rest_length)
    }

    /// Cable force N at a given length [N].
    pub fn force(&self, length: f64) -> f64 {
        self.stretch_force(length).max(0.0)
    }

    /// Elastic energy N²/2k at a given length [J].
    pub fn energy(&self, length: f64) -> f64 {
        let force = self.force(length);
        0.5 * force * force / self.stiffness
    }
}

impl Scene {
    /// How views address a cable: its two tires; empty for a scene without cables.
    pub fn cable_name(&self, cable: usize) -> String {
        self.cables.get(cable).map_or_else(String::new, |cable| {
            let [a, b] = cable.ends.map(|end| self.tire[end]);
            format!("{a}-{b}")
        })
    }

    /// Greatest natural frequency bound of any tire: ω² ≤ (2/m) Σ k over its cables [rad/s].
    ///
    /// Gershgorin's bound on M⁻¹K with every cable taut and in line.
    pub fn frequency_bound(&self) -> f64 {
        let mut stiffness = vec![0.0; self.mass.len()];
        for cable in &self.cables {
            for end in cable.ends {
                stiffness[end] += cable.stiffness;
            }
        }
        let squared = stiffness.iter().zip(&self.mass).map(|(k, m)| 2.0 * k / m);
        squared.fold(0.0, f64::max).sqrt()
    }

    /// Least and greatest place of the tires at rest along an axis [m].
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let places = self.position.iter().map(|place| place[axis]);
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Critical step of explicit central differences, 2/ω [s]; infinite without cables.
    pub fn critical_step(&self) -> f64 {
        2.0 / self.frequency_bound()
    }
}
