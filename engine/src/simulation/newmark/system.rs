//! The linear system of a Newton iteration, (K + 4M/h²) δ = r, and its solution by conjugate gradients.
//!
//! The system has one row for each tire that can move, and one link for each taut cable at such a tire. K is never assembled: a
//! link of length L and direction d contributes k [(1 − L₀/L) I + (L₀/L) d dᵀ] between its ends. The matrix is symmetric and
//! positive definite. At useful steps 4M/h² dominates it, so a few iterations reach the tolerance. The 3×3 diagonal blocks are the
//! preconditioner.

use nalgebra::{Matrix3, Vector3};

use super::region::{Region, TireContact};
use crate::scene::{Cable, Scene};
use crate::simulation::wake::Wake;

/// Row that stands for every tire that cannot move; its displacement stays 0.
const HELD: u32 = 0;

/// Rows and links of one linear solve; the memory is kept between solves.
#[derive(Clone, Debug)]
pub struct System {
    /// Rows; the first is [`HELD`].
    rows: Vec<Row>,
    links: Vec<Link>,
    /// Row of each tire during assembly; [`HELD`] at other times (`n_tires`).
    row: Vec<u32>,
}

/// A tire that can move.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    tire: usize,
    /// 4m/h² [N/m].
    inertia: f64,
    /// Whether the system solves for the height. Otherwise the ground prescribes the height.
    rises: bool,
    /// Inverse of the diagonal block [m/N].
    preconditioner: Matrix3<f64>,
    /// Residual: right side minus matrix times δ [N].
    residual: Vector3<f64>,
    /// Preconditioned residual [m].
    scaled: Vector3<f64>,
    /// Search direction of the present iteration [m].
    direction: Vector3<f64>,
    /// Matrix times the search direction [N].
    image: Vector3<f64>,
    /// δ [m].
    correction: Vector3<f64>,
}

/// A taut cable between two rows.
#[derive(Clone, Copy, Debug)]
struct Link {
    rows: [usize; 2],
    /// Tangent stiffness [N/m].
    tangent: Matrix3<f64>,
}

/// Relative residual at which conjugate gradients stop. The next Newton iterations remove the rest.
const TOLERANCE: f64 = 1e-4;
/// Iterations of conjugate gradients beyond the number of unknowns, which rounding may cost.
const STEPS_FOR_ROUNDING: usize = 20;

impl System {
    /// Empty system with room for every tire and cable of `scene`.
    pub fn new(scene: &Scene) -> Self {
        Self {
            rows: Vec::with_capacity(scene.tire_count() + 1),
            links: Vec::with_capacity(scene.cables.len()),
            row: vec![HELD; scene.tire_count()],
        }
    }

    /// Sets K for the displacements `u` [m] and the contact `region`, 4M/h² for the step `h` [s], and the right side r, `right` [N]
    /// (`u` and `right`: `n_tires`).
    pub fn assemble(
        &mut self,
        scene: &Scene,
        wake: &Wake<'_>,
        region: &Region,
        u: &[Vector3<f64>],
        right: &[Vector3<f64>],
        h: f64,
    ) {
        self.rows.clear();
        self.links.clear();
        self.rows.push(Row::default());
        for &tire in wake.awake_tires().iter().filter(|&&tire| region.ground[tire] != TireContact::Stick) {
            self.row[tire] = self.rows.len() as u32;
            let (inertia, rises) =
                (4.0 * scene.mass[tire] / (h * h), region.ground[tire] == TireContact::InAir);
            let mut residual = right[tire];
            residual.z = if rises { residual.z } else { 0.0 };
            let preconditioner = Matrix3::from_diagonal_element(inertia);
            self.rows.push(Row { tire, inertia, rises, preconditioner, residual, ..Row::default() });
        }
        for cable in wake.awake_cables().iter().filter(|&&n| region.taut[n]).map(|&n| &scene.cables[n]) {
            let rows = cable.ends.map(|end| self.row[end] as usize);
            if rows != [HELD as usize; 2] {
                let tangent = tangent(cable, u);
                for row in rows {
                    self.rows[row].preconditioner += tangent;
                }
                self.links.push(Link { rows, tangent });
            }
        }
        for row in &mut self.rows[1..] {
            row.invert_block();
            self.row[row.tire] = HELD;
        }
    }

    /// Solves for δ; returns whether the iteration converges within its bound.
    pub fn solve(&mut self) -> bool {
        for row in &mut self.rows[1..] {
            row.scaled = row.preconditioner * row.residual;
            row.direction = row.scaled;
        }
        let mut along = self.sum(|row| row.residual.dot(&row.scaled));
        let tolerance = along * TOLERANCE * TOLERANCE;
        // Without rounding, the iteration ends after as many steps as there are unknowns, three in each row.
        for _ in 0..STEPS_FOR_ROUNDING + 3 * self.rows.len() {
            if along <= tolerance {
                return true;
            }
            self.multiply();
            let length = along / self.sum(|row| row.direction.dot(&row.image));
            if !length.is_finite() {
                return false;
            }
            for row in &mut self.rows[1..] {
                row.correction += row.direction * length;
                row.residual -= row.image * length;
                row.scaled = row.preconditioner * row.residual;
            }
            let next = self.sum(|row| row.residual.dot(&row.scaled));
            for row in &mut self.rows[1..] {
                row.direction = row.scaled + row.direction * (next / along);
            }
            along = next;
        }
        false
    }

    /// Tires that can move, with their part of δ [m].
    pub fn corrections(&self) -> impl Iterator<Item = (usize, Vector3<f64>)> {
        self.rows[1..].iter().map(|row| (row.tire, row.correction))
    }

    /// Sum of a quantity over the rows of tires that can move.
    fn sum(&self, of: impl Fn(&Row) -> f64) -> f64 {
        self.rows[1..].iter().map(of).sum()
    }

    /// Sets image = (K + 4M/h²) direction.
    fn multiply(&mut self) {
        for row in &mut self.rows {
            row.image = row.direction * row.inertia;
        }
        for Link { rows: [a, b], tangent } in &self.links {
            let force = tangent * (self.rows[*b].direction - self.rows[*a].direction);
            self.rows[*a].image -= force;
            self.rows[*b].image += force;
        }
        for row in self.rows.iter_mut().filter(|row| !row.rises) {
            row.image.z = 0.0;
        }
    }
}

impl Row {
    /// Inverts the diagonal block. The inverse is the preconditioner.
    fn invert_block(&mut self) {
        let block = &mut self.preconditioner;
        if !self.rises {
            block.row_mut(2).fill(0.0);
            block.column_mut(2).fill(0.0);
            block[(2, 2)] = 1.0;
        }
        let diagonal = Matrix3::from_diagonal(&block.diagonal().map(|d| 1.0 / d));
        *block = block.try_inverse().unwrap_or(diagonal);
    }
}

/// Tangent stiffness of a taut cable at displacements `u` [N/m].
fn tangent(cable: &Cable, u: &[Vector3<f64>]) -> Matrix3<f64> {
    let span = cable.displaced(u);
    let length = span.norm().max(f64::MIN_POSITIVE);
    let direction = span / length;
    let shorter = cable.rest_length / length;
    (Matrix3::from_diagonal_element(1.0 - shorter) + direction * direction.transpose() * shorter)
        * cable.stiffness
}
