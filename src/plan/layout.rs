//! Positions of the tires, and which tires are tied.

use crate::choice::Link;
use crate::sorting::sort_by;

/// Positions of the tires, and the neighbours that are tied.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// `rows` × `columns` tires.
    Grid(Mesh),
    /// `rows` × `columns` corner tires, and one more tire at the centre of every cell.
    Quincunx(Mesh),
    /// Tires and cables one by one.
    List {
        /// Tires in the order listed.
        tires: Vec<ListedTire>,
        /// Pairs of tire indices, from 0.
        cables: Vec<(usize, usize)>,
    },
}

impl Layout {
    /// Whether tires have masses of their own.
    pub fn has_own_masses(&self) -> bool {
        matches!(self, Layout::List { tires, .. } if tires.iter().any(|tire| tire.mass_kg.is_some()))
    }

    /// Least distance between the centres of any two tires, and of two tied tires [m]; infinite where there are none. A mesh counts with
    /// this number of ballast rows on each side.
    pub fn least_distances(&self, border_rows: usize) -> [f64; 2] {
        let least = |distances: &mut dyn Iterator<Item = f64>| distances.fold(f64::INFINITY, f64::min);
        let between = |a: &ListedTire, b: &ListedTire| (a.x_m - b.x_m).hypot(a.y_m - b.y_m);
        let (mesh, has_centres) = match self {
            Layout::Grid(mesh) => (mesh, false),
            Layout::Quincunx(mesh) => (mesh, true),
            Layout::List { tires, cables } => {
                let tied = cables.iter().filter_map(|&(a, b)| Some(between(tires.get(a)?, tires.get(b)?)));
                let mut along: Vec<&ListedTire> = tires.iter().collect();
                sort_by(&mut along, |a, b| a.x_m.total_cmp(&b.x_m));
                let mut nearest = f64::INFINITY;
                for (n, tire) in along.iter().enumerate() {
                    let near = along[n + 1..].iter().take_while(|other| other.x_m - tire.x_m < nearest);
                    nearest = near.map(|other| between(tire, other)).fold(nearest, f64::min);
                }
                return [nearest, least(&mut tied.into_iter())];
            }
        };
        let (x, y) = (mesh.column_spacing_m, mesh.row_spacing_m);
        let [rows, columns] =
            [mesh.rows, mesh.columns].map(|count| count.saturating_add(2 * border_rows) > 1);
        let diagonal = if has_centres { 0.5 * x.hypot(y) } else { x.hypot(y) };
        let gaps =
            [(columns, Link::Row, x), (rows, Link::Column, y), (rows && columns, Link::Diagonal, diagonal)];
        let there = || gaps.into_iter().filter(|(is_there, ..)| *is_there);
        let tied = there().filter(|(_, link, _)| mesh.links.contains(link));
        [least(&mut there().map(|(.., gap)| gap)), least(&mut tied.map(|(.., gap)| gap))]
    }

    /// Why tires of a `diameter` [m] have no room in this layout: rims overlap, or no cable fits between tied tires. `None` if they have
    /// room. A mesh counts with this number of ballast rows on each side.
    pub fn lacks_room(&self, diameter: f64, border_rows: usize) -> Option<String> {
        let [nearest, tied] = self.least_distances(border_rows);
        let ballast = if border_rows > 0 { ", with rows of ballast," } else { "" };
        match () {
            () if tied - diameter < 1e-6 * tied => Some(format!(
                "centres {tied} m apart{ballast} leave no room for a cable between tires of {diameter} m"
            )),
            () if diameter - nearest > 1e-6 * nearest => {
                Some(format!("tires of {diameter} m lie in one another: their centres are {nearest} m apart"))
            }
            () => None,
        }
    }

    /// Greatest distance between the centres of tied tires [m]; in a mesh the greater spacing.
    pub fn widest_tie(&self) -> f64 {
        match self {
            Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.column_spacing_m.max(mesh.row_spacing_m),
            Layout::List { tires, cables } => {
                let length = |&(a, b): &(usize, usize)| {
                    Some((tires.get(a)?, tires.get(b)?)).map(|(a, b)| (a.x_m - b.x_m).hypot(a.y_m - b.y_m))
                };
                // Tires without ties give no distance; no tire is wider than this.
                cables.iter().filter_map(length).reduce(f64::max).unwrap_or(5.0)
            }
        }
    }
}

