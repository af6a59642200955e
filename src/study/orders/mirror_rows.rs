//! Orders that are mirror images of one another.

use itertools::Itertools;

use crate::plan::{HoleTiming, Time};
use crate::scene::Firing;
use crate::sorting::sorted;
use crate::study::Case;

/// The blast row that is the mirror image of each blast row, hole by hole as they fire; `None` if no mirror plane of the shelter
/// moves rows.
pub(super) fn mirror_rows(case: &Case, holes: &HoleTiming) -> Option<Vec<usize>> {
    let in_turn = (0..case.plan.blast_rows.len()).collect_vec();
    let together = case.shot(&in_turn, Time::ZERO, holes);
    let rows = |image: &dyn Fn(&Firing) -> Firing| {
        let of_row = |&row: &usize| {
            let firings = together.firings.iter().filter(|firing| firing.row == row);
            sorted(firings.map(|firing| image(firing).cause()))
        };
        in_turn.iter().map(of_row).collect_vec()
    };
    let planned = rows(&Firing::clone);
    case.scene().mirrors_with_slope().find_map(|mirror| {
        let images = rows(&|firing| firing.mirrored(mirror));
        let mirror_row: Vec<usize> =
            images.iter().map(|image| planned.iter().position(|row| row == image)).collect::<Option<_>>()?;
        let returns = mirror_row.iter().enumerate().all(|(row, &other)| mirror_row[other] == row);
        let moves = mirror_row.iter().enumerate().any(|(row, &other)| row != other);
        (returns && moves).then_some(mirror_row)
    })
}

/// The mirrored order.
pub(super) fn mirrored(order: &[usize], mirror_rows: &Option<Vec<usize>>) -> Vec<usize> {
    order.iter().map(|&row| mirror_rows.as_ref().map_or(row, |mirror_rows| mirror_rows[row])).collect()
}
