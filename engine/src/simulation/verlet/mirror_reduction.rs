//! Half or a quarter of a shelter, if shelter and shot are their own mirror image.
//!
//! - Tires that are mirror images of one another form a set. One tire of each set is *kept* and integrated.
//! - A tire that is not kept but tied to a kept tire stays in the scene as an *image*: after every step, a reflected copy of its
//!   kept tire.
//! - A tire on a mirror plane is kept, and stays on the plane.
//! - An anchor is an image of rest.
//! - Energies count each tire and cable as many times as the whole shelter has it.
//!
//! The motion equals the motion of the whole shelter, except for the order in which forces are summed.

use std::borrow::Cow;

use itertools::Itertools;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::scene::{Firing, Mirror, Scene, Shot};

/// Relation between the modelled part of a scene and the whole scene.
#[derive(Debug)]
pub struct MirrorReduction {
    /// Copies to make after every step.
    pub images: Vec<Image>,
    /// Number of tires of the whole scene that each tire stands for; 0 for an image or an anchor (`n_tires`).
    pub weight: Vec<f64>,
    /// Number of cables of the whole scene that each cable stands for (`n_cables`).
    pub cable_weight: Vec<f64>,
    /// How the part lies in the whole scene; `None` if the part is the whole scene.
    to_whole: Option<PartToWhole>,
}

/// How a part lies in the whole scene.
#[derive(Debug)]
struct PartToWhole {
    /// Axes that the planes reflect: 0 for x, 1 for y.
    axes: Vec<usize>,
    /// Index in the whole scene of each tire of the part (`n_tires`).
    tire: Vec<usize>,
    /// Index in the whole scene of each cable of the part (`n_cables`).
    cable: Vec<usize>,
    /// For each tire of the whole scene: its kept tire, as index in the part, and the factors of x and y (`n_tires` of the whole).
    kept: Vec<(usize, [f64; 2])>,
}

/// Copy of a kept tire to make after every step.
#[derive(Clone, Copy, Debug)]
pub struct Image {
    /// Tire that is written.
    pub written: usize,
    /// Kept tire that is read; equal to [`Self::written`] for a tire on a plane and for an anchor.
    pub read: usize,
    /// Factors of x, y and z: −1 if reflected, 0 across the plane for a tire on the plane, and 0 for an anchor.
    pub sign: [f64; 3],
}

