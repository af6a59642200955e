//! One sample of a shot, and the result of its run.

use serde::{Deserialize, Serialize};

use super::random_shot::Input;
use crate::outcome::{Outcome, Peak};
use crate::scene::Shot;
use crate::study::Case;
use crate::study::as_planned::cover::Cover;
use crate::study::as_planned::shot_reason::{ShotReason, energy_balance_closes, find_reasons};
use crate::study::as_planned::shot_summary::or_infinite;
use crate::verdict::{Estimate, Limits, PerQuantity, Quantity, Verdict};

/// One sample of a shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number of the sample, from 0.
    pub number: usize,
    /// Run at the step of samples; at a finer step if that run fails or loses energy.
    pub run: SampleRun,
    /// Run at a still finer step, if the sample is audited.
    pub finer: Option<SampleRun>,
    /// Values of the inputs in [`Input::ALL`].
    pub inputs: [f64; Input::ALL.len()],
}

impl Sample {
    /// The run at the finest step.
    pub fn finest(&self) -> &SampleRun {
        self.finer.as_ref().unwrap_or(&self.run)
    }
}

/// Result of a sample at one step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleRun {
    /// Whether the run keeps every limit. Undecided if the run ends too early, fails, loses energy, or a hole fires under no tire.
    pub verdict: Verdict,
    /// How near a hole comes to firing under no tire: see [`Cover::uncovering`].
    #[serde(default)]
    pub uncovering: f64,
    /// Fail if a cable breaks. Undecided if the verdict is undecided, or if the run ends early without a break.
    pub breaks: Verdict,
    /// Greatest flight height [m].
    #[serde(deserialize_with = "or_infinite")]
    pub height: f64,
    /// Index of the tire with the greatest flight height.
    #[serde(default)]
    pub tire: usize,
    /// Greatest cable force, scaled to a cable with the breaking force of the plan [N].
    #[serde(deserialize_with = "or_infinite")]
    pub force: f64,
    /// Index of the cable with the greatest force.
    pub cable: usize,
    /// Greatest drift at the end [m].
    #[serde(deserialize_with = "or_infinite")]
    pub drift: f64,
}

impl SampleRun {
    /// A run that failed.
    pub const FAILED_RUN: Self = Self {
        verdict: Verdict::Undecided,
        uncovering: 0.0,
        breaks: Verdict::Undecided,
        height: f64::INFINITY,
        tire: 0,
        force: f64::INFINITY,
        cable: 0,
        drift: f64::INFINITY,
    };

    /// Judges a run with this cover over its holes. A run without energy balance shows nothing.
    pub fn new(case: &Case, shot: &Shot, outcome: &Outcome, cover: &Cover) -> Self {
        let exact = |Peak { value, time, index }| Estimate { value, error: 0.0, time, index };
        let Outcome { height, force, drift, .. } = *outcome;
        let estimates = PerQuantity { height: exact(height), force: exact(force), drift: exact(drift) };
        let reasons = find_reasons(case, shot, outcome, &estimates, 1.0);
        let verdict = match energy_balance_closes(outcome.ledger.residual()) {
            true => cover.verdict(Verdict::worst(reasons.iter().map(ShotReason::verdict))),
            false => Verdict::Undecided,
        };
        let broke = !outcome.broken.is_empty() || outcome.force.value > case.limits.breaking_force;
        let ends_early = reasons.iter().any(|reason| matches!(reason, ShotReason::EndsEarly { .. }));
        let breaks = match verdict {
            Verdict::Undecided => Verdict::Undecided,
            _ if broke => Verdict::Fail,
            _ if ends_early => Verdict::Undecided,
            _ => Verdict::Pass,
        };
        Self {
            verdict,
            uncovering: cover.uncovering,
            breaks,
            height: height.value,
            tire: height.index,
            force: force.value,
            cable: force.index,
            drift: drift.value,
        }
    }

