//! Cable forces over the flat arrays of the stepping loop. One operation takes as many cables as a register holds.

use std::borrow::Cow;

use pulp::Simd;

use crate::simulation::cable_blocks::{Block, Blocks};
use crate::simulation::pack::{Aligned, LANES, Mask, Pack, VectorArrays, Wide, components};

/// Forces of all cables, and the state that cables keep from one step to the next.
#[derive(Debug)]
pub struct CableForceMemory<'a> {
    blocks: &'a Blocks,
    /// L0² [m²]; infinite for an empty slot and for a removed cable (`n_elements`).
    rest_length2: Cow<'a, [f64]>,
    /// L² − L0² at the last evaluation [m²] (`n_elements`).
    excess: Aligned,
    /// Mean force over the step on the first tire of each cable [N] (`n_elements`); see [`CableEvaluator::evaluate`].
    force: VectorArrays,
    /// State of the cables in each register, kept at the first element of the register (`n_elements`).
    state: Vec<CableState>,
    /// State of damped cables; empty without damping.
    damped: Damped<'a>,
}

/// State that damped cables keep from step to step (all `n_elements`).
#[derive(Debug)]
struct Damped<'a> {
    /// Viscosity c [N s/m].
    viscosity: &'a [f64],
    /// Change of L² over the step before [m²].
    length2_change: Aligned,
    /// Force N at the last evaluation and at the evaluation before [N].
    ///
    /// The force at the evaluation before may be a mark. Infinite: the force has had a kink or the cable has become taut since
    /// then, so no parabola goes through that force. Negative infinite: the force has jumped since then. A register whose cables
    /// are all slack keeps such a mark as its last force, too.
    force: [Aligned; 2],
}

/// State of the cables in one register at the last evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CableState {
    /// All cables are slack, and were slack one step earlier.
    Slack,
    /// All cables are slack; some were taut one step earlier.
    Slackened,
    /// Some cable is taut.
    Taut,
}

/// Result of the evaluation of one block, by lane.
#[derive(Clone, Copy, Debug)]
pub struct BlockTotals {
    /// Elastic energy [J].
    pub energy: Pack,
    /// Greatest force [N].
    pub force: Pack,
    /// Energy that damping dissipates over the step [J], half of it before and half after the evaluation.
    pub dissipated: Pack,
}

impl<'a> CableForceMemory<'a> {
    /// Cables at rest; `viscosity` is c of each element [N s/m], or empty without damping.
    pub fn new(blocks: &'a Blocks, viscosity: &'a [f64]) -> Self {
        let elements = blocks.weight.len();
        let zeros = || Aligned::zeros(viscosity.len());
        let mut excess = Aligned::zeros(elements);
        for block in &blocks.blocks {
            let [x, y, z] = block.span.into();
            let span2 = z.mul_add(z, y.mul_add(y, x * x));
            for element in block.first_element..block.first_element + block.len.next_multiple_of(LANES) {
                excess[element] = span2 - blocks.rest_length2[element];
            }
        }
        Self {
            blocks,
            rest_length2: Cow::Borrowed(&blocks.rest_length2),
            excess,
            force: VectorArrays::zeros(elements),
            state: vec![CableState::Slack; elements],
            damped: Damped { viscosity, length2_change: zeros(), force: [zeros(), zeros()] },
        }
    }

    /// All arrays as slices of one length (`n_elements`).
    #[inline(always)]
    pub fn slices(&mut self) -> CableEvaluator<'_, 'a> {
        let n = self.rest_length2.len();
        CableEvaluator {
            weight: &self.blocks.weight[..n],
            rest_length: &self.blocks.rest_length[..n],
            rest_length2: &self.rest_length2[..n],
            stiffness: &self.blocks.stiffness[..n],
            excess: &mut self.excess[..n],
            force: self.force.slices_mut(),
            state: &mut self.state[..n],
            damped: &mut self.damped,
        }
    }

    /// Length of the cable in a slot of a block at the last evaluation [m]; `None` for an empty slot.
    fn length(&self, block: &Block, slot: usize) -> Option<f64> {
        let element = block.first_element + slot;
        self.exists(element).then(|| (self.excess[element] + self.rest_length2[element]).sqrt())
    }

