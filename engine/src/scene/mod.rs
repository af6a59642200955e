//! Shelter and shot as flat arrays in SI units, made once for the stepping loops: an immutable [`Scene`] (masses, cables, ground)
//! and a [`Shot`] (its firings).
//!
//! This module does not know where the arrays come from, or how motion is computed and judged.

mod mirror;
mod shot;

use std::collections::BTreeMap;

use nalgebra::{Vector2, Vector3};

pub use mirror::Mirror;
pub use shot::{
    ASSUMED_PUSH_DEPTH, BeginnerFires, Firing, FiringNumbers, PushLine, Shot, Side, Wiring,
    direction_of_slope,
};

/// The shelter at rest, before any hole fires.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Centres of the tires at rest [m] (`n_tires`).
    pub position: Vec<Vector3<f64>>,
    /// Masses [kg]; infinite for an anchor, which nothing moves (`n_tires`).
    pub mass: Vec<f64>,
    /// Address of each tire in the plan (`n_tires`).
    pub tire_ids: Vec<TireId>,
    /// Cables (`n_cables`).
    pub cables: Vec<Cable>,
    /// Coefficient of friction; a shot may have its own ([`Shot::friction`]).
    pub friction: f64,
    /// Gravity into the ground [m/s²].
    pub gravity: f64,
    /// Gravity along the ground, down the slope [m/s²]; 0 on level ground.
    pub downhill: Vector2<f64>,
    /// Restitution: normal speed of a tire after a landing over its normal speed before.
    pub restitution: f64,
    /// Damping ratio ζ of each cable: damping over critical damping. [`Scene::viscosity`] gives the viscosity of a cable.
    pub damping: f64,
    /// Force above which a cable breaks [N]; `None`: cables never break.
    pub breaking_force: Option<f64>,
    /// Strength of each cable: its breaking force over the breaking force of the plan (`n_cables`). Empty if all cables are equal.
    pub strength: Vec<f64>,
    /// Mirror planes of the shelter: at most one across x and one across y.
    pub mirrors: Vec<Mirror>,
}

/// Address of a tire in a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TireId {
    /// Row and column of a tire in a mesh, counted from 1. The centre tires of a quincunx have half numbers.
    Cell {
        /// Row, counted along y.
        row: f64,
        /// Column, counted along x.
        column: f64,
    },
    /// Row and column of a border tire around a mesh. At least one of the two is below 1 or above the last of the mesh.
    Border {
        /// Row, counted along y.
        row: f64,
        /// Column, counted along x.
        column: f64,
    },
    /// Number in a list layout, from 1.
    Listed(usize),
}

impl TireId {
    /// Numbers of the address: row and column, or the number in the list.
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
    /// Stiffness k [N/m]: EA over the rope's own length, in series with the two ends of the rope.
    pub stiffness: f64,
    /// Vector from the first fastening to the second at rest [m], between the centres of the tires or between their rims. Tires do
    /// not turn, so displacements add to this vector.
    pub span: Vector3<f64>,
}

impl Cable {
    /// Span of the cable [m] under the displacements of all tires [m] (`n_tires`).
    pub fn displaced(&self, displacement: &[Vector3<f64>]) -> Vector3<f64> {
        self.between(self.ends.map(|end| displacement[end]))
    }

    /// Span of the cable [m] under the displacements `a` and `b` of its two tires [m].
    pub fn between(&self, [a, b]: [Vector3<f64>; 2]) -> Vector3<f64> {
        self.span + (b - a)
    }

    /// Force k (L − L0) at the length L [N]: the force of a taut cable, negative for a slack cable.
    pub fn stretch_force(&self, length: f64) -> f64 {
        self.stiffness * (length - self.rest_length)
    }

    /// Cable force N at the length L [N].
    pub fn force(&self, length: f64) -> f64 {
        self.stretch_force(length).max(0.0)
    }

    /// Elastic energy N²/2k at the length L [J].
    pub fn energy(&self, length: f64) -> f64 {
        let force = self.force(length);
        0.5 * force * force / self.stiffness
    }
}

/// Stiffness k [N/m] of a rope in series with its two ends: 1/k = 1/`rope` + 2/`end`. `None`: the ends do not yield.
pub fn with_ends(rope: f64, end: Option<f64>) -> f64 {
    end.map_or(rope, |end| rope * end / (end + 2.0 * rope))
}

impl Scene {
    /// Number of tires.
    pub fn tire_count(&self) -> usize {
        self.mass.len()
    }

