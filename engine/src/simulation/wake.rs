//! The wake front: the tires and cables that need work in a step.
//!
//! - Tires lie in packs of eight, cables in blocks.
//! - A pack *moves* while any of its tires has speed or height.
//! - A pack is *awake* while the pack or a pack tied to it moves. On all other packs the forces are those under which the pack came
//!   to rest.
//! - A step kicks the tires of awake packs, and evaluates the blocks with an awake pack at an end.
//! - Everything else stays exactly as it is, so nothing is approximated.
//! - The wake front keeps counts of moving neighbours. So an update costs only as much as its changes.
//!
//! [`super::newmark`] uses packs of one tire and blocks of one cable.

use fixedbitset::FixedBitSet;

use super::cable_blocks::{Block, Blocks};
use super::compressed_rows::CompressedRows;
use super::pack::LANES;
use crate::scene::Scene;

/// Which blocks tie which packs of tires.
#[derive(Debug)]
pub struct Ties {
    /// For each pack, the blocks with an end at it (`n_packs`).
    blocks: CompressedRows,
    /// For each pack, the packs that its motion wakes: itself and the packs tied to it (`n_packs`).
    neighbours: CompressedRows,
    n_blocks: usize,
}

impl Ties {
    /// Ties of packs of [`LANES`] tires.
    pub fn of_blocks(blocks: &Blocks, tires: usize) -> Self {
        let (mut at_packs, mut tied) = (Vec::<(u32, u32)>::new(), Vec::<(u32, u32)>::new());
        for (n, Block { ends, len, .. }) in blocks.blocks.iter().enumerate() {
            let packs = |tire: usize, len: usize| (tire / LANES) as u32..=((tire + len - 1) / LANES) as u32;
            at_packs.extend(ends.iter().flat_map(|&end| packs(end, *len)).map(|pack| (pack, n as u32)));
            for first in packs(ends[0], *len) {
                // Slots of the block whose first end is in this pack.
                let start = (first as usize * LANES).max(ends[0]) - ends[0];
                let end = ((first as usize + 1) * LANES).min(ends[0] + len) - ends[0];
                let second = packs(ends[1] + start, end - start);
                tied.extend(second.flat_map(|second| [(first, second), (second, first)]));
            }
        }
        let n_packs = tires.div_ceil(LANES);
        tied.extend((0..n_packs as u32).map(|pack| (pack, pack)));
        Self::new(n_packs, blocks.blocks.len(), at_packs, tied)
    }

    /// Ties of single tires: packs of one tire, blocks of one cable. Nothing wakes an anchor.
    pub fn of_cables(scene: &Scene) -> Self {
        let (cables, tires) = (&scene.cables, scene.tire_count());
        let ends = || cables.iter().map(|cable| cable.ends.map(|end| end as u32)).zip(0..);
        let at_packs = ends().flat_map(|([a, b], n)| [(a, n), (b, n)]).collect();
        let itself = (0..tires as u32).map(|tire| (tire, tire));
        let tied = ends().flat_map(|([a, b], _)| [(a, b), (b, a)]).chain(itself);
        let tied = tied.filter(|&(_, woken)| !scene.is_anchor(woken as usize)).collect();
        Self::new(tires, cables.len(), at_packs, tied)
    }

    fn new(n_packs: usize, n_blocks: usize, at_packs: Vec<(u32, u32)>, tied: Vec<(u32, u32)>) -> Self {
        let (blocks, neighbours) =
            (CompressedRows::sorted(n_packs, at_packs), CompressedRows::sorted(n_packs, tied));
        Self { blocks, neighbours, n_blocks }
    }
}

/// The packs and blocks that need work in a step.
#[derive(Debug)]
pub struct Wake<'a> {
    ties: &'a Ties,
    /// Awake packs, in ascending order.
    pub awake_packs: Vec<usize>,
    /// Blocks to evaluate, in ascending order.
    pub awake_blocks: Vec<usize>,
    /// Blocks that woke at the last refresh; a block may also be in [`Self::fell_asleep`].
    pub woke: Vec<usize>,
    /// Blocks that fell asleep at the last refresh.
    pub fell_asleep: Vec<usize>,
    /// Packs that move.
    moving: FixedBitSet,
    /// Packs that are counted as moving in `moving_neighbours`.
    counted: FixedBitSet,
    /// Packs set moving or resting since the last refresh.
    changed: Vec<usize>,
    /// Number of moving neighbours of each pack (`n_packs`).
    moving_neighbours: Vec<u32>,
    /// Number of awake packs at the ends of each block (`n_blocks`).
    awake_ends: Vec<u32>,
    /// Awake packs, as a set.
    awake_set: FixedBitSet,
    /// Blocks to evaluate, as a set.
    block_set: FixedBitSet,
}

impl<'a> Wake<'a> {
    /// Wake front with everything asleep.
    pub fn new(ties: &'a Ties) -> Self {
        let (n_packs, n_blocks) = (ties.neighbours.keys(), ties.n_blocks);
        Self {
            ties,
            awake_packs: Vec::with_capacity(n_packs),
            awake_blocks: Vec::with_capacity(n_blocks),
            woke: Vec::with_capacity(n_blocks),
            fell_asleep: Vec::with_capacity(n_blocks),
            moving: FixedBitSet::with_capacity(n_packs),
            counted: FixedBitSet::with_capacity(n_packs),
            changed: Vec::with_capacity(2 * n_packs),
            moving_neighbours: vec![0; n_packs],
            awake_ends: vec![0; n_blocks],
            awake_set: FixedBitSet::with_capacity(n_packs),
            block_set: FixedBitSet::with_capacity(n_blocks),
        }
    }

