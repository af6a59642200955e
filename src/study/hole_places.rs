//! Places of holes under a shelter by the plan: beside the middle of a tire, between two tires, or under none.

use std::collections::HashMap;

use itertools::Itertools;
use nalgebra::{Vector2, Vector3};

use super::Case;
use crate::scene::{Firing, Scene, Shot};

/// Distance of a hole from the center of its tire, over the diameter of the tire, from which the hole is reported.
const FAR: f64 = 0.25;
/// Height of a tire over its radius from which the tire covers nothing. The gap under its edge, 2 π r z, is then greater than the
/// tire, π r².
const HIGH: f64 = 0.5;
/// Difference of two distances [m]. Nobody stakes out holes more exactly.
const LEAST_DIFFERENCE: f64 = 0.05;

/// A hole that lies beside the middle of its tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoleBesideTire {
    /// Index of the blast row.
    pub row: usize,
    /// Number of the hole in its row, from 0.
    pub number: usize,
    /// Indices of the nearest tire and of the next.
    pub tires: [usize; 2],
    /// Distances of their centers from the hole [m].
    pub away: [f64; 2],
    /// Whether no tire lies over the hole.
    pub is_uncovered: bool,
    /// Whether the next tire is nearly as near.
    pub may_be_the_next: bool,
}

/// Place of a hole in the plan [m].
pub fn place_of_hole(scene: &Scene, firing: &Firing) -> Vector2<f64> {
    scene.position[firing.tire].xy() - firing.line.offset
}

/// The holes of a shot that lie farther than a quarter of a diameter from the center of their tire, or nearly as near to the next
/// tire. Without a diameter, the distance from their tire to the next one counts as the diameter.
pub fn holes_beside_tires(case: &Case, shot: &Shot) -> Vec<HoleBesideTire> {
    let scene = case.scene();
    let uncertainty = &case.plan.uncertainty;
    let doubt = (2.0 * uncertainty.hole_position_m.hypot(uncertainty.pattern_offset_m)).max(LEAST_DIFFERENCE);
    let beside = |firing: &Firing| {
        let away = firing.line.offset.norm();
        // A hole under the middle of its tire lies beside no tire. It returns early, because each check of a shot asks this of
        // every hole.
        if away == 0.0 {
            return None;
        }
        let place = place_of_hole(scene, firing);
        let away_from = |tire: usize| (scene.position[tire].xy() - place).norm();
        let others = || (0..scene.tire_count()).filter(|&tire| tire != firing.tire);
        let next = others().min_by(|&a, &b| away_from(a).total_cmp(&away_from(b)));
        let away_next = next.map_or(f64::INFINITY, away_from);
        let beside = HoleBesideTire {
            row: firing.row,
            number: firing.number,
            tires: [firing.tire, next.unwrap_or(firing.tire)],
            away: [away, away_next],
            is_uncovered: uncovering(case, firing, |_| Vector3::zeros()) > 1.0,
            may_be_the_next: away > 0.0 && away_next - away < doubt,
        };
        (lies_far(case, firing) || beside.may_be_the_next).then_some(beside)
    };
    shot.firings.iter().filter_map(beside).collect()
}

/// Whether a hole lies farther than a quarter of a diameter from the center of its tire.
pub fn lies_far(case: &Case, firing: &Firing) -> bool {
    firing.line.offset.norm() > FAR * diameter(case, firing.tire)
}

/// How near a hole is to lying under no tire, if the tires have moved by `moved` [m]. Above 1 it lies under none. A tire covers the
/// hole up to a radius aside, and up to half a radius high. The hole's own tire counts while it covers the hole, else the tire that
/// covers it best. Without a diameter, half the distance from its tire to the next one, as laid, counts as the radius.
pub fn uncovering(case: &Case, firing: &Firing, moved: impl Fn(usize) -> Vector3<f64>) -> f64 {
    let scene = case.scene();
    let place = scene.position[firing.tire].xy() - firing.line.offset;
    let radius = 0.5 * diameter(case, firing.tire);
    let of = |tire: usize| {
        let moved = moved(tire);
        let away = scene.position[tire].xy() + moved.xy() - place;
        (moved.z / (HIGH * radius)).max(away.norm() / radius)
    };
    let own = of(firing.tire);
    // What is no number covers nothing.
    let own = if own.is_nan() { f64::INFINITY } else { own };
    if own <= 1.0 { own } else { (0..scene.tire_count()).map(of).fold(own, f64::min) }
}

/// Diameter of the largest tires made, those of mining trucks [m].
const LARGEST: f64 = 4.0;

/// The outer diameter of a tire [m]. If the plan has none, the distance from the tire to the next one: no tire is larger than that.
fn diameter(case: &Case, tire: usize) -> f64 {
    match case.plan.tire.outer_diameter_m {
        0.0 => {
            let by_place = case.tires_by_place.get_or_init(|| TiresByPlace::new(&case.scene().position));
            by_place.distance_to_next(&case.scene().position, tire)
        }
        diameter => diameter,
    }
}

/// The tires in each square of the ground with the side [`LARGEST`]. So each firing of a run looks only at nearby tires.
#[derive(Clone, Debug)]
pub struct TiresByPlace(HashMap<[i64; 2], Vec<usize>>);

impl TiresByPlace {
    fn new(position: &[Vector3<f64>]) -> Self {
        let squares = position.iter().enumerate().map(|(tire, at)| (square(at), tire));
        Self(squares.into_group_map())
    }