    /// Whether a hole fires under no tire. The model gives its launch to the nearest tire, and knows nothing of the rock.
    pub fn is_uncovered(&self) -> bool {
        self.uncovering > 1.0
    }

    /// Utilization of the run: the greatest share of a limit.
    pub fn utilization(&self, limits: &Limits) -> f64 {
        limits.utilization(|quantity| self.get(quantity))
    }

    /// The value of a quantity [its SI unit].
    pub fn get(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Height => self.height,
            Quantity::Force => self.force,
            Quantity::Drift => self.drift,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::{BrokenCable, EndReason, Ledger, RunEnd};
    use crate::study::as_planned::shot_reason::tests::{case, outcome};

    /// A break shows if a cable broke or was pulled with more than its breaking force. Only a run that was followed to its end
    /// shows that no cable breaks. A run without energy balance shows nothing. A run with a hole under no tire shows no more than
    /// its breaks.
    #[test]
    fn a_run_shows_what_it_was_followed_for() {
        let case = case();
        let covered = Cover { holes: 1, ..Cover::NONE };
        let bare = Cover { holes: 1, uncovered: 1, under_no_tire: 1, uncovering: 1.5, ..Cover::NONE };
        let judged = |outcome: &Outcome, cover: &Cover| {
            let run = SampleRun::new(&case, &case.shots[0], outcome, cover);
            assert_eq!((run.force, run.uncovering), (outcome.force.value, cover.uncovering));
            [run.verdict, run.breaks]
        };
        let pulled = |value: f64| Outcome { force: Peak { value, time: 0.5, index: 2 }, ..outcome() };
        let broken = Outcome { broken: vec![BrokenCable { time: 0.5, cable: 2 }], ..pulled(900.0) };
        let most = case.limits.breaking_force;
        assert!(most > case.limits.force, "a pull between the limit and the breaking force breaks nothing");
        let [pass, fail, open] = [Verdict::Pass, Verdict::Fail, Verdict::Undecided];
        assert_eq!(judged(&pulled(900.0), &covered), [pass, pass]);
        assert_eq!(judged(&pulled(most), &covered), [fail, pass]);
        assert_eq!(judged(&pulled(1.001 * most), &covered), [fail, fail]);
        assert_eq!(judged(&broken, &covered), [fail, fail]);
        let cut = |outcome: Outcome| Outcome {
            end: RunEnd { time: 1000.0, reason: EndReason::TimeLimit },
            ..outcome
        };
        let high = Outcome { height: Peak { value: 3.0, ..Peak::default() }, ..pulled(900.0) };
        assert_eq!(judged(&high, &covered), [fail, pass]);
        assert_eq!(judged(&cut(pulled(900.0)), &covered), [open, open]);
        assert_eq!(judged(&cut(high), &covered), [fail, open]);
        assert_eq!(judged(&cut(broken.clone()), &covered), [fail, fail]);
        assert_eq!(judged(&pulled(900.0), &bare), [open, open]);
        assert_eq!(judged(&broken, &bare), [fail, fail]);
        let unbalanced = Ledger { put_in: 1.0, greatest_residual: 0.1, ..Ledger::default() };
        assert_eq!(judged(&Outcome { ledger: unbalanced, ..broken }, &covered), [open, open]);
    }

    /// A hole exactly under the rim lies under its tire, as in [`CoverRecorder`](crate::study::as_planned::cover::CoverRecorder).
    #[test]
    fn only_a_hole_beyond_the_rim_is_uncovered() {
        let run = |uncovering: f64| SampleRun { uncovering, ..SampleRun::FAILED_RUN };
        assert!(run(1.001).is_uncovered() && !run(1.0).is_uncovered());
        let limits = Limits { height: 2.0, force: 1000.0, drift: None, ..case().limits };
        let run = SampleRun { height: 0.5, force: 750.0, ..run(0.0) };
        assert_eq!(run.utilization(&limits), 0.75);
    }
}
