//! The contact region: which cables pull and which tires lie, stick or slide.
//!
//! A step is solved for one region; what comes out implies a region of its own. They must agree, or the step is repeated
//! (source paper, after (5)).

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
#[derive(Clone, Debug, PartialEq)]
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
    /// Takes over what `implied` says differently; false when nothing does.
    ///
    /// All at once at first; if that goes in circles, only the first difference each time (Murty's least-index rule,
    /// which ends for the positive definite systems met here).
    pub fn adopt(&mut self, implied: &Region, repeats: usize) -> bool {
        if self == implied {
            return false;
        }
        if repeats < AT_ONCE {
            self.taut.copy_from_slice(&implied.taut);
            self.ground.copy_from_slice(&implied.ground);
        } else if let Some(tire) = (0..self.ground.len()).find(|&t| self.ground[t] != implied.ground[t]) {
            self.ground[tire] = implied.ground[tire];
        } else if let Some(cable) = (0..self.taut.len()).find(|&c| self.taut[c] != implied.taut[c]) {
            self.taut[cable] = implied.taut[cable];
        }
        true
    }
}
