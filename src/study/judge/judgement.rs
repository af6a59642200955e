//! The judgement of a delay option: its planned shot and its samples of `[uncertainty]`.

use super::deciding_shot::{DecidingSamples, DecidingShots};
use super::grounds::{Evidence, Ground, Grounds};
use super::one_dud::OneDud;
use super::reason::Reason;
use crate::study::NoResult;
use crate::study::as_planned::check::CheckedShot;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::hole_places::HoleBesideTire;
use crate::study::samples::failure_bounds::FailureBounds;
use crate::study::samples::risk_reason::RiskReason;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sampled_shot::SampledShot;
use crate::verdict::{Limits, Quantity, Verdict};

/// Results of the options of one plan, in their order (`n_options`).
pub type OptionResults = Vec<Result<Judgement, NoResult>>;

/// The verdict on an option; open if there is no result.
pub fn verdict_of(result: &Result<Judgement, NoResult>) -> Verdict {
    result.as_ref().map_or(Verdict::Undecided, Judgement::verdict)
}

/// All that is known of one delay option. The parts become known in the order of the fields. [`take`](Judgement::take) stores each.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The planned shot.
    pub checked: CheckedShot,
    /// The samples of `[uncertainty]`.
    pub sampled: Evidence<SampledShot>,
    /// The samples that decide, run once more; `None` if there are none, or they were not run.
    pub deciding: Option<DecidingShots>,
    /// How much faster than planned the tires may leave; `None` if not asked for, or the time was up.
    pub launch_margin: Option<LaunchMargin>,
    /// The planned shot with one hole left out, the worst of all holes; `None` if not asked for, or the time was up.
    pub one_dud: Option<OneDud>,
    /// Holes that may launch another tire than planned, each with the verdict on the planned shot in which they do.
    pub next_tires: Vec<(HoleBesideTire, Verdict)>,
    /// Height that only the accepted share of the shots would exceed if rims turned toward their cables [m]; `None` if not asked for, if
    /// nothing turns, or if the time was up.
    pub turned_height: Option<f64>,
    /// Whether the option withstands any one dud, if the plan makes that part of the verdict.
    pub withstands_dud: Evidence<Verdict>,
    /// The result of fresh draws. An option that is chosen among several needs them ([`recommend`](super::recommend)).
    pub confirmation: Evidence<RiskSummary>,
}

impl Judgement {
    /// The tire that rises highest; `None` if no tire lifts. It is the tire of the sample that decides by height, or of the planned shot if
    /// that rises higher.
    pub fn highest_tire(&self) -> Option<usize> {
        let planned = self.checked.estimates.height;
        let is_higher = |sampled: &&SampledShot| {
            sampled.deciding_value(Quantity::Height).is_some_and(|height| height >= planned.value)
        };
        let sampled = self.sampled.known().filter(is_higher);
        let lifts = planned.value > 0.0 || sampled.is_some();
        lifts.then(|| sampled.and_then(SampledShot::deciding_tire).unwrap_or(planned.index))
    }

    /// The judgement of the planned shot alone.
    pub fn of_planned_alone(checked: CheckedShot) -> Self {
        Self {
            checked,
            sampled: Evidence::NotAsked,
            deciding: None,
            launch_margin: None,
            one_dud: None,
            next_tires: Vec::new(),
            turned_height: None,
            withstands_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        }
    }

    /// The grounds of the verdict.
    pub fn grounds(&self) -> Grounds {
        Grounds {
            planned: self.checked.verdict,
            launch_is_estimated: self.checked.launch_is_estimated,
            samples: self.sampled.map(SampledShot::verdict),
            one_dud: self.withstands_dud,
            confirmation: self.confirmation.map(|drawn| drawn.verdict),
        }
    }

    /// The verdict on the option, from its [grounds](Self::grounds).
    pub fn verdict(&self) -> Verdict {
        self.grounds().verdict()
    }

    /// Whether fresh draws confirm the pass; `None` if none were drawn.
    pub fn is_confirmed(&self) -> Option<bool> {
        self.confirmation.known().map(|drawn| drawn.verdict == Verdict::Pass)
    }

    /// Whether a dud at some hole makes the planned shot exceed a limit.
    pub fn fails_with_dud(&self) -> bool {
        self.one_dud.is_some_and(|dud| dud.failing > 0)
    }

    /// Share of the samples that do not pass; `None` before the first sample. Undecided samples may fail, so they count.
    pub fn failing_share(&self) -> Option<f64> {
        let FailureBounds { failures, undecided, samples, .. } = self.sampled.known()?.bounds;
        (samples > 0).then(|| (failures + undecided) as f64 / samples as f64)
    }

    /// Share of the limit that only the accepted share of the samples exceeds, or the planned shot's share if that is greater. `None` while
    /// there are few samples: the planned shot alone would flatter the option.
    pub fn used_of_limit(&self, quantity: Quantity, limits: &Limits) -> Option<f64> {
        let value = self.sampled.known()?.deciding_value(quantity)?;
        Some(self.checked.share_of_limit(quantity, limits)?.max(value / limits.get(quantity)?))
    }

