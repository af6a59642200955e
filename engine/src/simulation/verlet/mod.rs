//! Explicit method: central differences with contact in closed form.
//!
//! Symbols: h step; u displacement; v velocity at mid-step; v* velocity without the ground; N cable force; f sum of the cable
//! forces on a tire; m mass; g gravity as a vector; p normal impulse; μ coefficient of friction. One step from time tₙ:
//!
//! 1. Forces: f = Σ N over the taut cables at uₙ. (4) switches the slack cables off.
//! 2. Kick: v* = v + h (f/m + g). On the ground (2) gives the support p = −m v*₃ ≥ 0, and (3) gives friction up to μp
//!    ([`super::contact`]). Friction acts against the velocity at tₙ, which is parallel to v + (h/2) (f/m + g) along the ground.
//! 3. Move: uₙ₊₁ = uₙ + h v.
//!
//! A tire that lands or is launched within the step is integrated phase by phase instead
//! ([`TireStep::integrate`](super::contact::TireStep::integrate)), so that landing and launch have their own time. A cable that
//! becomes taut or slack within the step gets a force that gives the right amplitude
//! ([`CableEvaluator::evaluate`](cable_forces::CableEvaluator::evaluate)).
//!
//! The method is of second order, symplectic between events, and stable for h < 2/ω with ω² ≤ max (2/m) Σ k
//! ([`Scene::frequency_bound`](crate::scene::Scene::frequency_bound)). For the damping of cables see
//! [`CableEvaluator::evaluate`](cable_forces::CableEvaluator::evaluate), for its cost in stability
//! [`Scene::critical_step`](crate::scene::Scene::critical_step).
//!
//! Numbers in round brackets are equations of the source paper. `reference` makes the same steps for one tire and one cable after
//! another. Read it beside the paper; its tests hold the registers to it, bit for bit. "One step of one tire" in `docs/model.md`
//! has the numbers.

mod cable_forces;
mod half_kicks;
mod kick;
mod mirror_reduction;
#[cfg(test)]
mod reference;
mod stepper;

use std::sync::{Arc, OnceLock};

use self::mirror_reduction::MirrorReduction;
use self::stepper::Stepper;
use super::cable_blocks::Blocks;
use super::pack::LANES;
use super::wake::Ties;
use super::{RunError, RunSettings, Watcher};
use crate::choice::Method;
use crate::outcome::Outcome;
use crate::scene::{Mirror, Scene, Shot};

/// Parts of one scene, each made at its first use and kept for later runs.
#[derive(Debug, Default)]
pub struct VerletModel {
    /// Part for each set of mirror planes. The index is a binary number with one digit for each plane.
    parts: [OnceLock<Part>; 4],
}

/// Tires and cables that are integrated, laid out for the stepping loop; the same for every run.
#[derive(Debug)]
pub struct Part {
    reduction: Arc<MirrorReduction>,
    blocks: Blocks,
    ties: Arc<Ties>,
    /// Mass of each tire × number of tires of the whole scene that the tire stands for [kg]; 0 for an image or an anchor (`n_tires`
    /// + [`LANES`]).
    mass: Vec<f64>,
    /// One over the mass of each tire; 0 for an image or an anchor [1/kg] (`n_tires` + [`LANES`]).
    inverse_mass: Vec<f64>,
    /// Viscosity of each element [N s/m]; empty without damping.
    viscosity: Vec<f64>,
    /// Longest stable step [s].
    critical_step: f64,
}

impl VerletModel {
    /// Part that stands for the whole scene in `shot`.
    fn part(&self, scene: &Scene, shot: &Shot) -> &Part {
        self.part_of(scene, &shared_planes(scene, shot))
    }

    /// Part that stands for the whole scene if shot and scene share `planes`.
    fn part_of(&self, scene: &Scene, planes: &[&Mirror]) -> &Part {
        let number = planes.iter().map(|plane| 1 << plane.axis).sum::<usize>();
        self.parts[number].get_or_init(|| Part::new(scene, planes))
    }

