//! The linear system of a Newton iteration, (K + 4M/h²) δ = r, and its solution by conjugate gradients.
//!
//! K is never assembled: a taut cable of length L contributes k [(1 − L₀/L) I + (L₀/L) d dᵀ] between its ends, d being its
//! direction. The matrix is symmetric, positive definite and at useful steps dominated by 4M/h², so a few iterations
//! preconditioned with its 3×3 diagonal blocks do.

use nalgebra::{Matrix3, Vector3};

use crate::scene::Scene;

/// Vectors of one linear solve, kept between solves.
#[derive(Clone, Debug)]
pub struct System {
    /// Tangent stiffness of each cable [N/m] (`n_cables`).
    tangent: Vec<Matrix3<f64>>,
    /// Diagonal blocks, inverted [m/N] (`n_tires`).
    preconditioner: Vec<Matrix3<f64>>,
    /// 4m/h² [N/m] (`n_tires`).
    inertia: Vec<f64>,
    /// 1 where a component is solved for, 0 where it is prescribed (`n_tires`).
    pub open: Vec<Vector3<f64>>,
    residual: Vec<Vector3<f64>>,
    scaled: Vec<Vector3<f64>>,
    direction: Vec<Vector3<f64>>,
    image: Vec<Vector3<f64>>,
    /// The solution δ [m] (`n_tires`).
    pub correction: Vec<Vector3<f64>>,
}

/// Relative residual at which conjugate gradients stop; Newton's own iterations remove what is left.
const TOLERANCE: f64 = 1e-8;

impl System {
    /// For `scene`, nothing prescribed.
    pub fn new(scene: &Scene) -> Self {
        let n = scene.mass.len();
        let vectors = || vec![Vector3::zeros(); n];
        Self {
            tangent: vec![Matrix3::zeros(); scene.cables.len()],
            preconditioner: vec![Matrix3::identity(); n],
            inertia: vec![0.0; n],
            open: vec![Vector3::repeat(1.0); n],
            residual: vectors(),
            scaled: vectors(),
            direction: vectors(),
            image: vectors(),
            correction: vectors(),
        }
    }

    /// Sets K at displacements `u` [m] with the cables in `taut`, and 4M/h² for the step `h` [s].
    pub fn assemble(&mut self, scene: &Scene, u: &[Vector3<f64>], taut: &[bool], h: f64) {
        for (tire, &mass) in scene.mass.iter().enumerate() {
            self.inertia[tire] = 4.0 * mass / (h * h);
            self.preconditioner[tire] = Matrix3::from_diagonal_element(self.inertia[tire]);
        }
        for (n, cable) in scene.cables.iter().enumerate() {
            self.tangent[n] = Matrix3::zeros();
            if !taut[n] {
                continue;
            }
            let span = cable.displaced(u);
            let length = span.norm().max(f64::MIN_POSITIVE);
            let direction = span / length;
            let shorter = cable.rest_length / length;
            self.tangent[n] = (Matrix3::from_diagonal_element(1.0 - shorter)
                + direction * direction.transpose() * shorter)
                * cable.stiffness;
            for end in cable.ends {
                self.preconditioner[end] += self.tangent[n];
            }
        }
        for (block, open) in self.preconditioner.iter_mut().zip(&self.open) {
            for c in 0..3 {
                if open[c] == 0.0 {
                    block.row_mut(c).fill(0.0);
                    block.column_mut(c).fill(0.0);
                    block[(c, c)] = 1.0;
                }
            }
            let diagonal = Matrix3::from_diagonal(&block.diagonal().map(|d| 1.0 / d));
            *block = block.try_inverse().unwrap_or(diagonal);
        }
    }

    /// Solves for the correction of `right` [N]; false when it does not converge within a bound.
    pub fn solve(&mut self, scene: &Scene, right: &[Vector3<f64>]) -> bool {
        let n = right.len();
        for tire in 0..n {
            self.residual[tire] = right[tire].component_mul(&self.open[tire]);
            self.correction[tire] = Vector3::zeros();
            self.scaled[tire] = self.preconditioner[tire] * self.residual[tire];
            self.direction[tire] = self.scaled[tire];
        }
        let mut along = dot(&self.residual, &self.scaled);
        let enough = along * TOLERANCE * TOLERANCE;
        for _ in 0..20 + 3 * n {
            if along <= enough {
                return true;
            }
            self.multiply(scene);
            let length = along / dot(&self.direction, &self.image);
            if !length.is_finite() {
                return false;
            }
            for tire in 0..n {
                self.correction[tire] += self.direction[tire] * length;
                self.residual[tire] -= self.image[tire] * length;
                self.scaled[tire] = self.preconditioner[tire] * self.residual[tire];
            }
            let next = dot(&self.residual, &self.scaled);
            for tire in 0..n {
                self.direction[tire] = self.scaled[tire] + self.direction[tire] * (next / along);
            }
            along = next;
        }
        false
    }

    /// image = (K + 4M/h²) direction.
    fn multiply(&mut self, scene: &Scene) {
        for (tire, image) in self.image.iter_mut().enumerate() {
            *image = self.direction[tire] * self.inertia[tire];
        }
        for (cable, tangent) in scene.cables.iter().zip(&self.tangent) {
            let [a, b] = cable.ends;
            let pull = tangent * (self.direction[b] - self.direction[a]);
            self.image[a] -= pull;
            self.image[b] += pull;
        }
        for (image, open) in self.image.iter_mut().zip(&self.open) {
            image.component_mul_assign(open);
        }
    }
}

fn dot(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}