/// A regular layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Tires along y.
    pub rows: usize,
    /// Tires along x.
    pub columns: usize,
    /// Distance between rows [m].
    pub row_spacing_m: f64,
    /// Distance between columns [m].
    pub column_spacing_m: f64,
    /// Neighbours that are tied.
    pub links: Vec<Link>,
    /// Rows of ballast around the mesh, on each side. No blast row lies under them; tire (1,1) stays at the origin.
    pub border_rows: usize,
}

impl Mesh {
    /// Distance of a point from the area of the mesh and its border [m]; 0 inside.
    pub fn distance_outside(&self, x: f64, y: f64) -> f64 {
        let border = self.border_rows as f64;
        let beyond = |at: f64, count: usize, spacing: f64| {
            (-border * spacing - at).max(at - (count as f64 - 1.0 + border) * spacing).max(0.0)
        };
        let (across, along) = (self.column_spacing_m, self.row_spacing_m);
        beyond(x, self.columns, across).hypot(beyond(y, self.rows, along))
    }

    /// Number of tires of a grid, or at the corners of a quincunx, with the border.
    pub fn corners(&self) -> usize {
        let with_border = |n: usize| n.saturating_add(2 * self.border_rows);
        with_border(self.rows).saturating_mul(with_border(self.columns))
    }
}

/// One tire of a `list` layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ListedTire {
    /// Along the rows [m].
    pub x_m: f64,
    /// Across the rows [m].
    pub y_m: f64,
    /// Mass [kg]. `None`: the mass of `[tire]`.
    pub mass_kg: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(rows: usize, columns: usize, [x, y]: [f64; 2], links: &[Link]) -> Mesh {
        let links = links.to_vec();
        Mesh { rows, columns, row_spacing_m: y, column_spacing_m: x, links, border_rows: 0 }
    }

    /// A single row has no distance between rows, but has one with ballast. Rows that are not tied may touch, but must not overlap.
    #[test]
    fn tires_lie_beside_one_another() {
        let lacks = |layout: &Layout, border_rows| layout.lacks_room(1.6, border_rows);
        let row = Layout::Grid(mesh(1, 6, [2.6, 1.0], Link::ALL));
        assert_eq!(lacks(&row, 0), None);
        assert!(lacks(&row, 1).is_some_and(|why| why.contains("centres 1 m apart, with rows of ballast,")));
        let tied_along = |y| Layout::Grid(mesh(3, 6, [2.6, y], &[Link::Row]));
        assert!(lacks(&tied_along(1.0), 0).is_some_and(|why| why.contains("lie in one another")));
        assert_eq!(lacks(&tied_along(1.6), 0), None, "rims that touch");
        assert!(lacks(&Layout::Grid(mesh(3, 6, [2.6, 1.6], Link::ALL)), 0).is_some(), "no room for a cable");
        // A tire in the middle of four, 1.41 m from each.
        let quincunx = Layout::Quincunx(mesh(2, 2, [2.0, 2.0], &[Link::Row]));
        assert!(lacks(&quincunx, 0).is_some_and(|why| why.contains("1.41")));
        let at = |x_m: f64, y_m: f64| ListedTire { x_m, y_m, mass_kg: None };
        let list = |cables: &[(usize, usize)]| Layout::List {
            tires: vec![at(5.0, 0.0), at(0.0, 0.0), at(2.6, 0.0), at(5.0, 1.0), at(0.0, 9.0)],
            cables: cables.to_vec(),
        };
        assert_eq!(list(&[(1, 2)]).least_distances(0), [1.0, 2.6]);
        assert!(lacks(&list(&[(1, 2)]), 0).is_some_and(|why| why.contains("lie in one another")));
        assert_eq!(list(&[]).lacks_room(0.0, 0), None, "without a diameter tires are points");
    }
}
