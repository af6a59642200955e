//! Cables in blocks of equal ones, eight at a time: the tension law over the flat arrays of the stepping loop.
//!
//! Cables whose tires follow one another (a row of a mesh) and that share span, length and stiffness form a run: both ends
//! lie one after the other in memory, and the same code takes eight neighbouring cables of one run, or one cable of eight
//! runs that advance together. Long runs are cut into blocks, the unit that sleeps and wakes.

use crate::scene::Scene;

/// Elements handled at once.
pub const LANES: usize = 8;
/// Most cables in a block. The order of summation follows from it, so it is the same for any number of lanes.
const CABLES: usize = 32;
/// Most elements in a block.
pub const BLOCK: usize = CABLES * LANES;

/// One value per lane.
pub type Pack = [f64; LANES];

/// Equal cables whose ends follow one another in memory.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// First element of the first ends.
    pub first: usize,
    /// First element of the second ends.
    pub second: usize,
    /// Elements (cables × lanes per cable).
    pub len: usize,
    /// Index of its first cable in the order of [`Blocks::cable`].
    pub cable: usize,
    /// Span at rest [m].
    pub span: [f64; 3],
    /// L0 [m].
    pub rest_length: f64,
    /// k [N/m].
    pub stiffness: f64,
    /// How many cables of the whole scene each stands for.
    pub weight: f64,
    /// Where its stretches are remembered; whole packs.
    pub memory: usize,
}

/// All cables of a scene.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// In the order in which they are evaluated.
    pub blocks: Vec<Block>,
    /// Scene's cable index by place in the blocks (`n_cables`).
    pub cable: Vec<usize>,
}

impl Blocks {
    /// Sorts the scene's cables into runs and cuts them, for arrays with `width` elements per tire.
    ///
    /// `weight` says how many cables of the whole scene each stands for.
    pub fn new(scene: &Scene, weight: &[f64], width: usize) -> Self {
        let mut cable: Vec<usize> = (0..scene.cables.len()).collect();
        let ends = |c: usize| {
            let [a, b] = scene.cables[c].ends;
            (b as isize - a as isize, a)
        };
        cable.sort_by_key(|&c| ends(c));
        let mut blocks: Vec<Block> = Vec::new();
        for (place, &c) in cable.iter().enumerate() {
            let new = &scene.cables[c];
            let [first, second] = new.ends.map(|end| end * width);
            let continues = blocks.last().is_some_and(|last| {
                last.len < CABLES * width
                    && last.first + last.len == first
                    && last.second + last.len == second
                    && last.span == <[f64; 3]>::from(new.span)
                    && last.rest_length == new.rest_length
                    && last.stiffness == new.stiffness
                    && last.weight == weight[c]
            });
            match blocks.last_mut().filter(|_| continues) {
                Some(last) => last.len += width,
                None => blocks.push(Block {
                    first,
                    second,
                    len: width,
                    cable: place,
                    span: new.span.into(),
                    rest_length: new.rest_length,
                    stiffness: new.stiffness,
                    weight: weight[c],
                    memory: 0,
                }),
            }
        }
        let mut remembered = 0;
        for block in &mut blocks {
            block.memory = remembered;
            remembered += block.len.next_multiple_of(LANES);
        }
        Self { blocks, cable }
    }
}

/// Components of a vector field over all elements, with room for one pack more.
#[derive(Clone, Debug)]
pub struct Field {
    /// x, y, z (`n_elements` + [`LANES`]).
    pub part: [Vec<f64>; 3],
}

impl Field {
    /// A field of zeros over `elements`.
    pub fn zeros(elements: usize) -> Self {
        Self { part: std::array::from_fn(|_| vec![0.0; elements + LANES]) }
    }
}

/// Eight values from `at` on.
#[inline(always)]
pub fn load(from: &[f64], at: usize) -> Pack {
    let mut pack = [0.0; LANES];
    pack.copy_from_slice(&from[at..at + LANES]);
    pack
}

/// Whether any lane is set; integers, whose order of summation is free.
#[inline(always)]
fn any(set: &[u64; LANES]) -> bool {
    set.iter().fold(0, |any, set| any | set) != 0
}

/// Writes eight values from `at` on.
#[inline(always)]
pub fn store(to: &mut [f64], at: usize, pack: &Pack) {
    to[at..at + LANES].copy_from_slice(pack);
}

/// What is remembered of every cable from one step to the next.
#[derive(Clone, Debug)]
pub struct Memory {
    /// L − L0 of packs that are `taut`, stale elsewhere [m].
    stretch: Vec<f64>,
    /// Whether any cable of a pack was taut.
    taut: Vec<bool>,
}

impl Memory {
    /// All slack.
    pub fn new(blocks: &Blocks) -> Self {
        let elements = blocks.blocks.last().map_or(0, |last| last.memory + last.len.next_multiple_of(LANES));
        Self { stretch: vec![0.0; elements], taut: vec![false; elements / LANES] }
    }

    /// Every `width`th cable from `lane` on is slack.
    pub fn slacken(&mut self, lane: usize, width: usize) {
        self.stretch.iter_mut().skip(lane).step_by(width).for_each(|stretch| *stretch = 0.0);
    }
}

