//! Firings of one shot: which tire is launched when, and how fast.

/// Impulse of one hole on one tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Firing {
    /// Firing time [s].
    pub at: f64,
    /// Index of the tire above the hole.
    pub tire: usize,
    /// Launch velocity, added to the vertical velocity of the tire [m/s].
    pub launch: f64,
}

/// All firings of one shot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shot {
    /// Firings in order of time, then of tires (`n_holes`).
    pub firings: Vec<Firing>,
    /// Coefficient of friction for this shot; `None`: the friction of the scene.
    pub friction: Option<f64>,
}

impl Shot {
    /// Shot of blast rows with known targets `(tire, launch [m/s])`, each row fired at its time `at` [s] (both `n_rows`).
    pub fn from_targets(targets: &[Vec<(usize, f64)>], at: &[f64]) -> Self {
        let fire = |(row, &at): (&Vec<(usize, f64)>, &f64)| -> Vec<Firing> {
            row.iter().map(|&(tire, launch)| Firing { at, tire, launch }).collect()
        };
        Self::from_firings(targets.iter().zip(at).flat_map(fire).collect())
    }

    /// Shot of `firings` in any order.
    pub fn from_firings(mut firings: Vec<Firing>) -> Self {
        firings.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.tire.cmp(&b.tire)));
        Self { firings, friction: None }
    }

    /// Whether the shot is its own image under a reflection; `image` is the image of each tire (`n_tires`).
    pub fn is_mirrored(&self, image: &[usize]) -> bool {
        let reflected = self.firings.iter().map(|f| Firing { tire: image[f.tire], ..*f }).collect();
        Self::from_firings(reflected).firings == self.firings
    }
}