impl MirrorReduction {
    /// Reduction of `scene` by `planes`, and the modelled part: kept tires and images in the order of the whole scene, and the
    /// cables of kept tires.
    pub fn new<'s>(scene: &'s Scene, planes: &[&Mirror]) -> (Self, Cow<'s, Scene>) {
        let n = scene.tire_count();
        if planes.is_empty() {
            let weight = (0..n).map(|tire| if scene.is_anchor(tire) { 0.0 } else { 1.0 }).collect();
            let anchors = (0..n).filter(|&tire| scene.is_anchor(tire));
            let images = anchors.map(|at| Image { written: at, read: at, sign: [0.0; 3] }).collect();
            let cable_weight = vec![1.0; scene.cables.len()];
            return (Self { images, weight, cable_weight, to_whole: None }, Cow::Borrowed(scene));
        }
        // Kept tire of each tire, and the reflections that lead to that tire.
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
        let mut index = vec![usize::MAX; n];
        for (new, &old) in tire.iter().enumerate() {
            index[old] = new;
        }
        let mut images_of = vec![0.0; n];
        for &(source, _) in &kept {
            images_of[source] += 1.0;
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
            .map(|(written, &old)| {
                let (source, sign) = kept[old];
                let flat = on_plane(old);
                let free = if scene.is_anchor(old) { 0.0 } else { 1.0 };
                let sign = [sign[0] * flat[0] * free, sign[1] * flat[1] * free, free];
                Image { written, read: index[source], sign }
            })
            .filter(|image| image.written != image.read || image.sign.contains(&0.0))
            .collect();
        let mut part = Scene {
            position: tire.iter().map(|&t| scene.position[t]).collect(),
            mass: tire.iter().map(|&t| scene.mass[t]).collect(),
            tire_ids: tire.iter().map(|&t| scene.tire_ids[t]).collect(),
            cables: cables.iter().map(|&c| scene.cables[c]).collect(),
            friction: scene.friction,
            gravity: scene.gravity,
            downhill: scene.downhill,
            restitution: scene.restitution,
            damping: scene.damping,
            breaking_force: scene.breaking_force,
            strength: Vec::new(),
            mirrors: Vec::new(),
        };
        for cable in &mut part.cables {
            cable.ends = cable.ends.map(|end| index[end]);
        }
        let tire_weight = |tire: usize| if is_kept(tire) { images_of[tire] } else { 0.0 };
        // Each of the two ends counts for half the cable.
        let cable_weight = |&cable: &usize| {
            let [a, b] = scene.cables[cable].ends.map(tire_weight);
            0.5 * (a + b)
        };
        let reduction = Self {
            weight: tire.iter().map(|&t| if scene.is_anchor(t) { 0.0 } else { tire_weight(t) }).collect(),
            cable_weight: cables.iter().map(cable_weight).collect(),
            images,
            to_whole: Some(PartToWhole {
                axes: planes.iter().map(|plane| plane.axis).collect(),
                kept: kept.iter().map(|&(source, sign)| (index[source], sign)).collect(),
                tire,
                cable: cables,
            }),
        };
        (reduction, Cow::Owned(part))
    }

    /// Firings of `shot` under kept tires, with indices in the part.
    pub fn firings(&self, shot: &Shot) -> Vec<Firing> {
        let Some(map) = &self.to_whole else { return shot.firings.clone() };
        let under_kept = |firing: &Firing| {
            let tire = map.kept[firing.tire].0;
            (map.tire[tire] == firing.tire).then_some(Firing { tire, ..*firing })
        };
        shot.firings.iter().filter_map(under_kept).collect()
    }

    /// Index in the whole scene of a tire of the part.
    pub fn tire(&self, tire: usize) -> usize {
        self.to_whole.as_ref().map_or(tire, |map| map.tire[tire])
    }

    /// Index in the whole scene of a cable of the part.
    pub fn cable(&self, cable: usize) -> usize {
        self.to_whole.as_ref().map_or(cable, |map| map.cable[cable])
    }

    /// Indices in the whole scene of some cables of the part and of all their images, one cable after the other.
    ///
    /// One pass through the cables of the whole scene finds all of them.
    pub fn cables_with_images(&self, scene: &Scene, cables: &[usize]) -> Vec<usize> {
        let Some(map) = &self.to_whole else { return cables.to_vec() };
        let key = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let images = |&cable: &usize| {
            let mut all = vec![scene.cables[map.cable[cable]].ends];
            for plane in scene.mirrors.iter().filter(|plane| map.axes.contains(&plane.axis)) {
                let reflected: Vec<_> = all.iter().map(|ends| ends.map(|end| plane.image[end])).collect();
                all.extend(reflected);
            }
            all.into_iter().map(key).sorted_unstable().dedup().collect::<Vec<_>>()
        };
        let sets: Vec<_> = cables.iter().map(images).collect();
        let wanted: FxHashSet<_> = sets.iter().flatten().copied().collect();
        let ends = scene.cables.iter().map(|cable| key(cable.ends)).zip(0..);
        let found: FxHashMap<_, usize> = ends.filter(|(ends, _)| wanted.contains(ends)).collect();
        let indices = |set: &Vec<_>| set.iter().filter_map(|ends| found.get(ends).copied()).sorted_unstable();
        sets.iter().flat_map(indices).collect()
    }

    /// Kept tire of a tire of the whole scene, as index in the part, and the factors of x and y.
    pub fn image_of(&self, tire: usize) -> (usize, [f64; 2]) {
        self.to_whole.as_ref().map_or((tire, [1.0; 2]), |map| map.kept[tire])
    }

    /// Number of tires that are integrated.
    pub fn modelled(&self) -> usize {
        self.weight.iter().filter(|&&weight| weight > 0.0).count()
    }
}
