//! Events of single tires within a step: a new greatest height, a landing, a launch.

use std::ops::Range;

use nalgebra::Vector3;
use pulp::{Scalar, Simd};

use super::{DueFiring, Part, StepTotals};
use crate::outcome::Peak;
use crate::scene::Scene;
use crate::simulation::contact::TireStep;
use crate::simulation::pack::{LANES, Pack, Wide};
use crate::simulation::record::Record;
use crate::simulation::verlet::kick::Tires;
use crate::simulation::verlet::tension::CableForces;

/// Result of a tire that was integrated through the step by itself.
#[derive(Clone, Copy, Debug)]
pub struct Integrated {
    /// Index of the tire in the part.
    pub tire: usize,
    /// Displacement at the end of the step [m].
    pub displacement: Vector3<f64>,
    /// Velocity at mid-step [m/s].
    pub velocity: Vector3<f64>,
}

/// Tires before the step, as slices of one length so that one check of bounds serves them all (`n_tires` + [`LANES`]).
#[derive(Clone, Copy)]
pub struct State<'s> {
    /// Displacement [m].
    u: [&'s [f64]; 3],
    /// Velocity at mid-step [m/s].
    v: [&'s [f64]; 3],
    /// Cable forces [N].
    forces: CableForces<'s>,
    /// Masses [kg], and one over the masses [1/kg].
    masses: [&'s [f64]; 2],
}

impl<'s> State<'s> {
    /// State from arrays that the step will write later.
    #[inline(always)]
    pub fn new(
        [x, y, z]: &'s [&mut [f64]; 3],
        [dx, dy, dz]: &'s [&mut [f64]; 3],
        forces: CableForces<'s>,
        masses: [&'s [f64]; 2],
    ) -> Self {
        Self { u: [x, y, z], v: [dx, dy, dz], forces, masses }
    }
}

/// The step as the events see it, and the places that hold their results.
pub struct Events<'e> {
    /// Start of the step [s].
    pub now: f64,
    /// Step [s].
    pub step: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// The scene.
    pub scene: &'e Scene,
    /// Tires and cables that are modelled.
    pub part: &'e Part,
    /// Record of the run.
    pub record: &'e mut Record,
    /// Energies and greatest values of the step.
    pub totals: &'e mut StepTotals,
    /// Tires of the present register that were integrated by themselves.
    pub integrated: &'e mut Vec<Integrated>,
}

impl Events<'_> {
    /// Tires of the register that begins at tire `at`.
    #[inline(always)]
    pub fn tires<S: Simd>(&self, simd: S, state: State<'_>, at: usize) -> Tires<S> {
        let State { u, v, forces, masses: [mass, inverse] } = state;
        Tires {
            u: std::array::from_fn(|c| Wide::load(simd, u[c], at)),
            v: std::array::from_fn(|c| Wide::load(simd, v[c], at)),
            f: forces.sum_at(simd, self.part.blocks.ends.of(at / LANES), at % LANES),
            mass: Wide::load(simd, mass, at),
            inverse: Wide::load(simd, inverse, at),
            step: Wide::splat(simd, self.step),
            friction: Wide::splat(simd, self.friction),
            gravity: Wide::splat(simd, self.scene.gravity),
            downhill: std::array::from_fn(|c| Wide::splat(simd, self.scene.downhill[c])),
        }
    }

    /// Notes new greatest heights in the register of `tires`, and integrates each tire that lands or is fired at by itself.
    /// Returns whether any tire was integrated.
    ///
    /// `ahead` is the height of each tire at the end of the step [m]; a tire with a negative height lands. `firings` are those
    /// of this register. Kick and forces of these few tires are computed a second time: to keep the values of the registers
    /// would cost memory accesses at every step.
    #[cold]
    #[inline(never)]
    pub fn integrate_single_tires<const SLOPED: bool>(
        &mut self,
        state: State<'_>,
        tires: Range<usize>,
        ahead: Pack,
        mut firings: &[DueFiring],
    ) -> bool {
        for (tire, ahead) in tires.zip(ahead) {
            let (here, later) = firings.split_at(firings.partition_point(|due| due.tire <= tire));
            firings = later;
            let has_event = ahead < 0.0 || !here.is_empty();
            let is_image = self.part.inverse[tire] == 0.0;
            if is_image || !has_event && state.u[2][tire] <= self.record.height.value {
                continue;
            }
            let alone = self.tires(Scalar::new(), state, tire);
            let kicked = alone.kick::<SLOPED>(Scalar::new());
            let number = |wide: Wide<Scalar>| wide.pack()[0];
            let vector = |of: [Wide<Scalar>; 3]| Vector3::from(of.map(number));
            let (displacement, inverse) = (vector(alone.u), number(alone.inverse));
            let velocity = 0.5 * (vector(alone.v) + vector(kicked.v));
            let free = vector(alone.f) * inverse + self.scene.gravity();
            if displacement.z > self.record.height.value {
                let index = self.part.reduction.tire(tire);
                let sample = Peak { value: displacement.z, at: self.now, index };
                self.record.note_height(sample, velocity.z, free.z);
            }
            if has_event {
                let step = TireStep::new(displacement, velocity, free, self.friction, self.scene.restitution);
                self.integrate(step, free, tire, here, number(kicked.dissipated));
            }
        }
        !self.integrated.is_empty()
    }

    /// Integrates one tire through the step; `kick_dissipated` [J] is the energy that its kick has dissipated already.
    fn integrate(
        &mut self,
        mut motion: TireStep,
        free: Vector3<f64>,
        tire: usize,
        firings: &[DueFiring],
        kick_dissipated: f64,
    ) {
        let h = self.step;
        let last = motion.integrate(h, firings.iter().map(|due| (due.after, due.launch)));
        let velocity = motion.velocity - last * (0.5 * h);
        let (height, until) = motion.top;
        let index = self.part.reduction.tire(tire);
        self.record.note_top(Peak { value: height, at: self.now + until, index });
        self.totals.height[0] = self.totals.height[0].max(height);
        self.totals.motion[0] = self.totals.motion[0].max(velocity.amax()).max(motion.displacement.z);
        // Friction of the whole step is counted here. The kicks before and after count half a step each, and are taken off.
        let next_half = 0.5 * h * (free - last).xy().dot(&motion.velocity.xy());
        let mass = self.part.mass[tire];
        self.totals.lost += mass * (motion.lost - next_half) - 0.5 * kick_dissipated;
        self.totals.put_in += mass * motion.put_in;
        self.integrated.push(Integrated { tire, displacement: motion.displacement, velocity });
    }
}
