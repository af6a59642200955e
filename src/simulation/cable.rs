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
    pub fn new(scene: &Scene, width: usize) -> Self {
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
                }),
            }
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

/// Writes eight values from `at` on.
#[inline(always)]
pub fn store(to: &mut [f64], at: usize, pack: &Pack) {
    to[at..at + LANES].copy_from_slice(pack);
}

/// Forces of one block: per element the force N and the pull on the first end.
#[derive(Clone, Debug)]
pub struct Tension {
    /// N [N] (`BLOCK`).
    pub force: [f64; BLOCK],
    /// N × direction from first to second end [N] (3 × `BLOCK`).
    pub pull: [[f64; BLOCK]; 3],
    /// Whether any cable of each pack is taut.
    pub taut: [bool; BLOCK / LANES],
}

impl Tension {
    /// No force anywhere.
    pub fn zero() -> Self {
        Self { force: [0.0; BLOCK], pull: [[0.0; BLOCK]; 3], taut: [false; BLOCK / LANES] }
    }

    /// Evaluates N = k (L − L0)₊ for every cable of `block` at displacements `u` [m].
    #[inline(always)]
    pub fn evaluate(&mut self, block: &Block, u: &Field) {
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
            let mut longest = [0.0_f64; LANES];
            for j in 0..LANES {
                let l2 = d[0][j] * d[0][j] + d[1][j] * d[1][j] + d[2][j] * d[2][j];
                length2[j] = if j < live { l2 } else { 0.0 };
                longest[j] = if length2[j] > slack2 { 1.0 } else { 0.0 };
            }
            let taut = longest.iter().sum::<f64>() > 0.0;
            self.taut[at / LANES] = taut;
            if !taut {
                continue;
            }
            let mut force = [0.0; LANES];
            let mut pull = [[0.0; LANES]; 3];
            for j in 0..LANES {
                let length = length2[j].sqrt();
                force[j] = (block.stiffness * (length - block.rest_length)).max(0.0);
                let per_length = force[j] / length.max(f64::MIN_POSITIVE);
                pull[0][j] = per_length * d[0][j];
                pull[1][j] = per_length * d[1][j];
                pull[2][j] = per_length * d[2][j];
            }
            store(&mut self.force, at, &force);
            for c in 0..3 {
                store(&mut self.pull[c], at, &pull[c]);
            }
        }
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
