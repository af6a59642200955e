//! Which tires and cables need work: the wake front.
//!
//! Tires are kept in packs of eight, cables in blocks. A pack *moves* while any of its tires has speed or height; it is
//! *awake* (its tires are kicked) while it or a pack tied to it moves, since only then can its forces differ from those under
//! which it was last found at rest; a block is evaluated while any pack it touches is awake. Everything else lies exactly as
//! it did, so nothing is approximated. Counts are kept, so that a step costs what changes in it. [`super::newmark`] uses packs
//! of one tire and blocks of one cable.

use fixedbitset::FixedBitSet;

use super::cable::Blocks;
use super::pack::LANES;
use crate::scene::Cable;

/// What ties packs of tires together.
#[derive(Debug)]
pub struct Ties {
    /// By pack, the blocks that touch it.
    blocks: Lists,
    /// By pack, those tied to it, and itself.
    neighbours: Lists,
    n_blocks: usize,
}

impl Ties {
    /// Of packs of eight tires.
    pub fn of_blocks(blocks: &Blocks, tires: usize) -> Self {
        let (mut touches, mut tied) = (Vec::<(u32, u32)>::new(), Vec::<(u32, u32)>::new());
        for (n, block) in blocks.blocks.iter().enumerate() {
            let packs = |end: usize, len: usize| (end / LANES) as u32..=((end + len - 1) / LANES) as u32;
            touches.extend(
                packs(block.first, block.len).chain(packs(block.second, block.len)).map(|p| (p, n as u32)),
            );
            for first in packs(block.first, block.len) {
                // The part of the block that begins at this pack, and where it ends.
                let from = (first as usize * LANES).max(block.first) - block.first;
                let to = ((first as usize + 1) * LANES).min(block.first + block.len) - block.first;
                let second = packs(block.second + from, to - from);
                tied.extend(second.flat_map(|second| [(first, second), (second, first)]));
            }
        }
        Self::new(tires.div_ceil(LANES), blocks.blocks.len(), touches, tied)
    }

    /// Of single tires.
    pub fn of_cables(cables: &[Cable], tires: usize) -> Self {
        let ends = || cables.iter().map(|cable| cable.ends.map(|end| end as u32)).zip(0..);
        let touches = ends().flat_map(|([a, b], n)| [(a, n), (b, n)]).collect();
        let tied = ends().flat_map(|([a, b], _)| [(a, b), (b, a)]).collect();
        Self::new(tires, cables.len(), touches, tied)
    }

    fn new(n_packs: usize, n_blocks: usize, touches: Vec<(u32, u32)>, mut tied: Vec<(u32, u32)>) -> Self {
        tied.extend((0..n_packs as u32).map(|pack| (pack, pack)));
        Self { blocks: Lists::new(n_packs, touches), neighbours: Lists::new(n_packs, tied), n_blocks }
    }
}

/// The packs and blocks that need work in a step.
#[derive(Debug)]
pub struct Wake<'a> {
    ties: &'a Ties,
    /// Packs whose tires are kicked, ascending.
    pub awake: Vec<usize>,
    /// Blocks to evaluate, ascending.
    pub blocks: Vec<usize>,
    /// Blocks that woke and that fell asleep when the lists last changed; one may be in both.
    pub woke: Vec<usize>,
    /// See [`Self::woke`].
    pub fell_asleep: Vec<usize>,
    /// Whether each pack moves, and whether it is counted so.
    moving: FixedBitSet,
    counted: FixedBitSet,
    changed: Vec<usize>,
    /// How many of a pack's neighbours move.
    near: Vec<u32>,
    /// How many of a block's packs are awake.
    active: Vec<u32>,
    awake_set: FixedBitSet,
    block_set: FixedBitSet,
}

impl<'a> Wake<'a> {
    /// Everything asleep.
    pub fn new(ties: &'a Ties) -> Self {
        let (n_packs, n_blocks) = (ties.neighbours.keys(), ties.n_blocks);
        Self {
            ties,
            awake: Vec::with_capacity(n_packs),
            blocks: Vec::with_capacity(n_blocks),
            woke: Vec::with_capacity(n_blocks),
            fell_asleep: Vec::with_capacity(n_blocks),
            moving: FixedBitSet::with_capacity(n_packs),
            counted: FixedBitSet::with_capacity(n_packs),
            changed: Vec::with_capacity(2 * n_packs),
            near: vec![0; n_packs],
            active: vec![0; n_blocks],
            awake_set: FixedBitSet::with_capacity(n_packs),
            block_set: FixedBitSet::with_capacity(n_blocks),
        }
    }