    /// Runs one shot of the scene of this model; see [`super::Model::run`].
    pub fn run(
        &self,
        scene: &Scene,
        shot: &Shot,
        settings: &RunSettings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, RunError> {
        run(self.part(scene, shot), scene, shot, settings, watch)
    }

    /// Runs one shot under a `variant` of the scene of this model; see [`super::Model::run_variant`].
    pub fn run_variant(
        &self,
        scene: &Scene,
        variant: &Scene,
        shot: &Shot,
        settings: &RunSettings,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, RunError> {
        let planes = shared_planes(variant, shot);
        run(&self.part_of(scene, &planes).variant(variant), variant, shot, settings, watch)
    }

    /// Number of tires that are integrated for a shot: a half or a quarter of the scene's tires if scene and shot are their own
    /// mirror image.
    pub fn modelled_tires(&self, scene: &Scene, shot: &Shot) -> usize {
        self.part(scene, shot).reduction.modelled()
    }
}

/// Runs one shot of `scene`. Only `part` is integrated.
fn run(
    part: &Part,
    scene: &Scene,
    shot: &Shot,
    settings: &RunSettings,
    watch: &mut Watcher<'_>,
) -> Result<Outcome, RunError> {
    let (step, limit) = (settings.step, part.critical_step);
    if !(step > 0.0 && step < limit) {
        return Err(RunError::Step { step, limit, method: Method::Verlet });
    }
    Stepper::new(part, scene, shot, settings).run(pulp::Arch::new(), watch)
}

/// Mirror planes of the scene in which shot and slope are their own images.
fn shared_planes<'s>(scene: &'s Scene, shot: &Shot) -> Vec<&'s Mirror> {
    scene.mirrors_with_slope().filter(|mirror| shot.is_mirrored(mirror)).collect()
}

impl Part {
    fn new(scene: &Scene, planes: &[&Mirror]) -> Self {
        let (reduction, part) = MirrorReduction::new(scene, planes);
        let blocks = Blocks::new(&part, &reduction.cable_weight);
        let ties = Ties::of_blocks(&blocks, part.mass.len());
        Self::with_masses(scene, reduction.into(), blocks, ties.into())
    }

    /// The same layout with the numbers of `variant`.
    fn variant(&self, variant: &Scene) -> Self {
        let blocks = self.blocks.with_numbers(|cable| &variant.cables[self.reduction.cable(cable)]);
        Self::with_masses(variant, Arc::clone(&self.reduction), blocks, Arc::clone(&self.ties))
    }

    fn with_masses(scene: &Scene, reduction: Arc<MirrorReduction>, blocks: Blocks, ties: Arc<Ties>) -> Self {
        let weighted =
            || reduction.weight.iter().enumerate().map(|(n, &w)| (scene.mass[reduction.tire(n)], w));
        // Spare lanes behind the last tire have no energy.
        let spare = |value: f64| std::iter::repeat_n(value, LANES);
        // Images get no kick, because the part has only some of their cables.
        let viscosity = |cable: usize| scene.viscosity(&scene.cables[reduction.cable(cable)]);
        let inverse_mass = |(mass, weight)| if weight > 0.0 { 1.0 / mass } else { 0.0 };
        let moved_mass = |(mass, weight)| if weight > 0.0 { mass * weight } else { 0.0 };
        Self {
            mass: weighted().map(moved_mass).chain(spare(0.0)).collect(),
            inverse_mass: weighted().map(inverse_mass).chain(spare(1.0)).collect(),
            critical_step: scene.critical_step(),
            viscosity: if scene.damping > 0.0 { blocks.by_element(viscosity) } else { Vec::new() },
            blocks,
            ties,
            reduction,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::simulation::wake::tests::{exact, scenes};

    #[test]
    fn tires_asleep_would_not_have_moved() {
        let (scene, shots) = scenes();
        asleep_like_awake(&scene, &shots);
        asleep_like_awake(&Scene { damping: 0.1, ..scene }, &shots);
    }

    fn asleep_like_awake(scene: &Scene, shots: &[Shot]) {
        let mut part = Part::new(scene, &[]);
        part.ties = Arc::new(Ties::of_blocks(&part.blocks, scene.tire_count()).with_everything());
        let (some, mut all) = (VerletModel::default(), VerletModel::default());
        all.parts[0] = part.into();
        for shot in shots {
            let settings = RunSettings { method: Method::Verlet, step: 2e-3, duration: None };
            let [some, all] = [&some, &all].map(|cache| {
                cache.run(scene, shot, &settings, &mut |_| ControlFlow::Continue(())).expect("a run")
            });
            assert_eq!(exact(&some), exact(&all));
        }
    }
}