    /// Force of the cable in a slot of a block at the last evaluation [N]; 0 for an empty slot.
    pub fn slot_force(&self, block: &Block, slot: usize) -> f64 {
        match self.damped.viscosity {
            [] => {
                let force = |length| self.blocks.cable_in(block, slot).force(length);
                self.length(block, slot).map_or(0.0, force)
            }
            _ => {
                let force = self.damped.force[0][block.first_element + slot];
                if force.is_finite() { force } else { 0.0 }
            }
        }
    }

    /// Whether an element holds a cable.
    pub fn exists(&self, element: usize) -> bool {
        self.rest_length2[element] < f64::INFINITY
    }

    /// Forgets how a damped cable moved until now, as if its ends had always moved as they do now. Call it after one of its tires
    /// was launched or has landed, or after a push on a tire began or ended. `excess` is L² − L0² now [m²]. `changes` are the
    /// changes of L² over the step before this one and over this one [m²]. `jumps`: the force jumped.
    pub fn forget_motion(&mut self, element: usize, excess: f64, changes: [f64; 2], jumps: bool) {
        self.excess[element] = excess - changes[1];
        self.damped.length2_change[element] = changes[0];
        self.damped.force[0][element] = if jumps { f64::NEG_INFINITY } else { f64::INFINITY };
    }

    /// L² − L0² of a cable at the last evaluation [m²], and the change of L² over the step before that [m²]; the change is 0
    /// without damping.
    pub fn excess_and_change(&self, element: usize) -> [f64; 2] {
        let last = self.damped.length2_change.get(element).copied();
        [self.excess[element], last.unwrap_or_default()]
    }

    /// Force of a damped cable at the evaluation before the last [N]; `None` without damping. Infinite if the force has had a kink
    /// or the cable has become taut since then. Negative infinite if the force has jumped.
    pub fn slot_force_before(&self, block: &Block, slot: usize) -> Option<f64> {
        (!self.damped.viscosity.is_empty()).then(|| self.damped.force[1][block.first_element + slot])
    }

    /// Removes the cable in a slot of a block; returns the elastic energy that is lost with the cable [J].
    pub fn remove(&mut self, block: &Block, slot: usize) -> f64 {
        let element = block.first_element + slot;
        let energy = |length| self.blocks.cable_in(block, slot).energy(length);
        let stored = self.length(block, slot).map_or(0.0, energy);
        let lost = self.blocks.weight[element] * stored;
        self.rest_length2.to_mut()[element] = f64::INFINITY;
        self.excess[element] = f64::NEG_INFINITY;
        // The cable acts until now: only in the first half of the kick.
        self.force.components.iter_mut().for_each(|force| force[element] *= 0.5);
        lost
    }

    /// Forces of all cables.
    #[inline(always)]
    pub fn forces(&self) -> CableForces<'_> {
        CableForces(self.force.slices())
    }
}

