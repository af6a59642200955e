//! Half or a quarter of a shelter where it and what fires are their own mirror image.
//!
//! One tire of every set of images is *kept*. A tire across a plane that a kept one is tied to stays as an *image*: it is
//! not integrated but copied, reflected, after every step. A tire on a plane is kept, and keeps to the plane. Energies count
//! every tire and cable as often as it stands for others. The motion is that of the whole shelter up to the order in which
//! forces are summed.

use std::borrow::Cow;

use itertools::Itertools;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::scene::{Firing, Mirror, Scene, Shot};

/// What a part of a scene stands for.
#[derive(Debug)]
pub struct Quotient {
    /// Copies to make after every step.
    pub images: Vec<Image>,
    /// How many tires of the whole scene each stands for; 0 for images (`n_tires`).
    pub weight: Vec<f64>,
    /// How many cables of the whole scene each stands for (`n_cables`).
    pub cable_weight: Vec<f64>,
    /// Whole scene's index of each tire and cable, and where each tire of the whole scene is found; none without mirrors.
    map: Option<Map>,
}

#[derive(Debug)]
struct Map {
    /// What the planes taken out reflect.
    axes: Vec<usize>,
    tire: Vec<usize>,
    cable: Vec<usize>,
    found: Vec<(usize, [f64; 2])>,
}

/// A tire that is copied from another.
#[derive(Clone, Copy, Debug)]
pub struct Image {
    /// The copy.
    pub of: usize,
    /// What is copied; itself for a tire on a plane.
    pub from: usize,
    /// Factors of x, y and z: −1 reflected, 0 on the plane.
    pub sign: [f64; 3],
}

