//! Explicit central differences with contact in closed form.
//!
//! Velocities live at mid-step. A step of length h at time tₙ:
//!
//! 1. forces: f = Σ N over the taut cables at uₙ;
//! 2. kick: v* = v + h (f/m − g), then on the ground p = −m v*₃ ≥ 0 and friction up to μp ([`super::contact`]);
//! 3. drift: uₙ₊₁ = uₙ + h v.
//!
//! A tire that lands or is fired at inside the step is carried through it phase by phase instead
//! ([`Flight::through`](super::contact::Flight::through)), so both happen at their own time. A cable that becomes taut or
//! slack inside the step pulls as if it did so halfway ([`Slices::evaluate`](super::tension::Slices::evaluate)). The method
//! is of second order, symplectic between events, and stable for h < 2/ω; ω² ≤ max (2/m) Σ k
//! ([`Scene::frequency_bound`](crate::scene::Scene::frequency_bound)). It ignores damping in the cables.

mod stepper;

use std::sync::OnceLock;

use self::stepper::Stepper;
use super::cable::Blocks;
use super::mirror::Quotient;
use super::pack::LANES;
use super::wake::Ties;
use super::{Failure, Settings, Watcher};
use crate::choice::Method;
use crate::outcome::Outcome;
use crate::scene::{Mirror, Scene, Shot};

/// A scene made ready for many runs: the whole, and what each choice of its mirror planes leaves of it.
#[derive(Debug, Default)]
pub struct Model {
    /// By the planes taken out, as a binary number.
    parts: [OnceLock<Part>; 4],
}

/// What is integrated, laid out for the stepping loop; the same for every run.
#[derive(Debug)]
pub struct Part {
    quotient: Quotient,
    blocks: Blocks,
    ties: Ties,
    /// Mass × how many tires of the whole scene each stands for [kg] (`n_tires` + [`LANES`]).
    mass: Vec<f64>,
    /// One over the mass, 0 for images [1/kg] (`n_tires` + [`LANES`]).
    inverse: Vec<f64>,
    /// Longest stable step [s].
    critical_step: f64,
}

impl Model {
    /// The part of the scene that stands for the whole in a shot; made at its first use.
    fn part(&self, scene: &Scene, shot: &Shot) -> &Part {
        let planes = shared_planes(scene, shot);
        let number = planes.iter().map(|plane| 1 << plane.axis).sum::<usize>();
        self.parts[number].get_or_init(|| Part::new(scene, &planes))
    }

    /// Runs one shot of the scene this model is for; see [`super::simulate`].
    pub fn run(
        &self,
        scene: &Scene,
        shot: &Shot,
        settings: &Settings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, Failure> {
        let part = self.part(scene, shot);
        let (step, limit) = (settings.step, part.critical_step);
        if !(step > 0.0 && step < limit) {
            return Err(Failure::Step { step, limit, method: Method::Verlet });
        }
        Stepper::new(part, scene, shot, settings).run(watch)
    }

    /// How many tires are integrated for a shot: fewer than the scene has where both are their own mirror image.
    pub fn modelled_tires(&self, scene: &Scene, shot: &Shot) -> usize {
        self.part(scene, shot).quotient.modelled()
    }
}

/// The scene's mirror planes in which the shot is its own image.
fn shared_planes<'s>(scene: &'s Scene, shot: &Shot) -> Vec<&'s Mirror> {
    scene.mirrors.iter().filter(|mirror| shot.is_mirrored(&mirror.image)).collect()
}

impl Part {
    fn new(scene: &Scene, planes: &[&Mirror]) -> Self {
        let (quotient, part) = Quotient::new(scene, planes);
        let weighed = || part.mass.iter().zip(&quotient.weight);
        let spare = || std::iter::repeat_n(1.0, LANES);
        // An image is never kicked by the part of its cables that is modelled.
        let inverse = |(mass, &weight): (&f64, &f64)| if weight > 0.0 { 1.0 / mass } else { 0.0 };
        let blocks = Blocks::new(&part, &quotient.cable_weight);
        Self {
            ties: Ties::of_blocks(&blocks, part.mass.len()),
            blocks,
            mass: weighed().map(|(mass, weight)| mass * weight).chain(spare()).collect(),
            inverse: weighed().map(inverse).chain(spare()).collect(),
            critical_step: scene.critical_step(),
            quotient,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::simulation::wake::tests::{exact, scenes};

    #[test]
    fn what_sleeps_would_not_have_moved() {
        let (scene, shots) = scenes();
        let mut part = Part::new(&scene, &[]);
        part.ties = part.ties.with_everything();
        let (some, mut all) = (Model::default(), Model::default());
        all.parts[0] = part.into();
        for shot in shots {
            let settings = Settings { method: Method::Verlet, step: 2e-3, duration: None };
            let [some, all] = [&some, &all].map(|model| {
                model.run(&scene, &shot, &settings, &mut |_| ControlFlow::Continue(())).expect("a run")
            });
            assert_eq!(exact(&some), exact(&all));
        }
    }
}
