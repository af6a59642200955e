//! The contact region: which cables are taut, and which tires are in the air, stick or slip.
//!
//! A step is solved for an assumed region, and the solution implies a region. If both differ, the step is repeated (source paper,
//! after (5)).

use crate::simulation::wake::Wake;

/// Contact of one tire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TireContact {
    /// In the air.
    InAir,
    /// On the ground, at rest or coming to rest within the step.
    Stick,
    /// On the ground, moving or about to move.
    Slip,
}

/// The contact region of a step.
#[derive(Clone, Debug)]
pub struct Region {
    /// Whether each cable is taut, "switched on" in the paper (`n_cables`).
    pub taut: Vec<bool>,
    /// Contact of each tire (`n_tires`).
    pub ground: Vec<TireContact>,
}

/// Number of repetitions that adopt a whole region. Later repetitions adopt one change each. After a landing or a firing, the
/// region is final after two or three repetitions. A region that still changes after eight runs in a circle.
const AT_ONCE: usize = 8;
/// Greatest number of repetitions of a step. After these, the step is halved, because less happens within a shorter step.
pub const MOST_REPEATS: usize = 40;

impl Region {
    /// Adopts the differences of `implied` at the awake tires and cables; returns whether there is any.
    ///
    /// The first repetitions adopt all differences at once. If these repetitions run in a circle, later repetitions adopt only the
    /// first difference (Murty's least-index rule, which ends for the positive definite systems of this method).
    pub fn adopt(&mut self, implied: &Region, wake: &Wake<'_>, repeats: usize) -> bool {
        let most = if repeats < AT_ONCE { usize::MAX } else { 1 };
        let mut changes = 0;
        for &tire in wake.awake_tires() {
            if changes < most && self.ground[tire] != implied.ground[tire] {
                self.ground[tire] = implied.ground[tire];
                changes += 1;
            }
        }
        for &cable in wake.awake_cables() {
            if changes < most && self.taut[cable] != implied.taut[cable] {
                self.taut[cable] = implied.taut[cable];
                changes += 1;
            }
        }
        changes > 0
    }
}
