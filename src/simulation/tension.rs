//! The tension law of cables over the flat arrays of the stepping loop, as many cables at a time as a register holds.

use std::borrow::Cow;

use pulp::Simd;

use super::cable::{Block, Blocks, Field};
use super::pack::{Aligned, LANES, Pack, Wide};

/// What is remembered of every cable from one step to the next, and how it pulls.
#[derive(Debug)]
pub struct Tension<'a> {
    /// How many cables of the whole scene each element stands for, 0 where there is none (`n_elements`).
    weight: Cow<'a, [f64]>,
    /// L² when last evaluated, less its value at rest [m²] (`n_elements`).
    change: Aligned,
    /// Mean force since the last step × direction from first to second end [N] (`n_elements`); see
    /// [`Slices::evaluate`].
    pull: Field,
    /// Of the cables in one register, at the first of them (`n_elements`).
    state: Vec<State>,
}

/// Of cables in one register, when last evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// No cable pulls, nor pulled in the step before.
    Slack,
    /// No cable pulls; some did in the step before.
    Slackened,
    /// Some cable pulls.
    Taut,
}

/// What the evaluation of a block says, in parts by lane.
#[derive(Clone, Copy, Debug)]
pub struct Stress {
    /// Elastic energy [J].
    pub energy: Pack,
    /// Greatest force [N].
    pub force: Pack,
}

impl<'a> Tension<'a> {
    /// At rest.
    pub fn new(blocks: &'a Blocks) -> Self {
        let elements = blocks.weight.len();
        Self {
            weight: Cow::Borrowed(&blocks.weight),
            change: Aligned::zeros(elements),
            pull: Field::zeros(elements),
            state: vec![State::Slack; elements],
        }
    }

    /// Everything in slices of one length (`n_elements`).
    #[inline(always)]
    pub fn slices(&mut self) -> Slices<'_> {
        let n = self.weight.len();
        Slices {
            weight: &self.weight[..n],
            change: &mut self.change[..n],
            pull: self.pull.slices_mut().map(|part| &mut part[..n]),
            state: &mut self.state[..n],
        }
    }

    /// Force of the cable in the `n`th place of a block when last evaluated [N].
    pub fn force(&self, block: &Block, n: usize) -> f64 {
        let place = block.memory + n;
        if self.weight[place] == 0.0 {
            return 0.0;
        }
        let span2: f64 = block.span.iter().map(|component| component * component).sum();
        let length = (self.change[place] + span2).sqrt();
        block.stiffness * (length - block.rest_length).max(0.0)
    }

    /// Takes the cable in the `n`th place of a block away; returns the elastic energy lost with it [J].
    pub fn cut(&mut self, block: &Block, n: usize) -> f64 {
        let (place, force) = (block.memory + n, self.force(block, n));
        let lost = 0.5 * self.weight[place] * force * force / block.stiffness;
        self.weight.to_mut()[place] = 0.0;
        // It pulled until now: through the first half of the kick.
        self.pull.part.iter_mut().for_each(|pull| pull[place] *= 0.5);
        lost
    }

    /// What cables pull with.
    #[inline(always)]
    pub fn pulls(&self) -> Pulls<'_> {
        Pulls(self.pull.slices())
    }
}

/// [`Tension`] during the evaluation of many blocks.
pub struct Slices<'a> {
    weight: &'a [f64],
    change: &'a mut [f64],
    pull: [&'a mut [f64]; 3],
    state: &'a mut [State],
}