/// [`CableForceMemory`] during the evaluation of many blocks.
pub struct CableEvaluator<'a, 'b> {
    weight: &'a [f64],
    rest_length: &'a [f64],
    rest_length2: &'a [f64],
    stiffness: &'a [f64],
    excess: &'a mut [f64],
    force: [&'a mut [f64]; 3],
    state: &'a mut [CableState],
    damped: &'a mut Damped<'b>,
}

impl CableEvaluator<'_, '_> {
    /// Evaluates every cable of `block` at the displacements `u` [m], one `step` [s] after the last evaluation. `DAMPED`: the
    /// cables are damped.
    ///
    /// A cable has the force N = k (L − L0), or 0 if L < L0. A cable that becomes taut or slack within the step has the force F of
    /// line 7 instead. Without F, the amplitude of its swing depends on the time of the switch within the step.
    ///
    /// Symbols: h step; k stiffness; L, L0 length and unstretched length; s₀ < 0 < s₁ stretch L − L0 at the start and the
    /// end of the step in which the cable becomes taut; σ = |s₀| + |s₁|; v = σ/h relative speed of the two tires along the
    /// cable; q = |s₀|/σ part of the step before the cable is taut; m reduced mass of the two tires; ω² = k/m;
    /// A amplitude of the swing; e = L² − L0², with e₀ and e₁ at the start and the end of the step.
    ///
    /// 1. The exact amplitude is A = v/ω.
    /// 2. Central differences keep (s₁ − s₀)²/h² + ω² s₀ s₁ from step to step. With s₀ = −q v h and s₁ = (1 − q) v h, this
    ///    invariant is v² (1 − (ωh)² q (1 − q)). A swing of amplitude A has the invariant ω² A² (1 − (ωh)²/4).
    /// 3. Both are equal, so that A = v/ω · (1 + (ωh)²/8 · (1 − 2q)²) to second order: exact at q = ½, too large elsewhere.
    /// 4. The amplitude is right when v is smaller by the same part. The impulse on each tire is then
    ///    J = m v (ωh)²/8 · (1 − 2q)² = h k σ (1 − 2q)²/8.
    /// 5. Since 1 − 2q = (s₀ + s₁)/σ, the mean force over the step is J/h = k (s₀ + s₁)²/(8 σ).
    /// 6. Near the switch L is close to L0, so that s = e/(L + L0) with the present L serves for s₀ and s₁.
    /// 7. F = N + k/8 · (e₀ + e₁)²/(|e₁ − e₀| (L + L0)). The cable becomes slack in the same way, with time reversed.
    ///
    /// Source: line 2 is the known invariant of central differences for a harmonic oscillator (Hairer, Lubich, Wanner,
    /// "Geometric numerical integration illustrated by the Störmer–Verlet method", Acta Numerica 12, 2003); lines 3 to 7
    /// are derived here. The test `a_cable_pulls_alike_wherever_in_a_step_it_becomes_taut` holds the result.
    ///
    /// The evaluation has three parts: which cables are taut, what damping adds (`damp`), and the force of a switch (`per_length`).
    /// Most registers need only the first part. Only registers without a taut cable leave early. There is no other branch, because
    /// the processor could not predict it.
    #[inline(always)]
    pub fn evaluate<S: Simd, const DAMPED: bool>(
        &mut self,
        simd: S,
        block: &Block,
        u: [&[f64]; 3],
        step: f64,
    ) -> BlockTotals {
        let zero = Wide::splat(simd, 0.0);
        let Block { ends, span, len, first_element } = block;
        let span = components!(c => Wide::splat(simd, span[c]));
        // All slices have one length, so that one bounds check serves all of them.
        let room = len.next_multiple_of(LANES);
        let elements = *first_element..first_element + room;
        let [first, second] = *ends;
        let at_ends =
            [components!(c => &u[c][first..first + room]), components!(c => &u[c][second..second + room])];
        let weights = &self.weight[elements.clone()];
        let rest_lengths = &self.rest_length[elements.clone()];
        let rest_lengths2 = &self.rest_length2[elements.clone()];
        let stiffnesses = &self.stiffness[elements.clone()];
        let excesses = &mut self.excess[elements.clone()];
        let [x, y, z] = &mut self.force;
        let forces = [&mut x[elements.clone()], &mut y[elements.clone()], &mut z[elements.clone()]];
        let states = &mut self.state[elements.clone()];
        let damped_elements = if DAMPED { elements } else { 0..0 };
        let Damped { viscosity, length2_change: old_changes, force: [forces_at_step, forces_at_step_before] } =
            &mut *self.damped;
        let viscosities = &viscosity[damped_elements.clone()];
        let old_changes = &mut old_changes[damped_elements.clone()];
        let forces_at_step = &mut forces_at_step[damped_elements.clone()];
        let forces_at_step_before = &mut forces_at_step_before[damped_elements];
        let (mut energy, mut greatest, mut dissipated) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let per_step = Wide::splat(simd, 1.0 / step);
        for at in (0..room).step_by(Wide::<S>::LEN) {
            let mut d = between(simd, at_ends, at);
            for c in 0..3 {
                d[c] = d[c] + span[c];
            }
            let length2 = norm_squared(d);
            let excess = length2 - Wide::load(simd, rest_lengths2, at);
            // (4): a cable with L < L0 is switched off.
            let taut = zero.less(excess);
            let excess_before = Wide::load(simd, excesses, at);
            excess.store(excesses, at);
            let was = states[at];
            if taut.any() {
                states[at] = CableState::Taut;
            } else {
                states[at] = CableState::Slack;
                match was {
                    CableState::Slack => continue,
                    CableState::Slackened => {
                        for c in 0..3 {
                            zero.store(forces[c], at);
                        }
                        continue;
                    }
                    CableState::Taut => states[at] = CableState::Slackened,
                }
            }
            let (weight, rest_length) = (Wide::load(simd, weights, at), Wide::load(simd, rest_lengths, at));
            let cables = CableRegister { rest_length, excess, excess_before, taut };
            let length = length2.sqrt();
            let stretch = taut.select(length - rest_length, zero).max(zero);
            let stiffness = Wide::load(simd, stiffnesses, at);
            let elastic = stiffness * stretch;
            (weight * elastic * stretch).add_to(&mut energy, at % LANES);
            let mut switches = cables.switches(simd);
            let (mut force, mut force_at_step) = (elastic, elastic);
            if DAMPED {
                // A pull ends where N is 0, while the cable is still longer than at rest. So that is no switch.
                switches = switches.and(cables.taut);
                let old = Wide::load(simd, old_changes, at);
                (cables.excess - cables.excess_before).store(old_changes, at);
                let viscosity = [Wide::load(simd, viscosities, at), per_step];
                let pull = cables.damp(simd, switches, elastic, length, viscosity, old);
                (force, force_at_step) = (pull.mean, pull.at_step);
                (weight * cables.taut.select(force - elastic, zero) * pull.lengthening)
                    .add_to(&mut dissipated, at % LANES);
                let force_before = Wide::load(simd, forces_at_step, at);
                let infinite = Wide::splat(simd, f64::INFINITY);
                switches.select(infinite, force_before).store(forces_at_step_before, at);
                force_at_step.store(forces_at_step, at);
            }
            force_at_step.max(Wide::load(simd, &greatest, at % LANES)).store(&mut greatest, at % LANES);
            let per_length = cables.per_length(simd, switches, force, length, stiffness);
            for c in 0..3 {
                (per_length * d[c]).store(forces[c], at);
            }
        }
        // Until here, the sum is k s².
        energy.iter_mut().for_each(|energy| *energy *= 0.5);
        BlockTotals { energy, force: greatest, dissipated }
    }
}

/// The cables of one register at one evaluation.
#[derive(Clone, Copy)]
struct CableRegister<S: Simd> {
    /// L0 [m].
    rest_length: Wide<S>,
    /// e₁ and e₀: L² − L0² now and one step before [m²].
    excess: Wide<S>,
    excess_before: Wide<S>,
    /// Which cables pull: L > L0. (4) switches the others off.
    taut: Mask<S>,
}

/// Pull of damped cables.
#[derive(Clone, Copy)]
struct DampedPull<S: Simd> {
    /// Mean over the step [N].
    mean: Wide<S>,
    /// At the evaluation [N].
    at_step: Wide<S>,
    /// Change of length over the step [m].
    lengthening: Wide<S>,
}

impl<S: Simd> CableRegister<S> {
    /// Which cables became taut or slack within the step.
    #[inline(always)]
    fn switches(&self, simd: S) -> Mask<S> {
        let zero = Wide::splat(simd, 0.0);
        self.taut.differs(zero.less(self.excess_before))
    }