    /// The limit of which the shots use most, and that share; `None` while there are few samples.
    pub fn nearest_limit(&self, limits: &Limits) -> Option<(Quantity, f64)> {
        let used = |quantity| Some((quantity, self.used_of_limit(quantity, limits)?));
        Quantity::ALL.into_iter().filter_map(used).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Why the option does not pass; empty for a pass. Each ground that keeps the option from a pass gives at least one reason.
    pub fn reasons(&self) -> Vec<Reason> {
        let reasons_of = |(ground, verdict)| match ground {
            Ground::Planned => self.checked.reasons.iter().copied().map(Reason::AsPlanned).collect(),
            Ground::Samples => vec![match &self.sampled {
                Evidence::Awaited => Reason::NoSamples,
                Evidence::NotAsked => Reason::Samples(RiskReason::LaunchEstimated),
                Evidence::Known(sampled) => {
                    Reason::Samples(sampled.reason().unwrap_or(RiskReason::LaunchEstimated))
                }
            }],
            Ground::OneDud => vec![Reason::OneDud(verdict)],
            Ground::Confirmation => vec![match self.confirmation.known() {
                None => Reason::AwaitsConfirmation,
                Some(RiskSummary { bounds, .. }) => Reason::NotConfirmed {
                    failures: bounds.failures + bounds.undecided,
                    samples: bounds.samples,
                },
            }],
        };
        self.grounds().against_pass().into_iter().flat_map(reasons_of).collect()
    }

    /// Stores a part that has become known.
    pub fn take(&mut self, part: Part) {
        match part {
            Part::Samples { sampled, .. } => self.sampled = Evidence::of(*sampled),
            // More samples may have come meanwhile. If other samples decide now, these runs are outdated.
            Part::Deciding(runs) => {
                let sampled = self.sampled.known();
                let decide =
                    sampled.and_then(|sampled| DecidingSamples::of(sampled, runs.samples.of_any.seed));
                if decide == Some(runs.samples) {
                    self.deciding = Some(*runs);
                }
            }
            Part::Margin(margin) => self.launch_margin = Some(margin),
            Part::Dud { one_dud, next_tires, turned_height } => {
                if self.withstands_dud.is_asked() {
                    let verdict = one_dud.as_ref().map(|one_dud| one_dud.verdict());
                    self.withstands_dud = verdict.map_or(Evidence::Awaited, Evidence::Known);
                }
                self.one_dud = one_dud.map(|one_dud| *one_dud);
                self.next_tires = next_tires.unwrap_or_default();
                self.turned_height = turned_height.flatten();
            }
            Part::Confirmation(drawn) => self.confirmation = Evidence::Known(*drawn),
        }
    }
}

/// A part of a judgement that becomes known after the planned shot, in this order.
#[derive(Clone, Debug)]
pub enum Part {
    /// A round of samples was drawn.
    Samples {
        /// The shot with its samples so far.
        sampled: Box<SampledShot>,
        /// Whether more samples come.
        more: bool,
    },
    /// The samples that decide have run.
    Deciding(Box<DecidingShots>),
    /// How much faster than planned the tires may leave.
    Margin(LaunchMargin),
    /// The option is judged with any one hole left out, with the next tire over holes between two tires, and with tires that turn. A part
    /// is `None` if the time was up, or its computation failed.
    Dud {
        /// The worst place of a dud.
        one_dud: Option<Box<OneDud>>,
        /// Holes that may launch another tire, each with its verdict.
        next_tires: Option<Vec<(HoleBesideTire, Verdict)>>,
        /// The height of tires that turn [m]. The inner value is `None` if the option already fails, or nothing turns.
        turned_height: Option<Option<f64>>,
    },
    /// Fresh draws confirm a pass or refute it.
    Confirmation(Box<RiskSummary>),
}

impl Part {
    /// Whether every part is known.
    pub fn is_whole(&self) -> bool {
        !matches!(
            self,
            Part::Dud { one_dud: None, .. }
                | Part::Dud { next_tires: None, .. }
                | Part::Dud { turned_height: None, .. }
        )
    }
}

impl Evidence<SampledShot> {
    /// The evidence of a shot's samples so far; awaited before the first sample.
    pub fn of(sampled: SampledShot) -> Self {
        if sampled.samples.is_empty() { Evidence::Awaited } else { Evidence::Known(sampled) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::History;
    use crate::study::ShotSummary;
    use crate::study::judge::deciding_shot::DecidingShot;
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::standing::tests::{case, passing, sampled};

    fn drawn(verdict: Verdict) -> RiskSummary {
        let mut bounds = FailureBounds::new(0.01, ErrorShare::Whole);
        [Verdict::Pass, Verdict::Fail, Verdict::Undecided]
            .into_iter()
            .for_each(|verdict| bounds.push(verdict));
        RiskSummary { bounds, verdict, finer_runs_disagree: false, utilization: 0.5 }
    }

    fn dud(not_passing: usize) -> Box<OneDud> {
        let planned = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        Box::new(OneDud { row: 0, number: 0, planned, not_passing, failing: 0, places: 9, sampled: None })
    }

    /// Fresh draws that refute a pass leave the verdict open. The reason says how many draws fail.
    #[test]
    fn a_pass_is_confirmed_by_fresh_draws_that_pass_alone() {
        let case = case();
        let mut judged = Judgement { confirmation: Evidence::Awaited, ..passing(&case, 500) };
        assert_eq!((judged.is_confirmed(), judged.reasons()), (None, vec![Reason::AwaitsConfirmation]));
        judged.take(Part::Confirmation(Box::new(drawn(Verdict::Undecided))));
        let refused = Reason::NotConfirmed { failures: 2, samples: 3 };
        assert_eq!((judged.is_confirmed(), judged.reasons()), (Some(false), vec![refused]));
        judged.take(Part::Confirmation(Box::new(drawn(Verdict::Pass))));
        assert_eq!((judged.is_confirmed(), judged.reasons()), (Some(true), vec![]));
        assert_eq!(judged.verdict(), Verdict::Pass);
    }

    #[test]
    fn whatever_keeps_an_option_from_a_pass_is_a_reason() {
        let case = case();
        let full = passing(&case, 500);
        let missing = Judgement { sampled: Evidence::Awaited, ..full.clone() };
        assert_eq!(missing.reasons(), [Reason::NoSamples]);
        let mut estimated = Judgement { sampled: Evidence::NotAsked, ..full.clone() };
        estimated.checked.launch_is_estimated = true;
        assert_eq!(estimated.reasons(), [Reason::Samples(RiskReason::LaunchEstimated)]);
        let fails = Judgement { withstands_dud: Evidence::Awaited, ..sampled(&case, 500, 400) };
        assert!(matches!(fails.reasons()[..], [Reason::Samples(_), Reason::OneDud(Verdict::Undecided)]));
        assert_eq!(fails.reasons()[0].verdict(), Verdict::Fail);
    }

    /// One dud counts if the plan asks for it. A place that is open leaves the verdict open, and so does an unknown result.
    #[test]
    fn a_dud_counts_where_the_plan_asks_for_it() {
        let case = case();
        for (asked, one_dud, verdict) in [
            (Evidence::Awaited, Some(dud(0)), Verdict::Pass),
            (Evidence::Awaited, Some(dud(3)), Verdict::Undecided),
            (Evidence::Known(Verdict::Pass), None, Verdict::Undecided),
            (Evidence::NotAsked, Some(dud(3)), Verdict::Pass),
            (Evidence::NotAsked, None, Verdict::Pass),
        ] {
            let mut judged = Judgement { withstands_dud: asked, ..passing(&case, 500) };
            let is_known = one_dud.is_some();
            judged.take(Part::Dud { one_dud, next_tires: None, turned_height: None });
            assert_eq!((judged.verdict(), judged.one_dud.is_some()), (verdict, is_known));
        }
        let part = |one_dud, next_tires| Part::Dud { one_dud, next_tires, turned_height: Some(None) };
        assert!(!part(Some(dud(0)), None).is_whole() && !part(None, Some(vec![])).is_whole());
        assert!(part(Some(dud(0)), Some(vec![])).is_whole());
        let without_turned =
            Part::Dud { one_dud: Some(dud(0)), next_tires: Some(vec![]), turned_height: None };
        assert!(
            !without_turned.is_whole(),
            "the time was up before it was known how high tires that turn rise"
        );
        assert!(Part::Margin(LaunchMargin::BeyondTried).is_whole());
    }

    /// Runs of deciding samples are stored only while these samples still decide.
    #[test]
    fn runs_of_samples_that_decide_no_more_are_not_taken() {
        let case = case();
        let mut judged = passing(&case, 500);
        let samples = DecidingSamples::of(judged.sampled.known().expect("samples"), 7).expect("samples");
        let run = |samples: DecidingSamples| {
            let shot =
                |sample| DecidingShot { sample, shot: case.shots[0].clone(), history: History::new(0.1) };
            let (height, force) = (shot(samples.height), shot(samples.force));
            Part::Deciding(Box::new(DecidingShots { samples, height, force }))
        };
        let mut outdated = samples;
        outdated.force.number += 1;
        judged.take(run(outdated));
        assert!(judged.deciding.is_none());
        judged.take(run(samples));
        assert_eq!(judged.deciding.as_ref().map(|runs| runs.samples), Some(samples));
        judged.take(run(outdated));
        assert_eq!(judged.deciding.map(|runs| runs.samples), Some(samples));
        let mut begun = Judgement { sampled: Evidence::Awaited, ..passing(&case, 1) };
        let Evidence::Known(all) = passing(&case, 500).sampled else { panic!("samples") };
        begun.take(Part::Samples { sampled: Box::new(all), more: false });
        assert_eq!(begun.verdict(), Verdict::Pass);
    }
}
