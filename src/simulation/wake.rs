//! Which tires and cables need work: the wake front.
//!
//! Tires are kept in packs of eight elements, cables in blocks. A pack *moves* while any of its tires has speed or height;
//! it is *awake* (its tires are kicked) while it or a pack tied to it moves, since only then can its forces differ from
//! those under which it was last found at rest; a block is evaluated while any pack it touches is awake. Everything else
//! lies exactly as it did, so nothing is approximated.

use super::cable::Blocks;
use super::pack::LANES;

/// Which packs of tires each block of cables ties together.
#[derive(Debug)]
pub struct Ties {
    blocks_at: Lists,
    packs_of: Lists,
}

/// The packs and blocks that need work in a step, each list in ascending order.
#[derive(Debug)]
pub struct Wake<'a> {
    ties: &'a Ties,
    /// Packs whose tires are kicked.
    pub awake: Vec<usize>,
    /// Blocks to evaluate.
    pub blocks: Vec<usize>,
    /// Blocks that were evaluated before the lists last changed.
    pub blocks_before: Vec<usize>,
    moving: Vec<bool>,
    movers: Vec<usize>,
    changed: bool,
    pack_mark: Vec<bool>,
    block_mark: Vec<bool>,
}

impl Ties {
    /// Of all blocks.
    pub fn new(blocks: &Blocks, tires: usize) -> Self {
        let n_packs = tires.div_ceil(LANES);
        let n_blocks = blocks.blocks.len();
        let mut touches: Vec<(usize, usize)> = Vec::new();
        for (n, block) in blocks.blocks.iter().enumerate() {
            let packs = |end: usize| end / LANES..=(end + block.len - 1) / LANES;
            let first = packs(block.first);
            let apart = packs(block.second).filter(|pack| !first.contains(pack));
            touches.extend(first.clone().chain(apart).map(|pack| (n, pack)));
        }
        Self {
            packs_of: Lists::new(n_blocks, touches.iter().copied()),
            blocks_at: Lists::new(n_packs, touches.iter().map(|&(block, pack)| (pack, block))),
        }
    }
}

impl<'a> Wake<'a> {
    /// Everything asleep.
    pub fn new(ties: &'a Ties) -> Self {
        let (n_packs, n_blocks) = (ties.blocks_at.keys(), ties.packs_of.keys());
        Self {
            ties,
            awake: Vec::with_capacity(n_packs),
            blocks: Vec::with_capacity(n_blocks),
            blocks_before: Vec::with_capacity(n_blocks),
            moving: vec![false; n_packs],
            movers: Vec::with_capacity(2 * n_packs),
            changed: false,
            pack_mark: vec![false; n_packs],
            block_mark: vec![false; n_blocks],
        }
    }

    /// Notes whether a pack moves.
    #[inline(always)]
    pub fn set_moving(&mut self, pack: usize, moving: bool) {
        if self.moving[pack] != moving {
            self.moving[pack] = moving;
            self.changed = true;
            if moving {
                self.movers.push(pack);
            }
        }
    }

    /// Brings the lists up to date; whether they changed.
    pub fn refresh(&mut self) -> bool {
        if !self.changed {
            return false;
        }
        self.changed = false;
        std::mem::swap(&mut self.blocks, &mut self.blocks_before);
        let Self { awake, blocks, moving, movers, pack_mark, block_mark, .. } = self;
        let Ties { blocks_at, packs_of } = self.ties;
        movers.retain(|&pack| moving[pack] && !std::mem::replace(&mut pack_mark[pack], true));
        movers.iter().for_each(|&pack| pack_mark[pack] = false);
        unite(blocks, block_mark, movers.iter().flat_map(|&pack| blocks_at.of(pack)).copied());
        let neighbours = blocks.iter().flat_map(|&block| packs_of.of(block));
        unite(awake, pack_mark, movers.iter().chain(neighbours).copied());
        unite(blocks, block_mark, awake.iter().flat_map(|&pack| blocks_at.of(pack)).copied());
        true
    }
}

/// `into` becomes the sorted set of `items`; `mark` is all false before and after.
fn unite(into: &mut Vec<usize>, mark: &mut [bool], items: impl Iterator<Item = usize>) {
    into.clear();
    into.extend(items.filter(|&item| !std::mem::replace(&mut mark[item], true)));
    // A long list is sorted faster by reading the marks in order.
    if into.len() * 16 > mark.len() {
        into.clear();
        into.extend(mark.iter().enumerate().filter_map(|(item, &marked)| marked.then_some(item)));
        mark.fill(false);
    } else {
        into.iter().for_each(|&item| mark[item] = false);
        into.sort_unstable();
    }
}

/// A list of indices for each of many keys, in one allocation.
#[derive(Clone, Debug)]
struct Lists {
    start: Vec<usize>,
    items: Vec<usize>,
}

impl Lists {
    /// From `(key, item)` pairs; items of a key keep their order.
    fn new(keys: usize, pairs: impl Iterator<Item = (usize, usize)> + Clone) -> Self {
        let mut start = vec![0; keys + 1];
        for (key, _) in pairs.clone() {
            start[key + 1] += 1;
        }
        for key in 0..keys {
            start[key + 1] += start[key];
        }
        let (mut next, mut items) = (start.clone(), vec![0; start[keys]]);
        for (key, item) in pairs {
            items[next[key]] = item;
            next[key] += 1;
        }
        Self { start, items }
    }

    fn keys(&self) -> usize {
        self.start.len() - 1
    }

    fn of(&self, key: usize) -> &[usize] {
        &self.items[self.start[key]..self.start[key + 1]]
    }
}