    /// Pull of damped cables: N = k s + c ṡ while a cable is taut and N is positive.
    ///
    /// Symbols: L length; s = L − L0 stretch; c viscosity; h step; q part of the step before the cable becomes taut. `elastic` is k
    /// s [N], `viscosity` is c [N s/m] and 1/h [1/s], `old` is the change of L² over the step before [m²].
    ///
    /// 1. The rate of L² at the end of the step is 2 L ṡ. It is extrapolated from the mean rates over this step and over the step
    ///    before. That is exact for motion under no force.
    /// 2. In the step in which the cable becomes taut, N jumps to c ṡ. There the mean rate over this step serves alone.
    /// 3. In that step the force counts for the part 1 − q that is left of the step, and for the half step after: 1 + (½ − q) in
    ///    all.
    #[inline(always)]
    fn damp(
        &self,
        simd: S,
        switches: Mask<S>,
        elastic: Wide<S>,
        length: Wide<S>,
        [viscosity, per_step]: [Wide<S>; 2],
        old: Wide<S>,
    ) -> DampedPull<S> {
        let (zero, half, one) = (Wide::splat(simd, 0.0), Wide::splat(simd, 0.5), Wide::splat(simd, 1.0));
        let excess_change = self.excess - self.excess_before;
        let extrapolated = excess_change + half * (excess_change - old);
        let rate = switches.select(excess_change, extrapolated);
        // Without motion in this step the rate is 0, whatever moved before.
        let rate = zero.less(excess_change.abs()).select(rate, zero);
        let per_length = one / length.max(Wide::splat(simd, f64::MIN_POSITIVE));
        let lengthening = half * rate * per_length;
        // A mean rate is the rate at the mean length. The mean length is shorter than the last length by half of the lengthening.
        let at_mean = (half * lengthening * per_length).times_plus(lengthening, lengthening);
        let lengthening = switches.select(at_mean, lengthening);
        let viscous = viscosity * lengthening * per_step;
        let whole = self.taut.select((elastic + viscous).max(zero), zero);
        let after = half + self.excess_before / excess_change;
        let counted = switches.select((whole - elastic) * (one + after), whole - elastic);
        let at_step = switches.select(viscous.max(zero), whole);
        DampedPull { mean: (elastic + counted).max(zero), at_step, lengthening }
    }