    /// Notes whether a pack moves.
    #[inline(always)]
    pub fn set_moving(&mut self, pack: usize, moving: bool) {
        if self.moving.contains(pack) != moving {
            self.moving.set(pack, moving);
            self.changed.push(pack);
        }
    }

    /// Whether a pack was awake when the lists last changed.
    #[inline(always)]
    pub fn is_awake(&self, pack: usize) -> bool {
        self.awake_set.contains(pack)
    }

    /// Brings the lists up to date; whether they changed.
    pub fn refresh(&mut self) -> bool {
        if self.changed.is_empty() {
            return false;
        }
        self.woke.clear();
        self.fell_asleep.clear();
        let Self { ties, near, active, awake_set, block_set, .. } = self;
        for pack in self.changed.drain(..) {
            let moves = self.moving.contains(pack);
            if self.counted.contains(pack) == moves {
                continue;
            }
            self.counted.set(pack, moves);
            for &neighbour in ties.neighbours.of(pack) {
                let neighbour = neighbour as usize;
                near[neighbour] = if moves { near[neighbour] + 1 } else { near[neighbour] - 1 };
                if near[neighbour] != u32::from(moves) {
                    continue;
                }
                awake_set.set(neighbour, moves);
                for &block in ties.blocks.of(neighbour) {
                    let block = block as usize;
                    active[block] = if moves { active[block] + 1 } else { active[block] - 1 };
                    if active[block] == u32::from(moves) {
                        block_set.set(block, moves);
                        if moves { &mut self.woke } else { &mut self.fell_asleep }.push(block);
                    }
                }
            }
        }
        self.awake.clear();
        self.awake.extend(awake_set.ones());
        self.blocks.clear();
        self.blocks.extend(block_set.ones());
        true
    }
}

/// A sorted list of indices for each of many keys, in one allocation.
#[derive(Debug)]
struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// From `(key, item)` pairs in any order, some of them more than once.
    fn new(keys: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut start = vec![0; keys + 1];
        for (key, _) in &pairs {
            start[*key as usize + 1] += 1;
        }
        for key in 0..keys {
            start[key + 1] += start[key];
        }
        Self { start, items: pairs.into_iter().map(|(_, item)| item).collect() }
    }

    fn keys(&self) -> usize {
        self.start.len() - 1
    }

    fn of(&self, key: usize) -> &[u32] {
        &self.items[self.start[key] as usize..self.start[key + 1] as usize]
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::outcome::Outcome;
    use crate::plan::Plan;
    use crate::scene::{Firing, Scene, Shot};

    impl Ties {
        /// The same, but whatever moves wakes everything.
        pub fn with_everything(self) -> Self {
            let packs = 0..self.neighbours.keys() as u32;
            let all = packs.clone().flat_map(|a| packs.clone().map(move |b| (a, b)));
            Self { neighbours: Lists::new(packs.len(), all.collect()), ..self }
        }
    }

    /// A slack shelter without mirror planes, and shots of it that leave parts of it at rest and find others at rest again.
    pub fn scenes() -> (Scene, Vec<Shot>) {
        let plan = "title = ''\n[shelter]\nlayout = 'grid'\nrows = 9\ncolumns = 11\nspacing_m = 1.5\n\
                    [tire]\nmass_kg = 280\n[cable]\naxial_stiffness_kn = 1500\nbreaking_force_kn = 40\n\
                    slack_percent = 1\n[ground]\nfriction = 0.5\n\
                    [[blast_row]]\nname = '1'\nunder_row = 2\nlaunch_m_s = 6\n\
                    [limits]\nflight_height_m = 2\ncable_safety_factor = 2\n\
                    [[delay]]\nname = '0'\ninterval_ms = 0\n";
        let mut scene = Scene::build(&Plan::parse("slack", plan).expect("a plan"));
        scene.mirrors.clear();
        let fired = |interval: f64, launch: f64| {
            let tires = [3, 38, 3, 90, 41].into_iter().enumerate();
            Shot::from_firings(
                tires.map(|(n, tire)| Firing { at: n as f64 * interval, tire, launch }).collect(),
            )
        };
        (scene, vec![fired(0.017, 3.0), fired(0.11, 6.0), fired(0.6, 0.5), fired(2.0, 8.0)])
    }

    /// All that is counted over what moves, as bits; the order of sums decides the last digits of the rest.
    pub fn exact(run: &Outcome) -> [u64; 8] {
        let [height, force, drift] = [run.height, run.force, run.drift];
        [
            height.value,
            height.at,
            force.value,
            force.at,
            drift.value,
            drift.at,
            run.ledger.put_in,
            run.steps as f64,
        ]
        .map(f64::to_bits)
    }
}
