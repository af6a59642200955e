//! One cut of a step: Newton–Raphson for an assumed contact region, repeated until the region no longer changes.

use nalgebra::Vector3;

use super::Stepper;
use super::region::{MOST_REPEATS, TireContact};
use crate::scene::{Cable, Scene};
use crate::simulation::wake::Wake;
use crate::simulation::{Iteration, RunError};

/// Greatest number of Newton iterations. After these, the step is halved. Where Newton converges, each iteration doubles the number
/// of right digits, and five reach [`FINE_TOLERANCE`]. Friction that changes its direction takes some more.
const MOST_ITERATIONS: usize = 20;
/// Greatest number of times that a step is halved. After these, the run fails: 1/256 of a useful step is of no use.
const MOST_STEP_HALVINGS: usize = 8;
/// Newton stops at a correction of this size, relative to the displacement over the step, while the contact region is sought.
const COARSE_TOLERANCE: f64 = 1e-4;
/// The same once the contact region no longer changes: far below the error of the step, and far above rounding.
const FINE_TOLERANCE: f64 = 1e-10;

impl Stepper<'_> {
    /// Integrates one cut of a step over `h` [s]. Halves the cut if Newton or the contact region does not converge.
    pub(super) fn advance(&mut self, h: f64, halved: usize) -> Result<(), RunError> {
        match self.solve_until_region_agrees(h) {
            Err(RunError::NotConverged { .. }) if halved < MOST_STEP_HALVINGS => {
                self.advance(0.5 * h, halved + 1)?;
                self.advance(0.5 * h, halved + 1)
            }
            settled => settled,
        }
    }

    /// Integrates over `h` [s]. Repeats the solution until the contact region no longer changes.
    fn solve_until_region_agrees(&mut self, h: f64) -> Result<(), RunError> {
        self.refresh();
        self.set_start_forces();
        self.release_tires();
        self.set_accelerations();
        self.predict(h);
        let mut tolerance = COARSE_TOLERANCE;
        for repeats in 0..MOST_REPEATS {
            self.solve(h, tolerance)?;
            self.set_implied_region(h);
            if self.region.adopt(&self.implied, &self.wake, repeats) {
                self.wake_neighbours();
                tolerance = COARSE_TOLERANCE;
            } else if tolerance == FINE_TOLERANCE {
                self.accept(h);
                return Ok(());
            } else {
                tolerance = FINE_TOLERANCE;
            }
        }
        Err(RunError::NotConverged { what: Iteration::ContactRegion, time: self.clock.now() })
    }

    /// Sets the tires in the air that are above the ground or leave it. The region assumed for the end of a longer cut may have
    /// them on the ground.
    fn release_tires(&mut self) {
        for &tire in self.wake.awake_tires() {
            if self.u[tire].z > 0.0 || self.v[tire].z > 0.0 {
                self.region.ground[tire] = TireContact::InAir;
            }
        }
    }

    /// Sets the forces at the start of the cut.
    pub(super) fn set_start_forces(&mut self) {
        cable_forces(
            &self.scene,
            &self.wake,
            &self.u,
            |_, cable, length| cable.force(length),
            &mut self.f_start,
        );
    }

    /// Sets the tires moving that no longer stick, so that their neighbours wake.
    fn wake_neighbours(&mut self) {
        for n in 0..self.wake.awake_tires().len() {
            let tire = self.wake.awake_tires()[n];
            if self.region.ground[tire] != TireContact::Stick {
                self.wake.set_moving(tire, true);
            }
        }
        if self.refresh() {
            self.set_start_forces();
        }
    }

    /// Sets the accelerations at the start of the cut from the balance of forces.
    pub(super) fn set_accelerations(&mut self) {
        for &tire in self.wake.awake_tires() {
            let free = self.f_start[tire] / self.scene.mass[tire] - Vector3::z() * self.scene.gravity;
            self.a[tire] = match self.region.ground[tire] {
                TireContact::InAir => free,
                TireContact::Stick => Vector3::zeros(),
                TireContact::Slip => (free.xy() + self.sliding_friction(free, self.v[tire].xy())).push(0.0),
            };
        }
    }

    /// Predictor: sets the displacement over the cut, for constant forces and without contact. The predictor is (5) without the
    /// stiffness K: Δu = (4M/h²)⁻¹ M (4 v₀/h + 2 a₀) = h v₀ + h² a₀/2. The first correction of [`Self::solve`] brings K in.
    pub(super) fn predict(&mut self, h: f64) {
        for &tire in self.wake.awake_tires() {
            self.du[tire] = self.v[tire] * h + self.a[tire] * (0.5 * h * h);
        }
    }

    /// Solves equilibrium by Newton–Raphson for the assumed contact region, from the last displacement on. `tolerance` is the
    /// greatest correction over the greatest displacement.
    pub(super) fn solve(&mut self, h: f64, tolerance: f64) -> Result<(), RunError> {
        for &tire in self.wake.awake_tires() {
            match self.region.ground[tire] {
                TireContact::InAir => {}
                TireContact::Slip => self.du[tire].z = -self.u[tire].z,
                TireContact::Stick => self.du[tire] = (self.v[tire].xy() * (0.5 * h)).push(-self.u[tire].z),
            }
        }
        for _ in 0..MOST_ITERATIONS {
            self.set_residual(h);
            self.system.assemble(&self.scene, &self.wake, &self.region, &self.end, &self.residual, h);
            if !self.system.solve() {
                break;
            }
            let (mut correction, mut displacement) = (0.0_f64, 0.0_f64);
            for (tire, delta) in self.system.corrections() {
                self.du[tire] += delta;
                correction = correction.max(delta.amax());
            }
            for &tire in self.wake.awake_tires() {
                displacement = displacement.max(self.du[tire].amax());
            }
            if !(correction + displacement).is_finite() {
                return Err(RunError::Diverged { time: self.clock.now() });
            }
            if correction <= tolerance * displacement {
                self.set_residual(h);
                return Ok(());
            }
        }
        Err(RunError::NotConverged { what: Iteration::Newton, time: self.clock.now() })
    }

    /// Sets the forces and the residual of equilibrium at the end of the cut.
    fn set_residual(&mut self, h: f64) {
        for &tire in self.wake.awake_tires() {
            self.end[tire] = self.u[tire] + self.du[tire];
        }
        let taut = &self.region.taut;
        let law =
            |n: usize, cable: &Cable, length: f64| if taut[n] { cable.stretch_force(length) } else { 0.0 };
        cable_forces(&self.scene, &self.wake, &self.end, law, &mut self.f);
        for &tire in self.wake.awake_tires() {
            let mass = self.scene.mass[tire];
            let mut force = self.f[tire] / mass - Vector3::z() * self.scene.gravity;
            if self.region.ground[tire] == TireContact::Slip {
                force += self.end_friction(tire, force, h).push(0.0);
            }
            let inertia = (self.du[tire] / h - self.v[tire]) * (4.0 / h) - self.a[tire];
            self.residual[tire] = (force - inertia) * mass;
        }
    }
}

/// Sets `forces` on the awake tires [N]: gravity along the ground plus the sum over their cables. `law` gives the force of a cable
/// [N] from its index and length [m].
fn cable_forces(
    scene: &Scene,
    wake: &Wake<'_>,
    u: &[Vector3<f64>],
    law: impl Fn(usize, &Cable, f64) -> f64,
    forces: &mut [Vector3<f64>],
) {
    for &tire in wake.awake_tires() {
        forces[tire] = (scene.downhill * scene.mass[tire]).push(0.0);
    }
    for &n in wake.awake_cables() {
        let cable = &scene.cables[n];
        let span = cable.displaced(u);
        let length = span.norm();
        let force = law(n, cable, length);
        if force == 0.0 {
            continue;
        }
        let on_first_tire = span * (force / length);
        for (end, sign) in cable.ends.into_iter().zip([1.0, -1.0]) {
            if wake.is_awake(end) {
                forces[end] += on_first_tire * sign;
            }
        }
    }
}
