//! Cables in blocks of parallel cables: their order in memory, and the tires on which each cable acts.
//!
//! - Cables form a *run* if their tires follow one another (a row of a mesh) and their spans are equal.
//! - In a run, the first ends lie one after the other in memory, and so do the second ends. So one register takes several
//!   neighbouring cables.
//! - A missing cable (at the end of a mesh row) leaves an empty slot, so that a run continues from row to row.
//! - Long runs are cut into blocks. A block sleeps and wakes as one unit.

use std::sync::Arc;

use nalgebra::Vector3;

use super::compressed_rows::CompressedRows;
use super::pack::LANES;
use crate::scene::{Cable, Scene};

/// Greatest number of slots in a block: four packs. The sums of a block then cost little beside its cables, and a block sleeps
/// while the next one moves.
const BLOCK_SLOTS: usize = 32;
/// Greatest number of empty slots between two cables of a run: half a pack. Beyond that, two separate runs take no more registers.
const EMPTY_SLOTS: usize = 4;
/// Marks an empty slot, in place of the index of a cable.
const NONE: u32 = u32::MAX;

/// Cables of one span whose tires follow one another.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Tires of slot 0, even if the slot is empty. The cable in slot n joins tires `ends[0] + n` and `ends[1] + n`.
    pub ends: [usize; 2],
    /// Vector from the first end of each cable to the second, as laid [m].
    pub span: Vector3<f64>,
    /// Number of slots.
    pub len: usize,
    /// Element of slot 0 in arrays over all cables; a multiple of [`LANES`].
    pub first_element: usize,
}

/// All cables of a scene. An *element* is the index of a slot in the arrays over all cables.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// Blocks, in the order in which they are evaluated.
    pub blocks: Vec<Block>,
    /// Number of cables of the whole scene that each element stands for; 0 for an empty slot (`n_elements`).
    pub weight: Arc<[f64]>,
    /// Unstretched length of each element [m]; 0 for an empty slot (`n_elements`).
    pub rest_length: Vec<f64>,
    /// Square of the unstretched length of each element [m²]; infinite for an empty slot, so that it is never taut (`n_elements`).
    pub rest_length2: Vec<f64>,
    /// Stiffness of each element [N/m]; 0 for an empty slot (`n_elements`).
    pub stiffness: Vec<f64>,
    /// Elements of the cables that act on each pack of tires.
    pub ends: Arc<Ends>,
    /// Scene's cable of each element; [`NONE`] for an empty slot (`n_elements`).
    cable: Arc<[u32]>,
}

impl Blocks {
    /// Lays out the cables of `scene`. `weight` is the number of cables of the whole scene that each cable stands for (`n_cables`).
    pub fn new(scene: &Scene, weight: &[f64]) -> Self {
        let runs = runs(&scene.cables);
        let mut blocks = Vec::with_capacity(scene.cables.len() / BLOCK_SLOTS + runs.len());
        let mut cable = Vec::with_capacity(scene.cables.len() + 3 * LANES * (runs.len() + 1));
        let mut acting = Vec::with_capacity(2 * runs.len());
        for Run { slots, ends, span } in runs {
            // A run begins in the same lane as its first tire, so that packs of cables and packs of tires coincide. A pack of spare
            // elements lies before the run. It is read with the tires of the second ends, which begin in another lane.
            let head = ends[0] % LANES;
            let begin = cable.len().next_multiple_of(LANES) + LANES;
            cable.resize(begin + head, NONE);
            for (side, tire) in ends.into_iter().enumerate() {
                for pack in tire / LANES..=(tire + slots.len() - 1) / LANES {
                    let element = begin + head + pack * LANES - tire;
                    acting.push(((2 * pack + side) as u32, element as u32));
                }
            }
            cable.extend(&slots);
            for from in (0..head + slots.len()).step_by(BLOCK_SLOTS) {
                let ends = ends.map(|tire| tire + from - head);
                let len = (head + slots.len() - from).min(BLOCK_SLOTS);
                blocks.push(Block { ends, span, len, first_element: begin + from });
            }
        }
        cable.resize(cable.len().next_multiple_of(LANES) + LANES, NONE);
        let weight = cable.iter().map(|&c| if c == NONE { 0.0 } else { weight[c as usize] }).collect();
        let packs = scene.tire_count().div_ceil(LANES);
        let ends = Ends(CompressedRows::new(2 * packs, &acting));
        let [rest_length, rest_length2, stiffness] = [(); 3].map(|()| Vec::new());
        let (ends, cable) = (ends.into(), cable.into());
        let layout = Self { blocks, weight, rest_length, rest_length2, stiffness, ends, cable };
        layout.with_numbers(|cable| &scene.cables[cable])
    }

