//! The linear system of a Newton iteration, (K + 4M/h²) δ = r, and its solution by conjugate gradients.
//!
//! It has a row for every tire that can move and a link for every taut cable at such a tire. K is never assembled: a link of
//! length L contributes k [(1 − L₀/L) I + (L₀/L) d dᵀ] between its ends, d being its direction. The matrix is symmetric,
//! positive definite and at useful steps dominated by 4M/h², so a few iterations preconditioned with its 3×3 diagonal blocks
//! do.

use nalgebra::{Matrix3, Vector3};

use super::region::{Ground, Region};
use crate::scene::{Cable, Scene};
use crate::simulation::wake::Wake;

/// The row that stands for every tire that is held; it stays at rest.
const HELD: u32 = 0;

/// Rows and links of one linear solve; their memory is kept between solves.
#[derive(Clone, Debug)]
pub struct System {
    /// The first stands for every tire that is held.
    rows: Vec<Row>,
    links: Vec<Link>,
    /// By tire, its row; [`HELD`] between one assembly and the next (`n_tires`).
    row: Vec<u32>,
}

/// A tire that can move.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    tire: usize,
    /// 4m/h² [N/m].
    inertia: f64,
    /// Whether its height is solved for, not prescribed by the ground.
    rises: bool,
    /// The diagonal block, inverted [m/N].
    preconditioner: Matrix3<f64>,
    /// What δ leaves of the right side [N], and preconditioned [m].
    residual: Vector3<f64>,
    scaled: Vector3<f64>,
    /// Where the present iteration goes, and the matrix times that.
    direction: Vector3<f64>,
    image: Vector3<f64>,
    /// δ [m].
    correction: Vector3<f64>,
}

/// A taut cable.
#[derive(Clone, Copy, Debug)]
struct Link {
    rows: [usize; 2],
    /// Tangent stiffness [N/m].
    tangent: Matrix3<f64>,
}

/// Relative residual at which conjugate gradients stop; Newton's own iterations remove what is left.
const TOLERANCE: f64 = 1e-4;

impl System {
    /// With room for every tire and cable of `scene`.
    pub fn new(scene: &Scene) -> Self {
        Self {
            rows: Vec::with_capacity(scene.mass.len() + 1),
            links: Vec::with_capacity(scene.cables.len()),
            row: vec![HELD; scene.mass.len()],
        }
    }

    /// Sets K at displacements `u` [m] for the contact `region`, 4M/h² for the step `h` [s], and the right side [N]
    /// (both `n_tires`).
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
        for &tire in wake.awake.iter().filter(|&&tire| region.ground[tire] != Ground::Stick) {
            self.row[tire] = self.rows.len() as u32;
            let (inertia, rises) = (4.0 * scene.mass[tire] / (h * h), region.ground[tire] == Ground::Free);
            let mut residual = right[tire];
            residual.z = if rises { residual.z } else { 0.0 };
            let preconditioner = Matrix3::from_diagonal_element(inertia);
            self.rows.push(Row { tire, inertia, rises, preconditioner, residual, ..Row::default() });
        }
        for cable in wake.blocks.iter().filter(|&&n| region.taut[n]).map(|&n| &scene.cables[n]) {
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

    /// Solves for the correction; false when it does not converge within a bound.
    pub fn solve(&mut self) -> bool {
        for row in &mut self.rows[1..] {
            row.scaled = row.preconditioner * row.residual;
            row.direction = row.scaled;
        }
        let mut along = self.sum(|row| row.residual.dot(&row.scaled));
        let enough = along * TOLERANCE * TOLERANCE;
        for _ in 0..20 + 3 * self.rows.len() {
            if along <= enough {
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

    /// Tires that can move and their part of the solution [m].
    pub fn corrections(&self) -> impl Iterator<Item = (usize, Vector3<f64>)> {
        self.rows[1..].iter().map(|row| (row.tire, row.correction))
    }

    fn sum(&self, of: impl Fn(&Row) -> f64) -> f64 {
        self.rows[1..].iter().map(of).sum()
    }

    /// image = (K + 4M/h²) direction.
    fn multiply(&mut self) {
        for row in &mut self.rows {
            row.image = row.direction * row.inertia;
        }
        for Link { rows: [a, b], tangent } in &self.links {
            let pull = tangent * (self.rows[*b].direction - self.rows[*a].direction);
            self.rows[*a].image -= pull;
            self.rows[*b].image += pull;
        }
        for row in self.rows.iter_mut().filter(|row| !row.rises) {
            row.image.z = 0.0;
        }
    }
}

impl Row {
    /// Makes the diagonal block the preconditioner.
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
