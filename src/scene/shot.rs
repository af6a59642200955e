//! What fires when: the firing times of one delay option, per tire.

use super::{Scene, TireId};
use crate::plan::{BlastRow, LaunchTargets, Timing};

/// Firing time of each blast row [s] (`n_blast_rows`).
pub fn fire_at_s(timing: &Timing) -> Vec<f64> {
    timing.fire_at_ms().iter().map(|ms| ms * 1e-3).collect()
}

/// One hole's impulse on one tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Firing {
    /// Firing time [s].
    pub at: f64,
    /// Index of the tire above the hole.
    pub tire: usize,
    /// Launch velocity added to the tire's vertical velocity [m/s].
    pub launch: f64,
}

/// All firings of one delay option, in order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shot {
    /// Sorted by time, then tire (`n_holes`).
    pub firings: Vec<Firing>,
    /// Coefficient of friction on the day, instead of the scene's.
    pub friction: Option<f64>,
}

impl Shot {
    /// The shot of blast rows fired at `timing` under `scene`.
    pub fn new(scene: &Scene, rows: &[BlastRow], timing: &Timing) -> Self {
        let targets: Vec<_> = rows.iter().map(|row| scene.targets(&row.targets)).collect();
        Self::from_targets(&targets, &fire_at_s(timing))
    }

    /// The shot of rows with known targets `(tire, launch [m/s])` fired at `at` [s] (`n_rows`).
    pub fn from_targets(targets: &[Vec<(usize, f64)>], at: &[f64]) -> Self {
        let fire = |(row, &at): (&Vec<(usize, f64)>, &f64)| -> Vec<Firing> {
            row.iter().map(|&(tire, launch)| Firing { at, tire, launch }).collect()
        };
        Self::from_firings(targets.iter().zip(at).flat_map(fire).collect())
    }

    /// Whether the shot is its own image under a reflection of the tires.
    pub fn is_mirrored(&self, image: &[usize]) -> bool {
        let reflected = self.firings.iter().map(|f| Firing { tire: image[f.tire], ..*f }).collect();
        Self::from_firings(reflected).firings == self.firings
    }

    /// The shot of `firings` in any order.
    pub fn from_firings(mut firings: Vec<Firing>) -> Self {
        firings.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.tire.cmp(&b.tire)));
        Self { firings, friction: None }
    }
}

impl Scene {
    /// Tires that `charge` launches, each with its launch velocity [m/s].
    pub fn targets(&self, targets: &LaunchTargets) -> Vec<(usize, f64)> {
        match targets {
            LaunchTargets::UnderRow { row, launch_m_s } => {
                let over = |&n: &usize| matches!(self.tire[n], TireId::Cell { row: r, .. } if r == *row);
                let tires = (0..self.tire.len()).filter(over);
                tires.map(|tire| (tire, *launch_m_s)).collect()
            }
            LaunchTargets::UnderTires { tires, launch_m_s } => {
                tires.iter().map(|&tire| (tire, *launch_m_s)).collect()
            }
            LaunchTargets::Holes(holes) => holes
                .iter()
                .filter_map(|hole| Some((self.nearest(hole.x_m, hole.y_m)?, hole.launch_m_s)))
                .collect(),
        }
    }

    /// The tire nearest to a point on the ground; of two as near, the one listed first.
    fn nearest(&self, x: f64, y: f64) -> Option<usize> {
        let distance2 = |tire: &usize| {
            let p = self.position[*tire];
            (p.x - x).powi(2) + (p.y - y).powi(2)
        };
        (0..self.position.len()).min_by(|a, b| distance2(a).total_cmp(&distance2(b)))
    }
}
