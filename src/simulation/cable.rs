//! Cables in blocks of equal ones: how they lie in memory, and which of them pull at which tires.
//!
//! Cables whose tires follow one another (a row of a mesh) and that share span, length and stiffness form a run: both ends
//! lie one after the other in memory, so that neighbouring cables are taken together. Where a cable is missing (at the end
//! of a mesh row) its place stays empty, so that a run goes on from row to row. Long runs are cut into blocks, the unit that
//! sleeps and wakes.

use std::ops::Range;

use super::pack::{Aligned, LANES};
use crate::scene::{Cable, Scene};

/// Most places in a block.
const PLACES: usize = 32;
/// Most places left empty between two cables of a run.
const EMPTY: usize = 4;
/// The cable of an empty place.
const NONE: u32 = u32::MAX;

/// Equal cables whose ends follow one another in memory.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Tire at its first first end.
    pub first: usize,
    /// Tire at its first second end.
    pub second: usize,
    /// Places.
    pub len: usize,
    /// Its first element in arrays over all cables; a multiple of [`LANES`].
    pub memory: usize,
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
    /// How many cables of the whole scene each element stands for, 0 where there is none (`n_elements`).
    pub weight: Vec<f64>,
    /// Which elements pull at the tires of each pack.
    pub ends: Ends,
    /// Scene's cable by element, [`NONE`] where there is none (`n_elements`).
    cable: Vec<u32>,
}

impl Blocks {
    /// Lays out the scene's cables; `weight` says how many cables of the whole scene each stands for (`n_cables`).
    pub fn new(scene: &Scene, weight: &[f64]) -> Self {
        let runs = runs(&scene.cables);
        let mut blocks = Vec::with_capacity(scene.cables.len() / PLACES + runs.len());
        let mut cable = Vec::with_capacity(scene.cables.len() + 3 * LANES * (runs.len() + 1));
        let mut ends = Vec::with_capacity(2 * runs.len());
        for Run { places, like } in runs {
            let Cable { ends: tires, rest_length, stiffness, span } = like;
            // Packs of cables begin at the same tires as packs of tires. A pack of tires reaches over the second ends of a
            // run by up to a pack.
            let head = tires[0] % LANES;
            let begin = cable.len().next_multiple_of(LANES) + LANES;
            cable.resize(begin + head, NONE);
            ends.extend(tires.map(|tire| (tire..tire + places.len(), begin + head)));
            cable.extend(&places);
            for from in (0..head + places.len()).step_by(PLACES) {
                let [first, second] = tires.map(|tire| tire + from - head);
                let len = (head + places.len() - from).min(PLACES);
                let memory = begin + from;
                blocks.push(Block { first, second, len, memory, span: span.into(), rest_length, stiffness });
            }
        }
        cable.resize(cable.len().next_multiple_of(LANES) + LANES, NONE);
        let weight = cable.iter().map(|&c| if c == NONE { 0.0 } else { weight[c as usize] }).collect();
        let packs = scene.mass.len().div_ceil(LANES);
        Self { blocks, weight, ends: Ends::new(&ends, packs), cable }
    }

    /// Scene's index of the cable in the `n`th place of a block.
    pub fn cable(&self, block: usize, n: usize) -> usize {
        self.cable[self.blocks[block].memory + n] as usize
    }
}

/// Cables whose ends follow one another.
struct Run {
    /// The scene's cable in each place.
    places: Vec<u32>,
    /// The first of them, its ends in ascending order.
    like: Cable,
}

fn runs(cables: &[Cable]) -> Vec<Run> {
    let ascending = |cable: Cable| {
        let [a, b] = cable.ends;
        if a < b { cable } else { Cable { ends: [b, a], span: -cable.span, ..cable } }
    };
    let offset = |cable: &Cable| cable.ends[0].abs_diff(cable.ends[1]);
    let mut order: Vec<u32> = (0..cables.len() as u32).collect();
    order.sort_by_key(|&c| {
        let cable = &cables[c as usize];
        (offset(cable), cable.ends[0].min(cable.ends[1]))
    });
    let mut runs = Vec::<Run>::new();
    for c in order {
        let new = ascending(cables[c as usize]);
        let goes_on = runs.last_mut().and_then(|run| {
            let gap = new.ends[0].checked_sub(run.like.ends[0] + run.places.len())?;
            let like = offset(&new) == offset(&run.like)
                && new.span == run.like.span
                && new.rest_length == run.like.rest_length
                && new.stiffness == run.like.stiffness;
            (like && gap <= EMPTY).then_some((run, gap))
        });
        match goes_on {
            Some((run, gap)) => {
                run.places.resize(run.places.len() + gap, NONE);
                run.places.push(c);
            }
            None => runs.push(Run { places: vec![c], like: new }),
        }
    }
    runs
}

/// For every pack of tires, the elements from which its eight pulls are read: of cables that begin there, and of those that
/// end there.
#[derive(Clone, Debug)]
pub struct Ends {
    elements: Vec<u32>,
    /// Where in `elements` the list of a pack begins, first ends then second ends (2 × `n_packs` + 1).
    start: Vec<u32>,
}

impl Ends {
    /// From the elements of tires that each end of each run covers, and its first element among the cables; by turns first
    /// and second ends.
    fn new(ends: &[(Range<usize>, usize)], packs: usize) -> Self {
        let covered = |tires: &Range<usize>| tires.start / LANES..=(tires.end - 1) / LANES;
        let lists = || {
            ends.iter().enumerate().flat_map(move |(n, (tires, begin))| {
                covered(tires).map(move |pack| (2 * pack + n % 2, begin + pack * LANES - tires.start))
            })
        };
        let mut start = vec![0; 2 * packs + 1];
        lists().for_each(|(list, _)| start[list + 1] += 1);
        for list in 0..2 * packs {
            start[list + 1] += start[list];
        }
        let (mut next, mut elements) = (start.clone(), vec![0; start[2 * packs] as usize]);
        for (list, element) in lists() {
            elements[next[list] as usize] = element as u32;
            next[list] += 1;
        }
        Self { elements, start }
    }

    /// Where the pulls of cables that begin, and of those that end, at the tires of a pack are read.
    #[inline(always)]
    pub fn of(&self, pack: usize) -> [&[u32]; 2] {
        let at = |n: usize| self.start[2 * pack + n] as usize;
        [&self.elements[at(0)..at(1)], &self.elements[at(1)..at(2)]]
    }
}

/// Components of a vector field over tires or cables.
#[derive(Debug)]
pub struct Field {
    /// x, y, z, of one length.
    pub part: [Aligned; 3],
}

impl Field {
    /// Zeros.
    pub fn zeros(len: usize) -> Self {
        Self { part: std::array::from_fn(|_| Aligned::zeros(len)) }
    }

    /// The components, in slices whose lengths the compiler knows to be equal.
    #[inline(always)]
    pub fn slices(&self) -> [&[f64]; 3] {
        let [x, y, z] = &self.part;
        let n = x.len();
        [&x[..n], &y[..n], &z[..n]]
    }

    /// The same, to be written.
    #[inline(always)]
    pub fn slices_mut(&mut self) -> [&mut [f64]; 3] {
        let [x, y, z] = &mut self.part;
        let n = x.len();
        [&mut x[..n], &mut y[..n], &mut z[..n]]
    }
}
