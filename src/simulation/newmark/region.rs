//! The contact region: which cables pull and which tires lie, stick or slide.
//!
//! A step is solved for one region; what comes out implies a region of its own. They must agree, or the step is repeated
//! (source paper, after (5)).

use crate::simulation::wake::Wake;

/// One tire's part of the contact region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Off the ground.
    Free,
    /// On it, at rest or coming to rest within the step.
    Stick,
    /// On it, moving or about to move.
    Slip,
}

/// The contact region of a step.
#[derive(Clone, Debug)]
pub struct Region {
    /// Whether each cable is "switched on" (`n_cables`).
    pub taut: Vec<bool>,
    /// Each tire's support (`n_tires`).
    pub ground: Vec<Ground>,
}

/// Whole regions adopted before changes are made one at a time.
const AT_ONCE: usize = 8;
/// Repetitions of a step before it is halved.
pub const MOST_REPEATS: usize = 40;

impl Region {
    /// Takes over what `implied` says differently of the tires and cables awake; false when nothing does.
    ///
    /// All at once at first; if that goes in circles, only the first difference each time (Murty's least-index rule,
    /// which ends for the positive definite systems met here).
    pub fn adopt(&mut self, implied: &Region, wake: &Wake<'_>, repeats: usize) -> bool {
        let most = if repeats < AT_ONCE { usize::MAX } else { 1 };
        let mut changes = 0;
        for &tire in &wake.awake {
            if changes < most && self.ground[tire] != implied.ground[tire] {
                self.ground[tire] = implied.ground[tire];
                changes += 1;
            }
        }
        for &cable in &wake.blocks {
            if changes < most && self.taut[cable] != implied.taut[cable] {
                self.taut[cable] = implied.taut[cable];
                changes += 1;
            }
        }
        changes > 0
    }
}
