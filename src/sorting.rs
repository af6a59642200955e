//! Stable sorting that is compiled once for all elements and orders.
//!
//! The sort of the standard library is compiled anew for each type of elements and each comparison. Ninety copies of it were a
//! tenth of the code to compile (`benches/RESULTS.md`, "Build time"). This module sorts places, and the elements follow. Two kinds
//! of callers use the standard library: sorts of plain numbers (`values.sort_by(f64::total_cmp)`), and studies that sort a million
//! elements.

use std::cmp::Ordering;

/// Sorts elements.
pub fn sort<T: Ord>(elements: &mut [T]) {
    sort_by(elements, T::cmp);
}

/// Sorts elements by a key.
pub fn sort_by_key<T, K: Ord>(elements: &mut [T], key: impl Fn(&T) -> K) {
    sort_by(elements, |a, b| key(a).cmp(&key(b)));
}

/// Sorts elements by a comparison.
pub fn sort_by<T>(elements: &mut [T], compare: impl Fn(&T, &T) -> Ordering) {
    let mut from = sorted_places(elements.len(), &|a, b| compare(&elements[a], &elements[b]));
    for start in 0..elements.len() {
        let mut at = start;
        while from[at] != start {
            let next = from[at];
            elements.swap(at, next);
            from[at] = at;
            at = next;
        }
        from[at] = at;
    }
}

/// Sorted elements.
pub fn sorted<T: Ord>(elements: impl IntoIterator<Item = T>) -> Vec<T> {
    sorted_by(elements, T::cmp)
}

/// Elements sorted by a key.
pub fn sorted_by_key<T, K: Ord>(elements: impl IntoIterator<Item = T>, key: impl Fn(&T) -> K) -> Vec<T> {
    sorted_by(elements, |a, b| key(a).cmp(&key(b)))
}

/// Elements sorted by a comparison.
pub fn sorted_by<T>(elements: impl IntoIterator<Item = T>, compare: impl Fn(&T, &T) -> Ordering) -> Vec<T> {
    let mut all: Vec<T> = elements.into_iter().collect();
    sort_by(&mut all, compare);
    all
}

/// For each place of the sorted list, the place from which its element comes (`len`). `compare` compares the elements at two
/// places.
fn sorted_places(len: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut places: Vec<usize> = (0..len).collect();
    places.sort_by(|&a, &b| compare(a, b));
    places
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::{prop_assert_eq, proptest};

    use super::*;

    proptest! {
        /// The same order as the standard library gives. Elements with equal keys keep their order.
        #[test]
        fn elements_are_sorted_as_by_the_standard_library(elements in vec((0_u8..20, 0_u8..20), 0..200)) {
            let mut expected = elements.clone();
            expected.sort_by_key(|(key, _)| *key);
            prop_assert_eq!(sorted_by_key(elements.clone(), |(key, _)| *key), expected.clone());
            expected.sort();
            prop_assert_eq!(sorted(elements), expected);
        }
    }
}
