//! The cover over each hole as it fires. In the model a tire gets the whole launch even if it is then in the air, or no longer over
//! its hole.

use serde::{Deserialize, Serialize};

use crate::scene::Firing;
use crate::simulation::Motion;
use crate::study::Case;
use crate::study::hole_places::uncovering;
use crate::verdict::Verdict;

/// Height above which a tire counts as being in the air [m].
const IN_AIR: f64 = 0.01;
/// Share of the widest distance between tied tires. A tire that has shifted by more no longer counts as over its hole: another tire is
/// then as near.
const ASIDE: f64 = 0.5;

/// The cover over the holes of a shot, each at its firing time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cover {
    /// Number of holes.
    pub holes: usize,
    /// Number of holes whose tire is in the air or aside.
    pub uncovered: usize,
    /// Number of holes over which no tire lies: neither their own nor another tire, or only a tire that stands high.
    #[serde(default)]
    pub under_no_tire: usize,
    /// How near the holes came to lying under no tire, as [`uncovering`] says. The hole that came nearest counts.
    #[serde(default)]
    pub uncovering: f64,
    /// Greatest height of a tire over a hole that fires [m].
    pub height: f64,
    /// Greatest shift of a tire over a hole that fires [m].
    pub shift: f64,
}

impl Cover {
    /// The cover of a shot without holes.
    pub const NONE: Self =
        Self { holes: 0, uncovered: 0, under_no_tire: 0, uncovering: 0.0, height: 0.0, shift: 0.0 };

    /// The verdict of a run with this cover, whose limits give the verdict `of_limits`. If a hole fires under no tire, the run does
    /// not pass.
    pub fn verdict(&self, of_limits: Verdict) -> Verdict {
        if self.under_no_tire > 0 { of_limits.max(Verdict::Undecided) } else { of_limits }
    }
}

/// Watches a run, and records the cover over its holes.
pub struct CoverRecorder<'s> {
    case: &'s Case,
    firings: &'s [Firing],
    step: f64,
    aside: f64,
    cover: Cover,
}

impl<'s> CoverRecorder<'s> {
    /// Recorder for a run of `firings` at a `step` [s].
    pub fn new(case: &'s Case, firings: &'s [Firing], step: f64) -> Self {
        let aside = ASIDE * case.plan.layout.widest_tie();
        Self { case, firings, step, aside, cover: Cover::NONE }
    }

    /// Records the tires over the holes that fire within the step that begins now.
    pub fn observe(&mut self, motion: &dyn Motion) {
        let end = motion.time() + self.step;
        while let Some(firing) = self.firings.get(self.cover.holes).filter(|firing| firing.time < end) {
            let displacement = motion.displacement(firing.tire);
            let (height, shift) = (displacement.z, displacement.xy().norm());
            let uncovering = uncovering(self.case, firing, |tire| motion.displacement(tire));
            let cover = &mut self.cover;
            cover.holes += 1;
            cover.under_no_tire += usize::from(uncovering > 1.0);
            cover.uncovered += usize::from(height > IN_AIR || shift > self.aside);
            cover.uncovering = cover.uncovering.max(uncovering);
            (cover.height, cover.shift) = (cover.height.max(height), cover.shift.max(shift));
        }
    }

    /// The recorded cover.
    pub fn cover(&self) -> Cover {
        self.cover
    }
}
