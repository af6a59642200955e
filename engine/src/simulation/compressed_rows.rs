//! Lists of indices, one per key, in compressed rows. All lists together take two allocations.

/// Lists of indices, one per key.
#[derive(Clone, Debug)]
pub struct CompressedRows {
    /// Offset of each key's list in `items`, and the end of the last list (`n_keys` + 1).
    start: Vec<u32>,
    /// Items of all keys, one list after the other (`n_items`).
    items: Vec<u32>,
}

impl CompressedRows {
    /// Lists of the `(key, item)` pairs, for the keys from 0 to `keys` − 1. The items of a key keep the order of the pairs.
    pub fn new(keys: usize, pairs: &[(u32, u32)]) -> Self {
        let mut start = vec![0; keys + 1];
        for &(key, _) in pairs {
            start[key as usize + 1] += 1;
        }
        for key in 0..keys {
            start[key + 1] += start[key];
        }
        let (mut next, mut items) = (start.clone(), vec![0; pairs.len()]);
        for &(key, item) in pairs {
            let next = &mut next[key as usize];
            items[*next as usize] = item;
            *next += 1;
        }
        Self { start, items }
    }

    /// Lists of the `(key, item)` pairs, which may come in any order and more than once. Each list ascends and holds an item once.
    pub fn sorted(keys: usize, mut pairs: Vec<(u32, u32)>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        Self::new(keys, &pairs)
    }

    /// Number of keys.
    pub fn keys(&self) -> usize {
        self.start.len() - 1
    }

    /// Items of `key`.
    #[inline(always)]
    pub fn of(&self, key: usize) -> &[u32] {
        &self.items[self.start[key] as usize..self.start[key + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_keep_their_order_unless_sorted() {
        let pairs = [(2, 7), (0, 5), (2, 1), (2, 7)];
        let [ordered, sorted] = [CompressedRows::new(3, &pairs), CompressedRows::sorted(3, pairs.to_vec())];
        assert_eq!([0, 1, 2].map(|key| ordered.of(key).to_vec()), [vec![5], vec![], vec![7, 1, 7]]);
        assert_eq!([0, 1, 2].map(|key| sorted.of(key).to_vec()), [vec![5], vec![], vec![1, 7]]);
        assert_eq!(sorted.keys(), 3);
    }
}