    /// Distance from a tire to the next one [m], at most [`LARGEST`].
    fn distance_to_next(&self, position: &[Vector3<f64>], tire: usize) -> f64 {
        let [x, y] = square(&position[tire]);
        let around = (x - 1..=x + 1).cartesian_product(y - 1..=y + 1);
        let nearby = around.filter_map(|(x, y)| self.0.get(&[x, y])).flatten();
        let others = nearby.filter(|&&other| other != tire);
        others.map(|&other| (position[other] - position[tire]).norm()).fold(LARGEST, f64::min)
    }
}

/// The square in which a place lies.
fn square(at: &Vector3<f64>) -> [i64; 2] {
    [at.x, at.y].map(|along| (along / LARGEST).floor() as i64)
}

/// Number of holes of a shot that lie under no tire: farther than a radius from the center of every one.
pub fn count_under_no_tire(case: &Case, shot: &Shot) -> usize {
    holes_beside_tires(case, shot).iter().filter(|hole| hole.is_uncovered).count()
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::plan::Plan;

    fn case(x: f64, diameter: f64) -> Case {
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 2, columns = 3, spacing_m = 2 }}\n\
             tire = {{ mass_kg = 280, outer_diameter_m = {diameter} }}\n\
             cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\n\
             blast_row = [{{ name = \"1\", holes = [{{ x_m = {x}, y_m = 0, launch_m_s = 6 }}] }}]\n\
             limits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\ndelay = [{{ name = \"1\", interval_ms = 0 }}]\n"
        );
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// The next tire in the nearby squares is the next of all tires. The search by squares is compared with a search over all tires.
    #[test]
    fn the_next_tire_is_the_nearest_of_all() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for (count, size) in [(1, 1.0), (2, 20.0), (40, 20.0), (400, 40.0)] {
            let mut along = || rng.random_range(-size..size);
            let position: Vec<_> = (0..count).map(|_| Vector3::new(along(), along(), 0.0)).collect();
            let by_place = TiresByPlace::new(&position);
            for tire in 0..count {
                let others = (0..count).filter(|&other| other != tire);
                let of_all =
                    others.map(|other| (position[other] - position[tire]).norm()).fold(LARGEST, f64::min);
                assert_eq!(by_place.distance_to_next(&position, tire), of_all, "tire {tire} of {count}");
            }
        }
    }

    /// A tire of radius 0.8 m covers a hole up to 0.8 m aside and 0.4 m high; the larger share counts, and a tire that comes over the hole
    /// covers it instead.
    #[test]
    fn a_hole_is_uncovered_by_distance_or_height_of_the_best_tire() {
        let case = case(0.4, 1.6);
        let firing = &case.shots[0].firings[0];
        let share = |moved: [f64; 3], next: [f64; 3]| {
            uncovering(&case, firing, |tire| Vector3::from(if tire == firing.tire { moved } else { next }))
        };
        let near = |share: f64, exact: f64| assert!((share - exact).abs() < 1e-12, "{share} is not {exact}");
        near(share([0.0; 3], [0.0; 3]), 0.4 / 0.8);
        near(share([0.0, 0.0, 0.3], [0.0; 3]), 0.3 / 0.4);
        near(share([-0.4, 0.0, 0.0], [0.0; 3]), 0.8 / 0.8);
        // The next tire lies 1.6 m from the hole, and comes nearer.
        near(share([0.0, 0.0, 9.0], [0.0; 3]), 1.6 / 0.8);
        near(share([0.0, 0.0, 9.0], [-1.4, 0.0, 0.0]), 0.2 / 0.8);
        assert_eq!(share([f64::NAN; 3], [f64::NAN; 3]), f64::INFINITY);
        // As long as its own tire covers a hole, no other one counts.
        near(share([0.0; 3], [-1.6, 0.0, 0.0]), 0.4 / 0.8);
    }

    #[test]
    fn holes_under_no_tire_are_counted() {
        for (x, count) in [(0.79, 0), (0.81, 1)] {
            let case = case(x, 1.6);
            assert_eq!(count_under_no_tire(&case, &case.shots[0]), count, "{x}");
        }
    }

    /// Tires of 1.6 m, 2 m apart. A hole is reported from 0.4 m on, lies under no tire from 0.8 m on, and may belong to the next
    /// tire from 0.93 m on (2 √(0.05² + 0.05²) = 0.14 m nearer to one). Without a diameter, the 2 m to the next tire count as the
    /// diameter.
    #[test]
    fn holes_are_told_by_how_far_they_lie_beside_their_tire() {
        let found = |x: f64, diameter: f64| {
            let case = case(x, diameter);
            let found = holes_beside_tires(&case, &case.shots[0]);
            found.first().map(|hole| (hole.tires, hole.is_uncovered, hole.may_be_the_next))
        };
        assert_eq!(found(0.0, 1.6), None);
        assert_eq!(found(0.39, 1.6), None);
        assert_eq!(found(0.41, 1.6), Some(([0, 1], false, false)));
        assert_eq!(found(0.81, 1.6), Some(([0, 1], true, false)));
        assert_eq!(found(0.94, 1.6), Some(([0, 1], true, true)));
        assert_eq!(found(1.06, 1.6), Some(([1, 0], true, true)));
        assert_eq!(found(0.49, 0.0), None);
        assert_eq!(found(0.51, 0.0), Some(([0, 1], false, false)));
    }
}
