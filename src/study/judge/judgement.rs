//! The verdict on a delay option: on the shot as planned, and on the shots that `[uncertainty]` describes.

use super::deciding_shot::{DecidingSamples, DecidingShots};
use super::grounds::{Evidence, Ground, Grounds};
use super::one_dud::OneDud;
use super::reason::Reason;
use crate::study::NoResult;
use crate::study::as_planned::check::CheckedShot;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::hole_places::HoleBesideTire;
use crate::study::samples::risk_reason::RiskReason;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sampled_shot::SampledShot;
use crate::verdict::Verdict;

/// Results of the options of one plan, in their order (`n_options`).
pub type OptionResults = Vec<Result<Judgement, NoResult>>;

/// The verdict on an option: without a result it is open.
pub fn verdict_of(result: &Result<Judgement, NoResult>) -> Verdict {
    result.as_ref().map_or(Verdict::Undecided, Judgement::verdict)
}

/// All that is known of one delay option. Its parts become known one after the other, in the order of the fields, and
/// [`take`](Judgement::take) puts each in.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The shot as planned.
    pub checked: CheckedShot,
    /// The shots that `[uncertainty]` describes.
    pub sampled: Evidence<SampledShot>,
    /// The samples that decide; `None` where there are none, or they were not run.
    pub deciding: Option<DecidingShots>,
    /// How much faster than planned the tires may leave; `None` where it was not asked for, or the time was up.
    pub launch_margin: Option<LaunchMargin>,
    /// The shot as planned with one hole left out, the worst of all holes; `None` where it was not asked for, or the time was up.
    pub one_dud: Option<OneDud>,
    /// Holes that may launch another tire than planned, each with the verdict on the planned shot in which it does.
    pub next_tires: Vec<(HoleBesideTire, Verdict)>,
    /// Whether the option withstands any one dud, where the plan makes that a part of the verdict.
    pub withstands_dud: Evidence<Verdict>,
    /// What fresh draws tell. An option that is chosen among several needs them ([`recommend`](super::recommend)).
    pub confirmation: Evidence<RiskSummary>,
}

impl Judgement {
    /// The judgement of the shot as planned alone.
    pub fn of_planned_alone(checked: CheckedShot) -> Self {
        Self {
            checked,
            sampled: Evidence::NotAsked,
            deciding: None,
            launch_margin: None,
            one_dud: None,
            next_tires: Vec::new(),
            withstands_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        }
    }

    /// What the verdict rests on.
    pub fn grounds(&self) -> Grounds {
        Grounds {
            planned: self.checked.verdict,
            launch_is_estimated: self.checked.launch_is_estimated,
            samples: self.sampled.map(SampledShot::verdict),
            one_dud: self.withstands_dud,
            confirmation: self.confirmation.map(|drawn| drawn.verdict),
        }
    }

    /// The verdict on the option: that of its [grounds](Self::grounds).
    pub fn verdict(&self) -> Verdict {
        self.grounds().verdict()
    }

    /// Whether fresh draws confirm the pass; `None` where none were drawn.
    pub fn is_confirmed(&self) -> Option<bool> {
        self.confirmation.known().map(|drawn| drawn.verdict == Verdict::Pass)
    }

    /// Why the option does not pass: at least one reason for each ground that keeps it from a pass; empty for a pass.
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

    /// Notes what has become known.
    pub fn take(&mut self, part: Part) {
        match part {
            Part::Samples { sampled, .. } => self.sampled = Evidence::of(*sampled),
            // More samples may have come meanwhile. If other samples decide by now, these runs are outdated.
            Part::Deciding(runs) => {
                let sampled = self.sampled.known();
                let decide =
                    sampled.and_then(|sampled| DecidingSamples::of(sampled, runs.samples.of_any.seed));
                if decide == Some(runs.samples) {
                    self.deciding = Some(*runs);
                }
            }
            Part::Margin(margin) => self.launch_margin = Some(margin),
            Part::Dud { one_dud, next_tires } => {
                if self.withstands_dud.is_asked() {
                    let verdict = one_dud.as_ref().map(|one_dud| one_dud.verdict());
                    self.withstands_dud = verdict.map_or(Evidence::Awaited, Evidence::Known);
                }
                self.one_dud = one_dud.map(|one_dud| *one_dud);
                self.next_tires = next_tires.unwrap_or_default();
            }
            Part::Confirmation(drawn) => self.confirmation = Evidence::Known(*drawn),
        }
    }
}

/// A part of a judgement, as it becomes known after the shot as planned; in this order.
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
    /// The option is judged with any one hole left out, and with the next tire over holes between two; `None` where the time was up.
    Dud {
        /// The worst place of a dud.
        one_dud: Option<Box<OneDud>>,
        /// Holes of which another tire may get the impulse, each with its verdict.
        next_tires: Option<Vec<(HoleBesideTire, Verdict)>>,
    },
    /// Fresh draws confirm a pass, or do not.
    Confirmation(Box<RiskSummary>),
}

impl Part {
    /// Of duds nothing is known.
    pub const NO_DUD: Self = Part::Dud { one_dud: None, next_tires: None };

    /// Whether the time sufficed for all of it.
    pub fn is_whole(&self) -> bool {
        !matches!(self, Part::Dud { one_dud: None, .. } | Part::Dud { next_tires: None, .. })
    }
}

impl Evidence<SampledShot> {
    /// What a shot with its samples so far tells.
    pub fn of(sampled: SampledShot) -> Self {
        if sampled.samples.is_empty() { Evidence::Awaited } else { Evidence::Known(sampled) }
    }
}