    /// Force over length [N/m]: N/L, and F/L by line 7 of [`CableEvaluator::evaluate`] where a cable switches.
    #[inline(always)]
    fn per_length(
        &self,
        simd: S,
        switches: Mask<S>,
        force: Wide<S>,
        length: Wide<S>,
        stiffness: Wide<S>,
    ) -> Wide<S> {
        let eighth = Wide::splat(simd, 0.125);
        let apart = (self.excess - self.excess_before).abs() * (length + self.rest_length);
        let sum = self.excess + self.excess_before;
        let above = switches.select(force.times_plus(apart, eighth * stiffness * sum * sum), force);
        let below = switches.select(apart * length, length).max(Wide::splat(simd, f64::MIN_POSITIVE));
        above / below
    }
}

/// Forces of all cables on their first tires, by component, in slices of one length [N] (`n_elements`).
#[derive(Clone, Copy, Debug)]
pub struct CableForces<'a>([&'a [f64]; 3]);

impl CableForces<'_> {
    /// Sum of the cable forces on the tires of one register [N].
    ///
    /// `begin` and `end` are the elements of the cables that begin and end at the first tire of the pack. The register begins
    /// `offset` tires later.
    #[inline(always)]
    pub fn sum_at<S: Simd>(&self, simd: S, [begin, end]: [&[u32]; 2], offset: usize) -> [Wide<S>; 3] {
        let mut sum = [Wide::splat(simd, 0.0); 3];
        for &element in begin {
            for c in 0..3 {
                sum[c] = sum[c] + Wide::load(simd, self.0[c], element as usize + offset);
            }
        }
        for &element in end {
            for c in 0..3 {
                sum[c] = sum[c] - Wide::load(simd, self.0[c], element as usize + offset);
            }
        }
        sum
    }
}

/// Square of the length of a vector.
#[inline(always)]
fn norm_squared<S: Simd>([x, y, z]: [Wide<S>; 3]) -> Wide<S> {
    z.times_plus(z, y.times_plus(y, x * x))
}

/// Displacement of the second ends of cables relative to the first ends [m], from element `at` on.
#[inline(always)]
fn between<S: Simd>(simd: S, [first, second]: [[&[f64]; 3]; 2], at: usize) -> [Wide<S>; 3] {
    components!(c => Wide::load(simd, second[c], at) - Wide::load(simd, first[c], at))
}
