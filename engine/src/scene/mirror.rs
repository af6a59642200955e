//! Mirror planes of a shelter: vertical planes through its middle, across x or y. Every tire and cable has an image in them.

use nalgebra::Vector3;
use rustc_hash::FxHashMap as HashMap;

use super::Scene;

/// A vertical plane in which the shelter is its own mirror image.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Axis across the plane: 0 for x, 1 for y.
    pub axis: usize,
    /// Image of each tire (`n_tires`).
    pub image: Vec<usize>,
}

impl Mirror {
    /// Images of a tire and of its velocity [m/s].
    pub fn reflect(&self, tire: usize, mut velocity: Vector3<f64>) -> (usize, Vector3<f64>) {
        // A difference, because 0 and −0 differ in binary.
        velocity[self.axis] = 0.0 - velocity[self.axis];
        (self.image[tire], velocity)
    }
}

/// Greatest distance between two points that count as the same, relative to the width of the shelter.
const SAME: f64 = 1e-9;

impl Scene {
    /// Finds the mirror planes across x and y.
    pub fn find_mirrors(&mut self) {
        self.mirrors = [0, 1].into_iter().filter_map(|axis| self.mirror(axis)).collect();
    }

    /// Mirror planes in which the slope is its own image, too: gravity along the ground has no part across the plane.
    pub fn mirrors_with_slope(&self) -> impl Iterator<Item = &Mirror> {
        self.mirrors.iter().filter(|mirror| self.downhill[mirror.axis] == 0.0)
    }

    /// Mirror plane across `axis`, if the shelter has one.
    fn mirror(&self, axis: usize) -> Option<Mirror> {
        let extents = [0, 1].map(|axis| self.extent(axis));
        let width = extents.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let grain = SAME * width;
        let [low, high] = extents[axis];
        if high - low <= grain {
            return None;
        }
        let key = |point: [f64; 2]| point.map(|x| (x / grain).round() as i64);
        let place = |tire: usize| [self.position[tire].x, self.position[tire].y];
        let known: HashMap<[i64; 2], usize> =
            (0..self.mass.len()).map(|tire| (key(place(tire)), tire)).collect();
        // Rounding may move an image into a neighbouring grain.
        let find = |point: [f64; 2]| {
            let [x, y] = key(point);
            let near = [0, -1, 1].into_iter().flat_map(|dx| [0, -1, 1].map(|dy| [x + dx, y + dy]));
            near.into_iter().find_map(|key| known.get(&key).copied())
        };
        let image: Vec<usize> = (0..self.mass.len())
            .map(|tire| {
                let mut point = place(tire);
                point[axis] = low + high - point[axis];
                find(point).filter(|&image| self.mass[image] == self.mass[tire])
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