/// Forces of one block: per element the force N and the pull on the first end.
#[derive(Clone, Debug)]
pub struct Tension {
    /// N [N] (`BLOCK`).
    pub force: [f64; BLOCK],
    /// Mean force since the last step × direction from first to second end [N] (3 × `BLOCK`); see [`Self::evaluate`].
    pub pull: [[f64; BLOCK]; 3],
    /// Whether any cable of each pack pulls.
    pub taut: [bool; BLOCK / LANES],
}

impl Tension {
    /// No force anywhere.
    pub fn zero() -> Self {
        Self { force: [0.0; BLOCK], pull: [[0.0; BLOCK]; 3], taut: [false; BLOCK / LANES] }
    }

    /// Evaluates every cable of `block` at displacements `u` [m], reached with velocities `v` [m/s] in a `step` [s].
    ///
    /// The force is N = k (L − L0)₊. Kicks weigh it by the trapezoidal rule, which is wrong by O(h²) where a cable becomes
    /// taut or slack inside a step. With stretches s₀ and s₁ of unlike sign at its ends, ∫ k s₊ dt along the line between them
    /// differs from the trapezoid by −h k |s₀ s₁| / 2(|s₀| + |s₁|); the pull includes it.
    #[inline(always)]
    pub fn evaluate(&mut self, block: &Block, u: &Field, v: &Field, step: &Pack, memory: &mut Memory) {
        let slack2 = block.rest_length * block.rest_length;
        for at in (0..block.len).step_by(LANES) {
            let live = block.len - at;
            let mut d = [[0.0; LANES]; 3];
            for c in 0..3 {
                let first = load(&u.part[c], block.first + at);
                let second = load(&u.part[c], block.second + at);
                for j in 0..LANES {
                    d[c][j] = second[j] - first[j] + block.span[c];
                }
            }
            let mut length2 = [0.0; LANES];
            let mut longer = [0_u64; LANES];
            for j in 0..LANES {
                let l2 = d[0][j] * d[0][j] + d[1][j] * d[1][j] + d[2][j] * d[2][j];
                length2[j] = if j < live { l2 } else { 0.0 };
                longer[j] = u64::from(length2[j] > slack2);
            }
            let taut = any(&longer);
            let place = block.memory + at;
            let was_taut = std::mem::replace(&mut memory.taut[place / LANES], taut);
            self.taut[at / LANES] = taut || was_taut;
            if !taut && !was_taut {
                continue;
            }
            // What was slack is found from where its tires come, whether its pack was evaluated or not, so that the result
            // does not depend on who shares its pack.
            let remembered = if was_taut { load(&memory.stretch, place) } else { [0.0; LANES] };
            let mut tightens = [0_u64; LANES];
            for j in 0..LANES {
                tightens[j] = longer[j] & u64::from(remembered[j] <= 0.0);
            }
            let mut before = remembered;
            if any(&tightens) {
                let found = Self::stretch_before(block, at, &d, v, step);
                for j in 0..LANES {
                    before[j] = if remembered[j] > 0.0 { remembered[j] } else { found[j] };
                }
            }
            let mut force = [0.0; LANES];
            let mut stretch = [0.0; LANES];
            let mut pull = [[0.0; LANES]; 3];
            for j in 0..LANES {
                let length = length2[j].sqrt();
                stretch[j] = length - block.rest_length;
                let product = before[j] * stretch[j];
                let apart = (stretch[j] - before[j]).abs().max(f64::MIN_POSITIVE);
                let switched =
                    if product < 0.0 && j < live { 0.5 * block.stiffness * product / apart } else { 0.0 };
                force[j] = (block.stiffness * stretch[j]).max(0.0);
                let per_length = (force[j] + switched) / length.max(f64::MIN_POSITIVE);
                pull[0][j] = per_length * d[0][j];
                pull[1][j] = per_length * d[1][j];
                pull[2][j] = per_length * d[2][j];
            }
            store(&mut memory.stretch, place, &stretch);
            store(&mut self.force, at, &force);
            for c in 0..3 {
                store(&mut self.pull[c], at, &pull[c]);
            }
        }
    }

    /// L − L0 of a pack a step earlier, from where its tires come [m].
    #[inline(always)]
    fn stretch_before(block: &Block, at: usize, d: &[Pack; 3], v: &Field, step: &Pack) -> Pack {
        let mut length2 = [0.0; LANES];
        for c in 0..3 {
            let first = load(&v.part[c], block.first + at);
            let second = load(&v.part[c], block.second + at);
            for j in 0..LANES {
                let earlier = d[c][j] - step[j] * (second[j] - first[j]);
                length2[j] += earlier * earlier;
            }
        }
        length2.map(|l2| l2.sqrt() - block.rest_length)
    }

    /// Adds the pulls of `block` to the forces `f` [N] on its tires.
    #[inline(always)]
    pub fn apply(&self, block: &Block, f: &mut Field) {
        for (end, sign) in [(block.first, 1.0), (block.second, -1.0)] {
            for at in (0..block.len).step_by(LANES) {
                if !self.taut[at / LANES] {
                    continue;
                }
                for c in 0..3 {
                    let mut force = load(&f.part[c], end + at);
                    let pull = load(&self.pull[c], at);
                    for j in 0..LANES {
                        force[j] += sign * pull[j];
                    }
                    store(&mut f.part[c], end + at, &force);
                }
            }
        }
    }
}
