//! Finds the nearest of many points on the ground, in a grid of cells.

/// Points on the ground [m], sorted into square cells.
pub struct NearestPoint {
    points: Vec<[f64; 2]>,
    /// Corner of the first cell [m], width of a cell [m], and number of cells along x and y.
    corner: [f64; 2],
    width: f64,
    counts: [usize; 2],
    /// Index in `sorted` at which the points of each cell begin (`n_cells` + 1).
    begins: Vec<usize>,
    /// Indices of the points, cell by cell, ascending in each (`n_points`).
    sorted: Vec<usize>,
}

impl NearestPoint {
    /// Sorts points into about as many cells as there are points.
    pub fn of(points: Vec<[f64; 2]>) -> Self {
        let range = |axis: usize| {
            let along = points.iter().map(|point| point[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let ranges = [range(0), range(1)];
        let extents = ranges.map(|[low, high]| high - low);
        let count = points.len() as f64;
        let width = (extents[0] * extents[1] / count).sqrt().max(extents[0].max(extents[1]) / count);
        let is_spread = width > 0.0 && width.is_finite() && extents.iter().all(|extent| extent.is_finite());
        // Points that all lie in one place, or beyond the range of numbers, share one cell.
        let counts = if is_spread { extents.map(|extent| (extent / width) as usize + 1) } else { [1, 1] };
        let mut index = Self {
            points,
            corner: ranges.map(|[low, _]| low),
            width,
            counts,
            begins: vec![0; counts[0] * counts[1] + 1],
            sorted: Vec::new(),
        };
        let cells: Vec<usize> = index.points.iter().map(|&point| index.number(index.cell(point))).collect();
        cells.iter().for_each(|cell| index.begins[cell + 1] += 1);
        for cell in 1..index.begins.len() {
            index.begins[cell] += index.begins[cell - 1];
        }
        index.sorted = (0..cells.len()).collect();
        index.sorted.sort_by_key(|&point| cells[point]);
        index
    }

    /// Index of the point nearest to `at` [m]; the first of points at the same distance; `None` if there are no points.
    pub fn to(&self, at: [f64; 2]) -> Option<usize> {
        let middle = self.cell(at);
        let mut best: Option<(f64, usize)> = None;
        // Rings of cells around the cell of `at`, or around the cell next to it. Ring n is at least n - 1 widths away.
        for ring in 0..=self.counts[0].max(self.counts[1]) {
            let away = ring.saturating_sub(1) as f64 * self.width * (1.0 - 1e-9);
            if best.is_some_and(|(distance2, _)| away * away > distance2) {
                break;
            }
            for cell in self.ring(middle, ring) {
                for &point in &self.sorted[self.begins[cell]..self.begins[cell + 1]] {
                    let [x, y] = self.points[point];
                    let distance2 = (x - at[0]).powi(2) + (y - at[1]).powi(2);
                    let is_nearer = |(least, first): (f64, usize)| {
                        distance2.total_cmp(&least).then(point.cmp(&first)).is_lt()
                    };
                    if best.is_none_or(is_nearer) {
                        best = Some((distance2, point));
                    }
                }
            }
        }
        best.map(|(_, point)| point)
    }

    /// Column and row of the cell that holds a place, or of the cell nearest to it.
    fn cell(&self, at: [f64; 2]) -> [usize; 2] {
        // The cast turns a negative number or NaN into 0.
        [0, 1].map(|axis| (((at[axis] - self.corner[axis]) / self.width) as usize).min(self.counts[axis] - 1))
    }

    fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.counts[0] + column
    }

    /// Numbers of the cells at distance `ring` from a cell. The distance counts cells along x or y, whichever is greater.
    fn ring(&self, [column, row]: [usize; 2], ring: usize) -> impl Iterator<Item = usize> {
        let [columns, rows] = self.counts;
        let near = move |at: usize, count: usize| at.saturating_sub(ring)..=(at + ring).min(count - 1);
        near(row, rows).flat_map(move |r| {
            let is_end = r.abs_diff(row) == ring;
            // The rows between the first and the last have only their two end cells in the ring.
            let ends = [column.checked_sub(ring), column.checked_add(ring).filter(|_| ring > 0)];
            let ends = ends.into_iter().flatten().filter(move |&c| c < columns && !is_end);
            let whole = near(column, columns).filter(move |_| is_end);
            whole.chain(ends).map(move |c| r * columns + c)
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn by_looking_at_all(points: &[[f64; 2]], at: [f64; 2]) -> Option<usize> {
        let distance2 = |n: &usize| (points[*n][0] - at[0]).powi(2) + (points[*n][1] - at[1]).powi(2);
        (0..points.len()).min_by(|a, b| distance2(a).total_cmp(&distance2(b)))
    }

    proptest! {
        /// Points on a mesh (many at the same distance), in clusters, on a line, and in one place; places far from all points, too.
        #[test]
        fn the_nearest_point_is_that_of_looking_at_all(
            places in prop::collection::vec((-20..20_i32, -20..20_i32), 1..120),
            scale in prop::sample::select(vec![[1.5, 1.5], [0.0, 1.0], [0.0, 0.0], [1e-3, 1e3], [1e6, 1e-6]]),
            cluster in prop::sample::select(vec![0.0, 1e4]),
            at in prop::collection::vec((-50..50_i32, -50..50_i32), 1..40),
        ) {
            let place = |&(x, y): &(i32, i32)| {
                let shift = if x % 3 == 0 { cluster } else { 0.0 };
                [f64::from(x) * scale[0] + shift, f64::from(y) * scale[1]]
            };
            let points: Vec<[f64; 2]> = places.iter().map(place).collect();
            let index = NearestPoint::of(points.clone());
            for (x, y) in at {
                let point = [0.5 * f64::from(x) * scale[0].max(1.0), 0.5 * f64::from(y) * scale[1].max(1.0)];
                prop_assert_eq!(index.to(point), by_looking_at_all(&points, point));
            }
        }
    }

    /// A hundred thousand searches among a hundred thousand points: a search that looks at all points takes a minute.
    #[test]
    fn many_points_are_found_at_once() {
        let points: Vec<[f64; 2]> = (0..100_000).map(|n| [f64::from(n % 316), f64::from(n / 316)]).collect();
        let index = NearestPoint::of(points.clone());
        let begun = std::time::Instant::now();
        assert!((0..points.len()).all(|n| index.to([points[n][0] + 0.3, points[n][1] - 0.4]) == Some(n)));
        assert!(begun.elapsed().as_secs_f64() < 5.0);
        assert_eq!(NearestPoint::of(Vec::new()).to([0.0, 0.0]), None);
    }
}