impl Quotient {
    /// Takes out `planes`; also returns what is left: kept tires and images in the order of the whole scene, and the cables
    /// of kept ones.
    pub fn new<'s>(scene: &'s Scene, planes: &[&Mirror]) -> (Self, Cow<'s, Scene>) {
        let n = scene.mass.len();
        if planes.is_empty() {
            let (weight, cable_weight) = (vec![1.0; n], vec![1.0; scene.cables.len()]);
            return (Self { images: Vec::new(), weight, cable_weight, map: None }, Cow::Borrowed(scene));
        }
        // The kept tire of each tire's images, and the reflections that lead to it.
        let kept: Vec<(usize, [f64; 2])> = (0..n)
            .map(|tire| {
                planes.iter().fold((tire, [1.0; 2]), |(at, mut sign), plane| {
                    let image = plane.image[at];
                    if scene.position[image][plane.axis] < scene.position[at][plane.axis] && image != at {
                        sign[plane.axis] = -1.0;
                        return (image, sign);
                    }
                    (at, sign)
                })
            })
            .collect();
        let is_kept = |tire: usize| kept[tire].0 == tire;
        let cables: Vec<usize> = (0..scene.cables.len())
            .filter(|&cable| scene.cables[cable].ends.into_iter().any(is_kept))
            .collect();
        let mut modelled: Vec<bool> = (0..n).map(is_kept).collect();
        for end in cables.iter().flat_map(|&cable| scene.cables[cable].ends) {
            modelled[end] = true;
        }
        let tire: Vec<usize> = (0..n).filter(|&tire| modelled[tire]).collect();
        let mut place = vec![usize::MAX; n];
        for (new, &old) in tire.iter().enumerate() {
            place[old] = new;
        }
        let mut orbit = vec![0.0; n];
        for &(source, _) in &kept {
            orbit[source] += 1.0;
        }
        let on_plane = |tire: usize| {
            let mut sign = [1.0; 2];
            for plane in planes.iter().filter(|plane| plane.image[tire] == tire) {
                sign[plane.axis] = 0.0;
            }
            sign
        };
        let images = tire
            .iter()
            .enumerate()
            .map(|(of, &old)| {
                let (source, sign) = kept[old];
                let flat = on_plane(old);
                Image { of, from: place[source], sign: [sign[0] * flat[0], sign[1] * flat[1], 1.0] }
            })
            .filter(|image| image.of != image.from || image.sign.contains(&0.0))
            .collect();
        let mut part = Scene {
            position: tire.iter().map(|&t| scene.position[t]).collect(),
            mass: tire.iter().map(|&t| scene.mass[t]).collect(),
            tire: tire.iter().map(|&t| scene.tire[t]).collect(),
            cables: cables.iter().map(|&c| scene.cables[c]).collect(),
            friction: scene.friction,
            gravity: scene.gravity,
            breaking_force: scene.breaking_force,
            mirrors: Vec::new(),
        };
        for cable in &mut part.cables {
            cable.ends = cable.ends.map(|end| place[end]);
        }
        // A cable is seen from each of its kept ends; between two kept tires it is seen twice but evaluated once.
        let seen = |&cable: &usize| {
            let sides = scene.cables[cable].ends.map(|end| if is_kept(end) { orbit[end] } else { 0.0 });
            0.5 * (sides[0] + sides[1])
        };
        let quotient = Self {
            weight: tire.iter().map(|&t| if is_kept(t) { orbit[t] } else { 0.0 }).collect(),
            cable_weight: cables.iter().map(seen).collect(),
            images,
            map: Some(Map {
                axes: planes.iter().map(|plane| plane.axis).collect(),
                found: kept.iter().map(|&(source, sign)| (place[source], sign)).collect(),
                tire,
                cable: cables,
            }),
        };
        (quotient, Cow::Owned(part))
    }

    /// The firings of a shot under kept tires.
    pub fn firings(&self, shot: &Shot) -> Vec<Firing> {
        let Some(map) = &self.map else { return shot.firings.clone() };
        let here = |firing: &Firing| {
            let tire = map.found[firing.tire].0;
            (map.tire[tire] == firing.tire).then_some(Firing { tire, ..*firing })
        };
        shot.firings.iter().filter_map(here).collect()
    }

    /// Index in the whole scene of a tire.
    pub fn tire(&self, tire: usize) -> usize {
        self.map.as_ref().map_or(tire, |map| map.tire[tire])
    }

    /// Index in the whole scene of a cable.
    pub fn cable(&self, cable: usize) -> usize {
        self.map.as_ref().map_or(cable, |map| map.cable[cable])
    }

    /// Indices in the whole scene of cables and their images, one cable after the other; looks through the scene once.
    pub fn cables(&self, scene: &Scene, cables: &[usize]) -> Vec<usize> {
        let Some(map) = &self.map else { return cables.to_vec() };
        let key = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let orbit = |&cable: &usize| {
            let mut all = vec![scene.cables[map.cable[cable]].ends];
            for plane in scene.mirrors.iter().filter(|plane| map.axes.contains(&plane.axis)) {
                let reflected: Vec<_> = all.iter().map(|ends| ends.map(|end| plane.image[end])).collect();
                all.extend(reflected);
            }
            all.into_iter().map(key).sorted_unstable().dedup().collect::<Vec<_>>()
        };
        let orbits: Vec<_> = cables.iter().map(orbit).collect();
        let wanted: FxHashSet<_> = orbits.iter().flatten().copied().collect();
        let ends = scene.cables.iter().map(|cable| key(cable.ends)).zip(0..);
        let found: FxHashMap<_, usize> = ends.filter(|(ends, _)| wanted.contains(ends)).collect();
        let there =
            |orbit: &Vec<_>| orbit.iter().filter_map(|ends| found.get(ends).copied()).sorted_unstable();
        orbits.iter().flat_map(there).collect()
    }

    /// Where a tire of the whole scene is found, and the factors of its x and y.
    pub fn find(&self, tire: usize) -> (usize, [f64; 2]) {
        self.map.as_ref().map_or((tire, [1.0; 2]), |map| map.found[tire])
    }

    /// Tires that are integrated.
    pub fn modelled(&self) -> usize {
        self.weight.iter().filter(|&&weight| weight > 0.0).count()
    }
}
