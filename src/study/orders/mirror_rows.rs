//! Orders that are mirror images of one another.

use crate::plan::BlastRow;
use crate::scene::{Firing, Shot};
use crate::study::Case;

/// Blast row that is the mirror image of each blast row; `None` where the shelter has no mirror plane that moves rows.
pub(super) fn mirror_rows(case: &Case) -> Option<Vec<usize>> {
    let holes = |image: &dyn Fn(&Firing) -> Firing| -> Vec<Vec<Firing>> {
        let row = |row: &BlastRow| {
            let firings = case.scene().firings(&row.targets);
            Shot::from_firings(firings.iter().map(image).collect()).firings
        };
        case.plan.blast_rows.iter().map(row).collect()
    };
    let rows = holes(&Firing::clone);
    case.scene().mirrors_with_slope().find_map(|mirror| {
        let images = holes(&|firing| firing.mirrored(mirror));
        let mirror_row: Vec<usize> =
            images.iter().map(|image| rows.iter().position(|row| row == image)).collect::<Option<_>>()?;
        let returns = mirror_row.iter().enumerate().all(|(row, &other)| mirror_row[other] == row);
        let moves = mirror_row.iter().enumerate().any(|(row, &other)| row != other);
        (returns && moves).then_some(mirror_row)
    })
}

/// The mirrored order.
pub(super) fn mirrored(order: &[usize], mirror_rows: &Option<Vec<usize>>) -> Vec<usize> {
    order.iter().map(|&row| mirror_rows.as_ref().map_or(row, |mirror_rows| mirror_rows[row])).collect()
}
