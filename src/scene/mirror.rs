//! Mirror planes of a shelter: x or y reflected about its middle, if every tire and cable has its image.

use rustc_hash::FxHashMap as HashMap;

use super::Scene;

/// A vertical plane in which the shelter is its own image.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// The axis it reflects: 0 for x, 1 for y.
    pub axis: usize,
    /// Each tire's image (`n_tires`).
    pub image: Vec<usize>,
}

/// Places this much closer than the shelter is wide are the same.
const SAME: f64 = 1e-9;

impl Scene {
    /// Finds the mirror planes across x and y.
    pub(super) fn find_mirrors(&mut self) {
        self.mirrors = [0, 1].into_iter().filter_map(|axis| self.mirror(axis)).collect();
    }

    fn mirror(&self, axis: usize) -> Option<Mirror> {
        let range = |axis: usize| {
            let places = self.position.iter().map(|place| place[axis]);
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (ranges, sum) = ([range(0), range(1)], range(axis).0 + range(axis).1);
        let width = ranges.iter().map(|(low, high)| high - low).fold(0.0, f64::max);
        let grain = SAME * width;
        if ranges[axis].1 - ranges[axis].0 <= grain {
            return None;
        }
        let key = |place: [f64; 2]| place.map(|x| (x / grain).round() as i64);
        let at = |tire: usize| [self.position[tire].x, self.position[tire].y];
        let known: HashMap<[i64; 2], usize> =
            (0..self.mass.len()).map(|tire| (key(at(tire)), tire)).collect();
        // Rounding may put an image just across a grain's edge.
        let find = |place: [f64; 2]| {
            let [x, y] = key(place);
            let near = [0, -1, 1].into_iter().flat_map(|dx| [0, -1, 1].map(|dy| [x + dx, y + dy]));
            near.into_iter().find_map(|key| known.get(&key).copied())
        };
        let image: Vec<usize> = (0..self.mass.len())
            .map(|tire| {
                let mut place = at(tire);
                place[axis] = sum - place[axis];
                find(place).filter(|&image| self.mass[image] == self.mass[tire])
            })
            .collect::<Option<_>>()?;
        let ends = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let tied: HashMap<[usize; 2], (f64, f64)> =
            self.cables.iter().map(|c| (ends(c.ends), (c.rest_length, c.stiffness))).collect();
        let has_image = |cable: &super::Cable| {
            tied.get(&ends(cable.ends.map(|end| image[end]))) == Some(&(cable.rest_length, cable.stiffness))
        };
        let whole = tied.len() == self.cables.len() && self.cables.iter().all(has_image);
        whole.then_some(Mirror { axis, image })
    }
}