    /// Whether a tire is an anchor: a fixed point that no cable moves.
    pub fn is_anchor(&self, tire: usize) -> bool {
        self.mass[tire].is_infinite()
    }

    /// Gravity as a vector [m/s²]; the third axis is the ground's normal.
    pub fn gravity(&self) -> Vector3<f64> {
        self.downhill.push(-self.gravity)
    }

    /// Whether tires at rest slide down the slope under the coefficient of friction `friction`.
    pub fn slides(&self, friction: f64) -> bool {
        self.downhill.norm() > friction * self.gravity
    }

    /// Address of a cable: the addresses of its two tires; empty for a scene without cables.
    pub fn cable_name(&self, cable: usize) -> String {
        self.cables.get(cable).map_or_else(String::new, |cable| {
            let [a, b] = cable.ends.map(|end| self.tire_ids[end]);
            format!("{a}-{b}")
        })
    }

    /// Strength of a cable: its breaking force over the breaking force of the plan.
    pub fn strength(&self, cable: usize) -> f64 {
        self.strength.get(cable).copied().unwrap_or(1.0)
    }

    /// Upper bound of the natural frequencies ω of the shelter [rad/s].
    ///
    /// ω² ≤ (2/m) Σ k over the cables of a tire; the tire with the greatest sum counts. This is Gershgorin's bound on M⁻¹K with
    /// every cable taut and in line.
    pub fn frequency_bound(&self) -> f64 {
        self.rate_bound(|cable| cable.stiffness).sqrt()
    }

    /// Greatest (2/m) Σ of `value` over the cables of a tire, among all tires.
    fn rate_bound(&self, value: impl Fn(&Cable) -> f64) -> f64 {
        let mut sums = vec![0.0; self.mass.len()];
        for cable in &self.cables {
            for end in cable.ends {
                sums[end] += value(cable);
            }
        }
        sums.iter().zip(&self.mass).map(|(sum, mass)| 2.0 * sum / mass).fold(0.0, f64::max)
    }

    /// Viscosity c of a cable [N s/m]: force over the speed at which the cable lengthens. c = 2ζ √(k μ) with the reduced mass μ of
    /// the two tires; 0 between two anchors.
    pub fn viscosity(&self, cable: &Cable) -> f64 {
        let [a, b] = cable.ends.map(|end| self.mass[end]);
        let critical = match [a, b].map(f64::is_finite) {
            [true, true] => cable.stiffness * a * b / (a + b),
            [true, false] => cable.stiffness * a,
            [false, true] => cable.stiffness * b,
            [false, false] => 0.0,
        };
        2.0 * self.damping * critical.sqrt()
    }

    /// Least and greatest coordinate of the tires at rest along an axis [m]; axis 0 is x, 1 is y.
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let coordinates = self.position.iter().map(|position| position[axis]);
        coordinates.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Row numbers of a mesh with their y [m], and column numbers with their x [m]. Both are empty for a list of tires.
    pub fn rows_and_columns(&self) -> [BTreeMap<i64, f64>; 2] {
        let (mut rows, mut columns, mut first) = (BTreeMap::new(), BTreeMap::new(), None);
        for (tire, position) in self.tire_ids.iter().zip(&self.position) {
            let (TireId::Cell { row, column } | TireId::Border { row, column }) = *tire else { continue };
            // The first row holds every column, and the first column every row. The centre tires of a quincunx are in neither of
            // the two.
            let (first_row, first_column) = *first.get_or_insert((row, column));
            if column == first_column {
                rows.insert(row as i64, position.y);
            }
            if row == first_row {
                columns.insert(column as i64, position.x);
            }
        }
        [rows, columns]
    }

    /// Critical step of explicit central differences [s]; infinite without cables.
    ///
    /// Symbols: h step; ω frequency of a swing; c viscosity; μ reduced mass; γ = c/μ damping rate.
    ///
    /// 1. Without damping the critical step is 2/ω.
    /// 2. With damping, the rate in the damping force is extrapolated from the two steps before. The swing then stays bounded for
    ///    h² ω² + 4 γ h ≤ 4. At equality its fastest root is −1.
    /// 3. Equality gives the critical step h = 2/(√(ω² + γ²) + γ).
    pub fn critical_step(&self) -> f64 {
        let frequency = self.frequency_bound();
        let rate = if self.damping > 0.0 { self.rate_bound(|cable| self.viscosity(cable)) } else { 0.0 };
        2.0 / (libm::hypot(frequency, rate) + rate)
    }
}