    /// Sets whether a pack moves, from the next refresh on.
    #[inline(always)]
    pub fn set_moving(&mut self, pack: usize, moving: bool) {
        if self.moving.contains(pack) != moving {
            self.moving.set(pack, moving);
            self.changed.push(pack);
        }
    }

    /// Sets all packs moving, from the next refresh on.
    pub fn set_all_moving(&mut self) {
        (0..self.moving_neighbours.len()).for_each(|pack| self.set_moving(pack, true));
    }

    /// Awake tires, where every pack is one tire.
    pub fn awake_tires(&self) -> &[usize] {
        &self.awake_packs
    }

    /// Cables to evaluate, where every block is one cable.
    pub fn awake_cables(&self) -> &[usize] {
        &self.awake_blocks
    }

    /// Whether a pack was awake at the last refresh.
    #[inline(always)]
    pub fn is_awake(&self, pack: usize) -> bool {
        self.awake_set.contains(pack)
    }

    /// Updates the lists of awake packs and blocks. Returns whether a pack was set moving or resting since the last refresh.
    pub fn refresh(&mut self) -> bool {
        if self.changed.is_empty() {
            return false;
        }
        self.woke.clear();
        self.fell_asleep.clear();
        let Self { ties, moving_neighbours, awake_ends, awake_set, block_set, .. } = self;
        for pack in self.changed.drain(..) {
            let moves = self.moving.contains(pack);
            if self.counted.contains(pack) == moves {
                continue;
            }
            self.counted.set(pack, moves);
            for &neighbour in ties.neighbours.of(pack) {
                let neighbour = neighbour as usize;
                moving_neighbours[neighbour] =
                    if moves { moving_neighbours[neighbour] + 1 } else { moving_neighbours[neighbour] - 1 };
                if moving_neighbours[neighbour] != u32::from(moves) {
                    continue;
                }
                awake_set.set(neighbour, moves);
                for &block in ties.blocks.of(neighbour) {
                    let block = block as usize;
                    awake_ends[block] = if moves { awake_ends[block] + 1 } else { awake_ends[block] - 1 };
                    if awake_ends[block] == u32::from(moves) {
                        block_set.set(block, moves);
                        if moves { &mut self.woke } else { &mut self.fell_asleep }.push(block);
                    }
                }
            }
        }
        self.awake_packs.clear();
        self.awake_packs.extend(awake_set.ones());
        self.awake_blocks.clear();
        self.awake_blocks.extend(block_set.ones());
        true
    }
}

#[cfg(test)]
pub mod tests {
    use itertools::Itertools;
    use nalgebra::{Vector2, Vector3};

    use super::*;
    use crate::outcome::Outcome;
    use crate::scene::{Cable, Firing, Shot, TireId};

    impl Ties {
        /// The same ties, but any motion wakes everything.
        pub fn with_everything(self) -> Self {
            let packs = 0..self.neighbours.keys() as u32;
            let all = packs.clone().flat_map(|a| packs.clone().map(move |b| (a, b)));
            Self { neighbours: CompressedRows::sorted(packs.len(), all.collect()), ..self }
        }
    }

    /// A slack shelter without mirror planes, and its shots. Under them some tires never move, and others come to rest again.
    pub fn scenes() -> (Scene, Vec<Shot>) {
        let (rows, columns) = (9, 11);
        let position: Vec<Vector3<f64>> = (0..rows * columns)
            .map(|n| 1.5 * Vector3::new((n % columns) as f64, (n / columns) as f64, 0.0))
            .collect();
        let tie = |[a, b]: [usize; 2]| {
            let span = position[b] - position[a];
            let rest_length = 1.01 * span.norm();
            Cable { ends: [a, b], rest_length, stiffness: 1.5e6 / rest_length, span }
        };
        // Neighbours are at most one row and one column apart.
        let pairs = (0..rows * columns).tuple_combinations().map(|(a, b)| [a, b]);
        let near = |[a, b]: &[usize; 2]| (position[*b] - position[*a]).norm() < 2.2;
        let cables = pairs.filter(near).map(tie).collect();
        let scene = Scene {
            mass: vec![280.0; rows * columns],
            tire_ids: (1..=rows * columns).map(TireId::Listed).collect(),
            cables,
            friction: 0.5,
            gravity: 9.81,
            downhill: Vector2::zeros(),
            restitution: 0.0,
            damping: 0.0,
            breaking_force: None,
            strength: Vec::new(),
            mirrors: Vec::new(),
            position,
        };
        let fired = |interval: f64, launch: f64| {
            let tires = [3, 38, 3, 90, 41].into_iter().enumerate();
            Shot::from_firings(tires.map(|(n, tire)| Firing::up(n as f64 * interval, tire, launch)).collect())
        };
        (scene, vec![fired(0.017, 3.0), fired(0.11, 6.0), fired(0.6, 0.5), fired(2.0, 8.0)])
    }

    /// Bits of the results that do not depend on the order of sums.
    pub fn exact(run: &Outcome) -> [u64; 8] {
        let [height, force, drift] = [run.height, run.force, run.drift];
        [
            height.value,
            height.time,
            force.value,
            force.time,
            drift.value,
            drift.time,
            run.ledger.put_in,
            run.steps as f64,
        ]
        .map(f64::to_bits)
    }
}