impl Slices<'_> {
    /// Evaluates every cable of `block` at displacements `u` [m].
    ///
    /// The force is N = k (L − L0)₊. Central differences bring a cable that becomes taut halfway between two steps to its
    /// exact amplitude v/ω, and one that becomes taut on a step (ωh)²/8 too far; between, by (1 − 2q)² of that at the part q
    /// of the step, and alike where it becomes slack. An impulse of h k σ (1 − 2q)²/8 = h k (s₀ + s₁)²/8σ makes up for it, s₀
    /// and s₁ being the stretches at both ends of the step, of unlike sign, and σ = |s₀| + |s₁|; the pull includes it. There
    /// both are close to 0, so that s = (L² − L0²) / (L + L0) with the present L serves both. No branch but the first: they
    /// would be taken at random.
    #[inline(always)]
    pub fn evaluate<S: Simd>(&mut self, simd: S, block: &Block, u: [&[f64]; 3]) -> Stress {
        let (zero, half) = (Wide::splat(simd, 0.0), Wide::splat(simd, 0.5));
        let tiny = Wide::splat(simd, f64::MIN_POSITIVE);
        let rest_length = Wide::splat(simd, block.rest_length);
        let stiffness = Wide::splat(simd, block.stiffness);
        let span = block.span.map(|component| Wide::splat(simd, component));
        let slack2 = rest_length * rest_length;
        let eighth = Wide::splat(simd, 0.125) * stiffness;
        let span2 = square(span);
        let excess_at_rest = span2 - slack2;
        // Slices of one length, so that one check of bounds serves them all.
        let room = block.len.next_multiple_of(LANES);
        let places = block.memory..block.memory + room;
        let at_ends =
            [block.first, block.second].map(|from| u.map(|component| &component[from..from + room]));
        let weights = &self.weight[places.clone()];
        let changes = &mut self.change[places.clone()];
        let pulls = self.pull.each_mut().map(|pull| &mut pull[places.clone()]);
        let states = &mut self.state[places];
        let (mut energy, mut greatest) = ([0.0; LANES], [0.0; LANES]);
        for at in (0..room).step_by(Wide::<S>::LEN) {
            let mut d = between(simd, at_ends, at);
            for c in 0..3 {
                d[c] = d[c] + span[c];
            }
            let length2 = square(d);
            let weight = Wide::load(simd, weights, at);
            let there = zero.less(weight);
            let (change, excess) = (length2 - span2, length2 - slack2);
            let before = Wide::load(simd, changes, at) + excess_at_rest;
            change.store(changes, at);
            let was = states[at];
            let taut = zero.less(excess).and(there);
            if taut.any() {
                states[at] = State::Taut;
            } else {
                states[at] = State::Slack;
                match was {
                    State::Slack => continue,
                    State::Slackened => {
                        for c in 0..3 {
                            zero.store(pulls[c], at);
                        }
                        continue;
                    }
                    State::Taut => states[at] = State::Slackened,
                }
            }
            let length = length2.sqrt();
            // Empty places count as slack.
            let positive = there.select(length - rest_length, zero).max(zero);
            let force = stiffness * positive;
            (half * weight * force * positive).add_to(&mut energy, at % LANES);
            force.max(Wide::load(simd, &greatest, at % LANES)).store(&mut greatest, at % LANES);
            let switches = taut.differs(zero.less(before).and(there));
            let apart = (excess - before).abs() * (length + rest_length);
            let sum = excess + before;
            let above = switches.select(force.times_plus(apart, eighth * sum * sum), force);
            let below = switches.select(apart * length, length).max(tiny);
            let per_length = above / below;
            for c in 0..3 {
                (per_length * d[c]).store(pulls[c], at);
            }
        }
        Stress { energy, force: greatest }
    }
}

/// Pulls of all cables by component [N], in slices of one length (`n_elements`).
#[derive(Clone, Copy, Debug)]
pub struct Pulls<'a>([&'a [f64]; 3]);

impl Pulls<'_> {
    /// Their sum at the tires where cables begin and end, from `offset` in their pack on [N].
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, [begin, end]: [&[u32]; 2], offset: usize) -> [Wide<S>; 3] {
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

#[inline(always)]
fn square<S: Simd>([x, y, z]: [Wide<S>; 3]) -> Wide<S> {
    z.times_plus(z, y.times_plus(y, x * x))
}

/// From the first to the second ends of cables, from `at` on.
#[inline(always)]
fn between<S: Simd>(simd: S, [first, second]: [[&[f64]; 3]; 2], at: usize) -> [Wide<S>; 3] {
    std::array::from_fn(|c| Wide::load(simd, second[c], at) - Wide::load(simd, first[c], at))
}