    /// The same layout with other lengths and stiffnesses. `numbers` gives the cable for an index in the scene.
    pub fn with_numbers<'c>(&self, numbers: impl Fn(usize) -> &'c Cable) -> Self {
        let rest_length = self.by_element(|cable| numbers(cable).rest_length);
        let square =
            |(length, &cable): (&f64, &u32)| if cable == NONE { f64::INFINITY } else { length * length };
        Self {
            blocks: self.blocks.clone(),
            weight: Arc::clone(&self.weight),
            rest_length2: rest_length.iter().zip(&*self.cable).map(square).collect(),
            rest_length,
            stiffness: self.by_element(|cable| numbers(cable).stiffness),
            ends: Arc::clone(&self.ends),
            cable: Arc::clone(&self.cable),
        }
    }

    /// Cable in a slot of a block. An empty slot gives a cable of length and stiffness 0.
    pub fn cable_in(&self, block: &Block, slot: usize) -> Cable {
        let element = block.first_element + slot;
        Cable {
            ends: block.ends.map(|end| end + slot),
            span: block.span,
            rest_length: self.rest_length[element],
            stiffness: self.stiffness[element],
        }
    }

    /// Index in the scene of the cable at an element, which must hold a cable.
    pub fn cable_of(&self, element: usize) -> usize {
        self.cable[element] as usize
    }

    /// Number of each cable, by element; 0 for an empty slot (`n_elements`).
    pub fn by_element(&self, number: impl Fn(usize) -> f64) -> Vec<f64> {
        self.cable.iter().map(|&cable| if cable == NONE { 0.0 } else { number(cable as usize) }).collect()
    }

    /// Index in the scene of the cable in a slot of a block.
    pub fn cable(&self, block: usize, slot: usize) -> usize {
        self.cable[self.blocks[block].first_element + slot] as usize
    }
}

/// Cables of one span whose tires follow one another; any number of cables.
struct Run {
    /// Scene's cable in each slot; [`NONE`] for an empty slot.
    slots: Vec<u32>,
    /// Tires of the cable in slot 0, in ascending order.
    ends: [usize; 2],
    /// Vector from the first tire of each cable to the second, as laid [m].
    span: Vector3<f64>,
}

fn runs(cables: &[Cable]) -> Vec<Run> {
    let ascending = |cable: Cable| {
        let [a, b] = cable.ends;
        if a < b { cable } else { Cable { ends: [b, a], span: -cable.span, ..cable } }
    };
    let offset = |[a, b]: [usize; 2]| a.abs_diff(b);
    let mut order: Vec<u32> = (0..cables.len() as u32).collect();
    order.sort_by_key(|&c| {
        let cable = &cables[c as usize];
        (offset(cable.ends), cable.ends[0].min(cable.ends[1]))
    });
    let mut runs = Vec::<Run>::new();
    for c in order {
        let new = ascending(cables[c as usize]);
        let continued = runs.last_mut().and_then(|run| {
            let gap = new.ends[0].checked_sub(run.ends[0] + run.slots.len())?;
            let is_parallel = new.span == run.span && offset(new.ends) == offset(run.ends);
            (is_parallel && gap <= EMPTY_SLOTS).then_some((run, gap))
        });
        match continued {
            Some((run, gap)) => {
                run.slots.resize(run.slots.len() + gap, NONE);
                run.slots.push(c);
            }
            None => runs.push(Run { slots: vec![c], ends: new.ends, span: new.span }),
        }
    }
    runs
}

/// For each pack of tires, the elements of the cables that act on its first tire: the cables whose first end is there, and the
/// cables whose second end is there. The next tire of the pack has the next element.
#[derive(Clone, Debug)]
pub struct Ends(CompressedRows);

impl Ends {
    /// Elements of the cables with their first end at the first tire of `pack`, and of the cables with their second end there.
    #[inline(always)]
    pub fn of(&self, pack: usize) -> [&[u32]; 2] {
        [self.0.of(2 * pack), self.0.of(2 * pack + 1)]
    }
}
